#include "kernel/mesh/certificate_detail.h"

namespace trimloop::mesh {

using namespace certificate_detail;

namespace {

using Spread = DerivativeNets::Spread;
using Seconds = DerivativeNets::Seconds;
using Thirds = DerivativeNets::Thirds;

constexpr int halvings_of_flow = 2;

// The second derivative along a and b: middle of its range, and half of it.
double bend(const Seconds& d, Uv a, Uv b) {
  return a.u * b.u * d[0].mid + (a.u * b.v + a.v * b.u) * d[1].mid + a.v * b.v * d[2].mid;
}
double sway(const Seconds& d, Uv a, Uv b) {
  return std::abs(a.u * b.u) * d[0].half + (std::abs(a.u * b.v) + std::abs(a.v * b.u)) * d[1].half + std::abs(a.v * b.v) * d[2].half;
}

// The rectangle around a triangle of the parameter plane, and its sides, side i opposite to corner i.
struct Domain {
  Interval u, v;
  std::array<Uv, 3> side;

  explicit Domain(const std::array<Uv, 3>& uv)
      : u(spread(uv[0].u, uv[1].u, uv[2].u)), v(spread(uv[0].v, uv[1].v, uv[2].v)),
        side{uv[2] - uv[1], uv[2] - uv[0], uv[1] - uv[0]} {}

