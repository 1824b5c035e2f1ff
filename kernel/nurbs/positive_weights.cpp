#include "kernel/nurbs/positive_weights.h"

#include <fmt/format.h>

#include <algorithm>

#include "kernel/nurbs/builder.h"

namespace trimloop {

namespace {

constexpr int most_rounds = 16;  // halvings of a span
constexpr std::size_t most_poles = 100'000;

bool positive(const std::vector<Hpoint>& poles) {
  return std::all_of(poles.begin(), poles.end(), [](const Hpoint& h) { return h.w > 0; });
}

double middle_weight(const std::vector<Hpoint>& poles) { return poles[poles.size() / 2].w; }

std::vector<Hpoint> turned(std::vector<Hpoint> poles) {
  for (Hpoint& h : poles) h = -1.0 * h;
  return poles;
}

// Middles of the spans that a pole with a weight of zero or less acts on. `bad(i)` tells of the i-th row of poles.
template <class Bad>
std::vector<double> middles(int degree, const std::vector<double>& knots, std::size_t rows, Bad bad) {
  std::vector<double> out;
  const auto p = static_cast<std::size_t>(degree);
  for (std::size_t i = 0; i < rows; ++i) {
    if (!bad(i)) continue;
    for (std::size_t k = std::max(i, p); k <= i + p && k < rows; ++k)
      if (knots[k] < knots[k + 1]) out.push_back(0.5 * (knots[k] + knots[k + 1]));
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace

Result<NurbsCurve> with_positive_weights(const NurbsCurve& curve) {
  if (positive(curve.poles())) return curve;
  NurbsCurve c = trimmed(curve, curve.range());
  if (c.poles().front().w < 0)
    c = NurbsBuilder::curve(c.degree(), c.is_rational(), c.knots(), turned(c.poles()), c.range());
  for (int round = 0; round < most_rounds && c.poles().size() < most_poles; ++round) {
    if (positive(c.poles())) return c;
    c = refine(c, middles(c.degree(), c.knots(), c.poles().size(), [&](std::size_t i) { return !(c.poles()[i].w > 0); }));
  }
  const auto worst = std::min_element(c.poles().begin(), c.poles().end(), [](const Hpoint& a, const Hpoint& b) { return a.w < b.w; });
  const auto i = static_cast<std::size_t>(worst - c.poles().begin());
  return fail(ErrorCode::Unsupported, fmt::format("the weight function falls to zero near parameter {}: the curve runs to infinity there",
                                                  0.5 * (c.knots()[i] + c.knots()[i + static_cast<std::size_t>(c.degree()) + 1])),
              worst->w, 0);
}

Result<NurbsSurface> with_positive_weights(const NurbsSurface& surface) {
  if (positive(surface.poles())) return surface;
  NurbsSurface s = trimmed(surface, surface.range_u(), surface.range_v());
  if (middle_weight(s.poles()) < 0 || s.poles().front().w < 0)
    s = NurbsBuilder::surface(s.degree_u(), s.degree_v(), s.is_rational(), s.knots_u(), s.knots_v(), turned(s.poles()), s.range_u(), s.range_v());
  for (int round = 0; round < most_rounds && s.poles().size() < most_poles; ++round) {
    if (positive(s.poles())) return s;
    const auto row = [&](std::size_t i) {
      for (std::size_t j = 0; j < s.poles_v(); ++j)
        if (!(s.pole(i, j).w > 0)) return true;
      return false;
    };
    const auto column = [&](std::size_t j) {
      for (std::size_t i = 0; i < s.poles_u(); ++i)
        if (!(s.pole(i, j).w > 0)) return true;
      return false;
    };
    const auto u = middles(s.degree_u(), s.knots_u(), s.poles_u(), row), v = middles(s.degree_v(), s.knots_v(), s.poles_v(), column);
    s = refine_v(refine_u(s, u), v);
  }
  return fail(ErrorCode::Unsupported, "the weight function falls to zero: the surface runs to infinity there");
}

}  // namespace trimloop
