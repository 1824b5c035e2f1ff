#include "kernel/nurbs/bezier.h"

#include <fmt/format.h>

#include "base/assert.h"
#include "kernel/nurbs/basis.h"
#include "kernel/nurbs/binomial.h"

namespace trimloop {
namespace {

// `apply` on every column, then on every row of a net.
template <class F>
std::vector<Hpoint> both_ways(std::span<const Hpoint> net, std::size_t columns, F apply) {
  TRIMLOOP_ASSERT(columns > 0 && net.size() % columns == 0, "a net is a rectangle");
  const std::size_t rows = net.size() / columns;
  std::vector<Hpoint> out(net.begin(), net.end());
  for (std::size_t j = 0; j < columns; ++j) {
    std::vector<Hpoint> line;
    for (std::size_t i = 0; i < rows; ++i) line.push_back(out[i * columns + j]);
    line = apply(line);
    for (std::size_t i = 0; i < rows; ++i) out[i * columns + j] = line[i];
  }
  for (std::size_t i = 0; i < rows; ++i) {
    const std::vector<Hpoint> line = apply(std::span<const Hpoint>(out).subspan(i * columns, columns));
    std::copy(line.begin(), line.end(), out.begin() + static_cast<std::ptrdiff_t>(i * columns));
  }
  return out;
}

template <class F>
Hpoint along_both(std::span<const Hpoint> net, std::size_t columns, Uv uv, F value) {
  TRIMLOOP_ASSERT(columns > 0 && net.size() % columns == 0, "a net is a rectangle");
  std::vector<Hpoint> column;
  for (std::size_t i = 0; i < net.size(); i += columns) column.push_back(value(net.subspan(i, columns), uv.v));
  return value(column, uv.u);
}

}  // namespace

Hpoint horner(std::span<const Hpoint> a, double t) {
  TRIMLOOP_ASSERT(!a.empty(), "a polynomial has a coefficient");
  Hpoint sum = a.back();
  for (std::size_t i = a.size() - 1; i-- > 0;) sum = t * sum + a[i];
  return sum;
}

Hpoint horner(std::span<const Hpoint> a, std::size_t columns, Uv uv) {
  return along_both(a, columns, uv, [](std::span<const Hpoint> c, double t) { return horner(c, t); });
}

std::vector<double> all_bernstein(int degree, double t) {
  TRIMLOOP_ASSERT(degree >= 0, "a degree is not negative");
  std::vector<double> b(static_cast<std::size_t>(degree) + 1, 0.0);
  b[0] = 1;
  for (std::size_t j = 1; j < b.size(); ++j) {
    double carried = 0;
    for (std::size_t k = 0; k < j; ++k) {
      const double old = b[k];
      b[k] = carried + (1 - t) * old;
      carried = t * old;
    }
    b[j] = carried;
  }
  return b;
}

double bernstein(int degree, int i, double t) {
  return i < 0 || i > degree ? 0 : all_bernstein(degree, t)[static_cast<std::size_t>(i)];
}

Hpoint bezier_point(std::span<const Hpoint> poles, double t) {
  const std::vector<double> b = all_bernstein(static_cast<int>(poles.size()) - 1, t);
  Hpoint sum{0, 0, 0, 0};
  for (std::size_t i = 0; i < poles.size(); ++i) sum = sum + b[i] * poles[i];
  return sum;
}

Hpoint de_casteljau(std::span<const Hpoint> poles, double t) {
  TRIMLOOP_ASSERT(!poles.empty(), "a Bezier curve has a pole");
  std::vector<Hpoint> q(poles.begin(), poles.end());
  for (std::size_t left = q.size() - 1; left > 0; --left)
    for (std::size_t i = 0; i < left; ++i) q[i] = (1 - t) * q[i] + t * q[i + 1];
  return q[0];
}

Hpoint de_casteljau(std::span<const Hpoint> poles, std::size_t columns, Uv uv) {
  return along_both(poles, columns, uv, [](std::span<const Hpoint> c, double t) { return de_casteljau(c, t); });
}

BezierTangent bezier_tangent(std::span<const Hpoint> poles, double t) {
  TRIMLOOP_ASSERT(poles.size() >= 2, "a Bezier curve with a direction has two poles");
  const double n = static_cast<double>(poles.size()) - 1;
  const Hpoint a = de_casteljau(poles.first(poles.size() - 1), t), b = de_casteljau(poles.subspan(1), t);
  const Hpoint at = (1 - t) * a + t * b;
  // w_a w_b (B - A) written without division.
  const Vector cross{a.w * b.x - b.w * a.x, a.w * b.y - b.w * a.y, a.w * b.z - b.w * a.z};
  return {project(at), n / (at.w * at.w) * cross};
}

std::vector<Hpoint> bezier_to_power(std::span<const Hpoint> poles) {
  std::vector<Hpoint> d(poles.begin(), poles.end());  // after step j, d[j] is the j-th difference at the start
  for (std::size_t j = 1; j < d.size(); ++j)
    for (std::size_t i = d.size() - 1; i >= j; --i) d[i] = d[i] - d[i - 1];
  for (std::size_t j = 0; j < d.size(); ++j) d[j] = detail::binomial(d.size() - 1, j) * d[j];
  return d;
}

std::vector<Hpoint> power_to_bezier(std::span<const Hpoint> a) {
  const std::size_t n = a.size();
  std::vector<Hpoint> b(n, Hpoint{0, 0, 0, 0});
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) b[i] = b[i] + detail::binomial(i, j) / detail::binomial(n - 1, j) * a[j];
  return b;
}