  // What a function strays from the quadratic with its corners and the middles of the ranges.
  double rest(const Seconds& d) const {
    return linear * (u.length() * u.length() * d[0].half + 2 * u.length() * v.length() * d[1].half + v.length() * v.length() * d[2].half);
  }
  // What it strays from the linear function with its corners.
  double linear_rest(const Seconds& d) const {
    return linear * (u.length() * u.length() * d[0].largest() + 2 * u.length() * v.length() * d[1].largest() +
                     v.length() * v.length() * d[2].largest());
  }
  // Deviation from the linear function at the middles of the sides.
  std::array<double, 3> bows(const Seconds& d) const {
    return {-0.125 * bend(d, side[0], side[0]), -0.125 * bend(d, side[1], side[1]), -0.125 * bend(d, side[2], side[2])};
  }
  double cubed(const Thirds& d, std::size_t i) const {
    const double a = side[i].u, b = side[i].v;
    return a * a * (a * d[0].mid + 3 * b * d[1].mid) + b * b * (3 * a * d[2].mid + b * d[3].mid);
  }
  double cubed_sway(const Thirds& d, double a, double b) const {
    return a * a * (a * d[0].half + 3 * b * d[1].half) + b * b * (3 * a * d[2].half + b * d[3].half);
  }
  Cubic cubic(const Thirds& d) const {
    const Uv p = side[2], q = side[1];
    const double a01 = cubed(d, 2) / 12, a20 = -cubed(d, 1) / 12, a12 = cubed(d, 0) / 12;
    const double mixed = p.u * p.u * (q.u * d[0].mid + q.v * d[1].mid) + 2 * p.u * p.v * (q.u * d[1].mid + q.v * d[2].mid) +
                         p.v * p.v * (q.u * d[2].mid + q.v * d[3].mid);
    return {a01, a12, a20, a12 + 3 * a01 - a20 - 0.5 * mixed};
  }
  // What it strays from the quadratic through its six points.
  double rest(const Thirds& d) const {
    const Cubic c = cubic(d);
    return cubic_share * std::max({std::abs(c.a01), std::abs(c.a12), std::abs(c.a20)}) + std::abs(c.bubble) / 27 +
           lagrange * cubed_sway(d, u.length(), v.length());
  }
};

// How far the barycentric coordinate k of a facet may be below zero over its piece.
struct Beyond {
  double curve;  // on side k
  double more;   // elsewhere
  double slope;  // it is at least slope l_k above what it is on the side, unless that is negative
};

// On a ray from corner k to a place y of side k it is at least (1 - l) of that at y and l (1 - (1 - l) most / 2), `most` being the
// largest second derivative towards the side. All is times the weight.
Beyond beyond(const Domain& domain, const Seconds& d, std::size_t k, double weight) {
  const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
  const auto bend_of = [&](std::size_t s) { return bend(d, domain.side[s], domain.side[s]); };
  const auto sway_of = [&](std::size_t s) { return sway(d, domain.side[s], domain.side[s]); };
  const double along = bend_of(k);
  const double most = std::max(bend_of(i), bend_of(j)) + 0.25 * std::max(0.0, -along) + std::max(sway_of(i), sway_of(j));
  const double excess = most - 2 * weight;
  return {0.125 * std::max(0.0, along + sway_of(k)) / weight, excess > 0 ? excess * excess / (8 * most * weight) : 0, 1 - 0.5 * std::max(0.0, most) / weight};
}

// Largest value where l_k is at most `depth`, of a function that is zero at the corners: on the side, and from there
// towards corner k.
double beside_side(const Domain& domain, const Seconds& d, std::size_t k, double depth) {
  const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
  const auto sway_of = [&](std::size_t s) { return sway(d, domain.side[s], domain.side[s]); };
  const std::array<double, 3> m = domain.bows(d);
  const double inward = std::min(depth, 0.25);
  return std::abs(m[k]) + 0.125 * sway_of(k) + inward * (4 * std::max(std::abs(m[i]), std::abs(m[j])) + 0.5 * std::max(sway_of(i), sway_of(j)));
}

// Largest distance from a facet of a place of its plane that lies beyond side k by at most out[k], for each k.
double beyond_all(const Facet& f, const std::array<double, 3>& out) {
  double farthest = 0;
  for (std::size_t k = 0; k < 3; ++k) {  // at corner k, where the sides beside it meet
    const Vector a = f.corner[(k + 1) % 3] - f.corner[k], b = f.corner[(k + 2) % 3] - f.corner[k];
    const double sine = f.area / (norm(a) * norm(b)), cosine = dot(a, b) / (norm(a) * norm(b));
    // Distances i and j from the lines of two sides that meet at that angle, on their outer sides: |p|^2 sin^2 = i^2 + j^2 + 2 i j cos.
    const double i = out[(k + 1) % 3], j = out[(k + 2) % 3];
    farthest = std::max({farthest, i, j, std::sqrt(std::max(0.0, i * i + j * j + 2 * i * j * cosine)) / sine});
  }
  return farthest;
}

// What is known of the first derivatives within a facet's plane, of which t[0] and t[1] are an orthonormal basis.
struct Slopes {
  std::array<Vector, 2> t;
  std::array<DerivativeNets::Firsts, 2> d;

  // Range of the derivative along e of the component along g, a vector of the plane.
  Interval along(Vector g, Uv e) const {
    double mid = 0, half = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      const double share = dot(g, t[i]);
      mid += share * (e.u * d[i][0].mid + e.v * d[i][1].mid);
      half += std::abs(share) * (std::abs(e.u) * d[i][0].half + std::abs(e.v) * d[i][1].half);
    }
    return {mid - half, mid + half};
  }
  bool keep_orientation() const {
    const Spread &u0 = d[0][0], &u1 = d[1][0], &v0 = d[0][1], &v1 = d[1][1];
    const double along_u = u0.mid - u0.half, along_v = v1.mid - v1.half;
    return along_u > 0 && along_v > 0 && along_u * along_v > u1.largest() * v0.largest();
  }
};

// How the piece runs in a facet's plane: t[0] along S_u and t[1] to the side of S_v, by the map of the triangle of the
// parameter plane onto the facet.
class Flow {
 public:
  Flow(DerivativeNets& nets, const Domain& domain, const Facet& f) : nets_(nets), near_(f.corner[0]) {
    const Uv p = domain.side[2], q = domain.side[1];
    const Vector a = f.corner[1] - f.corner[0], b = f.corner[2] - f.corner[0];
    const double area = p.u * q.v - p.v * q.u;
    const Vector du = (q.v / area) * a + (-p.v / area) * b, dv = (-q.u / area) * a + (p.u / area) * b;
    t_[0] = normalized(du);
    t_[1] = cross(f.normal, t_[0]);
    if (dot(dv, t_[1]) < 0) t_[1] = -t_[1];
  }

