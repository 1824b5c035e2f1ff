#include "kernel/mesh/derivative_nets.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace trimloop::mesh {
namespace {

constexpr std::size_t most_pieces = 16;       // that a span is cut into
constexpr std::size_t most_poles = 1 << 20;   // of a net with its inserted knots
constexpr std::size_t most_looked_at = 20000;  // poles of one derivative
constexpr double ignored = 1e-12;             // of the range: nearer than that a border is not crossed

}  // namespace

// Knots to insert: equal parts of each span that the range touches.
void DerivativeNets::Direction::count(Interval range, double cell, std::vector<double>& added) const {
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    const Interval span{knots[k], knots[k + 1]};
    if (!(span.length() > 0) || span.hi <= range.lo || span.lo >= range.hi) continue;
    const double wanted = std::ceil(span.length() / cell - 0.25);
    const double pieces = std::clamp(std::isfinite(wanted) ? wanted : 1.0, 1.0, static_cast<double>(most_pieces));
    for (double i = 1; i < pieces; ++i) added.push_back(span.at(i / pieces));
  }
}

void DerivativeNets::Direction::finish(Interval range) {
  const std::size_t p = static_cast<std::size_t>(degree), poles = knots.size() - p - 1;
  for (std::size_t k = p; k < poles; ++k) {
    if (!(knots[k + 1] > knots[k])) continue;
    const bool is_beside = knots[k + 1] <= range.lo || knots[k] >= range.hi;
    if (is_beside && !(spans.empty() && k + 1 == poles)) continue;
    if (borders.empty()) borders.push_back(knots[k]);
    borders.push_back(knots[k + 1]);
    spans.push_back(k);
  }
  // By how much derivatives enlarge the rounding of a pole, over each span.
  std::vector<double> of_pole(poles, 1);
  amplified[0].assign(spans.size(), 1);
  for (std::size_t order = 1; order <= 3; ++order) {
    const std::vector<double> factor = divisors(static_cast<int>(order));
    for (std::size_t i = 0; i < factor.size(); ++i) of_pole[i] = factor[i] * (of_pole[i] + of_pole[i + 1]);
    for (const std::size_t k : spans) {
      double most = 0;
      for (std::size_t i = k - p; i + order <= k; ++i) most = std::max(most, of_pole[i]);
      amplified[order].push_back(most);
    }
  }
}

// Of pole i of the `order`-th derivative: degree over the width of its knots; 0 where it stands for nothing.
std::vector<double> DerivativeNets::Direction::divisors(int order) const {
  const int left = degree - order + 1;  // degree of what is differentiated
  const auto p = static_cast<std::size_t>(degree), k = static_cast<std::size_t>(order);
  const std::size_t poles = knots.size() - p - 1;
  std::vector<double> factor;
  for (std::size_t i = 0; i + k < poles; ++i) {
    const double width = left > 0 ? knots[i + p + 1] - knots[i + k] : 0;
    factor.push_back(width > 0 ? left / width : 0);
  }
  return factor;
}

std::array<std::size_t, 2> DerivativeNets::Direction::touched(Interval x) const {
  const double slack = ignored * (borders.back() - borders.front());
  const auto below = [&](double at) {
    const auto above = std::upper_bound(borders.begin() + 1, borders.end() - 1, at);
    return static_cast<std::size_t>(above - borders.begin()) - 1;
  };
  const std::size_t first = below(x.lo + slack);
  return {first, std::max(first, below(x.hi - slack))};
}

