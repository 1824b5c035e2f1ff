// No operation on valid data returns NaN: every operation of kernel/nurbs on splines made to hurt, with weights of any
// sign and zero. Infinity is an answer (a bound that cannot be given, a point at infinity), NaN is not.
#include <boost/test/unit_test.hpp>

#include "kernel/nurbs/bezier.h"
#include "kernel/nurbs/construct_surface.h"
#include "kernel/nurbs/deviation.h"
#include "kernel/nurbs/error_bound.h"
#include "kernel/nurbs/fit.h"
#include "kernel/nurbs/hodograph.h"
#include "kernel/nurbs/join.h"
#include "kernel/nurbs/periodic.h"
#include "kernel/nurbs/projective.h"
#include "kernel/nurbs/reduction.h"
#include "kernel/nurbs/removal.h"
#include "kernel/nurbs/reparametrize.h"
#include "tests/exact/cases.h"

using namespace trimloop;
using namespace trimloop::exact;

namespace {

bool has_nan(const std::vector<double>& v) {
  return std::any_of(v.begin(), v.end(), [](double x) { return std::isnan(x); });
}
bool has_nan(const std::vector<Hpoint>& v) {
  return std::any_of(v.begin(), v.end(), [](const Hpoint& h) { return std::isnan(h.x + h.y + h.z + h.w); });
}
bool has_nan(const NurbsCurve& c) { return has_nan(c.knots()) || has_nan(c.poles()) || std::isnan(c.range().length()); }
bool has_nan(const NurbsSurface& s) { return has_nan(s.knots_u()) || has_nan(s.knots_v()) || has_nan(s.poles()); }

template <class T>
bool has_nan(const std::vector<T>& all) {
  return std::any_of(all.begin(), all.end(), [](const T& one) { return has_nan(one); });
}
template <class T>
bool has_nan(const Result<T>& r) {
  return r && has_nan(*r);  // to say no is an answer
}

}  // namespace

BOOST_AUTO_TEST_CASE(no_operation_on_a_curve_returns_nan) {
  Cases cases(51);
  for (int i = 0; i < 800; ++i) {
    const int p = cases.degree(12);
    const NurbsCurve c = cases.curve(p, cases.weights());
    const double t = cases.parameter(c.knots(), c.domain());
    BOOST_TEST_CONTEXT("case " << i << ", degree " << p) {
      BOOST_TEST(!std::isnan(evaluate_bounded(c, t).error));
      BOOST_TEST(!has_nan(insert_knot(c, t, cases.integer(1, p))));
      BOOST_TEST(!has_nan(elevate(c, 1)));
      BOOST_TEST(!has_nan(reversed(c)));
      BOOST_TEST(!has_nan(bezier_pieces(c)));
      BOOST_TEST(!has_nan(hodograph(c)));
      BOOST_TEST(!has_nan(clamped(c)));
      BOOST_TEST(!has_nan(unclamped(clamped(c))));
      BOOST_TEST(!has_nan(moebius(c, 1.5)));
      BOOST_TEST(!has_nan(transformed(c, perspective({1, 2, 30}, {0, 0, 0}, {0, 0.3, 1}).value())));
      BOOST_TEST(!has_nan(extended(c, i % 2 ? End::Start : End::Finish, 0.1)));
      BOOST_TEST(!has_nan(extruded(c, {1, 2, 3})));
      BOOST_TEST(!has_nan(revolved(c, {0, 0, 0}, {1, 1, 0}, {0, 4})));
      BOOST_TEST(!has_nan(cone(c, {1, 2, 3, cases.chance(0.5) ? 0.0 : 1.0})));
      for (const std::vector<Hpoint>& level : derivative_poles(c, 2)) BOOST_TEST(!has_nan(level));
      for (const std::vector<Hpoint>& piece : to_power(c).pieces) BOOST_TEST(!has_nan(piece));
      const KnotRemoval thin = remove_knots(c, 1e-3);
      BOOST_TEST((!has_nan(thin.curve) && !std::isnan(thin.error)));
      if (const auto lower = reduce(c, 1)) BOOST_TEST((!has_nan(lower->curve) && !std::isnan(lower->error)));
      if (const auto ends = with_end_weights_one(c)) BOOST_TEST(!has_nan(ends->curve));
      if (const auto ring = periodic(c, 1e9)) BOOST_TEST((!has_nan(ring->curve) && !std::isnan(ring->deviation)));
      if (const auto whole = join(c, c, 1e9)) BOOST_TEST((!has_nan(whole->curve) && !std::isnan(whole->deviation)));
      BOOST_TEST(!std::isnan(deviation_bound(c, elevate(c, 1), 1)));
      const Joint j = joint(c, c);
      BOOST_TEST(!(j.parametric < -1 || j.geometric < -1));
    }
  }
}

