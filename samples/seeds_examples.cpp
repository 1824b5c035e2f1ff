// Worked examples of the course notes, computed by the library and compared with what the notes derive.

#include <cstdio>

#include "samples/seeds.h"

namespace samples {

using namespace trimloop;

namespace {

const std::vector<Point> six{{0, 0, 0}, {1, 4, 0}, {5, 6, 0}, {9, 5, 0}, {12, 1, 0}, {9, -2, 0}};

NurbsCurve over(int degree, std::vector<double> knots, const std::vector<Point>& points) {
  return *NurbsCurve::from_cartesian(degree, std::move(knots), points, {});
}

// 000 §4.1: P(3, 2, 3) = (P(1, 2, 3) + 2 P(2, 3, 4)) / 3.
double polar_form() {
  const NurbsCurve c = over(3, {1, 1, 2, 3, 4, 5, 6, 7, 8, 8}, six);
  const double arguments[] = {3, 2, 3};
  return distance(project(blossom(c, 3.5, arguments)), six[0] + 2.0 / 3 * (six[1] - six[0]));
}

// 000 §4: the first span alone is the Bézier curve of P(3,3,3), P(3,3,4), P(3,4,4), P(4,4,4).
double first_span() {
  const NurbsCurve c = over(3, {1, 1, 2, 3, 4, 5, 6, 7, 8, 8}, six);
  const NurbsCurve piece = bezier_pieces(c)[0];
  double off = 0;
  for (int i = 0; i < 4; ++i) {
    const double arguments[] = {i > 2 ? 4.0 : 3.0, i > 1 ? 4.0 : 3.0, i > 0 ? 4.0 : 3.0};
    off = std::max(off, distance(project(blossom(c, 3.5, arguments)), project(piece.poles()[static_cast<std::size_t>(i)])));
  }
  return off;
}

// 000 §1.3: from degree 5 to 6 each side is parted at 1, 2, 3 .. sixths.
double elevation() {
  const NurbsCurve raised = elevate(over(5, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}, six), 1);
  double off = 0;
  for (std::size_t i = 1; i < 6; ++i) {
    const double share = static_cast<double>(i) / 6;
    off = std::max(off, distance(project(raised.poles()[i]), six[i] + share * (six[i - 1] - six[i])));
  }
  return off;
}

// 000 §3: x^2 + y^2 = 1 on the arcs by two finite tangents, by a quarter and by the ideal point.
double arcs() {
  const double half = std::sqrt(0.5), high = std::sqrt(0.75);
  const std::vector<std::vector<Point>> points{{{high, 0.5, 0}, {0, 2, 0}, {-high, 0.5, 0}}, {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}};
  const std::vector<std::vector<double>> weights{{1, 0.5, 1}, {1, half, 1}, {1, 0, 1}};
  double off = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto arc = NurbsCurve::from_cartesian(2, {0, 0, 0, 1, 1, 1}, points[k], weights[k]);
    for (int i = 0; i <= 100; ++i) {
      const Point p = evaluate(*arc, i / 100.0);
      off = std::max(off, std::abs(p.x * p.x + p.y * p.y - 1));
    }
  }
  return off;
}

// 000 §3: one rational quintic is the whole circle.
double quintic() {
  const NurbsCurve circle = *quintic_circle(Frame{}, 1);
  double off = 0;
  for (int i = 0; i <= 100; ++i) {
    const Point p = evaluate(circle, circle.range().at(i / 100.0));
    off = std::max(off, std::abs(p.x * p.x + p.y * p.y - 1));
  }
  return off;
}

// 000 §0: corners cut at a quarter tend to the quadratic B-spline of the polygon; its points are 2^-12 apart by then.
double corner_cutting() {
  const std::vector<Point> square{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  const LevelPolygon cut = *cut_corners(square, true, 0.25, 12);
  std::vector<Point> wrapped = square;
  wrapped.insert(wrapped.end(), {square[0], square[1]});
  const NurbsCurve spline = over(2, {-2, -1, 0, 1, 2, 3, 4, 5, 6}, wrapped);
  double off = 0;
  for (std::size_t i = 0; i < cut.points.size(); i += 64) off = std::max(off, closest_point(Curve{spline}, cut.points[i]).distance - cut.bound);
  return std::max(off, 0.0);
}

// 004: bias 1 and tension 0 give the uniform cubic B-spline.
double beta() {
  const NurbsCurve a = *beta_spline(six, {1, 0}), b = over(3, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, six);
  double off = 0;
  for (int i = 0; i <= 100; ++i) off = std::max(off, distance(evaluate(a, a.range().at(i / 100.0)), evaluate(b, b.range().at(i / 100.0))));
  return off;
}

struct Example {
  const char* where;
  const char* says;
  double (*off)();
};
const Example examples[] = {
    {"000 §4.1", "P(3, 2, 3) = (P(1, 2, 3) + 2 P(2, 3, 4)) / 3", polar_form},
    {"000 §4", "a span of a B-spline is a Bézier curve by its polar form", first_span},
    {"000 §1.3", "degree 5 to 6 parts the sides by sixths", elevation},
    {"000 §3", "x² + y² = 1 on three kinds of arcs", arcs},
    {"000 §3", "x² + y² = 1 on the quintic circle", quintic},
    {"000 §0", "corner cutting at 1/4 is within its bound of the quadratic B-spline", corner_cutting},
    {"004", "the Beta-spline of (1, 0) is the cubic B-spline", beta},
};

}  // namespace

int work_examples() {
  int wrong = 0;
  for (const Example& e : examples) {
    const double off = e.off();
    std::printf("%-9s %-72s off by %.1e\n", e.where, e.says, off);
    wrong += !(off <= 1e-14);
  }
  return wrong > 0;
}

}  // namespace samples
