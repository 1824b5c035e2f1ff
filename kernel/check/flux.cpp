// Area and volume of a trimmed face as a boundary integral in the parameter plane.
//
// With a density f(u, v) (|Su x Sv| for area, (p - o).(Su x Sv)/3 for volume) and F(u, v) = integral of f from u_ref
// to u, Green's theorem gives  integral of f over the face = closed integral of F dv  along its loops. The inner
// integral runs along x, the outer one along y: x = u, y = v as above, or x = v, y = u with the sign turned.
// Inner: Gauss-Legendre per span of smoothness, with a number of nodes found by trial. Outer: Gauss-Kronrod pairs over
// the pcurve pieces between all lines of reduced smoothness, halved where the estimated error is largest.

#include "kernel/check/flux.h"

#include <algorithm>
#include <array>
#include <limits>
#include <queue>

#include "kernel/check/graded_breaks.h"
#include "kernel/check/measure.h"
#include "kernel/math/gauss.h"

namespace trimloop {
namespace {

using detail::What;

struct Independence {
  bool of_u = false, of_v = false;
};

bool is_affine(const NurbsSurface& n) {
  if (n.is_rational() || n.degree_u() != 1 || n.degree_v() != 1 || n.poles_u() != 2 || n.poles_v() != 2) return false;
  const Vector twist =
      (project(n.pole(1, 1)) - project(n.pole(1, 0))) - (project(n.pole(0, 1)) - project(n.pole(0, 0)));
  const double size = norm(project(n.pole(1, 1)) - project(n.pole(0, 0)));
  return norm(twist) <= 1e-12 * size;
}

// Directions in which the density does not change.
Independence independence(const Surface& surface, What what) {
  const Surface* s = &surface;
  while (const auto* offset = std::get_if<OffsetSurface>(&s->shape)) {
    if (!offset->basis) return {};
    s = offset->basis.get();
  }
  if (what != What::Area && what != What::Volume) return {};
  const bool area = what == What::Area;
  if (std::holds_alternative<Plane>(s->shape)) return {true, true};
  if (const auto* n = std::get_if<NurbsSurface>(&s->shape)) return {is_affine(*n), is_affine(*n)};
  if (std::holds_alternative<Cylinder>(s->shape)) return {area, area};
  if (std::holds_alternative<Extrusion>(s->shape)) return {false, area};
  const bool turns = std::holds_alternative<Cone>(s->shape) || std::holds_alternative<Sphere>(s->shape) ||
                     std::holds_alternative<Torus>(s->shape) || std::holds_alternative<Revolution>(s->shape);
  return {area && turns, false};
}

struct Density {
  const Surface& surface;
  What what;
  Point origin;

  double operator()(Uv uv) const {
    Point p;
    Vector du, dv;
    jet1(surface, uv, p, du, dv);
    const Vector n = cross(du, dv);
    const Vector r = p - origin;
    const double f = value(r, n);
    return std::isfinite(f) ? f : 0;
  }

 private:
  double value(Vector r, Vector n) const {
    switch (what) {
      case What::Area:
        return norm(n);
      case What::Volume:
        return dot(r, n) / 3;
      case What::MomentX:
        return 0.5 * r.x * r.x * n.x;
      case What::MomentY:
        return 0.5 * r.y * r.y * n.y;
      case What::MomentZ:
        return 0.5 * r.z * r.z * n.z;
      case What::MomentXX:
        return r.x * r.x * r.x * n.x / 3;
      case What::MomentYY:
        return r.y * r.y * r.y * n.y / 3;
      case What::MomentZZ:
        return r.z * r.z * r.z * n.z / 3;
      case What::MomentXY:
        return 0.5 * r.x * r.x * r.y * n.x;
      case What::MomentYZ:
        return 0.5 * r.y * r.y * r.z * n.y;
      case What::MomentZX:
        return 0.5 * r.z * r.z * r.x * n.z;
      case What::AreaX:
        return r.x * norm(n);
      case What::AreaY:
        return r.y * norm(n);
      case What::AreaZ:
        return r.z * norm(n);
      case What::AreaXX:
        return r.x * r.x * norm(n);
      case What::AreaYY:
        return r.y * r.y * norm(n);
      case What::AreaZZ:
        return r.z * r.z * norm(n);
      case What::AreaXY:
        return r.x * r.y * norm(n);
      case What::AreaYZ:
        return r.y * r.z * norm(n);
      case What::AreaZX:
        return r.z * r.x * norm(n);
    }
    return 0;
  }
};

// F of the file's head comment, over the x-range [lo, hi] of the face.
class Inner {
 public:
  Inner(const Density& density, bool along_u, bool constant, Interval x, Interval y,
        const std::vector<double>& breaks_x, const std::vector<double>& breaks_y, double relative_error, bool graded)
      : density_(density), along_u_(along_u), constant_(constant), reference_(x.lo) {
    if (constant_) return;
    stops_.push_back(x.lo);
    for (double b : breaks_x)
      if (b > stops_.back() && b < x.hi) stops_.push_back(b);
    if (x.hi > stops_.back()) stops_.push_back(x.hi);
    calibrate(y, breaks_y, relative_error, graded);
  }

