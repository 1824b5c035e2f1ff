#include "kernel/mesh/derivative_bounds.h"

#include <optional>

#include "kernel/geometry/detail.h"
#include "kernel/mesh/bezier_piece.h"

namespace trimloop::mesh {

Ball around(const Ball& a, const Ball& b) {
  const double apart = norm(b.centre - a.centre);
  if (apart + b.radius <= a.radius) return a;
  if (apart + a.radius <= b.radius) return b;
  const double radius = 0.5 * (apart + a.radius + b.radius);
  return {a.centre + ((radius - a.radius) / apart) * (b.centre - a.centre), radius * (1 + 1e-15)};
}

namespace {

// ---- Curves

// Centres are the derivatives in the middle, radii half the interval times a bound on the next derivative.
struct CurveEnclosure {
  Interval t;
  CurveBalls& out;
  double half() const { return 0.5 * t.length(); }

  void set(std::size_t order, Vector centre, double next) { out[order] = {centre, half() * next}; }

  bool operator()(const Line& c) const {
    const Vector d = c.end - c.start;
    out = {Ball{to_vector(c.start) + t.mid() * d, half() * norm(d)}, Ball{d, 0}, Ball{}, Ball{}};
    return true;
  }
  bool trigonometric(const Frame& f, double a, double b) const {
    const double c = std::cos(t.mid()), s = std::sin(t.mid()), next = half() * std::max(std::abs(a), std::abs(b));
    const Vector even = a * c * f.x + b * s * f.y, odd = -a * s * f.x + b * c * f.y;
    out = {Ball{to_vector(f.origin) + even, next}, Ball{odd, next}, Ball{-even, next}, Ball{-odd, next}};
    return true;
  }
  bool operator()(const Circle& c) const { return trigonometric(c.frame, c.radius, c.radius); }
  bool operator()(const Ellipse& c) const { return trigonometric(c.frame, c.a, c.b); }
  bool operator()(const Parabola& c) const {
    const double m = t.mid(), f = c.focal_length, reach = std::max(std::abs(t.lo), std::abs(t.hi));
    const Vector second = 2 * f * c.frame.x;
    out = {Ball{to_vector(c.frame.origin) + f * m * m * c.frame.x + 2 * f * m * c.frame.y,
                half() * 2 * std::abs(f) * std::hypot(reach, 1.0)},
           Ball{2 * f * m * c.frame.x + 2 * f * c.frame.y, half() * norm(second)}, Ball{second, 0}, Ball{}};
    return true;
  }
  bool operator()(const Hyperbola& c) const {
    const double reach = std::max(std::abs(t.lo), std::abs(t.hi));
    const double next = half() * std::hypot(c.a, c.b) * std::cosh(reach);
    const double ch = std::cosh(t.mid()), sh = std::sinh(t.mid());
    const Vector even = c.a * ch * c.frame.x + c.b * sh * c.frame.y, odd = c.a * sh * c.frame.x + c.b * ch * c.frame.y;
    out = {Ball{to_vector(c.frame.origin) + even, next}, Ball{odd, next}, Ball{even, next}, Ball{odd, next}};
    return true;
  }
  bool operator()(const Polyline& c) const {
    if (c.points.size() < 2) return false;
    const double last = static_cast<double>(c.points.size() - 2);
    const auto i = static_cast<std::size_t>(std::clamp(std::floor(t.mid()), 0.0, last));
    const Vector d = c.points[i + 1] - c.points[i];
    out = {Ball{to_vector(c.points[i]) + (t.mid() - static_cast<double>(i)) * d, half() * norm(d)}, Ball{d, 0}, Ball{}, Ball{}};
    return true;
  }
  bool operator()(const NurbsCurve& c) const {
    const Interval domain = c.domain(), part{domain.clamp(t.lo), domain.clamp(t.hi)};
    if (!(part.length() > 0)) {
      out = {Ball{to_vector(evaluate(c, part.lo)), 0}, Ball{}, Ball{}, Ball{}};
      return true;
    }
    const int p = c.degree();
    const auto k = static_cast<std::size_t>(find_span(p, c.knots(), c.poles().size(), part.mid()));
    std::vector<Hpoint> poles(static_cast<std::size_t>(p) + 1);
    std::vector<double> weights;
    detail::bezier_weights(p, &c.knots()[k], part, weights);
    detail::bezier_poles(p, weights, &c.poles()[k - static_cast<std::size_t>(p)], 1, poles.data(), 1);
    const Point origin = c.is_rational() ? project(poles[poles.size() / 2])
                                         : Point{poles[poles.size() / 2].x, poles[poles.size() / 2].y, poles[poles.size() / 2].z};
    detail::Partials partials;
    if (!is_finite(origin) || !detail::enclose_partials(p, 0, poles, part.length(), 1, c.is_rational(), origin, partials)) return false;
    for (std::size_t i = 0; i < 4; ++i) out[i] = partials[i][0];
    out[0].centre += to_vector(origin);
    return true;
  }
  bool operator()(const OffsetCurve&) const { return false; }
  bool operator()(const CompositeCurve& c) const {
    if (c.segments.empty()) return false;
    const std::size_t i = trimloop::detail::segment_at(c, t.mid());
    const CompositeCurve::Segment& s = c.segments[i];
    const Interval own = range(*s.curve);
    const auto shifted = [&](double x) { return s.reversed ? own.hi - (x - c.starts[i]) : own.lo + (x - c.starts[i]); };
    const double a = shifted(t.lo), b = shifted(t.hi);
    if (!enclose(*s.curve, {std::min(a, b), std::max(a, b)}, out)) return false;
    if (s.reversed) out[1].centre = -out[1].centre, out[3].centre = -out[3].centre;
    return true;
  }
};

}  // namespace

bool enclose(const Curve& curve, Interval t, CurveBalls& out) { return std::visit(CurveEnclosure{t, out}, curve.shape); }

namespace {

// Borders of cells: `breaks` and equal cuts between them.
std::vector<double> cell_borders(const std::vector<double>& breaks, Interval range) {
  std::vector<double> cuts;
  for (std::size_t i = 0; i < breaks.size(); ++i)
    if ((i + 1 == breaks.size() || breaks[i + 1] > range.lo) && (i == 0 || breaks[i - 1] < range.hi)) cuts.push_back(breaks[i]);
  if (cuts.size() < 2) cuts = {range.lo, range.hi};
  const std::size_t spans = cuts.size() - 1;
  const int per_span = spans == 1 ? 6 : spans <= 3 ? 4 : spans <= 8 ? 2 : 1;
  std::vector<double> borders;
  for (std::size_t i = 0; i < spans; ++i)
    for (int k = 0; k < per_span; ++k) borders.push_back(Interval{cuts[i], cuts[i + 1]}.at(static_cast<double>(k) / per_span));
  borders.push_back(cuts.back());
  borders.front() = std::min(borders.front(), range.lo), borders.back() = std::max(borders.back(), range.hi);
  return borders;
}

// First and last cell that [x.lo, x.hi] touches; a border touched within rounding does not count.
std::array<std::size_t, 2> cells_of(const std::vector<double>& borders, Interval x) {
  const double slack = 1e-12 * (borders.back() - borders.front());
  const auto below = [&](double at) {
    const auto above = std::upper_bound(borders.begin() + 1, borders.end() - 1, at);
    return static_cast<std::size_t>(above - borders.begin()) - 1;
  };
  const std::size_t first = below(x.lo + slack), last = below(x.hi - slack);
  return {first, std::max(first, last)};
}

// A curve's balls over cells, computed when first asked for.
class CurveCells {
 public:
  CurveCells(const Curve& curve, Interval range, bool periodic) : curve_(curve), periodic_(periodic) {
    if (!periodic_) borders_ = cell_borders(breaks(curve), range);
    cells_.resize(borders_.size());
    state_.assign(borders_.size(), 0);
  }

