// Points, derivatives, domains, normals and boxes of every surface type.

#include "kernel/geometry/surface.h"

#include <boost/test/unit_test.hpp>
#include <string>

#include "kernel/geometry/arc_length.h"
#include "shapes.h"

using namespace trimloop;
using namespace trimloop::test;

BOOST_AUTO_TEST_SUITE(surfaces)

BOOST_AUTO_TEST_CASE(elementary_surfaces_have_their_closed_forms) {
  const Frame f = tilted_frame();
  const double u = 0.7, v = 0.4;
  const Vector e = std::cos(u) * f.x + std::sin(u) * f.y;
  BOOST_TEST(distance(evaluate(Surface{Plane{f}}, {u, v}), f.origin + (u * f.x + v * f.y)) < 1e-15);
  BOOST_TEST(distance(evaluate(Surface{Cylinder{f, 3}}, {u, v}), f.origin + (3 * e + v * f.z)) < 1e-14);
  BOOST_TEST(distance(evaluate(Surface{Cone{f, 3, 0.5}}, {u, v}), f.origin + ((3 + v * std::tan(0.5)) * e + v * f.z)) <
             1e-14);
  BOOST_TEST(distance(evaluate(Surface{Sphere{f, 3}}, {u, v}),
                      f.origin + (3 * std::cos(v) * e + 3 * std::sin(v) * f.z)) < 1e-14);
  BOOST_TEST(distance(evaluate(Surface{Torus{f, 5, 2}}, {u, v}),
                      f.origin + ((5 + 2 * std::cos(v)) * e + 2 * std::sin(v) * f.z)) < 1e-14);
}

BOOST_AUTO_TEST_CASE(a_revolved_line_is_a_cylinder_and_a_revolved_circle_a_torus) {
  const Frame f = tilted_frame();
  const Surface cylinder{
      Revolution{f.origin, f.z, share(Line{f.origin + 3 * f.x, f.origin + (3 * f.x + f.z), {-2, 5}})}};
  const Surface torus{Revolution{f.origin, f.z, share(Circle{{f.origin + 5 * f.x, f.x, f.z, -f.y}, 2})}};
  for (const Uv p : {Uv{0, 0}, Uv{1, 2}, Uv{6, -1}}) {
    BOOST_TEST(distance(evaluate(cylinder, p), evaluate(Surface{Cylinder{f, 3}}, p)) < 1e-14);
    BOOST_TEST(distance(evaluate(torus, p), evaluate(Surface{Torus{f, 5, 2}}, p)) < 1e-14);
  }
  const SurfaceDomain d = domain(torus);
  BOOST_TEST(d.closed_v);
  BOOST_TEST(d.period_v == two_pi);
}

BOOST_AUTO_TEST_CASE(partial_derivatives_are_those_of_the_points) {
  for (const Patch& patch : every_patch()) {
    BOOST_TEST_CONTEXT(patch.name)
    for (const double a : {0.13, 0.44, 0.81})
      for (const double b : {0.23, 0.61}) {
        const Uv p{patch.u.at(a), patch.v.at(b)};
        const double h = 1e-5;
        const auto at = [&](double du, double dv) { return jet(patch.surface, {p.u + du, p.v + dv}); };
        const SurfaceJet j = at(0, 0);
        const double size = norm(j.duu) + norm(j.dvv) + 30;
        const auto difference = [&](Vector got, Vector hi, Vector lo) {
          BOOST_TEST(norm(got - (hi - lo) / (2 * h)) <= 1e-7 * size);
        };
        difference(j.du, to_vector(at(h, 0).point), to_vector(at(-h, 0).point));
        difference(j.dv, to_vector(at(0, h).point), to_vector(at(0, -h).point));
        difference(j.duu, at(h, 0).du, at(-h, 0).du);
        difference(j.duv, at(h, 0).dv, at(-h, 0).dv);
        difference(j.duv, at(0, h).du, at(0, -h).du);
        difference(j.dvv, at(0, h).dv, at(0, -h).dv);
        Point point;
        Vector du, dv;
        jet1(patch.surface, p, point, du, dv);
        BOOST_TEST(distance(point, evaluate(patch.surface, p)) <= 1e-13);
        BOOST_TEST(norm(du - j.du) <= 1e-13 * size);
        BOOST_TEST(norm(dv - j.dv) <= 1e-13 * size);
        const Vector n = normal(patch.surface, p);
        BOOST_TEST(std::abs(norm(n) - 1) < 1e-14);
        BOOST_TEST(norm(n - normalized(cross(du, dv))) < 1e-12);
      }
  }
}

