#include "kernel/mesh/certificate.h"

#include "kernel/mesh/certificate_detail.h"
#include "kernel/mesh/distance.h"

namespace trimloop::mesh {

using namespace certificate_detail;

namespace {

double squared_distance_to_segment(Point p, Point a, Point b) {
  const Vector d = b - a, to = p - a;
  const double length2 = dot(d, d);
  const double s = length2 > 0 ? std::clamp(dot(to, d) / length2, 0.0, 1.0) : 0.0;
  const Vector off = to - s * d;
  return dot(off, off);
}

double distance_to_sides(Point p, const Facet& f) {
  return std::sqrt(std::min({squared_distance_to_segment(p, f.corner[0], f.corner[1]),
                             squared_distance_to_segment(p, f.corner[1], f.corner[2]),
                             squared_distance_to_segment(p, f.corner[2], f.corner[0])}));
}

// Whether p lies well beside a facet, so that it is hardly the one that a piece around p is nearest to.
bool is_clear_of(Point p, const Facet& f) {
  const std::array<double, 3> l = barycentric(p, f);
  return !f.is_needle() && std::min({l[0], l[1], l[2]}) < -0.1;
}

Point at(const std::array<double, 3>& l, const Facet& f) {
  return f.corner[0] + l[1] * (f.corner[1] - f.corner[0]) + l[2] * (f.corner[2] - f.corner[0]);
}

// How far points of the facet's plane may lie beyond it whose barycentric coordinates are at least least - rest: these
// fill a triangle, and the distance from the facet is convex. Infinite when above `most`.
double beyond(const std::array<double, 3>& least, const std::array<double, 3>& rest, const Facet& f, double most) {
  std::array<double, 3> l;
  for (std::size_t k = 0; k < 3; ++k) l[k] = least[k] - rest[k];
  if (l[0] >= 0 && l[1] >= 0 && l[2] >= 0) return 0;
  double worst = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<double, 3> corner = l;
    corner[k] = 1 - l[(k + 1) % 3] - l[(k + 2) % 3];
    if (corner[k] < l[k]) return infinity;
    if (corner[0] >= 0 && corner[1] >= 0 && corner[2] >= 0) continue;  // within the facet
    worst = std::max(worst, distance_to_sides(at(corner, f), f));
    if (worst > most) return infinity;
  }
  return worst;
}

double beyond(Point p, const Facet& f) {
  const std::array<double, 3> l = barycentric(p, f);
  if (l[0] >= 0 && l[1] >= 0 && l[2] >= 0) return 0;
  return distance_to_sides(p - dot(p - f.corner[0], f.normal) * f.normal, f);
}

// The same for the quadratic over a facet's own piece, where its sides bow by less than the facet is high.
double own_beyond(const SurfacePiece& d, const std::array<double, 3>& h, const Facet& f, double noise) {
  double least_height = infinity, bow = 0, second_bow = 0, outward = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(std::abs(h[i]) <= noise) || !(distance(d.corner[i], f.corner[i]) <= noise)) return infinity;
    const Vector w = d.middle[i] - midpoint(d.corner[(i + 1) % 3], d.corner[(i + 2) % 3]);
    const double sideways = norm(w - dot(w, f.normal) * f.normal), height = 1 / norm(f.gradient[i]);
    if (sideways > bow) second_bow = bow, bow = sideways;
    else second_bow = std::max(second_bow, sideways);
    least_height = std::min(least_height, height);
    outward = std::max(outward, -dot(w, f.gradient[i]) * height);
  }
  return 4 * (bow + second_bow) <= least_height ? 4.0 / 3 * outward : infinity;
}

