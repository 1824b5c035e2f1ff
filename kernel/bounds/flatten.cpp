// Distance from chords and from bilinear patches, and polylines by it.

#include <algorithm>

#include "kernel/bounds/bounds.h"
#include "kernel/bounds/polynomial.h"
#include "kernel/nurbs/binomial.h"

namespace trimloop {

namespace {

double distance_to_segment(Point p, Point a, Point b) {
  const Vector along = b - a;
  const double length2 = dot(along, along);
  const double t = length2 > 0 ? Interval{0, 1}.clamp(dot(p - a, along) / length2) : 0;
  return distance(p, a + t * along);
}

// The distance from a segment is a convex function: over the hull of the poles it is largest at one of them.
double hull_width(std::span<const Hpoint> poles) {
  double width = 0, size = 0, lo = infinity, hi = 0;
  const Point a = project(poles.front()), b = project(poles.back());
  for (const Hpoint& h : poles) {
    if (!(h.w > 0) || !is_finite(project(h))) return infinity;
    width = std::max(width, distance_to_segment(project(h), a, b));
    size = std::max(size, norm(to_vector(project(h))));
    lo = std::min(lo, h.w);
    hi = std::max(hi, h.w);
  }
  return width + bounds::eps * (12 * static_cast<double>(poles.size()) + 12) * size * hi / lo;
}

// Both halves, sharing a pole.
void halve(std::vector<Hpoint>& low, std::vector<Hpoint>& high) {
  const std::size_t n = low.size();
  high.resize(n);
  high[n - 1] = low[n - 1];
  for (std::size_t r = 1; r < n; ++r) {
    for (std::size_t i = n; i-- > r;) low[i] = 0.5 * (low[i] + low[i - 1]);
    high[n - 1 - r] = low[n - 1];
  }
}

}  // namespace

double chord_height_bound(const CurvePieces& c, std::size_t piece) { return hull_width(c.bezier(piece)); }

// With B the bilinear patch, S - B = (A - w B) / w, a polynomial of degrees (p + 1, q + 1) over a positive one.
double bilinear_deviation_bound(const SurfacePieces& s, std::size_t a, std::size_t b) {
  const int p = s.degree_u(), q = s.degree_v();
  const std::span<const Hpoint> poles = s.bezier(a, b);
  const bounds::Homogeneous h = bounds::homogeneous(poles, p, q);
  const double lowest = h.w.lowest();
  if (!(lowest > 0)) return infinity;
  const std::size_t row = static_cast<std::size_t>(p) + 1;
  const std::array<std::size_t, 4> corner{0, row * static_cast<std::size_t>(q), row - 1, poles.size() - 1};
  const bounds::Polynomial one{1, 1, {1, 1, 1, 1}, 0};
  double out = 0, errors = 0;
  std::array<bounds::Polynomial, 3> difference;
  for (std::size_t k = 0; k < 3; ++k) {
    bounds::Polynomial bilinear{1, 1, {}, 0};
    for (std::size_t at : corner) {
      const Vector v = project(poles[at]) - h.origin;
      bilinear.c.push_back(k == 0 ? v.x : k == 1 ? v.y : v.z);
    }
    bilinear.error = 2 * bounds::eps * (bilinear.magnitude() + norm(to_vector(h.origin)));
    difference[k] = one * h.a[k] - h.w * bilinear;
    errors += difference[k].error;
  }
  for (std::size_t i = 0; i < difference[0].c.size(); ++i)
    out = std::max(out, norm(Vector{difference[0].c[i], difference[1].c[i], difference[2].c[i]}));
  return (out + errors) / lowest * (1 + 4 * bounds::eps);
}

Result<Flattening> flatten(const NurbsCurve& c, double tolerance_mm, std::size_t most) {
  if (!(tolerance_mm > 0))
    return tl::unexpected(
        Error{ErrorCode::InvalidArgument, "the tolerance of a flattening is positive", tolerance_mm, 0});
  const CurvePieces pieces(c);
  Flattening out;
  out.t.push_back(pieces.spans().lo());
  out.points.push_back(project(pieces.bezier(0).front()));
  struct Part {
    std::vector<Hpoint> poles;
    Interval t;
  };
  std::vector<Part> open;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::span<const Hpoint> poles = pieces.bezier(i);
    open.push_back({{poles.begin(), poles.end()}, pieces.spans()[i]});
    while (!open.empty()) {
      Part part = std::move(open.back());
      open.pop_back();
      const double width = hull_width(part.poles);
      if (width <= tolerance_mm) {
        out.bound = std::max(out.bound, width);
        out.t.push_back(part.t.hi);
        out.points.push_back(project(part.poles.back()));
        continue;
      }
      const double middle = part.t.mid();
      if (out.t.size() + open.size() >= most || !(middle > part.t.lo && middle < part.t.hi))
        return tl::unexpected(Error{ErrorCode::Limit, "too many points for this tolerance", width, tolerance_mm});
      Part high{{}, {middle, part.t.hi}};
      part.t.hi = middle;
      halve(part.poles, high.poles);
      open.push_back(std::move(high));
      open.push_back(std::move(part));
    }
  }
  return out;
}

}  // namespace trimloop