  double operator()(double x, double y) {
    if (x == reference_) return 0;
    if (constant_) return (x - reference_) * density_(uv(x, y));
    // Beyond the calibrated range (rounding, overshoot) the outermost rule goes on.
    double sum = 0, from = reference_;
    if (x < reference_) return span(x, reference_, y, nodes_.front()) * -1;
    for (std::size_t i = 0; i + 1 < stops_.size() && from < x; ++i) {
      const bool last = i + 2 == stops_.size();
      const double to = last ? x : std::min(x, stops_[i + 1]);
      sum += to == stops_[i + 1] ? whole_span(i, y) : span(from, to, y, nodes_[i]);
      from = to;
    }
    return sum;
  }

  double error() const { return error_; }  // relative

 private:
  Uv uv(double x, double y) const { return along_u_ ? Uv{x, y} : Uv{y, x}; }

  double span(double lo, double hi, double y, int n) const {
    const double mid = 0.5 * (lo + hi), half = 0.5 * (hi - lo);
    double sum = 0;
    for (const GaussNode& node : gauss_rule(n)) sum += node.w * density_(uv(mid + half * node.x, y));
    return half * sum;
  }

  // The integral over all of span i, as a function of y, is asked for again and again: after as many times as it costs
  // nodes, a Chebyshev polynomial between two breaks in y takes over, if its last coefficients say that it may.
  double whole_span(std::size_t i, double y) {
    const auto above = std::upper_bound(places_.begin() + 1, places_.end() - 1, y);
    const std::size_t k = static_cast<std::size_t>(above - places_.begin()) - 1;
    const Interval range{places_[k], places_[k + 1]};
    Cell& cell = cells_[i * (places_.size() - 1) + k];
    if (!cell.is_built && ++cell.uses > cell_nodes && range.contains(y)) build(cell, i, range);
    if (!cell.is_good || !range.contains(y)) return span(stops_[i], stops_[i + 1], y, nodes_[i]);
    const double t = (y - range.mid()) / (0.5 * range.length());
    double b1 = 0, b2 = 0;  // Clenshaw's recurrence
    for (std::size_t j = cell_nodes; j-- > 1;) {
      const double b0 = 2 * t * b1 - b2 + cell.coefficients[j];
      b2 = b1, b1 = b0;
    }
    return t * b1 - b2 + cell.coefficients[0];
  }

  static constexpr std::size_t cell_nodes = 14;
  // A line across the face on which rules are tried. Where all lines are of a kind the worst one counts; where breaks are
  // graded each counts by the width of the face that it stands for.
  struct Sample {
    double y, share;
  };
  double share(Interval cell) const { return graded_ ? cell.length() : 1; }

  struct Cell {
    std::size_t uses = 0;
    bool is_built = false, is_good = false;
    std::array<double, cell_nodes> coefficients{};
  };

