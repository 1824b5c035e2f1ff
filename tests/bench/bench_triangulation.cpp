// Points per second of the triangulation. What is aimed at on one core: random points 1.4 M/s at 1e5, faces of a
// hundred points 2 M/s, insertion 0.5 M/s. Processor time is what counts: items_per_second.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <random>

#include "kernel/mesh/triangulation.h"

using namespace trimloop;
using namespace trimloop::mesh;

namespace {

struct Drawing {
  std::vector<Uv> points;
  std::vector<Segment> constraints;

  void ring(Uv centre, double ru, double rv, int n, bool clockwise = false) {
    const auto first = static_cast<std::uint32_t>(points.size()), count = static_cast<std::uint32_t>(n);
    for (int i = 0; i < n; ++i) {
      const double angle = (clockwise ? -two_pi : two_pi) * i / n;
      points.push_back(centre + Uv{ru * std::cos(angle), rv * std::sin(angle)});
    }
    for (std::uint32_t i = 0; i < count; ++i) constraints.push_back({first + i, first + (i + 1) % count});
  }
  void square() {
    const auto first = static_cast<std::uint32_t>(points.size());
    points.insert(points.end(), {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    for (std::uint32_t i = 0; i < 4; ++i) constraints.push_back({first + i, first + (i + 1) % 4});
  }
};

struct Random {
  std::mt19937_64 engine{1};
  double unit() { return std::ldexp(static_cast<double>(engine() >> 11), -53); }
  Uv point() { return {unit(), unit()}; }
};

void build(benchmark::State& state, const std::vector<Drawing>& drawings) {
  Triangulation t;
  std::size_t points = 0;
  for (auto _ : state) {
    for (const Drawing& d : drawings) {
      if (!t.build(d.points, d.constraints)) state.SkipWithError("refused");
      t.classify(Inside::Positive);
      points += d.points.size();
    }
    benchmark::DoNotOptimize(t.triangle_count());
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(points));
}

void random_points(benchmark::State& state) {
  Random r;
  Drawing d;
  d.square();
  for (std::int64_t i = 4; i < state.range(0); ++i) d.points.push_back(r.point());
  build(state, {d});
}
BENCHMARK(random_points)->Arg(1000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

// A tenth of the points on closed rings of 32.
void points_and_rings(benchmark::State& state) {
  Random r;
  Drawing d;
  d.square();
  const double radius = 0.2 / std::sqrt(static_cast<double>(state.range(0)) / 320);
  const int side = static_cast<int>(std::sqrt(static_cast<double>(state.range(0)) / 320));
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) d.ring({(i + 0.5) / side, (j + 0.5) / side}, radius, radius, 32);
  }
  while (static_cast<std::int64_t>(d.points.size()) < state.range(0)) d.points.push_back(r.point());
  build(state, {d});
}
BENCHMARK(points_and_rings)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

// Random points and a hundred lines across, which also cross each other.
void points_and_long_lines(benchmark::State& state) {
  Random r;
  Drawing d;
  d.square();
  while (static_cast<std::int64_t>(d.points.size()) < state.range(0)) d.points.push_back(r.point());
  for (int i = 0; i < 100; ++i) {
    const auto a = static_cast<std::uint32_t>(d.points.size());
    d.points.insert(d.points.end(), {{0, r.unit()}, {1, r.unit()}});
    d.constraints.push_back({a, a + 1});
  }
  build(state, {d});
}
BENCHMARK(points_and_long_lines)->Arg(100'000)->Unit(benchmark::kMillisecond);

// The usual load: faces of 104 points, a ring of 32, a hole of 12 and 60 inside.
void small_faces(benchmark::State& state) {
  Random r;
  std::vector<Drawing> faces;
  for (int f = 0; f < 2000; ++f) {
    Drawing d;
    const Uv centre = 100 * r.point();
    d.ring(centre, 1, 1, 32);
    d.ring(centre, 0.3, 0.3, 12, true);
    for (int i = 0; i < 60; ++i) {
      const double angle = two_pi * r.unit(), radius = 0.35 + 0.6 * r.unit();
      d.points.push_back(centre + radius * Uv{std::cos(angle), std::sin(angle)});
    }
    faces.push_back(d);
  }
  build(state, faces);
}
BENCHMARK(small_faces)->Unit(benchmark::kMillisecond);

void octagons(benchmark::State& state) {
  Drawing d;
  d.ring({0, 0}, 1, 1, 8);
  build(state, {d});
}
BENCHMARK(octagons);

// Ties everywhere.
void grid(benchmark::State& state) {
  Drawing d;
  for (int i = 0; i < 300; ++i) {
    for (int j = 0; j < 300; ++j) d.points.push_back({i * 0.1, j * 0.3});
  }
  build(state, {d});
}
BENCHMARK(grid)->Unit(benchmark::kMillisecond);

void loop_of_100000(benchmark::State& state) {
  Drawing d;
  d.ring({0, 0}, 3, 2, 100'000);
  build(state, {d});
}
BENCHMARK(loop_of_100000)->Unit(benchmark::kMillisecond);

// As a refiner does: each point near the one before.
void insertion(benchmark::State& state) {
  Random r;
  Drawing d;
  d.square();
  std::vector<Uv> more;
  for (int i = 0; i < 100'000; ++i) more.push_back(r.point());
  std::sort(more.begin(), more.end(), [](Uv a, Uv b) {
    const int row = static_cast<int>(a.u * 200), other = static_cast<int>(b.u * 200);
    return row != other ? row < other : row % 2 == 0 ? a.v < b.v : b.v < a.v;
  });
  Triangulation t;
  std::vector<std::uint32_t> touched;
  for (auto _ : state) {
    if (!t.build(d.points, d.constraints)) state.SkipWithError("refused");
    t.classify(Inside::Positive);
    std::uint32_t near = 0;
    for (Uv p : more) {
      if (t.insert(p, near, touched) != Triangulation::none) near = touched.front();
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(more.size()));
}
BENCHMARK(insertion)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