  bool over(Interval t, CurveBalls& out) {
    if (periodic_) return enclose(curve_, t, out);  // cheap, and any place will do
    const auto [first, last] = cells_of(borders_, t);
    for (std::size_t i = first; i <= last; ++i) {
      if (state_[i] == 0) state_[i] = enclose(curve_, {borders_[i], borders_[i + 1]}, cells_[i]) ? 1 : 2;
      if (state_[i] == 2) return false;
      for (std::size_t k = 0; k < 4; ++k) out[k] = i == first ? cells_[i][k] : around(out[k], cells_[i][k]);
    }
    return true;
  }

 private:
  const Curve& curve_;
  bool periodic_;
  std::vector<double> borders_;
  std::vector<CurveBalls> cells_;
  std::vector<char> state_;
};

// Where `knots` break the smoothness, inside `range`. Ends of the domain are creases: beyond them a B-spline stands still.
// Ends of spans much narrower than the one beside them count as rough. A knot as often there as the degree is no crease
// when first derivatives agree; `rows(k)` points to the poles number k - 1, k and k + 1, `count` of them each.
struct KnotLines {
  std::vector<double> creases, rough, joins;
  double jump = 0;
};

// Bound on the jump of the first derivative where a pole row is shared by two Bézier pieces whose parameters run over
// `before` and `after`. Homogeneous derivatives may jump by a multiple of the row itself: that is no jump in space.
template <class Pole>
double jump_across(int degree, double before, double after, std::size_t count, const Pole& pole) {
  const double a = degree / before, b = degree / after;
  const auto change = [&](std::size_t j) {
    return b * (pole(1, j) + -1.0 * pole(0, j)) + -a * (pole(0, j) + -1.0 * pole(-1, j));
  };
  const Hpoint first = pole(0, 0);
  const double share = change(0).w / first.w;
  double numerator = 0, weight = 0, least = infinity, size = 0;
  const Point origin{first.x / first.w, first.y / first.w, first.z / first.w};
  for (std::size_t j = 0; j < count; ++j) {
    const Hpoint here = pole(0, j), rest = change(j) + -share * here;
    if (!(here.w > 0)) return infinity;
    least = std::min(least, here.w);
    size = std::max(size, norm(Vector{here.x / here.w - origin.x, here.y / here.w - origin.y, here.z / here.w - origin.z}));
    numerator = std::max(numerator, norm(Vector{rest.x - origin.x * rest.w, rest.y - origin.y * rest.w, rest.z - origin.z * rest.w}));
    weight = std::max(weight, std::abs(rest.w));
  }
  return (numerator + size * weight) / least;
}

template <class PoleOf>
void knot_lines(const std::vector<double>& knots, int degree, Interval domain, Interval range, double slope, std::size_t count,
                const PoleOf& pole_of, KnotLines& out) {
  constexpr double narrow = 0.05;
  constexpr double smooth = 1e-7;  // of `slope`, the size of first derivatives
  double before = 0;
  for (std::size_t i = 0; i < knots.size();) {
    std::size_t end = i;
    while (end < knots.size() && knots[end] == knots[i]) ++end;
    const double after = end < knots.size() ? knots[end] - knots[i] : 0, at = knots[i];
    const bool is_edge = before > 0 && after > 0 && (before < narrow * after || after < narrow * before);
    const int smoothness = degree - static_cast<int>(end - i);
    const bool is_end = at == domain.lo || at == domain.hi || !(before > 0) || !(after > 0);
    if (at > range.lo && at < range.hi && (is_end || is_edge || smoothness < 2)) {
      double jump = is_end || smoothness < 0 ? infinity : 0;
      if (!is_end && smoothness == 0)
        jump = jump_across(degree, before, after, count, [&](int k, std::size_t j) {
          return pole_of(static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) - 1 + k), j);
        });
      if (jump <= smooth * slope) {
        out.rough.push_back(at), out.jump = std::max(out.jump, jump);
        if (smoothness == 0) out.joins.push_back(at);
      } else {
        out.creases.push_back(at);
      }
    }
    before = after, i = end;
  }
}

