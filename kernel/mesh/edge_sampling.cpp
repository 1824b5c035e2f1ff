#include "kernel/mesh/edge_sampling.h"

#include "kernel/mesh/distance.h"
#include "kernel/mesh/tessellate.h"

namespace trimloop::mesh {
namespace {

constexpr std::size_t max_uses = 4;      // of one edge that are looked at; more only in non-manifold bodies
constexpr double slack = 1.15;           // over the chord bound before a chord of even share is halved
constexpr int max_halvings = 12;         // of one chord
constexpr double corner_rad = 0.3;       // a break that turns by more is a corner and always a sample

// What is known of an edge at one parameter.
struct Probe {
  double t = 0;
  Point p;
  std::array<Uv, max_uses> uv;
  std::array<Vector, max_uses> normal;
};

class Sampler {
 public:
  // `curve` may be null when there is a use.
  Sampler(const Curve* curve, Interval range, const Edge* edge, std::span<const EdgeUse> uses, const SampleBounds& bounds,
          StopCheck& stop)
      : curve_(curve), range_(range), edge_(edge), bounds_(bounds), stop_(stop) {
    for (const EdgeUse& use : uses) {
      const bool flat = std::holds_alternative<Plane>(use.surface->shape);  // a chord in uv is a chord in space
      if ((flat && curve_) || use_count_ == max_uses) continue;
      uses_[use_count_++] = use;
    }
  }

  // Nothing when stopped.
  EdgeSamples run(std::size_t least_chords) {
    first_nodes();
    if (stop_.stopped()) return {};
    mark_corners();
    densities();
    if (stop_.stopped()) return {};
    std::vector<Probe> chosen = even_shares(least_chords);
    EdgeSamples result = verified(chosen);
    return stop_.stopped() ? EdgeSamples{} : result;
  }

 private:
  Probe probe(double t) const {
    Probe r;
    r.t = t;
    for (std::size_t k = 0; k < use_count_; ++k) {
      const Coedge& c = *uses_[k].coedge;
      r.uv[k] = evaluate(c.pcurve, pcurve_parameter(c, *edge_, t));
      r.normal[k] = trimloop::normal(*uses_[k].surface, r.uv[k]);
    }
    r.p = curve_ ? evaluate(*curve_, t) : evaluate(*uses_[0].surface, r.uv[0]);
    return r;
  }

  // Nodes that see every smooth piece of the curve.
  void first_nodes() {
    std::vector<double> cuts{range_.lo};
    for (const double t : curve_ ? breaks(*curve_) : pcurve_breaks())
      if (t > cuts.back() && t < range_.hi) cuts.push_back(t);
    cuts.push_back(range_.hi);
    const std::size_t pieces = cuts.size() - 1;
    const bool straight = curve_ && std::holds_alternative<Line>(curve_->shape);
    const bool polyline = curve_ && std::holds_alternative<Polyline>(curve_->shape);
    std::size_t per_piece = pieces == 1 ? 6 : pieces <= 4 ? 4 : pieces <= 16 ? 3 : 2;
    if (straight || polyline) per_piece = use_count_ == 0 || pieces > 8 ? 1 : 4;
    nodes_.push_back(probe(cuts[0]));
    is_break_.push_back(true);
    for (std::size_t i = 0; i < pieces; ++i) {
      const Interval piece{cuts[i], cuts[i + 1]};
      for (std::size_t k = 1; k <= per_piece && !stop_.spend(); ++k) {
        nodes_.push_back(probe(piece.at(static_cast<double>(k) / static_cast<double>(per_piece))));
        is_break_.push_back(k == per_piece);
      }
    }
  }

  std::vector<double> pcurve_breaks() const {
    const Coedge& c = *uses_[0].coedge;
    std::vector<double> result;
    for (const double s : breaks(c.pcurve.curve)) result.push_back(edge_parameter(c, *edge_, s));
    if (result.size() > 1 && result.front() > result.back()) std::reverse(result.begin(), result.end());
    return result;
  }

  // Turn of the chords next to node i.
  double turn_at(std::size_t i) const {
    return angle_between(nodes_[i].p - nodes_[i - 1].p, nodes_[i + 1].p - nodes_[i].p);
  }

  // A break is a corner when the turn stays as the neighbours are drawn closer.
  void mark_corners() {
    corners_.assign(1, 0);
    const double limit = std::min(corner_rad, bounds_.angle_rad);
    for (std::size_t i = 1; i + 1 < nodes_.size(); ++i) {
      if (stop_.spend()) return;
      if (!is_break_[i] || !(turn_at(i) > limit)) continue;
      const double t = nodes_[i].t;
      const Point before = probe(t - 1e-3 * (t - nodes_[i - 1].t)).p, after = probe(t + 1e-3 * (nodes_[i + 1].t - t)).p;
      if (angle_between(nodes_[i].p - before, after - nodes_[i].p) > 0.9 * limit) corners_.push_back(i);
    }
    corners_.push_back(nodes_.size() - 1);
  }

