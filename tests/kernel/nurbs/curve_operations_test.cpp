// Every operation keeps the shape: two ways to the same point, on random curves of all kinds.
#include <boost/test/unit_test.hpp>

#include "kernel/math/transform.h"
#include "kernel/nurbs/curve.h"
#include "tests/kernel/nurbs/random_nurbs.h"

using namespace trimloop;
using testing::Random;

namespace {

// Degrees 1..9, rational and not, clamped and not.
template <class F>
void for_random_curves(unsigned seed, F check) {
  Random random(seed);
  for (int degree = 1; degree <= 9; ++degree)
    for (int kind = 0; kind < 4; ++kind)
      for (int repeat = 0; repeat < 4; ++repeat) check(random.curve(degree, kind & 1, kind & 2), random);
}

// Largest distance between the curves at equal parameters of `over`, relative to the size of the first.
double difference(const NurbsCurve& a, const NurbsCurve& b, Interval over) {
  double worst = 0;
  for (int i = 0; i <= 40; ++i) {
    const double t = over.at(i / 40.0);
    worst = std::max(worst, distance(evaluate(a, t), evaluate(b, t)));
  }
  return worst / testing::size(a.poles());
}

bool has_clamped_ends(const NurbsCurve& c) {
  const std::size_t order = static_cast<std::size_t>(c.degree()) + 1;
  const auto& k = c.knots();
  return k[0] == k[order - 1] && k[k.size() - order] == k.back();
}

}  // namespace

BOOST_AUTO_TEST_CASE(inserting_knots_keeps_the_shape) {
  for_random_curves(1, [](const NurbsCurve& c, Random& random) {
    const double t = random.in(c.domain());
    const int times = random.integer(1, c.degree());
    const NurbsCurve finer = insert_knot(c, t, times);
    BOOST_TEST(finer.poles().size() == c.poles().size() + static_cast<std::size_t>(times));
    BOOST_TEST(difference(c, finer, c.domain()) < 1e-13);
    BOOST_TEST(finer.is_rational() == c.is_rational());
  });
}

BOOST_AUTO_TEST_CASE(a_full_knot_takes_the_curve_through_its_pole) {
  for_random_curves(2, [](const NurbsCurve& c, Random& random) {
    const double t = random.in(c.domain());
    const NurbsCurve finer = insert_knot(c, t, 1000);
    const auto k = std::lower_bound(finer.knots().begin(), finer.knots().end(), t) - finer.knots().begin();
    BOOST_TEST(distance(project(finer.poles()[static_cast<std::size_t>(k) - 1]), evaluate(c, t)) <
               1e-13 * testing::size(c.poles()));
  });
}

BOOST_AUTO_TEST_CASE(poles_outside_an_insertion_keep_their_bits) {
  Random random(20);
  const NurbsCurve c =
      NurbsCurve::from_homogeneous(3, {0, 0, 0, 0, 1, 2, 2, 3, 4, 4, 4, 4}, random.poles(8, true)).value();
  // To the double knot 2 of degree 3 one more brings one new pole, between poles 3 and 4.
  const NurbsCurve finer = insert_knot(c, 2, 1);
  for (std::size_t i = 0; i < 8; ++i) BOOST_TEST(finer.poles()[i < 4 ? i : i + 1].x == c.poles()[i].x);
}

BOOST_AUTO_TEST_CASE(refining_keeps_the_shape_and_limits_multiplicities) {
  for_random_curves(3, [](const NurbsCurve& c, Random& random) {
    std::vector<double> wanted{c.domain().lo, c.domain().hi, c.domain().lo - 1, c.domain().hi + 1, std::nan("")};
    for (int i = 0; i < 12; ++i) wanted.push_back(random.in(c.domain()));
    for (double k : c.knots()) wanted.push_back(k);  // every knot once more
    const NurbsCurve finer = refine(c, wanted);
    BOOST_TEST(difference(c, finer, c.domain()) < 1e-13);
    // What comes out is a legal spline by the constructor's own measure.
    BOOST_TEST(NurbsCurve::from_homogeneous(finer.degree(), finer.knots(), finer.poles()).has_value());
    BOOST_TEST(finer.domain().lo == c.domain().lo);
    BOOST_TEST(finer.domain().hi == c.domain().hi);
  });
}