Hpoint with_weight(Hpoint h, bool rational) {
  if (!rational) h.w = 1;
  return h;
}

// The same for a curve, which may be of any type.
KnotLines curve_lines(const Curve& curve, Interval range) {
  KnotLines out;
  if (const auto* nurbs = std::get_if<NurbsCurve>(&curve.shape)) {
    const double slope = norm(jet(curve, nurbs->domain().mid()).d1);
    knot_lines(nurbs->knots(), nurbs->degree(), nurbs->domain(), range, slope, 1,
               [&](std::size_t i, std::size_t) { return with_weight(nurbs->poles()[i], nurbs->is_rational()); }, out);
  } else {
    for (const double b : breaks(curve))
      if (b > range.lo && b < range.hi) out.creases.push_back(b);
  }
  return out;
}

}  // namespace

// ---- Surfaces

struct SurfaceBounds::Kind {
  Lines lines;
  virtual ~Kind() = default;
  virtual bool known() const { return true; }
  virtual bool enclose(Interval u, Interval v, HigherPartials& out) = 0;
};

namespace {

struct UnknownBounds : SurfaceBounds::Kind {
  bool known() const override { return false; }
  bool enclose(Interval, Interval, HigherPartials&) override { return false; }
};

struct PlaneBounds : SurfaceBounds::Kind {
  bool enclose(Interval, Interval, HigherPartials& out) override {
    out = {};
    return true;
  }
};

// S(u, v) = turn by u about the axis of g(v): each derivative in u is a cross product with the axis.
struct RotationBounds : SurfaceBounds::Kind {
  Point origin;
  Vector axis;
  double first_u = 0;  // angle at which the profile stands
  Curve profile;
  CurvePtr shared;     // keeps a generatrix alive
  bool periodic = false;
  std::optional<CurveCells> cells;

