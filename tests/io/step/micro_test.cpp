// The micro-suite: files of a few instances, one for each entity or fact, against closed forms. tests/data/step.

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <fstream>
#include <iterator>

#include "io/io.h"
#include "kernel/check/measure.h"
#include "tests/support/paths.h"

using namespace trimloop;

namespace {

io::ReadResult read(const std::string& name) { return io::read(test::source_dir() / "tests/data/step" / (name + ".stp")); }

struct Expected {
  const char* file;
  std::size_t solids, faces, curves;
  double length, area, volume;  // mm, mm2, mm3; volume 0: none
  std::size_t findings = 0;     // warnings and errors
};

const double ellipse_quarter = 2.4221120551369188;  // complete elliptic integral: 2 E(sqrt(3)/2)
// integral of sqrt(cosh 2t) over [-1, 1], by Simpson with 4096 steps
double hyperbola_length() {
  const int n = 4096;
  double sum = 0;
  for (int i = 0; i <= n; ++i) {
    const double t = -1 + 2.0 * i / n;
    sum += (i == 0 || i == n ? 1 : i % 2 ? 4 : 2) * std::sqrt(std::cosh(2 * t));
  }
  return sum * 2.0 / n / 3;
}

const double ellipsoid_area = 48.882146302583;  // semi-axes 1, 2, 3: by its elliptic integrals

// The sheets of a torus of radii 1 and 2, between the angles at which it meets its axis: 2 pi r integral |R + r cos v| dv and
// pi integral (R + r cos v)^2 r cos v dv.
const double axis_angle = 2 * pi / 3, outer_sheet = 4 * pi * (2 * axis_angle + 4 * std::sin(axis_angle)),
             inner_sheet = 4 * pi * (4 * std::sin(axis_angle) - 2 * (pi - axis_angle));
double spindle_volume(double v) {  // from 0 to v, twice
  return 4 * pi * (std::sin(v) + 2 * (v + std::sin(2 * v) / 2) + 4 * (std::sin(v) - std::pow(std::sin(v), 3) / 3));
}

const Expected table[] = {
    {"line_long_vector", 0, 0, 1, 10, 0, 0},
    {"circle_degrees", 0, 0, 1, pi, 0, 0},
    {"trimmed_by_points_against", 0, 0, 1, 3 * pi, 0, 0},
    {"ellipse_short_axis_first", 0, 0, 1, ellipse_quarter, 0, 0},
    {"parabola", 0, 0, 1, std::sqrt(2.0) + std::asinh(1.0), 0, 0},
    {"hyperbola", 0, 0, 1, hyperbola_length(), 0, 0},
    {"polyline", 0, 0, 1, 7, 0, 0},
    {"bezier_curve", 0, 0, 1, 2, 0, 0},
    {"quasi_uniform_curve", 0, 0, 1, 3, 0, 0},
    {"uniform_curve", 0, 0, 1, 2, 0, 0},
    {"rational_spline_complex", 0, 0, 1, pi / 2, 0, 0},
    {"complex_parts_out_of_order", 0, 0, 1, pi / 2, 0, 0, 1},
    {"composite_with_reversed_segment", 0, 0, 1, 7, 0, 0},
    {"offset_curve", 0, 0, 1, 2 * pi, 0, 0},
    {"curve_replica", 0, 0, 1, 4 * pi, 0, 0},
    {"replica_with_six_attributes", 0, 0, 1, 4 * pi, 0, 0, 1},
    {"inch", 0, 0, 1, 25.4, 0, 0},
    {"mixed_units", 0, 0, 2, 26.4, 0, 0},
    {"rectangular_trimmed_cylinder", 0, 1, 0, 0, pi, 0},
    {"cone_in_degrees", 0, 1, 0, 0, 0.75 * pi * std::sqrt(2.0), 0},
    {"offset_of_cylinder", 0, 1, 0, 0, 2 * pi, 0},
    {"extruded_line", 0, 1, 0, 0, 12, 0},
    {"revolved_line", 0, 1, 0, 0, 2 * pi, 0},
    {"bezier_surface", 0, 1, 0, 0, 6, 0},
    {"curve_bounded_plane", 0, 1, 0, 0, pi, 0},
    {"face_same_sense", 0, 1, 0, 0, 4, 0},
    {"face_against_surface", 0, 1, 0, 0, 4, 0},
    {"edge_same_sense_false", 0, 1, 0, 0, 6, 0},
    {"solid_cylinder", 1, 3, 0, 0, 6 * pi, 2 * pi},
    {"solid_cylinder_without_seam", 1, 3, 0, 0, 6 * pi, 2 * pi},
    {"solid_cylinder_in_metres", 1, 3, 0, 0, 6 * pi, 2 * pi},
    {"sphere_by_vertex_loop", 1, 1, 0, 0, 4 * pi, 4 * pi / 3},
    {"torus_by_vertex_loop", 1, 1, 0, 0, 8 * pi * pi, 4 * pi * pi},
    {"degenerate_torus_outer", 1, 1, 0, 0, outer_sheet, spindle_volume(axis_angle)},
    {"degenerate_torus_inner", 1, 1, 0, 0, inner_sheet, spindle_volume(axis_angle) - spindle_volume(pi)},
    {"torus_negative_major", 0, 1, 0, 0, inner_sheet / 2, 0, 2},
    {"cone_beyond_its_apex", 0, 1, 0, 0, pi * 2 * std::sqrt(8.0) / 2, 0},
    {"short_arc", 0, 1, 0, 0, 3 * 0.0005, 0},
    {"composite_of_one_line", 0, 1, 0, 0, 6, 0},
    {"polygons_off_their_plane", 1, 4, 0, 0, 1.5 + std::sqrt(3.0) / 2, 1.0 / 6, 3},
    {"brep_with_void", 1, 2, 0, 0, 20 * pi, 28 * pi / 3},
    {"faceted_brep", 1, 4, 0, 0, 1.5 + std::sqrt(3.0) / 2, 1.0 / 6},
    {"csg_primitives", 7, 21, 0, 0, 88 + 2 * std::sqrt(13.0) + (81 + 15 * std::sqrt(2.0)) * pi + 16 * pi * pi + ellipsoid_area, 24 + 18 + 20 * pi + 21 * pi + 36 * pi + 8 * pi * pi + 8 * pi},
    {"csg_tree", 2, 14, 0, 0, 5 * (2 * (16 - pi) + 1.5 * (16 + 2 * pi)), 9 * 1.5 * (16 - pi)},
    {"swept_areas", 2, 7, 0, 0, 2 * 3 * pi + 18 * pi + 2 * pi + 4 * pi * pi, 9 * pi + 2 * pi * pi},
    {"assembly", 1, 3, 0, 0, 6 * pi, 2 * pi},
    {"assembly_swapped_representations", 1, 3, 0, 0, 6 * pi, 2 * pi},
    {"assembly_swapped_placements", 1, 3, 0, 0, 6 * pi, 2 * pi},
    {"assembly_swapped_both", 1, 3, 0, 0, 6 * pi, 2 * pi},
    {"mapped_item_scaled", 2, 6, 0, 0, 30 * pi, 18 * pi},
    {"styles", 1, 3, 0, 0, 6 * pi, 2 * pi},
    {"validation_right", 1, 3, 0, 0, 6 * pi, 2 * pi},
};

bool near(double a, double b) { return std::abs(a - b) <= 1e-7 * std::max(1.0, std::abs(b)); }

}  // namespace

