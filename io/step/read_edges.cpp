// Vertices, edges and loops.

#include <fmt/format.h>

#include "formats/step/records/geometry.h"
#include "formats/step/records/topology.h"
#include "formats/step/rules.h"
#include "io/step/solids.h"

namespace trimloop::io::step_import {

namespace sr = step::rules;

namespace {

CurvePtr share(Curve c) { return std::make_shared<const Curve>(std::move(c)); }

// The part of a curve from point `a` to point `b`, along the curve. `against` is set where the curve runs from b to a.
struct Part {
  CurvePtr curve;
  bool against = false;
};

Part between(const CurvePtr& whole, Point a, Point b, bool is_loop, double tolerance) {
  const Curve& c = *whole;
  if (is_closed_by_nature(c)) {
    double lo = parameter_near(c, a), hi = is_loop ? lo : parameter_near(c, b);
    if (hi <= lo) hi += two_pi;
    const double span = std::min(hi - lo, two_pi - (hi - lo));
    // Two vertices in one place: all of it, as an edge of no length is never meant. A short edge may well be.
    const double one_place = std::min(tolerance, 1e-5 * distance(evaluate(c, lo), evaluate(c, lo + pi)));
    const bool tiny = distance(evaluate(c, lo), evaluate(c, lo + span)) <= one_place;
    if (is_loop || (tiny && distance(a, b) <= tolerance)) hi = lo + two_pi;
    return {share(with_range(c, {lo, hi}))};
  }
  const Interval r = range(c);
  if (!r.is_bounded()) {
    const double lo = parameter_near(c, a), hi = parameter_near(c, b);
    if (!(std::abs(hi - lo) > 0) || !std::isfinite(lo) || !std::isfinite(hi)) return {};
    return {share(with_range(c, {std::min(lo, hi), std::max(lo, hi)})), hi < lo};
  }
  const Point first = start_point(c), last = end_point(c);
  const bool closed = distance(first, last) <= tolerance;
  if (is_loop && closed && distance(a, first) <= 10 * tolerance) return {whole};
  const bool starts = distance(a, first) <= tolerance, ends = distance(b, last) <= tolerance;
  if (starts && ends && !is_loop) return {whole};
  double lo = starts ? r.lo : closest_point(c, a).t, hi = ends ? r.hi : closest_point(c, b).t;
  if (closed) {
    // Either end of a closed curve is the other one too; an edge may run over it.
    if (!starts && distance(a, last) <= tolerance) lo = r.lo;
    if (!ends && distance(b, first) <= tolerance) hi = r.hi;
    if (is_loop) hi = lo;
    if (hi <= lo) {
      if (lo >= r.hi || hi <= r.lo) return {whole};
      return {share(Curve{make_composite({{share(with_range(c, {lo, r.hi})), false}, {share(with_range(c, {r.lo, hi})), false}})})};
    }
  }
  if (hi < lo) {
    if (!(lo - hi > 1e-9 * r.length())) return {};
    return {share(with_range(c, {hi, lo})), true};
  }
  if (!(hi - lo > 1e-9 * r.length())) return {};
  // Ends that lie within rounding of the curve's own are the curve's own.
  if (lo - r.lo < 1e-9 * r.length()) lo = r.lo;
  if (r.hi - hi < 1e-9 * r.length()) hi = r.hi;
  if (lo == r.lo && hi == r.hi) return {whole};
  return {share(with_range(c, {lo, hi}))};
}

}  // namespace

VertexId BrepReader::point_vertex(const Record& owner, Ref ref) {
  const Record* instance = context_.resolve(owner, ref, Entity::Point);
  if (!instance) return {};
  const auto [at, fresh] = vertices_.try_emplace(context_.index(*instance));
  if (!fresh) return at->second;
  const auto p = geometry_.point(*instance);
  if (p) at->second = body_.add(Vertex{*p, 0});
  return at->second;
}

VertexId BrepReader::vertex(const Record& owner, Ref ref) {
  const Record* instance = context_.resolve(owner, ref, Entity::Vertex);
  if (!instance) return {};
  const std::size_t key = context_.index(*instance);
  if (const auto known = vertices_.find(key); known != vertices_.end()) return known->second;
  VertexId id;
  if (const auto r = context_.is(*instance, Entity::VertexPoint) ? context_.read<step::VertexPoint>(*instance) : std::nullopt) {
    if (const auto p = geometry_.point(*instance, r->point)) id = body_.add(Vertex{*p, 0});
  }
  vertices_.emplace(key, id);
  return id;
}

BrepReader::EdgeUse BrepReader::edge_use(const Record& instance) {
  const std::size_t key = context_.index(instance);
  if (const auto known = edges_.find(key); known != edges_.end()) return known->second;
  const EdgeUse made = make_edge(instance);
  edges_.emplace(key, made);
  return made;
}

EdgeId BrepReader::edge(const Record& instance) { return edge_use(instance).id; }

BrepReader::EdgeUse BrepReader::make_edge(const Record& instance) {
  EdgeUse use;
  const auto r = context_.read<step::EdgeCurve>(instance);
  if (!r) return use;
  const VertexId start = vertex(instance, r->start), end = vertex(instance, r->end);
  if (!start || !end) return use;
  const Point a = body_[start].point, b = body_[end].point;
  const double tolerance = std::max(geometry_.units().uncertainty_mm, 1e-9);
  use.curve = context_.resolve(instance, r->curve, Entity::Curve);
  const CurvePtr whole = use.curve ? geometry_.curve(*use.curve) : nullptr;
  if (!whole) return use;
  use.whole = range(*whole);
  const bool is_loop = start == end;
  Part part = r->same_sense ? between(whole, a, b, is_loop, tolerance) : between(whole, b, a, is_loop, tolerance);
  if (!part.curve) {
    if (is_loop || distance(a, b) <= tolerance) {
      context_.add(instance, sr::edge_vertices, "the edge has no length; it is passed over", distance(a, b), tolerance);
    } else {
      context_.add(instance, sr::edge_vertices, Severity::Error, "the curve has no part between the vertices", distance(a, b), tolerance);
    }
    return use;
  }
  if (part.against)
    context_.add(instance, sr::edge_vertices, "the curve runs against the sense that is stated; it is turned");
  Edge edge;
  edge.range = range(*part.curve);
  edge.curve = std::move(part.curve);
  use.flipped = r->same_sense == part.against;
  edge.start = use.flipped ? end : start;
  edge.end = use.flipped ? start : end;
  edge.source = {source_of(instance), source_of(*use.curve, 2)};
  const double at_start = distance(evaluate(*edge.curve, edge.range.lo), body_[edge.start].point);
  const double at_end = distance(evaluate(*edge.curve, edge.range.hi), body_[edge.end].point);
  const double gap = std::max(at_start, at_end);
  body_[edge.start].gap_mm = std::max(body_[edge.start].gap_mm, at_start);
  body_[edge.end].gap_mm = std::max(body_[edge.end].gap_mm, at_end);
  if (gap > tolerance) {
    Diagnostic& d = context_.add(instance, sr::edge_vertices, gap > 10 * tolerance ? Severity::Error : Severity::Warning,
                                 "the curve ends beside its vertex", gap, tolerance);
    d.at = {a.x, a.y, a.z};
  }
  use.id = body_.add(std::move(edge));
  return use;
}

std::optional<heal::TrimLoop> BrepReader::loop(const Record& owner, const Record& instance, bool along, const Record* surface,
                                               const PlacedSurface& placed) {
  Visit visit(context_, instance);
  if (!visit) return std::nullopt;
  if (context_.is(instance, Entity::PolyLoop)) return poly_loop(instance, along);
  const auto r = context_.read<step::LoopRecord>(instance);
  if (!r) return std::nullopt;
  heal::TrimLoop out;
  out.trust = heal::Trust::Model;  // the edge's curve is the truth; a supplied parameter curve is checked against it
  out.source.push_back(source_of(instance, 4));
  if (context_.is(instance, Entity::VertexLoop)) {
    const VertexId lone = r->items.empty() ? VertexId{} : vertex(instance, r->items.front());
    if (!lone) return std::nullopt;
    out.pole = body_[lone].point;
    return out;
  }
  for (std::size_t k = 0; k < r->items.size(); ++k) {
    const Ref ref = along ? r->items[k] : r->items[r->items.size() - 1 - k];
    const Record* item = context_.resolve(instance, ref, Entity::Edge);
    if (!item) return std::nullopt;
    auto s = segment(*item, along, surface, placed);
    if (!s) return std::nullopt;
    if (s->edge || s->pcurve) out.segments.push_back(std::move(*s));
  }
  if (out.segments.empty()) {
    context_.add(owner, sr::path_chain, "a loop has no usable edge");
    return std::nullopt;
  }
  return out;
}

// One oriented edge. Chains of oriented edges are legal nowhere and followed to their end.
std::optional<heal::TrimSegment> BrepReader::segment(const Record& first, bool along, const Record* surface, const PlacedSurface& placed) {
  const Record* item = &first;
  int nested = 0;
  while (context_.is(*item, Entity::OrientedEdge)) {
    const auto o = context_.read<step::Oriented>(*item);
    if (!o) return std::nullopt;
    along = along == o->orientation;
    const Record* next = context_.resolve(*item, o->element, Entity::Edge);
    if (!next) return std::nullopt;
    if (++nested == 2) context_.add(first, sr::oriented_nesting, "an oriented edge of an oriented edge");
    if (nested > 64 || next == item) {
      context_.add(first, next == item ? sr::reference_self : sr::oriented_nesting, "the oriented edge leads to no edge");
      return std::nullopt;
    }
    item = next;
  }
  if (!context_.is(*item, Entity::EdgeCurve)) {
    context_.add(*item, sr::attribute_type, "an edge without a curve cannot be used");
    return std::nullopt;
  }
  const EdgeUse use = edge_use(*item);
  heal::TrimSegment s;
  s.source.push_back(source_of(*item));
  if (!use.id) {
    // An edge of no length between two vertices in one place says nothing, and one so short that healing closes the gap
    // without it is no loss; any other one was the border.
    constexpr double short_edge = 10;  // times the uncertainty
    const auto r = context_.read<step::EdgeCurve>(*item);
    const VertexId a = r ? vertex(*item, r->start) : VertexId{}, b = r ? vertex(*item, r->end) : VertexId{};
    if (a && b && use.curve && distance(body_[a].point, body_[b].point) <= short_edge * geometry_.units().uncertainty_mm &&
        geometry_.curve(*use.curve))
      return s;
    return std::nullopt;
  }
  s.edge = use.id;
  s.curve_reversed = along == use.flipped;
  add_pcurve(use, surface, placed, s);
  return s;
}

// A supplied parameter curve saves a projection on free-form surfaces; on elementary ones the projection is exact.
void BrepReader::add_pcurve(const EdgeUse& use, const Record* surface, const PlacedSurface& placed, heal::TrimSegment& segment) {
  if (!surface || !use.curve || !context_.is(*use.curve, Entity::SurfaceCurve) || context_.is(*use.curve, Entity::SeamCurve)) return;
  if (context_.is(*surface, Entity::ElementarySurface)) return;
  const auto r = context_.read<step::SurfaceCurve>(*use.curve);
  if (!r) return;
  const Record* found = nullptr;
  for (const Ref ref : r->associated) {
    const Record* i = context_.find(ref);
    if (!i || !context_.is(*i, Entity::Pcurve)) continue;
    const auto p = context_.read<step::PcurveRecord>(*i);
    if (!p || p->surface.id != surface->id) continue;
    if (found) return;  // two on one surface: a seam by another name
    found = context_.find(p->representation);
    segment.source.push_back(source_of(*i, 3));
  }
  if (!found || !context_.is(*found, Entity::Representation)) return;
  const auto rep = context_.read<step::RepresentationRecord>(*found);
  const Record* item = rep && !rep->items.empty() ? context_.find(rep->items.front()) : nullptr;
  if (!item || !context_.is(*item, Entity::Curve)) return;
  Geometry flat(context_, geometry_.units(), true);
  CurvePtr curve = flat.curve(*item);
  if (!curve) return;
  // Both curves have one parameter; which part the edge takes is known in space.
  const Interval edge = shared_.whole(body_, segment.edge).range;
  const Interval own = range(*curve);
  const bool is_part = !own.is_bounded() || edge.lo > use.whole.lo || edge.hi < use.whole.hi;
  Curve part = *curve;
  if (is_part) {
    if (!(own.lo <= edge.lo + 1e-9 * edge.length()) || !(edge.hi <= own.hi + 1e-9 * edge.length())) return;
    part = with_range(part, edge);
  }
  if (placed.scale_u != 1 || placed.scale_v != 1) {
    Transform t;
    t.r = {{{placed.scale_u, 0, 0}, {0, placed.scale_v, 0}, {0, 0, 1}}};
    auto scaled = transformed(part, t);
    if (!scaled) return;
    part = std::move(*scaled);
  }
  if (!is_bounded(part)) return;
  segment.pcurve = Curve2{std::move(part)};
  segment.pcurve_reversed = segment.curve_reversed;
}

std::optional<heal::TrimLoop> BrepReader::poly_loop(const Record& instance, bool along) {
  const auto r = context_.read<step::LoopRecord>(instance);
  if (!r) return std::nullopt;
  heal::TrimLoop out;
  out.trust = heal::Trust::Model;
  out.source.push_back(source_of(instance, 4));
  std::vector<VertexId> corners;
  for (const Ref ref : r->items) {
    const VertexId v = point_vertex(instance, ref);
    if (!v) return std::nullopt;
    if (corners.empty() || corners.back() != v) corners.push_back(v);
  }
  if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  if (corners.size() < 3) {
    context_.add(instance, sr::aggregate_bounds, "a polygon needs three corners", static_cast<double>(corners.size()), 3);
    return std::nullopt;
  }
  if (!along) std::reverse(corners.begin(), corners.end());
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const VertexId a = corners[k], b = corners[(k + 1) % corners.size()];
    if (distance(body_[a].point, body_[b].point) == 0) continue;
    const auto key = std::minmax(a.index, b.index);
    const auto [at, fresh] = straight_.try_emplace({key.first, key.second});
    if (fresh) {
      Edge edge;
      edge.start = VertexId{key.first};
      edge.end = VertexId{key.second};
      edge.curve = share(Curve{Line{body_[edge.start].point, body_[edge.end].point}});
      edge.range = {0, 1};
      edge.source.push_back(source_of(instance));
      at->second = body_.add(std::move(edge));
    }
    heal::TrimSegment s;
    s.edge = at->second;
    s.curve_reversed = a.index != key.first;
    out.segments.push_back(std::move(s));
  }
  return out;
}

}  // namespace trimloop::io::step_import
