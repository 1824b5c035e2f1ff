#include <fmt/format.h>

#include <random>

#include "tests/kernel/intersect/corpus.h"

namespace trimloop::test {
namespace {

double choose(std::size_t n, std::size_t k) {
  double r = 1;
  for (std::size_t i = 0; i < k; ++i) r = r * static_cast<double>(n - i) / static_cast<double>(i + 1);
  return r;
}

// Coefficients by powers of x to Bernstein coefficients over [lo, hi].
std::vector<double> to_bernstein(const std::vector<double>& c, Interval over) {
  const std::size_t n = c.size() - 1;
  std::vector<double> shifted(n + 1, 0.0);
  for (std::size_t k = n + 1; k-- > 0;) {
    std::vector<double> next(n + 1, 0.0);
    for (std::size_t i = 0; i <= n; ++i) {
      next[i] += over.lo * shifted[i];
      if (i < n) next[i + 1] += over.length() * shifted[i];
    }
    next[0] += c[k];
    shifted = next;
  }
  std::vector<double> b(n + 1, 0.0);
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t k = 0; k <= i; ++k) b[i] += choose(i, k) / choose(n, k) * shifted[k];
  return b;
}

Curve segment(Point a, Point b) { return {Line{a, b}}; }

}  // namespace

NurbsSurface graph_patch(const std::vector<std::vector<double>>& c, Interval x, Interval y) {
  const std::size_t n = std::max<std::size_t>(c.size(), 2), m = std::max<std::size_t>(c[0].size(), 2);
  std::vector<std::vector<double>> full(n, std::vector<double>(m, 0.0));
  for (std::size_t i = 0; i < c.size(); ++i)
    for (std::size_t j = 0; j < c[i].size(); ++j) full[i][j] = c[i][j];
  for (auto& row : full) row = to_bernstein(row, y);
  for (std::size_t j = 0; j < m; ++j) {
    std::vector<double> column(n);
    for (std::size_t i = 0; i < n; ++i) column[i] = full[i][j];
    column = to_bernstein(column, x);
    for (std::size_t i = 0; i < n; ++i) full[i][j] = column[i];
  }
  std::vector<Point> poles;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < m; ++j)
      poles.push_back({x.at(static_cast<double>(i) / static_cast<double>(n - 1)),
                       y.at(static_cast<double>(j) / static_cast<double>(m - 1)), full[i][j]});
  const auto knots = [](Interval over, std::size_t poles_along) {
    std::vector<double> k(poles_along, over.lo);
    k.insert(k.end(), poles_along, over.hi);
    return k;
  };
  return *NurbsSurface::from_cartesian(static_cast<int>(n) - 1, static_cast<int>(m) - 1, knots(x, n), knots(y, m),
                                       poles, {});
}

