#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "formats/iges/records/checks.h"
#include "formats/iges/records/splines.h"
#include "formats/iges/records/targets.h"
#include "formats/iges/rules.h"

namespace trimloop::iges {

void check(const PlaneRecord& r, TokenReader& in) {
  const double length = std::hypot(r.a, r.b, r.c);
  if (!(length > 1e-12)) in.fault_at(1, rules::e108::zero_normal, "A, B and C are all zero", length, 1e-12);
  if (in.form() == 0 && r.boundary)
    in.remark_at(5, rules::e108::form_vs_bound,
                 fmt::format("an unbounded plane (form 0) with the boundary D{}", r.boundary.de));
  if ((in.form() == 1 || in.form() == -1) && !r.boundary)
    in.remark_at(5, rules::e108::form_vs_bound, fmt::format("a bounded plane (form {}) without boundary", in.form()));
  admit(in, 5, r.boundary, any_curve);
}

void check(const ParametricSplineSurface& r, TokenReader& in) {
  if (r.ctype < 1 || r.ctype > 6 || r.ptype < 0 || r.ptype > 1)
    in.remark_at(1, rules::e114::flags,
                 fmt::format("spline type {} (1 to 6), patch type {} (0 or 1)", r.ctype, r.ptype));
  const auto ascends = [&](std::span<const double> breaks, std::size_t parameter, const char* name) {
    for (std::size_t i = 1; i < breaks.size(); ++i)
      if (!(breaks[i] > breaks[i - 1])) {
        in.fault_at(
            parameter + i, rules::e114::patches,
            fmt::format("break point {}({}) = {} does not exceed {} before it", name, i + 1, breaks[i], breaks[i - 1]),
            breaks[i], breaks[i - 1]);
        return;
      }
  };
  ascends(r.breaks_u, 5, "TU");
  ascends(r.breaks_v, 5 + r.breaks_u.size(), "TV");
  if (r.coefficients.size() < r.breaks_u.size() * r.breaks_v.size())
    in.remark_at(5 + r.breaks_u.size() + r.breaks_v.size(), rules::e114::dummy_rows,
                 fmt::format("{} patches, {} with the place holders", r.coefficients.size(),
                             r.breaks_u.size() * r.breaks_v.size()),
                 static_cast<double>(r.coefficients.size()),
                 static_cast<double>(r.breaks_u.size() * r.breaks_v.size()));
}

void check(const RuledSurface& r, TokenReader& in) {
  if (in.form() != 0 && in.form() != 1)
    in.remark_at(1, rules::e118::flags, fmt::format("form {}, it is 0 or 1", in.form()), in.form(), 1);
  for (const auto& [parameter, rail] : {std::pair{1, r.first}, std::pair{2, r.second}}) {
    const DirectoryEntry* target = in.target(rail);
    if (!target || target->type != PointRecord::type) require(in, static_cast<std::size_t>(parameter), rail, any_curve);
  }
  if (r.first && r.first == r.second) in.remark_at(2, rules::e118::rails, "both rails are the same curve");
}

void check(const SurfaceOfRevolution& r, TokenReader& in) {
  constexpr double turn = 2 * std::numbers::pi;
  const double sweep = r.end_angle - r.start_angle;
  require(in, 1, r.axis, axis_line);
  require(in, 2, r.generatrix, any_curve);
  if (r.axis && r.axis == r.generatrix)
    in.remark_at(2, rules::e120::axis, fmt::format("D{} is axis and generatrix at once", r.axis.de));
  if (sweep == 0)
    in.fault_at(4, rules::e120::sweep, "start and end angle are equal", 0, turn);
  else if (sweep < 0 || !(sweep <= turn + 1e-9))
    in.remark_at(4, rules::e120::sweep,
                 fmt::format("the sweep from {} to {} is not between 0 and a full turn", r.start_angle, r.end_angle),
                 sweep, turn);
  const double largest = std::max(std::fabs(r.start_angle), std::fabs(r.end_angle));
  if (largest > 6.5)
    in.remark_at(3, rules::e120::degrees, fmt::format("the angle {} looks like degrees", largest), largest, 6.5);
}

void check(const TabulatedCylinder& r, TokenReader& in) { require(in, 1, r.directrix, any_curve); }

namespace {

// Extents of the four border rows of the pole grid: at u0, u1, v0, v1.
std::array<double, 4> border_extents(const RationalBSplineSurface& r, std::size_t nu, std::size_t nv) {
  return {extent(r.points, 0, nu, nv), extent(r.points, nu - 1, nu, nv), extent(r.points, 0, 1, nu),
          extent(r.points, nu * (nv - 1), 1, nu)};
}

// Largest distance between the poles of two opposite border rows.
double row_gap(const RationalBSplineSurface& r, std::size_t first, std::size_t second, std::size_t step,
               std::size_t count) {
  double gap = 0;
  for (std::size_t i = 0; i < count; ++i)
    gap = std::max(gap, distance(r.points[first + i * step], r.points[second + i * step]));
  return gap;
}

void check_closed(TokenReader& in, std::size_t parameter, const char* direction, bool claimed, bool periodic,
                  double gap, double limit) {
  const bool closed = gap <= limit;
  if (claimed && !closed)
    in.remark_at(parameter, rules::e128::flags,
                 fmt::format("the flag says closed in {}, the borders are apart", direction), gap, limit);
  if (!claimed && closed)
    in.remark_at(parameter, Severity::Hint, rules::e128::flags,
                 fmt::format("the surface is closed in {}, the flag does not say so", direction), gap, limit);
  if (periodic && !closed)
    in.remark_at(parameter + 3, rules::e128::flags,
                 fmt::format("the flag says periodic in {}, the borders are apart", direction), gap, limit);
}

void check_flags(const RationalBSplineSurface& r, const KnotRow& u, const KnotRow& v, double size, TokenReader& in) {
  const auto nu = static_cast<std::size_t>(r.upper_u) + 1, nv = static_cast<std::size_t>(r.upper_v) + 1;
  const double limit = coincidence(in, size);
  if (u.ends_are_poles()) check_closed(in, 5, "u", r.closed_u, r.periodic_u, row_gap(r, 0, nu - 1, nu, nv), limit);
  if (v.ends_are_poles())
    check_closed(in, 6, "v", r.closed_v, r.periodic_v, row_gap(r, 0, nu * (nv - 1), 1, nu), limit);
  const bool polynomial = all_equal(r.weights);
  if (r.polynomial && !polynomial) in.remark_at(7, rules::e128::flags, "the flag says polynomial, the weights differ");
  if (!r.polynomial && polynomial)
    in.remark_at(7, Severity::Hint, rules::e128::flags, "the weights are equal, the flag does not say polynomial");
}

}  // namespace

void check(const RationalBSplineSurface& r, TokenReader& in) {
  const auto nu = static_cast<std::size_t>(r.upper_u) + 1, nv = static_cast<std::size_t>(r.upper_v) + 1;
  const std::size_t knots_v = 10 + r.knots_u.size(), weights = knots_v + r.knots_v.size();
  const std::size_t points = weights + r.weights.size(), range = points + 3 * r.points.size();
  const KnotRow u{"S", r.knots_u, r.degree_u, 10, r.u0, r.u1, range};
  const KnotRow v{"T", r.knots_v, r.degree_v, knots_v, r.v0, r.v1, range + 2};
  check_knots(u, surface_rules, in);
  check_knots(v, surface_rules, in);
  check_weights(r.weights, weights, surface_rules, in);
  if (!in.ok()) return;

  constexpr double widest = 1e6;  // readers that call weights below 1e-9 none make the whole surface polynomial
  const auto [low, high] = std::minmax_element(r.weights.begin(), r.weights.end());
  if (!(*high / *low <= widest))
    in.remark_at(weights, Severity::Warning, rules::e128::weight, fmt::format("weights run from {} to {}", *low, *high), *high / *low, widest);

  const double size = size_of(r.points);
  if (size == 0) {
    in.fault_at(points, rules::e128::collapsed, "all control points are one point", 0, 0);
    return;
  }
  const char* names[] = {"u = U(0)", "u = U(1)", "v = V(0)", "v = V(1)"};
  const std::array<double, 4> borders = border_extents(r, nu, nv);
  for (std::size_t i = 0; i < 4; ++i)
    if (borders[i] <= 1e-12 * size)
      in.remark_at(points, rules::e128::collapsed, fmt::format("the border {} is one point", names[i]), borders[i],
                   1e-12 * size);
  check_flags(r, u, v, size, in);
}

void check(const OffsetCurve& r, TokenReader& in) {
  require(in, 1, r.basis, any_curve);
  if (r.flag < 1 || r.flag > 3) {
    in.fault_at(2, rules::e130::flag, fmt::format("offset flag {}, it is 1, 2 or 3", r.flag), r.flag, 3);
    return;
  }
  if (r.flag == 3) require(in, 3, r.function, any_curve);
  if (r.flag != 1 && r.taper_type != 1 && r.taper_type != 2)
    in.remark_at(5, Severity::Warning, rules::e130::flag, fmt::format("taper type {}, it is 1 or 2", r.taper_type),
                 r.taper_type, 2);
  const double length = std::hypot(r.normal.x, r.normal.y, r.normal.z);
  if (!(std::fabs(length - 1) <= 1e-3))
    in.remark_at(10, rules::e130::normal, fmt::format("the normal has length {}", length), length, 1);
  if (!(r.tt1 < r.tt2))
    in.remark_at(13, rules::e130::range, fmt::format("the range {} to {} is empty or runs backwards", r.tt1, r.tt2),
                 r.tt1, r.tt2);
}

void check(const OffsetSurface& r, TokenReader& in) { require(in, 5, r.basis, any_surface); }

namespace {

// 190-198: form 0 has no reference direction, form 1 has one.
template <class Surface>
void check_form(const Surface& r, std::size_t parameter, TokenReader& in) {
  if (in.form() == 1 && !r.reference)
    in.remark_at(parameter, rules::e190::form_vs_ref, "form 1 without its reference direction");
  if (in.form() == 0 && r.reference)
    in.remark_at(parameter, rules::e190::form_vs_ref,
                 fmt::format("form 0 with the reference direction D{}", r.reference.de));
  admit(in, parameter, r.reference, direction);
}

void check_radius(TokenReader& in, std::size_t parameter, double radius) {
  if (!(radius > 0)) in.fault_at(parameter, rules::e190::size, fmt::format("the radius is {}", radius), radius, 0);
}

}  // namespace

void check(const PlaneSurface& r, TokenReader& in) {
  require(in, 1, r.location, point_entity);
  require(in, 2, r.normal, direction);
  check_form(r, 3, in);
}

void check(const CylindricalSurface& r, TokenReader& in) {
  require(in, 1, r.location, point_entity);
  require(in, 2, r.axis, direction);
  check_radius(in, 3, r.radius);
  check_form(r, 4, in);
}

// A cone of half-angle 0 is a cylinder, and a negative one opens the other way: odd, but shapes. At 90 degrees there is
// none.
void check(const ConicalSurface& r, TokenReader& in) {
  require(in, 1, r.location, point_entity);
  require(in, 2, r.axis, direction);
  const std::string stated = fmt::format("half-angle {} degrees", r.half_angle_deg);
  if (std::fabs(r.half_angle_deg) >= 90)
    in.fault_at(4, rules::e190::size, stated, r.half_angle_deg, 90);
  else if (!(r.half_angle_deg > 0))
    in.remark_at(4, rules::e190::size, stated, r.half_angle_deg, 0);
  if (r.radius < 0 || (r.radius == 0 && r.half_angle_deg == 0))
    in.fault_at(3, rules::e190::size, fmt::format("radius {}, {}", r.radius, stated), r.radius, 0);
  check_form(r, 5, in);
}

void check(const SphericalSurface& r, TokenReader& in) {
  require(in, 1, r.centre, point_entity);
  check_radius(in, 2, r.radius);
  admit(in, 3, r.axis, direction);
  check_form(r, 4, in);
}

// A minor radius above the major one gives a torus that cuts itself: odd, but a shape.
void check(const ToroidalSurface& r, TokenReader& in) {
  require(in, 1, r.centre, point_entity);
  require(in, 2, r.axis, direction);
  check_radius(in, 3, r.major_radius);
  check_radius(in, 4, r.minor_radius);
  if (r.minor_radius >= r.major_radius)
    in.remark_at(4, rules::e190::size, fmt::format("minor radius {}, major radius {}", r.minor_radius, r.major_radius),
                 r.minor_radius, r.major_radius);
  check_form(r, 5, in);
}

}  // namespace trimloop::iges