  // The same for a plane across n, with S_u along `du` somewhere.
  Flow(DerivativeNets& nets, Vector n, Vector du, Point near) : nets_(nets), near_(near), t_{normalized(du), cross(n, normalized(du))} {}

  bool slopes(Interval u, Interval v, Slopes& out) const {
    const std::optional<DerivativeNets::Window> window = nets_.window(u, v);
    out.t = t_;
    return window && nets_.firsts(*window, near_, out.t, out.d);
  }

  // Whether the determinant is positive all over a triangle, which may be halved.
  bool keeps_orientation(const std::array<Uv, 3>& uv, int depth) const {
    const Domain domain(uv);
    Slopes slopes;
    if (!this->slopes(domain.u, domain.v, slopes)) return false;
    if (slopes.keep_orientation()) return true;
    if (depth == 0) return false;
    std::size_t i = 0;
    double most = -1;
    for (std::size_t k = 0; k < 3; ++k) {
      const double weighs = std::abs(domain.side[k].u) / domain.u.length() + std::abs(domain.side[k].v) / domain.v.length();
      if (weighs > most) most = weighs, i = k;
    }
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const Uv cut = between(uv[j], uv[k]);
    return keeps_orientation({uv[i], uv[j], cut}, depth - 1) && keeps_orientation({uv[i], cut, uv[k]}, depth - 1);
  }

  // Over a rectangle, which may be cut into four.
  bool keeps_orientation(Interval u, Interval v, int depth) const {
    Slopes slopes;
    if (!this->slopes(u, v, slopes)) return false;
    if (slopes.keep_orientation()) return true;
    if (depth == 0) return false;
    const Interval left{u.lo, u.mid()}, right{u.mid(), u.hi}, lower{v.lo, v.mid()}, upper{v.mid(), v.hi};
    return keeps_orientation(left, lower, depth - 1) && keeps_orientation(right, lower, depth - 1) &&
           keeps_orientation(left, upper, depth - 1) && keeps_orientation(right, upper, depth - 1);
  }

  // A stretch of a side from a to b, which runs towards `to` and away from `from`: never backward against either, and along
  // `chord` (its whole length squared taken out) at no less than the result; negative when it does run backward.
  double forward(Uv a, Uv b, Vector to, Vector from, Vector chord, int depth) const {
    Slopes slopes;
    const Uv e = b - a;
    if (this->slopes({std::min(a.u, b.u), std::max(a.u, b.u)}, {std::min(a.v, b.v), std::max(a.v, b.v)}, slopes) &&
        slopes.along(to, e).lo >= 0 && slopes.along(from, e).hi <= 0)
      return std::max(0.0, slopes.along(chord, e).lo / dot(chord, chord));
    if (depth == 0) return -1;
    const Uv m = between(a, b);
    const double first = forward(a, m, to, from, chord, depth - 1);
    return first < 0 ? first : 2 * std::min(first, forward(m, b, to, from, chord, depth - 1));
  }