  Vector turned(Vector a, double c, double s) const {
    const double along = dot(a, axis);
    return along * axis + c * (a - along * axis) + s * cross(axis, a);
  }
  // Of the k-th derivative in u: k times crossed with the axis, turned to the middle of u; the rest is the arc.
  Ball turned(const Ball& b, int k, Interval u) const {
    const double angle = u.mid() - first_u + 0.5 * pi * k, c = std::cos(angle), s = std::sin(angle);
    const Vector radial = b.centre - dot(b.centre, axis) * axis;
    return {turned(k == 0 ? b.centre : radial, c, s), b.radius + 0.5 * u.length() * (norm(radial) + b.radius)};
  }
  bool enclose(Interval u, Interval v, HigherPartials& out) override {
    CurveBalls g;
    if (!cells->over(v, g)) return false;
    // Only what is across the axis counts of the value: it strays by half the interval times the slope across it.
    const Vector slope = g[1].centre - dot(g[1].centre, axis) * axis;
    const double mid = periodic ? v.mid() : range(*shared).clamp(v.mid());
    g[0] = {trimloop::evaluate(periodic ? profile : *shared, mid) - origin, 0.5 * v.length() * (norm(slope) + g[1].radius)};
    out = {turned(g[0], 2, u), turned(g[1], 1, u), turned(g[2], 0, u),
           turned(g[0], 3, u), turned(g[1], 2, u), turned(g[2], 1, u), turned(g[3], 0, u)};
    return true;
  }
};

std::unique_ptr<SurfaceBounds::Kind> rotation(const Frame& f, Curve profile, Interval v) {
  auto r = std::make_unique<RotationBounds>();
  r->origin = f.origin, r->axis = f.z;
  r->profile = std::move(profile);
  r->periodic = true;
  r->cells.emplace(r->profile, v, true);
  return r;
}

struct ExtrusionBounds : SurfaceBounds::Kind {
  CurvePtr directrix;
  std::optional<CurveCells> cells;
  bool enclose(Interval u, Interval, HigherPartials& out) override {
    CurveBalls c;
    if (!cells->over(u, c)) return false;
    out = {};
    out.uu = c[2], out.uuu = c[3];
    return true;
  }
};

// (1 - v) A + v B, each curve by an affine function of u.
struct RuledBounds : SurfaceBounds::Kind {
  CurvePtr curve[2];
  bool reversed[2]{};
  std::optional<CurveCells> cells[2];

