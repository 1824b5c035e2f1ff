#include <fmt/format.h>

#include <random>

#include "tests/kernel/intersect/corpus.h"

namespace trimloop::test {
namespace {

Curve line(double x0, double y0, double x1, double y1) { return {Line{{x0, y0, 0}, {x1, y1, 0}}}; }
Curve circle(double x, double y, double r, Interval range = {0, two_pi}) {
  return {Circle{Frame{{x, y, 0}}, r, range}};
}
Curve ellipse(double x, double y, double a, double b, Interval range = {0, two_pi}) {
  return {Ellipse{Frame{{x, y, 0}}, a, b, range}};
}
Curve bezier(const std::vector<Point>& poles, const std::vector<double>& weights = {}) {
  const int degree = static_cast<int>(poles.size()) - 1;
  std::vector<double> knots(poles.size(), 0.0);
  knots.insert(knots.end(), poles.size(), 1.0);
  return {*NurbsCurve::from_cartesian(degree, knots, poles, weights)};
}

// y = sum c[k] x^k over [lo, hi] as a Bézier curve; `swap` exchanges x and y.
Curve graph(const std::vector<double>& c, double lo, double hi, bool swap = false) {
  const int n = std::max<int>(1, static_cast<int>(c.size()) - 1);
  // Coefficients by powers of s, x = lo + (hi - lo) s.
  std::vector<double> in_s(static_cast<std::size_t>(n) + 1, 0.0);
  for (std::size_t k = c.size(); k-- > 0;) {
    std::vector<double> next(in_s.size(), 0.0);
    for (std::size_t i = 0; i < in_s.size(); ++i) {
      next[i] += lo * in_s[i];
      if (i + 1 < in_s.size()) next[i + 1] += (hi - lo) * in_s[i];
    }
    next[0] += c[k];
    in_s = next;
  }
  const auto choose = [](int a, int b) {
    double r = 1;
    for (int i = 0; i < b; ++i) r = r * (a - i) / (i + 1);
    return r;
  };
  std::vector<Point> poles;
  for (int i = 0; i <= n; ++i) {
    double y = 0;
    for (int k = 0; k <= i; ++k) y += choose(i, k) / choose(n, k) * in_s[static_cast<std::size_t>(k)];
    const double x = lo + (hi - lo) * i / n;
    poles.push_back(swap ? Point{y, x, 0} : Point{x, y, 0});
  }
  return bezier(poles);
}

std::vector<double> times(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> r(a.size() + b.size() - 1, 0.0);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) r[i + j] += a[i] * b[j];
  return r;
}
std::vector<double> chebyshev(int n) {
  std::vector<double> a{1}, b{0, 1};
  for (int k = 0; k < n; ++k) {
    std::vector<double> next = times({0, 2}, b);
    for (std::size_t i = 0; i < a.size(); ++i) next[i] -= a[i];
    a = b;
    b = next;
  }
  return a;
}

void lines_and_conics(std::vector<CurvePair>& out) {
  out.push_back({"line crosses line", line(0, 0, 2, 2), line(0, 2, 2, 0), {1, 0, 0}, true, {{1, 1, 0}}});
  out.push_back({"line ends on line", line(0, 0, 2, 0), line(1, 0, 1, 3), {1}, true, {{1, 0, 0}}});
  out.push_back({"lines meet end to end at an angle", line(0, 0, 1, 1), line(1, 1, 2, 0), {1}, true, {{1, 1, 0}}});
  out.push_back({"lines meet end to end in one direction", line(0, 0, 1, 1), line(1, 1, 3, 3), {1}});
  out.push_back({"lines overlap in part", line(0, 0, 2, 2), line(1, 1, 3, 3), {0, 0, 1}});
  out.push_back({"line lies in line, against it", line(0, 0, 4, 2), line(3, 1.5, 1, 0.5), {0, 0, 1}});
  out.push_back({"parallel lines 1e-9 apart", line(0, 0, 1, 0), line(0, 1e-9, 1, 1e-9), {0, 0, 0}});
  out.push_back(
      {"lines at an angle of 1e-6", line(-1, 0, 1, 0), line(-1, -1e-6, 1, 1e-6), {1, 0, 0}, true, {{0, 0, 0}}});

  out.push_back(
      {"line cuts circle", line(-2, 0.6, 2, 0.6), circle(0, 0, 1), {2, 0, 0}, true, {{-0.8, 0.6, 0}, {0.8, 0.6, 0}}});
  out.push_back({"line touches circle", line(-2, 1, 2, 1), circle(0, 0, 1), {1, 1, 0}, true, {{0, 1, 0}}});
  out.push_back({"line touches circle off its knots", line(-1, 2.75, 3.0, -0.25), circle(0, 0, 1), {0, 0, 0}});
  out.push_back({"slanted line touches circle",
                 line(0.6 - 1.6, 0.8 + 1.2, 0.6 + 1.6, 0.8 - 1.2),
                 circle(0, 0, 1),
                 {1, 1, 0},
                 true,
                 {{0.6, 0.8, 0}}});
  out.push_back({"line passes circle at 1e-9", line(-2, 1 + 1e-9, 2, 1 + 1e-9), circle(0, 0, 1), {0, 0, 0}});
  for (const double half : {1e-2, 1e-3, 1e-4, 1e-5})
    out.push_back({fmt::format("line cuts a chord of {} from a circle", 2 * half),
                   line(-2, std::sqrt(1 - half * half), 2, std::sqrt(1 - half * half)),
                   circle(0, 0, 1),
                   {2, 0, 0}});
  out.push_back({"line ends on circle", line(3, 0.8, 0.6, 0.8), circle(0, 0, 1), {1}, true, {{0.6, 0.8, 0}}});
  out.push_back({"line through the start of a circle",
                 line(-3, 0, 3, 0),
                 circle(0, 0, 1),
                 {2, 0, 0},
                 true,
                 {{-1, 0, 0}, {1, 0, 0}}});
  out.push_back({"unbounded line cuts ellipse",
                 {Line{{0, 0.5, 0}, {1, 0.5, 0}, {-infinity, infinity}}},
                 ellipse(0, 0, 3, 1),
                 {2, 0, 0}});

  out.push_back({"circles cross",
                 circle(0, 0, 1),
                 circle(1, 0, 1),
                 {2, 0, 0},
                 true,
                 {{0.5, std::sqrt(0.75), 0}, {0.5, -std::sqrt(0.75), 0}}});
  out.push_back({"circles touch outside", circle(0, 0, 1), circle(1.8, 2.4, 2), {1, 1, 0}, true, {{0.6, 0.8, 0}}});
  out.push_back({"circles touch inside", circle(0, 0, 2), circle(0.6, 0.8, 1), {1, 1, 0}, true, {{1.2, 1.6, 0}}});
  out.push_back({"circles in a lens of 1e-5", circle(0, 0, 1), circle(1.2, 1.6 - 1e-10, 1), {2, 0, 0}});
  out.push_back({"circles 1e-9 apart", circle(0, 0, 1), circle(2 + 1e-9, 0, 1), {0, 0, 0}});
  out.push_back({"concentric circles", circle(0, 0, 1), circle(0, 0, 1 + 1e-9), {0, 0, 0}});
  out.push_back({"the same circle", circle(0, 0, 1), circle(0, 0, 1), {0, 0, 1}});
  out.push_back({"arcs of one circle overlap", circle(0, 0, 1, {0, 2}), circle(0, 0, 1, {1.5, 3}), {0, 0, 1}});
  out.push_back({"arcs of one circle meet end to end", circle(0, 0, 1, {0, 1}), circle(0, 0, 1, {1, 3}), {1}});
  out.push_back(
      {"arcs of one circle overlap at both ends", circle(0, 0, 1, {0, 4}), circle(0, 0, 1, {3, 7}), {0, 0, 2}});
  out.push_back({"tiny circle on a line", circle(0.3, 0, 1e-5), line(0, 0, 1, 0), {2, 0, 0}});
  out.push_back({"tiny circle touches a line", circle(0.3, 1e-5, 1e-5), line(0, 0, 1, 0), {1, 1, 0}});

  out.push_back({"ellipses cross in four points", ellipse(0, 0, 2, 1), ellipse(0, 0, 1, 2), {4, 0, 0}});
  out.push_back(
      {"ellipse touches circle twice", ellipse(0, 0, 2, 1), circle(0, 0, 1), {2, 2, 0}, true, {{0, 1, 0}, {0, -1, 0}}});
  out.push_back({"ellipse touches and crosses circle", ellipse(0, 0, 2, 1), circle(0.5, 0, 1.5), {3, 1, 0}});
  out.push_back(
      {"circle of curvature at a vertex", ellipse(0, 0, 2, 1), circle(1.5, 0, 0.5), {1, 1, 0}, true, {{2, 0, 0}}});
  out.push_back(
      {"parabola touches line", {Parabola{Frame{}, 0.25, {-2, 2}}}, line(0, -2, 0, 2), {1, 1, 0}, true, {{0, 0, 0}}});
  out.push_back({"parabola crosses line",
                 {Parabola{Frame{}, 0.25, {-2, 2}}},
                 line(0.25, -2, 0.25, 2),
                 {2, 0, 0},
                 true,
                 {{0.25, 0.5, 0}, {0.25, -0.5, 0}}});
  out.push_back(
      {"hyperbola meets its asymptote's parallel", {Hyperbola{Frame{}, 1, 1, {-3, 3}}}, line(0, -1, 8, 7), {1, 0, 0}});
  out.push_back(
      {"hyperbola touches circle", {Hyperbola{Frame{}, 1, 1, {-2, 2}}}, circle(0, 0, 1), {1, 1, 0}, true, {{1, 0, 0}}});
  out.push_back({"polyline against circle",
                 {Polyline{{{-2, 0, 0}, {0, 2, 0}, {2, 0, 0}, {0, -2, 0}, {-2, 0, 0}}}},
                 circle(0, 0, 1.5),
                 {8, 0, 0}});
  out.push_back({"polyline's corner on circle",
                 {Polyline{{{-2, 2, 0}, {0, 1, 0}, {2, 2, 0}}}},
                 circle(0, 0, 1),
                 {1, -1, 0},
                 true,
                 {{0, 1, 0}}});
}

void graphs(std::vector<CurvePair>& out) {
  for (const int n : {3, 5, 7})
    out.push_back({fmt::format("Chebyshev curves of degree {}, crosswise", n),
                   graph(chebyshev(n), -1.1, 1.1),
                   graph(chebyshev(n), -1.1, 1.1, true),
                   {n * n, 0, 0}});
  out.push_back(
      {"Chebyshev polynomial of degree 15 and its axis", graph(chebyshev(15), -1, 1), line(-1, 0, 1, 0), {15, 0, 0}});
  out.push_back({"Chebyshev polynomial touches y = 1",
                 graph(chebyshev(6), -0.99, 0.99),
                 line(-1, 1, 1, 1),
                 {2, 2, 0}});  // at cos(2 k pi / 6), k = 1, 2
  out.push_back(
      {"cubic through its tangent", graph({0, 0, 0, 1}, -1, 1), line(-1, 0, 1, 0), {1, 1, 0}, true, {{0, 0, 0}}});
  out.push_back({"quartic on its tangent",
                 graph({0, 0, 0, 0, 1}, -1, 0.9),
                 line(-1, 0, 1, 0),
                 {1, 1, 0},
                 true,
                 {{0, 0, 0}},
                 1e-3});
  out.push_back({"parabola and quartic",
                 graph({0, 0, 1}, -1.3, 1.4),
                 graph({0, 0, 0, 0, 1}, -1.2, 1.3),
                 {3, 1, 0},
                 true,
                 {{-1, 1, 0}, {0, 0, 0}, {1, 1, 0}}});
  std::mt19937 random(7);
  const auto real = [&](double lo, double hi) { return lo + (hi - lo) * static_cast<double>(random()) / 4294967295.0; };
  for (int k = 0; k < 60; ++k) {  // p and p + product of (x - root): crossings at the roots, touches at the double ones
    std::vector<double> p, product{real(0.5, 2)};
    for (int i = 0; i <= 1 + k % 5; ++i) p.push_back(real(-1, 1));
    const int count = 1 + k % 5, doubles = k % 3 == 0 ? 1 : 0;
    std::vector<Point> where;
    for (int i = 0; i < count; ++i) {
      const double root = -0.85 + 1.7 * (i + real(0.1, 0.9)) / count;
      product = times(product, {-root, 1});
      if (i < doubles) product = times(product, {-root, 1});
      double y = 0;
      for (std::size_t j = p.size(); j-- > 0;) y = y * root + p[j];
      where.push_back({root, y, 0});
    }
    std::vector<double> q = product;
    q.resize(std::max(q.size(), p.size()), 0.0);
    for (std::size_t i = 0; i < p.size(); ++i) q[i] += p[i];
    out.push_back({fmt::format("graphs with {} constructed contacts, {}", count, k),
                   graph(p, -1, 1),
                   graph(q, -0.95, 1),
                   {count, doubles, 0},
                   true,
                   where});
  }
  for (const double gap : {1e-1, 1e-3, 1e-5}) {  // two roots so far apart
    std::vector<double> p{0.3, -0.2, 0.5}, product = times({-(0.2 - gap / 2), 1}, {-(0.2 + gap / 2), 1});
    for (std::size_t i = 0; i < 3; ++i) product[i] += p[i];
    out.push_back(
        {fmt::format("graphs crossing twice, {} apart", gap), graph(p, -1, 1), graph(product, -1, 1), {2, 0, 0}});
  }
}

void splines(std::vector<CurvePair>& out) {
  const NurbsCurve whole =
      std::get<NurbsCurve>(bezier({{0, 0, 0}, {1, 3, 0}, {2, -2, 0}, {4, 1, 0}, {5, 0, 0}}, {1, 2, 0.7, 1.5, 1}).shape);
  const auto part = [&](double lo, double hi) { return trimmed(whole, {lo, hi}); };
  out.push_back({"parts of one curve overlap", {part(0, 0.6)}, {part(0.4, 1)}, {0, 0, 1}});
  out.push_back(
      {"parts of one curve, elevated and reversed", {elevate(part(0, 0.6), 2)}, {reversed(part(0.4, 1))}, {0, 0, 1}});
  out.push_back({"a part inside a curve", {whole}, {elevate(part(0.3, 0.35), 1)}, {0, 0, 1}});
  out.push_back({"parts of one curve meet end to end", {part(0, 0.5)}, {part(0.5, 1)}, {1}});
  out.push_back({"parts of one curve apart", {part(0, 0.45)}, {part(0.5, 1)}, {0, 0, 0}});
  out.push_back({"the same spline", {whole}, {whole}, {0, 0, 1}});
  const std::vector<double> inner{0.2, 0.45, 0.45, 0.7};
  out.push_back({"a curve and its refinement", {whole}, {refine(whole, inner)}, {0, 0, 1}});
  // Moebius: weights times powers of a ratio, the same points at other parameters.
  std::vector<Hpoint> poles = whole.poles();
  double f = 1;
  for (Hpoint& h : poles) h = f * h, f *= 1.7;
  out.push_back({"the same points at other parameters",
                 {whole},
                 {*NurbsCurve::from_homogeneous(4, whole.knots(), poles)},
                 {0, 0, 1}});
  const std::vector<double> knots{0, 0, 0, 1, 2, 3, 3, 3};
  const NurbsCurve wave = *NurbsCurve::from_cartesian(
      2, knots, std::vector<Point>{{0, 1, 0}, {1, -2, 0}, {2, 2, 0}, {3, -2, 0}, {4, 1, 0}}, {});
  out.push_back({"line through a spline of three pieces", {wave}, line(-1, 0, 5, 0), {4, 0, 0}});
  out.push_back({"line through a spline's knot", {wave}, line(1.5, -1, 1.5, 1), {1, 0, 0}, true, {{1.5, 0, 0}}});
}

}  // namespace