  // Chords that the bounds ask for between a and b, by what is seen at m between them.
  double chords_needed(const Probe& a, const Probe& m, const Probe& b) const {
    const double f = std::clamp((m.t - a.t) / (b.t - a.t), 0.1, 0.9);
    double sagitta = distance_to_segment(m.p, a.p, b.p) / (4 * f * (1 - f));
    double turn = 0;
    if (distance(a.p, b.p) > 0.02 * bounds_.chord_mm) turn = 2 * angle_between(m.p - a.p, b.p - m.p);
    for (std::size_t k = 0; k < use_count_; ++k) {
      sagitta = std::max(sagitta, uv_chord_distance(k, a, b));
      turn = std::max(turn, angle_between(a.normal[k], b.normal[k]));
    }
    return std::max(std::sqrt(sagitta / bounds_.chord_mm), turn / bounds_.angle_rad);
  }

  double uv_chord_distance(std::size_t k, const Probe& a, const Probe& b) const {
    const Point middle = evaluate(*uses_[k].surface, 0.5 * (a.uv[k] + b.uv[k]));
    return std::max(0.0, distance_to_segment(middle, a.p, b.p) - 2 * uses_[k].coedge->gap_mm);
  }

  // Chords per unit of parameter at each node; at corners and ends that of the neighbour inside.
  void densities() {
    density_.assign(nodes_.size(), 0);
    for (std::size_t i = 1; i + 1 < nodes_.size(); ++i) {
      if (stop_.spend()) return;
      const double needed = chords_needed(nodes_[i - 1], nodes_[i], nodes_[i + 1]);
      const double width = nodes_[i + 1].t - nodes_[i - 1].t;
      if (std::isfinite(needed)) density_[i] = std::min(needed, static_cast<double>(bounds_.max_chords)) / width;
    }
    if (nodes_.size() > 2) density_.front() = density_[1], density_.back() = density_[nodes_.size() - 2];
  }

  // Integral of the density from node i to node i + 1, seen from inside the section [lo, hi] between two corners.
  double share(std::size_t i, std::size_t lo, std::size_t hi) const {
    const bool at_lo = i == lo, at_hi = i + 1 == hi;
    const double inside = at_lo && at_hi ? (nodes_.size() == 2 ? density_[i] : 0.0)
                          : at_lo        ? density_[i + 1]
                          : at_hi        ? density_[i]
                                         : 0.5 * (density_[i] + density_[i + 1]);
    return inside * (nodes_[i + 1].t - nodes_[i].t);
  }

  std::vector<Probe> even_shares(std::size_t least_chords) const {
    std::vector<Probe> chosen{nodes_.front()};
    const std::size_t sections = corners_.size() - 1;
    const std::size_t least = (least_chords + sections - 1) / sections;
    for (std::size_t s = 0; s < sections; ++s) {
      const std::size_t lo = corners_[s], hi = corners_[s + 1];
      double total = 0;
      for (std::size_t i = lo; i < hi; ++i) total += share(i, lo, hi);
      const double most = static_cast<double>(bounds_.max_chords);
      const auto chords = std::max(least, static_cast<std::size_t>(std::ceil(std::min(total, most) * (1 - 1e-6))));
      append_even(chosen, lo, hi, total, std::max<std::size_t>(chords, 1));
      chosen.push_back(nodes_[hi]);
    }
    return chosen;
  }

  void append_even(std::vector<Probe>& chosen, std::size_t lo, std::size_t hi, double total, std::size_t chords) const {
    // A little of the plain parameter keeps sections without curvature defined.
    const double width = nodes_[hi].t - nodes_[lo].t, base = 1e-6 * std::max(total, 1.0) / width;
    const double step = (total + base * width) / static_cast<double>(chords);
    double sum = 0;
    std::size_t next = 1;
    for (std::size_t i = lo; i < hi && next < chords; ++i) {
      const double dt = nodes_[i + 1].t - nodes_[i].t, gain = share(i, lo, hi) + base * dt;
      for (; next < chords && static_cast<double>(next) * step <= sum + gain && !stop_.spend(); ++next) {
        const double t = nodes_[i].t + dt * (static_cast<double>(next) * step - sum) / gain;
        if (t > chosen.back().t && t < nodes_[hi].t) chosen.push_back(probe(t));
      }
      sum += gain;
    }
  }

  // Halves each chord that fails at a node inside it, at its middle, or by the uv chord or the normals of a face.
  EdgeSamples verified(const std::vector<Probe>& chosen) const {
    EdgeSamples result;
    const auto keep = [&](const Probe& p) {
      result.t.push_back(p.t);
      result.points.push_back(p.p);
    };
    keep(chosen.front());
    struct Pending {
      Probe end;
      int halvings;
    };
    std::vector<Pending> stack;
    for (std::size_t i = 0; i + 1 < chosen.size(); ++i) {
      Probe a = chosen[i];
      stack.push_back({chosen[i + 1], 0});
      while (!stack.empty()) {
        if (stop_.spend()) return result;
        const Pending b = stack.back();
        const double middle = 0.5 * (a.t + b.end.t);
        const bool may_halve = b.halvings < max_halvings && middle > a.t && middle < b.end.t &&
                               result.t.size() + stack.size() < bounds_.max_chords;
        const Probe m = probe(middle);
        const double off = chord_distance(a, m, b.end);
        if (may_halve && (off > slack * bounds_.chord_mm || turns_too_far(a, b.end, b.halvings))) {
          stack.back().halvings++;
          stack.push_back({m, b.halvings + 1});
          continue;
        }
        if (off > result.deviation_mm) result.deviation_mm = off;
        keep(b.end);
        a = b.end;
        stack.pop_back();
      }
    }
    return result;
  }

