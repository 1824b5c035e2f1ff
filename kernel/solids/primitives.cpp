#include "kernel/solids/primitives.h"

#include "kernel/solids/sweep.h"

namespace trimloop {
namespace {

Point at(const Frame& f, double x, double y, double z = 0) { return f.origin + x * f.x + y * f.y + z * f.z; }
Curve straight(Point a, Point b) { return {Line{a, b, {0, 1}}}; }
SurfacePtr share(Surface s) { return std::make_shared<const Surface>(std::move(s)); }

// Gaps between computed corners are rounding; what is far below the size is none.
double rounding(double size) { return 1e-9 * size; }

tl::unexpected<Error> no_size() { return fail(ErrorCode::Degenerate, "a primitive needs positive sizes"); }
bool positive(std::initializer_list<double> sizes) {
  for (const double s : sizes)
    if (!(s > 0) || !std::isfinite(s)) return false;
  return true;
}

Profile polygon(const std::vector<Point>& corners) {
  Profile out;
  for (std::size_t i = 0; i < corners.size(); ++i) out.push_back(straight(corners[i], corners[(i + 1) % corners.size()]));
  return out;
}

}  // namespace

Result<Body> make_block(const Frame& f, double x, double y, double z) {
  if (!positive({x, y, z})) return no_size();
  return extrude(polygon({f.origin, at(f, x, 0), at(f, x, y), at(f, 0, y)}), z * f.z, rounding(x + y + z));
}

Result<Body> make_wedge(const Frame& f, double x, double y, double z, double top_x) {
  if (!positive({x, y, z}) || !(top_x >= 0)) return no_size();
  std::vector<Point> corners{f.origin, at(f, x, 0), at(f, top_x, y)};
  if (top_x > 0) corners.push_back(at(f, 0, y));
  return extrude(polygon(corners), z * f.z, rounding(x + y + z));
}

Result<Body> make_cylinder(const Frame& f, double radius, double height) {
  if (!positive({radius, height})) return no_size();
  return extrude({Curve{Circle{f, radius, {0, two_pi}}}}, height * f.z, rounding(radius + height));
}

Result<Body> make_cone(const Frame& f, double radius, double top_radius, double height) {
  if (!positive({radius, height}) || !(top_radius >= 0)) return no_size();
  if (radius == top_radius) return make_cylinder(f, radius, height);
  Profile profile{straight(f.origin, at(f, radius, 0)), straight(at(f, radius, 0), at(f, top_radius, 0, height))};
  if (top_radius > 0) profile.push_back(straight(at(f, top_radius, 0, height), at(f, 0, 0, height)));
  return revolve(std::move(profile), {f.origin, f.z}, two_pi, true, rounding(radius + height));
}

Result<Body> make_sphere(const Frame& f, double radius) {
  if (!positive({radius})) return no_size();
  return solid_of(share({Sphere{f, radius}}), rounding(radius));
}

Result<Body> make_torus(const Frame& f, double major_radius, double minor_radius) {
  if (!positive({minor_radius, major_radius - minor_radius})) return no_size();
  return solid_of(share({Torus{f, major_radius, minor_radius}}), rounding(major_radius));
}

Result<Body> make_ellipsoid(const Frame& f, double a, double b, double c) {
  if (!positive({a, b, c})) return no_size();
  const auto ball = to_nurbs(Surface{Sphere{Frame{}, 1}}, {0, two_pi}, {-pi / 2, pi / 2});
  if (!ball) return tl::unexpected<Error>(ball.error());
  Transform t;
  t.r = {{{a * f.x.x, b * f.y.x, c * f.z.x}, {a * f.x.y, b * f.y.y, c * f.z.y}, {a * f.x.z, b * f.y.z, c * f.z.z}}};
  t.t = to_vector(f.origin);
  auto surface = transformed(Surface{ball->surface}, t);
  if (!surface) return tl::unexpected<Error>(surface.error());
  return solid_of(share(std::move(*surface)), rounding(a + b + c));
}

}  // namespace trimloop
