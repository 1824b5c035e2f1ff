#include <fmt/format.h>

#include <algorithm>

#include "formats/iges/records/checks.h"
#include "formats/iges/records/targets.h"
#include "formats/iges/rules.h"

namespace trimloop::iges {

// SolidWorks writes boundaries without curves around full spheres and tori: usable, the surface is bounded by itself.
void check(const Boundary& r, TokenReader& in) {
  if (r.boundary_type < 0 || r.boundary_type > 1)
    in.remark_at(1, rules::e141::flags, fmt::format("type {}, it is 0 or 1", r.boundary_type), r.boundary_type, 1);
  if (r.preference < 0 || r.preference > 3)
    in.remark_at(2, rules::e141::flags, fmt::format("preference {}, it is 0 to 3", r.preference), r.preference, 3);
  require(in, 3, r.surface, any_surface);
  if (r.items.empty()) in.remark_at(4, rules::count_negative, "a boundary without curves", 0, 1);
  std::size_t parameter = 5;
  for (const Boundary::Item& item : r.items) {
    require(in, parameter, item.curve, any_curve);
    if (item.sense != 1 && item.sense != 2)
      in.fault_at(parameter + 1, rules::e141::flags, fmt::format("sense {}, it is 1 or 2", item.sense), item.sense, 2);
    if (r.boundary_type == 0 && !item.pcurves.empty())
      in.remark_at(parameter + 2, rules::e141::pcurve_rule,
                   fmt::format("{} parameter curves in a boundary of type 0", item.pcurves.size()));
    if (r.boundary_type == 1 && item.pcurves.empty())
      in.remark_at(parameter + 2, rules::e141::pcurve_rule, "no parameter curve in a boundary of type 1");
    for (std::size_t i = 0; i < item.pcurves.size(); ++i) {
      if (!item.pcurves[i]) in.remark_at(parameter + 3 + i, rules::e141::pcurve_rule, "a parameter curve that is counted and not named");
      admit(in, parameter + 3 + i, item.pcurves[i], any_curve);
    }
    parameter += 3 + item.pcurves.size();
  }
}

void check(const CurveOnSurface& r, TokenReader& in) {
  if (r.creation < 0 || r.creation > 3)
    in.remark_at(1, rules::e142::flags, fmt::format("creation flag {}, it is 0 to 3", r.creation), r.creation, 3);
  if (r.preference < 0 || r.preference > 3)
    in.remark_at(5, rules::e142::flags, fmt::format("preference flag {}, it is 0 to 3", r.preference), r.preference, 3);
  if (!r.pcurve && !r.curve)
    in.fault_at(3, rules::e142::both_null, "neither a curve in parameter space nor one in model space");
  require(in, 2, r.surface, any_surface);
  admit(in, 3, r.pcurve, any_curve);
  admit(in, 4, r.curve, any_curve);
  constexpr int parameter_space = 5;
  const DirectoryEntry* pcurve = in.target(r.pcurve);
  if (pcurve && pcurve->status.use != parameter_space)
    in.remark_at(3, rules::e142::use_flag,
                 fmt::format("D{} has use flag {:02}, not 05", pcurve->de, pcurve->status.use), pcurve->status.use,
                 parameter_space);
}

void check(const BoundedSurface& r, TokenReader& in) {
  if (r.representation < 0 || r.representation > 1)
    in.remark_at(1, rules::e143::type, fmt::format("type {}, it is 0 or 1", r.representation), r.representation, 1);
  require(in, 2, r.surface, any_surface);
  if (r.boundaries.empty()) in.fault_at(3, rules::e143::type, "a bounded surface without boundaries", 0, 1);
  for (std::size_t i = 0; i < r.boundaries.size(); ++i) require(in, 4 + i, r.boundaries[i], boundary_141);
}

void check(const TrimmedSurface& r, TokenReader& in) {
  require(in, 1, r.surface, any_surface);
  if (r.outer_given && !r.outer)
    in.remark_at(4, rules::e144::flags, "N1 is 1, but there is no outer boundary; the surface's own border is taken");
  if (!r.outer_given && r.outer)
    in.remark_at(2, rules::e144::flags, fmt::format("N1 is 0, but the outer boundary D{} is given", r.outer.de));
  admit(in, 4, r.outer, curve_142);
  for (std::size_t i = 0; i < r.inner.size(); ++i) require(in, 5 + i, r.inner[i], curve_142);
}

namespace {

void check_closed_shell(TokenReader& in, std::size_t parameter, Ref ref) {
  require(in, parameter, ref, shell);
  const DirectoryEntry* target = in.target(ref);
  if (target && target->type == ShellRecord::type && target->form != 1)
    in.remark_at(parameter, rules::e186::outer_shell,
                 fmt::format("D{} is an open shell (form {})", target->de, target->form), target->form, 1);
}

}  // namespace

void check(const ManifoldSolid& r, TokenReader& in) {
  check_closed_shell(in, 1, r.shell);
  for (std::size_t i = 0; i < r.voids.size(); ++i) {
    check_closed_shell(in, 4 + 2 * i, r.voids[i].shell);
    if (r.voids[i].shell && r.voids[i].shell == r.shell)
      in.remark_at(4 + 2 * i, rules::e186::void_shell, fmt::format("D{} is the outer shell and a void", r.shell.de));
  }
}

void check(const VertexList& r, TokenReader& in) {
  if (r.points.empty()) in.fault_at(1, rules::e502::vertex_list, "a vertex list without vertices", 0, 1);
}

void check(const EdgeList& r, TokenReader& in) {
  if (r.edges.empty()) in.fault_at(1, rules::e504::indices, "an edge list without edges", 0, 1);
  const auto check_index = [&](std::size_t parameter, std::int64_t index) {
    if (index < 1)
      in.remark_at(parameter, rules::e504::indices, fmt::format("vertex {}, they are counted from 1", index),
                   static_cast<double>(index), 1);
  };
  std::size_t parameter = 2;
  for (const EdgeList::Item& edge : r.edges) {
    admit(in, parameter, edge.curve, any_curve);
    require(in, parameter + 1, edge.start_list, vertex_list);
    check_index(parameter + 2, edge.start_index);
    require(in, parameter + 3, edge.end_list, vertex_list);
    check_index(parameter + 4, edge.end_index);
    parameter += 5;
  }
}

namespace {

// An edge bounds a face once, or twice as a seam.
void check_repeated_edges(const LoopRecord& r, TokenReader& in) {
  constexpr std::size_t most = 2;
  if (r.items.size() <= most) return;
  std::vector<std::pair<std::int32_t, std::int64_t>> edges;
  for (const LoopRecord::Item& item : r.items)
    if (!item.is_vertex) edges.emplace_back(item.list.de, item.index);
  std::sort(edges.begin(), edges.end());
  for (auto first = edges.begin(); first != edges.end();) {
    const auto last = std::find_if(first, edges.end(), [&](const auto& e) { return e != *first; });
    const auto uses = static_cast<std::size_t>(last - first);
    if (uses > most) {
      in.fault_at(1, rules::e508::head_to_tail, fmt::format("edge {} of D{} stands {} times in one loop", first->second, first->first, uses),
                  static_cast<double>(uses), static_cast<double>(most));
      return;
    }
    first = last;
  }
}

}  // namespace

void check(const LoopRecord& r, TokenReader& in) {
  check_repeated_edges(r, in);
  if (r.items.empty()) in.fault_at(1, rules::e508::use, "a loop without edges", 0, 1);
  std::size_t parameter = 2;
  for (const LoopRecord::Item& item : r.items) {
    require(in, parameter + 1, item.list, item.is_vertex ? vertex_list : edge_list);
    if (item.index < 1)
      in.remark_at(parameter + 2, rules::e508::use,
                   fmt::format("{} {}, they are counted from 1", item.is_vertex ? "vertex" : "edge", item.index),
                   static_cast<double>(item.index), 1);
    for (std::size_t i = 0; i < item.pcurves.size(); ++i)
      require(in, parameter + 6 + 2 * i, item.pcurves[i].curve, any_curve);
    parameter += 5 + 2 * item.pcurves.size();
  }
}

namespace {

// A pointer that stands in the list more than once, or none.
Ref listed_twice(std::vector<Ref> refs) {
  std::sort(refs.begin(), refs.end(), [](Ref a, Ref b) { return a.de < b.de; });
  const auto twin = std::adjacent_find(refs.begin(), refs.end());
  return twin == refs.end() ? Ref{} : *twin;
}

}  // namespace

// A face without loops is what some senders make of a whole sphere or torus: usable.
void check(const FaceRecord& r, TokenReader& in) {
  require(in, 1, r.surface, any_surface);
  if (r.loops.empty()) in.remark_at(2, rules::e510::face, "a face without loops", 0, 1);
  for (std::size_t i = 0; i < r.loops.size(); ++i) require(in, 4 + i, r.loops[i], loop);
  if (const Ref twin = listed_twice(r.loops))
    in.remark_at(4, rules::e510::face, fmt::format("the loop D{} is listed twice", twin.de));
}

void check(const ShellRecord& r, TokenReader& in) {
  if (r.faces.empty()) in.fault_at(1, rules::e514::shell, "a shell without faces", 0, 1);
  std::vector<Ref> faces;
  for (const ShellRecord::Item& item : r.faces) faces.push_back(item.face);
  for (std::size_t i = 0; i < faces.size(); ++i) require(in, 2 + 2 * i, faces[i], face);
  if (const Ref twin = listed_twice(faces))
    in.remark_at(2, rules::e514::shell, fmt::format("the face D{} is listed twice", twin.de));
}

}  // namespace trimloop::iges
