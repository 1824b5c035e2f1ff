#include "base/assert.h"
#include "kernel/nurbs/builder.h"
#include "kernel/nurbs/homogeneous.h"

namespace trimloop {

NurbsSurface transformed(const NurbsSurface& s, const Transform& m) {
  std::vector<Hpoint> poles = s.poles();
  for (Hpoint& h : poles) h = detail::apply(m, h);
  return NurbsBuilder::surface(s.degree_u(), s.degree_v(), s.is_rational(), s.knots_u(), s.knots_v(), std::move(poles),
                               s.range_u(), s.range_v());
}

Box bounding_box(const NurbsSurface& s) {
  const auto span = [](int degree, const std::vector<double>& knots, std::size_t poles, double t) {
    return static_cast<std::size_t>(find_span(degree, knots, poles, t));
  };
  const std::size_t p = static_cast<std::size_t>(s.degree_u()), q = static_cast<std::size_t>(s.degree_v());
  const std::size_t first_u = span(s.degree_u(), s.knots_u(), s.poles_u(), s.range_u().lo) - p;
  const std::size_t last_u = span(s.degree_u(), s.knots_u(), s.poles_u(), s.range_u().hi);
  const std::size_t first_v = span(s.degree_v(), s.knots_v(), s.poles_v(), s.range_v().lo) - q;
  const std::size_t last_v = span(s.degree_v(), s.knots_v(), s.poles_v(), s.range_v().hi);
  Box box;
  for (std::size_t i = first_u; i <= last_u; ++i)
    box.add(detail::hull_box({&s.pole(i, first_v), last_v - first_v + 1}));
  return box;
}

}  // namespace trimloop