std::vector<Hpoint> bezier_to_power(std::span<const Hpoint> poles, std::size_t columns) {
  return both_ways(poles, columns, [](std::span<const Hpoint> c) { return bezier_to_power(c); });
}
std::vector<Hpoint> power_to_bezier(std::span<const Hpoint> coefficients, std::size_t columns) {
  return both_ways(coefficients, columns, [](std::span<const Hpoint> c) { return power_to_bezier(c); });
}

PowerForm to_power(const NurbsCurve& c) {
  PowerForm out;
  for (const NurbsCurve& piece : bezier_pieces(c)) {
    if (out.breaks.empty()) out.breaks.push_back(piece.range().lo);
    out.breaks.push_back(piece.range().hi);
    std::vector<Hpoint> a = bezier_to_power(piece.poles());
    const double h = piece.range().length();
    double power = 1;
    for (Hpoint& coefficient : a) coefficient = 1 / power * coefficient, power *= h;
    out.pieces.push_back(std::move(a));
  }
  return out;
}

Result<FromPower> from_power(const PowerForm& form) {
  if (form.pieces.empty() || form.breaks.size() != form.pieces.size() + 1)
    return fail(ErrorCode::InvalidArgument,
                fmt::format("{} breaks do not bound {} pieces", form.breaks.size(), form.pieces.size()));
  const std::size_t order = form.pieces.front().size();
  if (order < 2 || order > static_cast<std::size_t>(detail::max_degree) + 1)
    return fail(ErrorCode::InvalidArgument, fmt::format("a piece of {} coefficients has no degree of 1 to 64", order));
  std::vector<double> knots{form.breaks.front()};
  std::vector<Hpoint> poles;
  double gap = 0;
  for (std::size_t i = 0; i < form.pieces.size(); ++i) {
    if (form.pieces[i].size() != order)
      return fail(ErrorCode::InvalidArgument,
                  fmt::format("piece {} has {} coefficients, the first has {}", i, form.pieces[i].size(), order));
    const double h = form.breaks[i + 1] - form.breaks[i];
    if (!(h > 0))
      return fail(ErrorCode::InvalidArgument, fmt::format("breaks {} and {} do not ascend", i, i + 1), h, 0);
    std::vector<Hpoint> a = form.pieces[i];
    double power = 1;
    for (Hpoint& coefficient : a) coefficient = power * coefficient, power *= h;
    std::vector<Hpoint> b = power_to_bezier(a);
    if (i > 0) {
      const Hpoint jump = b[0] - poles.back();
      gap = std::max({gap, std::abs(jump.x), std::abs(jump.y), std::abs(jump.z), std::abs(jump.w)});
      poles.back() = poles.back() + 0.5 * jump;
    }
    poles.insert(poles.end(), b.begin() + (i > 0), b.end());
    knots.insert(knots.end(), order - 1, form.breaks[i]);
  }
  knots.insert(knots.end(), order, form.breaks.back());
  auto curve = NurbsCurve::from_homogeneous(static_cast<int>(order) - 1, std::move(knots), std::move(poles));
  if (!curve) return tl::unexpected<Error>(curve.error());
  return FromPower{std::move(*curve), gap};
}

}  // namespace trimloop
