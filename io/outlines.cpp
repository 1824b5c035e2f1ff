#include "io/outlines.h"

#include <fmt/format.h>

#include <span>

#include "kernel/geometry/approximate.h"

namespace trimloop::io {

namespace {

using svg::Segment;
using Kind = Segment::Kind;

Point point(std::array<double, 2> p) { return {p[0], p[1], 0}; }

// The end of the segment, the subpath's start for Close.
Point end_of(const Segment& s, Point start) {
  switch (s.kind) {
    case Kind::Quad: return point(s.at[1]);
    case Kind::Cubic: return point(s.at[2]);
    case Kind::Close: return start;
    default: return point(s.at[0]);
  }
}

// Centre form of an arc (SVG 1.1 F.6.5, F.6.6: radii that are too small grow).
Curve arc(Point from, const Segment& s) {
  const Point to = point(s.at[0]);
  const double turn = s.rotation_deg * pi / 180, c = std::cos(turn), d = std::sin(turn);
  const double hx = (from.x - to.x) / 2, hy = (from.y - to.y) / 2;
  const double x = c * hx + d * hy, y = -d * hx + c * hy;
  double rx = s.rx, ry = s.ry;
  const double grow = (x / rx) * (x / rx) + (y / ry) * (y / ry);
  if (grow > 1) rx *= std::sqrt(grow), ry *= std::sqrt(grow);
  const double left = std::max(0.0, 1 / std::max(grow, 1e-300) - 1);
  const double factor = (grow >= 1 ? 0 : std::sqrt(left)) * (s.large == s.sweep ? -1 : 1);
  const double cx = factor * rx * y / ry, cy = -factor * ry * x / rx;
  const Point centre{c * cx - d * cy + (from.x + to.x) / 2, d * cx + c * cy + (from.y + to.y) / 2, 0};
  const double a0 = std::atan2((y - cy) / ry, (x - cx) / rx);
  double a1 = std::atan2((-y - cy) / ry, (-x - cx) / rx);
  // Sweep runs with growing angle. Against it, the frame is turned over, so that the curve runs upwards in its parameter.
  Frame frame{centre, {c, d, 0}, {-d, c, 0}, {0, 0, 1}};
  double start = a0;
  if (!s.sweep) {
    frame.y = -frame.y;
    frame.z = -frame.z;
    start = -a0;
    a1 = -a1;
  }
  if (a1 <= start) a1 += two_pi;
  if (rx == ry) return {Circle{frame, rx, {start, a1}}};
  return {Ellipse{frame, rx, ry, {start, a1}}};
}

// A run of pieces of one degree as one spline: knots 0, 1, ... with the degree as multiplicity, so that every control
// point is a pole.
Curve run(int degree, const std::vector<Point>& poles) {
  const auto p = static_cast<std::size_t>(degree);
  const std::size_t pieces = (poles.size() - 1) / p;
  std::vector<double> knots{0};
  for (std::size_t i = 0; i <= pieces; ++i) knots.insert(knots.end(), p, static_cast<double>(i));
  knots.push_back(static_cast<double>(pieces));
  return {*NurbsCurve::from_cartesian(degree, std::move(knots), poles, {})};
}

class Subpath {
 public:
  void start(Point p) { start_ = at_ = p; }

  void add(const Segment& s) {
    const Point end = end_of(s, start_);
    const int degree = s.kind == Kind::Cubic ? 3 : s.kind == Kind::Quad ? 2 : s.kind == Kind::Arc ? 0 : 1;
    if (degree == 1 && distance(at_, end) == 0) return;  // closing where the pen is, or a dot
    if (degree == 0) {
      flush();
      if (distance(at_, end) > 0) curves_.push_back(arc(at_, s));  // SVG 1.1 F.6.2: equal ends make no arc
    } else {
      if (degree != degree_) flush();
      degree_ = degree;
      if (poles_.empty()) poles_.push_back(at_);
      if (degree >= 2) poles_.push_back(point(s.at[0]));
      if (degree == 3) poles_.push_back(point(s.at[1]));
      poles_.push_back(end);
    }
    at_ = end;
  }

  // The curve so far, if there is one; the next subpath begins where this one did.
  void finish(std::vector<Curve>& out) {
    flush();
    if (curves_.size() == 1) out.push_back(std::move(curves_[0]));
    if (curves_.size() > 1) {
      std::vector<CompositeCurve::Segment> segments;
      for (Curve& c : curves_) segments.push_back({std::make_shared<const Curve>(std::move(c)), false});
      out.push_back({make_composite(std::move(segments))});
    }
    curves_.clear();
    at_ = start_;
  }

 private:
  void flush() {
    if (poles_.size() == 2 && degree_ == 1) curves_.push_back({Line{poles_[0], poles_[1]}});
    else if (!poles_.empty() && degree_ == 1) curves_.push_back({Polyline{poles_}});
    else if (!poles_.empty()) curves_.push_back(run(degree_, poles_));
    poles_.clear();
    degree_ = 0;
  }

