#include "kernel/splines/biarc.h"

#include <fmt/format.h>

#include "kernel/bounds/bounds.h"

namespace trimloop {

namespace {

// The arc that leaves `from` in the unit direction `along` and reaches `to`; a segment when it does so straight ahead.
Curve arc_to(Point from, Vector along, Point to) {
  const Vector chord = to - from;
  const double ahead = dot(chord, along);
  const Vector aside = chord - ahead * along;
  const double width = norm(aside), length = norm(chord);
  if (width <= 1e-14 * length && ahead > 0) return {Line{from, to}};
  const Vector inward = width > 0 ? aside / width : make_frame(from, along).x;
  const double radius = width > 0 ? length * length / (2 * width) : length / 2;
  Circle circle;
  circle.frame = {from + radius * inward, -inward, along, cross(-inward, along)};
  circle.radius = radius;
  circle.range = {0, 2 * std::atan2(width, ahead)};
  return {circle};
}

Vector end_direction(const Curve& arc) { return normalized(jet(arc, range(arc).hi).d1); }

double parameter_on(const Curve& arc, Point p) {
  if (const auto* line = std::get_if<Line>(&arc.shape)) {
    const Vector along = line->end - line->start;
    return std::clamp(dot(p - line->start, along) / dot(along, along), 0.0, 1.0);
  }
  const auto& circle = std::get<Circle>(arc.shape);
  const Vector d = p - circle.frame.origin;
  double angle = std::atan2(dot(d, circle.frame.y), dot(d, circle.frame.x));
  if (angle < -0.5 * (two_pi - circle.range.hi)) angle += two_pi;
  return circle.range.clamp(angle);
}

// The curve over `part` against the arc: nodes matched by projection, ends with ends, and between nodes what the second
// derivatives of both leave room for.
double distance_bound(const NurbsCurve& curve, Interval part, const Curve& arc, double tolerance) {
  const CurvePieces piece(trimmed(curve, part));
  double bend = 0;
  for (std::size_t i = 0; i < piece.size(); ++i) bend = std::max(bend, derivative_bounds(piece, i).second);
  const auto* circle = std::get_if<Circle>(&arc.shape);
  const double radius = circle ? circle->radius : 0, turn = range(arc).length();
  const double room = (bend * part.length() * part.length() + radius * turn * turn) / 8;
  if (!std::isfinite(room)) return infinity;
  const int nodes = std::clamp(static_cast<int>(std::ceil(std::sqrt(room / (0.1 * tolerance)))), 4, 512);
  double worst = 0, between = 0, before = range(arc).lo;
  const double step = part.length() / nodes;
  for (int k = 0; k <= nodes; ++k) {
    const Point p = evaluate(curve, part.at(static_cast<double>(k) / nodes));
    const double s = k == 0 ? range(arc).lo : k == nodes ? range(arc).hi : parameter_on(arc, p);
    worst = std::max(worst, distance(p, evaluate(arc, s)));
    between = std::max(between, (bend * step * step + radius * (s - before) * (s - before)) / 8);
    before = s;
  }
  return worst + between;
}

// Where the curve passes the plane through `at` across `along`; the middle when it does not do so once.
double crossing(const NurbsCurve& curve, Interval part, Point at, Vector along) {
  const auto side = [&](double t) { return dot(evaluate(curve, t) - at, along); };
  double lo = part.lo, hi = part.hi;
  if (!(side(lo) < 0 && side(hi) > 0)) return part.mid();
  for (int i = 0; i < 60 && lo < hi; ++i) {
    const double mid = 0.5 * (lo + hi);
    (side(mid) < 0 ? lo : hi) = mid;
  }
  return 0.5 * (lo + hi);
}

Curve chain_of(std::vector<Curve> arcs) {
  std::vector<CompositeCurve::Segment> segments;
  for (Curve& c : arcs) segments.push_back({std::make_shared<const Curve>(std::move(c)), false});
  return {make_composite(std::move(segments))};
}

// Direction at b of the circle through a, b, c; of the line when they are in line; none when it turns straight back.
Vector circle_direction(Point a, Point b, Point c) {
  const Vector in = b - a, out = c - b;
  if (dot(in, out) < 0 && norm(cross(in, out)) <= 1e-14 * norm(in) * norm(out)) return {};
  return normalized((dot(out, out) * in + dot(in, in) * out));
}

// The same circle's direction at its first point: the direction at the middle one mirrored across the chord.
Vector mirrored(Vector direction, Vector chord) {
  const Vector unit = normalized(chord);
  return 2 * dot(direction, unit) * unit - direction;
}

}  // namespace

Result<std::vector<Curve>> biarc(Point a, Vector ta, Point b, Vector tb) {
  ta = normalized(ta);
  tb = normalized(tb);
  const Vector v = b - a;
  if (!(norm(v) > 0) || !is_finite(v)) return fail(ErrorCode::InvalidArgument, "the ends of the biarc coincide", norm(v), 0);
  if (norm(ta) == 0 || norm(tb) == 0) return fail(ErrorCode::InvalidArgument, "a direction of the biarc has no length", 0, 0);
  // |v - d (ta + tb)| = 2 d.
  const double along = dot(v, ta + tb), spread = 2 * (1 - dot(ta, tb)), square = dot(v, v);
  double d = 0;
  if (spread > 1e-14) d = (-along + std::sqrt(along * along + spread * square)) / spread;
  else if (along > 0) d = square / (2 * along);
  else d = 0.5 * norm(v);  // straight back: two half circles
  if (spread <= 1e-14 && along <= 0) {
    const Point middle = midpoint(a, b);
    return std::vector<Curve>{arc_to(a, ta, middle), arc_to(middle, end_direction(arc_to(a, ta, middle)), b)};
  }
  const Point joint = midpoint(a + d * ta, b - d * tb);
  Curve first = arc_to(a, ta, joint);
  // The second arc seen from its other end, so that both ends keep their directions.
  Curve second = reversed(arc_to(b, -tb, joint));
  return std::vector<Curve>{std::move(first), std::move(second)};
}

Result<Curve> biarcs_through(std::span<const Point> points) {
  const std::size_t n = points.size();
  if (n < 2) return fail(ErrorCode::InvalidArgument, fmt::format("{} points, at least 2 are needed", n), static_cast<double>(n), 2);
  for (std::size_t i = 0; i + 1 < n; ++i)
    if (!(distance(points[i], points[i + 1]) > 0)) return fail(ErrorCode::InvalidArgument, fmt::format("points {} and {} coincide", i, i + 1), 0, 0);
  if (n == 2) return Curve{Line{points[0], points[1]}};
  std::vector<Vector> direction(n);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    direction[i] = circle_direction(points[i - 1], points[i], points[i + 1]);
    if (norm(direction[i]) == 0) return fail(ErrorCode::Degenerate, fmt::format("the chain turns straight back at point {}", i), 0, 0);
  }
  direction[0] = mirrored(direction[1], points[1] - points[0]);
  direction[n - 1] = mirrored(direction[n - 2], points[n - 1] - points[n - 2]);
  std::vector<Curve> arcs;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    auto two = biarc(points[i], direction[i], points[i + 1], direction[i + 1]);
    if (!two) return tl::unexpected(two.error());
    for (Curve& c : *two) arcs.push_back(std::move(c));
  }
  return chain_of(std::move(arcs));
}