std::vector<CurveSurfacePair> curve_surface_corpus() {
  std::vector<CurveSurfacePair> out;
  const Frame f;
  const Frame upright{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}};  // x is the world's y, y its z
  const Surface plane{Plane{f}}, sphere{Sphere{f, 1}}, cylinder{Cylinder{f, 1}}, torus{Torus{f, 3, 1}};
  const Surface cone{Cone{f, 1, pi / 4}};
  out.push_back({"line through plane", segment({0.3, 0.2, -1}, {0.5, 0.4, 1}), plane, {1, 0, 0}, {{0.4, 0.3, 0}}});
  out.push_back({"line 1e-9 above plane", segment({0, 0, 1e-9}, {1, 2, 1e-9}), plane, {0, 0, 0}});
  out.push_back({"line in plane", segment({0, 0, 0}, {1, 2, 0}), plane, {0, 0, 1}});
  out.push_back({"line ends on plane", segment({0, 0, 1}, {1, 2, 0}), plane, {1}, {{1, 2, 0}}});
  out.push_back({"line at an angle of 1e-6 to plane", segment({-1, 0, -1e-6}, {1, 0, 1e-6}), plane, {1, 0, 0}});
  out.push_back({"unbounded line through plane",
                 {Line{{1, 1, 5}, {1, 1, 6}, {-infinity, infinity}}},
                 {graph_patch({{0}}, {0, 2}, {0, 3})},
                 {1, 0, 0},
                 {{1, 1, 0}}});

  out.push_back(
      {"line through sphere", segment({-2, 0.6, 0}, {2, 0.6, 0}), sphere, {2, 0, 0}, {{0.8, 0.6, 0}, {-0.8, 0.6, 0}}});
  out.push_back({"line touches sphere", segment({-2, 0.6, 0.8}, {2, 0.6, 0.8}), sphere, {1, 1, 0}, {{0, 0.6, 0.8}}});
  out.push_back({"line touches sphere on its seam",
                 segment({0.6, -1, 0.8}, {0.6, 1.3, 0.8}),
                 sphere,
                 {1, 1, 0},
                 {{0.6, 0, 0.8}}});
  out.push_back(
      {"line passes sphere at 1e-9", segment({-2, 0.6, 0.8 + 2e-9}, {2, 0.6, 0.8 + 2e-9}), sphere, {0, 0, 0}});
  out.push_back(
      {"line through the poles of sphere", segment({0, 0, -2}, {0, 0, 2}), sphere, {2}, {{0, 0, 1}, {0, 0, -1}}});
  for (const double half : {1e-3, 1e-5})
    out.push_back({fmt::format("line cuts a chord of {} from sphere", 2 * half),
                   segment({-2, 0.6 * std::sqrt(1 - half * half), 0.8 * std::sqrt(1 - half * half)},
                           {2, 0.6 * std::sqrt(1 - half * half), 0.8 * std::sqrt(1 - half * half)}),
                   sphere,
                   {2, 0, 0}});
  out.push_back({"line ends on sphere", segment({0.3, 0.4, 3}, {0.48, 0.64, 0.6}), sphere, {1}, {{0.48, 0.64, 0.6}}});
  out.push_back({"circle of latitude on sphere", {Circle{Frame{{0, 0, 0.6}}, 0.8}}, sphere, {0, 0, 1}});
  out.push_back({"great circle across the poles", {Circle{upright, 1}}, sphere, {0, 0, 1}});
  out.push_back({"circle crosses sphere", {Circle{Frame{{1, 0, 0}}, 1}}, sphere, {2, 0, 0}});
  out.push_back({"circle touches sphere outside", {Circle{Frame{{0, 2, 0}}, 1}}, sphere, {1, 1, 0}, {{0, 1, 0}}});
  out.push_back(
      {"circle touches sphere inside", {Circle{Frame{{0.36, 0.48, 0}}, 0.4}}, sphere, {1, 1, 0}, {{0.6, 0.8, 0}}});

  out.push_back({"line through cylinder", segment({-2, 0.6, 0.1}, {2, 0.6, 0.7}), cylinder, {2, 0, 0}});
  out.push_back({"line touches cylinder", segment({-2, 1, 0.1}, {2, 1, 0.7}), cylinder, {1, 1, 0}, {{0, 1, 0.4}}});
  out.push_back({"generatrix of cylinder", segment({0.6, 0.8, 0.1}, {0.6, 0.8, 0.7}), cylinder, {0, 0, 1}});
  out.push_back({"axis of cylinder", segment({0, 0, 0.1}, {0, 0, 0.7}), cylinder, {0, 0, 0}});
  out.push_back({"circle of cylinder", {Circle{Frame{{0, 0, 2}}, 1, {0.5, 5}}}, cylinder, {0, 0, 1}});
  out.push_back({"ellipse in cylinder",
                 {Ellipse{make_frame({0, 0, 1}, {1, 0, 1}, {-1, 0, 1}), std::sqrt(2.0), 1}},
                 cylinder,
                 {0, 0, 1}});

  out.push_back({"line through cone", segment({-3, 0, 0.5}, {3, 0.4, 0.5}), cone, {2, 0, 0}});
  out.push_back({"axis of cone meets the apex", segment({0, 0, -2}, {0, 0, 1}), cone, {1}, {{0, 0, -1}}});
  out.push_back({"generatrix of cone", segment({0.6, 0.8, 0}, {1.2, 1.6, 1}), cone, {0, 0, 1}});

  out.push_back({"line through torus in four points", segment({-5, 0.1, 0.2}, {5, 0.3, 0.1}), torus, {4, 0, 0}});
  out.push_back({"line touches torus outside", segment({4, -2, -1}, {4, 2, 1}), torus, {1, 1, 0}, {{4, 0, 0}}});
  out.push_back({"line on top of torus touches twice",
                 segment({-5, 1, 1}, {5, 1, 1}),
                 torus,
                 {2, 2, 0},
                 {{std::sqrt(8.0), 1, 1}, {-std::sqrt(8.0), 1, 1}}});
  out.push_back({"top circle of torus", {Circle{Frame{{0, 0, 1}}, 3}}, torus, {0, 0, 1}});
  out.push_back(
      {"tube circle of torus", {Circle{Frame{{3, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}}, 1}}, torus, {0, 0, 1}});
  out.push_back({"circle touches torus' tube inside",
                 {Circle{Frame{{3, 0, 0.5}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}}, 0.5}},
                 torus,
                 {1, 1, 0},
                 {{3, 0, 1}}});

  // z = product of (x - root) + y^2 - 0.25 against lines along x at y = 0.5.
  std::mt19937 random(11);
  const auto real = [&](double lo, double hi) { return lo + (hi - lo) * static_cast<double>(random()) / 4294967295.0; };
  for (int k = 0; k < 24; ++k) {
    const int count = 1 + k % 4, doubles = k % 3 == 0 ? 1 : 0;
    std::vector<double> p{real(0.5, 2)};
    std::vector<Point> where;
    for (int i = 0; i < count; ++i) {
      const double root = -0.85 + 1.7 * (i + real(0.1, 0.9)) / count;
      for (int times = 0; times < (i < doubles ? 2 : 1); ++times) {
        std::vector<double> next(p.size() + 1, 0.0);
        for (std::size_t j = 0; j < p.size(); ++j) next[j] -= root * p[j], next[j + 1] += p[j];
        p = next;
      }
      where.push_back({root, 0.5, 0});
    }
    std::vector<std::vector<double>> c(p.size(), std::vector<double>(3, 0.0));
    for (std::size_t i = 0; i < p.size(); ++i) c[i][0] = p[i];
    c[0][0] -= 0.25, c[0][2] = 1;
    out.push_back({fmt::format("line over a graph with {} constructed contacts, {}", count, k),
                   segment({-1, 0.5, 0}, {1, 0.5, 0}),
                   {graph_patch(c, {-1, 1}, {-1, 1})},
                   {count, doubles, 0},
                   where});
  }
  const NurbsSurface bump = graph_patch({{0, 0, -1}, {0, 0, 0}, {-1, 0, 0}}, {-1, 1}, {-1, 1});
  out.push_back({"line touches the top of a bump", segment({-1, 0, 0}, {0.8, 0, 0}), {bump}, {1, 1, 0}, {{0, 0, 0}}});
  out.push_back(
      {"line cuts 2e-5 from the top of a bump", segment({-1, 0, -1e-10}, {0.8, 0, -1e-10}), {bump}, {2, 0, 0}});
  out.push_back({"line meets the border of a patch from outside", segment({1, 0.3, -1.09}, {2, 0.3, 5}), {bump}, {1}});
  out.push_back({"line ends on a corner of a patch", segment({1, 1, -2}, {2, 3, 5}), {bump}, {1}});
  out.push_back({"line beside a patch", segment({1 + 1e-9, 0.3, -3}, {1 + 1e-9, 0.3, 5}), {bump}, {0, 0, 0}});
  out.push_back({"isocurve of a patch", {isocurve_u(bump, 0.3)}, {bump}, {0, 0, 1}});
  out.push_back({"border of a patch", {isocurve_u(bump, 1)}, {bump}, {0, 0, 1}});
  out.push_back({"line sticks out of a flat patch",
                 segment({-3, 0.2, 0}, {3, 0.4, 0}),
                 {graph_patch({{0}}, {-1, 1}, {-1, 1})},
                 {0, 0, 1}});
  return out;
}

}  // namespace trimloop::test
