#include "kernel/topology/transform_body.h"

#include <map>

namespace trimloop {

namespace {

// A face's new parameters, and whether they run round the other way.
struct Chart {
  Transform map;
  bool turned = false;
};

Chart chart_of(const Surface& surface, const Transform& t) {
  const UvMap m = parameter_map(surface, t);
  Chart chart;
  chart.map.r = {{{m.uu, m.uv, 0}, {m.vu, m.vv, 0}, {0, 0, 1}}};
  chart.map.t = {m.u0, m.v0, 0};
  chart.turned = m.uu * m.vv - m.uv * m.vu < 0;
  return chart;
}

// Affine in the plane keeps parameters of lines and splines; conics may get another range, which `range` follows.
Result<void> move_pcurve(Body& body, Coedge& c, const Transform& map) {
  if (is_identity(map)) return {};
  const Interval before = range(c.pcurve);
  auto moved = transformed(c.pcurve.curve, map);
  if (!moved) return tl::unexpected(moved.error());
  const Interval after = range(*moved);
  if (after.lo != before.lo || after.hi != before.hi) {
    const double shift = after.lo - before.lo;
    c.pcurve_range = {c.pcurve_range.lo + shift, c.pcurve_range.hi + shift};
    for (Uv& p : c.map) p.v += shift;
    Edge& edge = body[c.edge];
    if (!edge.curve) edge.range = {edge.range.lo + shift, edge.range.hi + shift};
  }
  c.pcurve.curve = std::move(*moved);
  return {};
}

void turn(Loop& loop) {
  std::reverse(loop.coedges.begin(), loop.coedges.end());
  for (Coedge& c : loop.coedges) c.reversed = !c.reversed;
}

}  // namespace

Result<Body> transformed(const Body& body, const Transform& t) {
  if (deviation_from_similarity(t) > 1e-9) return fail(ErrorCode::Unsupported, "a body can be scaled evenly only");
  const double scale = std::abs(scale_factor(t));
  const bool mirror = determinant(t) < 0;
  Body out = body;
  for (Vertex& v : out.vertices) {
    v.point = apply(t, v.point);
    v.gap_mm *= scale;
  }
  std::map<const Curve*, CurvePtr> curves;  // shared before, shared after
  for (Edge& e : out.edges) {  // a similarity keeps their parameters
    if (!e.curve) continue;
    CurvePtr& moved = curves[e.curve.get()];
    if (!moved) {
      auto made = transformed(*e.curve, t);
      if (!made) return tl::unexpected(made.error());
      moved = std::make_shared<const Curve>(std::move(*made));
    }
    e.curve = moved;
  }
  std::map<const Surface*, SurfacePtr> surfaces;
  for (Face& f : out.faces) {
    if (!f.surface) continue;
    const Chart chart = chart_of(*f.surface, t);
    for (const LoopId id : f.loops) {
      for (Coedge& c : out[id].coedges) {
        c.gap_mm *= scale;
        if (auto done = move_pcurve(out, c, chart.map); !done) return tl::unexpected(done.error());
      }
      if (chart.turned) turn(out[id]);
    }
    // Su x Sv of the moved surface is that of the old one, mirrored with the parameters and with space.
    if (chart.turned != mirror) f.reversed = !f.reversed;
    SurfacePtr& moved = surfaces[f.surface.get()];
    if (!moved) {
      auto made = transformed(*f.surface, t);
      if (!made) return tl::unexpected(made.error());
      moved = std::make_shared<const Surface>(std::move(*made));
    }
    f.surface = moved;
    if (f.area_before_mm2 > 0) f.area_before_mm2 *= scale * scale;
  }
  return out;
}

}  // namespace trimloop