BOOST_AUTO_TEST_CASE(a_ruled_surface_pairs_equal_lengths_when_asked) {
  // Arc length along the parabola y = x^2 from 0 to 1, against a line.
  const CurvePtr parabola = share(Parabola{{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}}, 0.25, {0, 2}});
  const CurvePtr line = share(Line{{0, 0, 5}, {1, 1, 5}});
  const Surface by_length{make_ruled(parabola, line, false, true)}, by_parameter{make_ruled(parabola, line)};
  const auto arc = [](double x) { return 0.5 * x * std::sqrt(1 + 4 * x * x) + 0.25 * std::asinh(2 * x); };
  for (const double u : {0.0, 0.2, 0.5, 0.9, 1.0}) {
    const Point p = evaluate(by_length, {u, 0});
    BOOST_TEST(arc(p.x) == u * arc(1), boost::test_tools::tolerance(1e-12));
    BOOST_TEST(std::abs(p.y - p.x * p.x) < 1e-14);
    BOOST_TEST(std::abs(evaluate(by_parameter, {u, 0}).x - u) < 1e-15);
    BOOST_TEST(distance(evaluate(by_length, {u, 1}), evaluate(*line, u)) < 1e-12);
  }
  Ruled bare = std::get<Ruled>(by_length.shape);
  bare.first_length = bare.second_length = nullptr;  // measured again each time
  BOOST_TEST(distance(evaluate(Surface{bare}, {0.3, 0.4}), evaluate(by_length, {0.3, 0.4})) == 0);
}

