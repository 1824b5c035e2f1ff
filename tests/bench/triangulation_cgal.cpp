// Our triangulation beside CGAL's Constrained_Delaunay_triangulation_2 (exact predicates, inexact constructions), in
// turns in one process: points and constraints in, finished triangulation of the hull out. Processor time, best of
// several rounds. Both must find the same number of triangles. CGAL's own best way is taken: bulk insertion of all
// points with the constraints by index, one object cleared and used again.
//
//   build/bench/tests/bench/triangulation_cgal [ROUNDS]

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <time.h>

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>

#include "kernel/mesh/triangulation.h"

using namespace trimloop;
using namespace trimloop::mesh;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Peer = CGAL::Constrained_Delaunay_triangulation_2<Kernel>;

struct Drawing {
  std::vector<Uv> points;
  std::vector<Segment> constraints;

  void loop(std::size_t first) {
    const auto end = static_cast<std::uint32_t>(points.size());
    for (auto i = static_cast<std::uint32_t>(first); i < end; ++i) {
      constraints.push_back({i, i + 1 < end ? i + 1 : static_cast<std::uint32_t>(first)});
    }
  }
  void ring(Uv centre, double radius, int n, bool clockwise, double turn = 0) {
    const std::size_t first = points.size();
    for (int i = 0; i < n; ++i) {
      const double angle = turn + (clockwise ? -two_pi : two_pi) * i / n;
      points.push_back(centre + radius * Uv{std::cos(angle), std::sin(angle)});
    }
    loop(first);
  }
};

struct PeerDrawing {  // the same in CGAL's types, made beforehand
  std::vector<Kernel::Point_2> points;
  std::vector<std::pair<std::size_t, std::size_t>> constraints;

  explicit PeerDrawing(const Drawing& d) {
    for (Uv p : d.points) points.emplace_back(p.u, p.v);
    for (Segment s : d.constraints) constraints.emplace_back(s.a, s.b);
  }
};

struct Random {
  std::mt19937_64 engine{1};
  double unit() { return std::ldexp(static_cast<double>(engine() >> 11), -53); }
  Uv point() { return {unit(), unit()}; }
};

Drawing random_points(std::size_t n) {
  Random r;
  Drawing d;
  d.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  d.loop(0);
  while (d.points.size() < n) d.points.push_back(r.point());
  return d;
}

// A tenth of the points on closed rings of 32.
Drawing points_and_rings(std::size_t n) {
  Random r;
  Drawing d = random_points(4);
  const int side = static_cast<int>(std::sqrt(static_cast<double>(n) / 320));
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) d.ring({(i + 0.5) / side, (j + 0.5) / side}, 0.2 / side, 32, false);
  }
  while (d.points.size() < n) d.points.push_back(r.point());
  return d;
}

// A ring of 32, a hole of 12 and 60 points between.
std::vector<Drawing> small_faces(int count) {
  Random r;
  std::vector<Drawing> faces(static_cast<std::size_t>(count));
  for (Drawing& d : faces) {
    const Uv centre = 100 * r.point();
    d.ring(centre, 1, 32, false);
    d.ring(centre, 0.3, 12, true);
    for (int i = 0; i < 60; ++i) {
      const double angle = two_pi * r.unit(), radius = 0.35 + 0.6 * r.unit();
      d.points.push_back(centre + radius * Uv{std::cos(angle), std::sin(angle)});
    }
  }
  return faces;
}

std::vector<Drawing> octagons(int count) {
  Random r;
  std::vector<Drawing> faces(static_cast<std::size_t>(count));
  for (Drawing& d : faces) d.ring(100 * r.point(), 0.5 + r.unit(), 8, false, two_pi * r.unit());
  return faces;
}

double processor_time() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

template <class Body>
void keep_least(double& least, Body body) {
  const double start = processor_time();
  body();
  least = std::min(least, processor_time() - start);
}

bool compare(const char* name, const std::vector<Drawing>& faces, int rounds, double asked) {
  const std::vector<PeerDrawing> peer_faces(faces.begin(), faces.end());
  std::size_t points = 0, count = 0, peer_count = 0;
  for (const Drawing& d : faces) points += d.points.size();
  Triangulation ours;
  Peer peer;
  double time = infinity, peer_time = infinity;
  for (int k = 0; k < rounds; ++k) {
    count = peer_count = 0;
    keep_least(time, [&] {
      for (const Drawing& d : faces) {
        if (!ours.build(d.points, d.constraints)) std::abort();
        count += ours.triangle_count();
      }
    });
    keep_least(peer_time, [&] {
      for (const PeerDrawing& d : peer_faces) {
        peer.clear();
        peer.insert_constraints(d.points.begin(), d.points.end(), d.constraints.begin(), d.constraints.end());
        peer_count += 2 * peer.number_of_vertices() - 2;  // with the ones at infinity, as ours are counted
      }
    });
  }
  const double ratio = peer_time / time;
  const auto rate = [&](double seconds) { return static_cast<double>(points) / seconds / 1e6; };
  std::printf("%-28s %8.2f %8.2f   %5.2f   %s\n", name, rate(time), rate(peer_time), ratio,
              count != peer_count ? "COUNTS DIFFER"
              : ratio >= asked    ? "met"
                                  : "NOT MET");
  return count == peer_count && ratio >= asked;
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 10;
  std::printf("%-28s %8s %8s   %5s\n", "million points a second", "ours", "CGAL", "ratio");
  bool met = true;
  met &= compare("random 1e5", {random_points(100'000)}, rounds, 1.0);
  met &= compare("random 1e6", {random_points(1'000'000)}, rounds, 1.0);
  met &= compare("random and rings 1e5", {points_and_rings(100'000)}, rounds, 1.0);
  met &= compare("random and rings 1e6", {points_and_rings(1'000'000)}, rounds, 1.0);
  met &= compare("2000 faces of 104", small_faces(2000), rounds, 1.3);
  met &= compare("20000 octagons", octagons(20'000), rounds, 1.8);
  return met ? 0 : 1;
}
