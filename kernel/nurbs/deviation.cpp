#include "kernel/nurbs/deviation.h"

#include "kernel/nurbs/homogeneous.h"
#include "kernel/nurbs/net.h"

namespace trimloop {
namespace {

using detail::Net;

void to_common_degree(Net& a, Net& b) {
  while (a.degree < b.degree) a = detail::elevated(a);
  while (b.degree < a.degree) b = detail::elevated(b);
}

// The knots of `wanted` inside the domain that `has` lacks, with multiplicity.
std::vector<double> missing(const std::vector<double>& has, const std::vector<double>& wanted) {
  std::vector<double> out;
  std::set_difference(wanted.begin(), wanted.end(), has.begin(), has.end(), std::back_inserter(out));
  return out;
}

void to_common_knots(Net& a, Net& b) {
  const std::vector<double> for_a = missing(a.knots, b.knots), for_b = missing(b.knots, a.knots);
  a = detail::refined(a, detail::insertable(a, for_a));
  b = detail::refined(b, detail::insertable(b, for_b));
}

void halve_spans(Net& a, Net& b) {
  std::vector<double> middle;
  for (std::size_t i = 0; i + 1 < a.knots.size(); ++i) {
    const double m = 0.5 * (a.knots[i] + a.knots[i + 1]);
    if (a.knots[i] < m && m < a.knots[i + 1]) middle.push_back(m);
  }
  a = detail::refined(a, middle);
  b = detail::refined(b, middle);
}

// Over each run of degree + 1 poles (of rows) by itself, so that a weight that is small in one place counts there only.
double largest(const Net& a, const Net& b, std::size_t order_across) {
  double worst = 0;
  const std::size_t rows = a.rows(), p = a.p();
  constexpr double eps = std::numeric_limits<double>::epsilon();
  for (std::size_t i = p; i < rows; ++i) {
    if (!(a.knots[i] < a.knots[i + 1])) continue;
    for (std::size_t c = 0; c + order_across <= a.width; ++c) {
      double apart = 0, weights_apart = 0, least = infinity, size = 0, heaviest = 0, point = 0;
      for (std::size_t k = i - p; k <= i; ++k)
        for (std::size_t l = c; l < c + order_across; ++l) {
          const Hpoint &f = a.poles[k * a.width + l], &g = b.poles[k * a.width + l];
          apart = std::max(apart, norm(detail::xyz(f - g)));
          weights_apart = std::max(weights_apart, std::abs(f.w - g.w));
          least = std::min({least, f.w, g.w});
          size = std::max({size, norm(detail::xyz(f)), norm(detail::xyz(g))});
          heaviest = std::max({heaviest, f.w, g.w});
          point = std::max(point, norm(detail::xyz(g)) / g.w);
        }
      if (!(least > 0)) return infinity;
      // Refinement and elevation cost a few units each; evaluation of either curve costs as many again.
      const double rounding = 32 * static_cast<double>(p + order_across) * eps;
      apart += rounding * size;
      weights_apart += rounding * heaviest * (weights_apart > 0 ? 1 : 0);
      worst = std::max(worst, (apart + point * weights_apart) / least);
    }
  }
  return worst;
}

// Divides all weights by the first, so that equal shapes of different scale compare as equal.
void normalize(Net& a) {
  const double w = a.poles.front().w;
  if (!(w > 0)) return;
  for (Hpoint& h : a.poles) h = {h.x / w, h.y / w, h.z / w, h.w / w};
}

}  // namespace

double deviation_bound(const NurbsCurve& a, const NurbsCurve& b, int refinements) {
  const Interval over{std::max(a.range().lo, b.range().lo), std::min(a.range().hi, b.range().hi)};
  if (!(over.lo < over.hi)) return infinity;
  const NurbsCurve part_a = trimmed(a, over), part_b = trimmed(b, over);
  Net x{a.degree(), 1, part_a.knots(), part_a.poles()}, y{b.degree(), 1, part_b.knots(), part_b.poles()};
  normalize(x);
  normalize(y);
  to_common_degree(x, y);
  to_common_knots(x, y);
  for (int i = 0; i < refinements; ++i) halve_spans(x, y);
  return largest(x, y, 1);
}

double deviation_bound(const NurbsSurface& a, const NurbsSurface& b, int refinements) {
  const Interval u{std::max(a.range_u().lo, b.range_u().lo), std::min(a.range_u().hi, b.range_u().hi)};
  const Interval v{std::max(a.range_v().lo, b.range_v().lo), std::min(a.range_v().hi, b.range_v().hi)};
  if (!(u.lo < u.hi) || !(v.lo < v.hi)) return infinity;
  const auto net = [](const NurbsSurface& s) { return Net{s.degree_u(), s.poles_v(), s.knots_u(), s.poles()}; };
  const auto turned = [](const Net& n, int degree, const std::vector<double>& knots) {
    const std::size_t rows = n.rows();
    Net out{degree, rows, knots, std::vector<Hpoint>(n.poles.size())};
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < n.width; ++j) out.poles[j * rows + i] = n.poles[i * n.width + j];
    return out;
  };
  const NurbsSurface part_a = trimmed(a, u, v), part_b = trimmed(b, u, v);
  Net x = net(part_a), y = net(part_b);
  normalize(x);
  normalize(y);
  to_common_degree(x, y);
  to_common_knots(x, y);
  for (int i = 0; i < refinements; ++i) halve_spans(x, y);
  x = turned(x, part_a.degree_v(), part_a.knots_v());
  y = turned(y, part_b.degree_v(), part_b.knots_v());
  const std::size_t order_u = static_cast<std::size_t>(std::max(a.degree_u(), b.degree_u())) + 1;
  to_common_degree(x, y);
  to_common_knots(x, y);
  for (int i = 0; i < refinements; ++i) halve_spans(x, y);
  return largest(x, y, order_u);
}

}  // namespace trimloop
