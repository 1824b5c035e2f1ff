#include "io/step/knots.h"

#include <fmt/format.h>

#include <cmath>

#include "formats/step/rules.h"

namespace trimloop::io::step_import {
namespace {

namespace sr = step::rules;

// ISO 10303-42 default_b_spline_knots and default_b_spline_knot_mult.
std::vector<double> implied(step::KnotForm form, int degree, std::size_t poles) {
  std::vector<double> out;
  const auto n = static_cast<int>(poles);
  if (form == step::KnotForm::Uniform) {
    for (int i = -degree; i <= n; ++i) out.push_back(i);
  } else if (form == step::KnotForm::QuasiUniform) {
    out.assign(static_cast<std::size_t>(degree) + 1, 0.0);
    for (int i = 1; i < n - degree; ++i) out.push_back(i);
    out.insert(out.end(), static_cast<std::size_t>(degree) + 1, n - degree);
  } else {  // Bezier pieces
    out.push_back(0);
    const int pieces = (n - 1) / degree;
    for (int i = 0; i <= pieces; ++i) out.insert(out.end(), static_cast<std::size_t>(degree), i);
    out.push_back(pieces);
  }
  return out;
}

}  // namespace

std::optional<std::vector<double>> full_knots(Context& context, const Record& spline, int degree, std::size_t poles,
                                              step::KnotForm form, const std::vector<int>& multiplicities,
                                              const std::vector<double>& distinct, const Rule& sums) {
  if (degree > context.execution.limits.degree || poles < static_cast<std::size_t>(degree) + 1) {
    context.add(spline, sums, fmt::format("degree {} with {} poles", degree, poles));
    return std::nullopt;
  }
  if (form != step::KnotForm::Explicit) {
    if (form == step::KnotForm::Bezier && (poles - 1) % static_cast<std::size_t>(degree) != 0) {
      context.add(spline, sums, fmt::format("{} poles are no whole number of Bezier pieces of degree {}", poles, degree));
      return std::nullopt;
    }
    return implied(form, degree, poles);
  }
  const std::size_t wanted = poles + static_cast<std::size_t>(degree) + 1;
  std::size_t sum = 0;
  for (const int m : multiplicities) {
    if (m < 1 || static_cast<std::size_t>(m) > wanted) {
      context.add(spline, sums, fmt::format("a knot has the multiplicity {}", m), m, static_cast<double>(wanted));
      return std::nullopt;
    }
    sum += static_cast<std::size_t>(m);
  }
  if (multiplicities.size() != distinct.size() || sum != wanted) {
    context.add(spline, sums, fmt::format("{} knots, {} multiplicities with sum {}; degree {} and {} poles ask for {}", distinct.size(),
                                          multiplicities.size(), sum, degree, poles, wanted),
                static_cast<double>(sum), static_cast<double>(wanted));
    return std::nullopt;
  }
  for (std::size_t i = 0; i + 1 < distinct.size(); ++i) {
    if (distinct[i] < distinct[i + 1]) continue;
    const bool equal = distinct[i] == distinct[i + 1];
    context.add(spline, sr::knots_order, equal ? Severity::Warning : Severity::Error,
                equal ? "two distinct knots are equal; they are taken for one" : "the knots descend", distinct[i + 1], distinct[i]);
    if (!equal) return std::nullopt;
  }
  std::vector<double> out;
  out.reserve(wanted);
  for (std::size_t i = 0; i < distinct.size(); ++i) out.insert(out.end(), static_cast<std::size_t>(multiplicities[i]), distinct[i]);
  return out;
}

UnusedPoles drop_excess(Context& context, const Record& spline, int degree, std::vector<double>& knots, const Rule& sums) {
  UnusedPoles out;
  const std::size_t order = static_cast<std::size_t>(degree) + 1;
  std::size_t first = 0, last = 0;
  while (first < knots.size() && knots[first] == knots.front()) ++first;
  while (last < knots.size() && knots[knots.size() - 1 - last] == knots.back()) ++last;
  if (first == knots.size()) return out;
  out.front = first > order ? first - order : 0;
  out.back = last > order ? last - order : 0;
  if (out.front + out.back == 0) return out;
  context.add(spline, sums, Severity::Warning, fmt::format("an end knot has a multiplicity above {}; {} poles without effect are left out", order, out.front + out.back));
  knots.erase(knots.end() - static_cast<std::ptrdiff_t>(out.back), knots.end());
  knots.erase(knots.begin(), knots.begin() + static_cast<std::ptrdiff_t>(out.front));
  return out;
}

bool check_weights(Context& context, const Record& spline, const std::vector<double>& weights) {
  for (const double w : weights) {
    if (w > 0 && std::isfinite(w)) continue;
    context.add(spline, sr::weights, "a weight is not a positive finite number", w, 0);
    return false;
  }
  return true;
}

}  // namespace trimloop::io::step_import
