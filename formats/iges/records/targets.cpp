#include "formats/iges/records/targets.h"

#include <fmt/format.h>

#include <algorithm>

#include "formats/iges/names.h"
#include "formats/iges/rules.h"

namespace trimloop::iges {
namespace {

constexpr int curve_types[] = {100, 102, 104, 106, 110, 112, 126, 130};
constexpr int member_types[] = {100, 104, 106, 110, 112, 116, 126, 130, 132};
constexpr int surface_types[] = {108, 114, 118, 120, 122, 128, 140, 143, 144, 190, 192, 194, 196, 198};
constexpr int line_types[] = {110};
constexpr int point_types[] = {116};
constexpr int direction_types[] = {123};
constexpr int subfigure_types[] = {308, 416};
constexpr int boundary_types[] = {141};
constexpr int curve_on_surface_types[] = {142};
constexpr int vertex_list_types[] = {502};
constexpr int edge_list_types[] = {504};
constexpr int loop_types[] = {508};
constexpr int face_types[] = {510};
constexpr int shell_types[] = {514};

}  // namespace

const Role any_curve{"a curve", curve_types};
const Role composite_member{"a curve or point that is no composite", member_types};
const Role any_surface{"a surface", surface_types};
const Role axis_line{"a line (110)", line_types};
const Role point_entity{"a point (116)", point_types};
const Role direction{"a direction (123)", direction_types};
const Role subfigure{"a subfigure definition (308, or 416 for one in another file)", subfigure_types};
const Role boundary_141{"a boundary (141)", boundary_types};
const Role curve_142{"a curve on a surface (142)", curve_on_surface_types};
const Role vertex_list{"a vertex list (502)", vertex_list_types};
const Role edge_list{"an edge list (504)", edge_list_types};
const Role loop{"a loop (508)", loop_types};
const Role face{"a face (510)", face_types};
const Role shell{"a shell (514)", shell_types};

void admit(TokenReader& in, std::size_t parameter, Ref ref, const Role& role) {
  const DirectoryEntry* target = in.target(ref);
  if (!target || std::find(role.types.begin(), role.types.end(), target->type) != role.types.end()) return;
  in.remark_at(parameter, rules::target_type,
               fmt::format("D{} is of type {} ({}) where {} is expected", target->de, target->type,
                           entity_name(target->type), role.name));
}

void require(TokenReader& in, std::size_t parameter, Ref ref, const Role& role) {
  if (!ref) in.remark_at(parameter, rules::dangling, fmt::format("no pointer where {} is needed", role.name));
  admit(in, parameter, ref, role);
}

}  // namespace trimloop::iges
