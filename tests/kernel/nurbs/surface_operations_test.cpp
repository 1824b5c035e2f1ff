// Every operation keeps the shape: two ways to the same point, on random surfaces of all kinds.
#include <boost/test/unit_test.hpp>

#include "kernel/math/transform.h"
#include "kernel/nurbs/surface.h"
#include "tests/kernel/nurbs/random_nurbs.h"

using namespace trimloop;
using testing::Random;

namespace {

// Each degree 1..9 in u with another in v, rational and not, clamped and not.
template <class F>
void for_random_surfaces(unsigned seed, F check) {
  Random random(seed);
  for (int degree = 1; degree <= 9; ++degree)
    for (int kind = 0; kind < 4; ++kind)
      check(random.surface(degree, random.integer(1, 9), kind & 1, kind & 2), random);
}

double difference(const NurbsSurface& a, const NurbsSurface& b, Interval u, Interval v) {
  double worst = 0;
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 10; ++j) {
      const Uv at{u.at(i / 10.0), v.at(j / 10.0)};
      worst = std::max(worst, distance(evaluate(a, at), evaluate(b, at)));
    }
  return worst / testing::size(a.poles());
}
double difference(const NurbsSurface& a, const NurbsSurface& b) { return difference(a, b, a.domain_u(), a.domain_v()); }

bool is_legal(const NurbsSurface& s) {
  return NurbsSurface::from_homogeneous(s.degree_u(), s.degree_v(), s.knots_u(), s.knots_v(), s.poles(), s.range_u(),
                                        s.range_v())
      .has_value();
}

}  // namespace

BOOST_AUTO_TEST_CASE(refining_a_surface_keeps_its_shape) {
  for_random_surfaces(1, [](const NurbsSurface& s, Random& random) {
    std::vector<double> u, v;
    for (int i = 0; i < 5; ++i) u.push_back(random.in(s.domain_u())), v.push_back(random.in(s.domain_v()));
    const NurbsSurface fine_u = refine_u(s, u), fine = refine_v(fine_u, v);
    BOOST_TEST(fine_u.poles_u() == s.poles_u() + 5);
    BOOST_TEST(fine_u.poles_v() == s.poles_v());
    BOOST_TEST(fine.poles_v() == s.poles_v() + 5);
    BOOST_TEST(difference(s, fine) < 1e-13);
    BOOST_TEST(is_legal(fine));
  });
}

BOOST_AUTO_TEST_CASE(elevating_a_surface_keeps_its_shape) {
  for_random_surfaces(2, [](const NurbsSurface& s, Random&) {
    const NurbsSurface higher = elevate(s, 1, 2);
    BOOST_TEST(higher.degree_u() == s.degree_u() + 1);
    BOOST_TEST(higher.degree_v() == s.degree_v() + 2);
    BOOST_TEST(difference(s, higher) < 1e-13);
    BOOST_TEST(is_legal(higher));
    BOOST_TEST(elevate(s, 0, 0).poles().size() == s.poles().size());
  });
}

BOOST_AUTO_TEST_CASE(swapping_exchanges_u_and_v) {
  for_random_surfaces(3, [](const NurbsSurface& whole, Random& random) {
    const NurbsSurface s = whole.with_range({whole.domain_u().lo, whole.domain_u().mid()}, whole.domain_v());
    const NurbsSurface t = swapped(s);
    BOOST_TEST(t.degree_u() == s.degree_v());
    BOOST_TEST(t.range_v().hi == s.range_u().hi);
    for (int i = 0; i < 10; ++i) {
      const Uv at{random.in(s.domain_u()), random.in(s.domain_v())};
      BOOST_TEST(distance(evaluate(s, at), evaluate(t, {at.v, at.u})) < 1e-14 * testing::size(s.poles()));
    }
    BOOST_TEST(difference(s, swapped(t)) == 0);
  });
}