  Point start_, at_;
  int degree_ = 0;
  std::vector<Point> poles_;
  std::vector<Curve> curves_;
};

}  // namespace

Result<std::vector<Curve>> curves_of(const std::vector<Segment>& path, const Transform& to_mm) {
  std::vector<Curve> flat;
  Subpath subpath;
  for (const Segment& s : path) {
    if (s.kind == Kind::Move) {
      subpath.finish(flat);
      subpath.start(point(s.at[0]));
      continue;
    }
    subpath.add(s);
    if (s.kind == Kind::Close) subpath.finish(flat);
  }
  subpath.finish(flat);
  std::vector<Curve> out;
  for (const Curve& c : flat) {
    auto placed = transformed(c, to_mm);
    if (!placed) return tl::unexpected(placed.error());
    out.push_back(std::move(*placed));
  }
  return out;
}

namespace {

Segment to(Kind kind, std::initializer_list<Point> points) {
  Segment s;
  s.kind = kind;
  std::size_t i = 0;
  for (const Point& p : points) s.at[i++] = {p.x, p.y};
  return s;
}

bool flat(const Curve& c) {
  const auto* circle = std::get_if<Circle>(&c.shape);
  const auto* ellipse = std::get_if<Ellipse>(&c.shape);
  const Vector z = circle ? circle->frame.z : ellipse ? ellipse->frame.z : Vector{};
  return std::abs(z.x) + std::abs(z.y) <= 1e-12 && std::abs(z.z) > 0.5;
}

// Half turns at most, so that both flags are certain.
void add_arc(const Curve& c, const Frame& frame, double a, double b, std::vector<Segment>& out) {
  const Interval whole = range(c);
  const int parts = std::max(1, static_cast<int>(std::ceil(whole.length() / pi - 1e-12)));
  for (int i = 1; i <= parts; ++i) {
    Segment s = to(Kind::Arc, {evaluate(c, whole.at(static_cast<double>(i) / parts))});
    s.rx = a, s.ry = b;
    s.rotation_deg = std::atan2(frame.x.y, frame.x.x) * 180 / pi;
    s.sweep = frame.z.z > 0;
    out.push_back(s);
  }
}

struct Writer {
  PathOfCurve out;
  double tolerance;

  // True when every pole is a control point of a Bézier piece already: whole range, each inner knot `degree` times.
  static bool is_in_pieces(const NurbsCurve& c) {
    const auto p = static_cast<std::size_t>(c.degree());
    const std::vector<double>& k = c.knots();
    if (c.is_rational() || p > 3 || k.size() < 2 * p + 2 || (k.size() - 2) % p != 0) return false;
    if (c.range().lo != k.front() || c.range().hi != k.back() || k[0] != k[1] || k[k.size() - 2] != k.back()) return false;
    for (std::size_t i = 1; i + 1 < k.size(); i += p)
      if (k[i] != k[i + p - 1] || (i > 1 && !(k[i - 1] < k[i]))) return false;
    return true;
  }

  void put(std::span<const Hpoint> poles) {  // the first is where the pen stands
    static constexpr Kind kinds[] = {Kind::Line, Kind::Quad, Kind::Cubic};
    Segment s;
    s.kind = kinds[poles.size() - 2];
    for (std::size_t i = 1; i < poles.size(); ++i) {
      const Point p = project(poles[i]);
      s.at[i - 1] = {p.x, p.y};
    }
    out.path.push_back(s);
  }

  Result<void> pieces(const NurbsCurve& curve) {
    if (is_in_pieces(curve)) {
      const auto p = static_cast<std::size_t>(curve.degree());
      const std::span<const Hpoint> poles(curve.poles());
      out.path.reserve(out.path.size() + poles.size() / p);
      for (std::size_t i = 0; i + p < poles.size(); i += p) put(poles.subspan(i, p + 1));
      return {};
    }
    for (const NurbsCurve& piece : bezier_pieces(curve)) {
      if (piece.is_rational() || piece.degree() > 3) {
        if (auto done = approximated({piece}); !done) return done;
        continue;
      }
      put(piece.poles());
    }
    return {};
  }

  Result<void> approximated(const Curve& c) {
    const auto fitted = approximate_in_space([&c](double t) { return evaluate(c, t); }, breaks(c), tolerance);
    if (!fitted) return tl::unexpected(fitted.error());
    out.deviation_mm = std::max(out.deviation_mm, fitted->deviation);
    return pieces(std::get<NurbsCurve>(fitted->curve.shape));
  }

  Result<void> add(const Curve& c) {
    if (const auto* line = std::get_if<Line>(&c.shape)) {
      if (!is_bounded(c)) return fail(ErrorCode::Unsupported, "an unbounded line has no outline");
      out.path.push_back(to(Kind::Line, {evaluate(c, line->range.hi)}));
    } else if (const auto* polyline = std::get_if<Polyline>(&c.shape)) {
      for (std::size_t i = 1; i < polyline->points.size(); ++i) out.path.push_back(to(Kind::Line, {polyline->points[i]}));
    } else if (const auto* circle = std::get_if<Circle>(&c.shape); circle && flat(c)) {
      add_arc(c, circle->frame, circle->radius, circle->radius, out.path);
    } else if (const auto* ellipse = std::get_if<Ellipse>(&c.shape); ellipse && flat(c)) {
      add_arc(c, ellipse->frame, ellipse->a, ellipse->b, out.path);
    } else if (const auto* composite = std::get_if<CompositeCurve>(&c.shape)) {
      for (const CompositeCurve::Segment& s : composite->segments)
        if (auto done = add(s.reversed ? reversed(*s.curve) : *s.curve); !done) return done;
    } else if (const auto* nurbs = std::get_if<NurbsCurve>(&c.shape)) {
      return pieces(*nurbs);
    } else {
      return approximated(c);
    }
    return {};
  }
};

}  // namespace

Result<PathOfCurve> path_of(const Curve& curve, double tolerance_mm) {
  if (!is_bounded(curve)) return fail(ErrorCode::Unsupported, "an unbounded curve has no outline");
  Writer writer{{}, tolerance_mm};
  writer.out.path.push_back(to(Kind::Move, {start_point(curve)}));
  if (auto done = writer.add(curve); !done) return tl::unexpected(done.error());
  const Point start = start_point(curve), end = end_point(curve);
  if (start.x == end.x && start.y == end.y) writer.out.path.push_back(to(Kind::Close, {}));
  return std::move(writer.out);
}

}  // namespace trimloop::io
