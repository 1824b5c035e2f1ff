// Nearest points of trimmed faces: natural patches of every kind, plates with holes, and curved sheets cut by a circle,
// against dense samples of what the trim leaves.
#include <boost/test/unit_test.hpp>

#include "kernel/closest/closest.h"
#include "tests/kernel/closest/surfaces.h"

using namespace trimloop;
using testing::Random;

namespace {

Coedge closed_pcurve(Body& body, Curve2 pcurve, bool with_curve, const Surface& surface) {
  const Interval r = range(pcurve);
  const Uv start = evaluate(pcurve, r.lo);
  const VertexId vertex = body.add(Vertex{evaluate(surface, start), 0});
  Edge edge;
  edge.range = r;
  edge.start = edge.end = vertex;
  if (with_curve) {  // of a plane: the circle itself
    std::vector<Point> through;
    for (int k = 0; k <= 64; ++k) through.push_back(evaluate(surface, evaluate(pcurve, r.at(k / 64.0))));
    edge.curve = std::make_shared<const Curve>(
        Curve{Circle{make_frame(midpoint(through[0], through[32]), {0, 0, 1}, through[0] - through[32]),
                     0.5 * distance(through[0], through[32])}});
  }
  Coedge c;
  c.edge = body.add(edge);
  c.pcurve = pcurve;
  c.pcurve_range = r;
  return c;
}

Curve2 circle2(Uv centre, double radius, bool clockwise = false) {
  Frame f;
  f.origin = {centre.u, centre.v, 0};
  if (clockwise) f.y = {0, -1, 0}, f.z = {0, 0, -1};
  return {Curve{Circle{f, radius}}};
}

// A disc of parameters with a round hole in it.
struct Disc {
  Body body;
  FaceId face;
  Uv centre, hole;
  double radius, hole_radius;
  bool contains(Uv p, double by) const { return norm(p - centre) <= radius + by && norm(p - hole) >= hole_radius - by; }
};
Disc disc_of(SurfacePtr surface, Uv centre, double radius, bool with_curve = false) {
  Disc d{{}, {}, centre, centre + Uv{0.3 * radius, 0.1 * radius}, radius, 0.4 * radius};
  Face face;
  face.surface = surface;
  Loop outer, inner;
  outer.coedges = {closed_pcurve(d.body, circle2(d.centre, d.radius), with_curve, *surface)};
  inner.coedges = {closed_pcurve(d.body, circle2(d.hole, d.hole_radius, true), with_curve, *surface)};
  if (with_curve) {  // turn the hole's curve as its pcurve runs
    Edge& e = d.body[inner.coedges[0].edge];
    Circle c = std::get<Circle>(e.curve->shape);
    c.frame.y = -c.frame.y;
    c.frame.z = -c.frame.z;
    e.curve = std::make_shared<const Curve>(Curve{c});
  }
  face.loops = {d.body.add(outer), d.body.add(inner)};
  d.face = d.body.add(face);
  return d;
}

// Nearest of samples inside the disc, each improved by a descent that is taken only when it stays inside.
double reference(const Disc& d, const Surface& s, const std::vector<std::pair<Uv, Point>>& samples, Point p) {
  std::vector<std::pair<double, Uv>> near;
  for (const auto& [uv, q] : samples) near.emplace_back(distance(p, q), uv);
  std::partial_sort(near.begin(), near.begin() + 40, near.end(), [](auto a, auto b) { return a.first < b.first; });
  double best = near[0].first;
  for (int k = 0; k < 40; ++k) {
    const detail::Rectangle r = detail::rectangle(s);
    const SurfaceFoot foot = detail::descend(s, p, near[static_cast<std::size_t>(k)].second, r, 50, false);
    if (d.contains(foot.uv, 0)) best = std::min(best, foot.distance);
  }
  return best;
}

void ask(const Disc& d, Random& random, int queries, double reach) {
  const Surface& s = *d.body.faces[0].surface;
  const auto index = ClosestOnFace::make(d.body, d.face);
  BOOST_REQUIRE(index);
  std::vector<std::pair<Uv, Point>> samples;
  const auto add = [&](Uv uv) { samples.emplace_back(uv, evaluate(s, uv)); };
  for (int i = -80; i <= 80; ++i)
    for (int j = -80; j <= 80; ++j)
      if (const Uv uv = d.centre + Uv{d.radius * i / 80, d.radius * j / 80}; d.contains(uv, 0)) add(uv);
  for (int k = 0; k < 4000; ++k) {
    const Uv e{std::cos(two_pi * k / 4000), std::sin(two_pi * k / 4000)};
    add(d.centre + d.radius * e);
    add(d.hole + d.hole_radius * e);
  }
  for (int k = 0; k < queries; ++k) {
    const Point on = samples[static_cast<std::size_t>(random.integer(0, static_cast<int>(samples.size()) - 1))].second;
    const Point p = on + reach * Vector{random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)};
    const ClosestPoint found = index->nearest(p);
    BOOST_CHECK_LE(found.distance, reference(d, s, samples, p) + 1e-6);
    BOOST_CHECK(d.contains(found.uv, 1e-6 * d.radius));
    BOOST_CHECK_SMALL(distance(evaluate(s, found.uv), found.point), 2e-6);
    BOOST_CHECK_GE(found.lower, found.distance - 2e-6);
    BOOST_CHECK_LE(found.lower, found.distance);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(discs_with_a_hole_on_curved_surfaces) {
  Random random(41);
  const Frame frame = make_frame({1, 2, 3}, {0, 1, 1});
  const auto share = [](Surface s) { return std::make_shared<const Surface>(std::move(s)); };
  for (int round = 0; round < 12; ++round) {
    const NurbsSurface s = testing::sheet(random, 3, 3, 8, 8, round < 6 ? 1.0 : 5.0, round % 2 == 0);
    ask(disc_of(share({s}), {2.5, 2.5}, 2), random, 40, round % 3 == 0 ? 0.3 : 4);
  }
  ask(disc_of(share({Cylinder{frame, 3}}), {0.2, 1}, 2), random, 60, 2);  // over the seam
  ask(disc_of(share({Sphere{frame, 3}}), {1, 0.1}, 1.2), random, 60, 2);
  ask(disc_of(share({Torus{frame, 5, 2}}), {6, 3}, 1.5), random, 60, 2);
}

// build/dev/tests/test_kernel_closest --run_test=faces_long_run: 10 000 queries over 25 trimmed sheets
BOOST_AUTO_TEST_CASE(faces_long_run, *boost::unit_test::disabled()) {
  Random random(44);
  for (int round = 0; round < 25; ++round) {
    const NurbsSurface s = testing::sheet(random, 3, 3, 8, 8, round < 12 ? 1.0 : 5.0, round % 2 == 0);
    ask(disc_of(std::make_shared<const Surface>(Surface{s}), {2.5, 2.5}, 2), random, 400, round % 3 == 0 ? 0.3 : 4);
  }
}

BOOST_AUTO_TEST_CASE(a_plane_disc_has_a_closed_form) {
  Random random(42);
  Frame flat;
  const auto plane = std::make_shared<const Surface>(Surface{Plane{flat}});
  for (const bool with_curve : {false, true}) {
    const Disc d = disc_of(plane, {1, 2}, 5, with_curve);
    const auto index = ClosestOnFace::make(d.body, d.face).value();
    for (int k = 0; k < 400; ++k) {
      const Point p{random.real(-8, 8), random.real(-8, 8), random.real(-4, 4)};
      const double out =
          std::max({0.0, norm(Uv{p.x, p.y} - d.centre) - d.radius, d.hole_radius - norm(Uv{p.x, p.y} - d.hole)});
      const ClosestPoint found = index.nearest(p);
      const double tolerance = with_curve ? 1e-12 : 3e-7;  // an edge known only by its pcurve is approximated
      BOOST_CHECK_SMALL(found.distance - std::hypot(out, p.z), tolerance);
      BOOST_CHECK_SMALL(distance(evaluate(*plane, found.uv), found.point), tolerance);
      BOOST_CHECK_GE(found.lower, found.distance * (1 - 2e-11) - tolerance);
    }
  }
}

BOOST_AUTO_TEST_CASE(faces_without_loops_are_their_surface) {
  Body body;
  Face face;
  Frame frame = make_frame({1, 0, 0}, {0, 0, 1});
  face.surface = std::make_shared<const Surface>(Surface{Torus{frame, 5, 2}});
  const FaceId id = body.add(face);
  const auto index = ClosestOnFace::make(body, id).value();
  Random random(43);
  for (int k = 0; k < 200; ++k) {
    const Point p{random.real(-9, 9), random.real(-9, 9), random.real(-4, 4)};
    const double expected = std::abs(std::hypot(std::hypot(p.x - 1, p.y) - 5, p.z) - 2);
    BOOST_CHECK_SMALL(index.nearest(p).distance - expected, 1e-10);
  }
  body.faces[0].status = FaceStatus::Failed;
  BOOST_CHECK(!ClosestOnFace::make(body, id));
}