  void build(Cell& cell, std::size_t i, Interval range) const {
    constexpr double n = cell_nodes;
    std::array<double, cell_nodes> values;
    for (std::size_t j = 0; j < cell_nodes; ++j)
      values[j] = span(stops_[i], stops_[i + 1],
                       range.mid() + 0.5 * range.length() * std::cos(pi * (double(j) + 0.5) / n), nodes_[i]);
    for (std::size_t m = 0; m < cell_nodes; ++m) {
      double sum = 0;
      for (std::size_t j = 0; j < cell_nodes; ++j) sum += values[j] * std::cos(pi * double(m) * (double(j) + 0.5) / n);
      cell.coefficients[m] = (m == 0 ? 1 : 2) * sum / n;
    }
    cell.is_built = true;
    cell.is_good =
        share(range) * (std::abs(cell.coefficients[cell_nodes - 1]) + std::abs(cell.coefficients[cell_nodes - 2])) <= allowed_;
  }

  // For each span the smallest rule that agrees with the next larger one on lines spread over the face (between any two breaks
  // where these are graded); a span on which the largest still changes is halved.
  void calibrate(Interval y, const std::vector<double>& breaks_y, double relative_error, bool graded) {
    places_ = {y.lo};
    for (double b : breaks_y)
      if (b > places_.back() && b < y.hi) places_.push_back(b);
    places_.push_back(y.hi);
    if (stops_.size() < 2) return;
    graded_ = graded;
    std::vector<Sample> lines;
    const std::size_t stride = graded ? 1 : std::max<std::size_t>(1, (places_.size() - 1) / 4);
    for (std::size_t i = 0; i + 1 < places_.size(); i += stride) {
      const Interval cell{places_[i], places_[i + 1]};
      lines.push_back({cell.at(0.31), share(cell)});
      if (places_.size() < 4) lines.push_back({cell.at(0.79), share(cell)}), lines.push_back({cell.at(0.02), share(cell)});
    }
    double scale = 0;
    for (const Sample& line : lines) {
      double whole = 0;
      for (std::size_t i = 0; i + 1 < stops_.size(); ++i) whole += std::abs(span(stops_[i], stops_[i + 1], line.y, 4));
      scale = graded ? scale + line.share * whole : std::max(scale, whole);
    }
    const double allowed = 0.1 * relative_error * scale;
    constexpr std::size_t most_spans = 4096;
    std::vector<double> done{stops_.front()};
    std::vector<Interval> todo;
    for (std::size_t i = stops_.size() - 1; i > 0; --i) todo.push_back({stops_[i - 1], stops_[i]});
    const double shortest = 1e-6 * (stops_.back() - stops_.front());
    while (!todo.empty()) {
      const Interval part = todo.back();
      todo.pop_back();
      double off = 0;
      const int n = rule_for(part, lines, allowed, off);
      if (n == 0 && part.length() > shortest && done.size() + todo.size() < most_spans) {
        todo.push_back({part.mid(), part.hi});
        todo.push_back({part.lo, part.mid()});
        continue;
      }
      done.push_back(part.hi);
      nodes_.push_back(n == 0 ? largest_gauss_rule : n);
      if (scale > 0) error_ += off / scale;
    }
    stops_ = std::move(done);
    allowed_ = allowed / double(nodes_.size());
    cells_.resize(nodes_.size() * (places_.size() - 1));
  }

  int rule_for(Interval part, const std::vector<Sample>& lines, double allowed, double& off) const {
    constexpr int rules[] = {2, 4, 6, 9, 13, 18, 24, largest_gauss_rule};
    std::vector<double> before(lines.size());
    for (std::size_t r = 0; r < std::size(rules); ++r) {
      off = 0;
      for (std::size_t k = 0; k < lines.size(); ++k) {
        const double value = span(part.lo, part.hi, lines[k].y, rules[r]);
        const double change = lines[k].share * std::abs(value - before[k]);
        off = graded_ ? off + change : std::max(off, change);
        before[k] = value;
      }
      // The smaller rule was off by `off`; the larger one is far better, so it is the one to use.
      if (r > 0 && off <= 10 * allowed) {
        off = std::min(off, allowed);
        return rules[r];
      }
    }
    return 0;
  }

  const Density& density_;
  bool along_u_, constant_;
  double reference_;
  std::vector<double> stops_;
  std::vector<int> nodes_;
  std::vector<double> places_;  // breaks in y, with both ends of the face
  std::vector<Cell> cells_;     // by span, then by place
  bool graded_ = false;
  double error_ = 0, allowed_ = 0;
};

struct Part {  // of a pcurve, without a break inside
  const Curve* pcurve;
  double t0, t1;
  double value = 0, error = 0;
  friend bool operator<(const Part& a, const Part& b) { return a.error < b.error; }
};

class FaceIntegral {
 public:
  FaceIntegral(const Body& body, const Face& face, What what, Point origin, double relative_error,
               double absolute_error = 0)
      : body_(body),
        face_(face),
        density_{*face.surface, what, origin},
        relative_error_(relative_error),
        absolute_error_(absolute_error) {}

