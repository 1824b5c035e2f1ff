#include "kernel/nurbs/reparametrize.h"

#include <fmt/format.h>

#include <array>

#include "base/assert.h"
#include "kernel/nurbs/basis.h"
#include "kernel/nurbs/binomial.h"
#include "kernel/nurbs/net.h"

namespace trimloop {
namespace {

using detail::Net;

Result<Net> moebius_net(const Net& n, double ratio) {
  if (!(ratio > 0) || !std::isfinite(ratio) || !std::isfinite(1 / ratio))
    return fail(ErrorCode::InvalidArgument, fmt::format("a Moebius ratio is positive and finite, not {}", ratio),
                ratio);
  const Interval d = n.domain();
  Net out = n;
  std::vector<double> factor(n.knots.size());
  for (std::size_t i = 0; i < n.knots.size(); ++i) {
    // 1 + (ratio - 1) y = ratio / (x + ratio (1 - x)): one at lo, ratio at hi.
    const double x = (n.knots[i] - d.lo) / d.length(), below = x + ratio * (1 - x);
    if (!(below > 0))
      return fail(ErrorCode::InvalidArgument,
                  fmt::format("knot {} ({}) would lie at or beyond infinity", i, n.knots[i]), below, 0);
    factor[i] = ratio / below;
    out.knots[i] = moebius_to(d, ratio, n.knots[i]);
  }
  for (std::size_t i = 0; i < n.rows(); ++i) {
    double product = 1;
    for (std::size_t k = i + 1; k <= i + n.p(); ++k) product *= factor[k];
    for (std::size_t c = 0; c < n.width; ++c) out.poles[i * n.width + c] = product * n.poles[i * n.width + c];
  }
  return out;
}

using Scalars = std::vector<double>;

// Bernstein ordinates over a part, by de Casteljau.
Scalars sub_ordinates(Scalars f, double lo, double hi) {
  const auto cut = [](Scalars& g, double t, bool keep_left) {
    Scalars left, right;
    for (std::size_t n = g.size(); n > 0; --n) {
      left.push_back(g[0]);
      right.push_back(g[n - 1]);
      for (std::size_t i = 0; i + 1 < n; ++i) g[i] = (1 - t) * g[i] + t * g[i + 1];
    }
    std::reverse(right.begin(), right.end());
    g = keep_left ? left : right;
  };
  cut(f, hi, true);
  cut(f, hi > 0 ? lo / hi : 0, false);
  return f;
}

double value(Scalars f, double t) {
  for (std::size_t n = f.size() - 1; n > 0; --n)
    for (std::size_t i = 0; i < n; ++i) f[i] = (1 - t) * f[i] + t * f[i + 1];
  return f[0];
}

// Where the ascending f takes the value, in [0, 1]: bisection to the last bit.
double inverse(const Scalars& f, double target) {
  double lo = 0, hi = 1;
  for (;;) {
    const double mid = 0.5 * (lo + hi);
    if (!(lo < mid && mid < hi)) return std::abs(value(f, lo) - target) <= std::abs(value(f, hi) - target) ? lo : hi;
    (value(f, mid) < target ? lo : hi) = mid;
  }
}

// Poles of C(x(s)) on one Bezier piece, x by its ordinates: de Casteljau over polynomials (T. DeRose, "Composing Bezier
// simplexes", ACM Transactions on Graphics 7, 1988).
std::vector<Hpoint> composed_piece(const std::vector<Hpoint>& poles, const Scalars& x) {
  Scalars rest(x);
  for (double& r : rest) r = 1 - r;
  std::vector<std::vector<Hpoint>> level;
  for (const Hpoint& h : poles) level.push_back({h});
  const auto times = [](double s, const Hpoint& h) { return s * h; };
  while (level.size() > 1) {
    for (std::size_t i = 0; i + 1 < level.size(); ++i) {
      const auto a = detail::bezier_product(rest, level[i], times), b = detail::bezier_product(x, level[i + 1], times);
      level[i].resize(a.size());
      for (std::size_t k = 0; k < a.size(); ++k) level[i][k] = a[k] + b[k];
    }
    level.pop_back();
  }
  return level[0];
}

}  // namespace

double moebius_to(Interval d, double ratio, double t) {
  if (t == d.lo || t == d.hi) return t;
  const double x = (t - d.lo) / d.length();
  return std::lerp(d.lo, d.hi, x / (x + ratio * (1 - x)));
}

double moebius_from(Interval d, double ratio, double s) {
  if (s == d.lo || s == d.hi) return s;
  const double y = (s - d.lo) / d.length();
  return std::lerp(d.lo, d.hi, ratio * y / ((1 - y) + ratio * y));
}

Result<NurbsCurve> moebius(const NurbsCurve& c, double ratio) {
  auto n = moebius_net({c.degree(), 1, c.knots(), c.poles()}, ratio);
  if (!n) return tl::unexpected<Error>(n.error());
  const Interval d = c.domain();
  return NurbsCurve::from_homogeneous(c.degree(), std::move(n->knots), std::move(n->poles),
                                      Interval{moebius_to(d, ratio, c.range().lo), moebius_to(d, ratio, c.range().hi)});
}

Result<NurbsSurface> moebius(const NurbsSurface& s, double ratio_u, double ratio_v) {
  const auto along_u = [](const NurbsSurface& from, double ratio) -> Result<NurbsSurface> {
    if (ratio == 1) return from;
    auto n = moebius_net({from.degree_u(), from.poles_v(), from.knots_u(), from.poles()}, ratio);
    if (!n) return tl::unexpected<Error>(n.error());
    const Interval d = from.domain_u(), r = from.range_u();
    return NurbsSurface::from_homogeneous(
        from.degree_u(), from.degree_v(), std::move(n->knots), from.knots_v(), std::move(n->poles),
        Interval{moebius_to(d, ratio, r.lo), moebius_to(d, ratio, r.hi)}, from.range_v());
  };
  const auto u = along_u(s, ratio_u);
  if (!u) return u;
  const auto v = along_u(swapped(*u), ratio_v);
  if (!v) return v;
  return swapped(*v);
}

Result<NormalizedEnds> with_end_weights_one(const NurbsCurve& c) {
  const NurbsCurve whole = trimmed(c, c.range());
  const double first = whole.poles().front().w, last = whole.poles().back().w;
  if (!(first * last > 0))
    return fail(ErrorCode::Unsupported, fmt::format("end weights {} and {} cannot both become one", first, last));
  // The last weight gains ratio^degree.
  const double ratio = std::pow(first / last, 1.0 / c.degree());
  auto moved = moebius(whole, ratio);
  if (!moved) return tl::unexpected<Error>(moved.error());
  std::vector<Hpoint> poles = moved->poles();
  const double divisor = poles.front().w;
  for (Hpoint& h : poles) h = {h.x / divisor, h.y / divisor, h.z / divisor, h.w / divisor};
  Hpoint& end = poles.back();  // one up to rounding
  end = {end.x / end.w, end.y / end.w, end.z / end.w, 1};
  auto out = NurbsCurve::from_homogeneous(c.degree(), moved->knots(), std::move(poles));
  if (!out) return tl::unexpected<Error>(out.error());
  return NormalizedEnds{std::move(*out), ratio};
}

Result<NurbsCurve> composed(const NurbsCurve& c, std::span<const double> f, Interval over) {
  const int degree = static_cast<int>(f.size()) - 1;
  if (degree < 1) return fail(ErrorCode::InvalidArgument, "a reparametrization has two ordinates or more");
  if (degree * c.degree() > detail::max_degree)
    return fail(ErrorCode::Limit, fmt::format("the composed curve would have degree {}", degree * c.degree()),
                degree * c.degree(), detail::max_degree);
  if (!over.is_bounded() || !(over.lo < over.hi))
    return fail(ErrorCode::InvalidArgument, fmt::format("the parameters [{}, {}] have no length", over.lo, over.hi));
  const Scalars ordinates(f.begin(), f.end());
  const Interval d = c.domain();
  // Ascending ordinates are enough; otherwise the derivative must be positive on a fine subdivision of its hull.
  for (int i = 0; i < 64; ++i) {
    const Scalars part = sub_ordinates(ordinates, i / 64.0, (i + 1) / 64.0);
    if (!std::is_sorted(part.begin(), part.end()))
      return fail(ErrorCode::InvalidArgument,
                  fmt::format("the reparametrization does not ascend near {}", over.at(i / 64.0)));
  }
  if (!(d.lo <= f.front() && f.front() < f.back() && f.back() <= d.hi))
    return fail(ErrorCode::InvalidArgument,
                fmt::format("the reparametrization runs from {} to {}, the domain is [{}, {}]", f.front(), f.back(),
                            d.lo, d.hi));
  const std::vector<NurbsCurve> pieces = bezier_pieces(c.with_range({f.front(), f.back()}));
  const std::size_t order = static_cast<std::size_t>(degree * c.degree());
  std::vector<double> knots{over.lo};
  std::vector<Hpoint> poles;
  double begin = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Interval piece = pieces[i].range();
    const double end = i + 1 == pieces.size() ? 1 : inverse(ordinates, piece.hi);
    if (!(begin < end)) return fail(ErrorCode::Degenerate, fmt::format("knots near {} fall together", piece.lo));
    Scalars x = sub_ordinates(ordinates, begin, end);
    for (double& v : x) v = (v - piece.lo) / piece.length();
    x.front() = 0;
    x.back() = 1;
    const std::vector<Hpoint> q = composed_piece(pieces[i].poles(), x);
    poles.insert(poles.end(), q.begin() + (i > 0), q.end());
    knots.insert(knots.end(), order, over.at(begin));
    begin = end;
  }
  knots.insert(knots.end(), order + 1, over.hi);
  return NurbsCurve::from_homogeneous(static_cast<int>(order), std::move(knots), std::move(poles));
}

Result<NurbsCurve> composed_with_square(const NurbsCurve& c) {
  const Interval r = c.range();
  if (!(r.lo >= 0))
    return fail(ErrorCode::InvalidArgument, fmt::format("the range begins at {}, below zero", r.lo), r.lo, 0);
  const double lo = std::sqrt(r.lo), hi = std::sqrt(r.hi);
  const std::array<double, 3> ordinates{r.lo, std::clamp(lo * hi, r.lo, r.hi), r.hi};
  return composed(c, ordinates, {lo, hi});
}

}  // namespace trimloop
