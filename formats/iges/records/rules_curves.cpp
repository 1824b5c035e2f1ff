#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/iges/records/checks.h"
#include "formats/iges/records/splines.h"
#include "formats/iges/records/targets.h"
#include "formats/iges/rules.h"

namespace trimloop::iges {

void check(const CircularArc& r, TokenReader& in) {
  const double start = std::hypot(r.xs - r.xc, r.ys - r.yc), end = std::hypot(r.xe - r.xc, r.ye - r.yc);
  if (!(start > 0) || !(end > 0)) {
    in.fault_at(2, rules::e100::radius_zero, "the centre is the start or the end of the arc", std::min(start, end), 0);
    return;
  }
  const double limit = coincidence(in, std::max(start, end));
  if (!(std::fabs(start - end) <= limit))
    in.remark_at(6, rules::e100::radius_mismatch, fmt::format("radius {} at the start, {} at the end", start, end),
                 std::fabs(start - end), limit);
  const double chord = std::hypot(r.xs - r.xe, r.ys - r.ye);
  if (chord > 0 && chord < limit)
    in.remark_at(6, rules::e100::full_or_tiny, "start and end are closer than the resolution, but not equal", chord,
                 limit);
}

void check(const CompositeCurve& r, TokenReader& in) {
  if (r.members.empty()) in.fault_at(1, rules::e102::count, "a composite curve without members", 0, 1);
  for (std::size_t i = 0; i < r.members.size(); ++i) {
    const DirectoryEntry* target = in.target(r.members[i]);
    if (target && target->type == CompositeCurve::type)
      in.remark_at(2 + i, rules::e102::member_type, fmt::format("member D{} is a composite curve itself", target->de));
    else
      require(in, 2 + i, r.members[i], composite_member);
    if (i > 0 && r.members[i] && r.members[i] == r.members[i - 1])
      in.remark_at(2 + i, rules::e102::repeated_member, fmt::format("member D{} follows itself", r.members[i].de));
  }
}

namespace {

// Volume of the three rows' box that the matrix of the conic fills, 0..1: 0 where the conic falls apart into lines or
// nothing. Coordinates are taken in units of `length` first, so that the answer does not depend on the file's unit.
double conic_fullness(const ConicArc& r, double length) {
  const double a = r.a * length * length, b = r.b * length * length / 2, c = r.c * length * length;
  const double d = r.d * length / 2, e = r.e * length / 2, f = r.f;
  const double volume = a * (c * f - e * e) - b * (b * f - e * d) + d * (b * e - c * d);
  return std::fabs(volume) / (std::hypot(a, b, d) * std::hypot(b, c, e) * std::hypot(d, e, f));
}

// Form that the coefficients ask for: 1 ellipse, 2 hyperbola, 3 parabola (IGES 5.3 4.5).
int conic_form(const ConicArc& r) {
  const double discriminant = r.a * r.c - r.b * r.b / 4;
  const double scale = std::fabs(r.a * r.c) + r.b * r.b / 4;
  if (std::fabs(discriminant) <= 1e-12 * scale) return 3;
  return discriminant > 0 ? 1 : 2;
}

}  // namespace

void check(const ConicArc& r, TokenReader& in) {
  const double length = std::max({std::fabs(r.xs), std::fabs(r.ys), std::fabs(r.xe), std::fabs(r.ye)});
  const double fullness = conic_fullness(r, length > 0 ? length : 1);
  if (!(fullness > 1e-12)) {
    in.fault_at(1, rules::e104::degenerate, "the coefficients describe lines, a point or nothing", fullness, 1e-12);
    return;
  }
  const int form = conic_form(r);
  if (in.form() != 0 && in.form() != form)
    in.remark_at(1, rules::e104::form_vs_coeffs,
                 fmt::format("the form is {}, the coefficients make it {}", in.form(), form), in.form(), form);
}

namespace {

// What a form of 106 asks for (IGES 5.3 4.6-4.11).
struct CopiousForm {
  int interpretation;  // 0: any
  std::size_t minimum;
  enum { Any, Even, Odd } parity;
};

CopiousForm copious_form(int form) {
  if (form >= 31 && form <= 38) return {1, 2, CopiousForm::Even};
  switch (form) {
    case 1:
      return {1, 1, CopiousForm::Any};
    case 2:
      return {2, 1, CopiousForm::Any};
    case 3:
      return {3, 1, CopiousForm::Any};
    case 11:
      return {1, 2, CopiousForm::Any};
    case 12:
      return {2, 2, CopiousForm::Any};
    case 13:
      return {3, 2, CopiousForm::Any};
    case 20:
    case 21:
      return {1, 2, CopiousForm::Even};
    case 40:
      return {1, 3, CopiousForm::Odd};
    case 63:
      return {1, 2, CopiousForm::Any};
    default:
      return {0, 1, CopiousForm::Any};
  }
}

Xyz copious_point(const CopiousData& r, std::size_t i) {
  const double* p = r.values.data() + i * r.stride();
  return {p[0], p[1], r.stride() > 2 ? p[2] : r.common_z};
}

void check_path(const CopiousData& r, std::size_t points, std::size_t first, TokenReader& in) {
  std::size_t repeated = 0, where = 0;
  double size = 0;
  for (std::size_t i = 1; i < points; ++i) {
    const double step = distance(copious_point(r, i - 1), copious_point(r, i));
    size = std::max(size, step);
    if (step == 0 && repeated++ == 0) where = i;
  }
  if (repeated > 0)
    in.remark_at(first + where * r.stride(), rules::e106::repeated_points,
                 fmt::format("point {} equals the one before ({} such points)", where + 1, repeated), 0, 0);
  const double gap = distance(copious_point(r, 0), copious_point(r, points - 1)), limit = coincidence(in, size);
  if (in.form() == 63 && !(gap <= limit))
    in.remark_at(first + (points - 1) * r.stride(), rules::e106::not_closed, "the last point is not the first", gap,
                 limit);
}

}  // namespace

void check(const CopiousData& r, TokenReader& in) {
  if (r.interpretation < 1 || r.interpretation > 3) {
    in.fault_at(1, rules::e106::form_vs_ip, fmt::format("interpretation flag {}, it is 1, 2 or 3", r.interpretation),
                r.interpretation, 3);
    return;
  }
  const CopiousForm form = copious_form(in.form());
  const std::size_t points = r.values.size() / r.stride(), first = r.interpretation == 1 ? 4 : 3;
  if (form.interpretation != 0 && form.interpretation != r.interpretation)
    in.remark_at(
        1, rules::e106::form_vs_ip,
        fmt::format("interpretation flag {}, form {} asks for {}", r.interpretation, in.form(), form.interpretation),
        r.interpretation, form.interpretation);
  if (points < form.minimum) {
    in.fault_at(2, rules::e106::count, fmt::format("{} points, form {} needs {}", points, in.form(), form.minimum),
                static_cast<double>(points), static_cast<double>(form.minimum));
    return;
  }
  if ((form.parity == CopiousForm::Even && points % 2 != 0) || (form.parity == CopiousForm::Odd && points % 2 == 0))
    in.remark_at(2, rules::e106::parity,
                 fmt::format("{} points, form {} needs an {} number", points, in.form(),
                             form.parity == CopiousForm::Even ? "even" : "odd"));
  if (in.form() >= 11 && (in.form() <= 13 || in.form() == 63)) check_path(r, points, first, in);
  for (std::size_t i = 0; r.interpretation == 3 && i < points; ++i) {
    const double* v = r.values.data() + 6 * i + 3;
    if (std::hypot(v[0], v[1], v[2]) > 1e-12) continue;
    in.remark_at(first + 6 * i + 3, rules::e106::zero_vector, fmt::format("the vector of point {} is zero", i + 1), 0,
                 1e-12);
    break;
  }
}

void check(const Line& r, TokenReader& in) {
  if (distance(r.start, r.end) == 0)
    in.remark_at(4, rules::e110::zero_length, "start and end are the same point", 0, 0);
  if (in.form() < 0 || in.form() > 2)
    in.remark_at(1, Severity::Warning, rules::form_number,
                 fmt::format("form {} of a line; it is read as a segment", in.form()));
}

namespace {

// The largest difference between the stored terminal values and those of the last segment at its end, relative to the
// terms that make them up: the value and the derivatives divided by 1!, 2! and 3!. Some senders leave the divisions
// out.
double terminal_error(const ParametricSplineCurve& r) {
  const double h = r.breaks[r.breaks.size() - 1] - r.breaks[r.breaks.size() - 2];
  double error = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double* p = r.coefficients.back().data() + 4 * axis;
    const double terms[4][4] = {{p[0], h * p[1], h * h * p[2], h * h * h * p[3]},
                                {p[1], 2 * h * p[2], 3 * h * h * p[3], 0},
                                {p[2], 3 * h * p[3], 0, 0},
                                {p[3], 0, 0, 0}};
    const double factorial[4] = {1, 1, 2, 6};
    for (std::size_t i = 0; i < 4; ++i) {
      const double stored = r.terminal[4 * axis + i];
      double value = 0, size = std::fabs(stored);
      for (double term : terms[i]) {
        value += term;
        size += factorial[i] * std::fabs(term);
      }
      const double difference = std::min(std::fabs(stored - value), std::fabs(stored - factorial[i] * value));
      if (size > 0) error = std::max(error, difference / size);
    }
  }
  return error;
}

}  // namespace