  bool enclose(Interval u, Interval v, HigherPartials& out) override {
    std::array<CurveBalls, 2> c;
    for (std::size_t i = 0; i < 2; ++i) {
      const Interval own = range(*curve[i]);
      const double scale = reversed[i] ? -own.length() : own.length(), start = reversed[i] ? own.hi : own.lo;
      const double a = start + scale * u.lo, b = start + scale * u.hi;
      if (!cells[i]->over({std::min(a, b), std::max(a, b)}, c[i])) return false;
      c[i][1] = {scale * c[i][1].centre, std::abs(scale) * c[i][1].radius};
      c[i][2] = {scale * scale * c[i][2].centre, scale * scale * c[i][2].radius};
      c[i][3] = {scale * scale * scale * c[i][3].centre, std::abs(scale * scale * scale) * c[i][3].radius};
    }
    const double m = v.mid(), h = 0.5 * v.length();
    const auto mixed = [&](std::size_t k) {
      const Vector apart = c[1][k].centre - c[0][k].centre;
      return Ball{c[0][k].centre + m * apart, h * norm(apart) + std::max(c[0][k].radius, c[1][k].radius) * (1 + 2 * std::abs(m) + 2 * h)};
    };
    out = {};
    out.uu = mixed(2), out.uuu = mixed(3);
    out.uv = {c[1][1].centre - c[0][1].centre, c[0][1].radius + c[1][1].radius};
    out.uuv = {c[1][2].centre - c[0][2].centre, c[0][2].radius + c[1][2].radius};
    return true;
  }
};

// Cells of knot spans, cut further where spans are few, and a pyramid of blocks of cells over them, so that a wide
// rectangle asks few of them.
struct NurbsBounds : SurfaceBounds::Kind {
  const NurbsSurface& surface;
  std::vector<double> borders_u, borders_v;
  struct Level {
    std::size_t nu, nv;
    std::vector<std::uint32_t> slot;  // into pool; 0 not yet, 1 impossible
  };
  std::vector<Level> levels;
  std::vector<HigherPartials> pool;
  std::vector<std::vector<double>> weights_u, weights_v;  // of Bézier poles, by cell
  std::vector<Hpoint> rows, poles;

  NurbsBounds(const NurbsSurface& s, Interval u, Interval v) : surface(s), pool(2) {
    const auto all_breaks = [](const std::vector<double>& knots, Interval domain) {
      std::vector<double> out;
      for (const double k : knots)
        if (domain.contains(k) && (out.empty() || k > out.back())) out.push_back(k);
      return out;
    };
    borders_u = cell_borders(all_breaks(s.knots_u(), s.domain_u()), u);
    borders_v = cell_borders(all_breaks(s.knots_v(), s.domain_v()), v);
    weights_u.resize(borders_u.size()), weights_v.resize(borders_v.size());
    const SurfaceJet middle = jet(s, {s.domain_u().mid(), s.domain_v().mid()});
    KnotLines in_u, in_v;
    knot_lines(s.knots_u(), s.degree_u(), s.domain_u(), u, norm(middle.du), s.poles_v(),
               [&](std::size_t i, std::size_t j) { return with_weight(s.pole(i, j), s.is_rational()); }, in_u);
    knot_lines(s.knots_v(), s.degree_v(), s.domain_v(), v, norm(middle.dv), s.poles_u(),
               [&](std::size_t j, std::size_t i) { return with_weight(s.pole(i, j), s.is_rational()); }, in_v);
    lines = {std::move(in_u.creases), std::move(in_v.creases), std::move(in_u.rough), std::move(in_v.rough),
             std::move(in_u.joins), std::move(in_v.joins), in_u.jump, in_v.jump};
    for (std::size_t nu = borders_u.size() - 1, nv = borders_v.size() - 1;; nu = (nu + 1) / 2, nv = (nv + 1) / 2) {
      levels.push_back({nu, nv, std::vector<std::uint32_t>(nu * nv, 0)});
      if (nu == 1 && nv == 1) break;
    }
  }

