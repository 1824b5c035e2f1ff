#include "kernel/batch/pieces.h"

#include <array>

#include "base/assert.h"
#include "kernel/batch/access.h"
#include "kernel/nurbs/knots.h"
#include "kernel/nurbs/net.h"

namespace trimloop {

namespace {

// Every inner break of the range raised to multiplicity degree: the poles then are those of the Bezier pieces, with
// their end rows shared.
detail::Net decomposed(detail::Net n, Interval range) {
  n = detail::part(n, range);
  std::vector<double> wanted;
  for (double t : detail::breaks(n.knots, n.domain()))
    if (t > range.lo && t < range.hi) wanted.insert(wanted.end(), n.p(), t);
  return detail::refined(n, detail::insertable(n, wanted));
}

// Sum of a[i] b[i], correct to about an ulp of the result plus eps^2 times the sum of magnitudes. Ogita, Rump, Oishi
// 2005, algorithm 5.3.
double exact_dot(std::span<const double> a, const double* b, std::size_t stride) {
  double sum = 0, low = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double x = b[i * stride], product = a[i] * x, next = sum + product, shown = next - sum;
    low += std::fma(a[i], x, -product) + ((sum - (next - shown)) + (product - shown));
    sum = next;
  }
  return sum + low;
}

// From Bernstein on [-1, 1] to powers of x. Entry (k, i) is binomial(n, i) / 2^n times the coefficient of x^k in
// (1 + x)^i (1 - x)^(n - i): a dyadic number, exact.
std::vector<double> monomial_matrix(int degree) {
  const std::size_t n = static_cast<std::size_t>(degree);
  std::vector<double> m((n + 1) * (n + 1));
  double binomial = 1;
  for (std::size_t i = 0; i <= n; ++i) {
    std::vector<double> c(n + 1);
    c[0] = binomial / std::ldexp(1.0, degree);
    for (std::size_t factor = 0; factor < n; ++factor)
      for (std::size_t k = factor + 1; k-- > 0;) c[k + 1] += factor < i ? c[k] : -c[k];
    for (std::size_t k = 0; k <= n; ++k) m[k * (n + 1) + i] = c[k];
    binomial = binomial * static_cast<double>(n - i) / static_cast<double>(i + 1);
  }
  return m;
}

// `lines` sets of degree + 1 points, `stride` numbers apart inside a set, `next` from set to set; in place.
void to_monomial(int degree, double* numbers, std::size_t lines, std::size_t stride, std::size_t next) {
  const std::size_t n = static_cast<std::size_t>(degree) + 1;
  const std::vector<double> m = monomial_matrix(degree);
  std::array<double, monomial_degree + 1> out{};
  for (std::size_t line = 0; line < lines; ++line)
    for (std::size_t c = 0; c < 4; ++c) {
      double* first = numbers + line * next + c;
      for (std::size_t k = 0; k < n; ++k) out[k] = exact_dot({m.data() + k * n, n}, first, stride);
      for (std::size_t k = 0; k < n; ++k) first[k * stride] = out[k];
    }
}

double bounded_inverse(double length) {
  return std::min(1 / length, 0.25 * std::numeric_limits<double>::max());  // of a length that is not normal
}

}  // namespace

Spans::Spans(std::vector<double> breaks) : breaks_(std::move(breaks)) {
  TRIMLOOP_ASSERT(breaks_.size() >= 2, "a range with a length has two breaks");
  const std::size_t spans = breaks_.size() - 1, cells = 4 * spans;
  for (std::size_t i = 0; i < spans; ++i) inverse_lengths_.push_back(bounded_inverse(breaks_[i + 1] - breaks_[i]));
  cells_per_unit_ = static_cast<double>(cells) / (breaks_.back() - breaks_.front());
  if (!std::isfinite(cells_per_unit_)) cells_per_unit_ = 0;
  // The cell of a parameter never falls as the parameter grows, so that what lies in a later cell than a break lies
  // beyond the break, whatever was rounded.
  std::vector<std::uint32_t> inside(cells);
  for (std::size_t i = 1; i < spans; ++i) {
    const double cell = (breaks_[i] - breaks_[0]) * cells_per_unit_;
    ++inside[std::min(static_cast<std::size_t>(cell), cells - 1)];
  }
  std::uint32_t before = 0;
  for (std::uint32_t count : inside) {
    first_.push_back(before);
    before += count;
    steps_ = std::max(steps_, count);
  }
  breaks_.push_back(infinity);
}