// The side along which the third derivative weighs most: the one to halve.
std::size_t longest_side(const std::array<Uv, 3>& d, const HigherPartials& third) {
  const double uuu = largest_norm(third.uuu), uuv = largest_norm(third.uuv), uvv = largest_norm(third.uvv), vvv = largest_norm(third.vvv);
  std::size_t longest = 0;
  double most = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Uv e = d[(i + 2) % 3] - d[(i + 1) % 3];
    const double u = std::abs(e.u), v = std::abs(e.v);
    const double weight = u * u * u * uuu + 3 * u * u * v * uuv + 3 * u * v * v * uvv + v * v * v * vvv;
    if (weight > most) most = weight, longest = i;
  }
  return longest;
}

// The same by second derivatives.
std::size_t longest_second(const std::array<Uv, 3>& d, const HigherPartials& second) {
  std::size_t longest = 0;
  double most = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Uv e = d[(i + 2) % 3] - d[(i + 1) % 3];
    const double u = std::abs(e.u), v = std::abs(e.v);
    const double weight = u * u * largest_norm(second.uu) + 2 * u * v * largest_norm(second.uv) + v * v * largest_norm(second.vv);
    if (weight > most) most = weight, longest = i;
  }
  return longest;
}

// The part of a convex polygon where coordinate `axis` is at most (sign 1) or at least (sign -1) `at`.
using Polygon = std::vector<Uv>;
Polygon clipped(const Polygon& in, int axis, double at, double sign) {
  Polygon out;
  const auto off = [&](Uv p) { return sign * ((axis == 0 ? p.u : p.v) - at); };
  for (std::size_t i = 0; i < in.size(); ++i) {
    const Uv a = in[i], b = in[(i + 1) % in.size()];
    const double da = off(a), db = off(b);
    if (da <= 0) out.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
      Uv cut = a + (da / (da - db)) * (b - a);
      (axis == 0 ? cut.u : cut.v) = at;
      out.push_back(cut);
    }
  }
  return out;
}

}  // namespace

Facet::Facet(Point a, Point b, Point c) : corner{a, b, c} {
  const Vector ab = b - a, ac = c - a, n = cross(ab, ac);
  area = norm(n);
  for (const Point p : corner) size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  if (!(area > needle * std::max({dot(ab, ab), dot(ac, ac), dot(ac - ab, ac - ab)}))) return;
  normal = n / area;
  gradient[1] = cross(ac, normal) / area;
  gradient[2] = cross(normal, ab) / area;
  gradient[0] = -(gradient[1] + gradient[2]);
}

double distance(Point p, const Facet& f) {
  if (f.is_needle()) return distance_to_sides(p, f);
  const std::array<double, 3> l = barycentric(p, f);
  if (l[0] >= 0 && l[1] >= 0 && l[2] >= 0) return std::abs(dot(p - f.corner[0], f.normal));
  return distance_to_sides(p, f);
}

Certificate::Certificate(const Surface& surface, Interval u, Interval v) : surface_(surface), bounds_(surface, u, v), u_(u), v_(v) {}

bool Certificate::crosses_crease(const std::array<Uv, 3>& d) const {
  const SurfaceBounds::Lines& lines = bounds_.lines();
  return inside(lines.creases_u, spread(d[0].u, d[1].u, d[2].u), u_.length()).count() != 0 ||
         inside(lines.creases_v, spread(d[0].v, d[1].v, d[2].v), v_.length()).count() != 0;
}

Cubic Certificate::Remainder::cubic(Vector n) const {
  const double a = dot(n, d.uuu.centre), b = dot(n, d.uuv.centre), c = dot(n, d.uvv.centre), e = dot(n, d.vvv.centre);
  const auto cubed = [&](Uv x) {
    return x.u * x.u * (x.u * a + 3 * x.v * b) + x.v * x.v * (3 * x.u * c + x.v * e);
  };
  const Uv p = edge[0], q = edge[1];
  const double a01 = cubed(p) / 12, a20 = -cubed(q) / 12, a12 = cubed(q - p) / 12;
  const double mixed = p.u * p.u * (q.u * a + q.v * b) + 2 * p.u * p.v * (q.u * b + q.v * c) + p.v * p.v * (q.u * c + q.v * e);
  return {a01, a12, a20, a12 + 3 * a01 - a20 - 0.5 * mixed};
}
double Certificate::Remainder::along(Vector n) const {
  if (is_second) return norm(n) * all;
  const Cubic c = cubic(n);
  return cubic_share * std::max({std::abs(c.a01), std::abs(c.a20), std::abs(c.a12)}) + std::abs(c.bubble) / 27 +
         norm(n) * (uuu * d.uuu.radius + uuv * d.uuv.radius + uvv * d.uvv.radius + vvv * d.vvv.radius);
}
double Certificate::Remainder::linear_along(Vector n) const {
  const double l = norm(n);
  return uu * largest_dot(n, l, d.uu) + uv * largest_dot(n, l, d.uv) + vv * largest_dot(n, l, d.vv) + l * jumps;
}

