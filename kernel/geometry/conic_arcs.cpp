#include "kernel/geometry/conic_arcs.h"

#include "kernel/geometry/detail.h"

namespace trimloop::detail {
namespace {

std::vector<double> cut(Interval r, double longest) {
  const double wanted = std::ceil(r.length() / longest * (1 - 1e-12));
  const auto pieces = static_cast<std::size_t>(std::clamp(wanted, 1.0, 1e6));
  std::vector<double> at(pieces + 1);
  for (std::size_t i = 0; i <= pieces; ++i) at[i] = r.at(static_cast<double>(i) / static_cast<double>(pieces));
  return at;
}
double without_dust(double x) { return std::abs(x) < 4e-16 ? 0 : x; }  // cos(pi / 2) in doubles is 6e-17

// The middle pole is where the tangents meet: mid-point / cos(h) with weight cos(h), h half the piece (The NURBS
// Book 7.3).
ArcPole on_circle(double t, double w) { return {without_dust(std::cos(t)), without_dust(std::sin(t)), w}; }
ArcPole on_hyperbola(double t, double w) { return {std::cosh(t), std::sinh(t), w}; }

}  // namespace

std::vector<double> Arcs::knots() const {
  std::vector<double> out;
  out.reserve(2 * at.size() + 2);
  out.push_back(at.front());
  for (const double t : at) out.insert(out.end(), 2, t);
  out.push_back(at.back());
  return out;
}
ParameterMap Arcs::map(ParameterMap::Kind kind) const {
  ParameterMap out{at, at, {}};
  for (std::size_t i = 0; i + 1 < at.size(); ++i) out.pieces.push_back({kind, 0.5 * (at[i + 1] - at[i])});
  return out;
}

Arcs circular_arcs(Interval angle_rad) {
  Arcs out{cut(angle_rad, pi / 2), {}};
  for (std::size_t i = 0; i + 1 < out.at.size(); ++i) {
    const Interval piece{out.at[i], out.at[i + 1]};
    out.poles.push_back(on_circle(piece.lo, 1));
    out.poles.push_back(on_circle(piece.mid(), std::cos(0.5 * piece.length())));
  }
  out.poles.push_back(std::abs(angle_rad.length() - two_pi) < 1e-15 ? out.poles.front() : on_circle(angle_rad.hi, 1));
  return out;
}

Arcs hyperbolic_arcs(Interval parameter) {
  Arcs out{cut(parameter, 2), {}};
  for (std::size_t i = 0; i + 1 < out.at.size(); ++i) {
    const Interval piece{out.at[i], out.at[i + 1]};
    out.poles.push_back(on_hyperbola(piece.lo, 1));
    out.poles.push_back(on_hyperbola(piece.mid(), std::cosh(0.5 * piece.length())));
  }
  out.poles.push_back(on_hyperbola(parameter.hi, 1));
  return out;
}

}  // namespace trimloop::detail
