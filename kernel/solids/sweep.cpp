#include "kernel/solids/sweep.h"

#include <algorithm>

#include "kernel/check/measure.h"
#include "kernel/heal/make_face.h"

namespace trimloop {
namespace {

CurvePtr share(Curve c) { return std::make_shared<const Curve>(std::move(c)); }
SurfacePtr share(Surface s) { return std::make_shared<const Surface>(std::move(s)); }

Curve straight(Point a, Point b) { return {Line{a, b, {0, 1}}}; }

// The curve in the coordinates of the plane; exact, because the map is a rotation and a shift.
Curve2 in_plane(const Curve& curve, const Frame& f) {
  const Vector o = to_vector(f.origin);
  Transform t;
  t.r = {{{f.x.x, f.x.y, f.x.z}, {f.y.x, f.y.y, f.y.z}, {0, 0, 0}}};
  t.t = {-dot(f.x, o), -dot(f.y, o), 0};
  Transform rigid = t;
  rigid.r[2] = {f.z.x, f.z.y, f.z.z};
  rigid.t.z = -dot(f.z, o);
  auto flat = transformed(curve, rigid);
  return {flat ? std::move(*flat) : curve};
}

// Twice the area that the profile encloses, as a vector along its normal; sampled where curves are curved. Used for
// signs and directions only.
Vector area_vector(const Profile& profile) {
  constexpr int steps = 32;
  Vector sum;
  const Point base = start_point(profile.front());
  for (const Curve& c : profile) {
    const Interval r = range(c);
    Point last = evaluate(c, r.lo);
    for (int i = 1; i <= steps; ++i) {
      const Point p = evaluate(c, r.at(static_cast<double>(i) / steps));
      sum += cross(last - base, p - base);
      last = p;
    }
  }
  return sum;
}

double off_plane(const Profile& profile, Point origin, Vector normal) {
  double worst = 0;
  for (const Curve& c : profile)
    for (int i = 0; i <= 8; ++i) worst = std::max(worst, std::abs(dot(evaluate(c, range(c).at(i / 8.0)) - origin, normal)));
  return worst;
}

void reverse(Profile& profile) {
  std::reverse(profile.begin(), profile.end());
  for (Curve& c : profile) c = reversed(c);
}

// ---- Faces

heal::TrimSegment use(EdgeId edge, bool reversed, std::optional<Curve2> pcurve = {}) {
  heal::TrimSegment s;
  s.edge = edge;
  s.curve_reversed = s.pcurve_reversed = reversed;
  s.pcurve = std::move(pcurve);
  return s;
}

EdgeId add_edge(Body& body, Curve curve, VertexId start, VertexId end) {
  Edge edge;
  edge.range = range(curve);
  edge.curve = share(std::move(curve));
  edge.start = start;
  edge.end = end;
  body[start].gap_mm = std::max(body[start].gap_mm, distance(body[start].point, start_point(*edge.curve)));
  body[end].gap_mm = std::max(body[end].gap_mm, distance(body[end].point, end_point(*edge.curve)));
  return body.add(std::move(edge));
}

class Builder {
 public:
  explicit Builder(double tolerance_mm) : tolerance_(tolerance_mm) { body.kind = BodyKind::Solid; }

  // `outward`: about where the outside lies, at some point of the face. Loops run counter-clockwise seen from outside.
  void face(SurfacePtr surface, std::vector<heal::TrimLoop> loops, Point at, Vector outward) {
    heal::FaceInput input;
    const SurfaceFoot foot = closest_point(*surface, at, bounded(domain(*surface).u), bounded(domain(*surface).v));
    input.reversed = dot(normal(*surface, foot.uv), outward) < 0;
    input.surface = std::move(surface);
    input.loops = std::move(loops);
    for (heal::TrimLoop& loop : input.loops) {
      loop.trust = heal::Trust::Model;
      if (input.reversed) heal::turn(loop);
    }
    if (!input.loops.empty()) input.loops.front().claimed_outer = true;
    input.brep_sense = true;
    input.tolerance_mm = tolerance_;
    const heal::FaceOutcome outcome = heal::add_face(body, input);
    if (body[outcome.face].status == FaceStatus::Failed && problem_.empty()) problem_ = body[outcome.face].reason;
    shell_.faces.push_back({outcome.face, false});
  }

