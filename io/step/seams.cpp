#include "io/step/seams.h"

#include <unordered_map>

namespace trimloop::io::step_import {
namespace {

const Frame* frame_of(const Surface& s) {
  if (const auto* c = std::get_if<Cylinder>(&s.shape)) return &c->frame;
  if (const auto* c = std::get_if<Cone>(&s.shape)) return &c->frame;
  if (const auto* c = std::get_if<Sphere>(&s.shape)) return &c->frame;
  if (const auto* c = std::get_if<Torus>(&s.shape)) return &c->frame;
  return nullptr;
}

Uv across(const Frame& f, Point p) { return {dot(p - f.origin, f.x), dot(p - f.origin, f.y)}; }

// Turns of a loop about an axis, by samples.
bool goes_round(const Body& body, const heal::TrimLoop& loop, const Frame& f) {
  double sum = 0;
  for (const heal::TrimSegment& s : loop.segments) {
    if (!s.edge || !body[s.edge].curve) continue;
    const Edge& e = body[s.edge];
    double before = 0;
    for (int k = 0; k <= 8; ++k) {
      const Uv q = across(f, evaluate(*e.curve, e.range.at(s.curve_reversed ? 1 - k / 8.0 : k / 8.0)));
      const double angle = std::atan2(q.v, q.u);
      if (k > 0) sum += std::remainder(angle - before, two_pi);
      before = angle;
    }
  }
  return std::abs(sum) > 0.5 * two_pi;
}

struct Cut {
  EdgeId edge;
  double t;
};

// Where the edge goes through the half plane u = 0, away from its own ends.
std::optional<double> crossing(const Edge& e, const Frame& f) {
  constexpr int samples = 16;
  for (int k = 0; k < samples; ++k) {
    double a = e.range.at(k / double(samples)), b = e.range.at((k + 1) / double(samples));
    Uv qa = across(f, evaluate(*e.curve, a)), qb = across(f, evaluate(*e.curve, b));
    if (!(qa.u > 0) || !(qb.u > 0) || (qa.v > 0) == (qb.v > 0)) continue;
    for (int i = 0; i < 100 && a < b; ++i) {
      const double middle = 0.5 * (a + b);
      if (middle <= a || middle >= b) break;
      const Uv q = across(f, evaluate(*e.curve, middle));
      ((q.v > 0) == (qa.v > 0) ? a : b) = middle;
    }
    const double margin = 1e-6 * e.range.length();
    if (a - e.range.lo > margin && e.range.hi - a > margin) return a;
  }
  return std::nullopt;
}

}  // namespace

SurfacePtr seam_at_vertex(const SurfacePtr& surface, const Body& body, const std::vector<heal::TrimLoop>& loops) {
  const Frame* f = frame_of(*surface);
  if (!f) return surface;
  for (const heal::TrimLoop& l : loops) {
    if (l.segments.empty() || !l.segments.front().edge || !goes_round(body, l, *f)) continue;
    const heal::TrimSegment& s = l.segments.front();
    const Edge& e = body[s.edge];
    const Vector d = body[s.curve_reversed ? e.end : e.start].point - f->origin;
    const Vector x = d - dot(d, f->z) * f->z;
    if (!(norm(x) > 0) || norm(normalized(x) - f->x) < 1e-9) return surface;
    Surface turned = *surface;
    const Frame at_vertex = make_frame(f->origin, f->z, x);
    if (auto* c = std::get_if<Cylinder>(&turned.shape)) c->frame = at_vertex;
    if (auto* c = std::get_if<Cone>(&turned.shape)) c->frame = at_vertex;
    if (auto* c = std::get_if<Sphere>(&turned.shape)) c->frame = at_vertex;
    if (auto* c = std::get_if<Torus>(&turned.shape)) c->frame = at_vertex;
    return std::make_shared<const Surface>(std::move(turned));
  }
  return surface;
}

void split_at_seams(Body& body, std::vector<heal::FaceInput*>& faces) {
  // 1. Where the loops of faces that go round cross u = 0 inside an edge.
  std::vector<Cut> cuts;
  for (const heal::FaceInput* face : faces) {
    const Frame* f = face->surface ? frame_of(*face->surface) : nullptr;
    if (!f) continue;
    // A hole over the seam is cut too.
    const bool has_seam = std::any_of(face->loops.begin(), face->loops.end(),
                                      [&](const heal::TrimLoop& l) { return goes_round(body, l, *f); });
    if (!has_seam) continue;
    for (const heal::TrimLoop& l : face->loops) {
      for (const heal::TrimSegment& s : l.segments) {
        if (!s.edge || !body[s.edge].curve) continue;
        if (const auto t = crossing(body[s.edge], *f)) cuts.push_back({s.edge, *t});
      }
    }
  }
  if (cuts.empty()) return;
  // 2. The edges in pieces, each piece once.
  std::unordered_map<std::uint32_t, std::vector<EdgeId>> pieces;
  for (const Cut& cut : cuts) {
    auto& parts = pieces.try_emplace(cut.edge.index, std::vector<EdgeId>{cut.edge}).first->second;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const Edge whole = body[parts[k]];
      const double margin = 1e-6 * whole.range.length();
      if (!(cut.t > whole.range.lo + margin) || !(cut.t < whole.range.hi - margin)) continue;
      const VertexId middle = body.add(Vertex{evaluate(*whole.curve, cut.t), 0});
      Edge second = whole;
      second.range = {cut.t, whole.range.hi};
      second.curve = std::make_shared<const Curve>(with_range(*whole.curve, second.range));
      second.start = middle;
      Edge& first = body[parts[k]];
      first.range = {whole.range.lo, cut.t};
      first.curve = std::make_shared<const Curve>(with_range(*whole.curve, first.range));
      first.end = middle;
      parts.insert(parts.begin() + static_cast<std::ptrdiff_t>(k) + 1, body.add(std::move(second)));
      break;
    }
  }
  // 3. Every use of such an edge goes over its pieces.
  for (heal::FaceInput* face : faces) {
    for (heal::TrimLoop& l : face->loops) {
      std::vector<heal::TrimSegment> segments;
      for (heal::TrimSegment& s : l.segments) {
        const auto at = s.edge ? pieces.find(s.edge.index) : pieces.end();
        if (at == pieces.end() || at->second.size() < 2) {
          segments.push_back(std::move(s));
          continue;
        }
        for (std::size_t k = 0; k < at->second.size(); ++k) {
          heal::TrimSegment part = s;
          part.pcurve.reset();
          part.edge = at->second[s.curve_reversed ? at->second.size() - 1 - k : k];
          segments.push_back(std::move(part));
        }
      }
      l.segments = std::move(segments);
    }
  }
}

}  // namespace trimloop::io::step_import
