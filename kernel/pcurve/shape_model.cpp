#include "kernel/pcurve/shape_model.h"

#include "kernel/geometry/detail.h"
#include "kernel/nurbs/basis.h"

namespace trimloop::detail {
namespace {

using Model = TaylorModel;
constexpr std::size_t most_spans = 4;  // touched at once; beyond that the interval is too long to be worth it

CurveModel unknown_curve() { return {{Model::unknown(), 0, 0}, {Model::unknown(), 0, 0}}; }
SurfaceModel unknown_surface() {
  const ModelPoint p{Model::unknown(), 0, 0};
  return {p, p, p};
}

// The shape is `a` or `b` at each parameter: a model that holds both.
void absorb(Model& a, const Model& b) { a.widen((a - b).magnitude()); }
void absorb(ModelPoint& a, const ModelPoint& b) { absorb(a.x, b.x), absorb(a.y, b.y), absorb(a.z, b.z); }
void absorb(CurveModel& a, const CurveModel& b) { absorb(a.point, b.point), absorb(a.d1, b.d1); }
void absorb(SurfaceModel& a, const SurfaceModel& b) {
  absorb(a.point, b.point), absorb(a.du, b.du), absorb(a.dv, b.dv);
}

// The evaluators hold still beyond the domain; clamping moves the parameter by no more than it sticks out.
Model clamped(Model t, Interval domain) {
  const double out = std::max({0.0, domain.lo - t.lower(), t.upper() - domain.hi});
  return t.widen(out);
}

// ---- NURBS: models of the basis functions

struct Homogeneous {
  Model x, y, z, w{0};
  // The pole is taken about `origin`, so that radii grow with the size of the net and not with its place.
  void add(const Hpoint& h, Point origin, const Model& n, bool rational) {
    x.add(h.x - h.w * origin.x, n);
    y.add(h.y - h.w * origin.y, n);
    z.add(h.z - h.w * origin.z, n);
    if (rational) w.add(h.w, n);
  }
  void add(const Homogeneous& row, const Model& n, bool rational) {
    x += n * row.x;
    y += n * row.y;
    z += n * row.z;
    if (rational) w += n * row.w;
  }
};

// The degree + 1 functions of a span whose knots begin at at[0], as in kernel/nurbs/basis.h. A2.2, eq. 2.7.
struct BasisModels {
  std::vector<Model> value, slope;
  BasisModels(int degree, const double* at, const Model& t, bool slopes) {
    value.resize(static_cast<std::size_t>(degree) + 1);
    value[0] = 1;
    for (int j = 1; j <= degree; ++j) {
      if (slopes && j == degree) derive(j, at);
      Model carried(0);
      for (int r = 0; r < j; ++r) {
        const double a = at[r + 1 - j];
        Model& n = value[static_cast<std::size_t>(r)];
        const Model right = 1 / (at[r + 1] - a) * ((t - Model(a)) * n);
        n = carried + (n - right);
        carried = right;
      }
      value[static_cast<std::size_t>(j)] = carried;
    }
  }

