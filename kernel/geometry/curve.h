#pragma once
// Curve: one of a closed set of small value types, each with its own exact form and parametrization
// (ISO 10303-42; angles in radians). Curve2 is a curve in the parameter plane of a surface: z = 0.

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "kernel/math/transform.h"
#include "kernel/nurbs/curve.h"

namespace trimloop {

struct Curve;
using CurvePtr = std::shared_ptr<const Curve>;

struct Line {  // start + t (end - start), t in range; [0,1] is the segment; rays and lines have infinite ends
  Point start, end;
  Interval range{0, 1};
};
struct Circle {  // origin + radius (cos t x + sin t y)
  Frame frame;
  double radius = 1;
  Interval range{0, two_pi};
};
struct Ellipse {  // origin + a cos t x + b sin t y; a < b is legal
  Frame frame;
  double a = 1, b = 1;
  Interval range{0, two_pi};
};
struct Parabola {  // origin + f t^2 x + 2 f t y, f the focal length
  Frame frame;
  double focal_length = 1;
  Interval range{-1, 1};
};
struct Hyperbola {  // origin + a cosh t x + b sinh t y
  Frame frame;
  double a = 1, b = 1;
  Interval range{-1, 1};
};
struct Polyline {  // points[i] at t = i
  std::vector<Point> points;
};
struct OffsetCurve {  // C(t) + distance * normalized(C'(t) x normal)
  CurvePtr basis;
  double distance = 0;
  Vector normal{0, 0, 1};
};
struct CompositeCurve {  // children end to end; the parameter adds each child's span. Made by make_composite.
  struct Segment {
    CurvePtr curve;
    bool reversed = false;
  };
  std::vector<Segment> segments;
  std::vector<double> starts;  // parameter of each segment's start, and the end of the last: segments + 1 (or none)
};

struct Curve {
  std::variant<Line, Circle, Ellipse, Parabola, Hyperbola, Polyline, NurbsCurve, OffsetCurve, CompositeCurve> shape;
};

struct Curve2 {
  Curve curve;  // z = 0 throughout
};

// Parameter from 0. Null children are left out; of a ray or line its first unit of parameter is taken.
CompositeCurve make_composite(std::vector<CompositeCurve::Segment>);

Interval range(const Curve&);
Point evaluate(const Curve&, double t);  // t outside the range: extended where the type can, else clamped
CurveJet jet(const Curve&, double t);    // at a joint: of the piece that begins there (of the last piece at the end)
Point start_point(const Curve&);
Point end_point(const Curve&);
bool is_bounded(const Curve&);
// Parameters that cut the range into smooth pieces: both ends, knots, joints. At least two values when bounded.
std::vector<double> breaks(const Curve&);
Box bounding_box(const Curve&);                             // encloses; empty for unbounded curves
double length(const Curve&, double relative_error = 1e-9);  // adaptive Gauss per smooth piece
// Exact. Similarities (up to 1e-9) keep type and parameter. Any other affine map turns circle and ellipse into an
// ellipse and a hyperbola into one with a shifted parameter (old range -> new range), a parabola into a NURBS of the
// same parameter. Offsets under a non-similarity are Unsupported, conics under a singular map Degenerate.
Result<Curve> transformed(const Curve&, const Transform&);
// Same points in the other order: its parameter is new.lo + (old.hi - t). The range stays, except that ellipse,
// parabola, hyperbola and unbounded lines get [-hi, -lo], and a part of a NURBS its mirror image in the knot domain.
Curve reversed(const Curve&);
// The part over the interval, parameters kept; types that cannot be extended are cut to what they have. A part of a
// polyline is a NURBS of degree 1.
Curve with_range(const Curve&, Interval);

// Piecewise monotone map between a curve's own parameter and that of its NURBS; own and nurbs hold the piece
// boundaries. With x and y in [-1, 1] across a piece and h half the span of the conic's parameter over it: Affine y =
// x; HalfAngle y = tan(x h / 2) / tan(h / 2) (circle, ellipse); HalfHyperbolic the same with tanh.
struct ParameterMap {
  enum class Kind : std::uint8_t { Affine, HalfAngle, HalfHyperbolic };
  struct Piece {
    Kind kind = Kind::Affine;
    double half_span = 0;
  };
  std::vector<double> own, nurbs;
  std::vector<Piece> pieces;
};
double map_to_nurbs(const ParameterMap&, double t);  // clamped to the ends
double map_from_nurbs(const ParameterMap&, double s);

// Exact rational B-spline of a bounded curve and the parameter map to it. Offset curves are Unsupported here (they are
// approximated elsewhere, with a bound).
struct ToNurbsCurve {
  NurbsCurve curve;
  ParameterMap map;
  double deviation = 0;  // 0: exact. Children of a composite that do not meet are joined; this is their largest gap.
};
Result<ToNurbsCurve> to_nurbs(const Curve&);
inline double map_to_nurbs(const ToNurbsCurve& n, double t) { return map_to_nurbs(n.map, t); }
inline double map_from_nurbs(const ToNurbsCurve& n, double s) { return map_from_nurbs(n.map, s); }

inline Uv evaluate(const Curve2& c, double t) {
  const Point p = evaluate(c.curve, t);
  return {p.x, p.y};
}
inline Interval range(const Curve2& c) { return range(c.curve); }
Curve2 make_line2(Uv a, Uv b);
Curve2 make_polyline2(const std::vector<Uv>&);

struct CurveFoot {
  double t = 0;
  Point point;
  double distance = infinity;
};
// Nearest point of a bounded curve: sampling per smooth piece, then Newton; ends are candidates.
CurveFoot closest_point(const Curve&, Point);
// Refines from a start parameter only (Newton with step control); cheap.
CurveFoot closest_point_near(const Curve&, Point, double t_start);

}  // namespace trimloop