BOOST_AUTO_TEST_CASE(no_operation_on_a_surface_returns_nan) {
  Cases cases(52);
  for (int i = 0; i < 200; ++i) {
    const NurbsSurface s = cases.surface(cases.degree(5), cases.degree(4), cases.weights(), 1);
    const double u = cases.parameter(s.knots_u(), s.domain_u());
    BOOST_TEST_CONTEXT("case " << i) {
      BOOST_TEST(!std::isnan(evaluate_bounded(s, {u, s.domain_v().mid()}).error));
      BOOST_TEST(!has_nan(refine_u(s, std::vector<double>{u})));
      BOOST_TEST(!has_nan(elevate(s, 1, 1)));
      BOOST_TEST(!has_nan(isocurve_u(s, u)));
      BOOST_TEST(!has_nan(hodograph_u(s)));
      BOOST_TEST(!has_nan(hodograph_v(s)));
      BOOST_TEST(!has_nan(clamped(s)));
      BOOST_TEST(!has_nan(moebius(s, 0.5, 3)));
      BOOST_TEST(!has_nan(extended_u(s, End::Finish, 0.1)));
      BOOST_TEST(!has_nan(remove_knots(s, 1e-3).surface));
      if (const auto lower = reduce(s, s.degree_u() > 1, s.degree_v() > 1)) BOOST_TEST((!has_nan(lower->surface) && !std::isnan(lower->error)));
    }
  }
}

BOOST_AUTO_TEST_CASE(no_fit_returns_nan) {
  Cases cases(53);
  for (int i = 0; i < 300; ++i) {
    // Points with repetitions, runs along lines and back, and steps over many decades.
    std::vector<Point> points;
    Point at;
    for (int k = cases.integer(2, 14); k > 0; --k) {
      const double step = std::pow(10.0, cases.real(-9, 2));
      const double r = cases.real(0, 1);
      if (r < 0.2 && !points.empty()) at = points.back();
      if (r > 0.3) at = at + step * Vector{cases.real(-1, 1), cases.real(-1, 1), cases.real(-1, 1)};
      if (r >= 0.2 && r <= 0.3) at = at + Vector{step, 0, 0};
      points.push_back(at);
    }
    BOOST_TEST_CONTEXT("case " << i) {
      const int degree = cases.integer(1, 4);
      const auto check = [&](const Result<Fit>& fit) {
        if (fit) BOOST_TEST((!has_nan(fit->curve) && !std::isnan(fit->error) && !has_nan(fit->parameters)));
      };
      check(interpolate(points, degree));
      check(interpolate(points, degree, Vector{1, 0, 0}, Vector{0, 1, 0}, Spacing::Centripetal));
      check(interpolate_local(points));
      check(interpolate_local(points, true));
      check(interpolate_closed(points, 3));
      check(approximate_within(points, 1e-2, degree));
      check(fit_local(points, 1e-2, i % 2));
      LeastSquares how;
      how.poles = static_cast<std::size_t>(degree) + 2, how.degree = degree;
      check(approximate(points, how));
    }
  }
}
