#include "kernel/mesh/bezier_piece.h"

namespace trimloop::mesh::detail {
namespace {

constexpr double unit_roundoff = 0x1p-53;
constexpr std::array<std::array<double, 4>, 4> binomial{{{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}}};

struct Range {
  double lo = infinity, hi = -infinity;
  void add(double x) { lo = std::min(lo, x), hi = std::max(hi, x); }
  double mid() const { return 0.5 * (lo + hi); }
  double half() const { return 0.5 * (hi - lo); }
};

Ball plus(const Ball& a, const Ball& b) { return {a.centre + b.centre, a.radius + b.radius}; }
Ball times(const Ball& a, const Range& s) {
  const double m = s.mid(), h = s.half();
  return {m * a.centre, a.radius * (std::abs(m) + h) + norm(a.centre) * h};
}

// Homogeneous poles are differenced in place: [i][j] becomes the (a, b)-th derivative's Bézier pole, up to factors.
struct Net {
  int p, q;
  const std::vector<Hpoint>& poles;
  const Hpoint& at(int i, int j) const { return poles[static_cast<std::size_t>(i * (q + 1) + j)]; }
  Hpoint difference(int i, int j, int a, int b) const {
    Hpoint sum{0, 0, 0, 0};
    for (int k = 0; k <= a; ++k) {
      for (int m = 0; m <= b; ++m) {
        const double sign = ((a - k + b - m) & 1) != 0 ? -1 : 1;
        sum = sum + sign * binomial[static_cast<std::size_t>(a)][static_cast<std::size_t>(k)] *
                        binomial[static_cast<std::size_t>(b)][static_cast<std::size_t>(m)] * at(i + k, j + m);
      }
    }
    return sum;
  }
};

// p! / (p - k)! / width^k
double factor(int p, int k, double width) {
  double f = 1;
  for (int i = 0; i < k; ++i) f *= (p - i) / width;
  return f;
}

}  // namespace

void bezier_weights(int degree, const double* span, Interval ab, std::vector<double>& out) {
  const auto n = static_cast<std::size_t>(degree) + 1;
  out.assign(n * n, 0);
  std::array<double, 66> w;  // of the blossom's value, carried back from it to the poles
  for (int j = 0; j <= degree; ++j) {
    std::fill_n(w.begin(), n, 0.0);
    w[n - 1] = 1;
    for (int r = degree; r >= 1; --r) {
      const double x = r <= degree - j ? ab.lo : ab.hi;
      for (int i = r; i <= degree; ++i) {
        const double lo = span[i - degree], hi = span[i + 1 - r], share = (x - lo) / (hi - lo);
        const auto k = static_cast<std::size_t>(i);
        w[k - 1] += (1 - share) * w[k];
        w[k] *= share;
      }
    }
    std::copy_n(w.begin(), n, out.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(j) * n));
  }
}

void bezier_poles(int degree, const std::vector<double>& weights, const Hpoint* poles, std::size_t stride, Hpoint* out,
                  std::size_t out_stride) {
  const auto n = static_cast<std::size_t>(degree) + 1;
  for (std::size_t j = 0; j < n; ++j) {
    Hpoint sum = weights[j * n] * poles[0];
    for (std::size_t i = 1; i < n; ++i) sum = sum + weights[j * n + i] * poles[i * stride];
    out[j * out_stride] = sum;
  }
}

bool enclose_partials(int p, int q, std::vector<Hpoint>& poles, double width_u, double width_v, bool rational,
                      Point origin, Partials& out) {
  double size = 0;
  for (Hpoint& h : poles) {
    if (!rational) h.w = 1;
    if (!(h.w > 0)) return false;
    h = {h.x - h.w * origin.x, h.y - h.w * origin.y, h.z - h.w * origin.z, h.w};
    size = std::max({size, std::abs(h.x), std::abs(h.y), std::abs(h.z)});
  }
  const double from_origin = std::max({std::abs(origin.x), std::abs(origin.y), std::abs(origin.z)});
  const double rounding = 16 * (p + q) * unit_roundoff * (size + from_origin);
  const Net net{p, q, poles};
  std::array<std::array<Range, 4>, 4> weight;
  for (int a = 0; a <= 3; ++a) {
    for (int b = 0; a + b <= 3; ++b) {
      Ball& ball = out[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
      Range& w = weight[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
      ball = {};
      if (a > p || b > q) {
        w = {0, 0};
        continue;
      }
      Range x, y, z;
      for (int i = 0; i + a <= p; ++i) {
        for (int j = 0; j + b <= q; ++j) {
          const Hpoint h = net.difference(i, j, a, b);
          x.add(h.x), y.add(h.y), z.add(h.z), w.add(h.w);
        }
      }
      const double f = factor(p, a, width_u) * factor(q, b, width_v);
      ball.centre = f * Vector{x.mid(), y.mid(), z.mid()};
      ball.radius = f * (norm(Vector{x.half(), y.half(), z.half()}) + rounding * (1 << (a + b)));
      const double slack = (1 << (a + b)) * 16 * (p + q) * unit_roundoff;
      w = {f * (w.lo - slack), f * (w.hi + slack)};
    }
  }
  if (!rational) return true;
  // S_ab = (N_ab - sum C(a,i) C(b,j) w_ij S_(a-i)(b-j)) / w, eq. 4.20 of The NURBS Book.
  const Range w = weight[0][0];
  if (!(w.lo > 0)) return false;
  const Range inverse{1 / w.hi, 1 / w.lo};
  for (std::size_t order = 0; order <= 3; ++order) {
    for (std::size_t a = 0; a <= order; ++a) {
      const std::size_t b = order - a;
      Ball sum = out[a][b];
      for (std::size_t i = 0; i <= a; ++i) {
        for (std::size_t j = 0; j <= b; ++j) {
          if (i + j == 0) continue;
          const double c = -binomial[a][i] * binomial[b][j];
          const Range scaled{std::min(c * weight[i][j].lo, c * weight[i][j].hi), std::max(c * weight[i][j].lo, c * weight[i][j].hi)};
          sum = plus(sum, times(out[a - i][b - j], scaled));
        }
      }
      out[a][b] = times(sum, inverse);
    }
  }
  return std::isfinite(out[3][0].radius) && std::isfinite(out[0][3].radius);
}

}  // namespace trimloop::mesh::detail