Result<BiarcChain> biarcs_along(const NurbsCurve& curve, double tolerance_mm, std::size_t most_arcs) {
  if (!(tolerance_mm > 0)) return fail(ErrorCode::InvalidArgument, "the tolerance is not positive", tolerance_mm, 0);
  std::vector<Interval> open;
  const std::vector<double> ends = breaks(curve);
  for (std::size_t i = ends.size() - 1; i > 0; --i) open.push_back({ends[i - 1], ends[i]});
  BiarcChain out;
  std::vector<Curve> arcs;
  while (!open.empty()) {
    const Interval part = open.back();
    open.pop_back();
    // Inside the part at its ends: at a knot the derivative may jump.
    const Vector ta = derivatives(curve, part.lo, 1)[1], tb = derivatives(curve, part.at(1 - 1e-12), 1)[1];
    auto two = biarc(evaluate(curve, part.lo), ta, evaluate(curve, part.hi), tb);
    if (!two && (norm(ta) == 0 || norm(tb) == 0))
      return fail(ErrorCode::Degenerate, fmt::format("the curve stands still near parameter {}", norm(ta) == 0 ? part.lo : part.hi), 0, 0);
    double bound = infinity;
    if (two) {
      const Point joint = end_point((*two)[0]);
      const double t = crossing(curve, part, joint, end_direction((*two)[0]));
      bound = std::max(distance_bound(curve, {part.lo, t}, (*two)[0], tolerance_mm), distance_bound(curve, {t, part.hi}, (*two)[1], tolerance_mm));
    }
    if (bound <= tolerance_mm) {
      for (Curve& c : *two) arcs.push_back(std::move(c));
      out.bound = std::max(out.bound, bound);
    } else if (arcs.size() + 2 * open.size() >= most_arcs || !(part.lo < part.mid() && part.mid() < part.hi)) {
      return fail(ErrorCode::NoConvergence, fmt::format("{} arcs do not come within the tolerance", most_arcs), bound, tolerance_mm);
    } else {
      open.push_back({part.mid(), part.hi});
      open.push_back({part.lo, part.mid()});
    }
  }
  out.arcs = arcs.size();
  out.curve = chain_of(std::move(arcs));
  return out;
}

}  // namespace trimloop