// Lines inside a rectangle where second derivatives jump, and by how much the first ones do, as a distance.
Certificate::Rough Certificate::rough(Interval u, Interval v) const {
  const SurfaceBounds::Lines& lines = bounds_.lines();
  const auto in_u = inside(lines.rough_u, u, u_.length()).count(), in_v = inside(lines.rough_v, v, v_.length()).count();
  const auto joins = inside(lines.joins_u, u, u_.length()).count() + inside(lines.joins_v, v, v_.length()).count();
  return {in_u + in_v, joins, 0.25 * (static_cast<double>(in_u) * lines.jump_u * u.length() + static_cast<double>(in_v) * lines.jump_v * v.length())};
}

bool Certificate::remainder(const std::array<Uv, 3>& uv, Remainder& r) {
  const Interval u = spread(uv[0].u, uv[1].u, uv[2].u), v = spread(uv[0].v, uv[1].v, uv[2].v);
  if (!bounds_.enclose(u, v, r.d)) return false;
  const Rough lines = rough(u, v);
  r.edge = {uv[1] - uv[0], uv[2] - uv[0]};
  const double wide = u.length(), high = v.length();
  r.uu = linear * wide * wide, r.uv = 2 * linear * wide * high, r.vv = linear * high * high;
  r.jumps = lines.jumps;
  r.linear_all = r.uu * largest_norm(r.d.uu) + r.uv * largest_norm(r.d.uv) + r.vv * largest_norm(r.d.vv) + r.jumps;
  r.is_second = lines.lines != 0;
  if (r.is_second) {
    r.all = r.uu * r.d.uu.radius + r.uv * r.d.uv.radius + r.vv * r.d.vv.radius + r.jumps;
    return true;
  }
  r.uuu = lagrange * wide * wide * wide, r.uuv = 3 * lagrange * wide * wide * high;
  r.uvv = 3 * lagrange * wide * high * high, r.vvv = lagrange * high * high * high;
  r.all = r.uuu * largest_norm(r.d.uuu) + r.uuv * largest_norm(r.d.uuv) + r.uvv * largest_norm(r.d.uvv) +
          r.vvv * largest_norm(r.d.vvv);
  return true;
}

// Puts the middles where constant second derivatives would have them.
void Certificate::straighten(SurfacePiece& p, const Remainder& r) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Uv e = i == 0 ? r.edge[1] - r.edge[0] : r.edge[2 - i];
    p.middle[i] = midpoint(p.corner[(i + 1) % 3], p.corner[(i + 2) % 3]) -
                  0.125 * (e.u * e.u * r.d.uu.centre + 2 * e.u * e.v * r.d.uv.centre + e.v * e.v * r.d.vv.centre);
  }
}

std::size_t Certificate::hardest_side(const std::array<Uv, 3>& uv) {
  HigherPartials d;
  const bool is_known = bounds_.enclose(spread(uv[0].u, uv[1].u, uv[2].u), spread(uv[0].v, uv[1].v, uv[2].v), d);
  return is_known ? longest_second(uv, d) : 0;
}

Certificate::Estimate Certificate::estimate(const SurfacePiece& d, const Facet& f) {
  Estimate result;
  Remainder r;
  if (!remainder(d.uv, r)) return result;
  SurfacePiece piece = d;
  if (r.is_second) straighten(piece, r);
  estimate(piece, f, r, infinity, result);
  result.is_measured = !r.is_second;
  return result;
}