 private:
  void derive(int j, const double* at) {
    slope.assign(static_cast<std::size_t>(j) + 1, Model(0));
    for (int r = 0; r < j; ++r) {
      const Model right = j / (at[r + 1] - at[r + 1 - j]) * value[static_cast<std::size_t>(r)];
      slope[static_cast<std::size_t>(r)] += -right;
      slope[static_cast<std::size_t>(r) + 1] += right;
    }
  }
};

ModelPoint numerator(const Homogeneous& h) { return {h.x, h.y, h.z}; }
// The quotient rule; `p` about the same origin as the poles.
ModelPoint derivative(const Homogeneous& d, const ModelPoint& p, const Model& over_w, bool rational) {
  return rational ? over_w * (numerator(d) - d.w * p) : numerator(d);
}
Point origin_of(const Hpoint& h) {  // of a pole that has a place; any place will do
  const Point p = h.w != 0 ? project(h) : Point{};
  return is_finite(p) ? p : Point{};
}

// Spans that an interval touches, at most most_spans + 1 of them.
std::vector<std::size_t> spans(const std::vector<double>& knots, int degree, std::size_t poles, const Model& t) {
  const std::size_t p = static_cast<std::size_t>(degree);
  const Interval domain{knots[p], knots[poles]};
  std::size_t k = span_of(knots.data(), p, poles, domain.clamp(t.lower()));
  std::vector<std::size_t> out{k};
  while (out.size() <= most_spans) {
    do ++k;
    while (k < poles && !(knots[k] < knots[k + 1]));
    if (k >= poles || !(knots[k] < t.upper())) break;
    out.push_back(k);
  }
  return out;
}

CurveModel over_span(const NurbsCurve& c, std::size_t k, const Model& t) {
  const std::size_t p = static_cast<std::size_t>(c.degree());
  const bool rational = c.is_rational();
  const Point origin = origin_of(c.poles()[k - p / 2]);
  const BasisModels basis(c.degree(), &c.knots()[k], t, true);
  Homogeneous value, slope;
  for (std::size_t i = 0; i <= p; ++i) {
    value.add(c.poles()[k - p + i], origin, basis.value[i], rational);
    slope.add(c.poles()[k - p + i], origin, basis.slope[i], rational);
  }
  const Model over_w = rational ? reciprocal(value.w) : Model(1);
  const ModelPoint point = rational ? over_w * numerator(value) : numerator(value);
  return {origin + point, derivative(slope, point, over_w, rational)};
}

SurfaceModel over_span(const NurbsSurface& s, std::size_t ku, std::size_t kv, const Model& u, const Model& v,
                       bool with_slopes) {
  const std::size_t p = static_cast<std::size_t>(s.degree_u()), q = static_cast<std::size_t>(s.degree_v());
  const bool rational = s.is_rational();
  const Point origin = origin_of(s.pole(ku - p / 2, kv - q / 2));
  const BasisModels along_u(s.degree_u(), &s.knots_u()[ku], u, with_slopes),
      along_v(s.degree_v(), &s.knots_v()[kv], v, with_slopes);
  Homogeneous value, slope_u, slope_v;
  for (std::size_t i = 0; i <= p; ++i) {
    Homogeneous row, row_slope;
    for (std::size_t j = 0; j <= q; ++j) {
      const Hpoint& pole = s.pole(ku - p + i, kv - q + j);
      row.add(pole, origin, along_v.value[j], rational);
      if (with_slopes) row_slope.add(pole, origin, along_v.slope[j], rational);
    }
    value.add(row, along_u.value[i], rational);
    if (!with_slopes) continue;
    slope_u.add(row, along_u.slope[i], rational);
    slope_v.add(row_slope, along_u.value[i], rational);
  }
  const Model over_w = rational ? reciprocal(value.w) : Model(1);
  const ModelPoint point = rational ? over_w * numerator(value) : numerator(value);
  if (!with_slopes) return {origin + point, {}, {}};
  return {origin + point, derivative(slope_u, point, over_w, rational), derivative(slope_v, point, over_w, rational)};
}

// ---- Curves

struct OfCurve {
  const Model& t;

