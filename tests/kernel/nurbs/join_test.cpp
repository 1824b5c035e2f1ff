// Joints of each order told apart; joining, extending, periodic forms, bounds of removal and reduction.
#include "kernel/nurbs/join.h"

#include <boost/test/unit_test.hpp>

#include "kernel/math/transform.h"
#include "kernel/nurbs/bezier.h"
#include "kernel/nurbs/construct_conic.h"
#include "kernel/nurbs/deviation.h"
#include "kernel/nurbs/periodic.h"
#include "kernel/nurbs/reduction.h"
#include "kernel/nurbs/removal.h"
#include "kernel/nurbs/reparametrize.h"
#include "tests/kernel/nurbs/random_nurbs.h"

using namespace trimloop;
using testing::Random;

namespace {

NurbsCurve bezier(const std::vector<Point>& points, Interval over = {0, 1}) {
  std::vector<double> knots(points.size(), over.lo);
  knots.insert(knots.end(), points.size(), over.hi);
  return NurbsCurve::from_cartesian(static_cast<int>(points.size()) - 1, knots, points, {}).value();
}

double largest_distance(const NurbsCurve& a, const NurbsCurve& b, Interval over) {
  double worst = 0;
  for (int i = 0; i <= 500; ++i)
    worst = std::max(worst, distance(evaluate(a, over.at(i / 500.0)), evaluate(b, over.at(i / 500.0))));
  return worst;
}

double largest_coordinate(const NurbsCurve& c) {
  double out = 0;
  for (const Hpoint& h : c.poles()) out = std::max({out, std::abs(h.x), std::abs(h.y), std::abs(h.z), std::abs(h.w)});
  return out;
}

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v.empty() ? 0 : v[v.size() / 2];
}

}  // namespace

BOOST_AUTO_TEST_SUITE(joints)

BOOST_AUTO_TEST_CASE(each_order_of_continuity_is_told) {
  const NurbsCurve a = bezier({{0, 0}, {1, 0}, {2, 1}, {3, 1}});
  const auto after = [&](const std::vector<Point>& p, Interval over = {1, 2}) { return joint(a, bezier(p, over)); };
  BOOST_TEST(after({{3.1, 1}, {4, 1}, {5, 2}, {6, 2}}).parametric == -1);
  const Joint corner = after({{3, 1}, {3, 2}, {4, 3}, {5, 3}});
  BOOST_TEST(corner.parametric == 0);
  BOOST_TEST(corner.geometric == 0);
  BOOST_TEST(std::abs(corner.tangent_angle_rad - 0.5 * pi) < 1e-12);
  const Joint tangent = after({{3, 1}, {5, 1}, {6, 3}, {7, 3}});  // twice the speed
  BOOST_TEST(tangent.parametric == 0);
  BOOST_TEST(tangent.geometric == 1);
  const Joint smooth = after({{3, 1}, {4, 1}, {5, 4}, {6, 2}});
  BOOST_TEST(smooth.parametric == 1);
  BOOST_TEST(smooth.geometric == 1);
  // Mirrored with the curvature kept: C2; and the same osculating circle at another speed: G2 only.
  const Joint c2 = after({{3, 1}, {4, 1}, {5, 0}, {6, 5}});
  BOOST_TEST(c2.parametric == 2);
  const Joint g2 = after({{3, 1}, {4, 1}, {5, 0}, {6, 5}}, {1, 3});
  BOOST_TEST(g2.parametric == 0);
  BOOST_TEST(g2.geometric == 2);
  BOOST_TEST(after({{3, 1}, {2, 1}, {1, 1}, {0, 1}}).opposed);
  BOOST_TEST(after({{3, 1}, {3, 1}, {4, 4}, {5, 5}}).at_rest);
}

BOOST_AUTO_TEST_CASE(loss_of_continuity_at_knots_and_cusps_are_reported) {
  Random random(301);
  for (int m = 1; m <= 4; ++m) {
    std::vector<double> knots(5, 0.0);
    knots.insert(knots.end(), static_cast<std::size_t>(m), 1.0);
    knots.insert(knots.end(), 5, 2.0);
    const NurbsCurve c =
        NurbsCurve::from_homogeneous(4, knots, random.poles(5 + static_cast<std::size_t>(m), false)).value();
    const Continuity k = continuity(c);
    BOOST_TEST(k.knots.size() == 1u);
    BOOST_TEST(k.knots[0].multiplicity == m);
    BOOST_TEST(k.parametric == 4 - m);
  }
  // The cubic whose polygon crosses itself so that the curve has a cusp in the middle: y even, x with a double zero of
  // x'.
  const NurbsCurve cusp = bezier({{0, 0}, {1, 1}, {0, 1}, {1, 0}});
  const Continuity k = continuity(cusp);
  BOOST_TEST_REQUIRE(k.cusps.size() == 1u);
  BOOST_TEST(std::abs(k.cusps[0] - 0.5) < 1e-6);
  BOOST_TEST(continuity(bezier({{0, 0}, {1, 1}, {2, 1}, {3, 0}})).cusps.empty());
}

