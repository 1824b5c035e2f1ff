// Points against exact arithmetic: errors in units of eps (max |w_i P_i| + |S| max |w_i|) / |w| over the poles of the
// span, and never above the bound that the kernel states.
#include <boost/test/unit_test.hpp>

#include "kernel/nurbs/error_bound.h"
#include "tests/exact/cases.h"

using namespace trimloop;
using namespace trimloop::exact;

namespace {

double allowed_units(int degree) { return degree <= 5 ? 4 : 2 * (degree + 1); }

// The largest errors seen, per degree.
struct Tally {
  std::array<double, 26> units{}, share_of_bound{};
  int cases = 0, near_infinite = 0;
  void report(const char* what) const {
    double low = 0, high = 0, share = 0;
    for (std::size_t p = 1; p <= 25; ++p) {
      if (p <= 5) low = std::max(low, units[p]);
      high = std::max(high, units[p] / (2 * (static_cast<double>(p) + 1)));
      share = std::max(share, share_of_bound[p]);
    }
    BOOST_TEST_MESSAGE(what << ": " << cases << " cases, largest error " << low << " units at degree <= 5, " << high
                            << " of 2(p+1) units at any degree, " << share << " of the stated bound; " << near_infinite
                            << " points too near to infinity for a bound");
  }
};

void count(Tally& tally, int degree, const Row& h, const Size& size, const BoundedPoint& found) {
  ++tally.cases;
  const double w = std::abs(as_double(h[3]));
  // Where the weights cancel to rounding there is no point to speak of, and the kernel says so by an infinite bound.
  if (!(found.error < infinity)) {
    ++tally.near_infinite;
    BOOST_TEST(w <= 20 * (degree + 1) * epsilon * size.weight);
    return;
  }
  const double error = difference(projected(h), found.point), in_units = error / unit(h, size);
  BOOST_TEST(error <= found.error);
  // Close to that only the bound can hold: units are of first order in eps W / |w|.
  if (w > 1e-3 * size.weight || w > 1000 * (degree + 1) * epsilon * size.weight)
    BOOST_TEST(in_units <= allowed_units(degree));
  const std::size_t p = static_cast<std::size_t>(degree);
  if (unit(h, size) > 0) tally.units[p] = std::max(tally.units[p], in_units);
  if (found.error > 0) tally.share_of_bound[p] = std::max(tally.share_of_bound[p], error / found.error);
}

}  // namespace

BOOST_AUTO_TEST_CASE(curve_points_are_right_to_a_few_units) {
  Cases cases(1);
  Tally tally;
  for (int i = 0; i < 9000; ++i) {
    const int p = cases.degree();
    const NurbsCurve c = cases.curve(p, cases.weights());
    const double t = cases.parameter(c.knots(), c.domain());
    const Spline s = exact::exact(c);
    const std::size_t k = span(s, t);
    const std::span<const Hpoint> active(c.poles().data() + k - s.degree, s.degree + 1);
    const BoundedPoint found = evaluate_bounded(c, t);
    const Point same = evaluate(c, t);
    if (found.error < infinity)
      BOOST_TEST((same.x == found.point.x && same.y == found.point.y && same.z == found.point.z));
    const Row h = blossom(s, k, std::vector<Rational>(s.degree, t));
    if (h[3] == 0) BOOST_TEST(!(found.error < infinity));
    if (h[3] != 0) count(tally, p, h, size_of(active), found);
  }
  tally.report("curves");
}

BOOST_AUTO_TEST_CASE(surface_points_are_right_to_a_few_units) {
  Cases cases(2);
  Tally tally;
  for (int i = 0; i < 1500; ++i) {
    const int p = cases.degree(i % 50 == 0 ? 14 : 5), q = cases.degree(5);
    const NurbsSurface s = cases.surface(p, q, cases.weights());
    const Uv at{cases.parameter(s.knots_u(), s.domain_u()), cases.parameter(s.knots_v(), s.domain_v())};
    const Spline rows = exact::exact(s);
    const Spline column = along_v(s, value(rows, at.u));
    const Row h = value(column, at.v);
    Size size;
    const std::size_t ku = span(rows, at.u), kv = span(column, at.v);
    for (std::size_t a = ku - rows.degree; a <= ku; ++a)
      for (std::size_t b = kv - column.degree; b <= kv; ++b) size.add(s.pole(a, b));
    if (h[3] != 0) count(tally, std::max(p, q), h, size, evaluate_bounded(s, at));
  }
  tally.report("surfaces");
}
