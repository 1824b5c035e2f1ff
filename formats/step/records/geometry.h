#pragma once
// Records of points, curves and surfaces (ISO 10303-42 4): numbers as the file has them, in its units.

#include <array>

#include "formats/step/records/reader.h"

namespace trimloop::step {

struct Coordinates {  // of a CARTESIAN_POINT or the ratios of a DIRECTION
  std::array<double, 3> xyz{};
  int count = 0;      // 1 to 3
};

struct CartesianPoint {
  static constexpr Entity type = Entity::CartesianPoint;
  Coordinates at;
  static CartesianPoint read(Reader&);
};
struct Direction {
  static constexpr Entity type = Entity::Direction;
  Coordinates ratios;
  static Direction read(Reader&);
};
struct VectorRecord {
  static constexpr Entity type = Entity::VectorEntity;
  Ref orientation;
  double magnitude = 1;
  static VectorRecord read(Reader&);
};
struct Placement {  // AXIS1_PLACEMENT, AXIS2_PLACEMENT_2D, AXIS2_PLACEMENT_3D
  static constexpr Entity type = Entity::Placement;
  Ref location, axis, reference;
  static Placement read(Reader&);
};
struct TransformationOperator {  // CARTESIAN_TRANSFORMATION_OPERATOR_3D
  static constexpr Entity type = Entity::CartesianTransformationOperator;
  Ref axis1, axis2, axis3, origin;
  double scale = 1;
  static TransformationOperator read(Reader&);
};

// ---- Curves

struct LineRecord {
  static constexpr Entity type = Entity::Line;
  Ref point, direction;
  static LineRecord read(Reader&);
};
struct ConicRecord {  // CIRCLE: a; ELLIPSE, HYPERBOLA: a, b; PARABOLA: a = focal distance
  static constexpr Entity type = Entity::Conic;
  Ref position;
  double a = 0, b = 0;
  static ConicRecord read(Reader&);
};
struct PolylineRecord {
  static constexpr Entity type = Entity::Polyline;
  std::vector<Ref> points;
  static PolylineRecord read(Reader&);
};
enum class KnotForm : std::uint8_t { Explicit, Uniform, QuasiUniform, Bezier };
struct SplineCurve {  // B_SPLINE_CURVE and its subtypes, simple or complex
  static constexpr Entity type = Entity::BSplineCurve;
  int degree = 1;
  std::vector<Ref> poles;
  std::vector<double> weights;  // empty: all one
  KnotForm form = KnotForm::Explicit;
  std::vector<int> multiplicities;
  std::vector<double> knots;
  static SplineCurve read(Reader&);
};
struct TrimmedCurve {
  static constexpr Entity type = Entity::TrimmedCurve;
  Ref basis;
  std::vector<Select> trim1, trim2;  // a point, a parameter, or both
  bool sense = true;
  std::string master;                // CARTESIAN, PARAMETER, UNSPECIFIED
  static TrimmedCurve read(Reader&);
};
struct CompositeRecord {
  static constexpr Entity type = Entity::CompositeCurve;
  std::vector<Ref> segments;
  static CompositeRecord read(Reader&);
};
struct CompositeSegment {
  static constexpr Entity type = Entity::CompositeCurveSegment;
  std::string transition;
  bool same_sense = true;
  Ref parent;
  static CompositeSegment read(Reader&);
};
struct PcurveRecord {
  static constexpr Entity type = Entity::Pcurve;
  Ref surface, representation;       // a DEFINITIONAL_REPRESENTATION of one curve
  static PcurveRecord read(Reader&);
};
struct SurfaceCurve {  // and SEAM_CURVE, INTERSECTION_CURVE
  static constexpr Entity type = Entity::SurfaceCurve;
  Ref curve;
  std::vector<Ref> associated;       // pcurves or surfaces
  static SurfaceCurve read(Reader&);
};
struct OffsetCurveRecord {
  static constexpr Entity type = Entity::OffsetCurve3d;
  Ref basis, direction;              // direction: 3D only
  double distance = 0;
  static OffsetCurveRecord read(Reader&);
};
struct Replica {  // CURVE_REPLICA, SURFACE_REPLICA, SOLID_REPLICA
  static constexpr Entity type = Entity::CurveReplica;
  Ref parent, transformation;
  static Replica read(Reader&);
};

// ---- Surfaces

struct ElementarySurface {  // CYLINDRICAL, SPHERICAL: a; CONICAL: a, angle in b; TOROIDAL: a, b
  static constexpr Entity type = Entity::ElementarySurface;
  Ref position;
  double a = 0, b = 0;
  bool degenerate = false, select_outer = true;
  static ElementarySurface read(Reader&);
};
struct SweptSurface {
  static constexpr Entity type = Entity::SweptSurface;
  Ref curve, axis;                   // axis: a VECTOR or an AXIS1_PLACEMENT
  static SweptSurface read(Reader&);
};
struct SplineSurface {
  static constexpr Entity type = Entity::BSplineSurface;
  int degree_u = 1, degree_v = 1;
  std::vector<std::vector<Ref>> poles;             // [u][v]
  std::vector<std::vector<double>> weights;        // empty: all one
  KnotForm form = KnotForm::Explicit;
  std::vector<int> multiplicities_u, multiplicities_v;
  std::vector<double> knots_u, knots_v;
  static SplineSurface read(Reader&);
};
struct RectangularTrimmed {
  static constexpr Entity type = Entity::RectangularTrimmedSurface;
  Ref basis;
  double u1 = 0, u2 = 1, v1 = 0, v2 = 1;
  bool u_sense = true, v_sense = true;
  static RectangularTrimmed read(Reader&);
};
struct CurveBounded {
  static constexpr Entity type = Entity::CurveBoundedSurface;
  Ref basis;
  std::vector<Ref> boundaries;
  bool implicit_outer = false;
  static CurveBounded read(Reader&);
};
struct OffsetSurfaceRecord {
  static constexpr Entity type = Entity::OffsetSurface;
  Ref basis;
  double distance = 0;
  static OffsetSurfaceRecord read(Reader&);
};
struct CompositeSurface {
  static constexpr Entity type = Entity::RectangularCompositeSurface;
  std::vector<std::vector<Ref>> patches;           // SURFACE_PATCH
  static CompositeSurface read(Reader&);
};
struct SurfacePatch {
  static constexpr Entity type = Entity::SurfacePatch;
  Ref parent;
  static SurfacePatch read(Reader&);
};

}  // namespace trimloop::step
