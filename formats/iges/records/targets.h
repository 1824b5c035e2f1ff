#pragma once
// Which types a pointer of a record may reach (IG-R03), by the role that the target plays there.

#include <span>

#include "formats/iges/records/record.h"

namespace trimloop::iges {

struct Role {
  const char* name;  // "a curve"
  std::span<const int> types;
};
extern const Role any_curve, composite_member, any_surface, axis_line, point_entity, direction, subfigure;
extern const Role boundary_141, curve_142, vertex_list, edge_list, loop, face, shell;

// A finding when `ref` is not null and reaches a type that does not play the role. A null, dangling or even pointer is
// left to the two below and to the reader.
void admit(TokenReader& in, std::size_t parameter, Ref ref, const Role& role);
// As `admit`; a null pointer is a finding too (IG-R01).
void require(TokenReader& in, std::size_t parameter, Ref ref, const Role& role);

}  // namespace trimloop::iges