BOOST_AUTO_TEST_CASE(reversing_u_mirrors_u_only) {
  for_random_surfaces(4, [](const NurbsSurface& whole, Random& random) {
    const Interval u = whole.domain_u();
    const NurbsSurface s = whole.with_range({u.lo, u.at(0.25)}, whole.domain_v()), r = reversed_u(s);
    BOOST_TEST(r.domain_u().lo == u.lo);
    BOOST_TEST(r.domain_u().hi == u.hi);
    BOOST_TEST(r.range_u().hi == u.hi);
    BOOST_TEST(r.range_v().hi == s.range_v().hi);
    const double knot_size = std::max(std::abs(s.knots_u().front()), std::abs(s.knots_u().back()));
    for (int i = 0; i <= 10; ++i) {
      const double v = random.in(s.domain_v());
      const SurfaceJet j = jet(s, {u.at(1 - i / 10.0), v});
      BOOST_TEST(distance(evaluate(r, {u.at(i / 10.0), v}), j.point) <
                 1e-13 * testing::size(s.poles()) + 1e-14 * knot_size * norm(j.du));
    }
  });
}

BOOST_AUTO_TEST_CASE(a_trimmed_surface_is_clamped_and_the_same) {
  for_random_surfaces(5, [](const NurbsSurface& s, Random&) {
    const Interval u{s.domain_u().at(0.2), s.domain_u().at(0.7)}, v{s.domain_v().at(0.5), s.domain_v().hi};
    const NurbsSurface part = trimmed(s, u, v);
    BOOST_TEST(part.domain_u().lo == u.lo);
    BOOST_TEST(part.domain_u().hi == u.hi);
    BOOST_TEST(part.knots_v().front() == v.lo);
    BOOST_TEST(part.knots_v().back() == v.hi);
    BOOST_TEST(part.range_v().lo == v.lo);
    BOOST_TEST(difference(s, part, u, v) < 1e-13);
    BOOST_TEST(is_legal(part));
  });
}

BOOST_AUTO_TEST_CASE(isocurves_lie_on_the_surface) {
  for_random_surfaces(6, [](const NurbsSurface& whole, Random& random) {
    const NurbsSurface s = whole.with_range({whole.domain_u().at(0.1), whole.domain_u().at(0.2)},
                                            {whole.domain_v().at(0.3), whole.domain_v().at(0.4)});
    const double u = random.in(s.domain_u()), v = random.in(s.domain_v()), tol = 1e-13 * testing::size(s.poles());
    const NurbsCurve along_v = isocurve_u(s, u), along_u = isocurve_v(s, v);
    BOOST_TEST(along_v.range().hi == s.range_v().hi);
    BOOST_TEST(along_u.range().lo == s.range_u().lo);
    BOOST_TEST(along_u.degree() == s.degree_u());
    for (int i = 0; i <= 10; ++i) {
      const double a = s.domain_u().at(i / 10.0), b = s.domain_v().at(i / 10.0);
      BOOST_TEST(distance(evaluate(along_v, b), evaluate(s, {u, b})) < tol);
      BOOST_TEST(distance(evaluate(along_u, a), evaluate(s, {a, v})) < tol);
    }
  });
}

BOOST_AUTO_TEST_CASE(a_border_isocurve_has_the_border_poles) {
  Random random(7);
  const NurbsSurface s = random.surface(3, 4, true);
  const NurbsCurve border = isocurve_u(s, s.domain_u().hi);
  for (std::size_t j = 0; j < s.poles_v(); ++j) BOOST_TEST(border.poles()[j].x == s.pole(s.poles_u() - 1, j).x);
}