 private:
  DerivativeNets& nets_;
  Point near_;
  std::array<Vector, 2> t_;
};

// The lenses where the piece keeps its orientation: its side curves run forward along their chords, towards each of the
// other sides, and bow as second derivatives say. A curve that runs at no less than m times its mean is over s (1 - s) at a place sigma
// with s (1 - s) at most sigma (1 - sigma) / m^2.
bool lenses_by_flow(const Flow& flow, const std::array<Uv, 3>& uv, const Facet& f, const std::array<double, 3>& bow, std::array<Lens, 3>& lens) {
  if (!flow.keeps_orientation(uv, halvings_of_flow)) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const double least = flow.forward(uv[i], uv[j], f.gradient[j], f.gradient[i], f.corner[j] - f.corner[i], halvings_of_flow);
    if (least < 0) return false;
    lens[k].bow = bow[k];
    lens[k].stretch = least > 0 ? std::max(1.0, 1 / (least * least)) : infinity;
  }
  return true;
}

// What the lenses are found by.
std::array<BySecond, 3> second_view(const Domain& domain, const std::array<Seconds, 3>& d, const std::array<double, 3>& length, double jumps) {
  std::array<BySecond, 3> view;
  for (std::size_t k = 0; k < 3; ++k) {
    BySecond& b = view[k];
    for (std::size_t i = 0; i < 3; ++i) b.bend[i] = bend(d[k], domain.side[i], domain.side[i]), b.sway[i] = sway(d[k], domain.side[i], domain.side[i]);
    b.bend_01 = bend(d[k], domain.side[2], domain.side[1]), b.sway_01 = sway(d[k], domain.side[2], domain.side[1]);
    b.jump = length[k] * jumps;
  }
  return view;
}

ByThird third_view(const Domain& domain, const Thirds& thirds, const SurfacePiece& d, const Facet& f, std::size_t k, double length, double noise) {
  ByThird b;
  b.cubic = domain.cubic(thirds);
  b.stray = slope_share * domain.cubed_sway(thirds, domain.u.length(), domain.v.length()) + 16 * noise * length;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector w = d.middle[i] - midpoint(d.corner[(i + 1) % 3], d.corner[(i + 2) % 3]);
    b.psi[i] = dot(w, f.gradient[k]);
    b.third[i] = std::abs(domain.cubed(thirds, i)) + domain.cubed_sway(thirds, std::abs(domain.side[i].u), std::abs(domain.side[i].v)) + 96 * noise * length;
  }
  return b;
}

// As `beyond`, of a coordinate l_k + 4 (psi_0 l_1 l_2 + ...): its second derivative along side i is -8 psi_i.
Beyond beyond_quadratic(const std::array<double, 3>& psi, std::size_t k) {
  const double most = 8 * std::max(-psi[(k + 1) % 3], -psi[(k + 2) % 3]) + 2 * std::max(0.0, psi[k]), excess = most - 2;
  return {std::max(0.0, -psi[k]), excess > 0 ? excess * excess / (8 * most) : 0, 1 - 0.5 * std::max(0.0, most)};
}

}  // namespace

// Ranges of derivatives over a rectangle: of poles where there are nets, else of balls.
class Certificate::Ranges {
 public:
  Ranges(Certificate& c, Interval u, Interval v) : certificate_(c) {
    lines_ = c.rough(u, v);
    if (c.nets_) {
      window_ = c.nets_->window(u, v);
      known_ = window_ && !(c.nets_->is_rational() && lines_.joins != 0);
      if (known_) weights_ = c.nets_->weights(*window_), known_ = weights_.lo > 0;
    } else {
      known_ = c.bounds_.enclose(u, v, balls_);
    }
  }

  bool known() const { return known_; }
  double jumps() const { return lines_.jumps; }
  bool has_thirds() const { return lines_.lines == 0 && !is_rational(); }
  bool is_rational() const { return certificate_.nets_ && certificate_.nets_->is_rational(); }
  Interval weights() const { return weights_; }
  const DerivativeNets::Window* window() const { return window_ ? &*window_ : nullptr; }