  CurveModel operator()(const Line& c) const {
    const Vector d = c.end - c.start;
    return {c.start + t * d, {d.x, d.y, d.z}};
  }
  CurveModel conic(const Frame& f, double a, double b, const Model& c, const Model& s, double sign) const {
    return {f.origin + (a * c * f.x + b * s * f.y), sign * (a * s) * f.x + b * c * f.y};
  }
  CurveModel operator()(const Circle& c) const { return (*this)(Ellipse{c.frame, c.radius, c.radius, c.range}); }
  CurveModel operator()(const Ellipse& c) const {
    Model sine, cosine;
    sin_cos(t, sine, cosine);
    return conic(c.frame, c.a, c.b, cosine, sine, -1);
  }
  CurveModel operator()(const Hyperbola& c) const {
    Model sine, cosine;
    sinh_cosh(t, sine, cosine);
    return conic(c.frame, c.a, c.b, cosine, sine, 1);
  }
  CurveModel operator()(const Parabola& c) const {
    const double f = c.focal_length;
    const Vector y = 2 * f * c.frame.y;
    return {c.frame.origin + (f * square(t) * c.frame.x + t * y), 2 * f * t * c.frame.x + Model(1) * y};
  }
  CurveModel operator()(const Polyline& c) const {
    const std::size_t n = c.points.size();
    if (n < 2) return unknown_curve();
    std::vector<double> knots{0};
    for (std::size_t i = 0; i < n; ++i) knots.push_back(static_cast<double>(i));
    knots.push_back(static_cast<double>(n - 1));
    const Model in = clamped(t, {0, static_cast<double>(n - 1)});
    const auto piece = [&](std::size_t k) {
      const Point a = c.points[k - 1];
      const Vector d = c.points[k] - a;
      return CurveModel{a + (in - Model(static_cast<double>(k - 1))) * d, {d.x, d.y, d.z}};
    };
    return united(spans(knots, 1, n, in), piece);
  }
  CurveModel operator()(const NurbsCurve& c) const { return model(c, t); }
  CurveModel operator()(const CompositeCurve& c) const {
    if (c.segments.empty()) return unknown_curve();
    std::vector<std::size_t> touched;
    for (std::size_t i = 0; i < c.segments.size(); ++i) {
      if (!(c.starts[i + 1] > c.starts[i])) continue;
      const bool first = touched.empty() && i + 1 == c.segments.size();
      if ((t.upper() >= c.starts[i] && t.lower() <= c.starts[i + 1]) || first) touched.push_back(i);
    }
    if (touched.empty()) return unknown_curve();
    const auto piece = [&](std::size_t i) {
      const CompositeCurve::Segment& s = c.segments[i];
      const Interval r = range(*s.curve);
      const Model from_start = clamped(t, {c.starts[i], c.starts[i + 1]}) - Model(c.starts[i]);
      CurveModel m = model(*s.curve, s.reversed ? Model(r.hi) - from_start : Model(r.lo) + from_start);
      if (s.reversed) m.d1 = Model(-1) * m.d1;
      return m;
    };
    return united(touched, piece);
  }
  CurveModel operator()(const OffsetCurve& c) const {
    if (!c.basis || std::holds_alternative<OffsetCurve>(c.basis->shape)) return unknown_curve();
    const CurveModel b = model(*c.basis, t);
    const ModelPoint side = cross(b.d1, {c.normal.x, c.normal.y, c.normal.z});
    const Model over_length = reciprocal(sqrt(dot(side, side)));
    return {b.point + c.distance * over_length * side, unknown_curve().d1};
  }

  template <class Piece>
  static CurveModel united(const std::vector<std::size_t>& touched, Piece piece) {
    if (touched.size() > most_spans) return unknown_curve();
    CurveModel m = piece(touched[0]);
    for (std::size_t i = 1; i < touched.size(); ++i) absorb(m, piece(touched[i]));
    return m;
  }
};

// ---- Surfaces

struct OfSurface {
  const Model &u, &v;
  bool slopes;

