#pragma once
// Points, curves and surfaces of one representation: records of ISO 10303-42 in the units of its context -> shapes in mm.

#include "io/step/context.h"
#include "kernel/geometry/surface.h"

namespace trimloop::io::step_import {

// A surface and how the file's parameters lie on ours: u' = u scale_u.
struct PlacedSurface {
  SurfacePtr surface;
  double scale_u = 1, scale_v = 1;
  bool flipped = false;                     // the file's Su x Sv is against ours (trimmed with one sense turned)
  bool turned_inside = false;               // a torus of negative major radius: its inner sheet looks away from the axis
  std::optional<Interval> range_u, range_v; // a rectangular trim, in our parameters
};

class Geometry {
 public:
  // Flat: curves in the parameter plane of a surface; nothing is scaled, z is 0.
  Geometry(Context& context, const Units& units, bool flat = false) : context_(context), units_(units), flat_(flat) {}

  const Units& units() const { return units_; }
  double mm() const { return flat_ ? 1 : units_.mm; }

  std::optional<Point> point(const Record& owner, Ref ref);        // CARTESIAN_POINT, POINT_ON_CURVE, ...
  std::optional<Point> point(const Record& instance);
  std::optional<Vector> direction(const Record& owner, Ref ref);   // unit; nothing after a finding
  std::optional<Frame> frame(const Record& owner, Ref ref);        // AXIS2_PLACEMENT_3D or _2D
  std::optional<Frame> axis(const Record& owner, Ref ref);         // AXIS1_PLACEMENT: z is the axis
  std::optional<Transform> transform(const Record& instance);      // placement or transformation operator

  // Null after findings. Lines are unbounded, conics whole. Each instance is read once.
  CurvePtr curve(const Record& owner, Ref ref);
  CurvePtr curve(const Record& instance);
  std::optional<PlacedSurface> surface(const Record& owner, Ref ref);
  std::optional<PlacedSurface> surface(const Record& instance);

 private:
  std::optional<Curve> make_curve(const Record& instance);
  std::optional<Curve> line(const Record& instance);
  std::optional<Curve> conic(const Record& instance);
  std::optional<Curve> spline(const Record& instance);
  std::optional<Curve> trimmed(const Record& instance);
  std::optional<Curve> composite(const Record& instance);
  std::optional<Curve> offset(const Record& instance);
  std::optional<Curve> on_surface(const Record& instance);
  std::optional<double> trim_parameter(const Record& instance, const std::vector<step::Select>& trim, const std::string& master,
                                       const Curve& basis, double scale);
  double parameter_scale(const Record& curve);

  std::optional<PlacedSurface> make_surface(const Record& instance);
  std::optional<PlacedSurface> elementary(const Record& instance);
  std::optional<PlacedSurface> torus(const Record& instance, const Frame& frame, double major, double minor, bool degenerate, bool outer);
  std::optional<PlacedSurface> swept(const Record& instance);
  std::optional<PlacedSurface> spline_surface(const Record& instance);
  std::optional<PlacedSurface> rectangular(const Record& instance);
  std::optional<PlacedSurface> offset_surface(const Record& instance);
  std::optional<PlacedSurface> replica_surface(const Record& instance);

  Context& context_;
  Units units_;
  bool flat_ = false;
  std::unordered_map<std::size_t, CurvePtr> curves_;
  std::unordered_map<std::size_t, std::optional<PlacedSurface>> surfaces_;
};

// Parameter of the point of a curve nearest to `p`: closed forms for lines and conics.
double parameter_near(const Curve& curve, Point p);
bool is_closed_by_nature(const Curve& curve);  // circle, ellipse

// One of the two parts of a torus that goes through itself, an arc turned about the axis that it ends on; the parameters are
// those of the torus. ISO 10303-42 degenerate_toroidal_surface.
SurfacePtr spindle_sheet(const Torus& torus, bool outer);

// A copy of a swept surface with unbounded parts that is large enough for what lies in `box`; others as they are.
SurfacePtr bounded_for(const SurfacePtr& surface, const Box& box);

}  // namespace trimloop::io::step_import