BOOST_AUTO_TEST_CASE(domains_tell_what_closes_and_what_collapses) {
  const Frame f = tilted_frame();
  const auto flags = [](const SurfaceDomain& d) {
    return std::string() + (d.closed_u ? 'U' : '-') + (d.closed_v ? 'V' : '-') + (d.pole_u_lo ? '1' : '-') +
           (d.pole_u_hi ? '2' : '-') + (d.pole_v_lo ? '3' : '-') + (d.pole_v_hi ? '4' : '-');
  };
  BOOST_TEST(flags(domain(Surface{Plane{f}})) == "------");
  BOOST_TEST(!domain(Surface{Plane{f}}).is_bounded());
  BOOST_TEST(flags(domain(Surface{Cylinder{f, 1}})) == "U-----");
  BOOST_TEST(flags(domain(Surface{Sphere{f, 1}})) == "U---34");
  BOOST_TEST(flags(domain(Surface{Torus{f, 3, 1}})) == "UV----");
  BOOST_TEST(flags(domain(Surface{Cone{f, 1, 0.3}})) == "U---3-");
  BOOST_TEST(flags(domain(Surface{Cone{f, 1, -0.3}})) == "U----4");
  BOOST_TEST(flags(domain(Surface{Cone{f, 1, 0}})) == "U-----");
  const double apex = domain(Surface{Cone{f, 1, 0.3}}).v.lo;
  BOOST_TEST(norm(jet(Surface{Cone{f, 1, 0.3}}, {1, apex}).du) < 1e-15);
  // A half circle turned about its diameter; a part of that turn; a line that ends on the axis.
  const CurvePtr half = share(Circle{{f.origin, f.x, f.z, -f.y}, 2, {-pi / 2, pi / 2}});
  BOOST_TEST(flags(domain(Surface{Revolution{f.origin, f.z, half}})) == "U---34");
  BOOST_TEST(flags(domain(Surface{Revolution{f.origin, f.z, half, {1, 2}}})) == "----34");
  const SurfaceDomain turned = domain(Surface{Revolution{f.origin, f.z, half, {1, 1 + two_pi - 2e-10}}});
  BOOST_TEST(turned.period_u == two_pi);
  BOOST_TEST(turned.u.length() == two_pi, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(flags(domain(Surface{Revolution{f.origin, f.z, share(Line{f.origin + f.x, f.origin + f.z})}})) ==
             "U----4");
  BOOST_TEST(flags(domain(Surface{Extrusion{share(Circle{f, 1}), f.z}})) == "U-----");
  BOOST_TEST(flags(domain(Surface{Extrusion{share(wavy_curve()), f.z}})) == "------");
  BOOST_TEST(flags(domain(Surface{make_ruled(share(Circle{f, 1}), share(Line{{1, 1, 9}, {1, 1, 9}}))})) == "U----4");
  BOOST_TEST(flags(domain(Surface{wavy_surface(1)})) == "------");
  // The same as NURBS.
  const auto nurbs = [&](const Surface& s) {
    const SurfaceDomain d = domain(s);
    return Surface{to_nurbs(s, d.u, d.v)->surface};
  };
  BOOST_TEST(flags(domain(nurbs(Surface{Sphere{f, 100}}))) == "U---34");
  BOOST_TEST(domain(nurbs(Surface{Sphere{f, 100}})).period_u == 0);
  BOOST_TEST(flags(domain(nurbs(Surface{Torus{f, 100, 9}}))) == "UV----");
  BOOST_TEST(flags(domain(nurbs(Surface{Revolution{f.origin, f.z, half, {1, 2}}}))) == "----34");
}

BOOST_AUTO_TEST_CASE(a_part_of_a_nurbs_is_judged_by_its_range) {
  const Frame f = tilted_frame();
  const NurbsSurface sphere = to_nurbs(Surface{Sphere{f, 10}}, {0, two_pi}, {-pi / 2, pi / 2})->surface;
  const auto part = NurbsSurface::from_homogeneous(2, 2, sphere.knots_u(), sphere.knots_v(), sphere.poles(),
                                                   Interval{0, two_pi}, Interval{-pi / 2, 1});
  BOOST_REQUIRE(part.has_value());
  const SurfaceDomain d = domain(Surface{*part});
  BOOST_TEST(d.closed_u);
  BOOST_TEST(d.pole_v_lo);
  BOOST_TEST(!d.pole_v_hi);
  BOOST_TEST(d.v.hi == 1);
}

BOOST_AUTO_TEST_CASE(the_normal_at_a_pole_is_the_limit) {
  const Frame f = tilted_frame();
  const CurvePtr half = share(Circle{{f.origin, f.x, f.z, -f.y}, 2, {-pi / 2, pi / 2}});
  const Surface sphere{Sphere{f, 2}}, revolved{Revolution{f.origin, f.z, half}};
  const Surface nurbs{to_nurbs(sphere, {0, two_pi}, {-pi / 2, pi / 2})->surface};
  for (const Surface& s : {sphere, revolved, nurbs})
    for (const double u : {0.0, 1.0, 4.0, two_pi}) {
      BOOST_TEST(norm(normal(s, {u, pi / 2}) - f.z) < 1e-9);
      BOOST_TEST(norm(normal(s, {u, -pi / 2}) + f.z) < 1e-9);
    }
  const Surface cone{Cone{f, 0, 0.3}};
  const Vector at_apex = normal(cone, {1, 0});
  BOOST_TEST(norm(at_apex - normal(cone, {1, 5})) < 1e-15);
  // All of a triangle's third side in one pole; and a patch that is a point has no normal.
  const std::vector<Point> triangle{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Surface collapsed{*NurbsSurface::from_cartesian(1, 1, {0, 0, 1, 1}, {0, 0, 1, 1}, triangle, {})};
  BOOST_TEST(norm(normal(collapsed, {0, 0.5}) - Vector{0, 0, 1}) < 1e-12);
  const std::vector<Point> point(4, Point{1, 2, 3});
  const Surface nothing{*NurbsSurface::from_cartesian(1, 1, {0, 0, 1, 1}, {0, 0, 1, 1}, point, {})};
  BOOST_TEST(norm(normal(nothing, {0.5, 0.5})) == 0);
}

BOOST_AUTO_TEST_CASE(the_normal_beside_repeated_poles_is_the_limit) {
  // A cylinder net whose end rows stand three times over uniform knots: Su is zero all along the side u = 0.
  std::vector<Point> poles;
  for (const double z : {0.0, 0.0, 0.0, 5.0, 10.0, 10.0, 10.0})
    for (int k = 0; k < 9; ++k) poles.push_back({std::cos(k * pi / 3), std::sin(k * pi / 3), z});
  std::vector<double> u, v;
  for (int i = 0; i < 11; ++i) u.push_back(i - 3);
  for (int i = 0; i < 13; ++i) v.push_back(i - 3);
  const Surface s{*NurbsSurface::from_cartesian(3, 3, u, v, poles, {})};
  for (const double at : {0.0, 1.7, 3.0}) {
    const Vector end = normal(s, {0, at}), inside = normal(s, {1e-3, at});
    BOOST_TEST(norm(end) > 0.5);
    BOOST_TEST(norm(end - inside) <= 1e-5);
  }
}

BOOST_AUTO_TEST_CASE(degenerate_surfaces_answer_without_harm) {
  const Frame f;
  const CurvePtr dot = share(Line{{1, 1, 1}, {1, 1, 1}});
  for (const Surface& s :
       {Surface{Sphere{f, 0}}, Surface{Cylinder{f, 0}}, Surface{Torus{f, 0, 1}}, Surface{Torus{f, 1, 0}},
        Surface{Extrusion{}}, Surface{Revolution{}}, Surface{Ruled{}}, Surface{OffsetSurface{}},
        Surface{Extrusion{dot, {0, 0, 0}}}, Surface{Revolution{{1, 1, 1}, {0, 0, 1}, dot}},
        Surface{make_ruled(dot, dot, false, true)}, Surface{OffsetSurface{share_surface(Sphere{f, 1}), -1}}}) {
    BOOST_TEST_CONTEXT("shape " << s.shape.index()) {
      const SurfaceDomain d = domain(s);
      BOOST_TEST(is_finite(evaluate(s, {d.u.clamp(0.3), d.v.clamp(0.3)})));
      BOOST_TEST(is_finite(normal(s, {d.u.clamp(0.3), d.v.clamp(0.3)})));
      BOOST_TEST(std::isfinite(closest_point(s, {3, 2, 1}).distance));
      BOOST_TEST(std::isfinite(closest_point_near(s, {3, 2, 1}, {0.1, 0.1}).distance));
      const Box box = bounding_box(s, {0, 1}, {0, 1});
      BOOST_TEST((box.empty() || (is_finite(box.lo) && is_finite(box.hi))));
    }
  }
}

BOOST_AUTO_TEST_CASE(breaks_are_where_smoothness_ends) {
  BOOST_TEST(breaks_u(Surface{Plane{}}).empty());
  BOOST_TEST(breaks_u(Surface{Cylinder{}}).size() == 2u);
  BOOST_TEST(breaks_v(Surface{Cylinder{}}).empty());
  BOOST_TEST(breaks_u(Surface{wavy_surface(1)}).size() == 4u);
  BOOST_TEST(breaks_v(Surface{wavy_surface(1)}).size() == 5u);
  const CurvePtr polyline = share(Polyline{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {3, 1, 0}}});
  const Surface ruled{make_ruled(polyline, share(Polyline{{{0, 0, 2}, {1, 0, 2}, {1, 1, 2}}}), true)};
  const std::vector<double> expected{0, 1.0 / 3, 0.5, 2.0 / 3, 1};
  const std::vector<double> got = breaks_u(ruled);
  BOOST_TEST(got == expected, boost::test_tools::per_element());
  const std::vector<double> by_length = breaks_u(Surface{make_ruled(polyline, polyline, false, true)});
  BOOST_REQUIRE(by_length.size() == 4u);
  BOOST_TEST(by_length[1] == 0.25, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(boxes_enclose_and_are_not_much_too_large) {
  for (const Patch& patch : every_patch()) {
    BOOST_TEST_CONTEXT(patch.name)
    for (const double shrink : {0.0, 0.2}) {
      const Interval u{patch.u.at(shrink), patch.u.at(1 - shrink)}, v{patch.v.at(shrink), patch.v.at(1 - shrink)};
      const Box box = bounding_box(patch.surface, u, v);
      Box seen;
      for (int i = 0; i <= 60; ++i)
        for (int k = 0; k <= 60; ++k) seen.add(evaluate(patch.surface, {u.at(i / 60.0), v.at(k / 60.0)}));
      BOOST_TEST((box.lo.x <= seen.lo.x && box.lo.y <= seen.lo.y && box.lo.z <= seen.lo.z));
      BOOST_TEST((box.hi.x >= seen.hi.x && box.hi.y >= seen.hi.y && box.hi.z >= seen.hi.z));
      BOOST_TEST(box.diagonal() <= 1.5 * seen.diagonal());
    }
  }
}

BOOST_AUTO_TEST_CASE(boxes_of_elementary_patches_are_tight) {
  const Frame f = tilted_frame();
  const Box sphere = bounding_box(Surface{Sphere{f, 2}}, {0, two_pi}, {-pi / 2, pi / 2});
  BOOST_TEST(distance(sphere.lo, f.origin - Vector{2, 2, 2}) < 1e-13);
  BOOST_TEST(distance(sphere.hi, f.origin + Vector{2, 2, 2}) < 1e-13);
  // A torus reaches R sqrt(1 - c^2) + r along a direction with cosine c to its axis.
  const Box torus = bounding_box(Surface{Torus{f, 5, 2}}, {0, two_pi}, {0, two_pi});
  BOOST_TEST(torus.hi.x - f.origin.x == 5 * std::sqrt(1 - f.z.x * f.z.x) + 2, boost::test_tools::tolerance(1e-13));
  BOOST_TEST(f.origin.z - torus.lo.z == 5 * std::sqrt(1 - f.z.z * f.z.z) + 2, boost::test_tools::tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE(boxes_of_curves_enclose) {
  for (const Curve& c : every_curve()) {
    const Box box = bounding_box(c);
    Box seen;
    for (int i = 0; i <= 2000; ++i) seen.add(evaluate(c, range(c).at(i / 2000.0)));
    BOOST_TEST((box.lo.x <= seen.lo.x && box.lo.y <= seen.lo.y && box.lo.z <= seen.lo.z));
    BOOST_TEST((box.hi.x >= seen.hi.x && box.hi.y >= seen.hi.y && box.hi.z >= seen.hi.z));
    BOOST_TEST(box.diagonal() <= 1.8 * seen.diagonal());
  }
}

BOOST_AUTO_TEST_SUITE_END()
