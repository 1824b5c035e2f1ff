#include "kernel/mesh/certificate_detail.h"

// Seen along the facet's normal its own piece is a map of the plane. Where its determinant is positive, a point lies in the
// image as often as the border of the image winds around it, that is, beyond the facet, as often as a side curve and its
// chord do: such a point is in the hull of a side curve. When each side curve stays on the inner side of the two other
// sides, what lies beyond side k is in the hull of curve k.

namespace trimloop::mesh::certificate_detail {
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

// The curve of side k slides along its chord by at most 4 slide s (1 - s).
double stretched(double slide) { return 4 * slide < 1 ? 1 / ((1 - 4 * slide) * (1 - 4 * slide)) : infinity; }

// Where corner k stands over the chord of side k, as a share of it: a place along the chord is coordinate k + 2 and this share of k.
double foot(const Facet& f, std::size_t k) {
  const Point a = f.corner[(k + 1) % 3];
  const Vector chord = f.corner[(k + 2) % 3] - a;
  return dot(f.corner[k] - a, chord) / dot(chord, chord);
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

}  // namespace

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

Lines inside(const std::vector<double>& lines, Interval x, double whole) {
  if (lines.empty()) return {nullptr, nullptr};
  const double slack = ignored * std::max(whole, x.length());
  const auto first = std::upper_bound(lines.begin(), lines.end(), x.lo + slack);
  const auto last = std::lower_bound(first, lines.end(), x.hi - slack);
  return {lines.data() + (first - lines.begin()), lines.data() + (last - lines.begin())};
}

// S is Q, and a cubic, and what the third derivatives stray.
bool find_lenses(const Facet& f, const std::array<ByThird, 3>& b, std::array<Lens, 3>& out) {
  std::array<Jacobian, 3> at;
  Jacobian stray;
  for (std::size_t i = 0; i < 2; ++i) {
    const ByThird& s = b[i + 1];
    const double p0 = 4 * s.psi[0], p1 = 4 * s.psi[1], p2 = 4 * s.psi[2];
    const double in_0 = i == 0 ? 1 : 0, in_1 = 1 - in_0;
    at[0][i] = {in_0 + p2, in_1 + p1};
    at[1][i] = {in_0 - p2, in_1 + p0 - p2};
    at[2][i] = {in_0 + p0 - p1, in_1 - p1};
    const double a01 = std::abs(s.cubic.a01), a12 = std::abs(s.cubic.a12), a20 = std::abs(s.cubic.a20);
    const double rest = 0.25 * std::abs(s.cubic.bubble) + s.stray;
    stray[i] = {std::max(a01, a12 + a20) + rest, std::max(a20, a12 + a01) + rest};
  }
  if (!keeps_orientation(at, stray)) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    // The curve of side j is s + 4 psi s (1 - s) + C/6 s (s - 1/2) (s - 1) against side k.
    for (std::size_t j = 0; j < 3; ++j)
      if (j != k && !(4 * std::abs(b[k].psi[j]) + b[k].third[j] / 12 <= 1)) return false;
    out[k].bow = (std::max(0.0, -b[k].psi[k]) + curve_remainder * b[k].third[k]) / norm(f.gradient[k]);
    const ByThird& along = b[(k + 2) % 3];
    const double share = foot(f, k);
    out[k].stretch = stretched(std::abs(along.psi[k] + share * b[k].psi[k]) + (along.third[k] + std::abs(share) * b[k].third[k]) / 48);
  }
  return true;
}

// At the middle of an edge the derivatives are the facet's; from there to the corners they go by second derivatives.
bool find_lenses(const Facet& f, const std::array<BySecond, 3>& b, std::array<Lens, 3>& out) {
  std::array<Jacobian, 3> at;
  Jacobian stray;
  for (std::size_t i = 0; i < 2; ++i) {
    const BySecond& s = b[i + 1];
    const double c00 = 0.5 * s.bend[2], c01 = s.bend_01, c11 = 0.5 * s.bend[1];
    const double in_0 = i == 0 ? 1 : 0, in_1 = 1 - in_0;
    at[0][i] = {in_0 - c00, in_1 - c11};
    at[1][i] = {in_0 + c00, in_1 + c01 - c11};
    at[2][i] = {in_0 + c01 - c00, in_1 + c11};
    stray[i] = {0.75 * s.sway[2] + s.sway_01 + s.jump, 0.75 * s.sway[1] + s.sway_01 + s.jump};
  }
  if (!keeps_orientation(at, stray)) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t j = 0; j < 3; ++j)  // the curve of side j against side k
      if (j != k && !(std::abs(b[k].bend[j]) + b[k].sway[j] + 4 * b[k].jump <= 2)) return false;
    out[k].bow = std::max(0.0, 0.125 * (b[k].bend[k] + b[k].sway[k]) + b[k].jump) / norm(f.gradient[k]);
    const BySecond& along = b[(k + 2) % 3];
    const double share = foot(f, k);
    out[k].stretch = stretched(0.125 * (std::abs(along.bend[k] + share * b[k].bend[k]) + along.sway[k] + std::abs(share) * b[k].sway[k]) +
                               along.jump + std::abs(share) * b[k].jump);
  }
  return true;
}

// What lies beyond side k has l_k + psi_k < 0, so that l_k is at most `depth` there.
double near_side(const std::array<double, 3>& m, const std::array<double, 3>& psi, double rest, std::size_t k) {
  const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
  const double slope = 4 * std::max(std::abs(psi[i]), std::abs(psi[j]));
  double depth = 1;
  for (int pass = 0; pass < 2; ++pass)  // 4 (psi_i l_j + psi_j l_i) l_k is at most slope l_k (1 - l_k)
    depth = std::min(depth, std::max(0.0, -psi[k]) + slope * std::min(depth, 0.25) + rest);
  return std::abs(m[k]) + 4 * std::min(depth, 0.25) * std::max(std::abs(m[i]), std::abs(m[j]));
}

double with_lenses(const Facet& f, const std::array<const Facet*, 3>& neighbours, const std::array<Lens, 3>& lens, double across,
                   const std::array<Edge, 3>& edges, double noise) {
  double bound = across;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(lens[k].bow > 0)) continue;
    const Edge& edge = edges[k];
    const double bow = lens[k].bow + noise;
    double sine = 0, aside = bow;
    if (neighbours[k] && has_room(*neighbours[k], f.corner[(k + 1) % 3], f.corner[(k + 2) % 3], lens[k].stretch * bow)) {
      const double cosine = std::min(1.0, dot(f.normal, neighbours[k]->normal));
      if (cosine > 0) sine = std::sqrt(1 - cosine * cosine), aside = bow * (1 - cosine);
    }
    const double folded = std::max(std::min(across, edge.beside), std::min(across, edge.at_side) + (edge.reach + noise) * sine);
    bound = std::max(bound, std::sqrt(folded * folded + aside * aside));
  }
  return bound;
}

}  // namespace trimloop::mesh::certificate_detail
