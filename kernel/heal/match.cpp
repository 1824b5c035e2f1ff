#include "kernel/heal/match.h"

namespace trimloop::heal {
namespace {

struct Pair {
  double c, t;   // parameters on curve and pcurve
};

class Matcher {
 public:
  Matcher(const Sheet& sheet, const Piece& piece, bool against, double tolerance_mm)
      : sheet_(sheet), piece_(piece), c0_(against ? piece.c1 : piece.c0), c1_(against ? piece.c0 : piece.c1),
        tolerance_(tolerance_mm) {}

  // 1. Nearest points of the 3D curve to points along the pcurve, as far as they go on in one direction.
  // 2. Halving where the straight map between two of them is off by more than the curves are.
  Match run() {
    std::vector<Pair> pairs{{c0_, piece_.t0}};
    double gap = std::max(off(pairs[0]), off({c1_, piece_.t1}));
    const std::size_t step = std::max<std::size_t>(1, piece_.samples.size() / 512);
    for (std::size_t i = step; i + 1 < piece_.samples.size(); i += step) follow(piece_.samples[i].t, pairs);
    if (piece_.samples.size() < 9)
      for (int i = 1; i < 8; ++i) {
        const double t = Interval{piece_.t0, piece_.t1}.at(i / 8.0);
        if ((t - pairs.back().t) * (piece_.t1 - piece_.t0) > 0) follow(t, pairs);
      }
    pairs.push_back({c1_, piece_.t1});
    refine(pairs, gap);
    Match out;
    out.gap_mm = gap;
    if (pairs.size() > 2)
      for (const Pair& p : pairs) out.map.push_back({p.c, p.t});
    if (c0_ > c1_) std::reverse(out.map.begin(), out.map.end());
    return out;
  }

 private:
  Point on_surface(double t) const { return sheet_.point(uv_of(piece_, t)); }
  double off(Pair p) const { return distance(evaluate(*piece_.curve, p.c), on_surface(p.t)); }
  bool between(double c, double from, double to) const { return (c - from) * (to - c) > 0; }

  void follow(double t, std::vector<Pair>& pairs) const {
    const Pair last = pairs.back();
    const double guess = last.c + (t - last.t) / (piece_.t1 - last.t) * (c1_ - last.c);
    const CurveFoot foot = closest_point_near(*piece_.curve, on_surface(t), guess);
    if (between(foot.t, last.c, c1_)) pairs.push_back({foot.t, t});
  }

  void refine(std::vector<Pair>& pairs, double& gap) const {
    constexpr std::size_t most_pairs = 2048;
    std::vector<Pair> done{pairs.front()}, todo(pairs.rbegin(), pairs.rend() - 1);
    const double shortest = 1e-4 * std::abs(piece_.t1 - piece_.t0);
    while (!todo.empty()) {
      const Pair a = done.back(), b = todo.back();
      const Pair middle{0.5 * (a.c + b.c), 0.5 * (a.t + b.t)};
      const Point p = on_surface(middle.t);
      const double here = distance(evaluate(*piece_.curve, middle.c), p);
      if (here > tolerance_ && std::abs(b.t - a.t) > shortest && done.size() + todo.size() < most_pairs) {
        const CurveFoot foot = closest_point_near(*piece_.curve, p, middle.c);
        if (foot.distance < 0.7 * here && between(foot.t, a.c, b.c)) {
          todo.push_back({foot.t, middle.t});
          continue;
        }
      }
      gap = std::max({gap, here, off(b)});
      if (!(gap < infinity)) break;
      done.push_back(b);
      todo.pop_back();
    }
    pairs = std::move(done);
  }

  const Sheet& sheet_;
  const Piece& piece_;
  double c0_, c1_, tolerance_;
};

}  // namespace

Match match(const Sheet& sheet, const Piece& piece, double tolerance_mm) {
  constexpr int most = 16;
  const bool long_one = piece.samples.size() > 33;
  const int n = long_one ? most : 8;
  Point c[most + 1], s[most + 1];
  double along = 0, against = 0;
  for (int i = 0; i <= n; ++i) {
    const double f = double(i) / n;
    c[i] = evaluate(*piece.curve, Interval{piece.c0, piece.c1}.at(f));
    s[i] = sheet.point(uv_of(piece, Interval{piece.t0, piece.t1}.at(f)));
  }
  for (int i = 0; i <= n; ++i) {
    along = std::max(along, distance(c[i], s[i]));
    against = std::max(against, distance(c[n - i], s[i]));
  }
  if (along <= tolerance_mm) return {along, false, {}};
  if (against <= tolerance_mm) return {against, true, {}};
  const double ends_along = distance(c[0], s[0]) + distance(c[n], s[n]);
  const double ends_against = distance(c[n], s[0]) + distance(c[0], s[n]);
  const bool turned = ends_against < ends_along || (ends_against == ends_along && against < along);
  Match by_points = Matcher(sheet, piece, turned, tolerance_mm).run();
  by_points.against = turned;
  const double plain = turned ? against : along;
  // A map that does not help is not kept.
  if (!(by_points.gap_mm < 0.9 * plain)) return {plain, turned, {}};
  return by_points;
}

}  // namespace trimloop::heal