  // Of n . (S - p), or of its numerator.
  Seconds seconds(Vector n, Point p) const {
    if (!window_) {
      const double length = norm(n);
      return {of(n, length, balls_.uu), of(n, length, balls_.uv), of(n, length, balls_.vv)};
    }
    const DerivativeNets::Component component = certificate_.nets_->height_over(p, n);
    std::array<Seconds, 1> out;
    certificate_.nets_->seconds(*window_, {&component, 1}, out);
    return out[0];
  }
  std::array<Seconds, 3> seconds(const std::array<Vector, 3>& n, const std::array<Point, 3>& p) const {
    if (!window_) return {seconds(n[0], p[0]), seconds(n[1], p[1]), seconds(n[2], p[2])};
    std::array<DerivativeNets::Component, 3> components;
    for (std::size_t k = 0; k < 3; ++k) components[k] = certificate_.nets_->height_over(p[k], n[k]);
    std::array<Seconds, 3> out;
    certificate_.nets_->seconds(*window_, components, out);
    return out;
  }
  std::array<Thirds, 3> thirds(const std::array<Vector, 3>& n) const {
    if (!window_) return {thirds(n[0]), thirds(n[1]), thirds(n[2])};
    std::array<DerivativeNets::Component, 3> components;
    for (std::size_t k = 0; k < 3; ++k) components[k] = certificate_.nets_->component(n[k]);
    std::array<Thirds, 3> out;
    certificate_.nets_->thirds(*window_, components, out);
    return out;
  }
  Thirds thirds(Vector n) const {
    if (!window_) {
      const double length = norm(n);
      return {of(n, length, balls_.uuu), of(n, length, balls_.uuv), of(n, length, balls_.uvv), of(n, length, balls_.vvv)};
    }
    const DerivativeNets::Component component = certificate_.nets_->component(n);
    std::array<Thirds, 1> out;
    certificate_.nets_->thirds(*window_, {&component, 1}, out);
    return out[0];
  }
 private:
  static Spread of(Vector n, double length, const Ball& b) { return {dot(n, b.centre), length * b.radius}; }

  Certificate& certificate_;
  Rough lines_;
  std::optional<DerivativeNets::Window> window_;
  HigherPartials balls_;
  Interval weights_{1, 1};
  bool known_ = false;
};

void Certificate::set_cells(Uv cell) {
  const auto* surface = std::get_if<NurbsSurface>(&surface_.shape);
  if (surface && proves()) nets_ = std::make_unique<DerivativeNets>(*surface, u_, v_, cell);
}

