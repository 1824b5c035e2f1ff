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

// The angle about the axis of a surface, or about the circle in the middle of a torus, in which a loop may go round.
struct Turn {
  Frame frame;
  double major_radius = 0;  // > 0: about that circle
  double at(Point p) const {
    const Vector d = p - frame.origin;
    const double x = dot(d, frame.x), y = dot(d, frame.y);
    return major_radius > 0 ? std::atan2(dot(d, frame.z), std::hypot(x, y) - major_radius) : std::atan2(y, x);
  }
};

std::vector<Turn> turns_of(const Surface& s) {
  std::vector<Turn> out;
  if (const Frame* f = frame_of(s)) out.push_back({*f, 0});
  if (const auto* t = std::get_if<Torus>(&s.shape)) out.push_back({t->frame, t->major_radius});
  return out;
}

// Range of the angle along a loop, by samples, from that of its first point on without jumps.
struct Sweep {
  double lo = 0, hi = 0, total = 0;
  bool goes_round() const { return std::abs(total) > 0.5 * two_pi; }
  bool crosses(double angle) const { return std::floor((lo - angle) / two_pi) != std::floor((hi - angle) / two_pi); }
};

Sweep sweep_of(const Body& body, const heal::TrimLoop& loop, const Turn& turn) {
  constexpr int samples = 16;
  Sweep s;
  double unwrapped = 0;
  bool first = true;
  for (const heal::TrimSegment& segment : loop.segments) {
    if (!segment.edge || !body[segment.edge].curve) continue;
    const Edge& e = body[segment.edge];
    for (int k = 0; k <= samples; ++k) {
      const double angle = turn.at(evaluate(*e.curve, e.range.at(segment.curve_reversed ? 1 - k / double(samples) : k / double(samples))));
      const double step = first ? 0 : std::remainder(angle - unwrapped, two_pi);
      if (first) unwrapped = s.lo = s.hi = angle, first = false;
      unwrapped += step;
      s.total += step;
      s.lo = std::min(s.lo, unwrapped);
      s.hi = std::max(s.hi, unwrapped);
    }
  }
  return s;
}

double start_angle(const Body& body, const heal::TrimSegment& s, const Turn& turn) {
  const Edge& e = body[s.edge];
  return turn.at(body[s.curve_reversed ? e.end : e.start].point);
}

// The angle of a vertex of the loops that go round: one that as few other loops as can be go over, and that as many
// loops as can be have a vertex at. Healing chooses by the same rule, so that it finds its seam prepared.
std::optional<double> seam_angle(const Body& body, const std::vector<heal::TrimLoop>& loops, const Turn& turn) {
  constexpr double same_angle = 1e-9;
  constexpr std::size_t most = 64;
  std::vector<Sweep> holes;
  std::vector<std::vector<double>> round;
  for (const heal::TrimLoop& l : loops) {
    const Sweep sweep = sweep_of(body, l, turn);
    if (!sweep.goes_round()) {
      holes.push_back(sweep);
      continue;
    }
    round.emplace_back();
    for (const heal::TrimSegment& s : l.segments)
      if (s.edge && round.back().size() < most) round.back().push_back(start_angle(body, s, turn));
  }
  std::optional<double> best;
  std::size_t least = SIZE_MAX;
  for (const auto& candidates : round) {
    for (const double c : candidates) {
      std::size_t cost = 0;
      for (const Sweep& hole : holes) cost += 1000 * hole.crosses(c);
      for (const auto& angles : round)
        cost += std::none_of(angles.begin(), angles.end(), [&](double a) { return std::abs(std::remainder(a - c, two_pi)) < same_angle; });
      if (cost < least) least = cost, best = c;
    }
  }
  return best;
}

struct Cut {
  EdgeId edge;
  double t;
};

// Where the edge goes over the angle, away from its own ends.
std::optional<double> crossing(const Edge& e, const Turn& turn, double angle) {
  constexpr int samples = 16;
  const auto off = [&](double t) { return std::remainder(turn.at(evaluate(*e.curve, t)) - angle, two_pi); };
  for (int k = 0; k < samples; ++k) {
    double a = e.range.at(k / double(samples)), b = e.range.at((k + 1) / double(samples));
    const double before = off(a), after = off(b);
    constexpr double quarter = 0.25 * two_pi;
    if (std::abs(before) > quarter || std::abs(after) > quarter || (before > 0) == (after > 0)) continue;
    for (int i = 0; i < 100 && a < b; ++i) {
      const double middle = 0.5 * (a + b);
      if (middle <= a || middle >= b) break;
      ((off(middle) > 0) == (before > 0) ? a : b) = middle;
    }
    const double margin = 1e-6 * e.range.length();
    if (a - e.range.lo > margin && e.range.hi - a > margin) return a;
  }
  return std::nullopt;
}

}  // namespace

SurfacePtr seam_at_vertex(const SurfacePtr& surface, const Body& body, const std::vector<heal::TrimLoop>& loops) {
  const Frame* f = frame_of(*surface);
  const auto angle = f ? seam_angle(body, loops, {*f, 0}) : std::nullopt;
  if (!angle || std::abs(*angle) < 1e-9) return surface;
  Surface turned = *surface;
  const Frame at_vertex = make_frame(f->origin, f->z, std::cos(*angle) * f->x + std::sin(*angle) * f->y);
  if (auto* c = std::get_if<Cylinder>(&turned.shape)) c->frame = at_vertex;
  if (auto* c = std::get_if<Cone>(&turned.shape)) c->frame = at_vertex;
  if (auto* c = std::get_if<Sphere>(&turned.shape)) c->frame = at_vertex;
  if (auto* c = std::get_if<Torus>(&turned.shape)) c->frame = at_vertex;
  return std::make_shared<const Surface>(std::move(turned));
}

void split_at_seams(Body& body, std::vector<heal::FaceInput*>& faces) {
  // 1. Where the loops of faces that go round cross the seam inside an edge.
  std::vector<Cut> cuts;
  for (const heal::FaceInput* face : faces) {
    for (const Turn& turn : face->surface ? turns_of(*face->surface) : std::vector<Turn>{}) {
      const auto angle = seam_angle(body, face->loops, turn);
      if (!angle) continue;
      for (const heal::TrimLoop& l : face->loops) {  // a hole over the seam is cut too
        for (const heal::TrimSegment& s : l.segments) {
          if (!s.edge || !body[s.edge].curve) continue;
          if (const auto t = crossing(body[s.edge], turn, *angle)) cuts.push_back({s.edge, *t});
        }
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
