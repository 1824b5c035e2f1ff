#include "kernel/nurbs/periodic.h"

#include <fmt/format.h>

#include "kernel/nurbs/basis.h"
#include "kernel/nurbs/builder.h"
#include "kernel/nurbs/deviation.h"
#include "kernel/nurbs/homogeneous.h"
#include "kernel/nurbs/net.h"

namespace trimloop {
namespace {

using detail::Net;
using Knots = std::vector<double>;

Net net(const NurbsCurve& c) { return {c.degree(), 1, c.knots(), c.poles()}; }
Net net(const NurbsSurface& s) { return {s.degree_u(), s.poles_v(), s.knots_u(), s.poles()}; }

// Row of the polar form over the span that holds `at`.
std::vector<Hpoint> blossom_row(const Net& s, double at, std::span<const double> arguments) {
  const std::size_t p = s.p(), w = s.width, k = detail::span_of(s.knots.data(), p, s.rows(), s.domain().clamp(at));
  std::vector<Hpoint> d(s.poles.begin() + static_cast<std::ptrdiff_t>((k - p) * w),
                        s.poles.begin() + static_cast<std::ptrdiff_t>((k + 1) * w));
  for (std::size_t j = 1; j <= p; ++j)
    for (std::size_t i = p; i >= j; --i) {
      const double a = s.knots[k - p + i], b = s.knots[k + i + 1 - j], share = (arguments[j - 1] - a) / (b - a);
      for (std::size_t c = 0; c < w; ++c) d[i * w + c] = (1 - share) * d[(i - 1) * w + c] + share * d[i * w + c];
    }
  return {d.end() - static_cast<std::ptrdiff_t>(w), d.end()};
}

// The middle of a span of the domain that row i bears on; nothing when there is none, and the row may be anything.
std::optional<double> span_of_row(const Knots& knots, std::size_t p, std::size_t i) {
  const std::size_t rows = knots.size() - p - 1;
  for (std::size_t k = std::max(i, p); k <= std::min(i + p, rows - 1); ++k)
    if (knots[k] < knots[k + 1]) return 0.5 * (knots[k] + knots[k + 1]);
  return std::nullopt;
}

// The same shape over other knots, which hold those of `s` inside the domain at least as often, and its ends at index
// degree and rows. Rows that already belong to their knots are kept.
Net over_knots(const Net& s, Knots knots) {
  const std::size_t p = s.p(), rows = knots.size() - p - 1;
  Net out{s.degree, s.width, std::move(knots), {}};
  out.poles.reserve(rows * s.width);
  for (std::size_t i = 0; i < rows; ++i) {
    const std::span<const double> arguments(out.knots.data() + i + 1, p);
    if (rows == s.rows() &&
        std::equal(arguments.begin(), arguments.end(), s.knots.begin() + static_cast<std::ptrdiff_t>(i + 1))) {
      const auto row = s.poles.begin() + static_cast<std::ptrdiff_t>(i * s.width);
      out.poles.insert(out.poles.end(), row, row + static_cast<std::ptrdiff_t>(s.width));
      continue;
    }
    const std::vector<Hpoint> row = blossom_row(s, span_of_row(out.knots, p, i).value_or(s.domain().lo), arguments);
    out.poles.insert(out.poles.end(), row.begin(), row.end());
  }
  return out;
}

// `count` knots before the domain, and as many after, spaced as those at the other end.
Knots with_periodic_ends(const Net& s) {
  const std::size_t p = s.p(), rows = s.rows(), spans = rows - p;
  Knots out = s.knots;
  for (std::size_t m = 0; m < p; ++m) {
    const std::size_t from_end = rows - 1 - m % spans, from_start = p + m % spans;
    out[p - 1 - m] = out[p - m] - (s.knots[from_end + 1] - s.knots[from_end]);
    out[rows + 1 + m] = out[rows + m] + (s.knots[from_start + 1] - s.knots[from_start]);
  }
  return out;
}

// The full vector for a period of knots l[0] .. l[n - 1], l[n] = l[0] + period; index p is the last copy of l[0].
Knots full_periodic(std::size_t p, std::span<const double> l) {
  const std::size_t n = l.size() - 1;
  const double period = l[n] - l[0];
  std::size_t multiplicity = 1;
  while (multiplicity < n && l[multiplicity] == l[0]) ++multiplicity;
  Knots out;
  for (std::size_t i = 0; i < n + 2 * p + 1; ++i) {
    const auto at = static_cast<std::ptrdiff_t>(i + multiplicity) - 1 - static_cast<std::ptrdiff_t>(p);
    const auto size = static_cast<std::ptrdiff_t>(n);
    const std::ptrdiff_t turns = (at >= 0 ? at : at - size + 1) / size;
    const std::size_t place = static_cast<std::size_t>(at - turns * size);
    // The end of the domain has its own bits.
    const bool is_end = turns == 1 && l[place] == l[0];
    out.push_back(is_end ? l[n] : l[place] + static_cast<double>(turns) * period);
  }
  return out;
}

// Periodic net with multiplicity m at the seam, repeated rows made equal. `s` is clamped.
Net periodic_net(const Net& s, std::size_t m) {
  const Interval d = s.domain();
  Knots period(m, d.lo);
  for (std::size_t i = s.p() + 1; i < s.rows(); ++i) period.push_back(s.knots[i]);
  period.push_back(d.hi);
  Net out = over_knots(s, full_periodic(s.p(), period));
  const std::size_t n = period.size() - 1;
  std::vector<Hpoint> mean(n * s.width, Hpoint{0, 0, 0, 0});
  std::vector<double> count(n, 0.0);
  for (std::size_t i = 0; i < out.rows(); ++i) {
    if (!span_of_row(out.knots, s.p(), i)) continue;
    const std::size_t home = i % n;
    count[home] += 1;
    for (std::size_t c = 0; c < s.width; ++c) {
      Hpoint& h = mean[home * s.width + c];
      h = h + 1 / count[home] * (out.poles[i * s.width + c] - h);
    }
  }
  for (std::size_t i = 0; i < out.rows() * s.width; ++i) out.poles[i] = mean[i % (n * s.width)];
  return out;
}

Result<void> check_outer(const Net& s, std::span<const double> before, std::span<const double> after) {
  const Interval d = s.domain();
  if (before.size() != s.p() || after.size() != s.p())
    return fail(ErrorCode::InvalidArgument, fmt::format("degree {} needs {} knots on each side, there are {} and {}",
                                                        s.degree, s.p(), before.size(), after.size()));
  if (!std::is_sorted(before.begin(), before.end()) || !std::is_sorted(after.begin(), after.end()) ||
      !(before.back() <= d.lo) || !(after.front() >= d.hi))
    return fail(ErrorCode::InvalidArgument, "the outer knots do not ascend to the domain and from it");
  return {};
}

}  // namespace

NurbsCurve clamped(const NurbsCurve& c) { return trimmed(c, c.domain()).with_range(c.range()); }
NurbsSurface clamped(const NurbsSurface& s) {
  return trimmed(s, s.domain_u(), s.domain_v()).with_range(s.range_u(), s.range_v());
}

Result<NurbsCurve> unclamped(const NurbsCurve& c, std::span<const double> before, std::span<const double> after) {
  const NurbsCurve whole = clamped(c);
  const Net s = net(whole);
  if (auto ok = check_outer(s, before, after); !ok) return tl::unexpected<Error>(ok.error());
  Knots knots(before.begin(), before.end());
  knots.insert(knots.end(), s.knots.begin() + c.degree(), s.knots.end() - c.degree());
  knots.insert(knots.end(), after.begin(), after.end());
  Net out = over_knots(s, std::move(knots));
  return NurbsCurve::from_homogeneous(c.degree(), std::move(out.knots), std::move(out.poles), c.range());
}

NurbsCurve unclamped(const NurbsCurve& c) {
  const Net s = net(clamped(c));
  Net out = over_knots(s, with_periodic_ends(s));
  return NurbsBuilder::curve(c.degree(), c.is_rational(), std::move(out.knots), std::move(out.poles), c.range());
}

bool is_periodic_form(const NurbsCurve& c, double tolerance) {
  const std::size_t p = static_cast<std::size_t>(c.degree()), rows = c.poles().size();
  if (rows <= p) return false;
  const std::size_t n = rows - p;
  const double period = c.domain().length(), slack = 1e-14 * (std::abs(c.domain().lo) + period);
  for (std::size_t i = 0; i + n < c.knots().size(); ++i)
    if (std::abs(c.knots()[i + n] - c.knots()[i] - period) > slack) return false;
  for (std::size_t i = 0; i + n < rows; ++i) {
    const Hpoint d = c.poles()[i + n] - c.poles()[i];
    if (std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z), std::abs(d.w)}) > tolerance) return false;
  }
  return true;
}