BOOST_AUTO_TEST_SUITE(micro)

BOOST_AUTO_TEST_CASE(every_file_has_its_closed_form) {
  for (const Expected& e : table) {
    BOOST_TEST_CONTEXT(e.file) {
      const io::ReadResult r = read(e.file);
      BOOST_TEST(r.usable);
      BOOST_TEST(r.report.count(Severity::Warning) + r.report.count(Severity::Error) == e.findings);
      const auto c = count(r.model);
      const auto m = measure(r.model, Limits{});
      BOOST_REQUIRE(c.has_value());
      BOOST_REQUIRE(m.has_value());
      BOOST_TEST(c->solids == e.solids);
      BOOST_TEST(c->faces == e.faces);
      BOOST_TEST(c->faces_failed == 0u);
      BOOST_TEST(c->curves == e.curves);
      BOOST_TEST(near(m->curve_length_mm, e.length), m->curve_length_mm << " is not " << e.length);
      BOOST_TEST(near(m->area_mm2, e.area), m->area_mm2 << " is not " << e.area);
      BOOST_TEST(near(m->volume_mm3.value_or(0), e.volume), m->volume_mm3.value_or(0) << " is not " << e.volume);
      for (const Part& part : r.model.parts)
        for (const Body& body : part.bodies)
          for (const std::string& broken : broken_promises(body, 1e-6)) BOOST_TEST(broken == "");
    }
  }
}

