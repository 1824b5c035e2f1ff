#pragma once
// What the tests of make_face share: surfaces, segments, and a check that the result keeps every promise of Body.

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <string>

#include "kernel/check/measure.h"
#include "kernel/heal/make_face.h"

namespace trimloop::heal::test {

template <class T>
SurfacePtr surface(T shape) {
  return std::make_shared<const Surface>(Surface{std::move(shape)});
}
template <class T>
CurvePtr curve(T shape) {
  return std::make_shared<const Curve>(Curve{std::move(shape)});
}
inline Frame frame_at(Point origin) {
  Frame f;
  f.origin = origin;
  return f;
}
inline Circle horizontal_circle(Point centre, double radius) { return {frame_at(centre), radius, {0, two_pi}}; }

inline TrimSegment drawn(Curve2 pcurve, CurvePtr c = nullptr) {
  TrimSegment s;
  s.pcurve = std::move(pcurve);
  s.curve = std::move(c);
  return s;
}
inline TrimSegment drawn(Uv a, Uv b) { return drawn(make_line2(a, b)); }
inline TrimSegment in_space(CurvePtr c) {
  TrimSegment s;
  s.curve = std::move(c);
  return s;
}
inline TrimLoop polygon(const std::vector<Uv>& corners) {
  TrimLoop loop;
  for (std::size_t i = 0; i < corners.size(); ++i)
    loop.segments.push_back(drawn(corners[i], corners[(i + 1) % corners.size()]));
  return loop;
}
inline Curve2 circle2(Uv centre, double radius) {
  return Curve2{Curve{horizontal_circle({centre.u, centre.v, 0}, radius)}};
}
template <class... S>
TrimLoop loop_of(S... segments) {
  TrimLoop loop;
  (loop.segments.push_back(std::move(segments)), ...);
  return loop;
}

struct Made {
  Body body;
  FaceOutcome outcome;
  const Face& face() const { return body[outcome.face]; }
  double area() const { return trimloop::area(body, outcome.face).value; }
  int count(Step step) const {
    return static_cast<int>(std::count_if(outcome.steps.begin(), outcome.steps.end(),
                                          [&](const StepRecord& s) { return s.step == step; }));
  }
  const StepRecord& first(Step step) const {
    const auto it = std::find_if(outcome.steps.begin(), outcome.steps.end(),
                                 [&](const StepRecord& s) { return s.step == step; });
    BOOST_REQUIRE_MESSAGE(it != outcome.steps.end(), "no step " << to_string(step));
    return *it;
  }
  std::size_t coedges() const {
    std::size_t n = 0;
    for (const LoopId l : face().loops) n += body[l].coedges.size();
    return n;
  }
};

inline void check_sound(const Body& body, double tolerance_mm) {
  const auto broken = broken_promises(body, tolerance_mm);
  for (const std::string& b : broken) BOOST_TEST_MESSAGE(b);
  BOOST_TEST(broken.empty(), (broken.empty() ? std::string{} : broken.front()));
}

inline Made make(FaceInput input) {
  Made m;
  const double tolerance = input.tolerance_mm;
  m.outcome = add_face(m.body, input);
  check_sound(m.body, tolerance);
  for (const StepRecord& s : m.outcome.steps)
    if (s.changes_shape && m.face().status != FaceStatus::Failed) BOOST_TEST((m.face().status == FaceStatus::Healed));
  return m;
}

template <class T>
FaceInput input(T shape, std::vector<TrimLoop> loops) {
  FaceInput in;
  in.surface = surface(std::move(shape));
  in.loops = std::move(loops);
  return in;
}

inline void check_ok(const Made& m) { BOOST_TEST((m.face().status == FaceStatus::Ok), m.face().reason); }
inline void check_area(const Made& m, double expected, double relative = 1e-7) {
  BOOST_TEST(std::abs(m.area() - expected) <= relative * std::abs(expected),
             "area " << m.area() << ", expected " << expected << ", reason: " << m.face().reason);
}

// A cylinder of radius 1 along z as a NURBS surface: u around in [0, 1], v in [0, height] is z. Closed, not periodic.
inline NurbsSurface nurbs_cylinder(double height) {
  const double h = std::sqrt(0.5);
  const double xs[] = {1, 1, 0, -1, -1, -1, 0, 1, 1}, ys[] = {0, 1, 1, 1, 0, -1, -1, -1, 0};
  const double ws[] = {1, h, 1, h, 1, h, 1, h, 1};
  std::vector<Point> points;
  std::vector<double> weights;
  for (int i = 0; i < 9; ++i)
    for (const double z : {0.0, height}) points.push_back({xs[i], ys[i], z}), weights.push_back(ws[i]);
  auto s = NurbsSurface::from_cartesian(2, 1, {0, 0, 0, .25, .25, .5, .5, .75, .75, 1, 1, 1}, {0, 0, height, height},
                                        points, weights);
  BOOST_REQUIRE(s.has_value());
  return *s;
}

}  // namespace trimloop::heal::test
