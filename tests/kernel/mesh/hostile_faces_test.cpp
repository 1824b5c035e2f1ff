// Whatever the loops of a face: a triangulation in which everything holds, checked exactly (triangulation_property.h).

#include "tests/kernel/mesh/hostile_faces.h"

#include <boost/test/unit_test.hpp>

#include "tests/fuzz/triangulation_property.h"

using namespace trimloop;
using namespace trimloop::mesh;
using namespace trimloop::test;

namespace {

// Triangulates, checks, refines as a mesher does, checks again.
std::string broken_by(const HostileFace& face, Random& r, Triangulation& t) {
  if (!t.build(face.points, face.constraints)) return "refused";
  t.classify(face.rule);
  if (auto broken = broken_invariant(t, face.points, face.constraints); !broken.empty()) return broken;
  if (auto broken = property::broken_regions(t, face.points, face.constraints, face.rule); !broken.empty())
    return broken;
  std::vector<std::uint32_t> touched;
  for (int k = r.whole(0, 8); k > 0 && t.triangle_count() > 0; --k) {
    const auto from = static_cast<std::uint32_t>(r.whole(0, static_cast<int>(t.triangle_count()) - 1));
    const auto& v = t.triangle(from).v;
    const auto i = static_cast<std::size_t>(r.whole(0, 2));
    if (t.is_ghost(from)) continue;
    const Uv a = t.points()[v[i]], b = t.points()[v[(i + 1) % 3]], c = t.points()[v[(i + 2) % 3]];
    if (t.is_constrained(from, static_cast<int>(i))) {
      t.split_constraint(from, static_cast<int>(i), {b.u / 2 + c.u / 2, b.v / 2 + c.v / 2}, touched);
    } else {
      t.insert({a.u / 4 + b.u / 4 + c.u / 2, a.v / 4 + b.v / 4 + c.v / 2}, from, touched);
    }
  }
  const std::string broken = broken_invariant(t, face.points, face.constraints);
  return broken.empty() ? broken : broken + " after refinement";
}

struct Tally {
  std::size_t faces = 0, inside = 0, crossings = 0, diverted = 0, most_points = 0;
  void add(const HostileFace& face, const Triangulation& t) {
    ++faces;
    inside += t.inside_triangles().size();
    crossings += t.crossings().size();
    diverted += t.diverted() != 0;
    most_points = std::max(most_points, face.points.size());
  }
};

// Faces `begin` to `end`; face k depends on k alone.
void check_faces(std::uint64_t begin, std::uint64_t end, Tally& tally) {
  Triangulation t;
  for (std::uint64_t k = begin; k < end; ++k) {
    Random r{k};
    const HostileFace face = hostile_face(r);
    BOOST_TEST_INFO("face " << k);
    BOOST_REQUIRE_EQUAL(broken_by(face, r, t), "");
    tally.add(face, t);
  }
}

// A closed loop of so many points that crosses itself a few hundred times; or so many holes, some across each other.
HostileFace endless_loop(Random& r, int points) {
  HostileFace face;
  const double turns = r.whole(1, 20) + (r.whole(0, 1) == 0 ? 0 : 0.5);
  for (int i = 0; i < points; ++i) {
    const double angle = two_pi * turns * i / points, radius = 1 + 0.3 * std::sin(3.7 * angle) + 1e-5 * r.unit();
    face.points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  const auto n = static_cast<std::uint32_t>(points);
  for (std::uint32_t i = 0; i < n; ++i) face.constraints.push_back({i, (i + 1) % n});
  return face;
}
HostileFace many_holes(Random& r, int side) {
  HostileFace face;
  const auto ring = [&](Uv centre, double radius, int n) {
    const auto first = static_cast<std::uint32_t>(face.points.size()), count = static_cast<std::uint32_t>(n);
    for (int i = 0; i < n; ++i) {
      const double angle = -two_pi * i / n;
      face.points.push_back(centre + radius * Uv{std::cos(angle), std::sin(angle)});
    }
    for (std::uint32_t i = 0; i < count; ++i) face.constraints.push_back({first + i, first + (i + 1) % count});
  };
  ring({side / 2.0, side / 2.0}, 0.8 * side, 64);
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) ring({i + r.unit() / 4, j + r.unit() / 4}, 0.45, r.whole(3, 9));
  }
  face.rule = Inside::Odd;
  return face;
}

void check_large_faces(std::uint64_t seed, int points, int side, Tally& tally) {
  Random r{seed};
  Triangulation t;
  for (const HostileFace& face : {endless_loop(r, points), many_holes(r, side)}) {
    BOOST_REQUIRE_EQUAL(broken_by(face, r, t), "");
    tally.add(face, t);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(five_thousand_hostile_faces_make_valid_triangulations) {
  Tally tally;
  check_faces(0, 5'000, tally);
  check_large_faces(0, 20'000, 30, tally);
  BOOST_TEST(tally.crossings > 100'000u);
  BOOST_TEST(tally.inside > 100'000u);
}

// By name only: test_kernel_mesh --run_test=a_million_hostile_faces_make_valid_triangulations --log_level=message
BOOST_AUTO_TEST_CASE(a_million_hostile_faces_make_valid_triangulations, *boost::unit_test::disabled()) {
  Tally tally;
  for (std::uint64_t part = 0; part < 50; ++part) {
    check_faces(20'000 * part, 20'000 * (part + 1), tally);
    check_large_faces(part, 100'000, 100, tally);  // 10 000 holes
    BOOST_TEST_MESSAGE(tally.faces << " faces, the largest of " << tally.most_points << " points; " << tally.inside
                                   << " triangles inside, " << tally.crossings
                                   << " crossings; with pieces led around: " << tally.diverted);
  }
}
