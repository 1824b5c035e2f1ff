// Analytic shapes, made into NURBS and disguised, are found again with their parameters to 1e-12, and the maps agree.
#include "kernel/geometry/recognize.h"

#include <boost/test/unit_test.hpp>

#include "kernel/nurbs/construct_conic.h"
#include "kernel/nurbs/reparametrize.h"
#include "shapes.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

double near_one(double got, double wanted) { return std::abs(got - wanted) / std::abs(wanted); }

// As converted, refined, elevated, reparametrized: the same shape in other clothes.
std::vector<NurbsCurve> disguises(const NurbsCurve& c) {
  std::vector<NurbsCurve> out{c, refine(c, std::vector<double>{c.range().at(0.3), c.range().at(0.61)}), elevate(c, 1),
                              elevate(c, 3)};
  if (const auto m = moebius(c, 1.7)) out.push_back(*m);
  out.push_back(reparametrized(c, {-2, 5}));
  return out;
}

void maps_agree(const NurbsCurve& c, const RecognizedCurve& r) {
  const double size = 10;
  for (int i = 0; i <= 40; ++i) {
    const double s = c.range().at(i / 40.0), t = r.relation.to_analytic(s);
    BOOST_TEST(distance(evaluate(c, s), evaluate(r.curve, t)) < 1e-12 * size);
    BOOST_TEST(std::abs(r.relation.to_nurbs(t) - s) < 1e-12 * (1 + std::abs(s)) * 10);
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(recognition)

BOOST_AUTO_TEST_CASE(curves_are_found_again_with_their_parameters) {
  const Frame f = tilted_frame();
  for (const Interval arc : {Interval{0, two_pi}, Interval{0.5, 2}, Interval{-1, 3.5}, Interval{1, 1.4}}) {
    for (const NurbsCurve& c : disguises(to_nurbs(Curve{Circle{f, 3, arc}})->curve)) {
      const auto r = recognize(c);
      BOOST_TEST_REQUIRE(r.has_value());
      const auto* k = std::get_if<Circle>(&r->curve.shape);
      BOOST_TEST_REQUIRE(k != nullptr);
      BOOST_TEST(near_one(k->radius, 3) < 1e-12);
      BOOST_TEST(distance(k->frame.origin, f.origin) < 3e-12);
      BOOST_TEST(norm(k->frame.z - f.z) < 1e-12);
      BOOST_TEST(std::abs(k->range.length() - arc.length()) < 1e-12 * 6);
      maps_agree(c, *r);
    }
    for (const NurbsCurve& c : disguises(to_nurbs(Curve{Ellipse{f, 5, 3, arc}})->curve)) {
      const auto r = recognize(c);
      BOOST_TEST_REQUIRE(r.has_value());
      const auto* e = std::get_if<Ellipse>(&r->curve.shape);
      BOOST_TEST_REQUIRE(e != nullptr);
      // A short arc says less about the whole ellipse.
      const double ill = arc.length() < 1 ? 100 : 1;
      BOOST_TEST(near_one(std::max(e->a, e->b), 5) < 1e-12 * ill);
      BOOST_TEST(near_one(std::min(e->a, e->b), 3) < 1e-12 * ill);
      BOOST_TEST(distance(e->frame.origin, f.origin) < 3e-12 * ill);
      maps_agree(c, *r);
    }
  }
  for (const NurbsCurve& c : disguises(to_nurbs(Curve{Parabola{f, 2, {-1, 2}}})->curve)) {
    const auto r = recognize(c);
    BOOST_TEST_REQUIRE((r && std::holds_alternative<Parabola>(r->curve.shape)));
    BOOST_TEST(near_one(std::get<Parabola>(r->curve.shape).focal_length, 2) < 1e-12);
    BOOST_TEST(distance(std::get<Parabola>(r->curve.shape).frame.origin, f.origin) < 1e-11);
    maps_agree(c, *r);
  }
  for (const NurbsCurve& c : disguises(to_nurbs(Curve{Hyperbola{f, 2, 1, {-0.5, 1.2}}})->curve)) {
    const auto r = recognize(c);
    BOOST_TEST_REQUIRE((r && std::holds_alternative<Hyperbola>(r->curve.shape)));
    BOOST_TEST(near_one(std::get<Hyperbola>(r->curve.shape).a, 2) < 1e-11);
    BOOST_TEST(near_one(std::get<Hyperbola>(r->curve.shape).b, 1) < 1e-11);
    maps_agree(c, *r);
  }
  for (const NurbsCurve& c : disguises(to_nurbs(Curve{Line{{1, 2, 3}, {4, -1, 2}}})->curve)) {
    const auto r = recognize(c);
    BOOST_TEST_REQUIRE((r && std::holds_alternative<Line>(r->curve.shape)));
    maps_agree(c, *r);
  }
  BOOST_TEST(std::holds_alternative<Circle>(recognize(quintic_circle(f, 4).value())->curve.shape));
  BOOST_TEST(std::holds_alternative<Circle>(recognize(rational_quarter_circle(f, 4).value())->curve.shape));
}

BOOST_AUTO_TEST_CASE(what_is_no_conic_is_not_called_one) {
  BOOST_TEST(!recognize(wavy_curve()).has_value());
  const NurbsCurve circle = to_nurbs(Curve{Circle{{}, 3}})->curve;
  std::vector<Hpoint> poles = circle.poles();
  poles[3].x += 1e-9;  // a thousand times the tolerance
  const NurbsCurve dented = NurbsCurve::from_homogeneous(2, circle.knots(), poles).value();
  BOOST_TEST(!recognize(dented).has_value());
  BOOST_TEST(recognize(dented, 1e-8).has_value());
  // Twice round is not a circle's range; there and back again no line.
  const std::vector<Point> back{{0, 0, 0}, {2, 0, 0}, {1, 0, 0}};
  BOOST_TEST(!recognize(NurbsCurve::from_cartesian(2, {0, 0, 0, 1, 1, 1}, back, {}).value()).has_value());
}

BOOST_AUTO_TEST_CASE(surfaces_are_found_again_with_their_parameters) {
  const Frame f = tilted_frame();
  const auto disguise = [](const NurbsSurface& s) {
    return std::vector<NurbsSurface>{s,
                                     swapped(s),
                                     elevate(s, 1, 1),
                                     refine_u(s, std::vector<double>{s.range_u().at(0.37)}),
                                     reversed_u(s),
                                     swapped(reversed_u(swapped(s)))};
  };
  const auto check = [&](const Surface& shape, Interval u, Interval v, auto verify) {
    for (const NurbsSurface& n : disguise(to_nurbs(shape, u, v)->surface)) {
      const auto r = recognize(n);
      BOOST_TEST_REQUIRE(r.has_value());
      BOOST_TEST(r->surface.shape.index() == shape.shape.index());
      verify(r->surface);
      for (int i = 0; i <= 6; ++i)
        for (int k = 0; k <= 6; ++k) {
          const Uv at{n.range_u().at(i / 6.0), n.range_v().at(k / 6.0)}, own = map_to_analytic(*r, at);
          BOOST_TEST(distance(evaluate(n, at), evaluate(r->surface, own)) < 1e-11);
          const Uv back = map_to_nurbs(*r, own);
          if (norm(cross(jet(n, at).du, jet(n, at).dv)) > 1e-3) BOOST_TEST(norm(back - at) < 1e-10);
        }
    }
  };
  check(Surface{Plane{f}}, {-1, 2}, {0, 3}, [&](const Surface& s) {
    const Frame& g = std::get<Plane>(s.shape).frame;
    BOOST_TEST(norm(cross(g.z, f.z)) < 1e-12);
    BOOST_TEST(std::abs(dot(g.origin - f.origin, f.z)) < 1e-12);
  });
  check(Surface{Cylinder{f, 3}}, {0.3, 4}, {-1, 2}, [&](const Surface& s) {
    BOOST_TEST(near_one(std::get<Cylinder>(s.shape).radius, 3) < 1e-12);
    BOOST_TEST(norm(cross(std::get<Cylinder>(s.shape).frame.z, f.z)) < 1e-12);
  });
  check(Surface{Cone{f, 3, 0.4}}, {0, two_pi}, {-1, 2}, [&](const Surface& s) {
    BOOST_TEST(std::abs(std::abs(std::get<Cone>(s.shape).half_angle_rad) - 0.4) < 1e-12);
  });
  check(Surface{Sphere{f, 4}}, {0, two_pi}, {-0.5 * pi, 0.5 * pi}, [&](const Surface& s) {
    BOOST_TEST(near_one(std::get<Sphere>(s.shape).radius, 4) < 1e-12);
    BOOST_TEST(distance(std::get<Sphere>(s.shape).frame.origin, f.origin) < 1e-11);
  });
  check(Surface{Torus{f, 5, 2}}, {0, two_pi}, {0, two_pi}, [&](const Surface& s) {
    BOOST_TEST(near_one(std::get<Torus>(s.shape).major_radius, 5) < 1e-12);
    BOOST_TEST(near_one(std::get<Torus>(s.shape).minor_radius, 2) < 1e-12);
  });
  check(Surface{Torus{f, 5, 2}}, {1, 3}, {2, 3.5}, [](const Surface&) {});
  check(Surface{Revolution{f.origin, f.z, share(wavy_curve()), {0, two_pi}}}, {0, two_pi}, {0, 4},
        [&](const Surface& s) { BOOST_TEST(norm(cross(std::get<Revolution>(s.shape).axis, f.z)) < 1e-12); });
  check(Surface{Extrusion{share(wavy_curve()), {1, 2, 3}, {0, 1}}}, {0, 4}, {0, 1}, [](const Surface&) {});
  check(Surface{make_ruled(share(wavy_curve()), share(Line{{0, 5, 5}, {8, 6, 5}}))}, {0, 1}, {0, 1},
        [](const Surface&) {});
  BOOST_TEST(!recognize(wavy_surface(3)).has_value());
}

BOOST_AUTO_TEST_SUITE_END()
