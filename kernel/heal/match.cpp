#include "kernel/heal/match.h"

namespace trimloop::heal {
namespace {

struct Pair {
  double c, t;   // parameters on curve and pcurve
};

constexpr double map_slack = 5e-5;  // of the length: far below what any mesh of the curve can see

// An arc and its rational form meet at every half, quarter, eighth and so on, whatever their speeds: places to compare at
// must not be such fractions. `uneven` is symmetric about the middle, so that the reverse of a place is one.
double uneven(double fraction) { return fraction + 0.06 * std::sin(two_pi * fraction); }
// Between two places the difference looks like a bow, s (1 - s), or like an S, s (1 - s) (1 - 2 s): here both have 85 % of
// their largest value.
constexpr double off_middle = 0.3;

class Matcher {
 public:
  Matcher(const Sheet& sheet, const Piece& piece, bool against, double slack_mm)
      : sheet_(sheet), piece_(piece), c0_(against ? piece.c1 : piece.c0), c1_(against ? piece.c0 : piece.c1),
        slack_(slack_mm) {}

  // 1. Nearest points of the 3D curve to points along the pcurve, as far as they go on in one direction.
  // 2. Halving where the straight map between two of them loses more than the slack.
  Match run() {
    std::vector<Pair> pairs{{c0_, piece_.t0}};
    gap_ = off_ = std::max(off(pairs[0]), off({c1_, piece_.t1}));
    const std::size_t n = piece_.samples.size(), wanted = 16, step = std::max<std::size_t>(1, n / wanted);
    if (n > 8) {
      for (std::size_t i = step; i + 1 < n; i += step) follow(piece_.samples[i].t, pairs);
    } else {
      for (int i = 1; i < 8; ++i) follow(Interval{piece_.t0, piece_.t1}.at(i / 8.0), pairs);
    }
    pairs.push_back({c1_, piece_.t1});
    refine(pairs);
    Match out;
    out.gap_mm = gap_;
    out.off_mm = off_;
    if (pairs.size() > 2)
      for (const Pair& p : pairs) out.map.push_back({p.c, p.t});
    if (c0_ > c1_) std::reverse(out.map.begin(), out.map.end());
    return out;
  }

 private:
  Point on_surface(double t) const { return sheet_.point(uv_of(piece_, t)); }
  double off(Pair p) const { return distance(evaluate(*piece_.curve, p.c), on_surface(p.t)); }
  bool between(double c, double from, double to) const { return (c - from) * (to - c) > 0; }

  void follow(double t, std::vector<Pair>& pairs) {
    const Pair last = pairs.back();
    const double guess = last.c + (t - last.t) / (piece_.t1 - last.t) * (c1_ - last.c);
    const CurveFoot foot = closest_point_near(*piece_.curve, on_surface(t), guess);
    off_ = std::max(off_, foot.distance);
    if (between(foot.t, last.c, c1_)) pairs.push_back({foot.t, t});
  }

  void refine(std::vector<Pair>& pairs) {
    constexpr std::size_t most_pairs = 1024;
    std::vector<Pair> done{pairs.front()}, todo(pairs.rbegin(), pairs.rend() - 1);
    const double shortest = 1e-4 * std::abs(piece_.t1 - piece_.t0);
    while (!todo.empty()) {
      const Pair a = done.back(), b = todo.back();
      const Pair inner{a.c + off_middle * (b.c - a.c), a.t + off_middle * (b.t - a.t)};
      const Point p = on_surface(inner.t);
      const double here = distance(evaluate(*piece_.curve, inner.c), p);
      double nearest = here;
      if (here > slack_ && std::abs(b.t - a.t) > shortest && done.size() + todo.size() < most_pairs) {
        const CurveFoot foot = closest_point_near(*piece_.curve, p, inner.c);
        nearest = std::min(here, foot.distance);
        off_ = std::max(off_, nearest);
        if (foot.distance < 0.7 * here && between(foot.t, a.c, b.c)) {
          todo.push_back({foot.t, inner.t});
          continue;
        }
      } else if (here > off_) {
        off_ = std::max(off_, closest_point_near(*piece_.curve, p, inner.c).distance);
      }
      gap_ = std::max({gap_, here, off(b)});
      if (!(gap_ < infinity)) break;
      done.push_back(b);
      todo.pop_back();
    }
    pairs = std::move(done);
  }

  const Sheet& sheet_;
  const Piece& piece_;
  double c0_, c1_, slack_;
  double gap_ = 0, off_ = 0;
};

}  // namespace

Match match(const Sheet& sheet, const Piece& piece, double tolerance_mm) {
  constexpr int most = 16;
  const bool long_one = piece.samples.size() > 33;
  const int n = long_one ? most : 8;
  Point c[most + 1], s[most + 1];
  double along = 0, against = 0, length = 0;
  for (int i = 0; i <= n; ++i) {
    const double f = uneven(double(i) / n);
    c[i] = evaluate(*piece.curve, Interval{piece.c0, piece.c1}.at(f));
    s[i] = sheet.point(uv_of(piece, Interval{piece.t0, piece.t1}.at(f)));
    if (i > 0) length += distance(c[i - 1], c[i]);
  }
  for (int i = 0; i <= n; ++i) {
    along = std::max(along, distance(c[i], s[i]));
    against = std::max(against, distance(c[n - i], s[i]));
  }
  const double allowed = std::max(tolerance_mm, invisible * length);
  if (along <= allowed) return {along, along, allowed, false, {}};
  if (against <= allowed) return {against, against, allowed, true, {}};
  const double ends_along = distance(c[0], s[0]) + distance(c[n], s[n]);
  const double ends_against = distance(c[n], s[0]) + distance(c[0], s[n]);
  // The ends of a closed curve differ by rounding alone: then the points between decide.
  const bool closed = std::abs(ends_against - ends_along) <= 1e-6 * length;
  const bool turned = closed ? against < along : ends_against < ends_along;
  Match by_points = Matcher(sheet, piece, turned, std::max(tolerance_mm, map_slack * length)).run();
  by_points.against = turned;
  by_points.allowed_mm = allowed;
  const double plain = turned ? against : along;
  // A map that does not help is not kept.
  if (!(by_points.gap_mm < 0.9 * plain)) by_points.map.clear(), by_points.gap_mm = plain;
  return by_points;
}

}  // namespace trimloop::heal