  Measured run() {
    find_box();
    if (!(box_u_.lo <= box_u_.hi) || !(box_v_.lo <= box_v_.hi)) return {};
    choose_direction();
    Inner inner(density_, along_u_, constant_, along_u_ ? box_u_ : box_v_, along_u_ ? box_v_ : box_u_, breaks_x_,
                breaks_y_, relative_error_, graded_);
    inner_ = &inner;
    double value = 0, error = 0;
    std::vector<Part> first;
    for (const LoopId loop : face_.loops) collect(body_[loop], first, value);
    // Where there are many parts, each matters little and the small rule mostly does.
    constexpr std::size_t many = 24;
    const auto rule = first.size() > many ? kronrod_7() : kronrod_15();
    std::priority_queue<Part> parts;
    const auto add = [&](Part part) {
      integrate(part, rule);
      value += part.value;
      error += part.error;
      parts.push(part);
    };
    for (const Part& part : first) add(part);
    constexpr int most_halvings = 4000;
    for (int i = 0;
         i < most_halvings && !parts.empty() && error > std::max(relative_error_ * std::abs(value), absolute_error_);
         ++i) {
      const Part worst = parts.top();
      parts.pop();
      const double mid = 0.5 * (worst.t0 + worst.t1);
      if (mid == worst.t0 || mid == worst.t1) break;
      value -= worst.value;
      error -= worst.error;
      add({worst.pcurve, worst.t0, mid});
      add({worst.pcurve, mid, worst.t1});
    }
    const double sign = along_u_ ? 1 : -1;
    return {sign * value, std::max(error, 0.0) + (inner.error() + rounding_) * std::abs(value)};
  }

 private:
  double x_of(Point p) const { return along_u_ ? p.x : p.y; }
  double y_of(Point p) const { return along_u_ ? p.y : p.x; }
  double y_of(Vector d) const { return along_u_ ? d.y : d.x; }

  void find_box() {
    for (const LoopId loop : face_.loops)
      for (const Coedge& c : body_[loop].coedges) {
        const Interval r{std::min(c.pcurve_range.lo, c.pcurve_range.hi),
                         std::max(c.pcurve_range.lo, c.pcurve_range.hi)};
        const auto add = [&](double t) {
          const Uv p = evaluate(c.pcurve, t);
          if (!is_finite(p)) return;
          box_u_ = {std::min(box_u_.lo, p.u), std::max(box_u_.hi, p.u)};
          box_v_ = {std::min(box_v_.lo, p.v), std::max(box_v_.hi, p.v)};
        };
        add(r.lo), add(r.hi);
        if (std::holds_alternative<Line>(c.pcurve.curve.shape)) continue;
        const std::vector<double> stops = breaks(c.pcurve.curve);
        for (std::size_t i = 0; i + 1 < stops.size(); ++i)
          for (int k = 0; k < 4; ++k) add(r.clamp(Interval{stops[i], stops[i + 1]}.at(0.25 * k)));
      }
  }

  // How much of the narrowest gap two neighbouring doubles there are apart.
  static double resolution(const std::vector<double>& breaks) {
    double narrowest = infinity, largest = 0;
    for (std::size_t i = 0; i < breaks.size(); ++i) {
      largest = std::max(largest, std::abs(breaks[i]));
      if (i > 0) narrowest = std::min(narrowest, breaks[i] - breaks[i - 1]);
    }
    return std::numeric_limits<double>::epsilon() * largest / narrowest;
  }

