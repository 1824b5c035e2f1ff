#include "kernel/boolean/curve_hits.h"

#include <algorithm>

namespace trimloop::boolean {
namespace {

using Hits = std::optional<std::vector<double>>;

constexpr double clear = 1e-6;  // of the sizes at hand: nearer to tangency, rounding tells too much

// a t^2 + 2 b t + c along a unit direction; `size` is the surface's radius there.
Hits roots(double a, double b, double c, double size) {
  if (std::abs(a) < clear) return std::nullopt;
  const double middle = -b / a, square = middle * middle - c / a;  // of half the chord
  const double scale = size + std::abs(middle);
  if (std::abs(square) <= clear * clear * scale * scale) return std::nullopt;
  if (square < 0) return std::vector<double>{};
  const double half = std::sqrt(square);
  // The root away from cancellation first.
  const double far = middle >= 0 ? middle + half : middle - half, near = c / a / far;
  return std::vector<double>{std::min(far, near), std::max(far, near)};
}

Hits along_line(Point p, Vector d, const Surface& s) {
  if (const auto* plane = std::get_if<Plane>(&s.shape)) {
    const double sine = dot(d, plane->frame.z);
    if (std::abs(sine) < clear) return std::nullopt;
    return std::vector<double>{dot(plane->frame.origin - p, plane->frame.z) / sine};
  }
  if (const auto* sphere = std::get_if<Sphere>(&s.shape)) {
    const Vector w = p - sphere->frame.origin;
    return roots(1, dot(w, d), (norm(w) - sphere->radius) * (norm(w) + sphere->radius), sphere->radius);
  }
  if (const auto* c = std::get_if<Cylinder>(&s.shape)) {
    const Vector z = c->frame.z, w = p - c->frame.origin, wx = w - dot(w, z) * z, dx = d - dot(d, z) * z;
    return roots(dot(dx, dx), dot(wx, dx), (norm(wx) - c->radius) * (norm(wx) + c->radius), c->radius);
  }
  if (const auto* c = std::get_if<Cone>(&s.shape)) {
    const double ca = std::cos(c->half_angle_rad), C = ca * ca;
    const Vector z = c->frame.z, w = p - (c->frame.origin - c->radius / std::tan(c->half_angle_rad) * z);
    const double wz = dot(w, z), dz = dot(d, z);
    return roots(C - dz * dz, C * dot(w, d) - wz * dz, C * dot(w, w) - wz * wz, std::abs(c->radius));
  }
  return std::nullopt;
}

// a cos t + b sin t = c.
Hits on_circle(double a, double b, double c) {
  const double size = std::hypot(a, b);
  const double x = c / size;
  if (!(size > 0) || std::abs(1 - std::abs(x)) < clear) return std::nullopt;
  if (std::abs(x) > 1) return std::vector<double>{};
  const double middle = std::atan2(b, a), half = std::acos(x);
  return std::vector<double>{middle - half, middle + half};
}

}  // namespace

std::optional<std::vector<double>> curve_hits(const Curve& curve, const Surface& s, double slack) {
  Hits found;
  double period = 0, speed = 1;
  if (const auto* line = std::get_if<Line>(&curve.shape)) {
    const Vector d = line->end - line->start;
    speed = norm(d);
    if (!(speed > 0)) return std::nullopt;
    found = along_line(line->start, d / speed, s);
    if (found)
      for (double& t : *found) t /= speed;
  } else if (const auto* plane = std::get_if<Plane>(&s.shape)) {
    const auto turn = [&](const Frame& f, double a, double b) {
      period = two_pi;
      speed = std::min(a, b);
      const Vector n = plane->frame.z;
      const double along = a * dot(f.x, n), across = b * dot(f.y, n);
      if (std::hypot(along, across) < clear * std::max(a, b)) return Hits{};
      return on_circle(along, across, dot(plane->frame.origin - f.origin, n));
    };
    if (const auto* c = std::get_if<Circle>(&curve.shape)) found = turn(c->frame, c->radius, c->radius);
    if (const auto* e = std::get_if<Ellipse>(&curve.shape)) found = turn(e->frame, e->a, e->b);
  }
  if (!found) return std::nullopt;
  const Interval r = range(curve), wide{r.lo - slack / speed, r.hi + slack / speed};
  std::vector<double> out;
  for (double t : *found) {
    if (period > 0)
      for (t += period * std::ceil((wide.lo - t) / period); t <= wide.hi; t += period) out.push_back(r.clamp(t));
    else if (wide.contains(t))
      out.push_back(r.clamp(t));
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace trimloop::boolean
