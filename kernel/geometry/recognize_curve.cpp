// Lines and conics among NURBS curves.

#include "kernel/geometry/recognize.h"
#include "kernel/nurbs/reduction.h"

namespace trimloop {
namespace {

struct Poles {  // Cartesian, of the active range
  std::vector<Point> points;
  double size = 0;
  bool positive = true;
};
Poles cartesian(const NurbsCurve& active) {
  Poles out;
  Box box;
  for (const Hpoint& h : active.poles()) {
    out.positive = out.positive && h.w > 0;
    out.points.push_back(project(h));
    if (out.positive) box.add(out.points.back());
  }
  out.size = box.diagonal();
  return out;
}

// Parameters that tell a polynomial of degree 2 p on each piece: 2 p + 3 a piece.
template <class F>
double largest_over(const NurbsCurve& c, F deviation) {
  double worst = 0;
  const std::vector<double> at = breaks(c);
  const int n = 2 * c.degree() + 2;
  for (std::size_t i = 0; i + 1 < at.size(); ++i)
    for (int k = 0; k <= n; ++k) {
      const double d = deviation(evaluate(c, Interval{at[i], at[i + 1]}.at(0.5 - 0.5 * std::cos(pi * k / n))));
      worst = std::max(worst, std::isfinite(d) ? d : infinity);
    }
  return worst;
}

std::optional<Curve> as_line(const Poles& poles, double within) {
  const Point a = poles.points.front(), b = poles.points.back();
  const Vector along = normalized(b - a);
  if (!(norm(along) > 0)) return std::nullopt;
  for (const Point& p : poles.points)
    if (norm((p - a) - dot(p - a, along) * along) > within) return std::nullopt;
  return Curve{Line{a, b, {0, 1}}};
}

// The osculating circle in the middle of the longest piece.
std::optional<Frame> circle_frame(const NurbsCurve& c, double& radius) {
  const std::vector<double> at = breaks(c);
  Interval longest{at[0], at[1]};
  for (std::size_t i = 1; i + 1 < at.size(); ++i)
    if (at[i + 1] - at[i] > longest.length()) longest = {at[i], at[i + 1]};
  const CurveJet j = jet(c, longest.mid());
  const Vector b = cross(j.d1, j.d2);
  const double speed = norm(j.d1);
  if (!(speed > 0) || !(norm(b) > 0)) return std::nullopt;
  const Vector z = normalized(b), n = normalized(cross(z, j.d1));
  radius = speed * speed * speed / norm(b);
  Frame f;
  f.origin = j.point + radius * n;
  f.z = z;
  f.x = -n;  // where the middle is: both ends are within half a turn of it, or it is replaced below
  f.y = cross(z, f.x);
  return f;
}

// x axis through the start, so that the range begins at 0.
Frame turned_to(const Frame& f, Point start) {
  const Vector arm = start - f.origin, x = normalized(arm - dot(arm, f.z) * f.z);
  return {f.origin, x, cross(f.z, x), f.z};
}

std::optional<Curve> as_circle(const NurbsCurve& c, double within) {
  double radius = 0;
  const auto f = circle_frame(c, radius);
  if (!f || !(radius < 1e9)) return std::nullopt;
  Frame frame = *f;
  // Centre and radius once more from points spread over the arc: three of them fix a circle best when far apart.
  const auto at = [&](double s) { return evaluate(c, c.range().at(s)); };
  const bool closed = distance(at(0), at(1)) <= 1e-3 * radius;
  const Point p = at(0), q = at(closed ? 1 / 3.0 : 0.5), r = at(closed ? 2 / 3.0 : 1);
  const Vector a = q - p, b = r - p, n = cross(a, b);
  if (dot(n, n) > 1e-6 * dot(a, a) * dot(b, b)) {
    const Vector to_centre = 1 / (2 * dot(n, n)) * (dot(a, a) * cross(b, n) + dot(b, b) * cross(n, a));
    const Vector z = dot(n, frame.z) < 0 ? -normalized(n) : normalized(n);
    frame.origin = p + to_centre;
    frame.z = z;
    radius = norm(to_centre);
  }
  frame = turned_to(frame, at(0));
  const auto off = [&](Point x) {
    const Vector arm = x - frame.origin;
    return std::hypot(norm(arm - dot(arm, frame.z) * frame.z) - radius, dot(arm, frame.z));
  };
  if (!(largest_over(c, off) <= within)) return std::nullopt;
  return Curve{Circle{frame, radius, {0, two_pi}}};
}

Frame frame_of(Point origin, Vector x, Vector z) {
  Frame f;
  f.origin = origin;
  f.x = normalized(x);
  f.z = normalized(z - dot(z, f.x) * f.x);
  f.y = cross(f.z, f.x);
  return f;
}

// From conjugate radii a, b of p = c + a cos t + b sin t to the axes.
std::optional<Curve> ellipse_of(Point c, Vector a, Vector b) {
  const double t = 0.5 * std::atan2(2 * dot(a, b), dot(a, a) - dot(b, b));
  const Vector x = std::cos(t) * a + std::sin(t) * b, y = std::cos(t) * b - std::sin(t) * a;
  if (!(norm(x) > 0) || !(norm(y) > 0)) return std::nullopt;
  return Curve{Ellipse{frame_of(c, x, cross(x, y)), norm(x), norm(y), {0, two_pi}}};
}
// p = c + a cosh t + b sinh t.
std::optional<Curve> hyperbola_of(Point c, Vector a, Vector b) {
  const double ratio = -2 * dot(a, b) / (dot(a, a) + dot(b, b));
  if (!(std::abs(ratio) < 1)) return std::nullopt;
  const double t = 0.5 * std::atanh(ratio);
  const Vector x = std::cosh(t) * a + std::sinh(t) * b, y = std::sinh(t) * a + std::cosh(t) * b;
  if (!(norm(x) > 0) || !(norm(y) > 0)) return std::nullopt;
  return Curve{Hyperbola{frame_of(c, x, cross(x, y)), norm(x), norm(y), {-1, 1}}};
}
std::optional<Curve> parabola_of(Point p0, Point p1, Point p2) {
  const Vector b = 2.0 * (p1 - p0), a = (p2 - p1) - (p1 - p0);
  if (!(norm(a) > 0)) return std::nullopt;
  const double t0 = -dot(a, b) / (2 * dot(a, a));
  const Vector v = b + 2 * t0 * a;
  if (!(norm(v) > 0)) return std::nullopt;
  const Point vertex = p0 + t0 * (b + t0 * a);
  return Curve{Parabola{frame_of(vertex, a, cross(a, v)), dot(v, v) / (4 * norm(a)), {-1, 1}}};
}

// Poles p0, p1, p2 with weights 1, w, 1: the centre lies on the line from p1 through the middle of the chord.
std::optional<Curve> conic_of(const NurbsCurve& piece) {
  const Hpoint &h0 = piece.poles()[0], &h1 = piece.poles()[1], &h2 = piece.poles()[2];
  const Point p0 = project(h0), p1 = project(h1), p2 = project(h2), m = midpoint(p0, p2);
  const double w = h1.w / std::sqrt(h0.w * h2.w), excess = 1 - w * w;
  if (std::abs(excess) < 1e-10) return parabola_of(p0, p1, p2);
  const Point c = p1 + 1 / excess * (m - p1), shoulder = m + w / (1 + w) * (p1 - m);
  const Vector a = shoulder - c, b = 0.5 / std::sqrt(std::abs(excess)) * (p2 - p0);
  return excess > 0 ? ellipse_of(c, a, b) : hyperbola_of(c, a, b);
}

double off_conic(const Curve& conic, Point p) {
  const auto local = [&](const Frame& f) {
    return Vector{dot(p - f.origin, f.x), dot(p - f.origin, f.y), dot(p - f.origin, f.z)};
  };
  // Residual over gradient: the distance to first order.
  if (const auto* e = std::get_if<Ellipse>(&conic.shape)) {
    const Vector q = local(e->frame);
    const double x = q.x / e->a, y = q.y / e->b;
    return std::hypot((x * x + y * y - 1) / (2 * std::hypot(x / e->a, y / e->b)), q.z);
  }
  if (const auto* h = std::get_if<Hyperbola>(&conic.shape)) {
    const Vector q = local(h->frame);
    const double x = q.x / h->a, y = q.y / h->b;
    return q.x > 0 ? std::hypot((x * x - y * y - 1) / (2 * std::hypot(x / h->a, y / h->b)), q.z) : infinity;
  }
  const auto& b = std::get<Parabola>(conic.shape);
  const Vector q = local(b.frame);
  const double f = b.focal_length;
  return std::hypot((q.y * q.y - 4 * f * q.x) / (2 * std::hypot(q.y, 2 * f)), q.z);
}

std::optional<Curve> as_conic(NurbsCurve c, double within) {
  while (c.degree() > 2) {
    auto lower = reduce(c, 1);
    // The bound includes rounding of its own; what counts is checked on points below.
    if (!lower || !(lower->error <= 1e3 * within)) return std::nullopt;
    c = std::move(lower->curve);
  }
  if (c.degree() != 2) return std::nullopt;
  std::optional<Curve> best;
  double least = infinity;
  for (const NurbsCurve& piece : bezier_pieces(c)) {
    const auto conic = conic_of(piece);
    if (!conic) continue;
    const double off = largest_over(c, [&](Point p) { return off_conic(*conic, p); });
    if (off < least) least = off, best = conic;
  }
  return least <= within ? best : std::nullopt;
}

double parameter_of(const Curve& c, Point p) {
  const auto local = [&](const Frame& f) { return Uv{dot(p - f.origin, f.x), dot(p - f.origin, f.y)}; };
  if (const auto* l = std::get_if<Line>(&c.shape)) {
    const Vector d = l->end - l->start;
    return dot(p - l->start, d) / dot(d, d);
  }
  if (const auto* k = std::get_if<Circle>(&c.shape)) return std::atan2(local(k->frame).v, local(k->frame).u);
  if (const auto* e = std::get_if<Ellipse>(&c.shape))
    return std::atan2(local(e->frame).v / e->b, local(e->frame).u / e->a);
  if (const auto* h = std::get_if<Hyperbola>(&c.shape)) return std::asinh(local(h->frame).v / h->b);
  const auto& b = std::get<Parabola>(c.shape);
  return local(b.frame).v / (2 * b.focal_length);
}

}  // namespace

CurveRelation::CurveRelation(NurbsCurve nurbs, Curve analytic)
    : nurbs_(std::move(nurbs)), analytic_(std::move(analytic)) {
  if (std::holds_alternative<Circle>(analytic_.shape) || std::holds_alternative<Ellipse>(analytic_.shape))
    turn_ = two_pi;
  // Fine enough that neighbours are less than half a turn apart.
  constexpr int steps = 8;
  const std::vector<double> at = breaks(nurbs_);
  for (std::size_t i = 0; i + 1 < at.size(); ++i)
    for (int k = i == 0 ? 0 : 1; k <= steps; ++k) {
      at_.push_back(Interval{at[i], at[i + 1]}.at(k / double{steps}));
      double t = raw(at_.back());
      if (!value_.empty() && turn_ > 0) t += turn_ * std::round((value_.back() - t) / turn_);
      ascends_ = ascends_ && (value_.empty() || t > value_.back());
      value_.push_back(t);
    }
}

double CurveRelation::raw(double s) const { return parameter_of(analytic_, evaluate(nurbs_, s)); }

double CurveRelation::to_analytic(double s) const {
  s = Interval{at_.front(), at_.back()}.clamp(s);
  const auto next = std::upper_bound(at_.begin() + 1, at_.end() - 1, s);
  const std::size_t i = static_cast<std::size_t>(next - at_.begin());
  if (s == at_[i]) return value_[i];
  if (s == at_[i - 1]) return value_[i - 1];
  double t = raw(s);
  if (turn_ > 0) t += turn_ * std::round((0.5 * (value_[i - 1] + value_[i]) - t) / turn_);
  return t;
}

double CurveRelation::to_nurbs(double t) const {
  if (!(t > value_.front())) return at_.front();
  if (!(t < value_.back())) return at_.back();
  const std::size_t i = static_cast<std::size_t>(std::upper_bound(value_.begin(), value_.end(), t) - value_.begin());
  double lo = at_[i - 1], hi = at_[i], f_lo = value_[i - 1] - t, f_hi = value_[i] - t;
  if (f_lo == 0) return lo;
  // Regula falsi, Illinois variant, then the better end.
  for (int k = 0; k < 100; ++k) {
    double s = (lo * f_hi - hi * f_lo) / (f_hi - f_lo);
    if (!(lo < s && s < hi)) s = 0.5 * (lo + hi);
    if (!(lo < s && s < hi)) break;
    const double f = to_analytic(s) - t;
    if (f == 0) return s;
    if (f < 0) {
      lo = s, f_lo = f, f_hi *= 0.5;
    } else {
      hi = s, f_hi = f, f_lo *= 0.5;
    }
    if (hi - lo <= 2e-16 * std::max(std::abs(lo), std::abs(hi))) break;
  }
  return std::abs(to_analytic(lo) - t) <= std::abs(to_analytic(hi) - t) ? lo : hi;
}

std::optional<RecognizedCurve> recognize(const NurbsCurve& given, double relative) {
  if (!(given.range().lo < given.range().hi)) return std::nullopt;
  const NurbsCurve c = trimmed(given, given.range());
  const Poles poles = cartesian(c);
  if (!poles.positive || !(poles.size > 0)) return std::nullopt;
  const double within = relative * poles.size;
  auto found = as_line(poles, within);
  if (!found && c.degree() > 1) found = as_circle(c, within);
  if (!found && c.degree() > 1) found = as_conic(c, within);
  if (!found) return std::nullopt;
  // The ellipse and its kin may run the other way: turn them over.
  const auto turned_over = [](Frame f) { return Frame{f.origin, f.x, -f.y, -f.z}; };
  CurveRelation relation(c, *found);
  if (!relation.ascends()) {
    if (auto* e = std::get_if<Ellipse>(&found->shape)) e->frame = turned_over(e->frame);
    if (auto* h = std::get_if<Hyperbola>(&found->shape)) h->frame = turned_over(h->frame);
    if (auto* b = std::get_if<Parabola>(&found->shape)) b->frame = turned_over(b->frame);
    relation = CurveRelation(c, *found);
    if (!relation.ascends()) return std::nullopt;  // it doubles back
  }
  const Interval range{relation.to_analytic(c.range().lo), relation.to_analytic(c.range().hi)};
  const bool angle = std::holds_alternative<Circle>(found->shape) || std::holds_alternative<Ellipse>(found->shape);
  if (angle && range.length() > two_pi * (1 + 1e-12)) return std::nullopt;  // more than once round
  if (auto* k = std::get_if<Circle>(&found->shape)) k->range = range;
  if (auto* e = std::get_if<Ellipse>(&found->shape)) e->range = range;
  if (auto* h = std::get_if<Hyperbola>(&found->shape)) h->range = range;
  if (auto* b = std::get_if<Parabola>(&found->shape)) b->range = range;
  double deviation = 0;
  const std::vector<double> at = breaks(c);
  for (std::size_t i = 0; i + 1 < at.size(); ++i)
    for (int k = 0; k <= 8; ++k) {
      const double s = Interval{at[i], at[i + 1]}.at(k / 8.0);
      deviation = std::max(deviation, distance(evaluate(c, s), evaluate(*found, relation.to_analytic(s))));
    }
  return RecognizedCurve{std::move(*found), std::move(relation), deviation};
}

}  // namespace trimloop
