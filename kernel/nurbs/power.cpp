#include "kernel/nurbs/power.h"

namespace trimloop {
namespace {

// Bernstein ordinates on [0, h] of c0 + c1 t + c2 t^2 + c3 t^3.
std::array<double, 4> bernstein(double c0, double c1, double c2, double c3, double h) {
  const double b1 = c1 * h, b2 = c2 * h * h, b3 = c3 * h * h * h;
  return {c0, c0 + b1 / 3, c0 + (2 * b1 + b2) / 3, c0 + b1 + b2 + b3};
}

// Cubic knots with the breaks three-fold inside and four-fold at the ends.
std::vector<double> cubic_knots(std::span<const double> breaks) {
  std::vector<double> knots;
  knots.reserve(3 * breaks.size() + 2);
  knots.push_back(breaks.front());
  for (const double t : breaks) knots.insert(knots.end(), 3, t);
  knots.push_back(breaks.back());
  return knots;
}

bool ascending(std::span<const double> breaks) {
  for (std::size_t i = 1; i < breaks.size(); ++i)
    if (!(breaks[i - 1] < breaks[i])) return false;
  return breaks.size() >= 2;
}

// Poles of one bicubic patch, [k][l] with k along u.
std::array<std::array<Point, 4>, 4> patch_poles(const std::array<double, 48>& c, double hu, double hv) {
  std::array<std::array<Point, 4>, 4> poles{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double* a = c.data() + 16 * axis;
    std::array<std::array<double, 4>, 4> rows{};  // [l][k]: Bernstein along u, still powers of v
    for (std::size_t l = 0; l < 4; ++l) rows[l] = bernstein(a[4 * l], a[4 * l + 1], a[4 * l + 2], a[4 * l + 3], hu);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto column = bernstein(rows[0][k], rows[1][k], rows[2][k], rows[3][k], hv);
      for (std::size_t l = 0; l < 4; ++l) {
        Point& p = poles[k][l];
        (axis == 0 ? p.x : axis == 1 ? p.y : p.z) = column[l];
      }
    }
  }
  return poles;
}

}  // namespace

Result<PowerCurve> from_power(std::span<const double> breaks, std::span<const std::array<double, 12>> segments) {
  if (!ascending(breaks) || segments.size() + 1 < breaks.size())
    return fail(ErrorCode::InvalidArgument, "the breakpoints of the spline are not ascending");
  const std::size_t n = breaks.size() - 1;
  std::vector<Hpoint> poles(3 * n + 1);
  double gap = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto& c = segments[i];
    const double h = breaks[i + 1] - breaks[i];
    const auto x = bernstein(c[0], c[1], c[2], c[3], h), y = bernstein(c[4], c[5], c[6], c[7], h),
               z = bernstein(c[8], c[9], c[10], c[11], h);
    if (i > 0) gap = std::max(gap, distance(project(poles[3 * i]), {x[0], y[0], z[0]}));
    for (std::size_t k = 0; k < 4; ++k) poles[3 * i + k] = {x[k], y[k], z[k], 1};
  }
  auto curve = NurbsCurve::from_homogeneous(3, cubic_knots(breaks), std::move(poles));
  if (!curve) return tl::unexpected<Error>(curve.error());
  return PowerCurve{std::move(*curve), gap};
}

Result<PowerSurface> from_power(std::span<const double> breaks_u, std::span<const double> breaks_v,
                                std::span<const std::array<double, 48>> patches, std::size_t stride) {
  if (!ascending(breaks_u) || !ascending(breaks_v))
    return fail(ErrorCode::InvalidArgument, "the breakpoints of the spline surface are not ascending");
  const std::size_t m = breaks_u.size() - 1, n = breaks_v.size() - 1;
  if (stride < n || patches.size() < (m - 1) * stride + n)
    return fail(ErrorCode::InvalidArgument, "the spline surface has fewer patches than its breakpoints ask for");
  const std::size_t width = 3 * n + 1;
  std::vector<Hpoint> poles((3 * m + 1) * width);
  double gap = 0;
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const auto patch =
          patch_poles(patches[i * stride + j], breaks_u[i + 1] - breaks_u[i], breaks_v[j + 1] - breaks_v[j]);
      for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t l = 0; l < 4; ++l) {
          Hpoint& pole = poles[(3 * i + k) * width + 3 * j + l];
          const Point p = patch[k][l];
          if ((i > 0 && k == 0) || (j > 0 && l == 0)) gap = std::max(gap, distance(project(pole), p));
          pole = {p.x, p.y, p.z, 1};
        }
    }
  }
  auto surface = NurbsSurface::from_homogeneous(3, 3, cubic_knots(breaks_u), cubic_knots(breaks_v), std::move(poles));
  if (!surface) return tl::unexpected<Error>(surface.error());
  return PowerSurface{std::move(*surface), gap};
}

}  // namespace trimloop