  Result<Body> finish() {
    const ShellId shell = body.add(std::move(shell_));
    heal::finish_shell(body, shell);
    if (!problem_.empty()) return fail(ErrorCode::Degenerate, problem_);
    if (!body[shell].closed) return fail(ErrorCode::Degenerate, "the faces of the solid do not close");
    return std::move(body);
  }

  Body body;

 private:
  static Interval bounded(Interval r) {
    constexpr double far = 1e6;
    return {std::max(r.lo, -far), std::min(r.hi, far)};
  }
  double tolerance_;
  Shell shell_;
  std::string problem_;
};

heal::TrimLoop loop_of(std::vector<heal::TrimSegment> segments) {
  heal::TrimLoop loop;
  loop.segments = std::move(segments);
  return loop;
}

// ---- Surfaces that a profile piece sweeps

Surface extruded(const Curve& c, Vector direction) {
  const Vector d = normalized(direction);
  constexpr double parallel = 1e-12;
  if (const auto* line = std::get_if<Line>(&c.shape))
    return {Plane{make_frame(line->start, cross(line->end - line->start, direction), line->end - line->start)}};
  if (const auto* circle = std::get_if<Circle>(&c.shape); circle && norm(cross(circle->frame.z, d)) < parallel) {
    Frame f = circle->frame;
    if (dot(f.z, d) < 0) f = Frame{f.origin, f.x, -f.y, -f.z};
    return {Cylinder{f, circle->radius}};
  }
  return {Extrusion{share(c), direction, {0, 1}}};
}

// Distance from the axis and height along it.
Uv around(const Axis& axis, Point p) {
  const Vector v = p - axis.origin;
  const double h = dot(v, axis.direction);
  return {norm(v - h * axis.direction), h};
}

Surface revolved(const Curve& c, const Axis& axis, Vector in_plane_x, Interval turn) {
  const Vector z = axis.direction;
  const auto frame_at = [&](double height) { return make_frame(axis.origin + height * z, z, in_plane_x); };
  if (const auto* line = std::get_if<Line>(&c.shape)) {
    const Uv a = around(axis, line->start), b = around(axis, line->end);
    const double scale = std::abs(a.u) + std::abs(b.u) + std::abs(a.v - b.v);
    constexpr double straight_up = 1e-14;
    if (std::abs(a.v - b.v) <= straight_up * scale) return {Plane{frame_at(a.v)}};
    if (std::abs(a.u - b.u) <= straight_up * scale) return {Cylinder{frame_at(a.v), a.u}};
    const double slope = (b.u - a.u) / (b.v - a.v);
    return {Cone{frame_at(a.v), a.u, std::atan(slope)}};
  }
  if (const auto* circle = std::get_if<Circle>(&c.shape)) {
    const Uv centre = around(axis, circle->frame.origin);
    if (centre.u <= 1e-14 * circle->radius) return {Sphere{frame_at(centre.v), circle->radius}};
    if (centre.u > circle->radius) return {Torus{frame_at(centre.v), centre.u, circle->radius}};
  }
  return {Revolution{axis.origin, z, share(c), turn}};
}

}  // namespace

double largest_gap(const Profile& profile, bool open) {
  double worst = 0;
  for (std::size_t i = 0; i + (open ? 1 : 0) < profile.size(); ++i)
    worst = std::max(worst, distance(end_point(profile[i]), start_point(profile[(i + 1) % profile.size()])));
  return worst;
}

Box bounding_box(const Profile& profile) {
  Box box;
  for (const Curve& c : profile) box.add(bounding_box(c));
  return box;
}

Profile pieces_of(const Curve& curve) {
  Profile out;
  if (const auto* composite = std::get_if<CompositeCurve>(&curve.shape)) {
    for (const CompositeCurve::Segment& s : composite->segments)
      for (Curve& piece : pieces_of(s.reversed ? reversed(*s.curve) : *s.curve)) out.push_back(std::move(piece));
  } else if (const auto* line = std::get_if<Polyline>(&curve.shape)) {
    for (std::size_t i = 1; i < line->points.size(); ++i)
      if (distance(line->points[i - 1], line->points[i]) > 0) out.push_back(straight(line->points[i - 1], line->points[i]));
  } else {
    out.push_back(curve);
  }
  return out;
}

Result<Body> extrude(const Profile& given, Vector direction, double tolerance_mm) {
  if (given.empty()) return fail(ErrorCode::Degenerate, "the profile has no curve");
  Profile profile = given;
  if (const double gap = largest_gap(profile); !(gap <= tolerance_mm))
    return fail(ErrorCode::Degenerate, "the profile is not closed", gap, tolerance_mm);
  const Vector area = area_vector(profile);
  Vector n = normalized(area);
  if (norm(n) == 0) return fail(ErrorCode::Degenerate, "the profile encloses nothing");
  const Point base = start_point(profile.front());
  if (const double off = off_plane(profile, base, n); !(off <= tolerance_mm))
    return fail(ErrorCode::Degenerate, "the profile does not lie in a plane", off, tolerance_mm);
  constexpr double flat = 1e-9;
  if (!(std::abs(dot(normalized(direction), n)) > flat))
    return fail(ErrorCode::Degenerate, "the direction of extrusion lies in the profile's plane");
  if (dot(n, direction) < 0) {  // counter-clockwise about the direction of extrusion
    reverse(profile);
    n = -n;
  }

  Builder builder(tolerance_mm);
  Body& body = builder.body;
  const std::size_t count = profile.size();
  const Transform up = Transform::translation(direction);
  std::vector<VertexId> low(count), high(count);
  for (std::size_t i = 0; i < count; ++i) {
    low[i] = body.add(Vertex{start_point(profile[i]), 0});
    high[i] = body.add(Vertex{apply(up, start_point(profile[i])), 0});
  }
  std::vector<EdgeId> bottom(count), top(count), side(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = (i + 1) % count;
    bottom[i] = add_edge(body, profile[i], low[i], low[next]);
    auto raised = transformed(profile[i], up);
    if (!raised) return tl::unexpected<Error>(raised.error());
    top[i] = add_edge(body, std::move(*raised), high[i], high[next]);
    if (count > 1) side[i] = add_edge(body, straight(body[low[i]].point, body[high[i]].point), low[i], high[i]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = (i + 1) % count;
    const Interval r = range(profile[i]);
    const CurveJet middle = jet(profile[i], r.mid());
    std::vector<heal::TrimLoop> loops;
    if (count > 1) {
      loops.push_back(loop_of({use(bottom[i], false), use(side[next], false), use(top[i], true), use(side[i], true)}));
    } else {
      loops.push_back(loop_of({use(bottom[i], false)}));
      loops.push_back(loop_of({use(top[i], true)}));
    }
    builder.face(share(extruded(profile[i], direction)), std::move(loops), middle.point + 0.5 * direction,
                 cross(middle.d1, direction));
  }
  for (const bool is_top : {false, true}) {
    Frame f = make_frame(is_top ? apply(up, base) : base, n, profile.size() > 1 ? end_point(profile[0]) - base : Vector{});
    std::vector<heal::TrimSegment> segments;
    for (std::size_t i = 0; i < count; ++i) {
      const EdgeId edge = is_top ? top[i] : bottom[count - 1 - i];
      segments.push_back(use(edge, !is_top, in_plane(*body[edge].curve, f)));
    }
    builder.face(share(Surface{Plane{f}}), {loop_of(std::move(segments))}, f.origin, is_top ? n : -n);
  }
  return builder.finish();
}

namespace {

// A piece of the profile, its edge in the plane of the start (and of the end, where the turn is not whole), and the
// circles that its ends run along.
struct Station {
  VertexId first, last;  // of the piece's start; the same where the turn is whole
  EdgeId circle;         // none on the axis
};

}  // namespace

Result<Body> revolve(Profile profile, const Axis& given, double angle_rad, bool close_on_axis, double tolerance_mm) {
  if (profile.empty()) return fail(ErrorCode::Degenerate, "the profile has no curve");
  Axis axis{given.origin, normalized(given.direction)};
  constexpr double whole = 1e-12;
  if (!(angle_rad > 0) || angle_rad > two_pi * (1 + whole) || norm(axis.direction) == 0)
    return fail(ErrorCode::InvalidArgument, "a turn is above 0 and at most a whole one", angle_rad, two_pi);
  const bool full = angle_rad > two_pi * (1 - whole);

  // The half plane of the profile: where it is farthest from the axis.
  Point far = start_point(profile.front());
  double extent = 0;
  for (const Curve& c : profile)
    for (int i = 0; i <= 16; ++i) {
      const Point p = evaluate(c, range(c).at(i / 16.0));
      if (around(axis, p).u > around(axis, far).u) far = p;
      extent = std::max(extent, distance(p, axis.origin));
    }
  const Vector x = normalized(far - axis.origin - dot(far - axis.origin, axis.direction) * axis.direction);
  if (norm(x) == 0) return fail(ErrorCode::Degenerate, "the profile lies on the axis");
  const Vector n = cross(axis.direction, x);  // the way it is turned
  if (const double off = off_plane(profile, axis.origin, n); !(off <= tolerance_mm))
    return fail(ErrorCode::Degenerate, "the profile does not lie in a plane with the axis", off, tolerance_mm);
  for (const Curve& c : profile)
    for (int i = 0; i <= 16; ++i)
      if (const double side = dot(evaluate(c, range(c).at(i / 16.0)) - axis.origin, x); side < -tolerance_mm)
        return fail(ErrorCode::Degenerate, "the profile crosses the axis", -side, tolerance_mm);

  // 1. Close an open profile.
  const Point first = start_point(profile.front()), last = end_point(profile.back());
  const auto foot = [&](Point p) { return axis.origin + dot(p - axis.origin, axis.direction) * axis.direction; };
  if (distance(first, last) > tolerance_mm) {
    const auto add = [&](Point a, Point b) {
      if (distance(a, b) > tolerance_mm) profile.push_back(straight(a, b));
    };
    if (close_on_axis) {
      add(last, foot(last));
      add(foot(last), foot(first));
      add(foot(first), first);
    } else {
      add(last, first);
    }
  }
  const Vector area = area_vector(profile);
  if (!(std::abs(dot(area, n)) > 0)) return fail(ErrorCode::Degenerate, "the profile encloses nothing");
  if (dot(area, n) < 0) reverse(profile);  // counter-clockwise about the way it is turned: outside is on its right

  // 2. Vertices, profile edges at both ends of the turn, circles.
  Builder builder(tolerance_mm);
  Body& body = builder.body;
  const std::size_t count = profile.size();
  const Transform turn = Transform::rotation(axis.origin, axis.direction, angle_rad);
  std::vector<Station> stations(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Point p = start_point(profile[i]);
    Station& s = stations[i];
    const double radius = dot(p - axis.origin, x);
    const bool on_axis = radius <= tolerance_mm;
    s.first = s.last = body.add(Vertex{on_axis ? foot(p) : p, 0});
    if (on_axis) continue;
    if (!full) s.last = body.add(Vertex{apply(turn, p), 0});
    if (count > 1 || !full) {
      const Frame f = make_frame(foot(p), axis.direction, x);
      s.circle = add_edge(body, Curve{Circle{f, radius, {0, full ? two_pi : angle_rad}}}, s.first, s.last);
    }
  }
  const auto on_axis = [&](std::size_t i) { return dot(body[stations[i].first].point - axis.origin, x) <= tolerance_mm; };
  const auto along_axis = [&](std::size_t i) {
    return on_axis(i) && on_axis((i + 1) % count) && std::holds_alternative<Line>(profile[i].shape);
  };
  std::vector<EdgeId> at_start(count), at_end(count);
  for (std::size_t i = 0; i < count && !full; ++i) {
    const Station &a = stations[i], &b = stations[(i + 1) % count];
    at_start[i] = add_edge(body, profile[i], a.first, b.first);
    if (along_axis(i)) {
      at_end[i] = at_start[i];  // one edge of both caps
      continue;
    }
    auto turned = transformed(profile[i], turn);
    if (!turned) return tl::unexpected<Error>(turned.error());
    at_end[i] = add_edge(body, std::move(*turned), a.last, b.last);
  }

  // 3. Faces: one for each piece off the axis, and the two caps of a part of a turn.
  const Transform half = Transform::rotation(axis.origin, axis.direction, angle_rad / 2);
  for (std::size_t i = 0; i < count; ++i) {
    if (along_axis(i)) continue;
    const Station &a = stations[i], &b = stations[(i + 1) % count];
    const CurveJet middle = jet(profile[i], range(profile[i]).mid());
    const Vector outward = cross(middle.d1, n);  // to the right of the profile
    const Surface surface = revolved(profile[i], axis, x, {0, full ? two_pi : angle_rad});
    std::vector<heal::TrimLoop> loops;
    if (full) {
      if (a.circle) loops.push_back(loop_of({use(a.circle, true)}));
      if (b.circle && count > 1) loops.push_back(loop_of({use(b.circle, false)}));
      if (count == 1) loops.clear();
    } else {
      std::vector<heal::TrimSegment> border{use(at_start[i], false)};
      if (b.circle) border.push_back(use(b.circle, false));
      border.push_back(use(at_end[i], true));
      if (a.circle) border.push_back(use(a.circle, true));
      loops.push_back(loop_of(std::move(border)));
    }
    builder.face(share(surface), std::move(loops), apply(half, middle.point), apply(half, outward));
  }
  for (const bool is_end : {false, true}) {
    if (full) break;
    const Frame f = is_end ? make_frame(axis.origin, apply(turn, n), apply(turn, x)) : make_frame(axis.origin, n, x);
    std::vector<heal::TrimSegment> segments;
    for (std::size_t i = 0; i < count; ++i) {
      const EdgeId edge = is_end ? at_end[i] : at_start[count - 1 - i];
      segments.push_back(use(edge, !is_end, in_plane(*body[edge].curve, f)));
    }
    builder.face(share(Surface{Plane{f}}), {loop_of(std::move(segments))}, far, is_end ? f.z : -f.z);
  }
  return builder.finish();
}

Result<Body> solid_of(SurfacePtr surface, double tolerance_mm) {
  Builder builder(tolerance_mm);
  const SurfaceDomain d = domain(*surface, tolerance_mm);
  if (!d.is_bounded()) return fail(ErrorCode::Degenerate, "the surface has no end");
  // Away from the middle of all its points is outside.
  const Point at = evaluate(*surface, {d.u.mid(), d.v.mid()});
  builder.face(surface, {}, at, normal(*surface, {d.u.mid(), d.v.mid()}));
  auto body = builder.finish();
  if (!body) return body;
  const auto enclosed = volume(*body, ShellId{0});
  if (enclosed && enclosed->value < 0) body->faces.front().reversed = !body->faces.front().reversed;
  return body;
}

}  // namespace trimloop
