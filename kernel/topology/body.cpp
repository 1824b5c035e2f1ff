#include "kernel/topology/body.h"

#include <algorithm>

namespace trimloop {
namespace {

template <class Id, class T>
Id append(std::vector<T>& items, T item) {
  items.push_back(std::move(item));
  return Id{static_cast<std::uint32_t>(items.size() - 1)};
}

// Value at `x` of the piecewise linear map through `knots`, whose .*from is strictly monotone (either way).
double interpolate(const std::vector<Uv>& knots, double Uv::*from, double Uv::*to, double x) {
  const bool rising = knots.front().*from < knots.back().*from;
  const auto after = std::upper_bound(knots.begin() + 1, knots.end() - 1, x, [&](double value, const Uv& knot) {
    return rising ? value < knot.*from : value > knot.*from;
  });
  const Uv a = *(after - 1), b = *after;
  if (x == a.*from) return a.*to;
  if (x == b.*from) return b.*to;
  return a.*to + (x - a.*from) / (b.*from - a.*from) * (b.*to - a.*to);
}

double affine(Interval from, Interval to, double x) {
  if (x == from.lo) return to.lo;
  if (x == from.hi) return to.hi;
  return to.lo + (x - from.lo) / from.length() * to.length();
}

}  // namespace

VertexId Body::add(Vertex v) { return append<VertexId>(vertices, std::move(v)); }
EdgeId Body::add(Edge e) { return append<EdgeId>(edges, std::move(e)); }
LoopId Body::add(Loop l) { return append<LoopId>(loops, std::move(l)); }
FaceId Body::add(Face f) { return append<FaceId>(faces, std::move(f)); }
ShellId Body::add(Shell s) { return append<ShellId>(shells, std::move(s)); }

double pcurve_parameter(const Coedge& coedge, const Edge& edge, double t) {
  if (coedge.map.size() >= 2) return interpolate(coedge.map, &Uv::u, &Uv::v, t);
  return affine(edge.range, coedge.pcurve_range, t);
}

double edge_parameter(const Coedge& coedge, const Edge& edge, double s) {
  if (coedge.map.size() >= 2) return interpolate(coedge.map, &Uv::v, &Uv::u, s);
  return affine(coedge.pcurve_range, edge.range, s);
}

Uv uv_at(const Body& body, const Coedge& coedge, double t) {
  return evaluate(coedge.pcurve, pcurve_parameter(coedge, body[coedge.edge], t));
}

Uv start_uv(const Body&, const Coedge& c) {
  return evaluate(c.pcurve, c.reversed ? c.pcurve_range.hi : c.pcurve_range.lo);
}

Uv end_uv(const Body&, const Coedge& c) {
  return evaluate(c.pcurve, c.reversed ? c.pcurve_range.lo : c.pcurve_range.hi);
}

VertexId start_vertex(const Body& body, const Coedge& c) {
  return c.reversed ? body[c.edge].end : body[c.edge].start;
}

VertexId end_vertex(const Body& body, const Coedge& c) {
  return c.reversed ? body[c.edge].start : body[c.edge].end;
}

Point point_at(const Body& body, const Face& face, const Coedge& coedge, double t) {
  const Edge& edge = body[coedge.edge];
  if (edge.is_pole) return body[edge.start].point;
  if (edge.curve) return evaluate(*edge.curve, t);
  return evaluate(*face.surface, uv_at(body, coedge, t));
}

}  // namespace trimloop
