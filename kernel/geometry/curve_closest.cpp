// Nearest points of curves. Lines, circles and polylines in closed form; elsewhere samples on each smooth piece find
// the valleys of the distance, and Newton's method on its derivative, kept inside a bracket, finds their bottoms.

#include "kernel/geometry/detail.h"

namespace trimloop {
namespace {

CurveFoot foot_at(const Curve& c, Point p, double t) {
  const Point q = evaluate(c, t);
  return {t, q, distance(p, q)};
}
const CurveFoot& nearer(const CurveFoot& a, const CurveFoot& b) { return b.distance < a.distance ? b : a; }

// ---- Newton

// Bottom of the valley that t lies in, within `limits`. With f = |C - p|^2 / 2: f' = C' . r and f'' = C'^2 + C'' . r.
// Each accepted point is no farther than the one before; the sign of f' there narrows the bracket. Where the second
// derivative misleads (a crest, a crease of the curve) the bracket is halved.
CurveFoot descend(const Curve& c, Point p, double t, Interval limits) {
  // At the upper limit the derivatives of this side of a crease are wanted, not those of the piece that begins there.
  const double last = std::nextafter(limits.hi, limits.lo);
  const auto one_sided = [&](double at) { return jet(c, std::min(at, last)); };
  double lo = limits.lo, hi = limits.hi;
  const double scale = limits.is_bounded() ? limits.length() : 1 + std::abs(t);
  t = limits.clamp(t);
  CurveJet j = one_sided(t);
  CurveFoot foot{t, j.point, distance(p, j.point)};
  for (int i = 0; i < 50; ++i) {
    const Vector r = j.point - p;
    const double slope = dot(j.d1, r), speed2 = dot(j.d1, j.d1), curvature = speed2 + dot(j.d2, r);
    if (!(std::abs(slope) > 0) || !(speed2 > 0)) break;
    (slope < 0 ? lo : hi) = t;
    const double newton = t - slope / (curvature > 0.01 * speed2 ? curvature : speed2);
    double next = newton;
    if (!(next > lo)) next = lo == limits.lo ? lo : 0.5 * (t + lo);
    if (!(next < hi)) next = hi == limits.hi ? hi : 0.5 * (t + hi);
    // The error of a Newton step is about its square: a small one is the last, whatever rounding says of the distance.
    const bool is_newton = next == newton && curvature > 0.01 * speed2;
    const bool final = is_newton && std::abs(next - t) <= 1e-7 * scale;
    const double allowed = final ? foot.distance * (1 + 1e-14) : foot.distance;
    bool accepted = false;
    for (int halving = 0; halving < 12 && std::abs(next - t) > 1e-15 * scale; ++halving) {
      j = one_sided(next);
      accepted = distance(p, j.point) <= allowed;
      if (accepted) break;
      if (final) return foot;
      (next < t ? lo : hi) = next;
      next = 0.5 * (next + t);
    }
    if (!accepted) break;
    const double step = std::abs(next - t);
    t = next;
    foot = {t, j.point, distance(p, j.point)};
    if (final || step <= 1e-14 * scale) break;
  }
  return foot;
}

// The samples cut the piece into arcs; each that can hold something nearer is searched, the most promising first. Of a
// point q on the arc between samples a and b: |q - p| >= (|a - p| + |b - p| - length of the arc) / 2.
CurveFoot search_piece(const Curve& c, Point p, Interval piece, int samples, CurveFoot best) {
  struct Arc {
    double bound;
    Interval t;
  };
  std::vector<Arc> arcs;
  CurveFoot last = foot_at(c, p, piece.lo);
  best = nearer(best, last);
  for (int i = 1; i <= samples; ++i) {
    const CurveFoot next = foot_at(c, p, piece.at(static_cast<double>(i) / samples));
    best = nearer(best, next);
    const double length = 1.25 * distance(last.point, next.point);  // the chord, enlarged for its curvature
    arcs.push_back({0.5 * (last.distance + next.distance - length), {last.t, next.t}});
    last = next;
  }
  std::stable_sort(arcs.begin(), arcs.end(), [](const Arc& a, const Arc& b) { return a.bound < b.bound; });
  for (const Arc& arc : arcs) {
    if (arc.bound >= best.distance) break;
    best = nearer(best, descend(c, p, arc.t.mid(), arc.t));
  }
  return best;
}

// ---- Closed forms and searches over the whole range

CurveFoot closest_of(const Line& line, const Curve& c, Point p) {
  const Vector along = line.end - line.start;
  const double length2 = dot(along, along);
  double t = length2 > 0 ? dot(p - line.start, along) / length2 : 0;
  if (!std::isfinite(t)) t = 0;
  return foot_at(c, p, line.range.clamp(t));
}

CurveFoot closest_of(const Circle& circle, const Curve& c, Point p) {
  const Vector r = p - circle.frame.origin;
  const double sign = circle.radius < 0 ? -1 : 1;
  const double angle = std::atan2(sign * dot(r, circle.frame.y), sign * dot(r, circle.frame.x));
  const double t = detail::first_at_or_after(circle.range.lo, angle);
  if (t <= circle.range.hi) return foot_at(c, p, t);
  return nearer(foot_at(c, p, circle.range.lo), foot_at(c, p, circle.range.hi));
}

CurveFoot on_segment(const Polyline& line, Point p, std::size_t i) {
  const Point a = line.points[i], b = line.points[i + 1];
  const Vector along = b - a;
  const double length2 = dot(along, along);
  double f = length2 > 0 ? dot(p - a, along) / length2 : 0;
  f = f > 0 ? std::min(f, 1.0) : 0;
  const Point q = f == 1 ? b : a + f * along;
  return {static_cast<double>(i) + f, q, distance(p, q)};
}
CurveFoot closest_of(const Polyline& line, const Curve& c, Point p) {
  CurveFoot best = foot_at(c, p, 0);
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i) best = nearer(best, on_segment(line, p, i));
  return best;
}

// Pieces in the order of their distance from the hull of their poles, until none can be nearer than what is found.
CurveFoot closest_of(const NurbsCurve& nurbs, const Curve& c, Point p) {
  struct Piece {
    double bound;
    Interval t;
  };
  const std::vector<double> at = breaks(nurbs);
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    const int span = find_span(nurbs.degree(), nurbs.knots(), nurbs.poles().size(), 0.5 * (at[i] + at[i + 1]));
    Box box;
    bool hull = true;
    for (int k = span - nurbs.degree(); k <= span; ++k) {
      const Hpoint h = nurbs.poles()[static_cast<std::size_t>(k)];
      hull = hull && h.w > 0;
      box.add(project(h));
    }
    pieces.push_back({hull ? detail::distance(box, p) : 0, {at[i], at[i + 1]}});
  }
  std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.bound < b.bound; });
  CurveFoot best = nearer(foot_at(c, p, nurbs.range().lo), foot_at(c, p, nurbs.range().hi));
  const int samples = nurbs.degree() == 1 ? 1 : std::min(2 * nurbs.degree() + 1, 33);
  for (const Piece& piece : pieces) {
    if (piece.bound >= best.distance) break;
    best = search_piece(c, p, piece.t, samples, best);
  }
  return best;
}

