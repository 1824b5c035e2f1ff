// Evaluation of a rational bicubic surface (20 x 20 poles), point and both first derivatives, one core: what the
// machine allows, what we reach with each instruction set, and OpenCASCADE in the same run. Sides are interleaved and
// the fastest of several rounds counts. Never installed; docs/results.md records its table.

#include <GeomAdaptor_Surface.hxx>
#include <cstdio>
#include <numeric>

#include "kernel/batch/batch.h"
#include "tests/bench/machine.h"
#include "tests/bench/occt_surface.h"
#include "tests/bench/surfaces.h"

using namespace trimloop;

namespace {

constexpr int rounds = 15;
double avx2_rate = 1;  // two 256-bit multiply-adds a cycle: the usual bound
double sink = 0;       // what is computed is used

struct Output {
  std::vector<double> numbers;
  SurfaceColumns columns;
  explicit Output(std::size_t points) : numbers(9 * points + 8) {
    double* at = numbers.data();  // on a cache line, as those who ask for speed will have it
    while (reinterpret_cast<std::size_t>(at) % 64 != 0) ++at;
    for (auto* group : {&columns.point, &columns.du, &columns.dv})
      for (double*& column : *group) column = at, at += points;
  }
};

struct Points {
  std::vector<double> u, v;
};
Points random_points(const NurbsSurface& s, std::size_t n) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> u(s.domain_u().lo, s.domain_u().hi), v(s.domain_v().lo, s.domain_v().hi);
  Points p;
  for (std::size_t i = 0; i < n; ++i) p.u.push_back(u(random)), p.v.push_back(v(random));
  return p;
}
Points sorted_by_patch(const SurfacePieces& s, const Points& p) {
  std::vector<std::size_t> order(p.u.size());
  std::iota(order.begin(), order.end(), 0);
  const auto patch = [&](std::size_t i) {
    return s.spans_u().locate(p.u[i]) * s.spans_v().size() + s.spans_v().locate(p.v[i]);
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return patch(a) < patch(b); });
  Points out;
  for (std::size_t i : order) out.u.push_back(p.u[i]), out.v.push_back(p.v[i]);
  return out;
}

// Seconds a point of several ways of doing the same, taken in turns. The work comes in short pieces, of each of which
// the fastest round counts: other programs run on the machine. way(piece) returns how many points it did.
using Way = std::function<std::size_t(std::size_t)>;
std::vector<double> race(std::size_t pieces, const std::vector<Way>& ways) {
  std::vector<double> result(ways.size(), 0.0);
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    std::vector<double> best(ways.size(), 1e300);
    for (int round = 0; round < rounds; ++round)
      for (std::size_t i = 0; i < ways.size(); ++i) {
        std::size_t points = 1;
        const double seconds = bench::fastest(1, [&] { points = ways[i](piece); });
        best[i] = std::min(best[i], seconds / static_cast<double>(points));
      }
    for (std::size_t i = 0; i < ways.size(); ++i) result[i] += best[i] / static_cast<double>(pieces);
  }
  return result;
}

struct Build {
  const char* name;
  BatchOptions options;
  double fma_rate;  // of its instruction set; 0: no share is printed
};

// Vector operations a point (counted for Horner's scheme): those of the polynomials and of the quotient.
constexpr double grid_operations = 32 + 6 + 11, scattered_operations = 80 + 32 + 2 + 6 + 11;

void print(const char* what, const std::vector<Build>& builds, const std::vector<double>& seconds, double operations,
           std::size_t occt_ways) {
  const double occt = *std::min_element(seconds.end() - static_cast<std::ptrdiff_t>(occt_ways), seconds.end());
  std::printf("%s\n  OpenCASCADE %.1f ns a point\n", what, 1e9 * occt);
  for (std::size_t i = 0; i < builds.size(); ++i) {
    std::printf("  %-28s %8.2f ns %8.1f M points/s %7.1f x", builds[i].name, 1e9 * seconds[i], 1e-6 / seconds[i],
                occt / seconds[i]);
    if (builds[i].fma_rate > 0 && operations > 0)
      std::printf("   %4.0f %% of the bound, %4.0f %% of that of AVX2",
                  100 * operations / builds[i].fma_rate / seconds[i], 100 * operations / avx2_rate / seconds[i]);
    std::printf("\n");
  }
}

}  // namespace

