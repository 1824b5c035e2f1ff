#include "formats/iges/records/surfaces.h"

#include <fmt/format.h>

#include "formats/iges/records/checks.h"
#include "formats/iges/records/splines.h"

namespace trimloop::iges {

// 108 Plane (IGES 5.3 4.12): A, B, C, D, PTR (boundary, default none), X, Y, Z, SIZE of the display symbol
PlaneRecord PlaneRecord::read(TokenReader& in) {
  PlaneRecord r;
  r.a = in.real();
  r.b = in.real();
  r.c = in.real();
  r.d = in.real();
  in.optional_tail(5);
  r.boundary = in.ref();
  in.optional_tail(4);
  r.symbol = in.xyz_or({});
  r.symbol_size = in.real_or(0);
  return checked(r, in);
}

void PlaneRecord::write(TokenWriter& out) const {
  for (double value : {a, b, c, d}) out.real(value);
  out.ref(boundary);
  out.xyz(symbol);
  out.real(symbol_size);
}

// 114 Parametric Spline Surface (4.15): CTYPE, PTYPE, M, N, TU(1..M+1), TV(1..N+1), 48 coefficients a patch. Patches
// number (M+1)(N+1): each row ends with a place holder, and so does the whole with a row of them. Senders that leave
// the place holders out exist (IG-E114-04); the short form is kept as it is.
ParametricSplineSurface ParametricSplineSurface::read(TokenReader& in) {
  ParametricSplineSurface r;
  r.ctype = in.small_integer();
  r.ptype = in.small_integer();
  const std::size_t m = in.count(1), n = in.count(1);
  if (in.ok() && (m < 1 || n < 1))
    in.fault_at(3, rules::e114::patches, fmt::format("{} x {} patches: at least 1 x 1 is needed", m, n));
  if (!in.ok()) return r;
  // Each count is at most the number of parameters left, so the products below cannot overflow.
  const std::size_t breaks = m + n + 2, full = 48 * (m + 1) * (n + 1), short_form = 48 * m * n;
  const bool placeholders = breaks + full <= in.left();
  if (!in.room(breaks + (placeholders ? full : short_form))) return r;
  r.breaks_u = in.reals(m + 1);
  r.breaks_v = in.reals(n + 1);
  r.coefficients.resize(placeholders ? (m + 1) * (n + 1) : m * n);
  for (auto& patch : r.coefficients) in.reals(patch);
  return checked(std::move(r), in);
}

void ParametricSplineSurface::write(TokenWriter& out) const {
  out.integer(ctype);
  out.integer(ptype);
  out.count(breaks_u.empty() ? 0 : breaks_u.size() - 1);
  out.count(breaks_v.empty() ? 0 : breaks_v.size() - 1);
  out.reals(breaks_u);
  out.reals(breaks_v);
  for (const auto& patch : coefficients) out.reals(patch);
}

// 118 Ruled Surface (4.17): DE1, DE2, DIRFLG, DEVFLG
RuledSurface RuledSurface::read(TokenReader& in) {
  RuledSurface r;
  r.first = in.ref();
  r.second = in.ref();
  r.reverse_second = in.logical_or(false);
  r.developable = in.logical_or(false);
  return checked(r, in);
}

void RuledSurface::write(TokenWriter& out) const {
  out.ref(first);
  out.ref(second);
  out.logical(reverse_second);
  out.logical(developable);
}

// 120 Surface of Revolution (4.18): L, C, SA, TA
SurfaceOfRevolution SurfaceOfRevolution::read(TokenReader& in) {
  SurfaceOfRevolution r;
  r.axis = in.ref();
  r.generatrix = in.ref();
  r.start_angle = in.real();
  r.end_angle = in.real();
  return checked(r, in);
}

void SurfaceOfRevolution::write(TokenWriter& out) const {
  out.ref(axis);
  out.ref(generatrix);
  out.real(start_angle);
  out.real(end_angle);
}

// 122 Tabulated Cylinder (4.19): DE, LX, LY, LZ (a point, not a vector)
TabulatedCylinder TabulatedCylinder::read(TokenReader& in) {
  TabulatedCylinder r;
  r.directrix = in.ref();
  r.terminate_point = in.xyz();
  return checked(r, in);
}

void TabulatedCylinder::write(TokenWriter& out) const {
  out.ref(directrix);
  out.xyz(terminate_point);
}

// 128 Rational B-Spline Surface (4.24): K1, K2, M1, M2, PROP1-5, S(-M1..1+K1), T(-M2..1+K2), W, X Y Z (first index
// fastest), U(0), U(1), V(0), V(1)
RationalBSplineSurface RationalBSplineSurface::read(TokenReader& in) {
  RationalBSplineSurface r;
  r.upper_u = in.small_integer();
  r.upper_v = in.small_integer();
  r.degree_u = in.small_integer();
  r.degree_v = in.small_integer();
  r.closed_u = in.logical();
  r.closed_v = in.logical();
  r.polynomial = in.logical();
  r.periodic_u = in.logical();
  r.periodic_v = in.logical();
  if (!in.ok()) return r;
  const Order u = read_order(in, surface_rules, 1, r.upper_u, r.degree_u);
  const Order v = read_order(in, surface_rules, 2, r.upper_v, r.degree_v);
  // A direction has less than 2^32 poles and knots, so the product fits; four times the product might not.
  const std::size_t poles = u.poles * v.poles, knots = u.knots + v.knots;
  if (!in.room(poles) || !in.room(knots + 4 * poles + 4) || !in.ok()) return r;
  r.knots_u = in.reals(u.knots);
  r.knots_v = in.reals(v.knots);
  r.weights = in.reals(poles);
  r.points.resize(poles);
  for (Xyz& point : r.points) point = in.xyz();
  r.u0 = in.real();
  r.u1 = in.real();
  r.v0 = in.real();
  r.v1 = in.real();
  return checked(std::move(r), in);
}

void RationalBSplineSurface::write(TokenWriter& out) const {
  for (int value : {upper_u, upper_v, degree_u, degree_v}) out.integer(value);
  for (bool flag : {closed_u, closed_v, polynomial, periodic_u, periodic_v}) out.logical(flag);
  out.reals(knots_u);
  out.reals(knots_v);
  out.reals(weights);
  for (const Xyz& point : points) out.xyz(point);
  for (double value : {u0, u1, v0, v1}) out.real(value);
}

// 130 Offset Curve (4.25): DE1, FLAG, DE2, NDIM, PTYPE, D1, TD1, D2, TD2, VX, VY, VZ, TT1, TT2. What FLAG does not use
// may be empty.
OffsetCurve OffsetCurve::read(TokenReader& in) {
  OffsetCurve r;
  r.basis = in.ref();
  r.flag = in.small_integer();
  r.function = in.ref();
  r.coordinate = in.small_integer_or(0);
  r.taper_type = in.small_integer_or(0);
  r.d1 = in.real();
  r.td1 = in.real_or(0);
  r.d2 = in.real_or(0);
  r.td2 = in.real_or(0);
  r.normal = in.xyz();
  r.tt1 = in.real();
  r.tt2 = in.real();
  return checked(r, in);
}

void OffsetCurve::write(TokenWriter& out) const {
  out.ref(basis);
  out.integer(flag);
  out.ref(function);
  out.integer(coordinate);
  out.integer(taper_type);
  for (double value : {d1, td1, d2, td2}) out.real(value);
  out.xyz(normal);
  out.real(tt1);
  out.real(tt2);
}

// 140 Offset Surface (4.30): NX, NY, NZ, D, DE
OffsetSurface OffsetSurface::read(TokenReader& in) {
  OffsetSurface r;
  r.indicator = in.xyz();
  r.distance = in.real();
  r.basis = in.ref();
  return checked(r, in);
}

void OffsetSurface::write(TokenWriter& out) const {
  out.xyz(indicator);
  out.real(distance);
  out.ref(basis);
}

namespace {

// The reference direction that form 1 of 190-198 adds and form 0 does not have. A form 0 record with one more pointer
// than it should have is taken at its word (IG-E190-01).
template <class Surface>
void read_reference(TokenReader& in, Surface& r) {
  r.reference_given = in.form() == 1 || in.groups_start_after(1);
  if (!r.reference_given) return;
  in.optional_tail(1);
  r.reference = in.ref();
}

template <class Surface>
void write_reference(const Surface& r, TokenWriter& out) {
  if (r.reference || r.reference_given) out.ref(r.reference);
}

}  // namespace

// 190 Plane Surface (4.51): DELOC, DENRML; form 1: DEREFD
PlaneSurface PlaneSurface::read(TokenReader& in) {
  PlaneSurface r;
  r.location = in.ref();
  r.normal = in.ref();
  read_reference(in, r);
  return checked(r, in);
}

void PlaneSurface::write(TokenWriter& out) const {
  out.ref(location);
  out.ref(normal);
  write_reference(*this, out);
}

// 192 Right Circular Cylindrical Surface (4.52): DELOC, DEAXIS, RADIUS; form 1: DEREFD
CylindricalSurface CylindricalSurface::read(TokenReader& in) {
  CylindricalSurface r;
  r.location = in.ref();
  r.axis = in.ref();
  r.radius = in.real();
  read_reference(in, r);
  return checked(r, in);
}

void CylindricalSurface::write(TokenWriter& out) const {
  out.ref(location);
  out.ref(axis);
  out.real(radius);
  write_reference(*this, out);
}

// 194 Right Circular Conical Surface (4.53): DELOC, DEAXIS, RADIUS, SANGLE (degrees); form 1: DEREFD
ConicalSurface ConicalSurface::read(TokenReader& in) {
  ConicalSurface r;
  r.location = in.ref();
  r.axis = in.ref();
  r.radius = in.real_or(0);
  r.half_angle_deg = in.real();
  read_reference(in, r);
  return checked(r, in);
}

void ConicalSurface::write(TokenWriter& out) const {
  out.ref(location);
  out.ref(axis);
  out.real(radius);
  out.real(half_angle_deg);
  write_reference(*this, out);
}

// 196 Spherical Surface (4.54): DELOC, RADIUS; form 1: DEAXIS, DEREFD
SphericalSurface SphericalSurface::read(TokenReader& in) {
  SphericalSurface r;
  r.centre = in.ref();
  r.radius = in.real();
  r.reference_given = in.form() == 1 || in.groups_start_after(2);
  if (r.reference_given) {
    in.optional_tail(2);
    r.axis = in.ref();
    r.reference = in.ref();
  }
  return checked(r, in);
}

void SphericalSurface::write(TokenWriter& out) const {
  out.ref(centre);
  out.real(radius);
  if (!axis && !reference && !reference_given) return;
  out.ref(axis);
  out.ref(reference);
}

// 198 Toroidal Surface (4.55): DELOC, DEAXIS, MAJRAD, MINRAD; form 1: DEREFD
ToroidalSurface ToroidalSurface::read(TokenReader& in) {
  ToroidalSurface r;
  r.centre = in.ref();
  r.axis = in.ref();
  r.major_radius = in.real();
  r.minor_radius = in.real();
  read_reference(in, r);
  return checked(r, in);
}

void ToroidalSurface::write(TokenWriter& out) const {
  out.ref(centre);
  out.ref(axis);
  out.real(major_radius);
  out.real(minor_radius);
  write_reference(*this, out);
}

}  // namespace trimloop::iges
