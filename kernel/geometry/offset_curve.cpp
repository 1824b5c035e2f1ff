// Offsets of plane curves.

#include <fmt/format.h>

#include "kernel/geometry/offset.h"
#include "kernel/geometry/recognize.h"
#include "kernel/intersect/intersect.h"
#include "kernel/nurbs/bernstein_net.h"

namespace trimloop {
namespace {

using detail::Bernstein2;
using detail::BernsteinVector;

struct Homogeneous {  // of a Bezier curve
  BernsteinVector a;
  Bernstein2 w;
};
Homogeneous homogeneous(const NurbsCurve& piece) {
  const std::size_t p = static_cast<std::size_t>(piece.degree());
  Homogeneous h{{detail::constant(0, p), detail::constant(0, p), detail::constant(0, p)}, detail::constant(0, p)};
  for (std::size_t i = 0; i <= p; ++i) {
    const Hpoint& q = piece.poles()[i];
    h.a.x.c[i] = q.x, h.a.y.c[i] = q.y, h.a.z.c[i] = q.z, h.w.c[i] = q.w;
  }
  return h;
}

// Bound on |B - (C + d N)| over one Bezier piece; infinite where it cannot be had.
double bound_of(const NurbsCurve& c, const NurbsCurve& b, double d, Vector n) {
  // Seen from the start of the curve, coordinates are small.
  const Vector origin = to_vector(project(c.poles().front()));
  const NurbsCurve near_c = transformed(c, Transform::translation(-origin)),
                   near_b = transformed(b, Transform::translation(-origin));
  const Homogeneous f = homogeneous(near_c), g = homogeneous(near_b);
  const BernsteinVector x = f.w * g.a - f.a;  // w D
  const BernsteinVector slope{detail::derivative_u(f.a.x), detail::derivative_u(f.a.y), detail::derivative_u(f.a.z)};
  const BernsteinVector h = f.w * slope - detail::derivative_u(f.w) * f.a;  // along C'
  const double w = f.w.lowest(), speed2 = dot(h, h).lowest();
  if (!(w > 0) || !(speed2 > 0)) return infinity;
  const double square = (dot(x, x) - d * d * (f.w * f.w)).largest() / (w * w);  // of |D|^2 - d^2
  const double along = dot(x, h).largest() / (w * std::sqrt(speed2));
  const Bernstein2 off_plane = n.x * x.x + n.y * x.y + n.z * x.z;
  const double off = off_plane.largest() / w;
  const double inner = d * d - square - along * along - off * off;
  if (!(inner > 0)) return infinity;
  // D.N never vanishes, so its sign at the start is that of all.
  const CurveJet j = jet(c, c.range().lo);
  if (!(dot(evaluate(b, b.range().lo) - j.point, d * cross(j.d1, n)) > 0)) return infinity;
  const double across = std::max(std::sqrt(d * d + square) - std::abs(d), std::abs(d) - std::sqrt(inner));
  const double size = f.a.x.largest() + f.a.y.largest() + f.a.z.largest() + std::abs(d);
  const double rounding = 64 * static_cast<double>(c.degree() + 4) * std::numeric_limits<double>::epsilon() * size / w;
  return norm(Vector{across, along, off}) + rounding;
}

// The cubic with the ends and end tangents of the offset.
NurbsCurve hermite(const NurbsCurve& c, double d, Vector n) {
  const Curve exact{OffsetCurve{std::make_shared<const Curve>(Curve{c}), d, n}};
  const Interval r = c.range();
  const CurveJet a = jet(exact, r.lo), b = jet(exact, r.hi);
  const double third = r.length() / 3;
  const std::vector<Point> poles{a.point, a.point + third * a.d1, b.point - third * b.d1, b.point};
  return NurbsCurve::from_cartesian(3, {r.lo, r.lo, r.lo, r.lo, r.hi, r.hi, r.hi, r.hi}, poles, {}).value();
}

struct Piece {
  Curve curve;
  double bound = 0;
  bool filler = false;  // an arc about a corner
};

Result<void> add_approximated(const NurbsCurve& whole, double d, Vector n, const OffsetOptions& how,
                              std::vector<Piece>& out) {
  std::vector<NurbsCurve> open = bezier_pieces(whole);
  std::reverse(open.begin(), open.end());
  while (!open.empty()) {
    const NurbsCurve piece = open.back();
    open.pop_back();
    const NurbsCurve fit = hermite(piece, d, n);
    bool finite = true;
    for (const Hpoint& h : fit.poles()) finite = finite && is_finite(project(h));
    const double bound = finite ? bound_of(piece, fit, d, n) : infinity;
    if (bound <= how.tolerance) {
      out.push_back({Curve{fit}, bound});
      continue;
    }
    const double mid = piece.range().mid();
    if (static_cast<int>(out.size() + open.size()) + 2 > how.most_pieces ||
        piece.range().length() < 1e-9 * whole.range().length())
      return fail(ErrorCode::NoConvergence, fmt::format("the offset needs too many pieces near parameter {}", mid),
                  bound, how.tolerance);
    const auto [left, right] = split(piece, mid);
    open.push_back(right);
    open.push_back(left);
  }
  return {};
}

// One smooth curve, exactly where it can be.
Result<void> add_offset(const Curve& c, double d, Vector n, const OffsetOptions& how, std::vector<Piece>& out) {
  if (const auto* l = std::get_if<Line>(&c.shape)) {
    const Vector step = d * normalized(cross(l->end - l->start, n));
    out.push_back({Curve{Line{l->start + step, l->end + step, l->range}}});
    return {};
  }
  if (const auto* k = std::get_if<Circle>(&c.shape)) {
    // C' x n points outwards when the turn is about n.
    const double r = k->radius + (dot(k->frame.z, n) > 0 ? d : -d);
    if (std::abs(r) <= 1e-12 * k->radius) return {};  // shrunk to its centre
    Circle o = *k;
    o.radius = std::abs(r);
    if (r < 0) o.frame.x = -o.frame.x, o.frame.y = -o.frame.y;
    out.push_back({Curve{o}});
    return {};
  }
  if (const auto* s = std::get_if<NurbsCurve>(&c.shape)) {
    if (const auto found = recognize(*s))
      if (std::holds_alternative<Line>(found->curve.shape) || std::holds_alternative<Circle>(found->curve.shape))
        return add_offset(found->curve, d, n, how, out);
    return add_approximated(trimmed(*s, s->range()), d, n, how, out);
  }
  const auto spline = to_nurbs(c);
  if (!spline) return tl::unexpected<Error>(spline.error());
  return add_approximated(spline->curve, d, n, how, out);
}

// Smooth stretches of the curve: children, sides, and splines cut at full knots.
void smooth_parts(const Curve& c, std::vector<Curve>& out) {
  if (const auto* p = std::get_if<Polyline>(&c.shape)) {
    for (std::size_t i = 0; i + 1 < p->points.size(); ++i)
      if (distance(p->points[i], p->points[i + 1]) > 0) out.push_back(Curve{Line{p->points[i], p->points[i + 1]}});
  } else if (const auto* composite = std::get_if<CompositeCurve>(&c.shape)) {
    for (const CompositeCurve::Segment& s : composite->segments)
      smooth_parts(s.reversed ? reversed(*s.curve) : *s.curve, out);
  } else if (const auto* s = std::get_if<NurbsCurve>(&c.shape)) {
    double from = s->range().lo;
    for (const double t : breaks(*s)) {
      const auto [a, b] = std::equal_range(s->knots().begin(), s->knots().end(), t);
      if (t > from && (t == s->range().hi || b - a >= s->degree())) {
        out.push_back(Curve{trimmed(*s, {from, t})});
        from = t;
      }
    }
  } else {
    out.push_back(c);
  }
}

bool in_plane(const Curve& c, Vector n, double within) {
  const auto spline = to_nurbs(c);
  if (!spline) return false;
  const Point o = start_point(c);
  for (const Hpoint& h : spline->curve.poles())
    if (std::abs(dot(Vector{h.x, h.y, h.z} - h.w * to_vector(o), n)) > within * std::max(1.0, std::abs(h.w)))
      return false;
  return true;
}

// The arc about a corner from one offset end to the next, where they leave a gap on the outer side.
std::optional<Curve> corner_arc(Point corner, Point from, Point to, Vector n, double d, Vector before, Vector after) {
  if (distance(from, to) <= 1e-9 * std::abs(d)) return std::nullopt;
  // On the outer side the turn has the sign of -d: C' x n points right of the motion seen from n.
  const double turn = std::atan2(dot(cross(before, after), n), dot(before, after));
  if (!(turn * d > 0)) return std::nullopt;
  Frame f;
  f.origin = corner, f.x = normalized(from - corner), f.z = turn > 0 ? n : -n, f.y = cross(f.z, f.x);
  return Curve{Circle{f, std::abs(d), {0, std::abs(turn)}}};
}

// ---- Trimming

struct Cut {
  std::vector<double> at;
};

Result<std::vector<Cut>> crossings(const std::vector<Piece>& pieces, double tolerance) {
  std::vector<Cut> cuts(pieces.size());
  std::vector<Box> boxes;
  for (const Piece& p : pieces) boxes.push_back(bounding_box(p.curve));
  const auto apart = [&](const Box& a, const Box& b) {
    return a.lo.x > b.hi.x + tolerance || b.lo.x > a.hi.x + tolerance || a.lo.y > b.hi.y + tolerance ||
           b.lo.y > a.hi.y + tolerance || a.lo.z > b.hi.z + tolerance || b.lo.z > a.hi.z + tolerance;
  };
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (std::size_t j = i + 1; j < pieces.size(); ++j) {
      if (apart(boxes[i], boxes[j])) continue;
      const auto found = intersect(pieces[i].curve, pieces[j].curve, {tolerance});
      if (!found) return tl::unexpected<Error>(found.error());
      const auto add = [&](std::size_t k, double t) {
        const Interval r = range(pieces[k].curve);
        const double margin = 1e-9 * r.length();  // neighbours meet at their ends
        if (r.lo + margin < t && t < r.hi - margin) cuts[k].at.push_back(t);
      };
      for (const CurveCurvePoint& p : found->points) add(i, p.t_first), add(j, p.t_second);
      for (const CurveCurveOverlap& o : found->overlaps) {
        add(i, o.first.lo), add(i, o.first.hi);
        add(j, o.second.lo), add(j, o.second.hi);
      }
    }
  for (Cut& c : cuts) std::sort(c.at.begin(), c.at.end());
  return cuts;
}

// Whether a stretch is as far from the curve as the offset says: its middle tells, since that changes at crossings
// only.
bool valid(const Curve& base, const Curve& stretch, double d, double slack) {
  for (const double share : {0.5, 0.3}) {
    const Point p = evaluate(stretch, range(stretch).at(share));
    if (!(closest_point(base, p).distance >= std::abs(d) - slack)) return false;
  }
  return true;
}

}  // namespace

Result<CurveOffset> offset(const Curve& c, double d, Vector normal, const OffsetOptions& how) {
  const Vector n = normalized(normal);
  if (!(norm(n) > 0) || !std::isfinite(d))
    return fail(ErrorCode::InvalidArgument, "an offset has a distance and a normal");
  if (!is_bounded(c)) return fail(ErrorCode::InvalidArgument, "an unbounded curve has no offset of its own");
  if (!in_plane(c, n, how.tolerance))
    return fail(ErrorCode::InvalidArgument, "the curve lies in no plane across the normal");
  CurveOffset out;
  if (d == 0) {
    out.chains.push_back({c});
    return out;
  }
  // 1. Offsets of the smooth parts, arcs about outer corners.
  std::vector<Curve> parts;
  smooth_parts(c, parts);
  std::vector<Piece> pieces;
  const bool closed =
      parts.size() > 0 && distance(start_point(parts.front()), end_point(parts.back())) <= how.tolerance;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (auto ok = add_offset(parts[i], d, n, how, pieces); !ok) return tl::unexpected<Error>(ok.error());
    const bool last = i + 1 == parts.size();
    if (last && !closed) break;
    const Curve& next = parts[last ? 0 : i + 1];
    const Vector before = jet(parts[i], range(parts[i]).hi).d1, after = jet(next, range(next).lo).d1;
    const Point corner = end_point(parts[i]);
    const Point from = corner + d * normalized(cross(before, n)), to = corner + d * normalized(cross(after, n));
    if (auto arc = corner_arc(corner, from, to, n, d, before, after)) pieces.push_back({std::move(*arc), 0, true});
  }
  for (const Piece& p : pieces) out.bound = std::max(out.bound, p.bound);
  // 2. Cut where the pieces cross, keep what is far enough from the curve.
  std::vector<Curve> kept;
  const double slack = 2 * out.bound + 1e-9 * std::abs(d) + how.tolerance;
  if (how.trim) {
    const auto cuts = crossings(pieces, 0);
    if (!cuts) return tl::unexpected<Error>(cuts.error());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      std::vector<double> ends{range(pieces[i].curve).lo};
      for (const double t : (*cuts)[i].at)
        if (t > ends.back()) ends.push_back(t);
      ends.push_back(range(pieces[i].curve).hi);
      for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
        Curve stretch = ends.size() == 2 ? pieces[i].curve : with_range(pieces[i].curve, {ends[k], ends[k + 1]});
        if (valid(c, stretch, d, slack)) {
          kept.push_back(std::move(stretch));
        } else {
          ++out.trimmed;
        }
      }
    }
  } else {
    for (Piece& p : pieces) kept.push_back(std::move(p.curve));
  }
  // 3. Chains.
  for (Curve& k : kept) {
    const bool goes_on =
        !out.chains.empty() && distance(end_point(out.chains.back().back()), start_point(k)) <= 4 * slack;
    if (!goes_on) out.chains.emplace_back();
    out.chains.back().push_back(std::move(k));
  }
  return out;
}

}  // namespace trimloop