DerivativeNets::DerivativeNets(const NurbsSurface& surface, Interval u, Interval v, Uv cell) : rational_(surface.is_rational()) {
  u_.degree = surface.degree_u(), v_.degree = surface.degree_v();
  u_.knots = surface.knots_u(), v_.knots = surface.knots_v();
  std::vector<double> added_u, added_v;
  u_.count(u, cell.u, added_u), v_.count(v, cell.v, added_v);
  if ((surface.poles_u() + added_u.size()) * (surface.poles_v() + added_v.size()) > most_poles) added_u.clear(), added_v.clear();
  std::optional<NurbsSurface> finer;
  if (!added_u.empty()) finer.emplace(refine_u(surface, added_u));
  if (!added_v.empty()) finer.emplace(refine_v(finer ? *finer : surface, added_v));
  const NurbsSurface& s = finer ? *finer : surface;
  u_.knots = s.knots_u(), v_.knots = s.knots_v();
  u_.finish(u), v_.finish(v);
  const Hpoint middle = s.poles()[s.poles().size() / 2];
  origin_ = rational_ ? project(middle) : Point{middle.x, middle.y, middle.z};
  Net& n = nets_[0][0];
  n.rows = s.poles_u(), n.columns = s.poles_v();
  double size = 0;
  for (const Hpoint& h : s.poles()) {
    const double w = rational_ ? h.w : 1;
    n.x.push_back(h.x - w * origin_.x), n.y.push_back(h.y - w * origin_.y), n.z.push_back(h.z - w * origin_.z);
    if (rational_) n.w.push_back(h.w);
    size = std::max({size, std::abs(h.x), std::abs(h.y), std::abs(h.z), rational_ ? std::abs(h.w) : 0.0});
  }
  const double from_origin = std::max({std::abs(origin_.x), std::abs(origin_.y), std::abs(origin_.z)});
  noise_ = 16 * (u_.degree + v_.degree) * 0x1p-53 * (size + from_origin);
}

std::optional<DerivativeNets::Window> DerivativeNets::window(Interval u, Interval v) const {
  const Window w{u_.touched(u), v_.touched(v)};
  const std::size_t wide = w.u[1] - w.u[0] + static_cast<std::size_t>(u_.degree), high = w.v[1] - w.v[0] + static_cast<std::size_t>(v_.degree);
  if (wide * high > most_looked_at) return std::nullopt;
  return w;
}

// Poles that stand for nothing repeat the one before them.
void DerivativeNets::differentiate(const Net& from, Net& to, bool in_u, int order) const {
  const std::vector<double> factor = (in_u ? u_ : v_).divisors(order);
  to.rows = from.rows - (in_u ? 1 : 0), to.columns = from.columns - (in_u ? 0 : 1);
  const std::size_t count = to.rows * to.columns, step = in_u ? from.columns : 1;
  const auto differences = [&](const std::vector<double>& a, std::vector<double>& d) {
    d.resize(count);
    for (std::size_t i = 0; i < to.rows; ++i)
      for (std::size_t j = 0; j < to.columns; ++j) {
        const double f = factor[in_u ? i : j];
        const std::size_t at = i * from.columns + j, out = i * to.columns + j;
        if (f > 0) d[out] = f * (a[at + step] - a[at]);
        else d[out] = in_u ? (i > 0 ? d[out - to.columns] : 0) : (j > 0 ? d[out - 1] : 0);
      }
  };
  differences(from.x, to.x), differences(from.y, to.y), differences(from.z, to.z);
  if (rational_) differences(from.w, to.w);
}

