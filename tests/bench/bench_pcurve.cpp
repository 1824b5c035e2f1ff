// The proven distance of a pcurve from its curve, beside plain sampling of the same pair; and projection of curves.
#include <benchmark/benchmark.h>

#include "kernel/pcurve/project.h"
#include "tests/kernel/geometry/shapes.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

struct Pair {
  Surface surface{wavy_surface(9)};
  Curve curve;
  ProjectedCurve projected;
};
// A curve of 57 cubic pieces that runs across a bumpy rational bicubic, up to 6e-3 mm off it.
const Pair& pair() {
  static const Pair p = [] {
    Pair out;
    std::vector<Point> points;
    for (int i = 0; i <= 60; ++i) points.push_back(evaluate(out.surface, {0.2 + 2.5 * i / 60, 3.7 - 3.3 * i / 60}));
    std::vector<double> knots(4, 0.0);
    for (int i = 1; i + 3 <= 60; ++i) knots.push_back(i);
    knots.insert(knots.end(), 4, 58.0);
    out.curve = Curve{*NurbsCurve::from_cartesian(3, knots, points, {})};
    out.projected = *project(out.curve, range(out.curve), out.surface);
    return out;
  }();
  return p;
}

void bound(benchmark::State& state) {
  const Pair& p = pair();
  Deviation d;
  for (auto _ : state) {
    d = deviation(p.projected.pcurve, p.projected.range, p.surface, p.curve, range(p.curve));
    benchmark::DoNotOptimize(d);
  }
  state.counters["bound/measured"] = d.bound_mm / d.measured_mm;
}
BENCHMARK(bound)->Unit(benchmark::kMicrosecond);

void thousand_samples(benchmark::State& state) {
  const Pair& p = pair();
  const Interval r = range(p.curve);
  for (auto _ : state) {
    double worst = 0;
    for (int i = 0; i <= 1000; ++i) {
      const double x = i / 1000.0;
      const Uv uv = evaluate(p.projected.pcurve, p.projected.range.at(x));
      worst = std::max(worst, distance(evaluate(p.surface, uv), evaluate(p.curve, r.at(x))));
    }
    benchmark::DoNotOptimize(worst);
  }
}
BENCHMARK(thousand_samples)->Unit(benchmark::kMicrosecond);

void projection(benchmark::State& state) {
  const Pair& p = pair();
  for (auto _ : state) {
    auto r = project(p.curve, range(p.curve), p.surface);
    benchmark::DoNotOptimize(r);
  }
}
BENCHMARK(projection)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