BOOST_AUTO_TEST_CASE(surface_joints_are_told) {
  const std::vector<double> k{0, 0, 0, 1, 1, 1};
  const auto patch = [&](double lift, double bend, double shift) {
    std::vector<Point> p;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) p.push_back({shift + i, 1.0 * j, (i == 1 ? lift : i == 2 ? 2 * lift + bend : 0)});
    return NurbsSurface::from_cartesian(2, 2, k, k, p, {}).value();
  };
  const NurbsSurface a = reversed_u(patch(0, 1, 0));  // ends flat at u = 1
  const auto mirrored = [](const NurbsSurface& s) {
    Transform m = Transform::translation({0, 0, 0});
    m.r[0][0] = -1;
    return transformed(s, m);
  };
  const NurbsSurface left = mirrored(a);
  BOOST_TEST(joint_along_u(left, patch(0, 1, 0)).geometric == 2);
  BOOST_TEST(joint_along_u(left, patch(0, 3, 0)).geometric == 1);
  BOOST_TEST(joint_along_u(left, patch(1, 0, 0)).geometric == 0);
  BOOST_TEST(joint_along_u(left, patch(0, 1, 0.5)).geometric == -1);
}

BOOST_AUTO_TEST_CASE(split_curves_join_to_what_they_were) {
  Random random(302);
  for (int i = 0; i < 60; ++i) {
    const NurbsCurve c = random.curve(random.integer(1, 5), i % 2);
    const double t = c.range().at(random.real(0.2, 0.8));
    const auto [a, b] = split(c, t);
    const Joined j = join(a, b, 1e-9).value();
    BOOST_TEST(largest_distance(c, j.curve, c.range()) <= j.deviation + 1e-11);
    if (!std::binary_search(c.knots().begin(), c.knots().end(), t)) BOOST_TEST(j.continuity == c.degree() - 1);
    // Over a gap, closed half way from either side.
    const NurbsCurve away = transformed(b, Transform::translation({0, 0, 1e-3}));
    BOOST_TEST(!join(a, away, 1e-4).has_value());
    const Joined g = join(a, away, 1e-2).value();
    BOOST_TEST(largest_distance(a, g.curve, a.range()) <= g.deviation);
    BOOST_TEST(largest_distance(away, g.curve, {t, c.range().hi}) <= g.deviation);
    BOOST_TEST(g.deviation <= 1e-2);
  }
}

BOOST_AUTO_TEST_CASE(extensions_go_on_as_they_were) {
  Random random(303);
  for (int i = 0; i < 40; ++i) {
    const NurbsCurve c = random.curve(random.integer(1, 5), i % 2);
    const double by = 0.1 * c.range().length();
    for (const End end : {End::Start, End::Finish}) {
      const auto longer = extended(c, end, by);
      BOOST_TEST_REQUIRE(longer.has_value());
      BOOST_TEST(longer->range().length() > c.range().length());
      // Poles beyond a short span may lie far out.
      BOOST_TEST(largest_distance(c, *longer, c.range()) < 1e-12 * (10 + largest_coordinate(*longer)));
      // No knot is there where the new part begins: it is the same polynomial.
      const double t = end == End::Start ? c.range().lo : c.range().hi;
      BOOST_TEST(!std::binary_search(longer->knots().begin(), longer->knots().end(), t));
    }
  }
  const NurbsSurface s = random.surface(3, 2, true);
  const NurbsSurface wide = extended_v(s, End::Finish, 0.1 * s.range_v().length()).value();
  for (int i = 0; i < 20; ++i) {
    const Uv at{random.in(s.domain_u()), random.in(s.domain_v())};
    BOOST_TEST(distance(evaluate(s, at), evaluate(wide, at)) < 1e-10);
  }
  BOOST_TEST(!extended(random.curve(2, false), End::Start, -1).has_value());
}

