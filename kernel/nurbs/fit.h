#pragma once
// Curves and surfaces through points, and near them within a bound. The NURBS Book, 2nd ed., chapter 9. Consecutive
// points that coincide count once; what would make a system singular is said in the error, with the index.

#include <span>

#include "kernel/nurbs/surface.h"

namespace trimloop {

enum class Spacing : std::uint8_t { Uniform, ChordLength, Centripetal };  // eq. 9.3 - 9.6
// Parameters in [0, 1] of points that follow one another; equal points get equal parameters.
std::vector<double> parameters_of(std::span<const Point>, Spacing);

struct Fit {
  NurbsCurve curve;
  std::vector<double> parameters;  // of each given point
  double error = 0;  // largest distance of a given point from the curve at its parameter; rounding included
};
// Global interpolation (A9.1), knots by averaging (eq. 9.8). Degree at most the number of distinct points less one.
Result<Fit> interpolate(std::span<const Point>, int degree = 3, Spacing = Spacing::ChordLength);
// The same with first derivatives at the ends, with respect to the parameter in [0, 1] (section 9.2.2; for cubics the
// system of A9.2). Either may be left out.
Result<Fit> interpolate(std::span<const Point>, int degree, std::optional<Vector> start, std::optional<Vector> end,
                        Spacing = Spacing::ChordLength);
// Section 9.2.4: points and first derivatives at all of them; two poles a point.
Result<Fit> interpolate_with_derivatives(std::span<const Point>, std::span<const Vector> derivatives, int degree = 3,
                                         Spacing = Spacing::ChordLength);
// Closed and periodic: the first point follows the last, continuity degree - 1 everywhere. An odd degree.
Result<Fit> interpolate_closed(std::span<const Point>, int degree = 3, Spacing = Spacing::ChordLength);
// Local cubic interpolation: C1, each span from its neighbours only (section 9.3.4), unit speed at the points when
// parametrized by length. Corners where three points in a row ask for one are rounded unless `keep_corners`.
Result<Fit> interpolate_local(std::span<const Point>, bool keep_corners = false);

struct SurfaceFit {
  NurbsSurface surface;
  std::vector<double> u, v;  // parameters of rows and columns
  double error = 0;
};
// rows x columns points, row-major, u along rows. Parameters are means over rows and columns; those that collapse to a
// point are left out of the mean (A9.3). A9.4.
Result<SurfaceFit> interpolate_net(std::span<const Point>, std::size_t columns, int degree_u = 3, int degree_v = 3,
                                   Spacing = Spacing::ChordLength);
// Local bicubic interpolation, C1 (A9.5).
Result<SurfaceFit> interpolate_net_local(std::span<const Point>, std::size_t columns);

// Least squares with a given number of poles (A9.6): ends interpolated unless their weights say otherwise.
struct LeastSquares {
  std::size_t poles = 0;
  int degree = 3;
  Spacing spacing = Spacing::ChordLength;
  std::vector<double> weights;  // per point; empty: one. A negative weight is a constraint: through this point
  struct Derivative {
    std::size_t point = 0;
    Vector value;
    double weight = 1;  // negative: a constraint
  };
  std::vector<Derivative> derivatives;
  std::vector<double> parameters;  // per point, ascending in [0, 1]; empty: by spacing
  std::vector<double> knots;       // full, over [0, 1]; empty: eq. 9.68 - 9.69
};
Result<Fit> approximate(std::span<const Point>, const LeastSquares&);
// A9.7: least squares with poles_u x poles_v, the four corners interpolated.
Result<SurfaceFit> approximate_net(std::span<const Point>, std::size_t columns, int degree_u, int degree_v,
                                   std::size_t poles_u, std::size_t poles_v, Spacing = Spacing::ChordLength);

// A curve within `tolerance` of every point, with few poles: a curve of degree 1 through the points, raised step by
// step to `degree`, its knots removed as far as the points allow and fitted again (A9.10 with A9.9); or the same from
// the interpolant of that degree, or from least squares over evenly spread knots: whichever ends with the fewest.
// NoConvergence when rounding is above the tolerance.
Result<Fit> approximate_within(std::span<const Point>, double tolerance, int degree = 3,
                               Spacing = Spacing::ChordLength);
Result<SurfaceFit> approximate_net_within(std::span<const Point>, std::size_t columns, double tolerance,
                                          int degree_u = 3, int degree_v = 3, Spacing = Spacing::ChordLength);

// One arc for a run of points with given end tangents, when it keeps within the tolerance of all of them (distance to
// the arc, at the parameter found for each point): a conic (A9.11) or a cubic (A9.12). NoConvergence with the distance
// reached otherwise.
Result<Fit> fit_conic(std::span<const Point>, Vector start, Vector end, double tolerance);
Result<Fit> fit_cubic(std::span<const Point>, Vector start, Vector end, double tolerance);
// As long runs as the tolerance allows, one conic or cubic each, G1 at the joints (section 9.5).
Result<Fit> fit_local(std::span<const Point>, double tolerance, bool conics = false);

}  // namespace trimloop