BOOST_AUTO_TEST_CASE(an_ellipse_with_the_short_axis_first_starts_on_it) {
  const io::ReadResult r = read("ellipse_short_axis_first");
  const Curve& c = r.model.parts[0].curves.front().curve;
  BOOST_TEST(distance(start_point(c), Point{1, 0, 0}) < 1e-12);
  BOOST_TEST(distance(end_point(c), Point{0, 2, 0}) < 1e-12);
}

BOOST_AUTO_TEST_CASE(same_sense_turns_the_normal_only) {
  BOOST_TEST(!read("face_same_sense").model.parts[0].bodies[0].faces[0].reversed);
  BOOST_TEST(read("face_against_surface").model.parts[0].bodies[0].faces[0].reversed);
}

BOOST_AUTO_TEST_CASE(an_occurrence_is_where_the_product_structure_puts_it) {
  // The cylinder from z = 0 to 2 is laid along x from 10 on, whoever wrote which placement first.
  for (const char* name : {"assembly", "assembly_swapped_representations", "assembly_swapped_placements", "assembly_swapped_both"}) {
    BOOST_TEST_CONTEXT(name) {
      const io::ReadResult r = read(name);
      const auto m = measure(r.model, Limits{});
      BOOST_REQUIRE(m.has_value());
      BOOST_TEST(distance(m->box.lo, Point{10, -1, -1}) < 1e-3);
      BOOST_TEST(distance(m->box.hi, Point{12, 1, 1}) < 1e-3);
      BOOST_TEST(r.model.name == "assembly");
      BOOST_REQUIRE(r.model.parts[0].instances.size() == 1u);
      BOOST_TEST(r.model[r.model.parts[0].instances[0].attributes].name == "first");
    }
  }
}

BOOST_AUTO_TEST_CASE(mapped_items_place_what_the_product_structure_names) {
  const io::ReadResult r = read("mapped_occurrences");
  BOOST_TEST(r.report.items().empty());
  BOOST_REQUIRE(r.model.parts[0].instances.size() == 2u);  // and not four
  const Instance &lying = r.model.parts[0].instances[0], &standing = r.model.parts[0].instances[1];
  BOOST_TEST(r.model[lying.attributes].name == "lying");
  BOOST_TEST(r.model[standing.attributes].name == "standing");
  // The cylinder's axis from (0, 0, 0) to (0, 0, 2).
  BOOST_TEST(distance(apply(lying.transform, Point{0, 0, 2}), Point{12, 0, 0}) < 1e-15);
  BOOST_TEST(distance(apply(standing.transform, Point{0, 0, 2}), Point{0, 20, 2}) < 1e-15);
  const auto m = measure(r.model, Limits{});
  BOOST_REQUIRE(m.has_value());
  BOOST_TEST(std::abs(m->area_mm2 - 12 * pi) < 1e-9);
}