// A component along the normal is taken of the numerator, which is zero where the height is: the height is at most that
// over the least weight.
double Certificate::look_along(const SurfacePiece& d, const Facet& f, const std::array<const Facet*, 3>& neighbours, double limit, int depth) {
  if (!proves() || f.is_needle()) return infinity;
  ++pieces_;
  const Domain domain(d.uv);
  const Ranges ranges(*this, domain.u, domain.v);
  if (!ranges.known()) return infinity;
  const double weight = ranges.weights().lo, jumps = ranges.jumps(), noise = rounding * f.size;
  const Seconds height = ranges.seconds(f.normal, f.corner[0]);
  double across = std::min(peak({}, domain.bows(height)).value + domain.rest(height), domain.linear_rest(height)) / weight + jumps + noise;
  if (!(across <= limit) && ranges.has_thirds()) {
    std::array<double, 3> measured;
    for (std::size_t i = 0; i < 3; ++i) measured[i] = dot(d.middle[i] - f.corner[0], f.normal);
    across = std::min(across, peak({}, measured).value + domain.rest(ranges.thirds(f.normal)) + noise);
  }
  if (!(across <= limit)) {
    double worst = 0;
    if (depth == 0 || !stays_within(d.uv, {0, 0, 0}, f, limit, depth, worst)) return infinity;
    across = worst;
  }
  // Coordinate k over the weight is zero at both ends of side k.
  const std::array<Seconds, 3> sideways = ranges.seconds(f.gradient, {f.corner[1], f.corner[2], f.corner[0]});
  std::array<double, 3> length, bow, out;
  std::array<Edge, 3> edges;
  for (std::size_t k = 0; k < 3; ++k) {
    length[k] = norm(f.gradient[k]);
    const Beyond b = beyond(domain, sideways[k], k, weight);
    double curve = b.curve;
    if (!ranges.is_rational()) {  // from the middle of the side to its ends
      const double middle = dot(f.gradient[k], d.middle[k] - f.corner[(k + 1) % 3]);
      curve = std::min(curve, std::max(0.0, -middle) + 0.25 * b.curve);
    }
    bow[k] = curve / length[k] + jumps;
    out[k] = bow[k] + b.more / length[k] + noise;
    const double inward = b.slope > 0 ? (curve + (jumps + noise) * length[k]) / b.slope : infinity;
    const double left = jumps + noise, beside = std::min(across, beside_side(domain, height, k, inward) / weight + left);
    edges[k] = {inward <= 1 ? std::min(across, beside_side(domain, height, k, 0) / weight + left) : beside, bow[k] + noise, beside};
  }
  double at_side = 0;
  for (const Edge& e : edges) at_side = std::max(at_side, e.at_side);
  const auto with_aside = [&](double high, double aside) { return std::max(across, std::sqrt(high * high + aside * aside)); };
  double bound = with_aside(at_side, beyond_all(f, out));  // nearer than that to a side it is nearer to `beside`
  if (bound <= limit) return bound;
  std::array<Lens, 3> lens;
  bool is_seen = ranges.window() && lenses_by_flow(Flow(*nets_, domain, f), d.uv, f, bow, lens);
  if (!is_seen && ranges.is_rational()) {
    Remainder r;
    is_seen = remainder(d.uv, r) && lenses(d, f, r, lens);
  } else if (!is_seen) {
    is_seen = find_lenses(f, second_view(domain, sideways, length, jumps), lens);
  }
  if (is_seen) bound = with_lenses(f, neighbours, lens, across, edges, noise);
  if (bound <= limit || !ranges.has_thirds()) return bound <= limit ? bound : infinity;
  // The same of the quadratic through the six points, and what is left of it.
  const std::array<Thirds, 3> thirds = ranges.thirds(f.gradient);
  std::array<ByThird, 3> by_third;
  for (std::size_t k = 0; k < 3; ++k) {
    by_third[k] = third_view(domain, thirds[k], d, f, k, length[k], noise);
    const Beyond b = beyond_quadratic(by_third[k].psi, k);
    const double here = (b.curve + b.more + domain.rest(thirds[k])) / length[k] + noise;
    out[k] = std::min(out[k], here);
  }
  bound = with_aside(across, beyond_all(f, out));
  if (!(bound <= limit) && !is_seen && find_lenses(f, by_third, lens)) bound = with_lenses(f, neighbours, lens, across, edges, noise);
  return bound <= limit ? bound : infinity;
}

