#include "kernel/intersect/surface_chain.h"

namespace trimloop::detail {
namespace {

constexpr double outside = 1e-11;  // of the unit square: what rounding may put beside a border

bool in_domain(const Parameters& x) {
  for (const double t : x)
    if (!(t >= -outside && t <= 1 + outside)) return false;
  return true;
}
Parameters clamped(Parameters x) {
  for (double& t : x) t = std::clamp(t, 0.0, 1.0);
  return x;
}

class Tracer {
 public:
  Tracer(const Bezier& a, const Bezier& b, const SurfaceCells& cells) : a_(a), b_(b), cells_(cells) {}

  std::vector<Chain> run() {
    for (std::size_t j = 0; j < cells_.arcs.size(); ++j)
      for (const Parameters& x : places(cells_.arcs[j]))
        if (in_domain(x) && !is_known(x, cells_.arcs[j].system.ridge)) out_.push_back(trace(j, x));
    return std::move(out_);
  }

 private:
  // Points of the arc, one between any two places where it crosses a border of the patches: no stretch inside is
  // missed, however short, unless the arc turns back at the border between two of the samples.
  std::vector<Parameters> places(const SurfaceArc& arc) const {
    constexpr int samples = 8;
    std::vector<Parameters> at;
    for (int i = 0; i <= samples; ++i) {
      Parameters x = arc.middle;
      x[arc.k] = arc.range.at((i + 0.5) / (samples + 1));
      if (i == 0) x[arc.k] = arc.range.lo;
      if (i == samples) x[arc.k] = arc.range.hi;
      if (solve_on_arc(a_, b_, arc.system, arc.k, x)) at.push_back(x);
    }
    std::vector<double> stops;
    for (std::size_t i = 0; i < at.size(); ++i) {
      stops.push_back(at[i][arc.k]);
      if (i + 1 == at.size()) break;
      for (int c = 0; c < 4; ++c)
        for (const double border : {0.0, 1.0}) {
          const double p = at[i][c] - border, q = at[i + 1][c] - border;
          if (!(p * q < 0)) continue;
          Parameters x{};
          for (int d = 0; d < 4; ++d) x[d] = at[i][d] + p / (p - q) * (at[i + 1][d] - at[i][d]);
          x[c] = border;
          if (solve_on_arc(a_, b_, arc.system, c, x) && contains(arc, x)) stops.push_back(x[arc.k]);
        }
    }
    std::sort(stops.begin(), stops.end());
    std::vector<Parameters> out;
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      Parameters x = arc.middle;
      x[arc.k] = 0.5 * (stops[i] + stops[i + 1]);
      if (solve_on_arc(a_, b_, arc.system, arc.k, x)) out.push_back(x);
    }
    return out;
  }

  bool contains(const SurfaceArc& arc, const Parameters& x) const {
    for (int i = 0; i < 4; ++i) {
      const double by = 1e-12;
      if (!(arc.box[i].lo - by <= x[i] && x[i] <= arc.box[i].hi + by)) return false;
    }
    return true;
  }
  bool is_known(const Parameters& x, bool ridge) const {
    for (const Chain& c : out_) {
      if (c.tangential != ridge) continue;
      for (std::size_t i = 0; i + 1 < c.nodes.size(); ++i) {
        const SurfaceArc& arc = cells_.arcs[c.arcs[i]];
        const double p = c.nodes[i][arc.k], q = c.nodes[i + 1][arc.k];
        if (contains(arc, x) && std::min(p, q) - 1e-9 <= x[arc.k] && x[arc.k] <= std::max(p, q) + 1e-9) return true;
      }
    }
    return false;
  }

  Chain trace(std::size_t arc, const Parameters& x) {
    Chain ahead;
    ahead.tangential = cells_.arcs[arc].system.ridge;
    ahead.nodes.push_back(x);
    walk(ahead, arc, 1);
    if (ahead.closed) return ahead;
    Chain back;
    back.nodes.push_back(x);
    walk(back, arc, -1);
    std::reverse(back.nodes.begin(), back.nodes.end());
    std::reverse(back.arcs.begin(), back.arcs.end());
    back.nodes.insert(back.nodes.end(), ahead.nodes.begin() + 1, ahead.nodes.end());
    back.arcs.insert(back.arcs.end(), ahead.arcs.begin(), ahead.arcs.end());
    back.tangential = ahead.tangential;
    return back;
  }

  // Follows the arc from the chain's last node with parameter k growing (sign 1) or falling, then the next arc.
  void walk(Chain& chain, std::size_t arc, int sign) {
    const Parameters first = chain.nodes.front();
    const std::size_t most = 8 * cells_.arcs.size() + 64;
    for (std::size_t steps = 0; steps < most; ++steps) {
      const SurfaceArc& current = cells_.arcs[arc];
      const double from = chain.nodes.back()[current.k], to = sign > 0 ? current.range.hi : current.range.lo;
      // Round about, if the place it began at lies ahead on this arc.
      const double left = (first[current.k] - from) * sign;
      const bool home = steps > 0 && left > 0 && (to - first[current.k]) * sign >= 0 && contains(current, first);
      const double end = home ? first[current.k] : to;
      constexpr int parts = 3;
      for (int i = 1; i <= parts; ++i) {
        Parameters x = chain.nodes.back();
        x[current.k] = Interval{from, end}.at(double(i) / parts);
        if (home && i == parts)
          x = first;
        else if (!solve_on_arc(a_, b_, current.system, current.k, x))
          return;
        if (!in_domain(x)) {
          leave(chain, arc, x);
          return;
        }
        chain.nodes.push_back(x);
        chain.arcs.push_back(arc);
      }
      if (home) {
        chain.closed = true;
        return;
      }
      if (!next(chain, arc, sign)) {
        arrive(chain, arc);
        return;
      }
    }
  }

