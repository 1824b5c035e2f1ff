#include "formats/step/rules.h"

namespace trimloop::step::rules {

// tests/formats/step/rules_test.cpp compares this list with the header's text, so that no rule is forgotten.
std::span<const Rule* const> all() {
  static constexpr const Rule* table[] = {
    &not_part21, &end_missing, &after_end, &section_order, &header_entities, &header_arity, &header_types,
    &implementation_level, &schema_name, &instance_zero, &instance_malformed, &instance_duplicate,
    &reference_unresolved, &reference_self, &terminator, &separators, &string_open, &string_escape, &string_raw_byte,
    &comment_open, &real_form, &real_overflow, &integer_overflow, &enum_form, &binary_form, &complex_order, &depth,
    &encoding, &edition3, &signature, &container, &user_defined, &multi_data, &keyword_case, &header_missing,
    &attribute_count, &attribute_type, &required_null, &enum_value, &select_type, &aggregate_bounds, &reference_cycle,
    &curve_sums, &surface_sums, &knots_order, &weights, &direction_zero, &vector_magnitude, &axis_parallel,
    &dimension_mix, &conic_size, &cone_angle, &torus_size, &trimmed_curve, &composite_transition, &pcurve,
    &surface_curve, &rectangular_trim, &swept_degenerate, &oriented_nesting, &edge_vertices, &path_chain,
    &face_bounds, &shell_faces, &closed_shell_edges, &void_orientation, &representation_context, &units, &uncertainty,
    &tessellated, &assembly_cycle, &occurrence_transform, &transform_quality, &mapped_cycle, &expansion, &shape_link,
    &context_mismatch, &placement_swapped, &other_file, &property_unit, &property_positive, &property_volume, &property_area,
    &property_centroid,
  };
  return table;
}

}  // namespace trimloop::step::rules
