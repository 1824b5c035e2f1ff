#include "kernel/mesh/certificate.h"

#include "kernel/mesh/distance.h"

namespace trimloop::mesh {
namespace {

constexpr double lagrange = 0.204 / 6;           // see the head of certificate.h; found on a grid of 9 million places
constexpr double cubic = 0.1181;               // likewise
constexpr double linear = 2.0 / 9 * (1 + 1e-15);
constexpr double curve_remainder = 0.0481126 / 6;  // of t (t - 1/2) (t - 1), the same in one dimension
constexpr double rounding = 256 * 0x1p-53;      // of evaluated points, as a share of the coordinates
constexpr double needle = 1e-9;                 // area over the square of the longest side
constexpr double ignored = 1e-11;               // of the box: nearer than that a line does not cross

Uv between(Uv a, Uv b) { return {0.5 * (a.u + b.u), 0.5 * (a.v + b.v)}; }

Interval spread(double a, double b, double c) { return {std::min({a, b, c}), std::max({a, b, c})}; }

// Largest |q| over the triangle and where, q the quadratic with values h at the corners and m at the middles opposite.
struct Peak {
  double value = 0;
  std::array<double, 3> at{};
};
Peak peak(const std::array<double, 3>& h, const std::array<double, 3>& m) {
  Peak best;
  const auto offer = [&](double value, std::array<double, 3> at) {
    if (std::abs(value) > best.value) best = {std::abs(value), at};
  };
  std::array<double, 3> b;  // q = h . l + 4 (b0 l1 l2 + b1 l2 l0 + b2 l0 l1)
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    b[i] = m[i] - 0.5 * (h[j] + h[k]);
    std::array<double, 3> corner{}, middle{};
    corner[i] = 1, middle[j] = middle[k] = 0.5;
    offer(h[i], corner);
    offer(m[i], middle);
    // Along the side, s from j to k: h_j + (h_k - h_j) s + 4 b s (1 - s).
    const double s = 0.5 + (h[k] - h[j]) / (8 * b[i]);
    if (s > 0 && s < 1) {
      std::array<double, 3> on{};
      on[j] = 1 - s, on[k] = s;
      offer(h[j] + (h[k] - h[j]) * s + 4 * b[i] * s * (1 - s), on);
    }
  }
  const double k = b[2] - b[0] - b[1], det = 4 * b[0] * b[1] - k * k;
  if (det > 0) {
    const double g0 = 0.25 * (h[0] - h[2]) + b[1], g1 = 0.25 * (h[1] - h[2]) + b[0];
    const double l0 = (2 * b[0] * g0 + k * g1) / det, l1 = (2 * b[1] * g1 + k * g0) / det, l2 = 1 - l0 - l1;
    if (l0 > 0 && l1 > 0 && l2 > 0)
      offer(h[0] * l0 + h[1] * l1 + h[2] * l2 + 4 * (b[0] * l1 * l2 + b[1] * l2 * l0 + b[2] * l0 * l1), {l0, l1, l2});
  }
  return best;
}

double distance_to_sides(Point p, const Facet& f) {
  return std::min({distance_to_segment(p, f.corner[0], f.corner[1]), distance_to_segment(p, f.corner[1], f.corner[2]),
                   distance_to_segment(p, f.corner[2], f.corner[0])});
}

std::array<double, 3> barycentric(Point p, const Facet& f) {
  const Vector d = p - f.corner[0];
  const double b = dot(d, f.gradient[1]), c = dot(d, f.gradient[2]);
  return {1 - b - c, b, c};
}

Point at(const std::array<double, 3>& l, const Facet& f) {
  return f.corner[0] + l[1] * (f.corner[1] - f.corner[0]) + l[2] * (f.corner[2] - f.corner[0]);
}

// How far points of the facet's plane may lie beyond it whose barycentric coordinates are at least least - rest: these
// fill a triangle, and the distance from the facet is convex.
double beyond(const std::array<double, 3>& least, const std::array<double, 3>& rest, const Facet& f) {
  std::array<double, 3> l;
  for (std::size_t k = 0; k < 3; ++k) l[k] = least[k] - rest[k];
  if (l[0] >= 0 && l[1] >= 0 && l[2] >= 0) return 0;
  double worst = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<double, 3> corner = l;
    corner[k] = 1 - l[(k + 1) % 3] - l[(k + 2) % 3];
    worst = std::max(worst, distance_to_sides(at(corner, f), f));
    if (corner[k] < l[k]) return infinity;
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

// Whether a strip along side a-b of a facet, as high as a parabola of height `bow`, lies within the facet.
bool has_room(const Facet& f, Point a, Point b, double bow) {
  if (f.is_needle()) return false;
  std::size_t far = 0;
  int known = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const bool is_end = distance(f.corner[i], a) == 0 || distance(f.corner[i], b) == 0;
    known += is_end;
    if (!is_end) far = i;
  }
  if (known != 2) return false;
  const Vector side = b - a, to_far = f.corner[far] - a;
  const double length = norm(side), along = dot(to_far, side) / length, height = f.area / length;
  // The parabola rises by 4 bow / length at both ends, the other sides by height over their run.
  const double steepest = 4 * bow / length;
  return height > bow && (along <= 0 || height >= steepest * along) && (along >= length || height >= steepest * (length - along));
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

// Lines well inside an interval: first and past the last.
struct Lines {
  const double *first, *last;
};
Lines inside(const std::vector<double>& lines, Interval x, double whole) {
  if (lines.empty()) return {nullptr, nullptr};
  const double slack = ignored * std::max(whole, x.length());
  const auto first = std::upper_bound(lines.begin(), lines.end(), x.lo + slack);
  const auto last = std::lower_bound(first, lines.end(), x.hi - slack);
  return {lines.data() + (first - lines.begin()), lines.data() + (last - lines.begin())};
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

bool Certificate::crosses_line(const std::array<Uv, 3>& d) const {
  const Lines u = inside(bounds_.lines_u(), spread(d[0].u, d[1].u, d[2].u), u_.length());
  const Lines v = inside(bounds_.lines_v(), spread(d[0].v, d[1].v, d[2].v), v_.length());
  return u.first != u.last || v.first != v.last;
}

double Certificate::Remainder::along(Vector n) const {
  const double a = dot(n, d.uuu.centre), b = dot(n, d.uuv.centre), c = dot(n, d.uvv.centre), e = dot(n, d.vvv.centre);
  const auto cubed = [&](Uv x) {
    return x.u * x.u * (x.u * a + 3 * x.v * b) + x.v * x.v * (3 * x.u * c + x.v * e);
  };
  const Uv p = edge[0], q = edge[1];
  const double a01 = cubed(p) / 12, a20 = -cubed(q) / 12, a12 = cubed(q - p) / 12;
  const double mixed = p.u * p.u * (q.u * a + q.v * b) + 2 * p.u * p.v * (q.u * b + q.v * c) + p.v * p.v * (q.u * c + q.v * e);
  const double bubble = a12 + 3 * a01 - a20 - 0.5 * mixed;
  const double even = cubic * std::max({std::abs(a01), std::abs(a20), std::abs(a12)}) + std::abs(bubble) / 27;
  return even + norm(n) * (uuu * d.uuu.radius + uuv * d.uuv.radius + uvv * d.uvv.radius + vvv * d.vvv.radius);
}
double Certificate::Remainder::linear_along(Vector n) const {
  const double l = norm(n);
  return uu * largest_dot(n, l, d.uu) + uv * largest_dot(n, l, d.uv) + vv * largest_dot(n, l, d.vv);
}

bool Certificate::remainder(const std::array<Uv, 3>& uv, Remainder& r) {
  const Interval u = spread(uv[0].u, uv[1].u, uv[2].u), v = spread(uv[0].v, uv[1].v, uv[2].v);
  if (!bounds_.enclose(u, v, r.d)) return false;
  r.edge = {uv[1] - uv[0], uv[2] - uv[0]};
  const double wide = u.length(), high = v.length();
  r.uuu = lagrange * wide * wide * wide, r.uuv = 3 * lagrange * wide * wide * high;
  r.uvv = 3 * lagrange * wide * high * high, r.vvv = lagrange * high * high * high;
  r.all = r.uuu * largest_norm(r.d.uuu) + r.uuv * largest_norm(r.d.uuv) + r.uvv * largest_norm(r.d.uvv) +
          r.vvv * largest_norm(r.d.vvv);
  r.uu = linear * wide * wide, r.uv = 2 * linear * wide * high, r.vv = linear * high * high;
  r.linear_all = r.uu * largest_norm(r.d.uu) + r.uv * largest_norm(r.d.uv) + r.vv * largest_norm(r.d.vv);
  return true;
}

std::size_t Certificate::hardest_side(const std::array<Uv, 3>& uv) {
  HigherPartials d;
  const bool is_known = bounds_.enclose(spread(uv[0].u, uv[1].u, uv[2].u), spread(uv[0].v, uv[1].v, uv[2].v), d);
  return is_known ? longest_side(uv, d) : 0;
}

Certificate::Estimate Certificate::estimate(const SurfacePiece& d, const Facet& f) {
  Estimate result;
  Remainder r;
  remainder(d.uv, r);
  estimate(d, f, r, infinity, result);
  return result;
}

Certificate::Estimate Certificate::estimate(const SurfacePiece& d, const Facet& f, const std::array<const Facet*, 3>& neighbours) {
  Estimate result;
  Remainder r;
  if (!remainder(d.uv, r)) return result;
  if (f.is_needle()) {
    estimate(d, f, r, infinity, result);
    return result;
  }
  std::array<double, 3> h, m;
  for (std::size_t i = 0; i < 3; ++i)
    h[i] = dot(d.corner[i] - f.corner[0], f.normal), m[i] = dot(d.middle[i] - f.corner[0], f.normal);
  const Peak top = peak(h, m);
  result.likely = top.value, result.at = top.at;
  const double noise = rounding * f.size, rest = r.all + noise;
  double sine = 0, over = 0;
  const double out = own_beyond(d, h, f, noise);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const Vector w = d.middle[i] - midpoint(d.corner[j], d.corner[k]);
    const double bow = -dot(w, f.gradient[i]) / norm(f.gradient[i]);
    if (!(bow > 0)) continue;
    if (!neighbours[i] || !has_room(*neighbours[i], f.corner[j], f.corner[k], 4.0 / 3 * out)) {
      over = out;  // beyond the boundary, or too far into the neighbour
      continue;
    }
    const double cosine = std::min(1.0, dot(f.normal, neighbours[i]->normal));
    sine = std::max(sine, std::sqrt(1 - cosine * cosine));
  }
  const double normal_part = top.value + r.along(f.normal) + noise;
  result.across = normal_part;
  const double folded = normal_part + (out + rest) * sine, plane_part = over + rest;
  result.bound = out < infinity ? std::sqrt(folded * folded + plane_part * plane_part) : infinity;
  Estimate alone;
  if (!(result.bound < 1.05 * normal_part) || r.linear_along(f.normal) < normal_part) estimate(d, f, r, infinity, alone);
  result.bound = std::min(result.bound, alone.bound);
  return result;
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
  double plane_part = beyond(least, rest, f);
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
    const double linear_part = beyond(least_corner, linear_rest, f);
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

double Certificate::smooth_bound(const std::array<Uv, 3>& uv, std::span<const Facet> facets, const Aim& aim, int depth, double& seen) {
  const SurfacePiece p = piece(uv);
  double best = infinity;
  Remainder r;
  if (!remainder(uv, r)) return infinity;
  const bool is_quick = aim.tightness == 0;
  bool hopeless = false;  // the piece is too large for any facet
  for (const Facet& f : facets) {
    Estimate e;
    estimate(p, f, r, is_quick && depth > 0 ? aim.enough_mm : infinity, e);
    best = std::min(best, e.bound);
    if (best <= aim.enough_mm) return best;
    hopeless = is_quick && e.across > 2 * aim.enough_mm;
    if (hopeless) break;
  }
  for (const Point m : p.middle) {
    double nearest = infinity;
    for (const Facet& f : facets) {
      nearest = std::min(nearest, distance(m, f));
      if (nearest <= seen) break;
    }
    seen = std::max(seen, nearest);
  }
  if (is_quick && seen > aim.enough_mm) {
    Estimate e;
    estimate(p, facets[0], r, infinity, e);
    return std::min(best, e.bound);
  }
  for (std::size_t i = 1; i < facets.size() && !hopeless && best > aim.tightness * seen; ++i)
    best = std::min(best, hinge_bound(p, facets[0], facets[i], r));
  if (depth == 0 || best <= std::max(aim.enough_mm, aim.tightness * seen)) return best;
  const std::size_t i = longest_side(uv, r.d);
  const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
  const Uv cut = between(uv[j], uv[k]);
  const double first = smooth_bound({uv[i], uv[j], cut}, facets, aim, depth - 1, seen);
  if (first > best) return best;
  return std::min(best, std::max(first, smooth_bound({uv[i], cut, uv[k]}, facets, aim, depth - 1, seen)));
}

double Certificate::bound(const std::array<Uv, 3>& uv, std::span<const Facet> facets, const Aim& aim) {
  if (!proves()) return infinity;
  double worst = 0, seen = 0;
  if (!crosses_line(uv)) return smooth_bound(uv, facets, aim, aim.depth, seen);
  const auto across = [&](const Polygon& strip) {
    if (strip.size() < 3) return;
    Polygon rest = strip;
    const auto close = [&](const Polygon& cell) {
      for (std::size_t k = 2; k < cell.size(); ++k)
        worst = std::max(worst, smooth_bound({cell[0], cell[k - 1], cell[k]}, facets, aim, aim.depth, seen));
    };
    Interval v{infinity, -infinity};
    for (const Uv p : strip) v = {std::min(v.lo, p.v), std::max(v.hi, p.v)};
    const Lines lines = inside(bounds_.lines_v(), v, v_.length());
    for (const double* at = lines.first; at != lines.last; ++at) {
      close(clipped(rest, 1, *at, 1));
      rest = clipped(rest, 1, *at, -1);
    }
    close(rest);
  };
  Polygon rest(uv.begin(), uv.end());
  const Lines lines = inside(bounds_.lines_u(), spread(uv[0].u, uv[1].u, uv[2].u), u_.length());
  for (const double* at = lines.first; at != lines.last; ++at) {
    across(clipped(rest, 0, *at, 1));
    rest = clipped(rest, 0, *at, -1);
  }
  across(rest);
  return worst;
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