BOOST_AUTO_TEST_CASE(a_face_across_a_seam_is_written_with_one_loop) {
  const io::ReadResult r = read("face_across_seam");
  io::WriteOptions options;
  options.format = io::Format::Step;
  const auto written = io::encode(r.model, r.source, options);
  BOOST_REQUIRE(written.has_value());
  BOOST_TEST(written->losses.empty());
  const auto count_of = [&](const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = written->bytes.find(what); at != std::string::npos; at = written->bytes.find(what, at + 1)) ++n;
    return n;
  };
  BOOST_TEST(count_of("=ADVANCED_FACE(") == 1u);
  BOOST_TEST(count_of("=EDGE_LOOP(") == 1u);
  BOOST_TEST(count_of("=FACE_OUTER_BOUND(") == 1u);
  BOOST_TEST(count_of("=EDGE_CURVE(") == 6u);  // two of the four cross the seam
  BOOST_TEST(count_of("=SEAM_CURVE(") == 0u);
  for (const io::ReadResult& in : {io::read_bytes(written->bytes, "again.stp"), read("face_across_seam")}) {
    const auto m = measure(in.model, Limits{});
    BOOST_REQUIRE(m.has_value());
    BOOST_TEST(std::abs(m->area_mm2 - 24) < 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(styles_layers_and_names_reach_the_model) {
  const io::ReadResult r = read("styles");
  BOOST_TEST(r.model.name == "Wei\xC3\x9F \xC3\xA4 \xC3\xA9 it's");
  const Body& body = r.model.parts[0].bodies.at(0);
  const Attributes &side = r.model[body.faces[0].attributes], &bottom = r.model[body.faces[1].attributes], &top = r.model[body.faces[2].attributes];
  BOOST_REQUIRE(side.colour.has_value());
  BOOST_TEST(side.colour->r == 1);
  BOOST_TEST(side.layer == 1);
  BOOST_TEST(r.model.layer_names.at(0) == "walls");
  BOOST_REQUIRE(top.colour.has_value());
  BOOST_TEST(top.colour->b == 1);
  BOOST_TEST(top.colour->r == 0);
  BOOST_TEST(!bottom.visible);
  BOOST_TEST(top.visible);
}

BOOST_AUTO_TEST_CASE(stated_volume_and_centroid_are_compared) {
  BOOST_TEST(read("validation_right").report.items().empty());
  const io::ReadResult wrong = read("validation_wrong");
  BOOST_TEST(wrong.report.count("SP-V05") == 1u);
  BOOST_TEST(wrong.report.count("SP-V07") == 1u);
}

BOOST_AUTO_TEST_CASE(a_solid_closes_without_a_face_that_encloses_nothing) {
  const io::ReadResult r = read("solid_with_empty_face");
  const auto c = count(r.model);
  const auto m = measure(r.model, Limits{});
  BOOST_REQUIRE(c.has_value());
  BOOST_REQUIRE(m.has_value());
  BOOST_TEST(c->faces == 5u);
  BOOST_TEST(c->faces_failed == 1u);
  BOOST_TEST(c->solids == 1u);
  BOOST_TEST(near(m->volume_mm3.value_or(0), 1.0 / 6));
  BOOST_TEST(r.report.count("MD-12") == 1u);
}

BOOST_AUTO_TEST_CASE(a_short_edge_that_its_curve_does_not_reach_is_a_gap_to_close) {
  const io::ReadResult r = read("edge_beyond_its_curve");
  const Body& body = r.model.parts[0].bodies.at(0);
  BOOST_TEST((body.faces.at(0).status == FaceStatus::Healed));
  BOOST_TEST(r.report.count("SP-G22") == 1u);
  BOOST_TEST(r.report.count("SQ-251") == 1u);
  BOOST_TEST(std::abs(area(body, FaceId{0}).value - 2.5e-6) < 1e-12);
}

BOOST_AUTO_TEST_CASE(doubling_forty_times_ends_in_a_limit_finding) {
  const io::ReadResult r = read("assembly_doubling");
  BOOST_TEST(r.report.count("SP-A06") > 0u);
  const auto c = count(r.model);
  BOOST_REQUIRE(c.has_value());
  BOOST_TEST(c->solids <= Limits{}.instances);
}

BOOST_AUTO_TEST_SUITE_END()
