#include "formats/step/records/geometry.h"

#include <fmt/format.h>

#include "formats/step/rules.h"

namespace trimloop::step {
namespace {

Coordinates coordinates(Reader& r, int i) {
  const std::vector<double> values = r.reals(i);
  Coordinates c;
  if (!r.ok()) return c;
  if (values.empty() || values.size() > 3) {
    r.add(rules::aggregate_bounds, fmt::format("{} coordinates instead of 1 to 3", values.size()), i);
    r.fail();
    return c;
  }
  c.count = static_cast<int>(values.size());
  for (int k = 0; k < c.count; ++k) c.xyz[static_cast<std::size_t>(k)] = values[static_cast<std::size_t>(k)];
  return c;
}

int degree_of(Reader& r, int i) {
  const std::int64_t value = r.integer(i);
  if (r.ok() && (value < 1 || value > 1000)) {
    r.add(rules::curve_sums, fmt::format("the degree is {}", value), i);
    r.fail();
    return 1;
  }
  return static_cast<int>(value);
}

}  // namespace

CartesianPoint CartesianPoint::read(Reader& r) {
  CartesianPoint p;
  if (r.at(Entity::CartesianPoint)) p.at = coordinates(r, 0);
  return p;
}

Direction Direction::read(Reader& r) {
  Direction d;
  if (r.at(Entity::Direction)) d.ratios = coordinates(r, 0);
  return d;
}

VectorRecord VectorRecord::read(Reader& r) {
  VectorRecord v;
  if (!r.at(Entity::VectorEntity)) return v;
  v.orientation = r.ref(0);
  v.magnitude = r.real(1);
  return v;
}

Placement Placement::read(Reader& r) {
  Placement p;
  if (!r.at(Entity::Placement)) return p;
  p.location = r.ref(0);
  if (r.at(Entity::Axis2Placement3d, true) && r.count() >= 2) {
    p.axis = r.optional_ref(0);
    p.reference = r.optional_ref(1);
  } else if (r.at(Entity::Axis2Placement2d, true) && r.count() == 1) {
    p.axis = p.reference = r.optional_ref(0);  // of an AXIS1_PLACEMENT the axis, of an AXIS2_PLACEMENT_2D the reference
  } else if (r.at(Entity::Axis1Placement, true) && r.count() == 1) {
    p.axis = p.reference = r.optional_ref(0);
  }
  return p;
}

TransformationOperator TransformationOperator::read(Reader& r) {
  TransformationOperator t;
  if (!r.at(Entity::CartesianTransformationOperator)) return t;
  // Some writers leave out the name and description that come down from the second supertype.
  const int shift = r.count() < 4 ? -2 : 0;
  t.axis1 = r.optional_ref(shift);
  t.axis2 = r.optional_ref(shift + 1);
  t.origin = r.ref(shift + 2);
  t.scale = r.optional_real(shift + 3).value_or(1);
  if (shift != 0) r.add(rules::attribute_count, "the operator lacks two of its attributes; the rest is read");
  if (r.at(Entity::CartesianTransformationOperator3d, true) && r.count() + shift * -1 > 0) t.axis3 = r.optional_ref(shift);
  return t;
}

LineRecord LineRecord::read(Reader& r) {
  LineRecord l;
  if (!r.at(Entity::Line)) return l;
  l.point = r.ref(0);
  l.direction = r.ref(1);
  return l;
}

ConicRecord ConicRecord::read(Reader& r) {
  ConicRecord c;
  if (!r.at(Entity::Conic)) return c;
  c.position = r.ref(0);
  // The own attributes of all four stand behind the position.
  if (!r.at(Entity::Circle)) return c;
  c.a = r.real(0);
  if (r.count() > 1) c.b = r.real(1);
  return c;
}

PolylineRecord PolylineRecord::read(Reader& r) {
  PolylineRecord p;
  if (r.at(Entity::Polyline)) p.points = r.refs(0);
  return p;
}

SplineCurve SplineCurve::read(Reader& r) {
  SplineCurve c;
  if (!r.at(Entity::BSplineCurve)) return c;
  c.degree = degree_of(r, 0);
  c.poles = r.refs(1);
  if (r.is(Entity::BSplineCurveWithKnots) && r.at(Entity::BSplineCurveWithKnots)) {
    c.multiplicities = r.integers(0);
    c.knots = r.reals(1);
  } else {
    c.form = r.is(Entity::BezierCurve) ? KnotForm::Bezier : r.is(Entity::QuasiUniformCurve) ? KnotForm::QuasiUniform : KnotForm::Uniform;
  }
  if (r.is(Entity::RationalBSplineCurve) && r.at(Entity::RationalBSplineCurve)) c.weights = r.reals(0);
  return c;
}

TrimmedCurve TrimmedCurve::read(Reader& r) {
  TrimmedCurve t;
  if (!r.at(Entity::TrimmedCurve)) return t;
  t.basis = r.ref(0);
  t.trim1 = r.selects(1);
  t.trim2 = r.selects(2);
  t.sense = r.boolean(3, true);
  t.master = r.word(4);
  return t;
}

CompositeRecord CompositeRecord::read(Reader& r) {
  CompositeRecord c;
  if (r.at(Entity::CompositeCurve)) c.segments = r.refs(0);
  return c;
}

CompositeSegment CompositeSegment::read(Reader& r) {
  CompositeSegment s;
  if (!r.at(Entity::CompositeCurveSegment)) return s;
  s.transition = r.word(0);
  s.same_sense = r.boolean(1, true);
  s.parent = r.ref(2);
  return s;
}

PcurveRecord PcurveRecord::read(Reader& r) {
  PcurveRecord p;
  if (!r.at(Entity::Pcurve)) return p;
  p.surface = r.ref(0);
  p.representation = r.ref(1);
  return p;
}

SurfaceCurve SurfaceCurve::read(Reader& r) {
  SurfaceCurve s;
  if (!r.at(Entity::SurfaceCurve)) return s;
  s.curve = r.ref(0);
  s.associated = r.refs(1);
  return s;
}

OffsetCurveRecord OffsetCurveRecord::read(Reader& r) {
  OffsetCurveRecord o;
  if (!r.at(r.is(Entity::OffsetCurve2d) ? Entity::OffsetCurve2d : Entity::OffsetCurve3d)) return o;
  o.basis = r.ref(0);
  o.distance = r.real(1);
  if (r.is(Entity::OffsetCurve3d)) o.direction = r.ref(3);
  return o;
}

Replica Replica::read(Reader& r) {
  Replica c;
  if (!r.at(Entity::CurveReplica)) return c;
  c.parent = r.ref(0);
  c.transformation = r.ref(1);
  return c;
}

ElementarySurface ElementarySurface::read(Reader& r) {
  ElementarySurface s;
  if (!r.at(Entity::ElementarySurface)) return s;
  s.position = r.ref(0);
  if (r.is(Entity::Plane)) return s;
  if (!r.at(Entity::CylindricalSurface)) return s;  // what the others declare stands at the same place
  s.a = r.real(0);
  if (r.is(Entity::ConicalSurface) || r.is(Entity::ToroidalSurface)) s.b = r.real(1);
  s.degenerate = r.is(Entity::DegenerateToroidalSurface);
  if (s.degenerate) s.select_outer = r.boolean(2, true);
  return s;
}

SweptSurface SweptSurface::read(Reader& r) {
  SweptSurface s;
  if (!r.at(Entity::SweptSurface)) return s;
  s.curve = r.ref(0);
  if (r.at(r.is(Entity::SurfaceOfRevolution) ? Entity::SurfaceOfRevolution : Entity::SurfaceOfLinearExtrusion)) s.axis = r.ref(0);
  return s;
}

SplineSurface SplineSurface::read(Reader& r) {
  SplineSurface s;
  if (!r.at(Entity::BSplineSurface)) return s;
  s.degree_u = degree_of(r, 0);
  s.degree_v = degree_of(r, 1);
  s.poles = r.ref_rows(2);
  if (r.is(Entity::BSplineSurfaceWithKnots) && r.at(Entity::BSplineSurfaceWithKnots)) {
    s.multiplicities_u = r.integers(0);
    s.multiplicities_v = r.integers(1);
    s.knots_u = r.reals(2);
    s.knots_v = r.reals(3);
  } else {
    s.form = r.is(Entity::BezierSurface)         ? KnotForm::Bezier
             : r.is(Entity::QuasiUniformSurface) ? KnotForm::QuasiUniform
                                                 : KnotForm::Uniform;
  }
  if (r.is(Entity::RationalBSplineSurface) && r.at(Entity::RationalBSplineSurface)) s.weights = r.real_rows(0);
  return s;
}

RectangularTrimmed RectangularTrimmed::read(Reader& r) {
  RectangularTrimmed t;
  if (!r.at(Entity::RectangularTrimmedSurface)) return t;
  t.basis = r.ref(0);
  t.u1 = r.real(1);
  t.u2 = r.real(2);
  t.v1 = r.real(3);
  t.v2 = r.real(4);
  t.u_sense = r.boolean(5, true);
  t.v_sense = r.boolean(6, true);
  return t;
}

CurveBounded CurveBounded::read(Reader& r) {
  CurveBounded c;
  if (!r.at(Entity::CurveBoundedSurface)) return c;
  c.basis = r.ref(0);
  c.boundaries = r.refs(1);
  c.implicit_outer = r.boolean(2, false);
  return c;
}

OffsetSurfaceRecord OffsetSurfaceRecord::read(Reader& r) {
  OffsetSurfaceRecord o;
  if (!r.at(Entity::OffsetSurface)) return o;
  o.basis = r.ref(0);
  o.distance = r.real(1);
  return o;
}

CompositeSurface CompositeSurface::read(Reader& r) {
  CompositeSurface s;
  if (r.at(Entity::RectangularCompositeSurface)) s.patches = r.ref_rows(0);
  return s;
}

SurfacePatch SurfacePatch::read(Reader& r) {
  SurfacePatch p;
  if (r.at(Entity::SurfacePatch)) p.parent = r.ref(0);
  return p;
}

}  // namespace trimloop::step
