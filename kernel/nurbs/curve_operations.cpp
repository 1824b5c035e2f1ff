#include "base/assert.h"
#include "kernel/nurbs/builder.h"
#include "kernel/nurbs/homogeneous.h"

namespace trimloop {

NurbsCurve transformed(const NurbsCurve& c, const Transform& m) {
  std::vector<Hpoint> poles = c.poles();
  for (Hpoint& h : poles) h = detail::apply(m, h);
  return NurbsBuilder::curve(c.degree(), c.is_rational(), c.knots(), std::move(poles), c.range());
}

Box bounding_box(const NurbsCurve& c) {
  const int first = find_span(c.degree(), c.knots(), c.poles().size(), c.range().lo);
  const int last = find_span(c.degree(), c.knots(), c.poles().size(), c.range().hi);
  const auto begin = c.poles().begin();
  return detail::hull_box({begin + (first - c.degree()), begin + (last + 1)});
}

}  // namespace trimloop