Certificate::Estimate Certificate::estimate(const SurfacePiece& evaluated, const Facet& f,
                                            const std::array<const Facet*, 3>& neighbours) {
  Estimate result;
  Remainder r;
  if (!remainder(evaluated.uv, r)) return result;
  SurfacePiece d = evaluated;
  if (r.is_second) straighten(d, r);
  result.is_measured = !r.is_second;
  if (f.is_needle()) {
    estimate(d, f, r, infinity, result);
    return result;
  }
  std::array<double, 3> m;
  for (std::size_t i = 0; i < 3; ++i) m[i] = dot(d.middle[i] - f.corner[0], f.normal);
  const Peak top = peak({}, m);
  result.likely = top.value, result.at = top.at;
  const double noise = rounding * f.size, left = r.along(f.normal) + noise;
  result.across = std::min(top.value + left, r.linear_along(f.normal) + noise);
  std::array<Lens, 3> lens;
  if (!lenses(d, f, r, lens)) {
    estimate(d, f, r, infinity, result);
    return result;
  }
  std::array<Edge, 3> edges;
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<double, 3> psi;
    for (std::size_t i = 0; i < 3; ++i) psi[i] = dot(d.middle[i] - midpoint(d.corner[(i + 1) % 3], d.corner[(i + 2) % 3]), f.gradient[k]);
    const double high = near_side(m, psi, r.along(f.gradient[k]) + noise * norm(f.gradient[k]), k) + left;
    edges[k] = {high, lens[k].bow, high};
  }
  result.bound = with_lenses(f, neighbours, lens, result.across, edges, noise);
  return result;
}

// By third derivatives where they are known; else, or where these change too much, by second ones.
bool Certificate::lenses(const SurfacePiece& d, const Facet& f, const Remainder& r, std::array<Lens, 3>& out) {
  const std::array<Uv, 3> e{r.edge[1] - r.edge[0], r.edge[1], r.edge[0]};  // side i, opposite corner i
  std::array<double, 3> length;
  for (std::size_t k = 0; k < 3; ++k) length[k] = norm(f.gradient[k]);
  if (!r.is_second) {
    std::array<ByThird, 3> by_third;
    std::array<Vector, 3> w, third;
    std::array<double, 3> ball;
    for (std::size_t i = 0; i < 3; ++i) {
      w[i] = d.middle[i] - midpoint(d.corner[(i + 1) % 3], d.corner[(i + 2) % 3]);
      const double u = e[i].u, v = e[i].v, a = std::abs(u), b = std::abs(v);
      third[i] = (u * u * u) * r.d.uuu.centre + (3 * u * u * v) * r.d.uuv.centre + (3 * u * v * v) * r.d.uvv.centre + (v * v * v) * r.d.vvv.centre;
      ball[i] = a * a * a * r.d.uuu.radius + 3 * a * a * b * r.d.uuv.radius + 3 * a * b * b * r.d.uvv.radius + b * b * b * r.d.vvv.radius;
    }
    const double stray = slope_share / lagrange * (r.uuu * r.d.uuu.radius + r.uuv * r.d.uuv.radius + r.uvv * r.d.uvv.radius + r.vvv * r.d.vvv.radius) +
                         16 * rounding * f.size;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector g = f.gradient[k];
      by_third[k].cubic = r.cubic(g);
      by_third[k].stray = length[k] * stray;
      for (std::size_t i = 0; i < 3; ++i) {
        by_third[k].psi[i] = dot(w[i], g);
        by_third[k].third[i] = std::abs(dot(g, third[i])) + length[k] * (ball[i] + 96 * rounding * f.size);
      }
    }
    if (find_lenses(f, by_third, out)) return true;
  }
  std::array<BySecond, 3> by_second;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector g = f.gradient[k];
    const double uu = dot(g, r.d.uu.centre), uv = dot(g, r.d.uv.centre), vv = dot(g, r.d.vv.centre);
    const auto bend = [&](Uv a, Uv b) { return a.u * b.u * uu + (a.u * b.v + a.v * b.u) * uv + a.v * b.v * vv; };
    const auto sway = [&](Uv a, Uv b) {
      return length[k] * (std::abs(a.u * b.u) * r.d.uu.radius + (std::abs(a.u * b.v) + std::abs(a.v * b.u)) * r.d.uv.radius +
                          std::abs(a.v * b.v) * r.d.vv.radius);
    };
    for (std::size_t i = 0; i < 3; ++i) by_second[k].bend[i] = bend(e[i], e[i]), by_second[k].sway[i] = sway(e[i], e[i]);
    by_second[k].bend_01 = bend(e[2], e[1]), by_second[k].sway_01 = sway(e[2], e[1]);
    by_second[k].jump = length[k] * r.jumps;
  }
  return find_lenses(f, by_second, out);
}

