// Every change of representation against its exact answer: each pole of the result is a value of the polar form of what
// was given. Errors in units of eps times the largest premultiplied coordinate or weight.
#include <boost/test/unit_test.hpp>

#include "kernel/nurbs/bezier.h"
#include "kernel/nurbs/blossom.h"
#include "kernel/nurbs/periodic.h"
#include "kernel/nurbs/projective.h"
#include "kernel/nurbs/reduction.h"
#include "kernel/nurbs/removal.h"
#include "kernel/nurbs/reparametrize.h"
#include "tests/exact/cases.h"

using namespace trimloop;
using namespace trimloop::exact;

namespace {

double largest(std::span<const Hpoint> poles) {
  const Size s = size_of(poles);
  return std::max(s.point, s.weight);
}

// Largest error of the poles of `got` as a spline equal to `s`, in units of eps times the size.
double pole_error(const Spline& s, const NurbsCurve& got, double size) {
  const std::vector<Rational> knots = exact::exact(got.knots());
  double worst = 0;
  for (std::size_t i = 0; i < got.poles().size(); ++i) {
    const Row pole = pole_over(s, knots, i, static_cast<std::size_t>(got.degree()));
    if (!pole.empty()) worst = std::max(worst, difference(pole, got.poles()[i]));
  }
  return worst / (epsilon * size);
}

// `check(curve, exact twin, cases)` for many curves of degrees up to `highest`; reports the largest value it returns as
// a share of what is allowed at the degree.
template <class F>
void for_curves(const char* what, unsigned seed, int count, int highest, F check) {
  Cases cases(seed);
  double worst = 0;
  for (int i = 0; i < count; ++i) {
    const int p = cases.degree(highest);
    const NurbsCurve c = cases.curve(p, cases.weights(), 3);
    const double units = check(c, exact::exact(c), cases), allowed = 2 * (p + 1);
    BOOST_TEST(units <= allowed);
    worst = std::max(worst, units / allowed);
  }
  BOOST_TEST_MESSAGE(what << ": " << count << " cases, largest error " << worst << " of 2(p+1) units");
}

}  // namespace

BOOST_AUTO_TEST_CASE(inserted_knots_give_the_exact_poles) {
  for_curves("insertion", 11, 1200, 14, [](const NurbsCurve& c, const Spline& s, Cases& cases) {
    const double t = cases.parameter(c.knots(), c.domain());
    return pole_error(s, insert_knot(c, t, cases.integer(1, c.degree())), largest(c.poles()));
  });
}

BOOST_AUTO_TEST_CASE(refinement_gives_the_exact_poles) {
  for_curves("refinement", 12, 600, 10, [](const NurbsCurve& c, const Spline& s, Cases& cases) {
    std::vector<double> wanted;
    for (int i = cases.integer(1, 5); i > 0; --i) wanted.push_back(cases.parameter(c.knots(), c.domain()));
    return pole_error(s, refine(c, wanted), largest(c.poles()));
  });
}

