#pragma once
// Derivatives as splines, derivative poles and evaluation through them, and derivatives from either side of a knot.
// The NURBS Book, 2nd ed., sections 3.3, 3.5, 4.3, 4.5; the rational hodograph as one spline of degree 2 p is
// (A' w - A w') / w^2 written out (T. Sederberg and X. Wang, "Rational hodographs", CAGD 4, 1987).

#include "kernel/nurbs/surface.h"

namespace trimloop {

// The derivative over range() as curves whose points are the derivative vectors, in order. A curve that is C1 gives
// one; it is cut where a knot of full multiplicity lets the derivative jump. Degree p - 1 (1 for lines), of rational
// curves 2 p. Limit when 2 p is above 64.
Result<std::vector<NurbsCurve>> hodograph(const NurbsCurve&);
// Partial derivatives, cut across the direction of derivation only. Of rational surfaces of degrees (2 p, 2 q).
Result<std::vector<NurbsSurface>> hodograph_u(const NurbsSurface&);
Result<std::vector<NurbsSurface>> hodograph_v(const NurbsSurface&);

// Row k, 0 .. order: the poles of the k-th derivative of the homogeneous curve (A3.3); pole i of it rests on the knots
// i + k .. i + p + 1. Zero where the knots of a pole coincide.
std::vector<std::vector<Hpoint>> derivative_poles(const NurbsCurve&, int order);
// Net (k, l), at [k * (order + 1) + l]: of the (k, l)-th partial derivative, k + l <= order (A3.7); others are empty.
std::vector<std::vector<Hpoint>> derivative_poles(const NurbsSurface&, int order);

// Derivatives 0 .. order as by derivatives(), through derivative poles (A3.4, A4.2).
std::vector<Vector> derivatives_by_poles(const NurbsCurve&, double t, int order);
// All partial derivatives with k + l <= order, at [k * (order + 1) + l]; others are zero (A3.6, A4.4).
std::vector<Vector> derivatives(const NurbsSurface&, Uv, int order);
std::vector<Vector> derivatives_by_poles(const NurbsSurface&, Uv, int order);  // A3.8

enum class Side : std::uint8_t { Left, Right };
// What derivatives() would give just before or after t; they differ at knots only. At the ends of the domain there is
// one side.
std::vector<Vector> derivatives(const NurbsCurve&, double t, int order, Side);
std::vector<Vector> derivatives(const NurbsSurface&, Uv, int order, Side u, Side v);

}  // namespace trimloop