  SurfaceModel operator()(const Plane& s) const {
    const Vector x = s.frame.x, y = s.frame.y;
    return {s.frame.origin + (u * x + v * y), {x.x, x.y, x.z}, {y.x, y.y, y.z}};
  }
  // origin + rho e(u) + h z
  SurfaceModel turned(const Frame& f, const Model& rho, const Model& h, const Model& rho1, const Model& h1) const {
    Model sine, cosine;
    sin_cos(u, sine, cosine);
    const ModelPoint e = cosine * f.x + sine * f.y, across = cosine * f.y + -sine * f.x;
    return {f.origin + (rho * e + h * f.z), rho * across, rho1 * e + h1 * f.z};
  }
  SurfaceModel operator()(const Cylinder& s) const { return turned(s.frame, s.radius, v, 0, 1); }
  SurfaceModel operator()(const Cone& s) const {
    const double slope = std::tan(s.half_angle_rad);
    return turned(s.frame, Model(s.radius) + slope * v, v, slope, 1);
  }
  SurfaceModel circular(const Frame& f, double centre, double radius) const {
    Model sine, cosine;
    sin_cos(v, sine, cosine);
    return turned(f, Model(centre) + radius * cosine, radius * sine, -radius * sine, radius * cosine);
  }
  SurfaceModel operator()(const Sphere& s) const { return circular(s.frame, 0, s.radius); }
  SurfaceModel operator()(const Torus& s) const { return circular(s.frame, s.major_radius, s.minor_radius); }
  SurfaceModel operator()(const Revolution& s) const {
    if (!s.generatrix) return unknown_surface();
    const CurveModel c = model(*s.generatrix, v);
    Model sine, cosine;
    sin_cos(u, sine, cosine);
    const Vector a = s.axis;
    const ModelPoint axis{a.x, a.y, a.z};
    const auto turn = [&](const ModelPoint& p) {
      const ModelPoint along = dot(p, axis) * axis;
      return along + cosine * (p - along) + sine * cross(axis, p);
    };
    const Point o = s.axis_origin;
    const ModelPoint arm = c.point - ModelPoint{o.x, o.y, o.z};
    const ModelPoint along = dot(arm, axis) * axis;
    return {o + turn(arm), cosine * cross(axis, arm) - sine * (arm - along), turn(c.d1)};
  }
  SurfaceModel operator()(const Extrusion& s) const {
    if (!s.directrix) return unknown_surface();
    const CurveModel c = model(*s.directrix, u);
    return {c.point + v * s.direction, c.d1, {s.direction.x, s.direction.y, s.direction.z}};
  }
  SurfaceModel operator()(const Ruled& s) const {
    if (!s.first || !s.second) return unknown_surface();
    const auto even = [](const CurvePtr& c) {
      return std::holds_alternative<Line>(c->shape) || std::holds_alternative<Circle>(c->shape);
    };
    if (s.equal_arc_length && !(even(s.first) && even(s.second))) return unknown_surface();
    const auto side = [&](const CurvePtr& c, bool reversed) {
      const Interval r = range(*c);
      const double span = reversed ? -r.length() : r.length();
      CurveModel m = model(*c, Model(reversed ? r.hi : r.lo) + span * u);
      m.d1 = Model(span) * m.d1;
      return m;
    };
    const CurveModel a = side(s.first, false), b = side(s.second, s.second_reversed);
    const ModelPoint across = b.point - a.point;
    return {a.point + v * across, a.d1 + v * (b.d1 - a.d1), across};
  }
  SurfaceModel operator()(const OffsetSurface& s) const {
    if (!s.basis || std::holds_alternative<OffsetSurface>(s.basis->shape)) return unknown_surface();
    const SurfaceModel b = model(*s.basis, u, v);
    const ModelPoint n = cross(b.du, b.dv);
    const SurfaceModel none = unknown_surface();
    return {b.point + s.distance * reciprocal(sqrt(dot(n, n))) * n, none.du, none.dv};
  }
  SurfaceModel operator()(const NurbsSurface& s) const { return model(s, u, v, slopes); }
};

}  // namespace

CurveModel model(const NurbsCurve& c, const TaylorModel& t) {
  if (!t.is_finite()) return unknown_curve();
  const Model in = clamped(t, c.domain());
  return OfCurve::united(spans(c.knots(), c.degree(), c.poles().size(), in),
                         [&](std::size_t k) { return over_span(c, k, in); });
}

SurfaceModel model(const NurbsSurface& s, const TaylorModel& u, const TaylorModel& v, bool slopes) {
  if (!u.is_finite() || !v.is_finite()) return unknown_surface();
  const Model in_u = clamped(u, s.domain_u()), in_v = clamped(v, s.domain_v());
  const std::vector<std::size_t> along_u = spans(s.knots_u(), s.degree_u(), s.poles_u(), in_u),
                                 along_v = spans(s.knots_v(), s.degree_v(), s.poles_v(), in_v);
  if (along_u.size() > most_spans || along_v.size() > most_spans) return unknown_surface();
  SurfaceModel m = over_span(s, along_u[0], along_v[0], in_u, in_v, slopes);
  for (std::size_t i = 0; i < along_u.size(); ++i)
    for (std::size_t j = i == 0 ? 1 : 0; j < along_v.size(); ++j)
      absorb(m, over_span(s, along_u[i], along_v[j], in_u, in_v, slopes));
  return m;
}

CurveModel model(const Curve& c, const TaylorModel& t) {
  if (!t.is_finite()) return unknown_curve();
  return std::visit(OfCurve{t}, c.shape);
}
SurfaceModel model(const Surface& s, const TaylorModel& u, const TaylorModel& v, bool slopes) {
  if (!u.is_finite() || !v.is_finite()) return unknown_surface();
  return std::visit(OfSurface{u, v, slopes}, s.shape);
}

}  // namespace trimloop::detail