std::size_t Spans::locate(double t) const {
  const double in = t > lo() ? std::min(t, hi()) : lo();
  const std::size_t cell = static_cast<std::size_t>((in - lo()) * cells_per_unit_);
  std::size_t k = first_[std::min(cell, first_.size() - 1)];
  if (steps_ > 2)
    k = static_cast<std::size_t>(std::upper_bound(breaks_.begin(), breaks_.end() - 1, in) - breaks_.begin()) - 1;
  while (in >= breaks_[k + 1]) ++k;
  return std::min(k, size() - 1);
}

double Spans::local(std::size_t i, double t) const {
  const double in = t < breaks_[i] ? breaks_[i] : t > breaks_[i + 1] ? breaks_[i + 1] : t;
  return ((in - breaks_[i]) - (breaks_[i + 1] - in)) * inverse_lengths_[i];
}

CurvePieces::CurvePieces(const NurbsCurve& c)
    : degree_(c.degree()), rational_(c.is_rational()), spans_(trimloop::breaks(c)) {
  const detail::Net n = decomposed({c.degree(), 1, c.knots(), c.poles()}, c.range());
  const std::size_t p = n.p();
  for (std::size_t a = 0; a < size(); ++a)
    for (std::size_t i = 0; i <= p; ++i) bezier_.push_back(n.poles[a * p + i]);
  if (degree_ > monomial_degree) return;
  monomial_ = bezier_;
  to_monomial(degree_, &monomial_.data()->x, size(), 4, 4 * (p + 1));
}

std::span<const Hpoint> CurvePieces::bezier(std::size_t piece) const {
  const std::size_t count = static_cast<std::size_t>(degree_) + 1;
  return {bezier_.data() + piece * count, count};
}

SurfacePieces::SurfacePieces(const NurbsSurface& s)
    : degree_u_(s.degree_u()),
      degree_v_(s.degree_v()),
      rational_(s.is_rational()),
      spans_u_(trimloop::breaks_u(s)),
      spans_v_(trimloop::breaks_v(s)) {
  const detail::Net along_u = decomposed({s.degree_u(), s.poles_v(), s.knots_u(), s.poles()}, s.range_u());
  const std::size_t rows = along_u.rows(), columns = s.poles_v();
  std::vector<Hpoint> turned(rows * columns);
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j) turned[j * rows + i] = along_u.poles[i * columns + j];
  const detail::Net n = decomposed({s.degree_v(), rows, s.knots_v(), std::move(turned)}, s.range_v());

  const std::size_t p = along_u.p(), q = n.p();
  bezier_.reserve(size() * (p + 1) * (q + 1));
  for (std::size_t a = 0; a < spans_u_.size(); ++a)
    for (std::size_t b = 0; b < spans_v_.size(); ++b)
      for (std::size_t j = 0; j <= q; ++j)
        for (std::size_t i = 0; i <= p; ++i) bezier_.push_back(n.poles[(b * q + j) * rows + a * p + i]);
  if (!rational_)
    for (Hpoint& h : bezier_) h.w = 1;
  if (std::max(degree_u_, degree_v_) > monomial_degree) return;
  monomial_ = bezier_;
  const std::size_t patch = 4 * (p + 1) * (q + 1);
  for (std::size_t k = 0; k < size(); ++k) {
    double* numbers = &monomial_.data()->x + k * patch;
    to_monomial(degree_u_, numbers, q + 1, 4, 4 * (p + 1));
    to_monomial(degree_v_, numbers, p + 1, 4 * (p + 1), 4);
  }
}

std::span<const Hpoint> SurfacePieces::bezier(std::size_t a, std::size_t b) const {
  const std::size_t count = static_cast<std::size_t>((degree_u_ + 1) * (degree_v_ + 1));
  return {bezier_.data() + (a * spans_v_.size() + b) * count, count};
}

}  // namespace trimloop