Result<PeriodicForm> periodic(const NurbsCurve& c, double tolerance) {
  const NurbsCurve whole = trimmed(c, c.range());
  double best = infinity;
  for (std::size_t m = 1; m <= static_cast<std::size_t>(c.degree()); ++m) {
    Net n = periodic_net(net(whole), m);
    auto curve = NurbsCurve::from_homogeneous(c.degree(), std::move(n.knots), std::move(n.poles), c.range());
    if (!curve) continue;
    const double deviation = deviation_bound(whole, *curve, 0);
    best = std::min(best, deviation);
    if (deviation <= tolerance) return PeriodicForm{std::move(*curve), c.degree() - static_cast<int>(m), deviation};
  }
  return fail(ErrorCode::Degenerate, "the homogeneous ends of the curve do not meet", best, tolerance);
}

Result<PeriodicSurface> periodic_u(const NurbsSurface& s, double tolerance) {
  const NurbsSurface whole = trimmed(s, s.range_u(), s.range_v());
  double best = infinity;
  for (std::size_t m = 1; m <= static_cast<std::size_t>(s.degree_u()); ++m) {
    Net n = periodic_net(net(whole), m);
    auto out = NurbsSurface::from_homogeneous(s.degree_u(), s.degree_v(), std::move(n.knots), whole.knots_v(),
                                              std::move(n.poles), s.range_u(), s.range_v());
    if (!out) continue;
    const double deviation = deviation_bound(whole, *out, 0);
    best = std::min(best, deviation);
    if (deviation <= tolerance) return PeriodicSurface{std::move(*out), s.degree_u() - static_cast<int>(m), deviation};
  }
  return fail(ErrorCode::Degenerate, "the homogeneous sides of the surface do not meet", best, tolerance);
}