  bool cell(std::size_t i, std::size_t j, HigherPartials& out) {
    const Interval u{borders_u[i], borders_u[i + 1]}, v{borders_v[j], borders_v[j + 1]};
    const int p = surface.degree_u(), q = surface.degree_v();
    const auto ku = static_cast<std::size_t>(find_span(p, surface.knots_u(), surface.poles_u(), u.mid()));
    const auto kv = static_cast<std::size_t>(find_span(q, surface.knots_v(), surface.poles_v(), v.mid()));
    const auto pu = static_cast<std::size_t>(p), qv = static_cast<std::size_t>(q);
    rows.resize((pu + 1) * (qv + 1)), poles.resize((pu + 1) * (qv + 1));
    std::vector<double>&in_u = weights_u[i], &in_v = weights_v[j];
    if (in_u.empty()) detail::bezier_weights(p, &surface.knots_u()[ku], u, in_u);
    if (in_v.empty()) detail::bezier_weights(q, &surface.knots_v()[kv], v, in_v);
    for (std::size_t k = 0; k <= qv; ++k)
      detail::bezier_poles(p, in_u, &surface.pole(ku - pu, kv - qv + k), surface.poles_v(), &rows[k], qv + 1);
    for (std::size_t k = 0; k <= pu; ++k) detail::bezier_poles(q, in_v, &rows[k * (qv + 1)], 1, &poles[k * (qv + 1)], 1);
    const Hpoint middle = poles[poles.size() / 2];
    const Point origin = surface.is_rational() ? project(middle) : Point{middle.x, middle.y, middle.z};
    detail::Partials s;
    if (!is_finite(origin) || !detail::enclose_partials(p, q, poles, u.length(), v.length(), surface.is_rational(), origin, s))
      return false;
    out = {s[2][0], s[1][1], s[0][2], s[3][0], s[2][1], s[1][2], s[0][3]};
    return true;
  }

  static void widen(HigherPartials& a, const HigherPartials& b) {
    a = {around(a.uu, b.uu), around(a.uv, b.uv), around(a.vv, b.vv),
         around(a.uuu, b.uuu), around(a.uuv, b.uuv), around(a.uvv, b.uvv), around(a.vvv, b.vvv)};
  }

  std::uint32_t block(std::size_t level, std::size_t i, std::size_t j) {
    const std::size_t at = i * levels[level].nv + j;
    if (levels[level].slot[at] != 0) return levels[level].slot[at];
    HigherPartials sum;
    bool good = true, first = true;
    if (level == 0) {
      good = cell(i, j, sum);
    } else {
      const std::size_t below = level - 1;
      for (std::size_t a = 2 * i; good && a < std::min(2 * i + 2, levels[below].nu); ++a) {
        for (std::size_t b = 2 * j; good && b < std::min(2 * j + 2, levels[below].nv); ++b) {
          const std::uint32_t s = block(below, a, b);
          good = s != 1;
          if (!good) break;
          if (first) sum = pool[s], first = false;
          else widen(sum, pool[s]);
        }
      }
    }
    if (good) pool.push_back(sum);
    return levels[level].slot[at] = good ? static_cast<std::uint32_t>(pool.size() - 1) : 1;
  }

  bool enclose(Interval u, Interval v, HigherPartials& out) override {
    auto [i0, i1] = cells_of(borders_u, u);
    auto [j0, j1] = cells_of(borders_v, v);
    std::size_t level = 0;
    for (; level + 1 < levels.size() && (i1 - i0 > 3 || j1 - j0 > 3); ++level) i0 /= 2, i1 /= 2, j0 /= 2, j1 /= 2;
    for (std::size_t i = i0; i <= i1; ++i) {
      for (std::size_t j = j0; j <= j1; ++j) {
        const std::uint32_t s = block(level, i, j);
        if (s == 1) return false;
        if (i == i0 && j == j0) out = pool[s];
        else widen(out, pool[s]);
      }
    }
    return true;
  }
};

bool is_positive(const std::vector<Hpoint>& poles) {
  return std::all_of(poles.begin(), poles.end(), [](const Hpoint& h) { return h.w > 0; });
}

bool all_known(const Curve& curve) {
  if (const auto* nurbs = std::get_if<NurbsCurve>(&curve.shape)) return !nurbs->is_rational() || is_positive(nurbs->poles());
  if (const auto* composite = std::get_if<CompositeCurve>(&curve.shape)) {
    return std::all_of(composite->segments.begin(), composite->segments.end(),
                       [](const CompositeCurve::Segment& s) { return s.curve && all_known(*s.curve); });
  }
  return !std::holds_alternative<OffsetCurve>(curve.shape);
}

struct Maker {
  Interval u, v;
  using Made = std::unique_ptr<SurfaceBounds::Kind>;

