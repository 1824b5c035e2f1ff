#include "kernel/mesh/certificate.h"

#include "kernel/mesh/distance.h"

namespace trimloop::mesh {
namespace {

constexpr double lagrange = 0.125 / 6;           // see the head of certificate.h; found on a grid of 16 million places
constexpr double cubic_share = 0.1181;         // likewise
constexpr double linear = 0.125;
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

std::array<double, 3> barycentric(Point p, const Facet& f) {
  const Vector d = p - f.corner[0];
  const double b = dot(d, f.gradient[1]), c = dot(d, f.gradient[2]);
  return {1 - b - c, b, c};
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
  std::ptrdiff_t count() const { return last - first; }
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

bool Certificate::crosses_crease(const std::array<Uv, 3>& d) const {
  const SurfaceBounds::Lines& lines = bounds_.lines();
  return inside(lines.creases_u, spread(d[0].u, d[1].u, d[2].u), u_.length()).count() != 0 ||
         inside(lines.creases_v, spread(d[0].v, d[1].v, d[2].v), v_.length()).count() != 0;
}

Certificate::Remainder::Cubic Certificate::Remainder::cubic(Vector n) const {
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

bool Certificate::remainder(const std::array<Uv, 3>& uv, Remainder& r) {
  const Interval u = spread(uv[0].u, uv[1].u, uv[2].u), v = spread(uv[0].v, uv[1].v, uv[2].v);
  if (!bounds_.enclose(u, v, r.d)) return false;
  const SurfaceBounds::Lines& lines = bounds_.lines();
  const auto rough_u = inside(lines.rough_u, u, u_.length()).count(), rough_v = inside(lines.rough_v, v, v_.length()).count();
  r.edge = {uv[1] - uv[0], uv[2] - uv[0]};
  const double wide = u.length(), high = v.length();
  r.uu = linear * wide * wide, r.uv = 2 * linear * wide * high, r.vv = linear * high * high;
  r.jumps = 0.25 * (static_cast<double>(rough_u) * lines.jump_u * wide + static_cast<double>(rough_v) * lines.jump_v * high);
  r.linear_all = r.uu * largest_norm(r.d.uu) + r.uv * largest_norm(r.d.uv) + r.vv * largest_norm(r.d.vv) + r.jumps;
  r.is_second = rough_u + rough_v != 0;
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

// Largest |h| of Q over what lies beyond side k of its own facet, m being h at the middles. The barycentric coordinate of
// S there is l_k + psi with psi zero at the corners, so that these places have l_k at most `depth`.
double Certificate::near_side(const SurfacePiece& d, const Facet& f, const Remainder& r, const std::array<double, 3>& m, std::size_t k) {
  std::array<double, 3> psi;
  for (std::size_t i = 0; i < 3; ++i) psi[i] = dot(d.middle[i] - midpoint(d.corner[(i + 1) % 3], d.corner[(i + 2) % 3]), f.gradient[k]);
  const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
  const double rest = r.along(f.gradient[k]) + rounding * f.size * norm(f.gradient[k]);
  const double slope = 4 * std::max(std::abs(psi[i]), std::abs(psi[j]));
  double depth = 1;  // what 4 (psi_i l_j + psi_j l_i) l_k can take, twice
  for (int pass = 0; pass < 2; ++pass) depth = std::min(depth, std::max(0.0, -psi[k]) + slope * std::min(depth * (1 - depth), 0.25) + rest);
  return std::abs(m[k]) + 4 * std::min(depth, 0.5) * std::max(std::abs(m[i]), std::abs(m[j]));
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
  const double noise = rounding * f.size;
  result.across = std::min(top.value + r.along(f.normal), r.linear_along(f.normal)) + noise;
  std::array<Lens, 3> lens;
  if (!lenses(d, f, r, lens)) {
    estimate(d, f, r, infinity, result);
    return result;
  }
  result.bound = result.across;
  const double left = r.along(f.normal) + noise;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(lens[k].bow > 0)) continue;
    const double bow = lens[k].bow + noise;
    double folded = std::min(result.across, near_side(d, f, r, m, k) + left), aside = bow;
    if (neighbours[k] && has_room(*neighbours[k], f.corner[(k + 1) % 3], f.corner[(k + 2) % 3], lens[k].stretch * bow)) {
      const double cosine = std::min(1.0, dot(f.normal, neighbours[k]->normal));
      if (cosine > 0) folded += bow * std::sqrt(1 - cosine * cosine), aside = bow * (1 - cosine);
    }
    result.bound = std::max(result.bound, std::sqrt(folded * folded + aside * aside));
  }
  return result;
}

namespace {

// Derivatives of the barycentric coordinates 1 and 2 of a facet along the edges 0-1 and 0-2 of its piece.
using Jacobian = std::array<std::array<double, 2>, 2>;

// Whether their determinant is positive all over the triangle: they are linear between `at` the corners, but for `stray`.
bool keeps_orientation(const std::array<Jacobian, 3>& at, const Jacobian& stray) {
  Jacobian most{};
  for (const Jacobian& j : at)
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t k = 0; k < 2; ++k) most[i][k] = std::max(most[i][k], std::abs(j[i][k]));
  double least = infinity;  // of its Bezier coefficients
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {
      const Jacobian &a = at[i], &b = at[j];
      least = std::min(least, 0.5 * (a[0][0] * b[1][1] + b[0][0] * a[1][1] - a[0][1] * b[1][0] - b[0][1] * a[1][0]));
    }
  }
  const double lost = (most[0][0] + stray[0][0]) * stray[1][1] + most[1][1] * stray[0][0] + (most[0][1] + stray[0][1]) * stray[1][0] +
                      most[1][0] * stray[0][1];
  return least > lost;
}

}  // namespace

// Seen along the facet's normal the piece is phi. Where its determinant is positive, a point lies in the image as often as
// the border of the image winds around it, that is, beyond the facet, as often as a side curve and its chord do: such a point
// is in the hull of a side curve. When each side curve stays on the inner side of the two other sides, what lies beyond
// side k is in the hull of curve k.
bool Certificate::lenses(const SurfacePiece& d, const Facet& f, const Remainder& r, std::array<Lens, 3>& out) {
  return (!r.is_second && lenses_by_third(d, f, r, out)) || lenses_by_second(f, r, out);
}

// S is Q, and a cubic, and what the third derivatives stray: its derivative along an edge by at most 1/2 (U^3 r_uuu + ...).
bool Certificate::lenses_by_third(const SurfacePiece& d, const Facet& f, const Remainder& r, std::array<Lens, 3>& out) {
  const std::array<Uv, 3> e{r.edge[1] - r.edge[0], r.edge[1], r.edge[0]};  // side i, opposite corner i
  std::array<Vector, 3> w;
  for (std::size_t i = 0; i < 3; ++i) w[i] = d.middle[i] - midpoint(d.corner[(i + 1) % 3], d.corner[(i + 2) % 3]);
  const double ball = 0.5 / lagrange * (r.uuu * r.d.uuu.radius + r.uuv * r.d.uuv.radius + r.uvv * r.d.uvv.radius + r.vvv * r.d.vvv.radius) +
                      16 * rounding * f.size;
  std::array<double, 3> length;
  for (std::size_t k = 0; k < 3; ++k) length[k] = norm(f.gradient[k]);
  std::array<Jacobian, 3> at;
  Jacobian stray;
  for (std::size_t i = 0; i < 2; ++i) {
    const Vector g = f.gradient[i + 1];
    const double p0 = 4 * dot(w[0], g), p1 = 4 * dot(w[1], g), p2 = 4 * dot(w[2], g);
    const double in_0 = i == 0 ? 1 : 0, in_1 = 1 - in_0;
    at[0][i] = {in_0 + p2, in_1 + p1};
    at[1][i] = {in_0 - p2, in_1 + p0 - p2};
    at[2][i] = {in_0 + p0 - p1, in_1 - p1};
    const Remainder::Cubic c = r.cubic(g);
    const double bubble = 0.25 * std::abs(c.bubble) + length[i + 1] * ball;
    stray[i] = {std::max(std::abs(c.a01), std::abs(c.a12) + std::abs(c.a20)) + bubble,
                std::max(std::abs(c.a20), std::abs(c.a12) + std::abs(c.a01)) + bubble};
  }
  if (!keeps_orientation(at, stray)) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto third = [&](std::size_t side, Vector n, double l) {  // along a side
      const double u = std::abs(e[side].u), v = std::abs(e[side].v);
      const Vector c = (e[side].u * e[side].u * e[side].u) * r.d.uuu.centre + (3 * e[side].u * e[side].u * e[side].v) * r.d.uuv.centre +
                       (3 * e[side].u * e[side].v * e[side].v) * r.d.uvv.centre + (e[side].v * e[side].v * e[side].v) * r.d.vvv.centre;
      return std::abs(dot(n, c)) + l * (u * u * u * r.d.uuu.radius + 3 * u * u * v * r.d.uuv.radius + 3 * u * v * v * r.d.uvv.radius +
                                        v * v * v * r.d.vvv.radius);
    };
    for (std::size_t j = 0; j < 3; ++j)  // the curve of side j, s + 4 w s (1 - s) + C/6 s (s - 1/2) (s - 1), against side k
      if (j != k && !(4 * std::abs(dot(w[j], f.gradient[k])) + third(j, f.gradient[k], length[k]) / 12 + 8 * rounding * f.size * length[k] <= 1))
        return false;
    const Vector outward = f.gradient[k] / -length[k];
    Lens& lens = out[k];
    lens.bow = std::max(0.0, dot(w[k], outward)) + curve_remainder * third(k, outward, 1);
    const Vector chord = f.corner[(k + 2) % 3] - f.corner[(k + 1) % 3];
    const double reach = norm(chord);
    // The curve's points slide along the chord by at most 4 slide s (1 - s).
    const double slide = (std::abs(dot(w[k], chord)) / reach + third(k, chord / reach, 1) / 48) / reach;
    lens.stretch = 4 * slide < 1 ? 1 / ((1 - 4 * slide) * (1 - 4 * slide)) : infinity;
  }
  return true;
}

