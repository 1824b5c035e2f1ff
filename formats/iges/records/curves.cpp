#include "formats/iges/records/curves.h"

#include <fmt/format.h>

#include "formats/iges/records/checks.h"
#include "formats/iges/records/splines.h"

namespace trimloop::iges {

// 100 Circular Arc (IGES 5.3 4.3): ZT, X1, Y1 (centre), X2, Y2 (start), X3, Y3 (end)
CircularArc CircularArc::read(TokenReader& in) {
  CircularArc r;
  r.zt = in.real();
  r.xc = in.real();
  r.yc = in.real();
  r.xs = in.real();
  r.ys = in.real();
  r.xe = in.real();
  r.ye = in.real();
  return checked(r, in);
}

void CircularArc::write(TokenWriter& out) const {
  for (double value : {zt, xc, yc, xs, ys, xe, ye}) out.real(value);
}

// 102 Composite Curve (4.4): N, DE(1..N)
CompositeCurve CompositeCurve::read(TokenReader& in) {
  CompositeCurve r;
  r.members = in.refs(in.count(1));
  return checked(std::move(r), in);
}

void CompositeCurve::write(TokenWriter& out) const {
  out.count(members.size());
  out.refs(members);
}

// 104 Conic Arc (4.5): A..F, ZT, X1, Y1 (start), X2, Y2 (end)
ConicArc ConicArc::read(TokenReader& in) {
  ConicArc r;
  r.a = in.real();
  r.b = in.real();
  r.c = in.real();
  r.d = in.real();
  r.e = in.real();
  r.f = in.real();
  r.zt = in.real();
  r.xs = in.real();
  r.ys = in.real();
  r.xe = in.real();
  r.ye = in.real();
  return checked(r, in);
}

void ConicArc::write(TokenWriter& out) const {
  for (double value : {a, b, c, d, e, f, zt, xs, ys, xe, ye}) out.real(value);
}

// 106 Copious Data (4.6-4.11): IP, N, then ZT and N pairs (IP 1), N triples (2) or N sextuples (3)
CopiousData CopiousData::read(TokenReader& in) {
  CopiousData r;
  r.interpretation = in.small_integer();
  const bool known = r.interpretation >= 1 && r.interpretation <= 3;
  if (in.ok() && !known) check(r, in);
  if (!in.ok()) return r;
  const std::size_t points = in.count(r.stride());
  if (r.interpretation == 1) r.common_z = in.real();
  if (in.room(points * r.stride())) r.values = in.reals(points * r.stride());
  return checked(std::move(r), in);
}

void CopiousData::write(TokenWriter& out) const {
  out.integer(interpretation);
  out.count(values.size() / stride());
  if (interpretation == 1) out.real(common_z);
  out.reals(values);
}

// 110 Line (4.13): X1, Y1, Z1, X2, Y2, Z2
Line Line::read(TokenReader& in) {
  Line r;
  r.start = in.xyz();
  r.end = in.xyz();
  return checked(r, in);
}

void Line::write(TokenWriter& out) const {
  out.xyz(start);
  out.xyz(end);
}

// 112 Parametric Spline Curve (4.14): CTYPE, H, NDIM, N, T(1..N+1), 12 coefficients a segment, 12 terminal values
ParametricSplineCurve ParametricSplineCurve::read(TokenReader& in) {
  ParametricSplineCurve r;
  r.ctype = in.small_integer();
  r.continuity = in.small_integer();
  r.dimension = in.small_integer();
  const std::size_t segments = in.count(13);
  if (in.ok() && segments == 0) in.fault(rules::e112::segments, "a spline without segments", 0, 1);
  if (!in.ok() || !in.room(1 + 13 * segments + 12)) return r;
  r.breaks = in.reals(segments + 1);
  r.coefficients.resize(segments);
  for (auto& segment : r.coefficients) in.reals(segment);
  in.reals(r.terminal);
  return checked(std::move(r), in);
}

void ParametricSplineCurve::write(TokenWriter& out) const {
  out.integer(ctype);
  out.integer(continuity);
  out.integer(dimension);
  out.count(coefficients.size());
  out.reals(breaks);
  for (const auto& segment : coefficients) out.reals(segment);
  out.reals(terminal);
}

// 116 Point (4.16): X, Y, Z, PTR (display symbol, default none)
PointRecord PointRecord::read(TokenReader& in) {
  PointRecord r;
  r.point = in.xyz();
  in.optional_tail(1);
  r.symbol = in.ref();
  return checked(r, in);
}

void PointRecord::write(TokenWriter& out) const {
  out.xyz(point);
  out.ref(symbol);
}

// 123 Direction (4.20): X, Y, Z
Direction Direction::read(TokenReader& in) {
  Direction r;
  r.vector = in.xyz();
  return checked(r, in);
}

void Direction::write(TokenWriter& out) const { out.xyz(vector); }

// 124 Transformation Matrix (4.21): R11, R12, R13, T1, R21 .. T3
TransformationMatrix TransformationMatrix::read(TokenReader& in) {
  TransformationMatrix r;
  in.reals(r.m);
  return checked(r, in);
}

void TransformationMatrix::write(TokenWriter& out) const { out.reals(m); }

// 126 Rational B-Spline Curve (4.23): K, M, PROP1-4, T(-M..1+K), W(0..K), X Y Z (0..K), V(0), V(1), normal
RationalBSplineCurve RationalBSplineCurve::read(TokenReader& in) {
  RationalBSplineCurve r;
  r.upper_index = in.small_integer();
  r.degree = in.small_integer();
  r.planar = in.logical();
  r.closed = in.logical();
  r.polynomial = in.logical();
  r.periodic = in.logical();
  if (!in.ok()) return r;
  const Order order = read_order(in, curve_rules, 1, r.upper_index, r.degree);
  if (!in.room(order.knots + 4 * order.poles + 2) || !in.ok()) return r;
  r.knots = in.reals(order.knots);
  r.weights = in.reals(order.poles);
  r.points.resize(order.poles);
  for (Xyz& point : r.points) point = in.xyz();
  r.v0 = in.real();
  r.v1 = in.real();
  in.optional_tail(3);  // many senders leave the normal out when the curve is not planar
  r.normal = in.xyz_or({});
  return checked(std::move(r), in);
}

void RationalBSplineCurve::write(TokenWriter& out) const {
  out.integer(upper_index);
  out.integer(degree);
  for (bool flag : {planar, closed, polynomial, periodic}) out.logical(flag);
  out.reals(knots);
  out.reals(weights);
  for (const Xyz& point : points) out.xyz(point);
  out.real(v0);
  out.real(v1);
  out.xyz(normal);
}

}  // namespace trimloop::iges