std::vector<CurvePair> plane_corpus() {
  std::vector<CurvePair> out;
  lines_and_conics(out);
  graphs(out);
  splines(out);
  return out;
}

std::vector<CurvePair> space_corpus() {
  std::vector<CurvePair> out;
  int k = 0;
  for (CurvePair& pair : plane_corpus()) {
    if (pair.name.starts_with("graphs with") && k % 3) {
      ++k;
      continue;
    }
    const Transform m = Transform::translation({1, -2, 0.5 * (k % 7)}) *
                        Transform::rotation({0, 0, 0}, {1, 0.3 * k, 2.0 - k % 5}, 0.7 + k);
    ++k;
    const Result<Curve> a = transformed(pair.a, m), b = transformed(pair.b, m);
    for (Point& p : pair.where) p = apply(m, p);
    out.push_back({"in space: " + pair.name, *a, *b, pair.expected, false, pair.where, pair.zone});
  }
  const auto segment = [](Point a, Point b) { return Curve{Line{a, b}}; };
  out.push_back({"skew lines 1e-6 apart",
                 segment({-1, 0, 0}, {1, 0, 0}),
                 segment({0, -1, 1e-6}, {0, 1, 1e-6}),
                 {0, 0, 0},
                 false});
  out.push_back({"skew lines 1e-9 apart",
                 segment({-1, 0, 0}, {1, 0, 0}),
                 segment({0, -1, 1e-9}, {0, 1, 1e-9}),
                 {0, 0, 0},
                 false});
  out.push_back({"circles in two planes cross twice",
                 {Circle{Frame{}, 1}},
                 {Circle{Frame{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, 1}},
                 {2, 0, 0},
                 false,
                 {{1, 0, 0}, {-1, 0, 0}}});
  out.push_back({"linked circles",
                 {Circle{Frame{}, 1}},
                 {Circle{Frame{{1, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}}, 1}},
                 {0, 0, 0},
                 false});
  const Curve twisted = bezier({{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {3, 3, 1}});
  const CurveJet j = jet(twisted, 0.4);
  out.push_back({"twisted cubic touched by its tangent",
                 twisted,
                 segment(j.point - 0.3 * j.d1, j.point + 0.3 * j.d1),
                 {1, 1, 0},
                 false,
                 {j.point}});
  out.push_back({"twisted cubic met by a line",
                 twisted,
                 segment(j.point - Vector{1, 0, 2}, j.point + Vector{1, 0, 2}),
                 {1, 0, 0},
                 false,
                 {j.point}});
  return out;
}

}  // namespace trimloop::test