  double chord_distance(const Probe& a, const Probe& m, const Probe& b) const {
    double off = distance_to_segment(m.p, a.p, b.p);
    const auto first = std::upper_bound(nodes_.begin(), nodes_.end(), a.t, [](double t, const Probe& p) { return t < p.t; });
    for (auto node = first; node != nodes_.end() && node->t < b.t; ++node)
      off = std::max(off, distance_to_segment(node->p, a.p, b.p));
    for (std::size_t k = 0; k < use_count_; ++k) off = std::max(off, uv_chord_distance(k, a, b));
    return off;
  }

  bool turns_too_far(const Probe& a, const Probe& b, int halvings) const {
    if (halvings >= 4 || distance(a.p, b.p) < 0.05 * bounds_.chord_mm) return false;  // a crease stays a crease
    for (std::size_t k = 0; k < use_count_; ++k)
      if (angle_between(a.normal[k], b.normal[k]) > bounds_.angle_rad * (1 + 1e-6)) return true;
    return false;
  }

  const Curve* curve_;
  Interval range_;
  const Edge* edge_;
  SampleBounds bounds_;
  StopCheck& stop_;
  std::array<EdgeUse, max_uses> uses_{};
  std::size_t use_count_ = 0;
  std::vector<Probe> nodes_;
  std::vector<char> is_break_;
  std::vector<std::size_t> corners_;
  std::vector<double> density_;
};

// A pole fans out: one sample per turn of the direction in which the surface leaves it.
EdgeSamples sample_pole(const Body& body, const Edge& edge, std::span<const EdgeUse> uses, const SampleBounds& bounds) {
  constexpr int probes = 24;
  double turn = 0;
  if (!uses.empty()) {
    const Coedge& c = *uses[0].coedge;
    const auto leaving = [&](int i) {
      Point p;
      Vector du, dv;
      const double t = edge.range.at(static_cast<double>(i) / probes);
      jet1(*uses[0].surface, evaluate(c.pcurve, pcurve_parameter(c, edge, t)), p, du, dv);
      return dot(du, du) > dot(dv, dv) ? du : dv;
    };
    Vector last = leaving(0);
    for (int i = 1; i <= probes; ++i) {
      const Vector next = leaving(i);
      turn += angle_between(last, next);
      last = next;
    }
  }
  const int chords = std::isfinite(turn) ? std::clamp(static_cast<int>(std::ceil(turn / bounds.angle_rad)), 1, 200) : 1;
  EdgeSamples result;
  for (int i = 0; i <= chords; ++i) result.t.push_back(edge.range.at(static_cast<double>(i) / chords));
  result.points.assign(result.t.size(), body[edge.start].point);
  return result;
}

}  // namespace

EdgeSamples sample_edge(const Body& body, const Edge& edge, std::span<const EdgeUse> uses, const SampleBounds& bounds,
                        StopCheck& stop) {
  if (edge.is_pole) return sample_pole(body, edge, uses, bounds);
  EdgeSamples result;
  if (edge.curve || !uses.empty()) {
    Sampler sampler(edge.curve.get(), edge.range, &edge, uses, bounds, stop);
    result = sampler.run(edge.start == edge.end ? 3 : 1);
  }
  if (result.t.empty()) {  // nothing but its ends is known
    result.t = {edge.range.lo, edge.range.hi};
    result.points.resize(2);
  }
  result.points.front() = body[edge.start].point;
  result.points.back() = body[edge.end].point;
  return result;
}

Point edge_point(const Body& body, const Edge& edge, std::span<const EdgeUse> uses, double t) {
  if (edge.is_pole || (!edge.curve && uses.empty())) return body[edge.start].point;
  if (edge.curve) return evaluate(*edge.curve, t);
  return evaluate(*uses[0].surface, evaluate(uses[0].coedge->pcurve, pcurve_parameter(*uses[0].coedge, edge, t)));
}

std::vector<Point> sample(const Curve& curve, double deflection_mm, double angle_rad) {
  const Interval whole = range(curve);
  if (!whole.is_bounded() || !(deflection_mm > 0) || !(angle_rad > 0)) return {};
  const bool closed = distance(start_point(curve), end_point(curve)) <= 1e-9 * deflection_mm;
  StopCheck never;
  Sampler sampler(&curve, whole, nullptr, {}, {deflection_mm / slack, angle_rad, 1'000'000}, never);
  return sampler.run(closed && whole.length() > 0 ? 3 : 1).points;
}

}  // namespace trimloop::mesh
