#include "base/assert.h"
#include "kernel/nurbs/basis.h"
#include "kernel/nurbs/builder.h"
#include "kernel/nurbs/homogeneous.h"
#include "kernel/nurbs/knots.h"
#include "kernel/nurbs/net.h"

namespace trimloop {

using detail::Net;

namespace {

Net net(const NurbsCurve& c) { return {c.degree(), 1, c.knots(), c.poles()}; }

NurbsCurve curve(Net n, bool rational, Interval range) {
  return NurbsBuilder::curve(n.degree, rational, std::move(n.knots), std::move(n.poles), range);
}

}  // namespace

NurbsCurve insert_knot(const NurbsCurve& c, double t, int times) {
  return refine(c, std::vector<double>(static_cast<std::size_t>(std::clamp(times, 0, c.degree())), t));
}

NurbsCurve refine(const NurbsCurve& c, std::span<const double> new_knots) {
  const Net n = net(c);
  return curve(detail::refined(n, detail::insertable(n, new_knots)), c.is_rational(), c.range());
}

NurbsCurve elevate(const NurbsCurve& c, int by) {
  TRIMLOOP_ASSERT(by >= 0 && by <= detail::max_degree - c.degree(), "the elevated degree is at most 64");
  if (by == 0) return c;
  Net n = net(c);
  for (int i = 0; i < by; ++i) n = detail::elevated(n);
  return curve(std::move(n), c.is_rational(), c.range());
}

NurbsCurve reversed(const NurbsCurve& c) {
  const Interval d = c.domain(), range{detail::mirrored(d, c.range().hi), detail::mirrored(d, c.range().lo)};
  return curve(detail::reversed(net(c)), c.is_rational(), range);
}

std::pair<NurbsCurve, NurbsCurve> split(const NurbsCurve& c, double t) {
  const Interval range = c.range();
  TRIMLOOP_ASSERT(range.lo < t && t < range.hi, "a curve is split strictly inside its range");
  // The knot is made full first, so that both pieces take their common end pole from the same place.
  const NurbsCurve full = insert_knot(c, t, c.degree());
  return {trimmed(full, {range.lo, t}), trimmed(full, {t, range.hi})};
}

NurbsCurve trimmed(const NurbsCurve& c, Interval range) {
  range = {c.domain().clamp(range.lo), c.domain().clamp(range.hi)};
  TRIMLOOP_ASSERT(range.lo < range.hi, "the part that is kept has a length");
  return curve(detail::part(net(c), range), c.is_rational(), range);
}

std::vector<NurbsCurve> bezier_pieces(const NurbsCurve& c) {
  std::vector<NurbsCurve> pieces;
  const std::vector<double> ends = breaks(c);
  if (!(ends.front() < ends.back())) return pieces;
  const std::size_t p = static_cast<std::size_t>(c.degree());
  Net n = detail::part(net(c), c.range());
  std::vector<double> inner;
  for (std::size_t i = 1; i + 1 < ends.size(); ++i) inner.insert(inner.end(), p, ends[i]);
  n = detail::refined(n, detail::insertable(n, inner));
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    std::vector<double> knots(p + 1, ends[i]);
    knots.insert(knots.end(), p + 1, ends[i + 1]);
    const auto pole = n.poles.begin() + static_cast<std::ptrdiff_t>(i * p);
    pieces.push_back(NurbsBuilder::curve(c.degree(), c.is_rational(), std::move(knots),
                                         {pole, pole + static_cast<std::ptrdiff_t>(p + 1)}, {ends[i], ends[i + 1]}));
  }
  return pieces;
}

NurbsCurve transformed(const NurbsCurve& c, const Transform& m) {
  std::vector<Hpoint> poles = c.poles();
  for (Hpoint& h : poles) h = detail::apply(m, h);
  return NurbsBuilder::curve(c.degree(), c.is_rational(), c.knots(), std::move(poles), c.range());
}

NurbsCurve reparametrized(const NurbsCurve& c, Interval new_range) {
  const Interval old = c.range();
  TRIMLOOP_ASSERT(old.lo < old.hi && new_range.lo < new_range.hi, "both ranges have a length");
  std::vector<double> knots = c.knots();
  for (double& t : knots) t = std::lerp(new_range.lo, new_range.hi, (t - old.lo) / (old.hi - old.lo));
  return NurbsBuilder::curve(c.degree(), c.is_rational(), std::move(knots), c.poles(), new_range);
}

Box bounding_box(const NurbsCurve& c) {
  const Interval range = c.range();
  const bool whole = range.lo == c.knots().front() && range.hi == c.knots().back();
  if (whole) return detail::hull_box(c.poles());
  if (!(range.lo < range.hi)) return detail::point_box(evaluate(c, range.lo));
  return detail::hull_box(detail::part(net(c), range).poles);
}

}  // namespace trimloop