DerivativeNets::Net& DerivativeNets::net(int a, int b) {
  Net& n = nets_[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
  if (n.rows == 0 && a <= u_.degree && b <= v_.degree) {
    if (a > 0) differentiate(net(a - 1, b), n, true, a);
    else differentiate(net(a, b - 1), n, false, b);
  }
  return n;
}

namespace {

// Least and largest x . X + ... of some poles, several components at a time.
template <std::size_t K>
struct Extremes {
  std::array<DerivativeNets::Component, K> c;
  std::array<double, K> lo, hi;

  explicit Extremes(const DerivativeNets::Component* components) {
    std::copy_n(components, K, c.begin());
    lo.fill(infinity), hi.fill(-infinity);
  }
  void add(double x, double y, double z, double w) {
    for (std::size_t k = 0; k < K; ++k) {
      const double value = c[k].x * x + c[k].y * y + c[k].z * z + c[k].w * w;
      lo[k] = value < lo[k] ? value : lo[k], hi[k] = value > hi[k] ? value : hi[k];
    }
  }
};

// A part of a net.
struct Block {
  const double *x, *y, *z, *w;
  std::size_t rows, count, step;
};

#if defined(__SSE2__)
// Two poles at a time, by the same operations; the last pair of a row may repeat a pole.
template <std::size_t K, bool rational>
void extremes(const Block& n, Extremes<K>& out) {
  __m128d cx[K], cy[K], cz[K], cw[K], lo[K], hi[K];
  for (std::size_t k = 0; k < K; ++k) {
    cx[k] = _mm_set1_pd(out.c[k].x), cy[k] = _mm_set1_pd(out.c[k].y), cz[k] = _mm_set1_pd(out.c[k].z), cw[k] = _mm_set1_pd(out.c[k].w);
    lo[k] = _mm_set1_pd(infinity), hi[k] = _mm_set1_pd(-infinity);
  }
  for (std::size_t i = 0; i < n.rows; ++i) {
    for (std::size_t j = 0; j < n.count; j += 2) {
      const std::size_t at = i * n.step + (j + 2 <= n.count ? j : n.count - 2);
      const __m128d x = _mm_loadu_pd(n.x + at), y = _mm_loadu_pd(n.y + at), z = _mm_loadu_pd(n.z + at);
      for (std::size_t k = 0; k < K; ++k) {
        __m128d value = _mm_add_pd(_mm_add_pd(_mm_mul_pd(cx[k], x), _mm_mul_pd(cy[k], y)), _mm_mul_pd(cz[k], z));
        if (rational) value = _mm_add_pd(value, _mm_mul_pd(cw[k], _mm_loadu_pd(n.w + at)));
        lo[k] = _mm_min_pd(value, lo[k]), hi[k] = _mm_max_pd(value, hi[k]);
      }
    }
  }
  for (std::size_t k = 0; k < K; ++k) {
    out.lo[k] = std::min(_mm_cvtsd_f64(lo[k]), _mm_cvtsd_f64(_mm_unpackhi_pd(lo[k], lo[k])));
    out.hi[k] = std::max(_mm_cvtsd_f64(hi[k]), _mm_cvtsd_f64(_mm_unpackhi_pd(hi[k], hi[k])));
  }
}
#endif

template <std::size_t K>
void find_extremes(const Block& n, Extremes<K>& out) {
#if defined(__SSE2__)
  if (n.count >= 2) return n.w ? extremes<K, true>(n, out) : extremes<K, false>(n, out);
#endif
  for (std::size_t i = 0; i < n.rows; ++i)
    for (std::size_t at = i * n.step; at < i * n.step + n.count; ++at) out.add(n.x[at], n.y[at], n.z[at], n.w ? n.w[at] : 0);
}

}  // namespace

template <std::size_t K>
void DerivativeNets::spreads(int a, int b, const Window& window, const Component* components, Spread* out, std::size_t stride) {
  const Net& n = net(a, b);
  if (n.rows == 0) {
    for (std::size_t k = 0; k < K; ++k) out[k * stride] = {};
    return;
  }
  const auto order_u = static_cast<std::size_t>(a), order_v = static_cast<std::size_t>(b);
  const std::size_t i0 = u_.spans[window.u[0]] - static_cast<std::size_t>(u_.degree), i1 = u_.spans[window.u[1]] - order_u;
  const std::size_t j0 = v_.spans[window.v[0]] - static_cast<std::size_t>(v_.degree), j1 = v_.spans[window.v[1]] - order_v;
  const std::size_t first = i0 * n.columns + j0;
  Extremes<K> range(components);
  find_extremes<K>({n.x.data() + first, n.y.data() + first, n.z.data() + first, rational_ ? n.w.data() + first : nullptr, i1 - i0 + 1,
                    j1 - j0 + 1, n.columns},
                   range);
  double in_u = 0, in_v = 0;
  for (std::size_t i = window.u[0]; i <= window.u[1]; ++i) in_u = std::max(in_u, u_.amplified[order_u][i]);
  for (std::size_t j = window.v[0]; j <= window.v[1]; ++j) in_v = std::max(in_v, v_.amplified[order_v][j]);
  const double noise = noise_ * in_u * in_v;
  for (std::size_t k = 0; k < K; ++k) {
    const Component& c = components[k];
    const double half = noise * (std::abs(c.x) + std::abs(c.y) + std::abs(c.z) + (rational_ ? std::abs(c.w) : 0));
    // Nothing is said where numbers may have overflowed.
    out[k * stride] = {0.5 * (range.lo[k] + range.hi[k]), half < 1e200 ? 0.5 * (range.hi[k] - range.lo[k]) + half : infinity};
  }
}

DerivativeNets::Spread DerivativeNets::spread(int a, int b, const Window& window, const Component& c) {
  Spread out;
  spreads<1>(a, b, window, &c, &out, 1);
  return out;
}

void DerivativeNets::seconds(const Window& window, std::span<const Component> components, std::span<Seconds> out) {
  constexpr std::array<std::array<int, 2>, 3> orders{{{2, 0}, {1, 1}, {0, 2}}};
  for (std::size_t k = 0; k < orders.size(); ++k) {
    if (components.size() == 3) spreads<3>(orders[k][0], orders[k][1], window, components.data(), &out[0][k], orders.size());
    else
      for (std::size_t c = 0; c < components.size(); ++c) out[c][k] = spread(orders[k][0], orders[k][1], window, components[c]);
  }
}

void DerivativeNets::thirds(const Window& window, std::span<const Component> components, std::span<Thirds> out) {
  constexpr std::array<std::array<int, 2>, 4> orders{{{3, 0}, {2, 1}, {1, 2}, {0, 3}}};
  for (std::size_t k = 0; k < orders.size(); ++k) {
    if (components.size() == 3) spreads<3>(orders[k][0], orders[k][1], window, components.data(), &out[0][k], orders.size());
    else
      for (std::size_t c = 0; c < components.size(); ++c) out[c][k] = spread(orders[k][0], orders[k][1], window, components[c]);
  }
}

Interval DerivativeNets::weights(const Window& window) const {
  if (!rational_) return {1, 1};
  const Net& n = nets_[0][0];
  Interval range{infinity, -infinity};
  for (std::size_t i = u_.spans[window.u[0]] - static_cast<std::size_t>(u_.degree); i <= u_.spans[window.u[1]]; ++i) {
    for (std::size_t j = v_.spans[window.v[0]] - static_cast<std::size_t>(v_.degree); j <= v_.spans[window.v[1]]; ++j) {
      const double w = n.w[i * n.columns + j];
      range = {std::min(range.lo, w), std::max(range.hi, w)};
    }
  }
  return range;
}

// The surface is in the hull of its poles.
double DerivativeNets::largest_height(const Window& window, Point p, Vector n) {
  const Interval weight = weights(window);
  return weight.lo > 0 ? spread(0, 0, window, height_over(p, n)).largest() / weight.lo : infinity;
}

// With N taken from `near`, S_u = (N_u - (S - near) w_u) / w.
bool DerivativeNets::firsts(const Window& window, Point near, std::span<const Vector> along, std::span<Firsts> out) {
  constexpr std::array<std::array<int, 2>, 2> orders{{{1, 0}, {0, 1}}};
  const Interval weight = weights(window);
  if (!(weight.lo > 0)) return false;
  for (std::size_t c = 0; c < along.size(); ++c) {
    const Component component = rational_ ? height_over(near, along[c]) : this->component(along[c]);
    const double reach = rational_ ? spread(0, 0, window, component).largest() / weight.lo : 0;
    for (std::size_t k = 0; k < orders.size(); ++k) {
      const int a = orders[k][0], b = orders[k][1];
      out[c][k] = spread(a, b, window, component);
      if (!rational_) continue;
      const double more = out[c][k].half + reach * spread(a, b, window, {0, 0, 0, 1}).largest();
      const double lo = out[c][k].mid - more, hi = out[c][k].mid + more;
      const double least = lo / (lo > 0 ? weight.hi : weight.lo), most = hi / (hi > 0 ? weight.lo : weight.hi);
      out[c][k] = {0.5 * (least + most), 0.5 * (most - least)};
    }
  }
  return true;
}

}  // namespace trimloop::mesh
