// Nearest points of a rational bicubic surface with 20 x 20 poles: time and right answers, ours and OpenCASCADE's.
// Never installed; docs/results.md records its table.

#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <cstdio>
#include <cstdlib>

#include "kernel/batch/batch.h"
#include "kernel/closest/closest.h"
#include "tests/bench/machine.h"
#include "tests/bench/occt_surface.h"
#include "tests/bench/surfaces.h"

using namespace trimloop;

namespace {

struct Times {
  std::vector<double> seconds;
  void add(double s) { seconds.push_back(s); }
  double at(double share) {
    std::sort(seconds.begin(), seconds.end());
    return seconds[static_cast<std::size_t>(share * static_cast<double>(seconds.size() - 1))];
  }
};

}  // namespace

int main(int argc, char** argv) {
  const int queries = argc > 1 ? std::atoi(argv[1]) : 600;
  Times ours, api, prepared, build;
  int wrong[3] = {0, 0, 0}, asked = 0, on_side = 0;
  double largest_gap = 0;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const NurbsSurface surface = bench::wavy(20, seed == 1 ? 4 : seed == 2 ? 10 : 25, seed);
    build.add(bench::fastest(5, [&] { const ClosestOnSurface once(surface); }));
    const ClosestOnSurface index(surface);
    const Handle(Geom_BSplineSurface) geom = bench::to_occt(surface);
    const GeomAdaptor_Surface adaptor(geom);
    Extrema_ExtPS extrema;
    extrema.Initialize(adaptor, adaptor.FirstUParameter(), adaptor.LastUParameter(), adaptor.FirstVParameter(),
                       adaptor.LastVParameter(), 1e-9, 1e-9);
    std::mt19937 random(seed + 100);
    std::uniform_real_distribution<double> xy(-10, 110), z(-40, 40);
    for (int k = 0; k < queries / 3; ++k, ++asked) {
      const Point p{xy(random), xy(random), z(random)};
      ClosestPoint mine;
      ours.add(bench::fastest(2, [&] { mine = index.nearest(p); }));
      double nearest[3] = {mine.distance, infinity, infinity};
      api.add(bench::fastest(1, [&] {
        const GeomAPI_ProjectPointOnSurf projection(gp_Pnt(p.x, p.y, p.z), geom);
        if (projection.NbPoints() > 0) nearest[1] = projection.LowerDistance();
      }));
      prepared.add(bench::fastest(1, [&] {
        extrema.Perform(gp_Pnt(p.x, p.y, p.z));
        for (int i = 1; extrema.IsDone() && i <= extrema.NbExt(); ++i)
          nearest[2] = std::min(nearest[2], std::sqrt(extrema.SquareDistance(i)));
      }));
      const double best = std::min({nearest[0], nearest[1], nearest[2]});
      for (int i = 0; i < 3; ++i) wrong[i] += nearest[i] > best + 1e-7;
      const Interval u = surface.range_u(), v = surface.range_v();
      on_side += mine.uv.u == u.lo || mine.uv.u == u.hi || mine.uv.v == v.lo || mine.uv.v == v.hi;
      largest_gap = std::max(largest_gap, mine.distance - mine.lower);
    }
  }
  std::printf("%d queries on three surfaces, nearest point on a side in %d; largest distance - lower %.3g mm\n", asked,
              on_side, largest_gap);
  std::printf("preparation %.2f ms\n", 1e3 * build.at(0.5));
  const char* names[3] = {"ours", "GeomAPI_ProjectPointOnSurf", "Extrema_ExtPS, prepared"};
  Times* times[3] = {&ours, &api, &prepared};
  for (int i = 0; i < 3; ++i)
    std::printf("%-28s median %9.2f us, 99 %% %9.2f us, largest %9.2f us, wrong %d of %d\n", names[i],
                1e6 * times[i]->at(0.5), 1e6 * times[i]->at(0.99), 1e6 * times[i]->at(1), wrong[i], asked);
  for (int i = 1; i < 3; ++i)
    std::printf("against %-20s median 1/%.0f, 99 %% 1/%.0f\n", names[i], times[i]->at(0.5) / ours.at(0.5),
                times[i]->at(0.99) / ours.at(0.99));
  return 0;
}