void check(const ParametricSplineCurve& r, TokenReader& in) {
  if (r.ctype < 1 || r.ctype > 6 || r.continuity < 0 || r.continuity > 2)
    in.remark_at(1, rules::e112::spline_type,
                 fmt::format("spline type {} (1 to 6), continuity {} (0 to 2)", r.ctype, r.continuity));
  if (r.dimension != 2 && r.dimension != 3)
    in.remark_at(3, rules::e112::dimensions, fmt::format("dimension {}, it is 2 or 3", r.dimension), r.dimension, 3);
  for (std::size_t i = 1; i < r.breaks.size(); ++i)
    if (!(r.breaks[i] > r.breaks[i - 1])) {
      in.fault_at(5 + i, rules::e112::breakpoints,
                  fmt::format("break point {} = {} does not exceed {} before it", i + 1, r.breaks[i], r.breaks[i - 1]),
                  r.breaks[i], r.breaks[i - 1]);
      return;
    }
  const double error = terminal_error(r);
  if (!(error <= 1e-6))
    in.remark_at(in.position() - 12, rules::e112::terminal_block,
                 "the terminal values are not those of the last segment", error, 1e-6);
  const bool bends = std::any_of(r.coefficients.begin(), r.coefficients.end(),
                                 [](const auto& c) { return c[9] != 0 || c[10] != 0 || c[11] != 0; });
  if (r.dimension == 2 && bends)
    in.remark_at(3, Severity::Warning, rules::e112::dimensions,
                 "a planar spline (dimension 2) whose z is not constant");
}