BOOST_AUTO_TEST_CASE(periodic_and_clamped_forms_are_the_same_curve) {
  Random random(304);
  for (int p = 1; p <= 5; ++p) {
    const std::vector<double> period{0, 1, 1.5, 2.25, 3, 4.5, 5, 6};
    const NurbsCurve ring = from_periodic(p, period, random.poles(7, p % 2)).value();
    BOOST_TEST(is_periodic_form(ring));
    const NurbsCurve cut = clamped(ring);
    BOOST_TEST(!is_periodic_form(cut));
    const PeriodicForm again = periodic(cut, 1e-9).value();
    BOOST_TEST(again.continuity == p - 1);
    BOOST_TEST(is_periodic_form(again.curve, 1e-12));
    BOOST_TEST(again.curve.knots() == ring.knots(), boost::test_tools::per_element());
    for (std::size_t i = 0; i < ring.poles().size(); ++i)
      BOOST_TEST(distance(project(ring.poles()[i]), project(again.curve.poles()[i])) < 1e-9);
    BOOST_TEST(largest_distance(ring, again.curve, ring.domain()) <= again.deviation + 1e-12);
  }
  // A circle of quadratic arcs closes with a corner in its weights: C0 only, as homogeneous curve.
  const PeriodicForm circle = periodic(circle_arc({}, 2, {0, two_pi}).value(), 1e-9).value();
  BOOST_TEST(circle.continuity >= 0);
  BOOST_TEST(!periodic(random.curve(3, false), 1e-6).has_value());
  // Nets of a cylinder and a torus (seed 001).
  std::vector<Hpoint> tube;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 4; ++j) tube.push_back({std::cos(i), std::sin(i), 1.0 * j, 1});
  const std::vector<double> around{0, 1, 2, 3, 4, 5, 6}, along{0, 0, 0, 0, 1, 1, 1, 1}, ring{0, 1, 2, 3, 4};
  const NurbsSurface cylinder = from_periodic(3, 3, around, along, tube, true, false).value();
  const NurbsSurface torus = from_periodic(3, 3, around, ring, tube, true, true).value();
  for (const NurbsSurface* s : {&cylinder, &torus})
    for (int i = 0; i <= 10; ++i) {
      const double v = s->domain_v().at(i / 10.0);
      const SurfaceJet a = jet(*s, {0, v}), b = jet(*s, {6, v});
      BOOST_TEST(distance(a.point, b.point) < 1e-14);
      BOOST_TEST(norm(a.du - b.du) + norm(a.duu - b.duu) < 1e-12);
    }
  const PeriodicSurface closed = periodic_u(clamped(torus), 1e-9).value();
  BOOST_TEST(closed.continuity == 2);
}

BOOST_AUTO_TEST_CASE(bounds_of_removal_and_reduction_hold) {
  Random random(305);
  std::vector<double> of_removal, of_reduction;  // bound over what was seen
  for (int i = 0; i < 150; ++i) {
    const NurbsCurve c = trimmed(random.curve(random.integer(2, 6), i % 2), {-infinity, infinity});
    const std::vector<double> at = breaks(c);
    if (at.size() > 2) {
      const KnotRemoval r = remove_knot(c, at[1], 1, infinity);
      BOOST_TEST(r.removed == 1);
      const double seen = largest_distance(c, r.curve, c.range());
      BOOST_TEST(seen <= r.error);
      BOOST_TEST(removal_bound(c, at[1]) == r.error);
      if (r.error < infinity && seen > 1e-10) of_removal.push_back(r.error / seen);
    }
    const Reduction d = reduce(c, 1).value();
    BOOST_TEST(d.curve.degree() == c.degree() - 1);
    const double seen = largest_distance(c, d.curve, c.range());
    BOOST_TEST(seen <= d.error);
    BOOST_TEST(d.error <= deviation_bound(c, d.curve, 0) * (1 + 1e-12));  // refinement only helps
    if (seen > 1e-10) of_reduction.push_back(d.error / seen);
  }
  BOOST_TEST_MESSAGE("bound over what was seen, median: removal " << median(of_removal) << ", reduction "
                                                                  << median(of_reduction));
  BOOST_TEST(median(of_removal) <= 3);
  BOOST_TEST(median(of_reduction) <= 3);
  // Ends with their derivatives stay.
  const NurbsCurve c = random.curve(6, false);
  const Reduction tied = reduce(c, 1, 1).value();
  BOOST_TEST(distance(evaluate(c, c.range().lo), evaluate(tied.curve, c.range().lo)) < 1e-11);
  BOOST_TEST(norm(jet(c, c.range().hi).d1 - jet(tied.curve, c.range().hi).d1) < 1e-9 * norm(jet(c, c.range().hi).d1));
  BOOST_TEST(!reduce(random.curve(1, false), 1).has_value());
  BOOST_TEST(reduce_within(elevate(random.curve(2, false), 4), 1e-9).curve.degree() == 2);
  // Surfaces: a refined, elevated one comes back.
  for (int i = 0; i < 10; ++i) {
    const NurbsSurface s = trimmed(random.surface(2, 3, i % 2), {-infinity, infinity}, {-infinity, infinity});
    const double u = s.range_u().at(0.43);
    const SurfaceKnotRemoval back = remove_knot_u(refine_u(s, std::vector<double>{u}), u, 1, 1e-8);
    BOOST_TEST(back.removed == 1);
    BOOST_TEST(deviation_bound(s, back.surface, 0) < 1e-8);
    const SurfaceReduction lower = reduce(elevate(s, 1, 1), 1, 1).value();
    BOOST_TEST(lower.error < 1e-8);
    BOOST_TEST(remove_knots(refine_v(s, std::vector<double>{s.range_v().at(0.3)}), 1e-8).removed >= 1);
    const SurfaceReduction rough = reduce(s, 1, 1).value();
    for (int k = 0; k < 50; ++k) {
      const Uv p{random.in(s.range_u()), random.in(s.range_v())};
      BOOST_TEST(distance(evaluate(s, p), evaluate(rough.surface, p)) <= rough.error);
    }
  }
  // All removable knots go, and no more than the tolerance is spent.
  const NurbsCurve base = random.curve(3, false);
  std::vector<double> extra;
  for (int i = 0; i < 12; ++i) extra.push_back(random.in(base.domain()));
  const KnotRemoval thin = remove_knots(refine(base, extra), 1e-8);
  BOOST_TEST(thin.removed >= 12);
  BOOST_TEST(largest_distance(base, thin.curve, base.range()) <= 1e-8 + 1e-11);
}