int main() {
  const InstructionSet best = best_instruction_set();
  const double sse2 = bench::peak_rate(bench::peak_sse2);
  const double avx2 = best >= InstructionSet::Avx2 ? bench::peak_rate(bench::peak_avx2) : 0;
  const double avx512 = best >= InstructionSet::Avx512 ? bench::peak_rate(bench::peak_avx512) : 0;
  if (avx2 > 0) avx2_rate = avx2;
  const bench::StoreRates stores = bench::store_rates();
  std::printf("peak, multiply-adds a second: SSE2 %.1f G, AVX2 %.1f G, AVX-512 %.1f G\n", 1e-9 * sse2, 1e-9 * avx2,
              1e-9 * avx512);
  std::printf("stores: %.0f GB/s in cache, %.1f to memory, %.1f past the caches\n", 1e-9 * stores.cached,
              1e-9 * stores.plain, 1e-9 * stores.streamed);

  std::vector<Build> builds;
  if (avx512 > 0) builds.push_back({"AVX-512, fused", {Arithmetic::Fast, InstructionSet::Avx512}, avx512});
  if (avx512 > 0) builds.push_back({"AVX-512, same bits", {Arithmetic::SameBits, InstructionSet::Avx512}, avx512});
  if (avx2 > 0) builds.push_back({"AVX2, fused", {Arithmetic::Fast, InstructionSet::Avx2}, avx2});
  if (avx2 > 0) builds.push_back({"AVX2, same bits", {Arithmetic::SameBits, InstructionSet::Avx2}, avx2});
  builds.push_back({"without AVX, same bits", {Arithmetic::SameBits, InstructionSet::Baseline}, sse2});

  const NurbsSurface surface = bench::wavy(20, 10, 7);
  const SurfacePieces pieces(surface);
  const Handle(Geom_BSplineSurface) geom = bench::to_occt(surface);
  const GeomAdaptor_Surface adaptor(geom);
  gp_Pnt p;
  gp_Vec du, dv;

  {  // 64 points along u in each of 17 spans; rows are used while they are in the cache, four at a time
    std::vector<double> u, v;
    for (int i = 0; i < 64 * 17; ++i) u.push_back(surface.domain_u().at((i + 0.5) / (64 * 17)));
    for (int i = 0; i < 64; ++i) v.push_back(surface.domain_v().at((i + 0.5) / 64));
    Output out(u.size() * 4);
    std::vector<Way> ways;
    for (const Build& b : builds)
      ways.push_back([&, b](std::size_t) {
        const SurfaceGrid grid(pieces, u, v, b.options);
        for (std::size_t j = 0; j < v.size(); j += 4) grid.rows(j, 4, out.columns), sink += out.numbers[5];
        return u.size() * v.size();
      });
    ways.push_back([&](std::size_t piece) {
      for (double t : u) adaptor.D1(t, v[piece], p, du, dv), sink += p.X();
      return u.size();
    });
    print("grid, results in cache (OpenCASCADE: adaptor)", builds, race(20, ways), grid_operations, 1);

    Output large(u.size() * 17 * 64);
    ways.clear();
    for (const Build& b : builds)
      ways.push_back([&, b](std::size_t piece) {
        SurfaceColumns to = large.columns;
        for (auto* group : {&to.point, &to.du, &to.dv})
          for (double*& column : *group) column += piece * u.size() * v.size();
        evaluate_grid(pieces, u, v, to, b.options);
        return u.size() * v.size();
      });
    const std::vector<double> seconds = race(17, ways);
    std::printf("grid, 5 MB of results at a time (last-level cache)\n");
    for (std::size_t i = 0; i < builds.size(); ++i)
      std::printf("  %-28s %8.2f ns %8.1f M points/s\n", builds[i].name, 1e9 * seconds[i], 1e-6 / seconds[i]);
  }

  const std::size_t n = 1000000, step = 50000, part = 2000;
  const Points scattered = random_points(surface, n), sorted = sorted_by_patch(pieces, scattered);
  Output out(n);
  for (const Points* points : {&sorted, &scattered}) {
    std::vector<Way> ways;
    for (const Build& b : builds)
      ways.push_back([&, b](std::size_t piece) {
        SurfaceColumns to = out.columns;
        for (auto* group : {&to.point, &to.du, &to.dv})
          for (double*& column : *group) column += piece * step;
        evaluate(pieces, {points->u.data() + piece * step, step}, {points->v.data() + piece * step, step}, to,
                 b.options);
        return step;
      });
    ways.push_back([&](std::size_t piece) {  // OpenCASCADE does a part of each piece: it would take too long
      for (std::size_t i = piece * step; i < piece * step + part; ++i)
        geom->D1(points->u[i], points->v[i], p, du, dv), sink += p.X();
      return part;
    });
    ways.push_back([&](std::size_t piece) {
      for (std::size_t i = piece * step; i < piece * step + part; ++i)
        adaptor.D1(points->u[i], points->v[i], p, du, dv), sink += p.X();
      return part;
    });
    print(points == &sorted ? "1 000 000 points sorted by patch (OpenCASCADE: the better of direct and adaptor)"
                            : "1 000 000 points in random order, all costs included (likewise)",
          builds, race(n / step, ways), points == &sorted ? scattered_operations : 0, 2);
  }

  {
    Point q;
    Vector a, b;
    const auto each = [&](auto body) -> Way {
      return [&, body](std::size_t piece) {
        for (std::size_t i = piece * part; i < (piece + 1) * part; ++i) body(scattered.u[i], scattered.v[i]);
        return part;
      };
    };
    const std::vector<double> seconds =
        race(20, {each([&](double u, double v) {
                    jet1(pieces, {u, v}, q, a, b), sink += q.x;
                  }),
                  each([&](double u, double v) {
                    jet1(surface, {u, v}, q, a, b), sink += q.x;
                  }),
                  each([&](double u, double v) { geom->D1(u, v, p, du, dv), sink += p.X(); }),
                  each([&](double u, double v) { adaptor.D1(u, v, p, du, dv), sink += p.X(); })});
    print("single calls, random places", {{"jet1 of pieces", {}, 0}, {"jet1 of the surface", {}, 0}}, seconds, 0, 2);
  }
  return sink == 0.1234 ? 1 : 0;
}
