#include "kernel/mesh/chart.h"

namespace trimloop::mesh {
namespace {

constexpr double max_aspect = 100;      // of steps in space, as far as the chart follows it
constexpr std::size_t max_cells = 24;   // per direction

constexpr double angle_share = 0.93;    // so that the longer direction of the elliptic lattice still keeps the angle
constexpr double max_bow = 0.25;        // of a side within the surface, as a share of the row beside it

// Into how many cells each smooth span is cut: symmetries of the analytic types need one.
struct CellsPerSpan {
  int u, v;
  explicit CellsPerSpan(const Surface& s) : u(0), v(0) {  // 0: by the number of spans
    if (std::holds_alternative<Plane>(s.shape) || std::holds_alternative<Cylinder>(s.shape)) u = v = 1;
    if (std::holds_alternative<Cone>(s.shape) || std::holds_alternative<Sphere>(s.shape) ||
        std::holds_alternative<Torus>(s.shape))
      u = 1, v = 10;
    if (std::holds_alternative<Revolution>(s.shape)) u = 1;
    if (std::holds_alternative<Extrusion>(s.shape)) v = 1;
  }
};

std::vector<double> cell_borders(const std::vector<double>& breaks, Interval range, int per_span) {
  std::vector<double> cuts{range.lo};
  const double narrowest = 1e-9 * range.length();  // a border of the loops may lie within rounding of a knot
  for (const double b : breaks)
    if (b - cuts.back() > narrowest && range.hi - b > narrowest) cuts.push_back(b);
  cuts.push_back(range.hi);
  if (cuts.size() - 1 > max_cells) cuts = {range.lo, range.hi}, per_span = max_cells;
  const std::size_t spans = cuts.size() - 1;
  if (per_span == 0) per_span = spans == 1 ? 4 : spans <= 4 ? 3 : spans <= 12 ? 2 : 1;
  std::vector<double> borders;
  for (std::size_t i = 0; i < spans; ++i)
    for (int k = 0; k < per_span; ++k)
      borders.push_back(Interval{cuts[i], cuts[i + 1]}.at(static_cast<double>(k) / per_span));
  borders.push_back(range.hi);
  return borders;
}

// log(step u / step v) with both steps held within the size of the face and the aspect cap.
double log_aspect(const Steps& s, double size_mm) {
  double u = std::min(s.u * s.length_u, size_mm), v = std::min(s.v * s.length_v, size_mm);
  u = std::min(u, max_aspect * v), v = std::min(v, max_aspect * u);
  return std::log((u / s.length_u) / (v / s.length_v));
}

void integrate_slopes(PiecewiseLinear& f, const std::vector<double>& slope) {
  f.to.assign(1, 0);
  for (std::size_t i = 0; i < slope.size(); ++i) f.to.push_back(f.to.back() + slope[i] * (f.from[i + 1] - f.from[i]));
}

// Least squares of log(step u / step v) = row part + column part: means of rows and columns.
void stretch(Chart& chart, double size_mm) {
  const std::size_t nu = chart.cells_u(), nv = chart.cells_v();
  std::vector<double> sum_u(nu, 0), sum_v(nv, 0), count_u(nu, 0), count_v(nv, 0);
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < nu; ++i) {
    for (std::size_t j = 0; j < nv; ++j) {
      const double a = chart.cell(i, j).valid ? log_aspect(chart.cell(i, j), size_mm) : not_measured;
      if (!std::isfinite(a)) continue;
      sum_u[i] += a, sum_v[j] += a, sum += a;
      count_u[i]++, count_v[j]++, count++;
    }
  }
  const double mean = count > 0 ? sum / count : 0;
  std::vector<double> slope_u(nu), slope_v(nv);
  for (std::size_t i = 0; i < nu; ++i) slope_u[i] = std::exp(count_u[i] > 0 ? mean - sum_u[i] / count_u[i] : 0);
  for (std::size_t j = 0; j < nv; ++j) slope_v[j] = std::exp(count_v[j] > 0 ? sum_v[j] / count_v[j] : mean);

  double log_step = 0, steps = 0;  // geometric mean of the local step in the chart so far
  for (std::size_t i = 0; i < nu; ++i) {
    for (std::size_t j = 0; j < nv; ++j) {
      const Steps& s = chart.cell(i, j);
      if (!s.valid) continue;
      const double u = std::min(s.u * s.length_u, size_mm) / s.length_u, v = std::min(s.v * s.length_v, size_mm) / s.length_v;
      const double log_here = 0.5 * std::log(u * slope_u[i] * v * slope_v[j]);
      if (std::isfinite(log_here)) log_step += log_here, steps++;
    }
  }
  const double scale = steps > 0 ? std::exp(-log_step / steps) : 1;
  for (double& x : slope_u) x *= scale;
  for (double& x : slope_v) x *= scale;
  integrate_slopes(chart.u, slope_u);
  integrate_slopes(chart.v, slope_v);
}

}  // namespace