BOOST_AUTO_TEST_CASE(a_cylinder_has_polynomial_rulings) {
  // Quarter cylinder: rational in u only, so that an isocurve along v has equal weights.
  const double h = std::sqrt(0.5);
  const std::vector<Point> points{{1, 0, 0}, {1, 0, 5}, {1, 1, 0}, {1, 1, 5}, {0, 1, 0}, {0, 1, 5}};
  const std::vector<double> weights{1, 1, h, h, 1, 1};
  const NurbsSurface s = NurbsSurface::from_cartesian(2, 1, {0, 0, 0, 1, 1, 1}, {0, 0, 5, 5}, points, weights).value();
  const NurbsCurve ruling = isocurve_u(s, 0.3);
  BOOST_TEST(!ruling.is_rational());
  BOOST_TEST(ruling.poles()[0].w == 1);
  BOOST_TEST(distance(evaluate(ruling, 2), evaluate(s, {0.3, 2})) < 1e-15);
  BOOST_TEST(isocurve_v(s, 2).is_rational());
}

BOOST_AUTO_TEST_CASE(transforming_a_surface_commutes_with_evaluation) {
  const Transform m = Transform::rotation({1, 0, 2}, {0, 3, 1}, 2) * Transform::translation({100, 0, 0});
  for_random_surfaces(8, [&](const NurbsSurface& s, Random& random) {
    const NurbsSurface moved = transformed(s, m);
    for (int i = 0; i < 10; ++i) {
      const Uv at{random.in(s.domain_u()), random.in(s.domain_v())};
      BOOST_TEST(distance(evaluate(moved, at), apply(m, evaluate(s, at))) < 1e-13 * testing::size(moved.poles()));
    }
  });
}

BOOST_AUTO_TEST_CASE(the_box_encloses_the_surface_over_its_range) {
  for_random_surfaces(9, [](const NurbsSurface& whole, Random&) {
    const Interval u = whole.domain_u(), v = whole.domain_v();
    const NurbsSurface s = whole.with_range({u.at(0.4), u.at(0.6)}, {v.lo, v.at(0.3)});
    const NurbsSurface edge = whole.with_range({u.mid(), u.mid()}, v);
    const Box part = bounding_box(s), all = bounding_box(whole), line = bounding_box(edge);
    const double tol = 1e-14 * testing::size(s.poles());
    const auto encloses = [&](const Box& b, Point p) {
      return b.lo.x - tol <= p.x && b.lo.y - tol <= p.y && b.lo.z - tol <= p.z && p.x <= b.hi.x + tol &&
             p.y <= b.hi.y + tol && p.z <= b.hi.z + tol;
    };
    for (int i = 0; i <= 10; ++i)
      for (int j = 0; j <= 10; ++j) {
        const Point p = evaluate(s, {s.range_u().at(i / 10.0), s.range_v().at(j / 10.0)});
        BOOST_TEST((encloses(part, p) && encloses(all, p)));
        BOOST_TEST(encloses(line, evaluate(edge, {u.mid(), v.at(j / 10.0)})));
      }
    BOOST_TEST(part.diagonal() <= all.diagonal() * (1 + 1e-13));
    BOOST_TEST(line.diagonal() <= all.diagonal() * (1 + 1e-13));
  });
}

BOOST_AUTO_TEST_CASE(a_weight_that_is_not_positive_makes_the_box_infinite) {
  Random random(10);
  auto poles = random.poles(9, true);
  poles[4].w = -1;
  const std::vector<double> k{0, 0, 0, 1, 1, 1};
  BOOST_TEST(bounding_box(NurbsSurface::from_homogeneous(2, 2, k, k, poles).value()).diagonal() == infinity);
}

BOOST_AUTO_TEST_CASE(breaks_follow_the_range_in_each_direction) {
  Random random(11);
  const NurbsSurface s =
      NurbsSurface::from_homogeneous(1, 2, {0, 0, 1, 2, 2}, {0, 1, 2, 3, 4, 5, 6}, random.poles(12, false)).value();
  const std::vector<double> u{0, 1, 2}, v{2, 3, 4}, some{2.5, 3, 3.5};
  BOOST_TEST(breaks_u(s) == u, boost::test_tools::per_element());
  BOOST_TEST(breaks_v(s) == v, boost::test_tools::per_element());
  BOOST_TEST(breaks_v(s.with_range({0, 1}, {2.5, 3.5})) == some, boost::test_tools::per_element());
}