  void choose_direction() {
    const Independence free = independence(*face_.surface, density_.what);
    const std::vector<double> u = breaks_u(*face_.surface), v = breaks_v(*face_.surface);
    const auto spans = [](const std::vector<double>& breaks, Interval range) {
      return std::count_if(breaks.begin(), breaks.end(), [&](double b) { return range.lo < b && b < range.hi; });
    };
    along_u_ = free.of_u || (!free.of_v && spans(u, box_u_) <= spans(v, box_v_));
    constant_ = along_u_ ? free.of_u : free.of_v;
    const bool flat = free.of_u && free.of_v;
    if (flat) return;
    const std::vector<double> close_u = detail::graded_breaks_u(*face_.surface, u), close_v = detail::graded_breaks_v(*face_.surface, v);
    graded_ = close_u.size() > u.size() || close_v.size() > v.size();
    if (graded_) rounding_ = resolution(close_u) + resolution(close_v);
    breaks_x_ = along_u_ ? close_u : close_v;
    breaks_y_ = along_u_ ? close_v : close_u;
    if (constant_) breaks_x_.clear();
  }

  // The parts of a loop, and straight steps over the small jumps between its coedges.
  void collect(const Loop& loop, std::vector<Part>& parts, double& value) const {
    const std::size_t n = loop.coedges.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Coedge& c = loop.coedges[i];
      const double t0 = c.reversed ? c.pcurve_range.hi : c.pcurve_range.lo;
      const double t1 = c.reversed ? c.pcurve_range.lo : c.pcurve_range.hi;
      const Uv end = end_uv(body_, c), next = start_uv(body_, loop.coedges[(i + 1) % n]);
      if (end.u != next.u || end.v != next.v) value += step(end, next);
      if (contributes(c.pcurve.curve)) split(c.pcurve.curve, t0, t1, parts);
    }
  }

  bool contributes(const Curve& pcurve) const {
    const auto* line = std::get_if<Line>(&pcurve.shape);
    if (!line) return true;
    if (y_of(line->start) == y_of(line->end)) return false;
    const double reference = along_u_ ? box_u_.lo : box_v_.lo;
    return x_of(line->start) != reference || x_of(line->end) != reference;
  }

  double step(Uv a, Uv b) const {
    const Point p{a.u, a.v, 0}, q{b.u, b.v, 0};
    double sum = 0;
    for (const GaussNode& node : gauss_rule(4)) {
      const Point at = p + 0.5 * (node.x + 1) * (q - p);
      sum += 0.5 * node.w * (*inner_)(x_of(at), y_of(at));
    }
    return sum * (y_of(q) - y_of(p));
  }

  void split(const Curve& pcurve, double t0, double t1, std::vector<Part>& parts) const {
    const double lo = std::min(t0, t1), hi = std::max(t0, t1);
    std::vector<double> stops{lo};
    for (double b : breaks(pcurve))
      if (b > stops.back() && b < hi) stops.push_back(b);
    stops.push_back(hi);
    std::vector<double> all;
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      all.push_back(stops[i]);
      add_crossings(pcurve, stops[i], stops[i + 1], all);
    }
    all.push_back(hi);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    const bool backwards = t0 > t1;
    for (std::size_t i = 0; i + 1 < all.size(); ++i)
      parts.push_back(backwards ? Part{&pcurve, all[i + 1], all[i]} : Part{&pcurve, all[i], all[i + 1]});
  }

  // Parameters where a smooth piece crosses a line of reduced smoothness.
  void add_crossings(const Curve& pcurve, double lo, double hi, std::vector<double>& out) const {
    if (breaks_x_.size() <= 2 && breaks_y_.size() <= 2) return;
    const int samples = std::holds_alternative<Line>(pcurve.shape) ? 1 : 12;
    double t_before = lo;
    Point before = evaluate(pcurve, lo);
    for (int k = 1; k <= samples; ++k) {
      const double t = Interval{lo, hi}.at(double(k) / samples);
      const Point here = evaluate(pcurve, t);
      add_crossings(pcurve, breaks_x_, true, t_before, t, before, here, out);
      add_crossings(pcurve, breaks_y_, false, t_before, t, before, here, out);
      t_before = t;
      before = here;
    }
  }

