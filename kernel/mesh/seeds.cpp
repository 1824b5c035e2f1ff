#include "kernel/mesh/seeds.h"

namespace trimloop::mesh {
namespace {

// Steps along a row and between rows, as shares of the admissible step: equilateral triangles are rows of step 1 at
// distance sqrt(3)/2; on hyperbolic places staggered rows of step sqrt(8) at distance sqrt(10) use the bound fully.
constexpr double elliptic_along = 1.074, elliptic_across = 0.93;
constexpr double hyperbolic_along = 0.948, hyperbolic_across = 1.06;
constexpr double tightness = 0.92;   // of all steps: curvature varies between the places that were looked at
constexpr double clearance = 0.4;    // distance from the boundary in local steps

// Integral of a piecewise-constant density over cells, and its inverse.
struct Cumulative {
  const std::vector<double>* at = nullptr;  // cell borders
  std::vector<double> sum;                  // at the borders

  void set(const std::vector<double>& borders, const std::vector<double>& density) {
    at = &borders;
    sum.assign(1, 0);
    for (std::size_t i = 0; i < density.size(); ++i) sum.push_back(sum.back() + density[i] * (borders[i + 1] - borders[i]));
  }
  double value(double x) const {
    const std::size_t i = cell(*at, x);
    return sum[i] + (x - (*at)[i]) / ((*at)[i + 1] - (*at)[i]) * (sum[i + 1] - sum[i]);
  }
  double place(double s) const {  // sum must rise around s
    const std::size_t i = cell(sum, s);
    const double rise = sum[i + 1] - sum[i];
    return (*at)[i] + (rise > 0 ? (s - sum[i]) / rise : 0.5) * ((*at)[i + 1] - (*at)[i]);
  }
  static std::size_t cell(const std::vector<double>& borders, double x) {
    const auto above = std::upper_bound(borders.begin() + 1, borders.end() - 1, x);
    return static_cast<std::size_t>(above - borders.begin()) - 1;
  }
};

// The chart with rows running along its first coordinate, whichever of u and v that is.
class Rows {
 public:
  Rows(const Chart& chart, bool along_u) : chart_(chart), along_u_(along_u) {}

  const std::vector<double>& along() const { return along_u_ ? chart_.u.to : chart_.v.to; }
  const std::vector<double>& across() const { return along_u_ ? chart_.v.to : chart_.u.to; }
  std::size_t cells_along() const { return along().size() - 1; }
  std::size_t cells_across() const { return across().size() - 1; }
  Uv turned(Uv p) const { return along_u_ ? p : Uv{p.v, p.u}; }  // its own inverse

  // Points wanted per chart unit in cell (i along, j across); 0 where the surface is straight or has no normal.
  double density_along(std::size_t i, std::size_t j) const { return density(i, j, along_u_, elliptic_along, hyperbolic_along); }
  double density_across(std::size_t i, std::size_t j) const { return density(i, j, !along_u_, elliptic_across, hyperbolic_across); }

  // How unevenly the rows' distance is wanted along the rows: what choosing one distance per row loses.
  double unevenness() const {
    double total = 0;
    for (std::size_t j = 0; j < cells_across(); ++j) {
      double low = infinity, high = 0;
      for (std::size_t i = 0; i < cells_along(); ++i) {
        const double d = density_across(i, j);
        low = std::min(low, d), high = std::max(high, d);
      }
      total += high > 0 ? 1 - low / high : 0;
    }
    return total / static_cast<double>(cells_across());
  }

 private:
  double density(std::size_t i, std::size_t j, bool in_u, double elliptic, double hyperbolic) const {
    const std::size_t cu = along_u_ ? i : j, cv = along_u_ ? j : i;
    const Steps& s = chart_.cell(cu, cv);
    if (!s.valid) return 0;
    const PiecewiseLinear& f = in_u ? chart_.u : chart_.v;
    const std::size_t c = in_u ? cu : cv;
    const double slope = (f.to[c + 1] - f.to[c]) / (f.from[c + 1] - f.from[c]);
    const double step = (in_u ? s.u : s.v) * slope * (s.elliptic ? elliptic : hyperbolic) * tightness;
    return step > 0 ? 1 / step : 0;
  }

  const Chart& chart_;
  bool along_u_;
};

// Segments of the polygon met by a horizontal line that only moves upwards.
class Scanline {
 public:
  struct Side {
    Uv lo, hi;  // by second coordinate
  };

  Scanline(const Rows& rows, std::span<const Uv> polygon, std::span<const Segment> segments) {
    for (const Segment s : segments) {
      Uv a = rows.turned(polygon[s.a]), b = rows.turned(polygon[s.b]);
      if (b.v < a.v) std::swap(a, b);
      sides_.push_back({a, b});
    }
    std::sort(sides_.begin(), sides_.end(), [](const Side& a, const Side& b) { return a.lo.v < b.lo.v; });
  }

  void move_to(double v, double reach) {
    for (; next_ < sides_.size() && sides_[next_].lo.v <= v + reach; ++next_) active_.push_back(sides_[next_]);
    const auto passed = [&](const Side& s) { return s.hi.v < v - reach; };
    active_.erase(std::remove_if(active_.begin(), active_.end(), passed), active_.end());
  }

  // Ascending places where the line enters and leaves the inside.
  void crossings(double v, std::vector<double>& out) const {
    out.clear();
    for (const Side& s : active_)
      if (s.lo.v <= v && v < s.hi.v) out.push_back(s.lo.u + (v - s.lo.v) / (s.hi.v - s.lo.v) * (s.hi.u - s.lo.u));
    std::sort(out.begin(), out.end());
  }

