#include "kernel/boolean/boolean.h"
#include "kernel/boolean/prepare.h"
#include "kernel/boolean/standing.h"
#include "kernel/closest/closest.h"

namespace trimloop {
namespace {

using namespace boolean;

// The side of an open tool: at a cut, the side on which a piece leaves it; elsewhere that of the nearest face.
class OpenTool {
 public:
  explicit OpenTool(const Prepared& given) : given_(given), tool_(*given.operands[1]) {
    for (const FaceOf& f : tool_.faces())
      if (auto c = ClosestOnFace::make(tool_.body(), f.id)) closest_.push_back({&f, std::move(*c)});
    for (std::uint32_t f = 0; f < tool_.faces().size(); ++f) {
      const FaceNet& net = given.network.faces[1][f];
      for (const std::vector<Use>* uses : {&net.inner, &net.border})
        for (const Use& use : *uses)
          if (use.segment != none && given.network.segments[use.segment].meets) cuts_.emplace(use.segment, std::pair{f, &use});
    }
  }

  std::optional<Side> nearest(Point p) const {
    double nearest = infinity, across = 0;
    for (const auto& [face, closest] : closest_) {
      const ClosestPoint c = closest.nearest(p);
      if (!(c.distance < nearest)) continue;
      nearest = c.distance;
      across = dot(outward(*face, c.uv), p - c.point);
    }
    if (!(nearest > tool_.tolerance()) || !(std::abs(across) > clear * nearest)) return std::nullopt;
    return across < 0 ? Side::Inside : Side::Outside;
  }

  // By the longest cut along its border.
  std::optional<Side> from_border(std::uint32_t f, std::uint32_t p) const {
    const FaceOf& face = given_.operands[0]->faces()[f];
    const FacePieces& of = given_.faces[0][f];
    std::optional<Side> out;
    double longest = 0;
    for (const std::uint32_t cycle : of.pieces[p].cycles) {
      std::uint32_t i = cycle;
      do {
        const HalfEdge& h = of.half_edges[i];
        i = h.next;
        const auto cut = h.use.segment == none ? cuts_.end() : cuts_.find(h.use.segment);
        if (cut == cuts_.end()) continue;
        const Segment& s = given_.network.segments[h.use.segment];
        const double size = distance(evaluate(*s.curve, s.range.lo), evaluate(*s.curve, s.range.mid()));
        if (!(size > longest)) continue;
        const Vector along = jet(*s.curve, s.range.mid()).d1;
        const Vector n = normal(*face.surface, evaluate(h.use.pcurve, h.use.range.mid()));
        const Vector into = normalized(cross(n, h.use.reversed ? -along : along));
        const auto& [g, use] = cut->second;
        const double across = dot(outward(tool_.faces()[g], evaluate(use->pcurve, use->range.mid())), into);
        if (std::abs(across) < clear) continue;
        longest = size;
        out = across < 0 ? Side::Inside : Side::Outside;
      } while (i != cycle);
    }
    return out;
  }

 private:
  static constexpr double clear = 1e-6;  // sine of an angle
  static Vector outward(const FaceOf& face, Uv uv) {
    const Vector n = normal(*face.surface, uv);
    return face.reversed ? -n : n;
  }

  const Prepared& given_;
  const Operand& tool_;
  std::vector<std::pair<const FaceOf*, ClosestOnFace>> closest_;
  std::map<SegmentIndex, std::pair<std::uint32_t, const Use*>> cuts_;
};

Result<std::vector<std::vector<Standing>>> standings_of_sheet(const Prepared& prepared, const Body& tool) {
  if (check_closed(tool))
    return standings(prepared, 0, [&](Point p) { return side_of(*prepared.operands[1], p); });
  const OpenTool open(prepared);
  return standings(
      prepared, 0, [&](Point p) { return open.nearest(p); },
      [&](std::uint32_t f, std::uint32_t p) { return open.from_border(f, p); });
}

bool is_kept(TrimSide keep, Standing s) {
  return keep == TrimSide::Inside ? s == Standing::Inside : s != Standing::Inside;
}

}  // namespace

Result<BooleanResult> trim(const Body& sheet, const Body& tool, TrimSide keep, const BooleanOptions& options) {
  auto setting = prepare(sheet, tool, options);
  if (!setting) return tl::unexpected<Error>(setting.error());
  const Prepared& prepared = (*setting)->prepared;
  std::vector<KeptPiece> kept;
  Result<std::vector<std::vector<Standing>>> standing = std::vector<std::vector<Standing>>{};
  if (keep != TrimSide::Both) standing = standings_of_sheet(prepared, tool);
  if (!standing) return tl::unexpected<Error>(standing.error());
  for (std::uint32_t f = 0; f < prepared.faces[0].size(); ++f)
    for (std::uint32_t p = 0; p < prepared.faces[0][f].pieces.size(); ++p)
      if (keep == TrimSide::Both || is_kept(keep, (*standing)[f][p])) kept.push_back({0, f, p, false});
  BooleanResult out;
  out.tolerance_mm = (*setting)->a.tolerance();
  out.bound_mm = prepared.network.bound_mm;
  if (kept.empty()) return out;
  auto body = assemble(prepared, kept, keep == TrimSide::Both ? Cuts::Kept : Cuts::Dissolved);
  if (!body) return tl::unexpected<Error>(body.error());
  body->kind = BodyKind::Sheet;
  body->attributes = sheet.attributes;
  body->source = sheet.source;
  out.bodies.push_back(std::move(*body));
  return out;
}

}  // namespace trimloop