BOOST_AUTO_TEST_CASE(polynomial_reparametrization_keeps_the_points) {
  Random random(306);
  for (int i = 0; i < 40; ++i) {
    const NurbsCurve c = reparametrized(random.curve(random.integer(1, 5), i % 2), {0.5, 4});
    const NurbsCurve q = composed_with_square(c).value();
    BOOST_TEST(q.degree() == 2 * c.degree());
    for (int k = 0; k <= 20; ++k) {
      const double s = q.range().at(k / 20.0);
      BOOST_TEST(distance(evaluate(q, s), evaluate(c, s * s)) < 1e-9);
    }
    // A cubic that ascends from 1 to 3.5 over [0, 2].
    const std::vector<double> f{1, 1.2, 3, 3.5};
    const NurbsCurve g = composed(c, f, {0, 2}).value();
    for (int k = 0; k <= 20; ++k) {
      const double y = k / 20.0, x = 1 - y;
      const double t = x * x * x * f[0] + 3 * x * x * y * f[1] + 3 * x * y * y * f[2] + y * y * y * f[3];
      BOOST_TEST(distance(evaluate(g, 2 * y), evaluate(c, t)) < 1e-9);
    }
    BOOST_TEST(!composed(c, std::vector<double>{1, 3, 0, 2}, {0, 1}).has_value());
    BOOST_TEST(!composed(c, std::vector<double>{-9, 3}, {0, 1}).has_value());
  }
}

BOOST_AUTO_TEST_CASE(bernstein_and_power_forms_agree) {
  Random random(307);
  for (int n = 1; n <= 9; ++n) {
    const std::vector<Hpoint> b = random.poles(static_cast<std::size_t>(n) + 1, true);
    const std::vector<Hpoint> a = bezier_to_power(b), back = power_to_bezier(a);
    const auto same = [](const Hpoint& x, const Hpoint& y, double within) {
      const Hpoint d = x - y;
      BOOST_TEST(std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z), std::abs(d.w)}) < within);
    };
    for (std::size_t i = 0; i < b.size(); ++i) same(back[i], b[i], 1e-10);
    for (int k = 0; k <= 10; ++k) {
      const double t = k / 10.0;
      same(de_casteljau(b, t), bezier_point(b, t), 1e-13 * 30);
      same(horner(a, t), de_casteljau(b, t), 1e-10);
      double sum = 0;
      for (int i = 0; i <= n; ++i) sum += bernstein(n, i, t);
      BOOST_TEST(std::abs(sum - 1) < 1e-14);
    }
    const std::vector<Hpoint> net = random.poles(static_cast<std::size_t>((n + 1) * 3), true);
    const std::vector<Hpoint> powers = bezier_to_power(net, 3);
    same(horner(powers, 3, {0.3, 0.6}), de_casteljau(net, 3, {0.3, 0.6}), 1e-10);
    const std::vector<Hpoint> net_back = power_to_bezier(powers, 3);
    for (std::size_t i = 0; i < net.size(); ++i) same(net_back[i], net[i], 1e-10);
  }
}

BOOST_AUTO_TEST_SUITE_END()
