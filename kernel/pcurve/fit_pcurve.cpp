#include "kernel/pcurve/fit_pcurve.h"

#include <algorithm>

#include "kernel/pcurve/flat.h"
#include "kernel/pcurve/deviation.h"

namespace trimloop::pcurve {
namespace {

struct Knot {
  double t = 0;
  Uv uv;
  Uv before, after;    // d(uv)/dt on either side
  double off_mm = 0;   // distance of the curve from the surface
  const Pole* pole = nullptr;
};

Uv hermite(const Knot& a, const Knot& b, double t) {
  const double h = b.t - a.t, x = (t - a.t) / h, y = 1 - x;
  return y * y * (1 + 2 * x) * a.uv + x * x * (1 + 2 * y) * b.uv + (x * y * y * h) * a.after + (-x * x * y * h) * b.before;
}

class Fitter {
 public:
  Fitter(const Sheet& sheet, const Curve& curve, Interval range, double fit_mm, double tolerance_mm)
      : sheet_(sheet), curve_(curve), range_(range), fit_mm_(fit_mm), tolerance_mm_(tolerance_mm) {}

  Result<FittedPcurve> run(std::optional<ParameterHint> hint) {
    if (!walk(hint)) return fail(ErrorCode::NoConvergence, "a trimming curve could not be projected onto its surface");
    refine();
    return result();
  }

 private:
  // 1. Knots at all corners of the curve and some between, each projected from its neighbour.
  bool walk(std::optional<ParameterHint> hint) {
    const std::vector<double> places = first_places();
    knots_.resize(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) knots_[i].t = places[i];
    std::size_t begin = places.size() / 2;
    bool found = false;
    if (hint) {
      begin = std::abs(hint->t - range_.lo) <= std::abs(hint->t - range_.hi) ? 0 : places.size() - 1;
      found = place(knots_[begin], hint->uv) && !knots_[begin].pole &&
              knots_[begin].off_mm <= std::max(tolerance_mm_, fit_mm_);
      if (found) found = leave(knots_[begin]);
    }
    if (!found) {
      // From the middle: ends may lie at poles, where half of the answer is undetermined.
      begin = places.size() / 2;
      if (!place_anywhere(knots_[begin]) || !leave(knots_[begin])) return false;
    }
    for (std::size_t i = begin; i + 1 < knots_.size(); ++i) {
      while (is_far(knots_[i], knots_[i + 1])) insert_between(i);
      if (!step(knots_[i], knots_[i + 1])) return false;
    }
    for (std::size_t i = begin; i > 0; --i) {
      while (is_far(knots_[i], knots_[i - 1])) insert_between(i - 1), ++i;
      if (!step(knots_[i], knots_[i - 1])) return false;
    }
    return true;
  }

  // A step of so large a part of a turn that the next sheet might be taken for this one.
  bool is_far(const Knot& from, const Knot& to) const {
    constexpr std::size_t most_knots = 4096;
    const double h = to.t - from.t;
    if (from.pole || knots_.size() >= most_knots || std::abs(h) < 1e-4 * range_.length()) return false;
    const Uv d = h * (h > 0 ? from.after : from.before);
    const auto far = [](double step, double period) { return period > 0 && std::abs(step) > 0.2 * period; };
    return far(d.u, sheet_.period_u()) || far(d.v, sheet_.period_v());
  }
  void insert_between(std::size_t i) {
    Knot middle;
    middle.t = 0.5 * (knots_[i].t + knots_[i + 1].t);
    knots_.insert(knots_.begin() + static_cast<std::ptrdiff_t>(i) + 1, middle);
  }

  std::vector<double> first_places() const {
    std::vector<double> stops{range_.lo};
    for (double b : breaks(curve_))
      if (b > stops.back() && b < range_.hi) stops.push_back(b);
    stops.push_back(range_.hi);
    const std::size_t spans = stops.size() - 1;
    const bool straight = std::holds_alternative<Line>(curve_.shape) || std::holds_alternative<Polyline>(curve_.shape);
    // A full turn needs steps well under half a period to be followed.
    const std::size_t between = spans >= 16 ? 1 : straight ? 2 : std::max<std::size_t>(2, 8 / spans);
    std::vector<double> places;
    for (std::size_t i = 0; i < spans; ++i)
      for (std::size_t k = 0; k < between; ++k)
        places.push_back(Interval{stops[i], stops[i + 1]}.at(double(k) / double(between)));
    places.push_back(range_.hi);
    return places;
  }

  bool take(Knot& k, const SurfaceFoot& foot, Point p) {
    if (!is_finite(foot.uv) || !std::isfinite(foot.distance)) return false;
    k.uv = foot.uv;
    k.off_mm = foot.distance;
    k.pole = sheet_.pole_at(foot.uv, p, tolerance_mm_);
    return true;
  }

  bool place(Knot& k, Uv near) {
    const Point p = evaluate(curve_, k.t);
    return is_finite(p) && take(k, sheet_.foot_near(p, near), p);
  }