void check(const PointRecord& r, TokenReader& in) {
  const DirectoryEntry* symbol = in.target(r.symbol);
  if (symbol && symbol->type != 308)
    in.remark_at(4, rules::e116::symbol,
                 fmt::format("the display symbol D{} is of type {}, not 308", symbol->de, symbol->type));
}

void check(const Direction& r, TokenReader& in) {
  const double length = std::hypot(r.vector.x, r.vector.y, r.vector.z);
  if (!(length > 1e-12)) in.fault_at(1, rules::e123::zero, "the direction is zero", length, 1e-12);
}

// Orthonormal within 1e-5, or what it is instead: singular, scaled, skewed.
void check(const TransformationMatrix& r, TokenReader& in) {
  const int form = in.form();
  if (form != 0 && form != 1 && !(form >= 10 && form <= 12))
    in.remark_at(1, rules::e124::form, fmt::format("form {}", form), form, 12);

  const auto row = [&](std::size_t i) { return r.m.data() + 4 * i; };
  const auto dot = [](const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const double *x = row(0), *y = row(1), *z = row(2);
  const double determinant =
      x[0] * (y[1] * z[2] - y[2] * z[1]) - x[1] * (y[0] * z[2] - y[2] * z[0]) + x[2] * (y[0] * z[1] - y[1] * z[0]);
  const double lengths[3] = {std::hypot(x[0], x[1], x[2]), std::hypot(y[0], y[1], y[2]), std::hypot(z[0], z[1], z[2])};
  const double fullness = std::fabs(determinant) / (lengths[0] * lengths[1] * lengths[2]);
  if (!(fullness > 1e-9)) {
    in.fault_at(1, rules::e124::singular, "the matrix cannot be inverted", fullness, 1e-9);
    return;
  }
  if ((form == 0 && determinant < 0) || (form == 1 && determinant > 0))
    in.remark_at(1, rules::e124::handedness, fmt::format("form {} with determinant {}", form, determinant),
                 determinant);

  const double scale = std::cbrt(std::fabs(determinant));
  double skew = 0, error = 0;  // of R / scale, of R
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j) {
      const double wanted = i == j ? 1 : 0, product = dot(row(i), row(j));
      skew = std::max(skew, std::fabs(product / (scale * scale) - wanted));
      error = std::max(error, std::fabs(product - wanted));
    }
  if (skew <= 1e-5 && std::fabs(scale - 1) > 1e-5)
    in.remark_at(1, rules::e124::scale, fmt::format("the matrix scales by {}", scale), scale, 1);
  else if (!(error <= 1e-5))
    in.remark_at(1, error > 1e-3 ? Severity::Error : Severity::Warning, rules::e124::orthonormal,
                 "the rotation part is not orthonormal", error, 1e-5);
}

