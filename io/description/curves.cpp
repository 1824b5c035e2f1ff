#include <fmt/format.h>

#include <algorithm>

#include "io/description/shapes.h"
#include "kernel/geometry/approximate.h"
#include "kernel/nurbs/bezier.h"
#include "kernel/nurbs/construct_conic.h"
#include "kernel/nurbs/fit.h"
#include "kernel/nurbs/periodic.h"
#include "kernel/splines/beta_spline.h"
#include "kernel/splines/biarc.h"
#include "kernel/splines/interpolating.h"
#include "kernel/splines/procedural.h"
#include "kernel/splines/transcendental.h"

namespace trimloop::io::description {

namespace {

using Made = std::optional<CurveShape>;

constexpr int highest_degree = 64;

Made made(Fields& f, Result<NurbsCurve> curve, double bound = 0) {
  if (!f.good()) return std::nullopt;
  if (!curve) {
    f.impossible(curve.error());
    return std::nullopt;
  }
  return CurveShape{{std::move(*curve)}, bound};
}

Made exact(Fields& f, Curve curve) {
  if (!f.good()) return std::nullopt;
  return CurveShape{std::move(curve), 0};
}

std::vector<double> weights(Fields& f, std::size_t count) {
  std::vector<double> w = f.numbers_or_none("weights");
  if (!w.empty() && w.size() != count)
    f.wrong("weights", fmt::format("{} weights for {} points", w.size(), count), static_cast<double>(w.size()), static_cast<double>(count));
  return w;
}

Made bezier(Fields& f) {
  const auto points = f.points("points", 2);
  const auto w = weights(f, points.size());
  if (!f.good()) return std::nullopt;
  std::vector<double> knots(points.size(), 0.0);
  knots.insert(knots.end(), points.size(), 1.0);
  return made(f, NurbsCurve::from_cartesian(static_cast<int>(points.size()) - 1, std::move(knots), points, w));
}

Made nurbs(Fields& f) {
  const int degree = f.integer("degree", 1, highest_degree);
  auto points = f.points("points", 2);
  auto w = weights(f, points.size());
  if (f.flag("periodic")) {  // the first `degree` poles come again at the end, over uniform knots
    const std::size_t n = points.size();
    for (std::size_t i = 0; i < static_cast<std::size_t>(degree) && n > 0; ++i) {
      points.push_back(points[i % n]);
      if (!w.empty()) w.push_back(w[i % n]);
    }
    std::vector<double> knots;
    for (std::size_t i = 0; i < points.size() + static_cast<std::size_t>(degree) + 1; ++i) knots.push_back(static_cast<double>(i) - degree);
    return made(f, NurbsCurve::from_cartesian(degree, std::move(knots), points, w));
  }
  auto knots = knots_of(f, "knots", "ends", degree, points.size());
  return made(f, NurbsCurve::from_cartesian(degree, std::move(knots), points, w));
}

// A polynomial in t over [lo, hi]: in powers of (t - lo) / (hi - lo) by repeated Horner division, then in Bernstein form.
Result<NurbsCurve> of_power_series(const std::vector<Point>& coefficients, Interval over) {
  std::vector<Hpoint> c;
  for (const Point& p : coefficients) c.push_back({p.x, p.y, p.z, c.empty() ? 1.0 : 0.0});
  const std::size_t n = c.size();
  for (std::size_t k = 0; over.lo != 0 && k + 1 < n; ++k)
    for (std::size_t i = n - 1; i-- > k;) c[i] = c[i] + over.lo * c[i + 1];
  double scale = 1;
  for (std::size_t k = 1; k < n && over.length() != 1; ++k) c[k] = (scale *= over.length()) * c[k];
  std::vector<Hpoint> poles = power_to_bezier(c);
  for (Hpoint& h : poles) h.w = 1;
  std::vector<double> knots(n, over.lo);
  knots.insert(knots.end(), n, over.hi);
  return NurbsCurve::from_homogeneous(static_cast<int>(n) - 1, std::move(knots), std::move(poles));
}

// Coefficients from the constant term up; exact (seed 000 §0).
Made power(Fields& f) {
  const auto coefficients = f.points("coefficients", 1);
  const std::vector<double> range = f.numbers_or_none("range");
  if (!range.empty() && range.size() != 2) f.wrong("range", "a range has two ends", static_cast<double>(range.size()), 2);
  if (!f.good()) return std::nullopt;
  const Interval over = range.empty() ? Interval{0, 1} : Interval{range[0], range[1]};
  if (!(over.lo < over.hi)) f.wrong("range", "a range has two ends, the smaller first", over.hi, over.lo);
  if (coefficients.size() < 2) f.wrong("coefficients", "a constant is a point, no curve", 1, 2);
  if (!f.good()) return std::nullopt;
  return made(f, of_power_series(coefficients, over));
}

Made hermite(Fields& f) {
  const auto points = f.points("points", 2);
  const auto tangents = f.points("tangents", 2);
  auto at = f.numbers_or_none("parameters");
  if (f.good() && tangents.size() != points.size())
    f.wrong("tangents", fmt::format("{} tangents for {} points", tangents.size(), points.size()));
  if (at.empty())
    for (std::size_t i = 0; i < points.size(); ++i) at.push_back(static_cast<double>(i));
  if (f.good() && at.size() != points.size()) f.wrong("parameters", fmt::format("{} parameters for {} points", at.size(), points.size()));
  for (std::size_t i = 1; f.good() && i < at.size(); ++i)
    if (!(at[i] > at[i - 1])) f.wrong("parameters", "parameters ascend", at[i], at[i - 1]);
  if (!f.good()) return std::nullopt;
  std::vector<Point> poles{points[0]};
  std::vector<double> knots(4, at[0]);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double third = (at[i + 1] - at[i]) / 3;
    poles.push_back(points[i] + third * to_vector(tangents[i]));
    poles.push_back(points[i + 1] - third * to_vector(tangents[i + 1]));
    const bool last = i + 2 == points.size();
    if (last) poles.push_back(points.back());
    knots.insert(knots.end(), last ? 4 : 2, at[i + 1]);
  }
  return made(f, NurbsCurve::from_cartesian(3, std::move(knots), poles, {}));
}

Made through(Fields& f, TangentRule rule) {
  const auto points = f.points("points", 3);
  const SplineEnds ends[] = {SplineEnds::QuadraticC1, SplineEnds::QuadraticG1, SplineEnds::Dropped, SplineEnds::Closed};
  const SplineEnds end = ends[f.choice("ends", {"quadratic-c1", "quadratic-g1", "dropped", "closed"})];
  const bool uniform = rule == TangentRule::Overhauser && f.flag("uniform");
  if (!f.good()) return std::nullopt;
  return made(f, uniform ? overhauser_uniform(points, end) : spline_through(points, rule, end));
}

Made beta(Fields& f) {
  const auto points = f.points("points", 4);
  const BetaShape shape{f.number_or("bias", 1), f.number_or("tension", 0)};
  if (!f.good()) return std::nullopt;
  return made(f, beta_spline(points, shape));
}

Made interpolated(Fields& f) {
  const auto points = f.points("points", 2);
  const int degree = f.integer_or("degree", 3, 1, 25);
  const Spacing spacings[] = {Spacing::ChordLength, Spacing::Centripetal, Spacing::Uniform};
  const Spacing spacing = spacings[f.choice("spacing", {"chord-length", "centripetal", "uniform"})];
  const bool closed = f.flag("closed");
  if (!f.good()) return std::nullopt;
  auto fit = closed ? interpolate_closed(points, degree, spacing) : interpolate(points, degree, spacing);
  if (!fit) return made(f, tl::unexpected(fit.error()));
  return made(f, std::move(fit->curve));
}

Made approximated(Fields& f) {
  const auto points = f.points("points", 2);
  const double tolerance = f.positive("tolerance");
  const int degree = f.integer_or("degree", 3, 1, 25);
  if (!f.good()) return std::nullopt;
  auto fit = approximate_within(points, tolerance, degree);
  if (!fit) return made(f, tl::unexpected(fit.error()));
  return made(f, std::move(fit->curve), fit->error);
}

Frame frame(Fields& f) {
  const Point centre = f.point_or("centre", {});
  const Vector normal = to_vector(f.point_or("normal", {0, 0, 1})), x = to_vector(f.point_or("x_axis", {0, 0, 0}));
  if (f.good() && norm(normal) == 0) f.wrong("normal", "the normal has no direction", 0, 0);
  return make_frame(centre, normal, norm(x) > 0 ? x : normal.x == 0 && normal.y == 0 ? Vector{1, 0, 0} : Vector{});
}

Interval turn(Fields& f) {
  const double a = f.number_or("start_deg", 0), b = f.number_or("end_deg", a + 360);
  if (f.good() && !(b > a && b - a <= 360)) f.wrong("end_deg", "the arc runs upwards by at most a full turn", b, a + 360);
  return {a * pi / 180, b - a == 360 ? a * pi / 180 + two_pi : b * pi / 180};
}

Made circle(Fields& f) {
  const Frame at = frame(f);
  const double radius = f.positive("radius");
  const std::size_t form = f.choice("form", {"arcs", "quintic", "quartic"});
  const Interval angles = turn(f);
  if (form == 1) return made(f, quintic_circle(at, radius));
  if (form == 2) return made(f, quartic_circle(at, radius));
  return exact(f, {Circle{at, radius, angles}});
}

Made ellipse(Fields& f) {
  const Frame at = frame(f);
  const double a = f.positive("a"), b = f.positive("b");
  return exact(f, {Ellipse{at, a, b, turn(f)}});
}

Interval parameters(Fields& f) {
  const auto range = f.numbers("range");
  if (f.good() && (range.size() != 2 || !(range[0] < range[1]))) f.wrong("range", "a range has two ends, the smaller first");
  return f.good() ? Interval{range[0], range[1]} : Interval{0, 1};
}

Made parabola(Fields& f) {
  const Frame at = frame(f);
  const double focal = f.positive("focal_length");
  return exact(f, {Parabola{at, focal, parameters(f)}});
}

Made hyperbola(Fields& f) {
  const Frame at = frame(f);
  const double a = f.positive("a"), b = f.positive("b");
  return exact(f, {Hyperbola{at, a, b, parameters(f)}});
}

// Ends, the tangents' crossing and the shape weight; a negative weight is the rest of the conic.
Made conic(Fields& f) {
  const Point start = f.point("start"), apex = f.point("apex"), end = f.point("end");
  const double weight = f.number("weight");
  const double across = norm(cross(apex - start, end - apex)), size = norm(apex - start) + norm(end - apex);
  if (f.good() && !(across > 1e-12 * size * size)) f.wrong("apex", "start, apex and end lie on one line: the tangents do not cross there", across, 0);
  if (!f.good()) return std::nullopt;
  return made(f, NurbsCurve::from_cartesian(2, {0, 0, 0, 1, 1, 1}, std::vector{start, apex, end}, std::vector{1.0, weight, 1.0}));
}

Made line(Fields& f) {
  const Point a = f.point("start"), b = f.point("end");
  if (f.good() && distance(a, b) == 0) f.wrong("end", "the line has no length", 0, 0);
  return exact(f, {Line{a, b}});
}

Made polyline(Fields& f) {
  auto points = f.points("points", 2);
  if (f.flag("closed") && !points.empty()) points.push_back(points.front());
  return exact(f, {Polyline{std::move(points)}});
}

Made level(Fields& f, Result<LevelPolygon> polygon, bool closed) {
  if (!f.good()) return std::nullopt;
  if (!polygon) {
    f.impossible(polygon.error());
    return std::nullopt;
  }
  if (closed) polygon->points.push_back(polygon->points.front());
  return CurveShape{{Polyline{std::move(polygon->points)}}, polygon->bound};
}

Made corner_cutting(Fields& f) {
  const auto points = f.points("points", 2);
  const bool closed = f.flag("closed");
  const double ratio = f.number_or("ratio", 0.25);
  const int rounds = f.integer_or("rounds", 4, 0, 30);
  return level(f, cut_corners(points, closed, ratio, rounds, 1'000'000), closed);
}

Made koch_curve(Fields& f) {
  const auto points = f.points("points", 2);
  const bool closed = f.flag("closed");
  const int rounds = f.integer_or("rounds", 4, 0, 12);
  return level(f, koch(points, closed, rounds, 1'000'000), closed);
}

// Through points, or along a curve within a tolerance (seed 002 §1).
Made biarc_chain(Fields& f) {
  if (f.has("points")) {
    const auto points = f.points("points", 2);
    if (!f.good()) return std::nullopt;
    auto chain = biarcs_through(points);
    if (chain) return CurveShape{std::move(*chain), 0};
    f.impossible(chain.error());
    return std::nullopt;
  }
  const auto curve = curve_member(f, "curve");
  const double tolerance = f.positive("tolerance");
  if (!curve || !f.good()) return std::nullopt;
  auto chain = biarcs_along(*curve, tolerance);
  if (chain) return CurveShape{std::move(chain->curve), chain->bound};
  f.impossible(chain.error());
  return std::nullopt;
}

// ---- Transcendental curves, within "tolerance"

Made within(Fields& f, const SmoothCurve& curve, Interval over) {
  const double tolerance = f.has("tolerance") ? f.positive("tolerance") : 1e-4;
  if (!f.good()) return std::nullopt;
  auto spline = hermite_within(curve, over, tolerance);
  if (!spline) return made(f, tl::unexpected(spline.error()));
  return made(f, std::move(spline->curve), spline->bound);
}

Interval angles(Fields& f, std::string_view first, double otherwise, std::string_view last) {
  const double a = f.number_or(first, otherwise), b = f.number(last);
  if (f.good() && !(a < b)) f.wrong(last, "the angle runs upwards", b, a);
  return {a * pi / 180, b * pi / 180};
}

Made helix_curve(Fields& f) {
  const Frame at = frame(f);
  const double radius = f.positive("radius"), pitch = f.number("pitch"), turns = f.positive("turns");
  return within(f, helix(at, radius, pitch), {0, two_pi * turns});
}

Made sine_curve(Fields& f) {
  const Frame at = frame(f);
  const double amplitude = f.number("amplitude"), wavelength = f.positive("wavelength");
  const Interval over = parameters(f);
  return within(f, sine_wave(at, amplitude, wavelength), over);
}

Made catenary_curve(Fields& f) {
  const Frame at = frame(f);
  const double parameter = f.positive("parameter");
  const Interval over = parameters(f);
  return within(f, catenary(at, parameter), over);
}

Made cycloid_curve(Fields& f) {
  const Frame at = frame(f);
  const double radius = f.positive("radius"), arm = f.number_or("arm", radius);
  const Interval over = angles(f, "start_deg", 0, "end_deg");
  return within(f, trochoid(at, radius, arm), over);
}

Made spiral_curve(Fields& f) {
  const Frame at = frame(f);
  const bool logarithmic = f.choice("form", {"archimedean", "logarithmic"}) == 1;
  const double start = logarithmic ? f.positive("radius") : f.number_or("radius", 0);
  const double growth = logarithmic ? f.positive("factor_per_turn") : f.number("growth_per_turn");
  const Interval over = angles(f, "start_deg", 0, "end_deg");
  return within(f, logarithmic ? logarithmic_spiral(at, start, growth) : archimedean_spiral(at, start, growth), over);
}

Made involute_curve(Fields& f) {
  const Frame at = frame(f);
  const double radius = f.positive("radius");
  const Interval over = angles(f, "start_deg", 0, "end_deg");
  return within(f, involute(at, radius), over);
}

struct Maker {
  std::string_view type;
  Made (*make)(Fields&);
};
const Maker makers[] = {{"line", line}, {"polyline", polyline}, {"bezier", bezier}, {"nurbs", nurbs}, {"power", power},
                        {"hermite", hermite},
                        {"catmull-rom", [](Fields& f) { return through(f, TangentRule::CatmullRom); }},
                        {"overhauser", [](Fields& f) { return through(f, TangentRule::Overhauser); }},
                        {"beta-spline", beta}, {"interpolate", interpolated}, {"approximate", approximated}, {"circle", circle},
                        {"ellipse", ellipse}, {"parabola", parabola}, {"hyperbola", hyperbola}, {"conic", conic},
                        {"corner-cutting", corner_cutting}, {"koch", koch_curve}, {"biarcs", biarc_chain},
                        {"helix", helix_curve}, {"sine", sine_curve}, {"catenary", catenary_curve}, {"cycloid", cycloid_curve},
                        {"spiral", spiral_curve}, {"involute", involute_curve}};

const Maker* find(std::string_view type) {
  const auto found = std::find_if(std::begin(makers), std::end(makers), [&](const Maker& m) { return m.type == type; });
  return found == std::end(makers) ? nullptr : found;
}

}  // namespace