  bool place_anywhere(Knot& k) {
    const Point p = evaluate(curve_, k.t);
    return is_finite(p) && take(k, sheet_.foot(p), p);
  }

  // Tangents of the pcurve at a knot, from the derivative of (C - S) . Su = 0 = (C - S) . Sv: where the curve lies on
  // the surface, C' = Su u' + Sv v'. At corners one on either side.
  bool leave(Knot& k) {
    Point p;
    Vector du, dv;
    sheet_.jet(k.uv, p, du, dv);
    double a = dot(du, du), b = dot(du, dv), c = dot(dv, dv);
    if (k.off_mm > fit_mm_) {
      const SurfaceJet j = jet(sheet_.surface(), sheet_.home(k.uv));
      const Vector up = evaluate(curve_, k.t) - p;
      const double aa = a - dot(up, j.duu), bb = b - dot(up, j.duv), cc = c - dot(up, j.dvv);
      // Beyond the centre of curvature the foot is no nearest point: the plain tangent does no harm there.
      if (aa > 0.1 * a && cc > 0.1 * c && aa * cc - bb * bb > 0.1 * (a * c - b * b)) a = aa, b = bb, c = cc;
    }
    const double det = a * c - b * b;
    const auto solve = [&](Vector d) -> Uv {
      const double x = dot(du, d), y = dot(dv, d);
      if (det > 1e-14 * a * c) return {(c * x - b * y) / det, (a * y - b * x) / det};
      return {a > c ? x / a : 0, c >= a && c > 0 ? y / c : 0};
    };
    const double nudge = 1e-9 * range_.length();
    k.after = solve(jet(curve_, std::min(k.t, range_.hi - nudge)).d1);
    k.before = k.t - nudge > range_.lo ? solve(jet(curve_, k.t - nudge).d1) : k.after;
    return is_finite(k.after) && is_finite(k.before);
  }

  // From a placed knot to its neighbour.
  bool step(const Knot& from, Knot& to) {
    const double h = to.t - from.t;
    const Uv tangent = h > 0 ? from.after : from.before;
    Uv guess = from.uv + h * tangent;
    // Far tangents mislead more than they help.
    const auto tame = [](double d, double period, Interval range) {
      const double most = period > 0 ? 0.3 * period : range.is_bounded() ? 0.5 * range.length() : infinity;
      return std::clamp(d, -most, most);
    };
    guess = {from.uv.u + tame(guess.u - from.uv.u, sheet_.period_u(), sheet_.domain().u),
             from.uv.v + tame(guess.v - from.uv.v, sheet_.period_v(), sheet_.domain().v)};
    if (!place(to, guess)) return false;
    const double expected = std::max({from.off_mm * 2, tolerance_mm_, fit_mm_});
    if (to.off_mm > expected) {
      Knot other = to;
      if (place(other, from.uv) && other.off_mm < to.off_mm) to = other;
      constexpr int most_searches = 16;
      if (to.off_mm > expected && searches_ < most_searches) {
        ++searches_;
        other = to;
        if (place_anywhere(other) && other.off_mm < 0.5 * to.off_mm) {
          to = other;
          to.uv.u += near_turn(from.uv.u, to.uv.u, sheet_.period_u());
          to.uv.v += near_turn(from.uv.v, to.uv.v, sheet_.period_v());
        }
      }
    }
    if (to.pole) return arrive(from, to);
    return leave(to);
  }

  static double near_turn(double from, double to, double period) {
    return period > 0 ? period * std::round((from - to) / period) : 0;
  }

  // At a pole the free parameter is what the curve arrives with.
  bool arrive(const Knot& from, Knot& pole) {
    const double h = pole.t - from.t;
    const Uv tangent = h > 0 ? from.after : from.before;
    Uv uv = from.uv;
    (pole.pole->at_v ? uv.v : uv.u) = pole.pole->value;
    (pole.pole->at_v ? uv.u : uv.v) += h * (pole.pole->at_v ? tangent.u : tangent.v);
    pole.uv = uv;
    pole.before = pole.after = (1 / h) * (uv - from.uv);
    if (pole.t > range_.lo && pole.t < range_.hi) {
      // Through the pole: on the other side the free parameter may be another; it is found from the next point on.
      pole.after = pole.before;
    }
    return true;
  }

