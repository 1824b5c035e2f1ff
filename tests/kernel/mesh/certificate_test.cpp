#include "kernel/mesh/certificate.h"

#include <boost/test/unit_test.hpp>
#include <random>

#include "kernel/mesh/certify.h"
#include "kernel/mesh/tessellate.h"
#include "tests/kernel/mesh/bodies.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

// Largest of many distances from S over a triangle of the parameter plane to the facet.
double sampled(const Surface& s, const std::array<Uv, 3>& d, const mesh::Facet& f) {
  double worst = 0;
  constexpr int n = 24;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j) {
      const double a = i / double{n}, b = j / double{n};
      worst = std::max(worst, distance(evaluate(s, a * d[0] + b * d[1] + (1 - a - b) * d[2]), f));
    }
  return worst;
}

// Random triangles of all sizes and shapes over a rectangle: the bound must hold on each; the median ratio is returned.
double median_ratio(const Surface& s, Interval u, Interval v, double size) {
  std::mt19937_64 random(7);
  const auto unit = [&] { return std::ldexp(static_cast<double>(random() >> 11), -53); };
  mesh::Certificate certificate(s, u, v);
  BOOST_REQUIRE(certificate.proves());
  std::vector<double> ratios;
  for (int k = 0; k < 400; ++k) {
    const double r = size * std::pow(0.1, 2 * unit());
    const Uv at{u.lo + (1 - r) * u.length() * unit(), v.lo + (1 - r) * v.length() * unit()};
    std::array<Uv, 3> d;
    for (Uv& p : d) p = at + Uv{r * u.length() * unit(), r * v.length() * unit()};
    const mesh::Facet f(evaluate(s, d[0]), evaluate(s, d[1]), evaluate(s, d[2]));
    const double measured = sampled(s, d, f), bound = certificate.bound(d, {&f, 1}, {0, 1.05, 8});
    BOOST_REQUIRE_GE(bound, measured);
    if (measured > 1e-9) ratios.push_back(bound / measured);
  }
  std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2), ratios.end());
  return ratios[ratios.size() / 2];
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_bound_holds_and_is_close_on_every_kind_of_surface) {
  const NurbsSurface wavy = wavy_patch(12, 30, 4), torus = nurbs_torus(10, 3);
  const Interval turn{0, two_pi};
  BOOST_CHECK_LT(median_ratio({Cylinder{{}, 10}}, turn, {0, 20}, 0.2), 1.1);
  BOOST_CHECK_LT(median_ratio({Cone{{}, 2, 0.4}}, turn, {0, 20}, 0.2), 1.1);
  BOOST_CHECK_LT(median_ratio({Sphere{{}, 10}}, turn, {-1.5, 1.5}, 0.2), 1.1);
  BOOST_CHECK_LT(median_ratio({Torus{{}, 10, 3}}, turn, turn, 0.2), 1.1);
  BOOST_CHECK_LT(median_ratio({wavy}, wavy.range_u(), wavy.range_v(), 0.2), 1.1);
  BOOST_CHECK_LT(median_ratio({torus}, torus.range_u(), torus.range_v(), 0.2), 1.1);
  const auto circle = std::make_shared<const Curve>(Curve{Circle{{{5, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}}, 2}});
  BOOST_CHECK_LT(median_ratio({Revolution{{}, {0, 0, 1}, circle}}, turn, turn, 0.2), 1.1);
  BOOST_CHECK_LT(median_ratio({Extrusion{circle, {0, 1, 0.2}, {0, 5}}}, turn, {0, 5}, 0.2), 1.1);
  const auto line = std::make_shared<const Curve>(Curve{Line{{0, 0, 5}, {4, 7, 6}}});
  BOOST_CHECK_LT(median_ratio({make_ruled(circle, line)}, {0, 1}, {0, 1}, 0.2), 1.1);
}

BOOST_AUTO_TEST_CASE(creases_inside_a_triangle_are_seen) {
  // A roof over two spans of degree 1: nothing between the knots tells of the ridge.
  const std::vector<Point> poles{{0, 0, 0}, {0, 1, 0}, {1, 0, 0.5}, {1, 1, 0.5}, {2, 0, 0}, {2, 1, 0}};
  const auto roof = NurbsSurface::from_cartesian(1, 1, {0, 0, 1, 2, 2}, {0, 0, 1, 1}, poles, {});
  BOOST_REQUIRE(roof);
  const Surface s{*roof};
  mesh::Certificate certificate(s, {0, 2}, {0, 1});
  const std::array<Uv, 3> d{Uv{0, 0}, Uv{2, 0}, Uv{2, 1}};
  BOOST_CHECK(certificate.crosses_crease(d));
  const mesh::Facet f({0, 0, 0}, {2, 0, 0}, {2, 1, 0});
  const double bound = certificate.bound(d, {&f, 1}, {});
  BOOST_CHECK_GE(bound, 0.5);
  BOOST_CHECK_LT(bound, 0.51);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_enclosed_is_said) {
  const auto basis = std::make_shared<const Surface>(Surface{Sphere{{}, 10}});
  mesh::Certificate offset({OffsetSurface{basis, 1}}, {0, 1}, {0, 1});
  BOOST_CHECK(!offset.proves());
}

BOOST_AUTO_TEST_CASE(chords_of_curves_are_bounded) {
  const Curve circle{Circle{{}, 10}};
  for (const double t : {0.5, 0.1, 0.01}) {
    const double bow = 10 * (1 - std::cos(t / 2)), bound = mesh::chord_bound(circle, {0, t}, evaluate(circle, 0), evaluate(circle, t));
    BOOST_CHECK_GE(bound, bow);
    BOOST_CHECK_LT(bound, bow * (1 + 0.2 * t) + 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(proven_meshes_are_within_their_deflection) {
  const NurbsSurface wavy = wavy_patch(12, 30, 4);
  const Interval turn{0, two_pi};
  const std::vector<Body> bodies{patch({Sphere{{}, 10}}, turn, {-pi / 2, pi / 2}), patch({wavy}, wavy.range_u(), wavy.range_v()),
                                 capped_cylinder(10, 20)};
  for (const Body& body : bodies) {
    mesh::TessellationOptions options;
    options.deflection_mm = 0.05;
    options.prove = true;
    const auto made = mesh::tessellate(body, options);
    BOOST_REQUIRE(made);
    const std::vector<mesh::FaceBounds> bounds = mesh::certify(body, *made, {options.deflection_mm, 1, 8});
    for (std::size_t f = 0; f < made->faces.size(); ++f) {
      BOOST_CHECK(made->faces[f].bound_kind == mesh::BoundKind::Proven);
      BOOST_CHECK(made->faces[f].deflection_met);
      BOOST_CHECK_LE(bounds[f].largest(), options.deflection_mm);
    }
  }
}