void Certificate::estimate(const SurfacePiece& d, const Facet& f, const Remainder& r, double enough, Estimate& result) {
  std::array<Point, 3> control;
  for (std::size_t i = 0; i < 3; ++i)
    control[i] = d.middle[i] + ((d.middle[i] - d.corner[(i + 1) % 3]) + (d.middle[i] - d.corner[(i + 2) % 3])) * 0.5;
  const double noise = rounding * f.size;
  if (f.is_needle()) {  // the distance from it is convex: at most that of a Bézier point
    double off = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      off = std::max({off, distance_to_sides(d.corner[i], f), distance_to_sides(control[i], f)});
      const double here = distance_to_sides(d.middle[i], f);
      if (here > result.likely) result.likely = here, result.at = {0.5, 0.5, 0.5}, result.at[i] = 0;
    }
    double ends = 0;
    for (const Point p : d.corner) ends = std::max(ends, distance_to_sides(p, f));
    result.bound = std::min(off + r.all, ends + r.linear_all) + noise;
    return;
  }
  std::array<double, 3> h, m;
  for (std::size_t i = 0; i < 3; ++i)
    h[i] = dot(d.corner[i] - f.corner[0], f.normal), m[i] = dot(d.middle[i] - f.corner[0], f.normal);
  const Peak top = peak(h, m);
  result.likely = top.value, result.at = top.at;
  // Within its plane: the least barycentric coordinates of the Bézier points and of the corners.
  std::array<double, 3> least{1, 1, 1}, least_corner{1, 1, 1};
  double corners_off = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::array<double, 3> at_corner = barycentric(d.corner[i], f), at_control = barycentric(control[i], f);
    for (std::size_t k = 0; k < 3; ++k) {
      least_corner[k] = std::min(least_corner[k], at_corner[k]);
      least[k] = std::min({least[k], at_corner[k], at_control[k]});
    }
    corners_off = std::max(corners_off, std::abs(h[i]));
  }
  const double normal_part = result.likely + r.along(f.normal) + noise;
  const double linear_normal = corners_off + r.linear_along(f.normal) + noise;
  result.across = std::min(normal_part, linear_normal);
  if (result.across > enough) return;
  std::array<double, 3> rest, linear_rest;
  for (std::size_t k = 0; k < 3; ++k) {
    const double noise_here = noise * norm(f.gradient[k]);
    rest[k] = r.along(f.gradient[k]) + noise_here, linear_rest[k] = r.linear_along(f.gradient[k]) + noise_here;
  }
  // Far beyond is not looked at closely.
  double plane_part = beyond(least, rest, f, enough);
  if (plane_part > 0.1 * normal_part) {
    double out = own_beyond(d, h, f, noise);
    if (!(out < infinity)) {
      out = 0;
      for (std::size_t i = 0; i < 3; ++i) out = std::max({out, beyond(d.corner[i], f), beyond(control[i], f)});
    }
    plane_part = std::min(plane_part, out + r.all + noise);
  }
  result.bound = std::sqrt(normal_part * normal_part + plane_part * plane_part);
  if (linear_normal < result.bound) {
    const double linear_part = beyond(least_corner, linear_rest, f, enough);
    result.bound = std::min(result.bound, std::sqrt(linear_normal * linear_normal + linear_part * linear_part));
  }
}