Result<PeriodicSurface> periodic_v(const NurbsSurface& s, double tolerance) {
  auto out = periodic_u(swapped(s), tolerance);
  if (out) out->surface = swapped(out->surface);
  return out;
}

Result<NurbsCurve> from_periodic(int degree, std::span<const double> knots, std::span<const Hpoint> poles) {
  if (poles.empty() || knots.size() != poles.size() + 1)
    return fail(ErrorCode::InvalidArgument,
                fmt::format("a period of {} poles has {} knots, not {}", poles.size(), poles.size() + 1, knots.size()));
  if (degree < 1 || degree > detail::max_degree)
    return fail(ErrorCode::InvalidArgument, fmt::format("degree is {}, not 1 to {}", degree, detail::max_degree),
                degree);
  std::vector<Hpoint> all;
  for (std::size_t i = 0; i < poles.size() + static_cast<std::size_t>(degree); ++i)
    all.push_back(poles[i % poles.size()]);
  return NurbsCurve::from_homogeneous(degree, full_periodic(static_cast<std::size_t>(degree), knots), std::move(all));
}

Result<NurbsSurface> from_periodic(int degree_u, int degree_v, std::span<const double> knots_u,
                                   std::span<const double> knots_v, std::span<const Hpoint> poles, bool around_u,
                                   bool around_v) {
  const auto along = [](int degree, std::span<const double> knots, bool around) -> std::size_t {
    const std::size_t less = around ? 1 : static_cast<std::size_t>(std::max(degree, 0)) + 1;
    return knots.size() > less ? knots.size() - less : 0;
  };
  const std::size_t nu = along(degree_u, knots_u, around_u), nv = along(degree_v, knots_v, around_v);
  for (const int degree : {degree_u, degree_v})
    if (degree < 1 || degree > detail::max_degree)
      return fail(ErrorCode::InvalidArgument, fmt::format("degree is {}, not 1 to {}", degree, detail::max_degree),
                  degree);
  if (nu == 0 || nv == 0 || poles.size() % nv != 0 || poles.size() / nv != nu)
    return fail(ErrorCode::InvalidArgument,
                fmt::format("the knots ask for {} x {} poles, there are {}", nu, nv, poles.size()));
  const std::size_t rows = nu + (around_u ? static_cast<std::size_t>(degree_u) : 0);
  const std::size_t columns = nv + (around_v ? static_cast<std::size_t>(degree_v) : 0);
  std::vector<Hpoint> all;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j) all.push_back(poles[(i % nu) * nv + j % nv]);
  const auto full = [](int degree, std::span<const double> knots, bool around) {
    return around ? full_periodic(static_cast<std::size_t>(degree), knots) : Knots(knots.begin(), knots.end());
  };
  return NurbsSurface::from_homogeneous(degree_u, degree_v, full(degree_u, knots_u, around_u),
                                        full(degree_v, knots_v, around_v), std::move(all));
}

}  // namespace trimloop
