// From one curve, the chine. Seen from a point far out to the side its shadow on the centre plane is the keel; seen from
// a point below its shadow on the deck is the sheer. Rays between a curve and its shadow all pass through one point, so
// that the strips between them are cones: developable exactly, and rational because a perspective is a projective map.

#include "samples/hull.h"

namespace samples {

using namespace trimloop;

namespace {

NurbsCurve shadow(const NurbsCurve& curve, Point eye, Point on_plane, Vector normal) {
  const NurbsCurve cast = *transformed(curve, *perspective(eye, on_plane, normal));
  std::vector<Hpoint> poles = cast.poles();
  const double weight = poles[0].w;  // brought to one, so that the rulings are run through evenly
  for (Hpoint& h : poles) h = 1 / weight * h;
  return *NurbsCurve::from_homogeneous(cast.degree(), cast.knots(), std::move(poles));
}

NurbsCurve mirrored(const NurbsCurve& c) {
  Transform across;
  across.r[1][1] = -1;
  return transformed(c, across);
}

heal::FaceInput strip(const NurbsCurve& lower, const NurbsCurve& upper) {
  heal::FaceInput face;
  face.surface = std::make_shared<const Surface>(Surface{*ruled(lower, upper)});
  return face;
}

heal::TrimSegment along(Curve curve, bool reversed = false) {
  heal::TrimSegment segment;
  segment.curve = std::make_shared<const Curve>(std::move(curve));
  segment.curve_reversed = reversed;
  return segment;
}

heal::FaceInput plane(Point origin, Vector normal, std::vector<heal::TrimSegment> border) {
  heal::FaceInput face;
  face.surface = std::make_shared<const Surface>(Surface{Plane{make_frame(origin, normal)}});
  heal::TrimLoop loop;
  loop.segments = std::move(border);
  face.loops.push_back(std::move(loop));
  return face;
}

}  // namespace

Model hull() {
  // From the transom (x = 0) to the stem, where both sides meet in the centre plane.
  const NurbsCurve chine = *NurbsCurve::from_cartesian(
      3, {0, 0, 0, 0, 0.5, 1, 1, 1, 1}, std::vector<Point>{{0, 8, 2.6}, {24, 9, 2.4}, {52, 9, 2.8}, {78, 5, 4.2}, {92, 0, 6.5}}, {});
  const Point beside{0, 70, 24}, below{0, 0, -40}, deck_middle{0, 0, 10};
  const Vector up{-0.035, 0, 1};
  const NurbsCurve keel = shadow(chine, beside, {}, {0, 1, 0}), sheer = shadow(chine, below, deck_middle, up);

  Body body;
  for (const bool port : {true, false}) {
    const auto side = [port](const NurbsCurve& c) { return port ? c : mirrored(c); };
    heal::add_face(body, strip(side(keel), side(chine)));
    heal::add_face(body, strip(side(chine), side(sheer)));
  }
  const auto start = [](const NurbsCurve& c) { return start_point(Curve{c}); };
  const Point k = start(keel), c1 = start(chine), s1 = start(sheer), c2 = start(mirrored(chine)), s2 = start(mirrored(sheer));
  heal::add_face(body, plane({}, {-1, 0, 0}, {along({Line{k, c1}}), along({Line{c1, s1}}), along({Line{s1, s2}}), along({Line{s2, c2}}), along({Line{c2, k}})}));
  heal::add_face(body, plane(deck_middle, up, {along({sheer}), along({mirrored(sheer)}, true), along({Line{s2, s1}})}));

  Model model;
  model.name = "hull";
  model.parts.emplace_back();
  Attributes paint;
  paint.name = "hull";
  paint.colour = Colour{0.35, 0.4, 0.5};
  body.attributes = model.add(paint);
  heal::SewOptions how;
  how.tolerance_mm = 1e-6;
  for (Body& sewn : heal::sew({std::move(body)}, how).bodies) model.parts[0].bodies.push_back(std::move(sewn));
  return model;
}

}  // namespace samples
