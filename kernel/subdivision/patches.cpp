#include "kernel/subdivision/patches.h"

#include "base/assert.h"

namespace trimloop::subdivision::detail {

namespace {

Point affine(Point a, double wa, Point b, double wb) {
  return {wa * a.x + wb * b.x, wa * a.y + wb * b.y, wa * a.z + wb * b.z};
}

// Lower or upper half of a Bézier row by de Casteljau at 1/2.
void halve(std::vector<Point>& row, bool upper) {
  const std::size_t n = row.size();
  for (std::size_t level = 1; level < n; ++level) {
    if (upper) {
      for (std::size_t i = 0; i + level < n; ++i) row[i] = midpoint(row[i], row[i + 1]);
    } else {
      for (std::size_t i = n - 1; i >= level; --i) row[i] = midpoint(row[i - 1], row[i]);
    }
  }
}

// Bézier poles of one span of a uniform B-spline.
void to_bernstein(std::vector<Point>& p) {
  if (p.size() == 3) {
    p = {midpoint(p[0], p[1]), p[1], midpoint(p[1], p[2])};
    return;
  }
  const auto sixth = [](Point a, Point b, Point c) {
    return Point{(a.x + 4 * b.x + c.x) / 6, (a.y + 4 * b.y + c.y) / 6, (a.z + 4 * b.z + c.z) / 6};
  };
  p = {sixth(p[0], p[1], p[2]), affine(p[1], 2.0 / 3, p[2], 1.0 / 3), affine(p[1], 1.0 / 3, p[2], 2.0 / 3),
       sixth(p[1], p[2], p[3])};
}

// `change` of every row along u, then of every row along v.
template <class Change>
std::vector<Point> both_ways(int degree, std::vector<Point> net, Change change) {
  const auto n = static_cast<std::size_t>(degree + 1);
  for (const bool along_u : {true, false}) {
    for (std::size_t line = 0; line < n; ++line) {
      std::vector<Point> row(n);
      const auto place = [&](std::size_t i) -> Point& { return along_u ? net[i * n + line] : net[line * n + i]; };
      for (std::size_t i = 0; i < n; ++i) row[i] = place(i);
      change(row, along_u);
      for (std::size_t i = 0; i < n; ++i) place(i) = row[i];
    }
  }
  return net;
}

NurbsSurface surface(int degree, std::vector<double> knots, const std::vector<Point>& poles, Interval range) {
  auto made = NurbsSurface::from_cartesian(degree, degree, knots, knots, poles, {}, range, range);
  TRIMLOOP_ASSERT(made.has_value(), "a finite net over sound knots makes a patch");
  return *made;
}

}  // namespace

NurbsSurface to_surface(const Square& s) {
  const auto n = static_cast<std::size_t>(s.degree + 1);
  std::vector<double> knots(n, 0.0);
  knots.insert(knots.end(), n, 1.0);
  return surface(s.degree, std::move(knots), s.poles, {0, 1});
}

NurbsSurface uniform_patch(int degree, const std::vector<Point>& net) {
  std::vector<double> knots;
  for (int i = -degree; i <= degree + 1; ++i) knots.push_back(i);
  return surface(degree, std::move(knots), net, {0, 1});
}

Square bernstein(int degree, const std::vector<Point>& net) {
  return {degree, both_ways(degree, net, [](std::vector<Point>& row, bool) { to_bernstein(row); })};
}

Square quarter(const Square& s, bool upper_u, bool upper_v) {
  return {s.degree, both_ways(s.degree, s.poles, [&](std::vector<Point>& row, bool along_u) {
            halve(row, along_u ? upper_u : upper_v);
          })};
}

double difference(const Square& a, const Square& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.poles.size(); ++i) largest = std::max(largest, distance(a.poles[i], b.poles[i]));
  return largest;
}

double spread(const std::vector<Point>& a, const std::vector<Point>& b) {
  double largest = 0;
  for (const Point& p : a)
    for (const Point& q : b) largest = std::max(largest, distance(p, q));
  return largest;
}

double cap_bound(const Levels& levels, int degree, std::size_t level) {
  static constexpr std::array<std::array<bool, 2>, 3> places{{{true, false}, {true, true}, {false, true}}};
  Square rest = levels.approximations[level];
  double bound = 0, size = 0;
  for (const Point& p : rest.poles) size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  for (std::size_t k = level; k < levels.rings.size(); ++k) {
    for (std::size_t i = 0; i < 3; ++i)
      bound = std::max(bound, difference(bernstein(degree, levels.rings[k][i]), quarter(rest, places[i][0], places[i][1])));
    rest = quarter(rest, false, false);
  }
  bound = std::max(bound, spread(levels.last_hull, rest.poles));
  return bound + 64 * std::numeric_limits<double>::epsilon() * size;  // rounding of the poles compared
}

void add_corners(LimitSurface& out, const CornerPatches& from, int degree) {
  int rounds = 0;
  for (const Levels& c : from.corners) rounds = std::max(rounds, c.rounds);
  for (std::size_t i = 0; i < from.corners.size(); ++i) {
    const Levels& c = from.corners[i];
    // Corners that were good enough earlier go on as far as rings were made for their bound.
    const auto level = std::min(static_cast<std::size_t>(rounds), c.rings.size());
    for (std::size_t k = 0; k < level; ++k) {
      for (const auto& net : c.rings[k]) {
        out.patches.push_back({uniform_patch(degree, net), from.from[i], 0});
        ++out.exact;
      }
    }
    const double bound = cap_bound(c, degree, level);
    out.patches.push_back({to_surface(c.approximations[level]), from.from[i], bound});
    ++out.caps;
    out.bound = std::max(out.bound, bound);
  }
}

}  // namespace trimloop::subdivision::detail