  // Intervals along the line that are nearer to a side than `reach`, ascending by lower end.
  void blocked(double v, double reach, std::vector<Interval>& out) const {
    out.clear();
    for (const Side& s : active_) {
      if (s.lo.v > v + reach) continue;
      const double height = s.hi.v - s.lo.v, slope = height > 0 ? (s.hi.u - s.lo.u) / height : 0;
      const double a = s.lo.v >= v - reach || height <= 0 ? s.lo.u : s.lo.u + (v - reach - s.lo.v) * slope;
      const double b = s.hi.v <= v + reach || height <= 0 ? s.hi.u : s.lo.u + (v + reach - s.lo.v) * slope;
      out.push_back({std::min(a, b), std::max(a, b)});
    }
    std::sort(out.begin(), out.end(), [](Interval a, Interval b) { return a.lo < b.lo; });
  }

 private:
  std::vector<Side> sides_, active_;
  std::size_t next_ = 0;
};

class Seeder {
 public:
  Seeder(const Chart& chart, const Rows& rows, std::span<const Uv> polygon, std::span<const Segment> segments)
      : rows_(rows), scanline_(rows, polygon, segments) {
    (void)chart;
    for (const Uv p : polygon) {
      const double v = rows.turned(p).v;
      box_ = {std::min(box_.lo, v), std::max(box_.hi, v)};
    }
  }

  std::vector<Uv> run(std::size_t max_points) {
    const Cumulative across = distances();
    const double lo = across.value(box_.lo), total = across.value(box_.hi) - lo;
    if (!(total > 1.1) || total > static_cast<double>(max_points)) return {};
    const auto bands = static_cast<std::size_t>(std::ceil(total - 0.1));
    for (std::size_t k = 1; k < bands && seeds_.size() <= max_points; ++k) {
      const double s = lo + total * static_cast<double>(k) / static_cast<double>(bands);
      const double v = across.place(s), above = across.place(s + 0.5), below = across.place(s - 0.5);
      add_row(v, clearance * std::min(above - below, 2 * std::min(above - v, v - below)), k % 2 == 1, max_points);
    }
    if (seeds_.size() > max_points) seeds_.clear();
    return std::move(seeds_);
  }

 private:
  // Density of rows: root mean square over each row of cells.
  Cumulative distances() const {
    std::vector<double> density(rows_.cells_across());
    for (std::size_t j = 0; j < density.size(); ++j) {
      double sum = 0;
      for (std::size_t i = 0; i < rows_.cells_along(); ++i) sum += rows_.density_across(i, j) * rows_.density_across(i, j);
      density[j] = std::sqrt(sum / static_cast<double>(rows_.cells_along()));
    }
    Cumulative result;
    result.set(rows_.across(), density);
    return result;
  }

  // Density along the row at v, between the two nearest rows of cells.
  void set_density_along(double v) {
    const std::vector<double>& border = rows_.across();
    const std::size_t j = Cumulative::cell(border, v);
    const double f = (v - border[j]) / (border[j + 1] - border[j]) - 0.5;
    const std::size_t other = f < 0 ? (j > 0 ? j - 1 : j) : std::min(j + 1, rows_.cells_across() - 1);
    const double w = std::min(std::abs(f), 0.5);
    std::vector<double> density(rows_.cells_along());
    for (std::size_t i = 0; i < density.size(); ++i)
      density[i] = (1 - w) * rows_.density_along(i, j) + w * rows_.density_along(i, other);
    along_.set(rows_.along(), density);
  }

  void add_row(double v, double reach, bool staggered, std::size_t max_points) {
    scanline_.move_to(v, reach);
    scanline_.crossings(v, crossings_);
    if (crossings_.size() < 2) return;
    scanline_.blocked(v, reach, blocked_);
    set_density_along(v);
    std::size_t block = 0;
    double blocked_to = -infinity;
    for (std::size_t c = 0; c + 1 < crossings_.size(); c += 2) {
      const double lo = along_.value(crossings_[c]), total = along_.value(crossings_[c + 1]) - lo;
      if (!(total < static_cast<double>(max_points))) continue;
      const double steps = std::max(1.0, std::ceil(total - 0.1));
      const double width = crossings_[c + 1] - crossings_[c];
      for (double k = staggered ? 0.5 : 1; k < steps; ++k) {
        const double s = lo + total * k / steps;
        const double u = total > 0 ? along_.place(s) : crossings_[c] + width * k / steps;
        if (steps == 1 && total < 0.8) break;
        const double margin = std::min(reach, clearance * width / steps);
        for (; block < blocked_.size() && blocked_[block].lo <= u + margin; ++block)
          blocked_to = std::max(blocked_to, blocked_[block].hi);
        if (u - margin > blocked_to) seeds_.push_back(rows_.turned({u, v}));
      }
    }
  }

  const Rows& rows_;
  Scanline scanline_;
  Interval box_{infinity, -infinity};
  Cumulative along_;
  std::vector<double> crossings_;
  std::vector<Interval> blocked_;
  std::vector<Uv> seeds_;
};

}  // namespace

std::vector<Uv> seed_points(const Chart& chart, std::span<const Uv> polygon, std::span<const Segment> segments,
                            std::size_t max_points) {
  if (!chart.curved) return {};
  const Rows along_u(chart, true), along_v(chart, false);
  const Rows& rows = along_u.unevenness() <= along_v.unevenness() ? along_u : along_v;
  return Seeder(chart, rows, polygon, segments).run(max_points);
}

}  // namespace trimloop::mesh
