#include "kernel/nurbs/net.h"

#include "kernel/nurbs/basis.h"
#include "kernel/nurbs/knots.h"

namespace trimloop::detail {

namespace {

std::size_t span_from_left(const Net& s, double t) { return span_of(s.knots.data(), s.p(), s.rows(), t); }

// The span that ends at or after t: the last one that begins before it.
std::size_t span_from_right(const Net& s, double t) {
  const auto first = s.knots.begin() + s.degree, last = s.knots.begin() + static_cast<std::ptrdiff_t>(s.rows());
  return s.p() + static_cast<std::size_t>(std::lower_bound(first + 1, last, t) - first) - 1;
}

// Only the rows and knots that the curve over `range` depends on.
Net active_spans(const Net& s, Interval range) {
  const std::size_t first = span_from_left(s, range.lo) - s.p(), last = span_from_right(s, range.hi);
  const auto knot = s.knots.begin() + static_cast<std::ptrdiff_t>(first);
  const auto pole = s.poles.begin() + static_cast<std::ptrdiff_t>(first * s.width);
  const std::size_t rows = last + 1 - first;
  return {s.degree,
          s.width,
          {knot, knot + static_cast<std::ptrdiff_t>(rows + s.p() + 1)},
          {pole, pole + static_cast<std::ptrdiff_t>(rows * s.width)}};
}

void copy_rows(const Net& from, std::size_t first, std::size_t count, Net& to, std::size_t at) {
  std::copy_n(from.poles.begin() + static_cast<std::ptrdiff_t>(first * from.width), count * from.width,
              to.poles.begin() + static_cast<std::ptrdiff_t>(at * to.width));
}

// row[i] = (1 - share) row[i + 1] + share row[i]
void blend_with_next(Net& s, std::size_t i, double share) {
  Hpoint *row = s.poles.data() + i * s.width, *next = row + s.width;
  if (share == 1) return;
  for (std::size_t c = 0; c < s.width; ++c) row[c] = next[c] + share * (row[c] - next[c]);
}

}  // namespace

std::vector<double> insertable(const Net& s, std::span<const double> wanted) {
  std::vector<double> added;
  for (double t : wanted)
    if (s.domain().contains(t)) added.push_back(t);
  std::sort(added.begin(), added.end());
  std::size_t kept = 0, present = 0;
  for (std::size_t i = 0; i < added.size(); ++i) {
    present = kept > 0 && added[i] == added[kept - 1] ? present + 1 : multiplicity(s.knots, added[i]) + 1;
    if (present <= s.p()) added[kept++] = added[i];
  }
  added.resize(kept);
  return added;
}

// A5.4, from the right: i runs over the old knots and k over the new ones; row k - p - 1 is the one that begins there.
// Between two insertions rows and knots only move; each insertion replaces p rows by blends with their right
// neighbours.
Net refined(const Net& s, std::span<const double> added) {
  if (added.empty()) return s;
  const std::size_t p = s.p(), m = added.size();
  Net out{s.degree, s.width, std::vector<double>(s.knots.size() + m),
          std::vector<Hpoint>(s.poles.size() + m * s.width)};

  // 1. Left of the first and right of the last new knot nothing changes.
  const std::size_t a = span_from_left(s, added.front()), b = span_from_left(s, added.back()) + 1;
  copy_rows(s, 0, a - p + 1, out, 0);
  copy_rows(s, b - 1, s.rows() - b + 1, out, b - 1 + m);
  std::copy_n(s.knots.begin(), a + 1, out.knots.begin());
  std::copy(s.knots.begin() + static_cast<std::ptrdiff_t>(b + p), s.knots.end(),
            out.knots.begin() + static_cast<std::ptrdiff_t>(b + p + m));

  // 2. In between, from right to left.
  std::size_t i = b + p - 1, k = b + p + m - 1;
  for (std::size_t j = m; j-- > 0; --k) {
    const double t = added[j];
    for (; i > a && t <= s.knots[i]; --i, --k) {
      copy_rows(s, i - p - 1, 1, out, k - p - 1);
      out.knots[k] = s.knots[i];
    }
    copy_rows(out, k - p, 1, out, k - p - 1);
    for (std::size_t l = 1; l <= p; ++l) {
      const double right = out.knots[k + l], left = s.knots[i - p + l];
      blend_with_next(out, k - p + l - 1, right > t ? (right - t) / (right - left) : 0);
    }
    out.knots[k] = t;
  }
  return out;
}

Net part(const Net& s, Interval range) {
  Net spans = active_spans(s, range);
  std::vector<double> ends(spans.p(), range.lo);
  ends.insert(ends.end(), spans.p(), range.hi);
  Net result = active_spans(refined(spans, insertable(spans, ends)), range);
  result.knots.front() = range.lo;  // the outermost knots carry no shape
  result.knots.back() = range.hi;
  return result;
}

// After H. Prautzsch, "Degree elevation of B-spline curves", CAGD 1 (1984): a B-spline of degree p is the mean, over
// the p + 2 ways to repeat one of its knots, of B-splines of degree p + 1, times (p + 2) / (p + 1). Doubling every (p +
// 1)-th knot, from offset 0 .. p, repeats one knot of each B-spline (both end knots in turn of those that begin at a
// doubled one), which gives p + 1 splines whose mean is the curve. Each is refined to the common knots.
Net elevated(const Net& source) {
  const Net s = part(source, source.domain());
  const std::size_t p = s.p(), w = s.width;
  Net mean;
  for (std::size_t offset = 0; offset <= p; ++offset) {
    Net doubled{s.degree + 1, w, {}, {}};
    std::vector<double> missing;  // the distinct knots of which no copy is doubled
    bool repeated = false;
    for (std::size_t i = 0; i < s.knots.size(); ++i) {
      const bool twice = i % (p + 1) == offset;
      for (int copy = 0; copy <= twice; ++copy) {
        doubled.knots.push_back(s.knots[i]);
        if (i < s.rows()) doubled.poles.insert(doubled.poles.end(), &s.poles[i * w], &s.poles[i * w] + w);
      }
      repeated = repeated || twice;
      if (i + 1 < s.knots.size() && s.knots[i + 1] == s.knots[i]) continue;
      if (!repeated) missing.push_back(s.knots[i]);
      repeated = false;
    }
    Net next = refined(doubled, missing);
    if (offset == 0) {
      mean = std::move(next);
      continue;
    }
    const double share = 1 / static_cast<double>(offset + 1);
    for (std::size_t i = 0; i < mean.poles.size(); ++i)
      mean.poles[i] = mean.poles[i] + share * (next.poles[i] - mean.poles[i]);
  }
  return mean;
}

double mirrored(Interval domain, double t) {
  if (t == domain.lo) return domain.hi;
  if (t == domain.hi) return domain.lo;
  const double m = domain.lo + (domain.hi - t);
  return domain.contains(t) ? domain.clamp(m) : m;
}

Net reversed(Net s) {
  const Interval domain = s.domain();
  const auto begin = s.poles.begin();
  const auto row = [&](std::size_t i) { return begin + static_cast<std::ptrdiff_t>(i * s.width); };
  for (std::size_t i = 0, j = s.rows() - 1; i < j; ++i, --j) std::swap_ranges(row(i), row(i + 1), row(j));
  std::reverse(s.knots.begin(), s.knots.end());
  for (double& t : s.knots) t = mirrored(domain, t);
  return s;
}

}  // namespace trimloop::detail