  // The arc that goes on farthest from the chain's end.
  bool next(const Chain& chain, std::size_t& arc, int& sign) const {
    const Parameters& x = chain.nodes.back();
    const Parameters& before = chain.nodes[chain.nodes.size() - 2];
    const SurfaceArc& current = cells_.arcs[arc];
    Parameters step{};
    Vector tangent;
    if (!arc_direction(a_, b_, current.system, x, step, tangent)) return false;
    if (dot(tangent, evaluate(a_, x[0], x[1]) - evaluate(a_, before[0], before[1])) < 0)
      for (double& s : step) s = -s;
    double farthest = 0;
    std::size_t best = arc;
    int best_sign = sign;
    for (std::size_t j = 0; j < cells_.arcs.size(); ++j) {
      const SurfaceArc& other = cells_.arcs[j];
      if (j == arc || other.system.ridge != current.system.ridge || !contains(other, x)) continue;
      const double speed = step[other.k];
      if (speed == 0) continue;
      const double left = ((speed > 0 ? other.range.hi : other.range.lo) - x[other.k]) / speed;  // millimetres
      if (left > farthest) farthest = left, best = j, best_sign = speed > 0 ? 1 : -1;
    }
    const Interval r = current.range;
    const double least = 1e-6 * r.length() / std::max(std::abs(step[current.k]), 1e-300);
    if (!(farthest > std::min(least, 1e-9)) || best == arc) return false;
    arc = best;
    sign = best_sign;
    return true;
  }

  // Ends the chain where it leaves the patches before `x`.
  void leave(Chain& chain, std::size_t arc, const Parameters& x) const {
    const SurfaceArc& current = cells_.arcs[arc];
    const Parameters from = chain.nodes.back();
    double soonest = infinity;
    Parameters best{};
    for (int i = 0; i < 4; ++i) {
      const double border = x[i] < 0 ? 0 : 1;
      if (x[i] >= -outside && x[i] <= 1 + outside) continue;
      const double f = x[i] == from[i] ? 0 : std::clamp((border - from[i]) / (x[i] - from[i]), 0.0, 1.0);
      Parameters y{};
      for (int c = 0; c < 4; ++c) y[c] = from[c] + f * (x[c] - from[c]);
      y[i] = border;
      if (!solve_on_arc(a_, b_, current.system, i, y) || !contains(current, y)) continue;
      const double along = std::abs(y[current.k] - from[current.k]);
      if (along < soonest) soonest = along, best = y;
    }
    if (soonest == infinity) {  // it leaves at too small an angle for that: halving
      double in = from[current.k], out = x[current.k];
      best = from;
      for (int i = 0; i < 60; ++i) {
        Parameters y = best;
        y[current.k] = 0.5 * (in + out);
        if (solve_on_arc(a_, b_, current.system, current.k, y) && in_domain(y))
          in = y[current.k], best = y;
        else
          out = 0.5 * (in + out);
      }
    }
    double moved = 0;
    best = clamped(best);
    for (int c = 0; c < 4; ++c) moved = std::max(moved, std::abs(best[c] - from[c]));
    if (moved < 1e-13) return;
    chain.nodes.push_back(best);
    chain.arcs.push_back(arc);
  }

  // Ends the chain on a branch point or pole near its end, if there is one.
  void arrive(Chain& chain, std::size_t arc) const {
    const Parameters& x = chain.nodes.back();
    const Point p = evaluate(a_, x[0], x[1]);
    for (const SurfaceTouch& t : cells_.touches) {
      if (!t.branching) continue;
      if (distance(p, t.point) > reach_of(t)) continue;
      Parameters y = t.at;
      for (int i = 0; i < 4; ++i)
        if (t.within[i].length() > 1e-2) y[i] = x[i];  // at a pole that parameter is free
      chain.nodes.push_back(y);
      chain.arcs.push_back(arc);
      return;
    }
  }
  double reach_of(const SurfaceTouch& t) const {
    const BezierJet p = jet(a_, t.at[0], t.at[1]), q = jet(b_, t.at[2], t.at[3]);
    double size = 0;
    const Vector v[4] = {p.du, p.dv, q.du, q.dv};
    for (int i = 0; i < 4; ++i) size = std::max(size, norm(v[i]) * std::min(1.0, t.within[i].length()));
    return 8 * size + 1e-12;
  }

  const Bezier &a_, &b_;
  const SurfaceCells& cells_;
  std::vector<Chain> out_;
};

}  // namespace

std::vector<Chain> chains(const Bezier& a, const Bezier& b, const SurfaceCells& cells) {
  return Tracer(a, b, cells).run();
}

}  // namespace trimloop::detail