BOOST_AUTO_TEST_CASE(elevation_keeps_the_shape_on_uneven_knots) {
  for_random_curves(4, [](const NurbsCurve& c, Random& random) {
    const int by = random.integer(1, 3);
    const NurbsCurve higher = elevate(c, by);
    BOOST_TEST(higher.degree() == c.degree() + by);
    BOOST_TEST(has_clamped_ends(higher));
    BOOST_TEST(difference(c, higher, c.domain()) < 1e-13);
    BOOST_TEST(NurbsCurve::from_homogeneous(higher.degree(), higher.knots(), higher.poles()).has_value());
  });
}

BOOST_AUTO_TEST_CASE(elevation_raises_each_multiplicity_by_one) {
  const NurbsCurve c = NurbsCurve::from_homogeneous(2, {0, 0, 0, 1, 2, 2, 5, 5, 5}, std::vector<Hpoint>(6)).value();
  const std::vector<double> expected{0, 0, 0, 0, 1, 1, 2, 2, 2, 5, 5, 5, 5};
  BOOST_TEST(elevate(c, 1).knots() == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(elevation_by_many_degrees_reaches_the_limit) {
  Random random(5);
  const NurbsCurve c = random.curve(4, true);
  const NurbsCurve highest = elevate(c, 60);
  BOOST_TEST(highest.degree() == 64);
  BOOST_TEST(difference(c, highest, c.domain()) < 1e-13);
}

BOOST_AUTO_TEST_CASE(a_bezier_quadratic_is_elevated_by_the_textbook_rule) {
  const std::vector<Point> points{{0, 0}, {3, 6}, {9, 0}};
  const NurbsCurve c = NurbsCurve::from_cartesian(2, {0, 0, 0, 1, 1, 1}, points, {}).value();
  const NurbsCurve cubic = elevate(c, 1);  // ends, and thirds of the way to the middle pole
  const std::vector<Point> expected{{0, 0}, {2, 4}, {5, 4}, {9, 0}};
  for (std::size_t i = 0; i < 4; ++i) BOOST_TEST(distance(project(cubic.poles()[i]), expected[i]) < 1e-15 * 9);
}

BOOST_AUTO_TEST_CASE(splitting_keeps_the_shape_and_shares_the_joint) {
  for_random_curves(6, [](const NurbsCurve& whole, Random& random) {
    const Interval d = whole.domain();
    const NurbsCurve c = whole.with_range({d.at(0.1), d.at(0.9)});
    const double t = random.in({d.at(0.2), d.at(0.8)});
    const auto [left, right] = split(c, t);
    BOOST_TEST(left.range().lo == c.range().lo);
    BOOST_TEST(left.range().hi == t);
    BOOST_TEST(right.range().lo == t);
    BOOST_TEST(right.range().hi == c.range().hi);
    BOOST_TEST(difference(c, left, left.range()) < 1e-13);
    BOOST_TEST(difference(c, right, right.range()) < 1e-13);
    BOOST_TEST(distance(evaluate(left, t), evaluate(right, t)) == 0);
  });
}

BOOST_AUTO_TEST_CASE(a_trimmed_curve_is_clamped_and_the_same) {
  for_random_curves(7, [](const NurbsCurve& c, Random& random) {
    double lo = random.in(c.domain()), hi = random.in(c.domain());
    if (lo > hi) std::swap(lo, hi);
    const NurbsCurve part = trimmed(c, {lo, hi});
    BOOST_TEST(has_clamped_ends(part));
    BOOST_TEST(part.domain().lo == lo);
    BOOST_TEST(part.domain().hi == hi);
    BOOST_TEST(difference(c, part, {lo, hi}) < 1e-13);
    BOOST_TEST(difference(c, trimmed(c, {-infinity, infinity}), c.domain()) < 1e-13);
  });
}

BOOST_AUTO_TEST_CASE(trimming_a_clamped_curve_to_its_domain_changes_no_bit) {
  Random random(8);
  for (int degree = 1; degree <= 9; ++degree) {
    const NurbsCurve c = random.curve(degree, true), same = trimmed(c, c.domain());
    BOOST_TEST(same.knots() == c.knots(), boost::test_tools::per_element());
    for (std::size_t i = 0; i < c.poles().size(); ++i) {
      BOOST_TEST(same.poles()[i].x == c.poles()[i].x);
      BOOST_TEST(same.poles()[i].w == c.poles()[i].w);
    }
  }
}

BOOST_AUTO_TEST_CASE(trimming_ends_at_knots_works) {
  for_random_curves(9, [](const NurbsCurve& c, Random&) {
    const std::vector<double> b = breaks(c);
    for (std::size_t i = 0; i + 1 < b.size(); ++i) {
      const NurbsCurve part = trimmed(c, {b[i], b.back()});
      BOOST_TEST(difference(c, part, part.domain()) < 1e-13);
      BOOST_TEST(breaks(part).size() == b.size() - i);
    }
  });
}

BOOST_AUTO_TEST_CASE(a_part_of_one_ulp_is_a_point_of_the_curve) {
  for_random_curves(21, [](const NurbsCurve& c, Random& random) {
    const double t = random.in({c.domain().at(0.1), c.domain().at(0.9)});
    const NurbsCurve part = trimmed(c, {t, std::nextafter(t, infinity)});
    BOOST_TEST(distance(evaluate(part, t), evaluate(c, t)) < 1e-13 * testing::size(c.poles()));
  });
}

BOOST_AUTO_TEST_CASE(bezier_pieces_make_up_the_curve) {
  for_random_curves(10, [](const NurbsCurve& whole, Random&) {
    const NurbsCurve c = whole.with_range({whole.domain().at(0.05), whole.domain().at(0.95)});
    const auto pieces = bezier_pieces(c);
    const auto ends = breaks(c);
    BOOST_TEST_REQUIRE(pieces.size() + 1 == ends.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      BOOST_TEST(pieces[i].poles().size() == static_cast<std::size_t>(c.degree()) + 1);
      BOOST_TEST(pieces[i].range().lo == ends[i]);
      BOOST_TEST(pieces[i].range().hi == ends[i + 1]);
      // Strictly inside, where both have one piece only.
      BOOST_TEST(difference(c, pieces[i], {pieces[i].range().at(1e-9), pieces[i].range().at(1 - 1e-9)}) < 1e-13);
    }
  });
  Random random(11);
  const NurbsCurve c = random.curve(3, false);
  BOOST_TEST(bezier_pieces(c.with_range({c.domain().lo, c.domain().lo})).empty());
}

BOOST_AUTO_TEST_CASE(reversing_mirrors_the_parameter_and_keeps_the_domain) {
  for_random_curves(12, [](const NurbsCurve& whole, Random&) {
    const Interval d = whole.domain();
    const NurbsCurve c = whole.with_range({d.lo, d.at(0.7)}), r = reversed(c);
    BOOST_TEST(r.domain().lo == d.lo);
    BOOST_TEST(r.domain().hi == d.hi);
    BOOST_TEST(r.range().hi == d.hi);
    BOOST_TEST(std::abs(r.range().lo - d.at(0.3)) < 1e-14 * (std::abs(d.lo) + std::abs(d.hi)));
    // Mirrored knots are rounded: a parameter moves by an ulp of the knots, the point by that times the speed.
    for (int i = 0; i <= 20; ++i) {
      const double t = d.at(i / 20.0), m = d.at(1 - i / 20.0);
      const CurveJet j = jet(c, m);
      const double knot_size = std::max(std::abs(c.knots().front()), std::abs(c.knots().back()));
      BOOST_TEST(distance(evaluate(r, t), j.point) < 1e-13 * testing::size(c.poles()) + 1e-14 * knot_size * norm(j.d1));
    }
    BOOST_TEST(distance(evaluate(r, d.lo), evaluate(c, d.hi)) <= 1e-13 * testing::size(c.poles()));
  });
}

BOOST_AUTO_TEST_CASE(reparametrizing_maps_the_range_exactly) {
  for_random_curves(13, [](const NurbsCurve& whole, Random&) {
    const NurbsCurve c = whole.with_range({whole.domain().at(0.25), whole.domain().hi});
    const NurbsCurve n = reparametrized(c, {10, 12});
    BOOST_TEST(n.range().lo == 10);
    BOOST_TEST(n.range().hi == 12);
    BOOST_TEST(n.domain().hi == 12);
    for (int i = 0; i <= 20; ++i) {
      const CurveJet j = jet(c, c.range().at(i / 20.0));
      const double rounding = 1e-14 * (12 * c.range().length() + std::abs(c.range().hi)) * norm(j.d1);
      BOOST_TEST(distance(evaluate(n, 10 + i / 10.0), j.point) < 1e-13 * testing::size(c.poles()) + rounding);
    }
  });
}

BOOST_AUTO_TEST_CASE(transforming_commutes_with_evaluation) {
  const Transform m =
      Transform::translation({5, -3, 8}) * Transform::rotation({1, 2, 3}, {1, 1, 0}, 0.7) * Transform::scale(-2.5);
  for_random_curves(14, [&](const NurbsCurve& c, Random& random) {
    const NurbsCurve moved = transformed(c, m);
    BOOST_TEST(moved.is_rational() == c.is_rational());
    for (int i = 0; i < 10; ++i) {
      const double t = random.in(c.domain());
      BOOST_TEST(distance(evaluate(moved, t), apply(m, evaluate(c, t))) < 1e-13 * testing::size(moved.poles()));
    }
  });
}

BOOST_AUTO_TEST_CASE(the_box_encloses_the_range_and_is_no_larger_than_its_poles) {
  for_random_curves(15, [](const NurbsCurve& whole, Random&) {
    const NurbsCurve c = whole.with_range({whole.domain().at(0.3), whole.domain().at(0.5)});
    const Box part = bounding_box(c), all = bounding_box(whole);
    const double tol = 1e-14 * testing::size(c.poles());
    for (int i = 0; i <= 100; ++i) {
      const Point p = evaluate(c, c.range().at(i / 100.0));
      for (const Box& b : {part, all}) {
        BOOST_TEST((b.lo.x - tol <= p.x && b.lo.y - tol <= p.y && b.lo.z - tol <= p.z));
        BOOST_TEST((p.x <= b.hi.x + tol && p.y <= b.hi.y + tol && p.z <= b.hi.z + tol));
      }
    }
    BOOST_TEST(part.diagonal() <= all.diagonal() * (1 + 1e-13));
    const NurbsCurve point = whole.with_range({whole.domain().mid(), whole.domain().mid()});
    BOOST_TEST(bounding_box(point).diagonal() == 0);
  });
}

BOOST_AUTO_TEST_CASE(the_box_is_infinite_only_where_a_weight_is_not_positive) {
  const std::vector<Hpoint> poles{{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 0}, {3, 0, 0, 1}, {4, 0, 0, 1}};
  const NurbsCurve c = NurbsCurve::from_homogeneous(1, {0, 0, 1, 2, 3, 4, 4}, poles).value();
  BOOST_TEST(bounding_box(c).diagonal() == infinity);
  const Box first = bounding_box(c.with_range({0, 1}));
  BOOST_TEST(first.hi.x == 1);
  BOOST_TEST(first.lo.x == 0);
}

BOOST_AUTO_TEST_CASE(breaks_are_the_range_and_the_distinct_knots_inside) {
  const NurbsCurve c = NurbsCurve::from_homogeneous(2, {-1, 0, 0, 1, 2, 2, 3, 3, 4}, std::vector<Hpoint>(6)).value();
  const std::vector<double> all{0, 1, 2, 3}, some{0.5, 1, 2};
  BOOST_TEST(breaks(c) == all, boost::test_tools::per_element());
  BOOST_TEST(breaks(c.with_range({0.5, 2})) == some, boost::test_tools::per_element());
}