double Certificate::hinge_bound(const SurfacePiece& d, const Facet& f, const Facet& g, const Remainder& r) {
  if (f.is_needle() || g.is_needle()) return infinity;
  const auto corner_of = [](Point p, const Facet& t) {
    for (std::size_t i = 0; i < 3; ++i)
      if (distance(p, t.corner[i]) == 0) return i;
    return std::size_t{3};
  };
  const std::array<std::size_t, 3> in_g{corner_of(f.corner[0], g), corner_of(f.corner[1], g), corner_of(f.corner[2], g)};
  const std::size_t far = in_g[0] == 3 ? 0 : in_g[1] == 3 ? 1 : 2;  // corner of f opposite to the common side
  const std::size_t j = (far + 1) % 3, k = (far + 2) % 3;
  if (in_g[far] != 3 || in_g[j] == 3 || in_g[k] == 3) return infinity;
  const double cosine = dot(f.normal, g.normal);
  if (!(cosine > 0.5)) return infinity;
  const double noise = rounding * std::max(f.size, g.size);
  double off = 0;
  for (const Facet* t : {&f, &g}) {
    std::array<double, 3> h, m;
    const std::array<std::size_t, 2> other = t == &f ? std::array{j, k} : std::array{in_g[j], in_g[k]};
    for (std::size_t i = 0; i < 3; ++i) {
      const Point control = d.middle[i] + ((d.middle[i] - d.corner[(i + 1) % 3]) + (d.middle[i] - d.corner[(i + 2) % 3])) * 0.5;
      h[i] = dot(d.corner[i] - t->corner[0], t->normal), m[i] = dot(d.middle[i] - t->corner[0], t->normal);
      for (const Point p : {d.corner[i], control}) {
        const std::array<double, 3> l = barycentric(p, *t);
        for (const std::size_t side : other)
          if (l[side] < r.along(t->gradient[side]) + noise * norm(t->gradient[side])) return infinity;  // not within them
      }
    }
    off = std::max(off, peak(h, m).value + r.along(t->normal) + noise);
  }
  return off / std::sqrt(0.5 * (1 + cosine));
}

SurfacePiece Certificate::piece(const std::array<Uv, 3>& uv) const {
  SurfacePiece p{uv, {}, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    p.corner[i] = evaluate(surface_, uv[i]);
    p.middle[i] = evaluate(surface_, between(uv[(i + 1) % 3], uv[(i + 2) % 3]));
  }
  return p;
}