  // 2. Halving where the spline leaves the projection. The projection of a curve that is not on the surface may jump, and
  // then no number of knots is enough.
  void refine() {
    constexpr std::size_t most_knots = 4096, most_more_off_surface = 256;
    const std::size_t most_off_surface = std::min(most_knots, knots_.size() + most_more_off_surface);
    double seen_off_mm = 0;
    for (const Knot& k : knots_) seen_off_mm = std::max(seen_off_mm, k.off_mm);
    std::vector<Knot> done{knots_.front()};
    std::vector<Knot> todo(knots_.rbegin(), knots_.rend() - 1);
    const double shortest = 1e-6 * range_.length();
    while (!todo.empty()) {
      const Knot a = done.back(), b = todo.back();
      const double t = 0.5 * (a.t + b.t);
      const Uv uv = hermite(a, b, t);
      const Point p = evaluate(curve_, t);
      const Point here = sheet_.point(uv);
      const double off = distance(here, p);
      Knot middle;
      middle.t = t;
      const bool is_off_surface = seen_off_mm > std::max(tolerance_mm_, fit_mm_);
      const bool may_halve =
          b.t - a.t > shortest && done.size() + todo.size() < (is_off_surface ? most_off_surface : most_knots);
      // What counts is how far it is from the projection. A curve that is off the surface itself asks for less.
      constexpr double share = 1e-4;
      const double allowed = std::max(fit_mm_, share * std::max(a.off_mm, b.off_mm));
      if (!(off <= allowed) && may_halve && place(middle, uv) && !middle.pole &&
          distance(here, sheet_.point(middle.uv)) > allowed && leave(middle)) {
        seen_off_mm = std::max(seen_off_mm, middle.off_mm);
        todo.push_back(middle);
        continue;
      }
      gap_mm_ = std::max({gap_mm_, off, a.off_mm, b.off_mm});
      done.push_back(b);
      todo.pop_back();
    }
    knots_ = std::move(done);
  }

  Result<FittedPcurve> result() const {
    if (is_straight()) {
      const Curve2 line = make_line2(knots_.front().uv, knots_.back().uv);
      return FittedPcurve{line, trimloop::range(line), gap_mm_};
    }
    std::vector<Point> poles;
    std::vector<double> knots(4, range_.lo);
    const auto add = [&](Uv p) { poles.push_back({p.u, p.v, 0}); };
    add(knots_.front().uv);
    for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
      const Knot &a = knots_[i], &b = knots_[i + 1];
      const double third = (b.t - a.t) / 3;
      add(a.uv + third * a.after);
      add(b.uv - third * b.before);
      if (i + 2 == knots_.size()) break;
      const bool corner = norm(b.after - b.before) > 1e-6 * (norm(b.after) + norm(b.before));
      if (corner) add(b.uv);
      knots.insert(knots.end(), corner ? 3u : 2u, b.t);
    }
    add(knots_.back().uv);
    knots.insert(knots.end(), 4, range_.hi);
    auto nurbs = NurbsCurve::from_cartesian(3, std::move(knots), poles, {});
    if (!nurbs) return tl::unexpected<Error>(nurbs.error());
    return FittedPcurve{Curve2{Curve{std::move(*nurbs)}}, range_, gap_mm_};
  }

  // All knots at even speed on one straight line.
  bool is_straight() const {
    const Uv a = knots_.front().uv, d = knots_.back().uv - a;
    const double size = std::abs(d.u) + std::abs(d.v);
    for (const Knot& k : knots_) {
      const double x = (k.t - range_.lo) / range_.length();
      const Uv off = k.uv - (a + x * d), turn = range_.length() * k.after - d;
      if (!(std::abs(off.u) + std::abs(off.v) <= 1e-10 * size)) return false;
      if (!k.pole && !(std::abs(turn.u) + std::abs(turn.v) <= 1e-6 * size)) return false;
    }
    return size > 0;
  }

  const Sheet& sheet_;
  const Curve& curve_;
  Interval range_;
  double fit_mm_, tolerance_mm_;
  std::vector<Knot> knots_;
  double gap_mm_ = 0;
  int searches_ = 0;
};

// What was seen between the knots becomes a bound, where one is found in reasonable time.
void prove(const Sheet& sheet, const Curve& curve, Interval range, double fit_mm, double tolerance_mm, FittedPcurve& f) {
  DeviationOptions how;
  how.ratio = 1.1;
  how.floor_mm = 0.5 * fit_mm;
  how.enough_mm = std::max(fit_mm, 1.1 * f.gap_mm);
  how.parts = 64;
  if (f.gap_mm > tolerance_mm) how.parts_of_piece = 2;  // a curve that is not the boundary: how far it is off does not decide
  how.period_u = sheet.covers_u() ? 0 : sheet.period_u();
  how.period_v = sheet.covers_v() ? 0 : sheet.period_v();
  const Deviation d = deviation(f.pcurve, f.range, sheet.surface(), curve, range, how);
  if (!(d.bound_mm <= 1.5 * std::max(d.measured_mm, f.gap_mm) + fit_mm)) return;
  f.gap_mm = d.bound_mm;
  f.proven = true;
}

}  // namespace

Result<FittedPcurve> fit_pcurve(const Sheet& sheet, const Curve& curve, Interval range, std::optional<ParameterHint> hint,
                                double fit_mm, double tolerance_mm) {
  if (auto flat = flattened(sheet, curve, range)) return std::move(*flat);
  auto fitted = Fitter(sheet, curve, range, fit_mm, tolerance_mm).run(hint);
  if (fitted) prove(sheet, curve, range, fit_mm, tolerance_mm, *fitted);
  return fitted;
}

}  // namespace trimloop::pcurve