CurveFoot child_to_composite(const CompositeCurve& composite, std::size_t i, CurveFoot foot) {
  const Interval r = range(*composite.segments[i].curve);
  foot.t = composite.starts[i] + (composite.segments[i].reversed ? r.hi - foot.t : foot.t - r.lo);
  foot.t = Interval{composite.starts[i], composite.starts[i + 1]}.clamp(foot.t);
  return foot;
}
CurveFoot closest_of(const CompositeCurve& composite, const Curve& c, Point p) {
  CurveFoot best = foot_at(c, p, range(c).lo);
  for (std::size_t i = 0; i < composite.segments.size(); ++i)
    best = nearer(best, child_to_composite(composite, i, closest_point(*composite.segments[i].curve, p)));
  return best;
}

template <class C>  // ellipse, parabola, hyperbola, offset
CurveFoot closest_of(const C&, const Curve& c, Point p) {
  const std::vector<double> at = breaks(c);
  if (at.size() < 2) return foot_at(c, p, 0);
  CurveFoot best = nearer(foot_at(c, p, at.front()), foot_at(c, p, at.back()));
  const int samples = at.size() == 2 ? 24 : 8;
  for (std::size_t i = 0; i + 1 < at.size(); ++i) best = search_piece(c, p, {at[i], at[i + 1]}, samples, best);
  return best;
}