bool Certificate::lenses_by_second(const Facet& f, const Remainder& r, std::array<Lens, 3>& out) {
  struct Second {
    Vector centre;
    double radius;
  };
  const auto second = [&](Uv a, Uv b) {
    return Second{a.u * b.u * r.d.uu.centre + (a.u * b.v + a.v * b.u) * r.d.uv.centre + a.v * b.v * r.d.vv.centre,
                  std::abs(a.u * b.u) * r.d.uu.radius + (std::abs(a.u * b.v) + std::abs(a.v * b.u)) * r.d.uv.radius +
                      std::abs(a.v * b.v) * r.d.vv.radius};
  };
  const std::array<Uv, 3> e{r.edge[1] - r.edge[0], r.edge[1], r.edge[0]};
  const std::array<Second, 3> along{second(e[0], e[0]), second(e[1], e[1]), second(e[2], e[2])};
  const Second s01 = second(e[2], e[1]), &s00 = along[2], &s11 = along[1];
  std::array<double, 3> length;
  for (std::size_t k = 0; k < 3; ++k) length[k] = norm(f.gradient[k]);
  std::array<Jacobian, 3> at;
  Jacobian stray;
  for (std::size_t i = 0; i < 2; ++i) {  // at the middle of an edge those of the facet, from there to the corners by second derivatives
    const Vector g = f.gradient[i + 1];
    const double c00 = 0.5 * dot(g, s00.centre), c01 = dot(g, s01.centre), c11 = 0.5 * dot(g, s11.centre);
    const double in_0 = i == 0 ? 1 : 0, in_1 = 1 - in_0;
    at[0][i] = {in_0 - c00, in_1 - c11};
    at[1][i] = {in_0 + c00, in_1 + c01 - c11};
    at[2][i] = {in_0 + c01 - c00, in_1 + c11};
    stray[i] = {length[i + 1] * (s00.radius + s01.radius + r.jumps), length[i + 1] * (s11.radius + s01.radius + r.jumps)};
  }
  if (!keeps_orientation(at, stray)) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t j = 0; j < 3; ++j)  // the curve of side j against side k
      if (j != k && !(std::abs(dot(f.gradient[k], along[j].centre)) + length[k] * (along[j].radius + 4 * r.jumps) <= 2)) return false;
    const Vector outward = f.gradient[k] / -length[k];
    Lens& lens = out[k];
    lens.bow = std::max(0.0, 0.125 * (along[k].radius - dot(outward, along[k].centre)) + r.jumps);
    const Vector chord = f.corner[(k + 2) % 3] - f.corner[(k + 1) % 3];
    const double length2 = dot(chord, chord);
    // The curve's points slide along the chord by at most 4 slide s (1 - s).
    const double slide = 0.125 * (std::abs(dot(chord, along[k].centre)) / length2 + along[k].radius / std::sqrt(length2)) + r.jumps / std::sqrt(length2);
    lens.stretch = 4 * slide < 1 ? 1 / ((1 - 4 * slide) * (1 - 4 * slide)) : infinity;
  }
  return true;
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