BOOST_AUTO_TEST_CASE(surface_refinement_gives_the_exact_poles) {
  Cases cases(13);
  for (int i = 0; i < 150; ++i) {
    const NurbsSurface s = cases.surface(cases.degree(6), cases.degree(4), cases.weights());
    const std::vector<double> wanted{cases.parameter(s.knots_u(), s.domain_u())};
    const NurbsSurface fine = refine_u(s, wanted);
    const Spline rows = exact::exact(s);
    const std::vector<Rational> knots = exact::exact(fine.knots_u());
    for (std::size_t k = 0; k < fine.poles_u(); ++k) {
      const Row row = pole_over(rows, knots, k, rows.degree);
      for (std::size_t j = 0; j < fine.poles_v() && !row.empty(); ++j) {
        const Row pole(row.begin() + static_cast<std::ptrdiff_t>(4 * j),
                       row.begin() + static_cast<std::ptrdiff_t>(4 * j + 4));
        BOOST_TEST(difference(pole, fine.pole(k, j)) <= 2 * (s.degree_u() + 1) * epsilon * largest(s.poles()));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(elevated_poles_are_the_exact_ones) {
  for_curves("elevation", 14, 400, 5, [](const NurbsCurve& c, const Spline& s, Cases& cases) {
    return pole_error(s, elevate(c, cases.integer(1, 2)), largest(c.poles()));
  });
}

BOOST_AUTO_TEST_CASE(split_and_bezier_poles_are_the_exact_ones) {
  for_curves("splitting", 15, 500, 12, [](const NurbsCurve& c, const Spline& s, Cases& cases) {
    double t = cases.parameter(c.knots(), c.domain());
    if (!(c.range().lo < t && t < c.range().hi)) t = c.range().mid();
    const auto [left, right] = split(c, t);
    // A piece of no size to speak of has equal weights, which are divided out.
    if (left.is_rational() != c.is_rational() || right.is_rational() != c.is_rational()) return 0.0;
    return std::max(pole_error(s, left, largest(c.poles())), pole_error(s, right, largest(c.poles())));
  });
  for_curves("Bezier pieces", 16, 500, 10, [](const NurbsCurve& c, const Spline& s, Cases&) {
    double worst = 0;
    for (const NurbsCurve& piece : bezier_pieces(c)) worst = std::max(worst, pole_error(s, piece, largest(c.poles())));
    return worst;
  });
}

BOOST_AUTO_TEST_CASE(the_polar_form_is_exact_inside_its_span) {
  for_curves("polar form", 17, 800, 14, [](const NurbsCurve& c, const Spline& s, Cases& cases) {
    const double t = cases.parameter(c.knots(), c.domain());
    const std::size_t k = span(s, t);
    const Interval inside{c.knots()[k], c.knots()[k + 1]};
    std::vector<double> arguments;
    for (int i = 0; i < c.degree(); ++i) arguments.push_back(cases.in(inside));
    const Row pole = exact::blossom(s, k, exact::exact(arguments));
    return difference(pole, trimloop::blossom(c, t, arguments)) / (epsilon * largest(c.poles()));
  });
}

BOOST_AUTO_TEST_CASE(removable_knots_are_removed_exactly) {
  // Knots and poles that are small integers times powers of two, so that the insertion is exact in doubles.
  Cases cases(18);
  double worst = 0;
  int removed = 0;
  for (int i = 0; i < 700; ++i) {
    const int p = cases.degree(6);
    std::vector<double> knots(static_cast<std::size_t>(p) + 1, 0.0);
    for (int k = cases.integer(0, 3), at = 0; k > 0; --k) knots.push_back(64.0 * ++at);
    knots.insert(knots.end(), static_cast<std::size_t>(p) + 1, knots.back() + 64);
    std::vector<Hpoint> poles(knots.size() - static_cast<std::size_t>(p) - 1);
    const bool rational = cases.chance(0.5);
    for (Hpoint& h : poles)
      h = {double(cases.integer(-64, 64)), double(cases.integer(-64, 64)), double(cases.integer(-64, 64)),
           rational ? double(cases.integer(1, 8)) : 1.0};
    poles[0].w = rational ? 9 : 1;
    const NurbsCurve c = NurbsCurve::from_homogeneous(p, knots, poles).value();
    const double t = std::floor(cases.real(0, knots.back() / 64)) * 64 + 32;
    const NurbsCurve fine = insert_knot(c, t, 1);
    if (pole_error(exact::exact(c), fine, 1) != 0) continue;  // not exact after all
    const KnotRemoval back = remove_knot(fine, t, 1, 1e-9);
    BOOST_TEST_REQUIRE(back.removed == 1);
    ++removed;
    BOOST_TEST(back.curve.knots() == c.knots(), boost::test_tools::per_element());
    const double error = pole_error(exact::exact(c), back.curve, largest(c.poles()));
    BOOST_TEST(error <= 2 * (p + 1));
    worst = std::max(worst, error / (2 * (p + 1)));
    for (int k = 0; k <= 20; ++k) {  // the bound holds
      const double at = c.domain().at(k / 20.0);
      BOOST_TEST(distance(evaluate(fine, at), evaluate(back.curve, at)) <= back.error);
    }
  }
  BOOST_TEST(removed > 400);
  BOOST_TEST_MESSAGE("removal: " << removed << " removable knots, largest error " << worst << " of 2(p+1) units");
}

BOOST_AUTO_TEST_CASE(power_forms_are_exact_at_low_degree) {
  // The power form at a span's start, in units of eps times the size of each coefficient: differences of poles.
  for_curves("power form", 19, 600, 6, [](const NurbsCurve& c, const Spline& s, Cases&) {
    const PowerForm form = to_power(c);
    double worst = 0;
    for (std::size_t i = 0; i < form.pieces.size(); ++i) {
      const double a = form.breaks[i], h = form.breaks[i + 1] - a;
      const std::vector<Row> right = power_coefficients(s, a, a);
      double scale = largest(c.poles());
      for (std::size_t k = 0; k < right.size(); ++k) {
        // Coefficient k is a k-th difference of Bezier poles: binomial(p, k) 2^k of them in absolute value.
        worst = std::max(worst, difference(right[k], form.pieces[i][k]) / (epsilon * scale));
        scale *= 2 * static_cast<double>(c.degree() - static_cast<int>(k)) / static_cast<double>(k + 1) / h;
      }
    }
    return worst;
  });
  // And back: the curve of the power form is the polynomial that its coefficients mean.
  Cases cases(20);
  for (int i = 0; i < 300; ++i) {
    const int p = cases.degree(9);
    PowerForm form{{0, 1}, {std::vector<Hpoint>(static_cast<std::size_t>(p) + 1)}};
    for (Hpoint& h : form.pieces[0]) h = {cases.real(-1, 1), cases.real(-1, 1), cases.real(-1, 1), cases.real(0.5, 1)};
    const NurbsCurve c = from_power(form).value().curve;
    const double t = cases.real(0, 1);
    Row sum(4);
    for (std::size_t k = form.pieces[0].size(); k-- > 0;) {
      const Hpoint& h = form.pieces[0][k];
      const double part[4] = {h.x, h.y, h.z, h.w};
      for (std::size_t j = 0; j < 4; ++j) sum[j] = sum[j] * Rational(t) + Rational(part[j]);
    }
    BOOST_TEST(difference(projected(sum), evaluate(c, t)) <= 2 * (p + 1) * unit(sum, size_of(c.poles())));
  }
}

BOOST_AUTO_TEST_CASE(affine_reparametrization_keeps_poles_and_rounds_knots_once) {
  Cases cases(21);
  for (int i = 0; i < 800; ++i) {
    const NurbsCurve c = cases.curve(cases.degree(10), cases.weights());
    const double lo = cases.real(-5, 5), hi = lo + std::pow(10.0, cases.real(-3, 3));
    const NurbsCurve moved = reparametrized(c, {lo, hi});
    BOOST_TEST(moved.range().lo == lo);
    BOOST_TEST(moved.range().hi == hi);
    const Rational a(c.range().lo), length = Rational(c.range().hi) - a, target = Rational(hi) - Rational(lo);
    for (std::size_t k = 0; k < c.knots().size(); ++k) {
      const Rational right = Rational(lo) + (Rational(c.knots()[k]) - a) / length * target;
      const double size = std::max({std::abs(lo), std::abs(hi), std::abs(as_double(right))});
      BOOST_TEST(difference(right, moved.knots()[k]) <= 4 * epsilon * size);
    }
    for (std::size_t k = 0; k < c.poles().size(); ++k)
      BOOST_TEST(difference(Row{c.poles()[k].x, c.poles()[k].y, c.poles()[k].z, c.poles()[k].w}, moved.poles()[k]) ==
                 0);
  }
}

BOOST_AUTO_TEST_CASE(moebius_reparametrization_keeps_the_points) {
  // The exact point of the result at s against that of the given curve at the exact image of s.
  Cases cases(22);
  double worst = 0;
  for (int i = 0; i < 700; ++i) {
    const int p = cases.degree(9);
    const NurbsCurve c = clamped(cases.curve(p, cases.weights(), 0));  // one span: its knots are kept to the bit
    const double ratio = std::pow(10.0, cases.real(-2, 2));
    const NurbsCurve moved = moebius(c, ratio).value();
    const double s = cases.in(moved.domain());
    const Rational lo(c.domain().lo), length = Rational(c.domain().hi) - lo, y = (Rational(s) - lo) / length;
    const Rational t = lo + Rational(ratio) * y / (1 + (Rational(ratio) - 1) * y) * length;
    const Row right = value(exact::exact(c), t), got = value(exact::exact(moved), s);
    if (right[3] == 0 || got[3] == 0) continue;
    const Row a = projected(right), b = projected(got);
    double error = 0;
    for (std::size_t k = 0; k < 3; ++k) error = std::max(error, std::abs(as_double(a[k] - b[k])));
    const double units = error / unit(got, size_of(moved.poles()));
    BOOST_TEST(units <= 2 * (p + 1));
    worst = std::max(worst, units / (2 * (p + 1)));
    // End weights of one, where the signs allow it.
    if (const auto normal = with_end_weights_one(c)) {
      BOOST_TEST(normal->curve.poles().front().w == 1);
      BOOST_TEST(normal->curve.poles().back().w == 1);
    }
  }
  BOOST_TEST_MESSAGE("Moebius: 700 cases, largest error " << worst << " of 2(p+1) units");
}

BOOST_AUTO_TEST_CASE(projective_maps_are_exact_on_poles) {
  for_curves("projective map", 23, 800, 10, [](const NurbsCurve& c, const Spline& s, Cases& cases) {
    Projective map;
    for (auto& row : map.m)
      for (double& m : row) m = cases.real(-1, 1);
    const auto moved = transformed(c, map);
    if (!moved || !moved->is_rational()) return 0.0;
    double worst = 0;
    for (std::size_t i = 0; i < c.poles().size(); ++i) {
      Row right(4);
      for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t l = 0; l < 4; ++l) right[k] += Rational(map.m[k][l]) * s.poles[i][l];
      worst = std::max(worst, difference(right, moved->poles()[i]));
    }
    return worst / (epsilon * largest(c.poles()));
  });
}

BOOST_AUTO_TEST_CASE(elevation_and_reduction_undo_each_other) {
  Cases cases(24);
  double worst = 0;
  for (int i = 0; i < 400; ++i) {
    const int p = cases.degree(8);
    const NurbsCurve c = clamped(cases.curve(p, i % 2 ? Weights::Positive : Weights::None));
    const auto back = reduce(elevate(c, 1), 1);
    BOOST_TEST_REQUIRE(back.has_value());
    BOOST_TEST(back->curve.knots() == c.knots(), boost::test_tools::per_element());
    double error = 0;
    for (std::size_t k = 0; k < c.poles().size(); ++k)
      error = std::max(error, difference(exact::exact(c).poles[k], back->curve.poles()[k]));
    // Poles of narrow spans have little weight in the least squares: their condition is that of the B-spline basis.
    const double units = error / (epsilon * largest(c.poles())) / std::pow(2.0, p);
    BOOST_TEST(units <= 16);
    worst = std::max(worst, units);
    for (int k = 0; k <= 10; ++k) {
      const double t = c.domain().at(k / 10.0);
      BOOST_TEST(distance(evaluate(c, t), evaluate(back->curve, t)) <= back->error);
    }
  }
  BOOST_TEST_MESSAGE("elevate, reduce: 400 cases, largest error of a pole " << worst << " units times 2^p");
}

BOOST_AUTO_TEST_CASE(unclamping_and_clamping_undo_each_other) {
  Cases cases(25);
  for (int i = 0; i < 300; ++i) {
    const int p = cases.integer(1, 5);
    std::vector<double> knots(static_cast<std::size_t>(p) + 1, 0.0);
    for (int k = cases.integer(0, 4); k > 0; --k) knots.push_back(knots.back() + cases.real(0.5, 2));
    knots.insert(knots.end(), static_cast<std::size_t>(p) + 1, knots.back() + cases.real(0.5, 2));
    const std::size_t n = knots.size() - static_cast<std::size_t>(p) - 1;
    const NurbsCurve c = NurbsCurve::from_homogeneous(p, knots, cases.poles(n, Weights::Mixed)).value();
    const NurbsCurve loose = unclamped(c);
    const double size = std::max(largest(c.poles()), largest(loose.poles()));
    BOOST_TEST(pole_error(exact::exact(c), loose, size) <= 16 * (p + 1));
    BOOST_TEST(pole_error(exact::exact(loose), clamped(loose), size) <= 2 * (p + 1));
  }
}