bool is_curve(std::string_view type) { return find(type) != nullptr; }

Made curve_shape(std::string_view type, Fields& f) { return find(type)->make(f); }

std::optional<NurbsCurve> described_curve(Fields& f) {
  const std::string type = f.text_or("type", "");
  if (!is_curve(type)) {
    f.wrong("type", fmt::format("\"{}\" is no curve", type));
    return std::nullopt;
  }
  auto shape = curve_shape(type, f);
  f.finish();
  if (!shape || !f.good()) return std::nullopt;
  auto nurbs = to_nurbs(shape->curve);
  if (!nurbs) {
    f.impossible(nurbs.error());
    return std::nullopt;
  }
  return std::move(nurbs->curve);
}

std::optional<NurbsCurve> curve_member(Fields& f, std::string_view name) {
  Fields inner = f.object(name);
  return inner.good() ? described_curve(inner) : std::nullopt;
}

std::vector<double> knots_of(Fields& f, std::string_view name, std::string_view ends, int degree, std::size_t count) {
  const auto p = static_cast<std::size_t>(degree);
  std::vector<double> knots = f.numbers_or_none(name);
  const std::size_t kind = f.choice(ends, {"clamped", "uniform", "bezier"});
  if (!f.good()) return {};
  if (count < p + 1) {
    f.wrong("points", fmt::format("{} points, degree {} needs {}", count, degree, p + 1), static_cast<double>(count), static_cast<double>(p + 1));
    return {};
  }
  if (!knots.empty()) {
    if (knots.size() + 2 == count + p + 1) {  // the short form: the outermost knot at each end carries nothing
      knots.insert(knots.begin(), knots.front());
      knots.push_back(knots.back());
    }
    if (knots.size() != count + p + 1)
      f.wrong(name, fmt::format("{} knots for {} points of degree {}: {} in full, or {} without the outer two", knots.size(), count, degree,
                                count + p + 1, count + p - 1),
              static_cast<double>(knots.size()), static_cast<double>(count + p + 1));
    return knots;
  }
  if (kind == 2 && (count - 1) % p != 0)
    f.wrong(ends, fmt::format("{} points are no whole number of Bézier pieces of degree {}", count, degree));
  if (kind == 1) {
    for (std::size_t i = 0; i < count + p + 1; ++i) knots.push_back(static_cast<double>(i) - degree);
    return knots;
  }
  knots.assign(p + 1, 0.0);
  const std::size_t inner = kind == 2 ? (count - 1) / p - 1 : count - p - 1;
  for (std::size_t i = 1; i <= inner; ++i) knots.insert(knots.end(), kind == 2 ? p : 1, static_cast<double>(i));
  knots.insert(knots.end(), p + 1, static_cast<double>(inner + 1));
  return knots;
}

}  // namespace trimloop::io::description
