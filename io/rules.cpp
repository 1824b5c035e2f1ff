#include "io/rules.h"

namespace trimloop::io::rules {

std::span<const Rule* const> all() {
  static constexpr const Rule* table[] = {
      &erroneous_curve, &erroneous_surface, &inconsistent_face_normal, &intersecting_loops, &misplaced_loop,
      &gap_in_loop,     &gap_edge_surface,  &gap_inside,               &non_finite,         &seam,
      &pole,            &shared_face,       &empty_model,              &nothing_visible,    &unsupported,
      &ignored,         &depth,             &work,                     &expansion,          &cancelled,
      &healed_face,     &approximated,      &free_edge,                &sew_report};
  return table;
}

}  // namespace trimloop::io::rules