namespace {

// Largest distance of a point from the plane through three far points, or 0 for points on a line.
double flatness(std::span<const Xyz> points) {
  const auto minus = [](const Xyz& a, const Xyz& b) { return Xyz{a.x - b.x, a.y - b.y, a.z - b.z}; };
  const auto dot = [](const Xyz& a, const Xyz& b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
  const auto cross = [](const Xyz& a, const Xyz& b) {
    return Xyz{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  };
  Xyz along, normal;
  for (const Xyz& p : points)
    if (const Xyz d = minus(p, points[0]); dot(d, d) > dot(along, along)) along = d;
  for (const Xyz& p : points)
    if (const Xyz n = cross(along, minus(p, points[0])); dot(n, n) > dot(normal, normal)) normal = n;
  const double size = std::sqrt(dot(normal, normal));
  if (!(size > 1e-12 * dot(along, along))) return 0;
  double worst = 0;
  for (const Xyz& p : points) worst = std::max(worst, std::fabs(dot(minus(p, points[0]), normal)));
  return worst / size;
}

// A flag that claims too much misleads (the rule's own severity); one that claims too little is a hint.
void check_flag(TokenReader& in, std::size_t parameter, const Rule& rule, bool claimed, bool true_indeed,
                const char* property, double measured, double limit) {
  if (claimed && !true_indeed)
    in.remark_at(parameter, rule, fmt::format("the flag says {}, the curve is not", property), measured, limit);
  if (!claimed && true_indeed)
    in.remark_at(parameter, Severity::Hint, rule, fmt::format("the curve is {}, the flag does not say so", property),
                 measured, limit);
}

void check_flags(const RationalBSplineCurve& r, const KnotRow& row, double size, TokenReader& in) {
  const double limit = coincidence(in, size);
  const double flat = flatness(r.points);
  check_flag(in, 3, rules::e126::planar_flag, r.planar, flat <= limit, "planar", flat, limit);
  check_flag(in, 5, rules::e126::polynomial_flag, r.polynomial, all_equal(r.weights), "polynomial", not_measured,
             not_measured);
  if (row.ends_are_poles()) {
    const double gap = distance(r.points.front(), r.points.back());
    check_flag(in, 4, rules::e126::closed_flag, r.closed, gap <= limit, "closed", gap, limit);
    if (r.periodic)
      in.remark_at(6, gap <= limit ? Severity::Hint : rules::e126::periodic_flag.severity, rules::e126::periodic_flag,
                   gap <= limit ? "the flag says periodic, the end knots are those of a clamped curve"
                                : "the flag says periodic, the ends are apart",
                   gap, limit);
  }
  const double length = std::hypot(r.normal.x, r.normal.y, r.normal.z);
  if (r.planar && !(std::fabs(length - 1) <= 1e-3))
    in.remark_at(in.position() - 3, rules::e126::normal,
                 length == 0 ? std::string("a planar curve without its normal")
                             : fmt::format("the normal has length {}", length),
                 length, 1);
}

}  // namespace

void check(const RationalBSplineCurve& r, TokenReader& in) {
  const std::size_t weights = 7 + r.knots.size(), points = weights + r.weights.size();
  const std::size_t range = points + 3 * r.points.size();
  const KnotRow row{"T", r.knots, r.degree, 7, r.v0, r.v1, range};
  check_knots(row, curve_rules, in);
  check_weights(r.weights, weights, curve_rules, in);
  if (!in.ok()) return;

  const auto [low, high] = std::minmax_element(r.weights.begin(), r.weights.end());
  if (!(*high / *low <= 1e6))
    in.remark_at(weights, rules::e126::weight_ratio, fmt::format("weights run from {} to {}", *low, *high),
                 *high / *low, 1e6);
  const double size = size_of(r.points);
  if (size == 0) {
    in.remark_at(points, rules::e126::all_coincident, "all control points are one point", 0, 0);
    return;
  }
  check_flags(r, row, size, in);
}

}  // namespace trimloop::iges