// Where the determinant is positive seen along n, a point of the surface lies over the triangulation, or between a straight
// piece of the outline and the curve over it. Both surfaces are in the slab that holds the poles.
double Certificate::flat_bound(Vector n, Point on_plane, std::span<const std::array<Uv, 2>> border, double limit) {
  if (!nets_ || crosses_crease({Uv{u_.lo, v_.lo}, Uv{u_.hi, v_.lo}, Uv{u_.hi, v_.hi}})) return infinity;
  const std::optional<DerivativeNets::Window> whole = nets_->window(u_, v_);
  if (!whole) return infinity;
  const double slab = 2 * nets_->largest_height(*whole, on_plane, n);
  if (!(slab <= limit)) return infinity;
  Point p;
  Vector du, dv;
  jet1(surface_, {u_.mid(), v_.mid()}, p, du, dv);
  const Flow flow(*nets_, n, du - dot(du, n) * n, p);
  if (!flow.keeps_orientation(u_, v_, halvings_of_flow)) return infinity;
  double worst = 0;
  for (const std::array<Uv, 2>& chord : border) {
    const Interval u{std::min(chord[0].u, chord[1].u), std::max(chord[0].u, chord[1].u)};
    const Interval v{std::min(chord[0].v, chord[1].v), std::max(chord[0].v, chord[1].v)};
    const std::optional<DerivativeNets::Window> window = nets_->window(u, v);
    const Rough lines = rough(u, v);
    const Point a = evaluate(surface_, chord[0]), b = evaluate(surface_, chord[1]);
    if (!window || (nets_->is_rational() && lines.joins != 0)) return infinity;
    if (distance(a, b) == 0) continue;
    const Vector along = normalized((b - a) - dot(b - a, n) * n);
    Slopes slopes;
    if (!flow.slopes(u, v, slopes) || !(slopes.along(along, chord[1] - chord[0]).lo >= 0)) return infinity;
    const DerivativeNets::Component sideways = nets_->height_over(a, cross(n, along));
    std::array<Seconds, 1> d;
    nets_->seconds(*window, {&sideways, 1}, d);
    const Uv e = chord[1] - chord[0];
    worst = std::max(worst, 0.125 * (std::abs(bend(d[0], e, e)) + sway(d[0], e, e)) / nets_->weights(*window).lo + lines.jumps);
  }
  const double bound = std::sqrt(slab * slab + worst * worst) + rounding * norm(to_vector(on_plane));
  return bound <= limit ? bound : infinity;
}

// Whether the surface over a triangle of the parameter plane stays within `limit` of a facet's plane. `height`: of its
// corners. `worst` grows to the bound found.
bool Certificate::stays_within(const std::array<Uv, 3>& uv, const std::array<double, 3>& h, const Facet& f, double limit, int depth, double& worst) {
  ++pieces_;
  const Domain domain(uv);
  const Ranges ranges(*this, domain.u, domain.v);
  std::size_t longest = 0;
  double most = -1;
  if (ranges.known()) {
    const Seconds height = ranges.seconds(f.normal, f.corner[0]);
    const Interval weight = ranges.weights();
    const double left = ranges.jumps() + rounding * f.size, largest = std::max({std::abs(h[0]), std::abs(h[1]), std::abs(h[2])});
    // The numerator at the corners: the heights times weights not far from the middle one.
    const double astray = 0.5 * largest * weight.length();
    std::array<double, 3> m = domain.bows(height), corner;
    for (std::size_t i = 0; i < 3; ++i) corner[i] = weight.mid() * h[i], m[i] += 0.5 * weight.mid() * (h[(i + 1) % 3] + h[(i + 2) % 3]);
    double bound = (largest * weight.mid() + domain.linear_rest(height) + astray) / weight.lo + left;
    if (!(bound <= limit)) bound = std::min(bound, (peak(corner, m).value + domain.rest(height) + astray) / weight.lo + left);
    if (bound <= limit) {
      worst = std::max(worst, bound);
      return true;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const double u = std::abs(domain.side[i].u), v = std::abs(domain.side[i].v);
      const double weighs = u * u * height[0].largest() + 2 * u * v * height[1].largest() + v * v * height[2].largest();
      if (weighs > most) most = weighs, longest = i;
    }
  }
  if (depth == 0) return false;
  const std::size_t j = (longest + 1) % 3, k = (longest + 2) % 3;
  const Uv cut = between(uv[j], uv[k]);
  const double at_cut = dot(evaluate(surface_, cut) - f.corner[0], f.normal);
  if (!(std::abs(at_cut) <= limit)) return false;
  return stays_within({uv[longest], uv[j], cut}, {h[longest], h[j], at_cut}, f, limit, depth - 1, worst) &&
         stays_within({uv[longest], cut, uv[k]}, {h[longest], at_cut, h[k]}, f, limit, depth - 1, worst);
}

}  // namespace trimloop::mesh
