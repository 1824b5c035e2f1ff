#pragma once
// Circles and conic arcs as rational splines. The NURBS Book, 2nd ed., chapter 7. Analytic types are converted, with
// the map of their parameters, in kernel/geometry.

#include "kernel/nurbs/curve.h"

namespace trimloop {

// Arc from angle.lo to angle.hi (at most a full turn) about frame.z, in pieces of a quarter turn at most; knots 0, 1,
// .. pieces. Weights are square roots, so points are off the circle by rounding. A7.1.
Result<NurbsCurve> circle_arc(const Frame&, double radius, Interval angle_rad);
// The quarter from frame.x to frame.y with weights 1, 1, 2: x^2 + y^2 = r^2 w^2 holds in the stored numbers when the
// frame is that of the axes and r has digits to spare (a power of two, a small integer).
Result<NurbsCurve> rational_quarter_circle(const Frame&, double radius);
// The whole circle as one quintic Bezier curve with weights 5, 1, 1, 1, 1, 5 over [0, 1]; the square of the complex
// quadratic with ordinates 1, i, -1, raised once (J. Chou, "Higher order Bezier circles", CAD 27, 1995). Same identity.
Result<NurbsCurve> quintic_circle(const Frame&, double radius);
// The same circle as a quartic, weights 3, 0, 1, 0, 3: two of its poles are ideal.
Result<NurbsCurve> quartic_circle(const Frame&, double radius);
// The half circle from frame.x by frame.y to -frame.x as a quadratic with an ideal pole in the middle.
Result<NurbsCurve> ideal_half_circle(const Frame&, double radius);

// One rational quadratic from p0 with tangent t0 to p2 with tangent t2 through p, weights 1, w, 1. Parallel tangents
// give an ideal middle pole, a point on the other side of the chord a negative weight. Degenerate when the data lie in
// no plane or make no conic. A7.2.
Result<NurbsCurve> one_conic_arc(Point p0, Vector t0, Point p2, Vector t2, Point p);
// The same arc in as many positive pieces as its angle asks for. A7.3.
Result<NurbsCurve> open_conic(Point p0, Vector t0, Point p2, Vector t2, Point p);

enum class ConicClass : std::uint8_t { Line, Ellipse, Parabola, Hyperbola };
struct ConicShape {
  ConicClass kind = ConicClass::Line;
  double shape_factor = 0;  // w1^2 / (w0 w2): below 1, equal to 1, above 1
};
// Of a rational quadratic Bezier curve; Unsupported for anything else. `relative` decides "equal".
Result<ConicShape> conic_class(const NurbsCurve&, double relative = 1e-12);
// The rest of the conic between the same ends: the middle weight with the other sign.
Result<NurbsCurve> complementary_arc(const NurbsCurve&);

}  // namespace trimloop