double PiecewiseLinear::map(const std::vector<double>& a, const std::vector<double>& b, double x) {
  const std::size_t last = a.size() - 2;
  std::size_t i = 0;
  if (last > 0) {
    const auto above = std::upper_bound(a.begin() + 1, a.end() - 1, x);
    i = static_cast<std::size_t>(above - a.begin()) - 1;
  }
  return b[i] + (x - a[i]) * ((b[i + 1] - b[i]) / (a[i + 1] - a[i]));
}

// Deviation of a chord of parameter length h over a surface with second form L: L h^2 / 8. An equilateral triangle of
// side s on an elliptic place deviates k s^2 / 6, one with sides along the directions of a hyperbolic place k s^2 / 8.
// The twist M is shared out as if steps were isotropic in space.
Steps admissible_steps(const SurfaceJet& j, double deflection_mm, double angle_rad) {
  Steps s;
  s.length_u = norm(j.du), s.length_v = norm(j.dv);
  const Vector cr = cross(j.du, j.dv);
  const double area = norm(cr);
  if (!(area > 1e-9 * s.length_u * s.length_v) || !std::isfinite(area)) return s;
  s.valid = true;
  const Vector n = cr / area;
  const double L = dot(n, j.duu), M = dot(n, j.duv), N = dot(n, j.dvv);
  const double E = dot(j.du, j.du), F = dot(j.du, j.dv), G = dot(j.dv, j.dv);
  const double K = (L * N - M * M) / (area * area);
  const double H = (E * N - 2 * F * M + G * L) / (2 * area * area);
  s.elliptic = K > 0.05 * H * H;
  const double factor = s.elliptic ? 5.2 : 8.9;  // geometric means of the lattice's two directions, see seeds.cpp
  const double twist = std::abs(M) * s.length_u / s.length_v;
  const double bend_u = std::abs(L) + twist, bend_v = std::abs(N) + twist * (G / E);
  s.u = std::sqrt(factor * deflection_mm / bend_u);
  s.v = std::sqrt(factor * deflection_mm / bend_v);
  // A side that bends within the surface must not sweep over the next row: its bow stays below a third of a row.
  const auto bow = [&](Vector d1, Vector d2) { return std::abs(dot(d2, cross(n, d1))) / norm(d1); };
  const double row_v = s.v * s.length_v, row_u = s.u * s.length_u;
  s.u = std::min(s.u, std::sqrt(8 * max_bow * row_v / bow(j.du, j.duu)));
  s.v = std::min(s.v, std::sqrt(8 * max_bow * row_u / bow(j.dv, j.dvv)));
  const auto turn = [&](Vector d) { return norm(d - dot(d, n) * n) / area; };  // |dn/du|
  const double angle_u = angle_share * angle_rad / turn(cross(j.duu, j.dv) + cross(j.du, j.duv));
  const double angle_v = angle_share * angle_rad / turn(cross(j.duv, j.dv) + cross(j.du, j.dvv));
  if (angle_u < s.u || angle_v < s.v) s.elliptic = true;  // the angle bounds a side in every direction alike
  s.u = std::min(s.u, angle_u), s.v = std::min(s.v, angle_v);
  return s;
}

Chart make_chart(const Surface& surface, Interval u, Interval v, double size_mm, double deflection_mm, double angle_rad) {
  Chart chart;
  const CellsPerSpan per_span(surface);
  chart.u.from = cell_borders(breaks_u(surface), u, per_span.u);
  chart.v.from = cell_borders(breaks_v(surface), v, per_span.v);
  for (std::size_t i = 0; i < chart.cells_u(); ++i) {
    for (std::size_t j = 0; j < chart.cells_v(); ++j) {
      const Uv at{0.5 * (chart.u.from[i] + chart.u.from[i + 1]), 0.5 * (chart.v.from[j] + chart.v.from[j + 1])};
      chart.steps.push_back(admissible_steps(jet(surface, at), deflection_mm, angle_rad));
      const Steps& s = chart.steps.back();
      if (s.valid && (s.u * s.length_u < size_mm || s.v * s.length_v < size_mm)) chart.curved = true;
    }
  }
  stretch(chart, size_mm);
  return chart;
}

}  // namespace trimloop::mesh
