#include "kernel/intersect/strand.h"

#include "kernel/pcurve/deviation.h"

namespace trimloop::detail {
namespace {

const Parameters& end_of(const Strand& s, bool at_end) {
  return at_end ? s.stretches.back().x1 : s.stretches.front().x0;
}
const Stretch& stretch_at(const Strand& s, bool at_end) { return at_end ? s.stretches.back() : s.stretches.front(); }

void reverse(Strand& s) {
  std::reverse(s.stretches.begin(), s.stretches.end());
  for (Stretch& t : s.stretches) std::swap(t.x0, t.x1);
}

template <class T>
T hermite(const T& p, const T& dp, const T& q, const T& dq, double h, double x) {
  const double y = 1 - x;
  return (y * y * (1 + 2 * x)) * p + (x * x * (1 + 2 * y)) * q + (x * y * y * h) * dp + (-x * x * y * h) * dq;
}

// Parameters for a step along `tangent`: least squares; nothing where the surface has no two directions.
bool pull_back(const Surface& s, Uv at, Vector tangent, Uv& step) {
  Point p;
  Vector du, dv;
  jet1(s, at, p, du, dv);
  const double a = dot(du, du), b = dot(du, dv), c = dot(dv, dv), det = a * c - b * b;
  if (!(det > 1e-12 * a * c)) return false;
  const double x = dot(du, tangent), y = dot(dv, tangent);
  step = {(c * x - b * y) / det, (a * y - b * x) / det};
  return is_finite(step);
}

}  // namespace

void Weaver::add(std::size_t pair, const Chain& c) {
  Strand s;
  s.tangential = c.tangential;
  s.closed = c.closed;
  for (std::size_t i = 0; i + 1 < c.nodes.size(); ++i)
    s.stretches.push_back({pair, c.arcs[i], c.nodes[i], c.nodes[i + 1], {}});
  if (!s.stretches.empty()) strands_.push_back(std::move(s));
}

Parameters Weaver::own(const Stretch& s, const Parameters& x) const {
  const Bezier &p = a_.pieces[pairs_[s.pair].a], &q = b_.pieces[pairs_[s.pair].b];
  const Uv a = map_from_nurbs(a_.nurbs, {p.u.at(x[0]), p.v.at(x[1])});
  const Uv b = map_from_nurbs(b_.nurbs, {q.u.at(x[2]), q.v.at(x[3])});
  return {a.u + s.shift[0], a.v + s.shift[1], b.u + s.shift[2], b.v + s.shift[3]};
}

Point Weaver::point(const Stretch& s, const Parameters& x) const {
  const Bezier &p = a_.pieces[pairs_[s.pair].a], &q = b_.pieces[pairs_[s.pair].b];
  return midpoint(evaluate(p, x[0], x[1]), evaluate(q, x[2], x[3])) + to_vector(origin_);
}

// `towards`: another point of the stretch, ahead when sign > 0.
Weaver::Node Weaver::node(const Stretch& s, const Parameters& x, Point towards, double sign) const {
  Node n;
  n.point = point(s, x);
  const Parameters o = own(s, x);
  n.a = {o[0], o[1]};
  n.b = {o[2], o[3]};
  const PairOfPieces& pair = pairs_[s.pair];
  Parameters step{};
  const Vector chord = sign * (towards - n.point);
  const bool known =
      arc_direction(a_.pieces[pair.a], b_.pieces[pair.b], pair.cells.arcs[s.arc].system, x, step, n.tangent);
  if (known && dot(n.tangent, chord) < 0) n.tangent = -n.tangent;
  if (!known || dot(n.tangent, chord) < 0.5 * norm(chord)) n.tangent = normalized(chord);
  if (!pull_back(a_.surface, n.a, n.tangent, n.da)) n.da = {infinity, 0};
  if (!pull_back(b_.surface, n.b, n.tangent, n.db)) n.db = {infinity, 0};
  return n;
}

// ---- Joining

// Whether the two ends are one place of both surfaces; `shift`: what brings the second strand's parameters there.
bool Weaver::match(const Strand& s, bool s_end, const Strand& t, bool t_end, Parameters& shift) const {
  if (s.tangential != t.tangential) return false;
  const Stretch &x = stretch_at(s, s_end), &y = stretch_at(t, t_end);
  if (distance(point(x, end_of(s, s_end)), point(y, end_of(t, t_end))) > near_) return false;
  const Parameters p = own(x, end_of(s, s_end)), q = own(y, end_of(t, t_end));
  const double periods[4] = {a_.period_u, a_.period_v, b_.period_u, b_.period_v};
  const auto span = [](const Interval& i) { return i.length(); };
  const double ranges[4] = {span(a_.nurbs.surface.range_u()), span(a_.nurbs.surface.range_v()),
                            span(b_.nurbs.surface.range_u()), span(b_.nurbs.surface.range_v())};
  for (int i = 0; i < 4; ++i) {
    const double turns = periods[i] > 0 ? std::round((p[i] - q[i]) / periods[i]) : 0;
    shift[i] = turns * periods[i];
    if (std::abs(p[i] - q[i] - shift[i]) > 1e-6 * ranges[i]) return false;
  }
  return true;
}

void Weaver::drop_doubles() {
  // A branch along the border of two pieces is found by both.
  std::vector<Strand> kept;
  for (Strand& s : strands_) {
    const auto middle = [this](const Strand& t) {
      const Stretch& m = t.stretches[t.stretches.size() / 2];
      return point(m, m.x0);
    };
    const Point p0 = point(s.stretches.front(), s.stretches.front().x0),
                p1 = point(s.stretches.back(), s.stretches.back().x1);
    bool known = false;
    for (const Strand& t : kept) {
      const Point q0 = point(t.stretches.front(), t.stretches.front().x0),
                  q1 = point(t.stretches.back(), t.stretches.back().x1);
      const bool same_ends = (distance(p0, q0) <= near_ && distance(p1, q1) <= near_) ||
                             (distance(p0, q1) <= near_ && distance(p1, q0) <= near_);
      if (!same_ends || s.tangential != t.tangential || s.closed != t.closed) continue;
      const Point m = middle(s);
      // The other's nearest node and its neighbours: within what arcs of such stretches bend.
      double nearest = infinity, step = 0;
      for (const Stretch& y : t.stretches) {
        const Point a = point(y, y.x0), b = point(y, y.x1);
        const Vector d = b - a;
        const double f = dot(d, d) > 0 ? std::clamp(dot(m - a, d) / dot(d, d), 0.0, 1.0) : 0;
        const double off = distance(m, a + f * d);
        if (off < nearest) nearest = off, step = norm(d);
      }
      known = known || nearest <= 0.02 * step + near_;
    }
    if (!known) kept.push_back(std::move(s));
  }
  strands_ = std::move(kept);
}

void Weaver::join() {
  bool joined = true;
  while (joined) {
    joined = false;
    for (std::size_t i = 0; i < strands_.size() && !joined; ++i)
      for (const bool end : {true, false}) {
        if (strands_[i].closed) break;
        std::size_t partners = 0, j = 0;
        bool j_end = false;
        Parameters shift{};
        for (std::size_t k = 0; k < strands_.size(); ++k)
          for (const bool k_end : {true, false}) {
            if (strands_[k].closed || (k == i && k_end == end)) continue;
            Parameters by{};
            if (!match(strands_[i], end, strands_[k], k_end, by)) continue;
            ++partners;
            j = k, j_end = k_end, shift = by;
          }
        if (partners != 1) continue;
        if (j == i) {
          if (shift == Parameters{} || strands_[i].stretches.size() > 1) strands_[i].closed = true;
          joined = true;
          break;
        }
        Strand &one = strands_[i], two = strands_[j];
        if (!end) reverse(one);
        if (j_end) reverse(two);
        for (Stretch& s : two.stretches)
          for (int c = 0; c < 4; ++c) s.shift[c] += shift[c];
        one.stretches.insert(one.stretches.end(), two.stretches.begin(), two.stretches.end());
        strands_.erase(strands_.begin() + static_cast<std::ptrdiff_t>(j));
        joined = true;
        break;
      }
  }
}

// ---- Fitting

bool Weaver::good(const Stretch&, const std::array<Node, 2>& ends, double tolerance) const {
  const Node &p = ends[0], &q = ends[1];
  const double h = distance(p.point, q.point);
  for (const double x : {0.5, 0.2, 0.8}) {
    const Vector c = hermite(to_vector(p.point), p.tangent, to_vector(q.point), q.tangent, h, x);
    const Uv a = hermite(p.a, p.da, q.a, q.da, h, x), b = hermite(p.b, p.db, q.b, q.db, h, x);
    if (!(norm(to_vector(evaluate(a_.surface, a)) - c) <= tolerance)) return false;
    if (!(norm(to_vector(evaluate(b_.surface, b)) - c) <= tolerance)) return false;
  }
  return true;
}

void Weaver::fit_stretch(const Stretch& whole, double tolerance, std::vector<std::array<Node, 2>>& out) const {
  const PairOfPieces& pair = pairs_[whole.pair];
  const Bezier &p = a_.pieces[pair.a], &q = b_.pieces[pair.b];
  const SurfaceArc& arc = pair.cells.arcs[whole.arc];
  std::vector<Stretch> open{whole};
  constexpr std::size_t most = 20000;
  while (!open.empty()) {
    const Stretch s = open.back();
    open.pop_back();
    const Point from = point(s, s.x0), to = point(s, s.x1);
    std::array<Node, 2> ends{node(s, s.x0, to, 1), node(s, s.x1, from, -1)};
    const double h = distance(from, to);
    // At poles the way in is all that is known.
    const auto tame = [h](Uv x, Uv y, Uv& d) {
      if (!is_finite(d)) d = (1 / std::max(h, 1e-300)) * (y - x);
    };
    tame(ends[0].a, ends[1].a, ends[0].da), tame(ends[0].b, ends[1].b, ends[0].db);
    tame(ends[0].a, ends[1].a, ends[1].da), tame(ends[0].b, ends[1].b, ends[1].db);
    Parameters middle{};
    for (int i = 0; i < 4; ++i) middle[i] = 0.5 * (s.x0[i] + s.x1[i]);
    const bool short_enough = !(h > 1e-9 * size_);
    if (short_enough || out.size() > most || good(s, ends, tolerance) ||
        !solve_on_arc(p, q, arc.system, arc.k, middle)) {
      if (h > 1e-13 * size_) out.push_back(ends);
      continue;
    }
    Stretch one = s, two = s;
    one.x1 = two.x0 = middle;
    open.push_back(two);
    open.push_back(one);
  }
}

Result<IntersectionBranch> Weaver::fit(const Strand& strand, double tolerance) const {
  std::vector<std::array<Node, 2>> parts;
  for (const Stretch& s : strand.stretches) fit_stretch(s, tolerance, parts);
  if (parts.empty()) return fail(ErrorCode::Degenerate, "a branch of an intersection has no length", 0.0);
  std::vector<Point> space, first, second;
  std::vector<double> knots(4, 0.0);
  double t = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Node &p = parts[i][0], &q = parts[i][1];
    const double h = distance(p.point, q.point), third = h / 3;
    const auto put = [&](Point c, Uv a, Uv b) {
      space.push_back(c);
      first.push_back({a.u, a.v, 0});
      second.push_back({b.u, b.v, 0});
    };
    put(p.point, p.a, p.b);
    put(p.point + third * p.tangent, p.a + third * p.da, p.b + third * p.db);
    put(q.point - third * q.tangent, q.a - third * q.da, q.b - third * q.db);
    t += h;
    if (i + 1 < parts.size())
      knots.insert(knots.end(), 3, t);
    else
      put(q.point, q.a, q.b);
  }
  knots.insert(knots.end(), 4, t);
  if (strand.closed) space.back() = space.front();
  const auto c = NurbsCurve::from_cartesian(3, knots, space, {}), a = NurbsCurve::from_cartesian(3, knots, first, {}),
             b = NurbsCurve::from_cartesian(3, knots, second, {});
  if (!c || !a || !b) return tl::unexpected<Error>(!c ? c.error() : !a ? a.error() : b.error());
  IntersectionBranch out{Curve{*c}, Curve2{Curve{*a}}, Curve2{Curve{*b}}, infinity, strand.closed, strand.tangential,
                         0};
  const Interval range{0, t};
  DeviationOptions how;
  how.ratio = 1.3;
  how.enough_mm = 2 * tolerance;
  how.parts = 64 * parts.size() + 1024;
  out.bound_mm = std::max(deviation(out.first, range, a_.surface, out.curve, range, how).bound_mm,
                          deviation(out.second, range, b_.surface, out.curve, range, how).bound_mm);
  return out;
}

Result<std::vector<IntersectionBranch>> Weaver::branches(double fit_mm) {
  drop_doubles();
  join();
  std::vector<IntersectionBranch> out;
  for (const Strand& s : strands_) {
    double tolerance = 0.5 * fit_mm;
    Result<IntersectionBranch> best = fit(s, tolerance);
    for (int attempt = 0; attempt < 3 && best && best->bound_mm > fit_mm; ++attempt) {
      tolerance *= 0.2;
      Result<IntersectionBranch> finer = fit(s, tolerance);
      if (finer && finer->bound_mm < best->bound_mm) best = std::move(finer);
    }
    if (!best) {
      if (best.error().code == ErrorCode::Degenerate) continue;
      return tl::unexpected<Error>(best.error());
    }
    out.push_back(std::move(*best));
  }
  return out;
}

}  // namespace trimloop::detail
