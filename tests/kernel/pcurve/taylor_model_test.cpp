#include "kernel/pcurve/taylor_model.h"

#include <boost/multiprecision/cpp_dec_float.hpp>
#include <boost/test/unit_test.hpp>
#include <random>

using namespace trimloop;
using detail::TaylorModel;
using Real = boost::multiprecision::cpp_dec_float_50;

namespace {

Real value(const TaylorModel& m, double x) {
  Real sum = 0;
  for (int k = TaylorModel::order; k >= 0; --k) sum = sum * x + m.coefficient(k);
  return sum;
}

// The model holds f over [lo, hi]; returns its radius.
template <class F>
double check(const TaylorModel& m, double lo, double hi, F f) {
  for (int i = 0; i <= 64; ++i) {
    const double x = -1 + i / 32.0;
    const Real t = Real(lo) * (1 - Real(x)) / 2 + Real(hi) * (1 + Real(x)) / 2;
    const Real off = abs(value(m, x) - f(t));
    BOOST_TEST(off <= Real(m.radius()));
    BOOST_TEST(f(t) <= Real(m.upper()));
    BOOST_TEST(f(t) >= Real(m.lower()));
  }
  return m.radius();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(taylor_model)

BOOST_AUTO_TEST_CASE(models_hold_the_functions_they_stand_for) {
  std::mt19937 random(3);
  const auto real = [&](double lo, double hi) { return lo + (hi - lo) * static_cast<double>(random()) / 4294967295.0; };
  for (int k = 0; k < 200; ++k) {
    const double lo = real(-4, 4), hi = lo + std::pow(10, real(-4, 0));
    const TaylorModel t = TaylorModel::over(lo, hi);
    TaylorModel s, c, sh, ch;
    sin_cos(t, s, c);
    sinh_cosh(t, sh, ch);
    check(s, lo, hi, [](Real x) { return sin(x); });
    check(c, lo, hi, [](Real x) { return cos(x); });
    check(sh, lo, hi, [](Real x) { return sinh(x); });
    check(ch, lo, hi, [](Real x) { return cosh(x); });
    const TaylorModel w = square(t) + TaylorModel(0.7);
    check(reciprocal(w), lo, hi, [](Real x) { return 1 / (x * x + Real(0.7)); });
    check(sqrt(w), lo, hi, [](Real x) { return sqrt(x * x + Real(0.7)); });
    check(s * reciprocal(w) - 0.3 * (c * t), lo, hi,
          [](Real x) { return sin(x) / (x * x + Real(0.7)) - Real(0.3) * cos(x) * x; });
  }
}

BOOST_AUTO_TEST_CASE(short_intervals_leave_only_rounding) {
  TaylorModel s, c;
  sin_cos(TaylorModel::over(1, 1.02), s, c);
  BOOST_TEST(s.radius() < 1e-14);
  BOOST_TEST(reciprocal(TaylorModel::over(1, 1.02)).radius() < 1e-14);
}

BOOST_AUTO_TEST_CASE(what_may_divide_by_zero_is_unknown) {
  BOOST_TEST(!reciprocal(TaylorModel::over(-1, 1)).is_finite());
  BOOST_TEST(!sqrt(TaylorModel::over(-0.1, 1)).is_finite());
}

BOOST_AUTO_TEST_SUITE_END()