double Certificate::smooth_bound(const SurfacePiece& whole, std::span<const Facet> facets, const Aim& aim, int depth, double& seen) {
  ++pieces_;
  double best = infinity;
  Remainder r;
  if (!remainder(whole.uv, r)) return infinity;
  SurfacePiece p = whole;
  if (r.is_second) straighten(p, r);
  const bool is_quick = aim.tightness == 0;
  bool hopeless = false;  // the piece is too large for any facet
  const Point middle = whole.corner[0] + (1.0 / 3) * ((whole.corner[1] - whole.corner[0]) + (whole.corner[2] - whole.corner[0]));
  for (const Facet& f : facets) {
    if (is_quick && &f != facets.data() && is_clear_of(middle, f)) continue;
    Estimate e;
    estimate(p, f, r, is_quick && depth > 0 ? aim.enough_mm : infinity, e);
    best = std::min(best, e.bound);
    if (best <= aim.enough_mm) return best;
    hopeless = is_quick && e.across > 2 * aim.enough_mm;
    if (hopeless) break;
  }
  for (const Point m : whole.middle) {
    double nearest = infinity;
    for (const Facet& f : facets) {
      nearest = std::min(nearest, distance(m, f));
      if (nearest <= std::max(seen, is_quick ? aim.enough_mm : 0)) break;
    }
    seen = std::max(seen, nearest);
  }
  const auto given_up = [&] {
    Estimate e;
    estimate(p, facets[0], r, infinity, e);
    return std::min(best, e.bound);
  };
  if (is_quick && seen > aim.enough_mm) return given_up();
  for (std::size_t i = 1; i < facets.size() && !hopeless && best > std::max(aim.enough_mm, aim.tightness * seen); ++i)
    best = std::min(best, hinge_bound(p, facets[0], facets[i], r));
  if (depth == 0 || best <= std::max(aim.enough_mm, aim.tightness * seen)) return best;
  const std::array<Uv, 3>& uv = whole.uv;
  const std::size_t i = r.is_second ? longest_second(uv, r.d) : longest_side(uv, r.d);
  const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
  const Uv cut = between(uv[j], uv[k]);
  const auto at_middle = [&](Uv a, Uv b) { return evaluate(surface_, between(a, b)); };
  const Point inner = at_middle(uv[i], cut);
  const double first = smooth_bound({{uv[i], uv[j], cut}, {whole.corner[i], whole.corner[j], whole.middle[i]},
                                     {at_middle(uv[j], cut), inner, whole.middle[k]}},
                                    facets, aim, depth - 1, seen);
  if (is_quick && first > aim.enough_mm) return given_up();
  if (first > best) return best;
  const double second = smooth_bound({{uv[i], cut, uv[k]}, {whole.corner[i], whole.middle[i], whole.corner[k]},
                                      {at_middle(cut, uv[k]), whole.middle[j], inner}},
                                     facets, aim, depth - 1, seen);
  return std::min(best, std::max(first, second));
}

double Certificate::bound(const SurfacePiece& piece, std::span<const Facet> facets, const Aim& aim) {
  if (!proves()) return infinity;
  double seen = 0;
  return crosses_crease(piece.uv) ? bound(piece.uv, facets, aim) : smooth_bound(piece, facets, aim, aim.depth, seen);
}

double Certificate::bound(const std::array<Uv, 3>& uv, std::span<const Facet> facets, const Aim& aim) {
  if (!proves()) return infinity;
  double worst = 0, seen = 0;
  if (!crosses_crease(uv)) return smooth_bound(piece(uv), facets, aim, aim.depth, seen);
  const auto across = [&](const Polygon& strip) {
    if (strip.size() < 3) return;
    Polygon rest = strip;
    const auto close = [&](const Polygon& cell) {
      for (std::size_t k = 2; k < cell.size(); ++k)
        worst = std::max(worst, smooth_bound(piece({cell[0], cell[k - 1], cell[k]}), facets, aim, aim.depth, seen));
    };
    Interval v{infinity, -infinity};
    for (const Uv p : strip) v = {std::min(v.lo, p.v), std::max(v.hi, p.v)};
    const Lines lines = inside(bounds_.lines().creases_v, v, v_.length());
    for (const double* at = lines.first; at != lines.last; ++at) {
      close(clipped(rest, 1, *at, 1));
      rest = clipped(rest, 1, *at, -1);
    }
    close(rest);
  };
  Polygon rest(uv.begin(), uv.end());
  const Lines lines = inside(bounds_.lines().creases_u, spread(uv[0].u, uv[1].u, uv[2].u), u_.length());
  for (const double* at = lines.first; at != lines.last; ++at) {
    across(clipped(rest, 0, *at, 1));
    rest = clipped(rest, 0, *at, -1);
  }
  across(rest);
  return worst;
}