// ---- From a start

CurveFoot near_of(const Line& line, const Curve& c, Point p, double) { return closest_of(line, c, p); }
CurveFoot near_of(const Circle& circle, const Curve& c, Point p, double t) {
  return nearer(foot_at(c, p, circle.range.clamp(t)), closest_of(circle, c, p));
}
// From segment to segment as long as it goes down.
CurveFoot near_of(const Polyline& line, const Curve& c, Point p, double t) {
  if (line.points.size() < 2) return foot_at(c, p, 0);
  const std::size_t last = line.points.size() - 2;
  std::size_t i = t > 0 ? std::min(static_cast<std::size_t>(std::min(t, static_cast<double>(last))), last) : 0;
  CurveFoot best = on_segment(line, p, i);
  const auto walk = [&](std::size_t next) {
    const CurveFoot foot = on_segment(line, p, next);
    if (!(foot.distance < best.distance)) return false;
    best = foot;
    i = next;
    return true;
  };
  while (i < last && walk(i + 1)) {
  }
  while (i > 0 && walk(i - 1)) {
  }
  return best;
}
CurveFoot near_of(const CompositeCurve& composite, const Curve& c, Point p, double t) {
  if (composite.segments.empty()) return foot_at(c, p, 0);
  std::size_t i = detail::segment_at(composite, t);
  const auto in_child = [&](std::size_t k, double own) {
    const CompositeCurve::Segment& s = composite.segments[k];
    const Interval r = range(*s.curve);
    const double from_start = own - composite.starts[k];
    const double start = r.clamp(s.reversed ? r.hi - from_start : r.lo + from_start);
    return child_to_composite(composite, k, closest_point_near(*s.curve, p, start));
  };
  CurveFoot best = in_child(i, t);
  const auto walk = [&](std::size_t next, double joint) {
    const CurveFoot foot = in_child(next, joint);
    if (!(foot.distance < best.distance)) return false;
    best = foot;
    i = next;
    return true;
  };
  while (i + 1 < composite.segments.size() && best.t >= composite.starts[i + 1] &&
         walk(i + 1, composite.starts[i + 1])) {
  }
  while (i > 0 && best.t <= composite.starts[i] && walk(i - 1, composite.starts[i])) {
  }
  return best;
}
// Over the whole range; at the end of a curve that closes, on from the other end.
template <class C>
CurveFoot near_of(const C&, const Curve& c, Point p, double t) {
  const Interval r = range(c);
  const CurveFoot foot = descend(c, p, t, r);
  if (!r.is_bounded() || (foot.t > r.lo && foot.t < r.hi)) return foot;
  const double other = foot.t == r.lo ? r.hi : r.lo;
  const CurveJet beyond = jet(c, other);
  const bool closes = distance(beyond.point, foot.point) <= 1e-9 * norm(beyond.d1) * r.length();
  return closes ? nearer(foot, descend(c, p, other, r)) : foot;
}

}  // namespace

CurveFoot closest_point(const Curve& c, Point p) {
  return std::visit([&](const auto& shape) { return closest_of(shape, c, p); }, c.shape);
}
CurveFoot closest_point_near(const Curve& c, Point p, double t_start) {
  return std::visit([&](const auto& shape) { return near_of(shape, c, p, t_start); }, c.shape);
}

}  // namespace trimloop
