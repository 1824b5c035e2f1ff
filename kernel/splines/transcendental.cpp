#include "kernel/splines/transcendental.h"

#include <fmt/format.h>

#include <limits>

namespace trimloop {

namespace {

constexpr double longest_step = pi / 4;  // of curves whose fourth derivative is small or zero; in their parameter

struct Plane {
  double x = 0, y = 0, z = 0;
};

// Point and derivative from coordinates in the frame.
template <class At, class Slope, class Fourth>
SmoothCurve in_frame(const Frame& f, At at, Slope slope, Fourth fourth) {
  return {[f, at](double t) {
            const Plane p = at(t);
            return f.origin + p.x * f.x + p.y * f.y + p.z * f.z;
          },
          [f, slope](double t) {
            const Plane d = slope(t);
            return d.x * f.x + d.y * f.y + d.z * f.z;
          },
          fourth};
}

double largest(Interval r) { return std::max(std::abs(r.lo), std::abs(r.hi)); }

}  // namespace

Result<BoundedCurve> hermite_within(const SmoothCurve& c, Interval range, double tolerance, std::size_t most_pieces) {
  if (!(tolerance > 0) || !range.is_bounded() || !(range.lo < range.hi))
    return fail(ErrorCode::InvalidArgument, "a tolerance above zero and a range that ascends are needed", tolerance, 0);
  const auto off = [&c](double from, double to) {
    const double h = to - from;
    return c.fourth({from, to}) * h * h * h * h / 384;
  };
  std::vector<Point> poles{c.point(range.lo)};
  std::vector<double> knots(4, range.lo);
  double bound = 0, size = 0, step = std::min(longest_step, range.length());
  for (double from = range.lo; from < range.hi;) {
    step = std::min(2 * step, std::max(longest_step, range.length() / 16));
    double to = std::min(range.hi, from + step);
    while (!(off(from, to) <= tolerance) && to > from) to = std::min(range.hi, from + (step *= 0.84));
    if (!(to > from) || poles.size() / 3 >= most_pieces)
      return fail(ErrorCode::Limit, fmt::format("more than {} pieces would be needed for {:.3g}", most_pieces, tolerance),
                  static_cast<double>(most_pieces), tolerance);
    const double third = (to - from) / 3;
    const Point end = c.point(to);
    poles.push_back(poles.back() + third * c.derivative(from));
    poles.push_back(end - third * c.derivative(to));
    poles.push_back(end);
    knots.insert(knots.end(), 3, to);
    bound = std::max(bound, off(from, to));
    size = std::max({size, std::abs(end.x), std::abs(end.y), std::abs(end.z)});
    from = to;
  }
  // Neighbours' derivatives agree at each joint, so that its pole is the mean of its neighbours by lengths: it goes, and a
  // knot with it.
  std::vector<Point> kept{poles[0]};
  std::vector<double> doubled(knots.begin(), knots.begin() + 4);
  for (std::size_t i = 1; i + 1 < poles.size(); ++i)
    if (i % 3 != 0) kept.push_back(poles[i]);
  for (std::size_t i = 4; i + 3 < knots.size(); i += 3) doubled.insert(doubled.end(), 2, knots[i]);
  kept.push_back(poles.back());
  doubled.insert(doubled.end(), 4, range.hi);
  auto curve = NurbsCurve::from_cartesian(3, std::move(doubled), kept, {});
  if (!curve) return tl::unexpected(curve.error());
  return BoundedCurve{std::move(*curve), bound + 16 * std::numeric_limits<double>::epsilon() * size};
}

SmoothCurve helix(const Frame& f, double radius, double pitch) {
  const double rise = pitch / two_pi;
  return in_frame(
      f, [=](double t) { return Plane{radius * std::cos(t), radius * std::sin(t), rise * t}; },
      [=](double t) { return Plane{-radius * std::sin(t), radius * std::cos(t), rise}; },
      [=](Interval) { return std::abs(radius); });
}

SmoothCurve sine_wave(const Frame& f, double amplitude, double wavelength) {
  const double w = two_pi / wavelength;
  return in_frame(
      f, [=](double t) { return Plane{t, amplitude * std::sin(w * t), 0}; },
      [=](double t) { return Plane{1, amplitude * w * std::cos(w * t), 0}; },
      [=](Interval) { return std::abs(amplitude) * w * w * w * w; });
}

SmoothCurve catenary(const Frame& f, double a) {
  return in_frame(
      f, [=](double t) { return Plane{t, a * std::cosh(t / a), 0}; }, [=](double t) { return Plane{1, std::sinh(t / a), 0}; },
      [=](Interval r) { return std::cosh(largest(r) / a) / (a * a * std::abs(a)); });
}

SmoothCurve trochoid(const Frame& f, double radius, double arm) {
  return in_frame(
      f, [=](double t) { return Plane{radius * t - arm * std::sin(t), radius - arm * std::cos(t), 0}; },
      [=](double t) { return Plane{radius - arm * std::cos(t), arm * std::sin(t), 0}; },
      [=](Interval) { return std::abs(arm); });
}

SmoothCurve archimedean_spiral(const Frame& f, double start, double growth) {
  const double b = growth / two_pi;
  return in_frame(
      f, [=](double t) { return Plane{(start + b * t) * std::cos(t), (start + b * t) * std::sin(t), 0}; },
      [=](double t) {
        const double r = start + b * t;
        return Plane{b * std::cos(t) - r * std::sin(t), b * std::sin(t) + r * std::cos(t), 0};
      },
      [=](Interval r) { return std::hypot(std::max(std::abs(start + b * r.lo), std::abs(start + b * r.hi)), 4 * b); });
}

SmoothCurve logarithmic_spiral(const Frame& f, double start, double factor_per_turn) {
  const double k = std::log(factor_per_turn) / two_pi, turn = 1 + k * k;
  return in_frame(
      f,
      [=](double t) {
        const double r = start * std::exp(k * t);
        return Plane{r * std::cos(t), r * std::sin(t), 0};
      },
      [=](double t) {
        const double r = start * std::exp(k * t);
        return Plane{r * (k * std::cos(t) - std::sin(t)), r * (k * std::sin(t) + std::cos(t)), 0};
      },
      [=](Interval r) { return std::abs(start) * std::exp(std::max(k * r.lo, k * r.hi)) * turn * turn; });
}

SmoothCurve involute(const Frame& f, double radius) {
  return in_frame(
      f, [=](double t) { return Plane{radius * (std::cos(t) + t * std::sin(t)), radius * (std::sin(t) - t * std::cos(t)), 0}; },
      [=](double t) { return Plane{radius * t * std::cos(t), radius * t * std::sin(t), 0}; },
      [=](Interval r) { return std::abs(radius) * std::hypot(3, largest(r)); });
}

}  // namespace trimloop
