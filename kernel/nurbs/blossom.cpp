#include "kernel/nurbs/blossom.h"

#include "base/assert.h"
#include "kernel/nurbs/basis.h"

namespace trimloop {
namespace {

// d: the p + 1 poles of the span; at: its first knot.
Hpoint polar(std::vector<Hpoint> d, const double* at, std::span<const double> arguments) {
  const std::size_t p = d.size() - 1;
  for (std::size_t j = 1; j <= p; ++j)
    for (std::size_t i = p; i >= j; --i) {
      const double a = *(at + i - p), b = *(at + i + 1 - j);
      const double share = (arguments[j - 1] - a) / (b - a);
      d[i] = (1 - share) * d[i - 1] + share * d[i];
    }
  return d[p];
}

}  // namespace

Hpoint blossom(const NurbsCurve& c, double span_at, std::span<const double> arguments) {
  const std::size_t p = static_cast<std::size_t>(c.degree());
  TRIMLOOP_ASSERT(arguments.size() == p, "the polar form takes degree arguments");
  const std::size_t k = detail::span_of(c.knots().data(), p, c.poles().size(), c.domain().clamp(span_at));
  const auto first = c.poles().begin() + static_cast<std::ptrdiff_t>(k - p);
  return polar({first, first + c.degree() + 1}, c.knots().data() + k, arguments);
}

Hpoint blossom(const NurbsSurface& s, Uv span_at, std::span<const double> arguments_u,
               std::span<const double> arguments_v) {
  const std::size_t p = static_cast<std::size_t>(s.degree_u()), q = static_cast<std::size_t>(s.degree_v());
  TRIMLOOP_ASSERT(arguments_u.size() == p && arguments_v.size() == q, "the polar form takes degree arguments each way");
  const std::size_t ku = detail::span_of(s.knots_u().data(), p, s.poles_u(), s.domain_u().clamp(span_at.u));
  const std::size_t kv = detail::span_of(s.knots_v().data(), q, s.poles_v(), s.domain_v().clamp(span_at.v));
  std::vector<Hpoint> column;
  for (std::size_t i = ku - p; i <= ku; ++i) {
    const Hpoint* row = &s.pole(i, kv - q);
    column.push_back(polar({row, row + q + 1}, s.knots_v().data() + kv, arguments_v));
  }
  return polar(std::move(column), s.knots_u().data() + ku, arguments_u);
}

std::vector<Hpoint> segment_poles(const NurbsCurve& c, double span_at, Interval over) {
  const std::size_t p = static_cast<std::size_t>(c.degree());
  std::vector<double> arguments(p, over.lo);
  std::vector<Hpoint> out{blossom(c, span_at, arguments)};
  for (std::size_t i = 0; i < p; ++i) {
    arguments[i] = over.hi;
    out.push_back(blossom(c, span_at, arguments));
  }
  return out;
}

}  // namespace trimloop