// S on the line is a quadratic through three points and a remainder; across it, S moves by the derivative there, which is known
// at the middle and changes by second derivatives.
double Certificate::beside_chord(const std::array<Uv, 2>& line, double width, const Facet& f, const std::array<Point, 2>& place) {
  const Uv e = line[1] - line[0];
  const double length = norm(e);
  const Uv across = (width / length) * Uv{-e.v, e.u};
  const Uv reach{std::abs(across.u), std::abs(across.v)};
  const Interval u{std::min(line[0].u, line[1].u) - reach.u, std::max(line[0].u, line[1].u) + reach.u};
  const Interval v{std::min(line[0].v, line[1].v) - reach.v, std::max(line[0].v, line[1].v) + reach.v};
  HigherPartials d;
  if (f.is_needle() || !proves() || crosses_crease({Uv{u.lo, v.lo}, Uv{u.hi, v.lo}, Uv{u.hi, v.hi}}) || !bounds_.enclose(u, v, d))
    return infinity;
  ++pieces_;
  const Rough lines = rough(u, v);
  Point m;
  Vector du, dv;
  jet1(surface_, between(line[0], line[1]), m, du, dv);
  const Point a = evaluate(surface_, line[0]), b = evaluate(surface_, line[1]);
  const Vector bow = m - midpoint(a, b), step = across.u * du + across.v * dv;
  const double eu = std::abs(e.u), ev = std::abs(e.v), uu = largest_norm(d.uu), uv = largest_norm(d.uv), vv = largest_norm(d.vv);
  const double third = eu * eu * eu * largest_norm(d.uuu) + 3 * eu * eu * ev * largest_norm(d.uuv) + 3 * eu * ev * ev * largest_norm(d.uvv) +
                       ev * ev * ev * largest_norm(d.vvv);
  const auto second = [&](Uv p, Uv q) { return p.u * q.u * uu + (p.u * q.v + p.v * q.u) * uv + p.v * q.v * vv; };
  const auto in_plane = [&](Vector x) { return norm(x - dot(x, f.normal) * f.normal); };
  // Off the line a jump counts by the share that `reach` has of its width.
  double rest = second(reach, {0.5 * (eu + reach.u), 0.5 * (ev + reach.v)}) + rounding * f.size + 5 * lines.jumps;
  double high = std::abs(dot(step, f.normal)), aside = in_plane(step);
  if (lines.lines == 0) {
    high += std::abs(dot(bow, f.normal)), aside += in_plane(bow), rest += curve_remainder * third;
  } else {
    high += 0.125 * (eu * eu * largest_dot(f.normal, 1, d.uu) + 2 * eu * ev * largest_dot(f.normal, 1, d.uv) + ev * ev * largest_dot(f.normal, 1, d.vv));
    aside += 0.125 * second({eu, ev}, {eu, ev});
  }
  high += rest, aside += rest;
  const double moved = std::min(std::max(distance(a, place[0]), distance(b, place[1])), std::max(distance(a, place[1]), distance(b, place[0])));
  return std::sqrt(high * high + aside * aside) + moved;
}

double chord_bound(const Curve& curve, Interval t, Point a, Point b) {
  double worst = 0;
  std::vector<double> cuts{t.lo};
  for (const double x : breaks(curve))
    if (x > t.lo + ignored * t.length() && x < t.hi - ignored * t.length()) cuts.push_back(x);
  cuts.push_back(t.hi);
  double size = 0;
  for (const Point p : {a, b}) size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const Interval part{cuts[i], cuts[i + 1]};
    CurveBalls balls;
    if (!enclose(curve, part, balls)) return infinity;
    // The quadratic through three points stays within the hull of its Bézier points.
    const Point p = evaluate(curve, part.lo), m = evaluate(curve, part.mid()), q = evaluate(curve, part.hi);
    const Point control = m + 0.5 * ((m - p) + (m - q));
    const double ends = std::max(distance_to_segment(p, a, b), distance_to_segment(q, a, b));
    const double bow = 0.5 * std::max(0.0, distance_to_segment(control, a, b) - ends);  // at most half-way to it
    const double length = part.length();
    worst = std::max(worst, ends + bow + curve_remainder * length * length * length * largest_norm(balls[3]) + rounding * size);
  }
  return worst;
}

}  // namespace trimloop::mesh