  Made operator()(const Plane&) const { return std::make_unique<PlaneBounds>(); }
  Made operator()(const Cylinder& s) const {
    const Point start = s.frame.origin + s.radius * s.frame.x;
    return rotation(s.frame, {Line{start, start + s.frame.z, {-infinity, infinity}}}, v);
  }
  Made operator()(const Cone& s) const {
    const Point start = s.frame.origin + s.radius * s.frame.x;
    return rotation(s.frame, {Line{start, start + (s.frame.z + std::tan(s.half_angle_rad) * s.frame.x), {-infinity, infinity}}}, v);
  }
  Made circle(const Frame& f, double centre, double radius) const {
    return rotation(f, {Circle{{f.origin + centre * f.x, f.x, f.z, -f.y}, radius, {-infinity, infinity}}}, v);
  }
  Made operator()(const Sphere& s) const { return circle(s.frame, 0, s.radius); }
  Made operator()(const Torus& s) const { return circle(s.frame, s.major_radius, s.minor_radius); }
  Made operator()(const Revolution& s) const {
    if (!s.generatrix || !all_known(*s.generatrix)) return std::make_unique<UnknownBounds>();
    auto r = std::make_unique<RotationBounds>();
    r->origin = s.axis_origin, r->axis = s.axis, r->first_u = 0;
    r->shared = s.generatrix;
    r->cells.emplace(*r->shared, v, false);
    KnotLines lines = curve_lines(*r->shared, v);
    r->lines.creases_v = std::move(lines.creases), r->lines.rough_v = std::move(lines.rough), r->lines.jump_v = lines.jump;
    return r;
  }
  Made operator()(const Extrusion& s) const {
    if (!s.directrix || !all_known(*s.directrix)) return std::make_unique<UnknownBounds>();
    auto r = std::make_unique<ExtrusionBounds>();
    r->directrix = s.directrix;
    r->cells.emplace(*r->directrix, u, trimloop::detail::is_periodic(*r->directrix));
    KnotLines lines = curve_lines(*r->directrix, u);
    r->lines.creases_u = std::move(lines.creases), r->lines.rough_u = std::move(lines.rough), r->lines.jump_u = lines.jump;
    return r;
  }
  Made operator()(const Ruled& s) const {
    if (!s.first || !s.second || s.equal_arc_length || !all_known(*s.first) || !all_known(*s.second))
      return std::make_unique<UnknownBounds>();
    auto r = std::make_unique<RuledBounds>();
    r->curve[0] = s.first, r->curve[1] = s.second;
    r->reversed[1] = s.second_reversed;
    for (std::size_t i = 0; i < 2; ++i) {
      const Interval own = range(*r->curve[i]);
      r->cells[i].emplace(*r->curve[i], own, false);
      const KnotLines lines = curve_lines(*r->curve[i], own);
      const auto add = [&](const std::vector<double>& from, std::vector<double>& to) {
        for (const double t : from) {
          const double f = (t - own.lo) / own.length(), at = r->reversed[i] ? 1 - f : f;
          if (at > u.lo && at < u.hi) to.push_back(at);
        }
      };
      add(lines.creases, r->lines.creases_u), add(lines.rough, r->lines.rough_u);
      r->lines.jump_u += lines.jump * own.length() * (1 + 2 * std::max(std::abs(v.lo), std::abs(v.hi)));
    }
    std::sort(r->lines.creases_u.begin(), r->lines.creases_u.end());
    std::sort(r->lines.rough_u.begin(), r->lines.rough_u.end());
    return r;
  }
  Made operator()(const OffsetSurface&) const { return std::make_unique<UnknownBounds>(); }
  Made operator()(const NurbsSurface& s) const {
    if (s.is_rational() && !is_positive(s.poles())) return std::make_unique<UnknownBounds>();
    return std::make_unique<NurbsBounds>(s, u, v);
  }
};

}  // namespace

SurfaceBounds::SurfaceBounds(const Surface& surface, Interval u, Interval v) : kind_(std::visit(Maker{u, v}, surface.shape)) {}
SurfaceBounds::~SurfaceBounds() = default;
SurfaceBounds::SurfaceBounds(SurfaceBounds&&) noexcept = default;
bool SurfaceBounds::known() const { return kind_->known(); }
const SurfaceBounds::Lines& SurfaceBounds::lines() const { return kind_->lines; }
bool SurfaceBounds::enclose(Interval u, Interval v, HigherPartials& out) { return kind_->enclose(u, v, out); }

}  // namespace trimloop::mesh