  void add_crossings(const Curve& pcurve, const std::vector<double>& lines, bool is_x, double ta, double tb, Point a,
                     Point b, std::vector<double>& out) const {
    const double fa = is_x ? x_of(a) : y_of(a), fb = is_x ? x_of(b) : y_of(b);
    auto it = std::upper_bound(lines.begin(), lines.end(), std::min(fa, fb));
    for (; it != lines.end() && *it < std::max(fa, fb); ++it) {
      double lo = ta, hi = tb, glo = fa - *it, ghi = fb - *it;
      for (int i = 0; i < 60 && glo != 0 && ghi != 0; ++i) {  // regula falsi, Illinois variant
        const double t = (lo * ghi - hi * glo) / (ghi - glo);
        const Point p = evaluate(pcurve, t);
        const double g = (is_x ? x_of(p) : y_of(p)) - *it;
        if (!(t > std::min(lo, hi)) || !(t < std::max(lo, hi))) break;
        if ((g > 0) == (ghi > 0)) {
          hi = t, ghi = g, glo *= 0.5;
        } else {
          lo = hi, glo = ghi, hi = t, ghi = g;
        }
        if (std::abs(hi - lo) <= 1e-14 * (std::abs(hi) + std::abs(lo))) break;
      }
      const double t = glo == 0 ? lo : hi;
      if (t > std::min(ta, tb) && t < std::max(ta, tb)) out.push_back(t);
    }
  }

  // Gauss-Kronrod with QUADPACK's error estimate.
  void integrate(Part& part, std::span<const KronrodNode> rule) const {
    const double mid = 0.5 * (part.t0 + part.t1), half = 0.5 * (part.t1 - part.t0);
    double values[15], kronrod = 0, gauss = 0, spread = 0;
    for (std::size_t i = 0; i < rule.size(); ++i) {
      const CurveJet j = jet(*part.pcurve, mid + half * rule[i].x);
      const double dy = y_of(j.d1);
      values[i] = dy == 0 ? 0 : dy * (*inner_)(x_of(j.point), y_of(j.point));
      kronrod += rule[i].kronrod * values[i];
      gauss += rule[i].gauss * values[i];
    }
    for (std::size_t i = 0; i < rule.size(); ++i) spread += rule[i].kronrod * std::abs(values[i] - 0.5 * kronrod);
    const double difference = std::abs(kronrod - gauss);
    part.value = half * kronrod;
    part.error = spread > 0 ? spread * std::min(1.0, std::pow(200 * difference / spread, 1.5)) * std::abs(half)
                            : difference * std::abs(half);
    if (!std::isfinite(part.value)) part.value = 0, part.error = 0;
  }

  const Body& body_;
  const Face& face_;
  Density density_;
  double relative_error_, absolute_error_;
  Interval box_u_{infinity, -infinity}, box_v_{infinity, -infinity};
  bool along_u_ = true, constant_ = false;
  bool graded_ = false;  // the density differs by powers of ten between breaks
  double rounding_ = 0;  // relative error that comes of parameters being doubles, where that matters
  std::vector<double> breaks_x_, breaks_y_;
  Inner* inner_ = nullptr;
};

}  // namespace

Measured area(const Body& body, FaceId id, double relative_error) {
  const Face& face = body[id];
  if (face.status == FaceStatus::Failed || !face.surface) return {};
  return FaceIntegral(body, face, What::Area, {}, relative_error).run();
}

Measured volume_contribution(const Body& body, FaceId id, Point origin, double relative_error) {
  const Face& face = body[id];
  if (face.status == FaceStatus::Failed || !face.surface) return {};
  Measured m = FaceIntegral(body, face, What::Volume, origin, relative_error).run();
  if (face.reversed) m.value = -m.value;
  return m;
}

Vector moment_contribution(const Body& body, FaceId id, Point origin, double relative_error, double absolute_error) {
  const Face& face = body[id];
  if (face.status == FaceStatus::Failed || !face.surface) return {};
  const auto along = [&](What what) {
    return FaceIntegral(body, face, what, origin, relative_error, absolute_error).run().value;
  };
  const Vector m{along(What::MomentX), along(What::MomentY), along(What::MomentZ)};
  return face.reversed ? -m : m;
}

Measured detail::face_integral(const Body& body, FaceId id, What what, Point origin, double relative_error,
                               double absolute_error) {
  const Face& face = body[id];
  if (face.status == FaceStatus::Failed || !face.surface) return {};
  return FaceIntegral(body, face, what, origin, relative_error, absolute_error).run();
}

}  // namespace trimloop
