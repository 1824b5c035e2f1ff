#include "kernel/closest/squared_distance.h"

#include "kernel/nurbs/binomial.h"

namespace trimloop::closest {

namespace {

// C(p, i) C(p, k) / C(2 p, i + k)
std::vector<double> product_shares(int degree) {
  const std::size_t p = static_cast<std::size_t>(degree);
  std::vector<double> out;
  for (std::size_t i = 0; i <= p; ++i)
    for (std::size_t k = 0; k <= p; ++k)
      out.push_back(detail::binomial(p, i) * detail::binomial(p, k) / detail::binomial(2 * p, i + k));
  return out;
}

struct Builder {
  int p, q;
  std::vector<double> shares_u = product_shares(p), shares_v = product_shares(q);

  // Poles (i, j) at [j * (p + 1) + i].
  void add(SquaredDistance& s, std::span<const Hpoint> poles, Interval u, Interval v) const {
    SquaredDistance::Piece piece{u, v, {}, 0, {}, 1};
    bool positive = true;
    for (const Hpoint& h : poles) {
      positive = positive && h.w > 0 && is_finite(project(h));
      if (positive) piece.box.add(project(h));
    }
    if (!positive) piece.box = {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
    if (positive) piece.origin = midpoint(piece.box.lo, piece.box.hi);
    std::vector<Hpoint> local(poles.begin(), poles.end());
    double weight = 0;
    for (Hpoint& h : local) {
      const Vector c = to_vector(piece.origin);
      h = {h.x - h.w * c.x, h.y - h.w * c.y, h.z - h.w * c.z, h.w};
      const double reach = positive ? norm(to_vector(project(h))) : norm(Vector{h.x, h.y, h.z});
      piece.radius = std::max(piece.radius, reach);
      weight = std::max(weight, std::abs(h.w));
      s.size = std::max({s.size, reach + norm(c)});
    }
    piece.weight_hi = weight * weight;
    if (!positive) piece.radius /= std::sqrt(std::max(piece.weight_hi, 1e-300));
    s.pieces.push_back(piece);
    if ((s.pieces.size() - 1) % SquaredDistance::group == 0) s.groups.emplace_back();
    s.groups.back().add(piece.box);
    add_products(s, local);
  }

  void add_products(SquaredDistance& s, const std::vector<Hpoint>& a) const {
    const std::size_t rows = static_cast<std::size_t>(p) + 1, columns = static_cast<std::size_t>(q) + 1;
    const std::size_t n = static_cast<std::size_t>(s.n) + 1, count = s.count(), first = s.numbers.size();
    s.numbers.resize(first + s.arrays() * count);
    double* to = s.numbers.data() + first;
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j)
        for (std::size_t k = 0; k < rows; ++k)
          for (std::size_t l = 0; l < columns; ++l) {
            const double share = shares_u[i * rows + k] * shares_v[j * columns + l];
            const Hpoint &x = a[j * rows + i], &y = a[l * rows + k];
            double* at = to + (i + k) * n + (j + l);
            at[0] += share * (x.x * y.x + x.y * y.y + x.z * y.z);
            at[count] += share * x.w * y.x;
            at[2 * count] += share * x.w * y.y;
            at[3 * count] += share * x.w * y.z;
            if (s.rational) at[4 * count] += share * x.w * y.w;
          }
  }
};

}  // namespace

double SquaredDistance::combine(std::size_t piece, Point at, double* product, double* weight) const {
  const std::size_t k = count();
  const double *aa = numbers.data() + piece * arrays() * k, *x = aa + k, *y = x + k, *z = y + k, *ww = z + k;
  const Vector p = at - pieces[piece].origin;
  const double px = -2 * p.x, py = -2 * p.y, pz = -2 * p.z, pp = dot(p, p);
  if (rational) {
    for (std::size_t i = 0; i < k; ++i) {
      product[i] = aa[i] + px * x[i] + py * y[i] + pz * z[i] + pp * ww[i];
      weight[i] = ww[i];
    }
  } else {
    for (std::size_t i = 0; i < k; ++i) product[i] = aa[i] + px * x[i] + py * y[i] + pz * z[i] + pp;
  }
  // Each product of poles and its share: some roundings; each sum over the at most (m + 2) (n + 2) / 4 products one
  // more, of positive shares that add up to one; then the five terms.
  const double reach = pieces[piece].radius + std::sqrt(pp);
  constexpr double eps = std::numeric_limits<double>::epsilon();
  return eps * (24 + 0.25 * (m + 2) * (n + 2)) * reach * reach * pieces[piece].weight_hi;
}

SquaredDistance squared_distance(const SurfacePieces& s) {
  SquaredDistance out;
  out.m = 2 * s.degree_u();
  out.n = 2 * s.degree_v();
  out.rational = s.is_rational();
  out.numbers.reserve(s.size() * out.arrays() * out.count());
  const Builder builder{s.degree_u(), s.degree_v()};
  for (std::size_t a = 0; a < s.spans_u().size(); ++a)
    for (std::size_t b = 0; b < s.spans_v().size(); ++b)
      builder.add(out, s.bezier(a, b), s.spans_u()[a], s.spans_v()[b]);
  return out;
}

SquaredDistance squared_distance(const CurvePieces& c) {
  SquaredDistance out;
  out.m = 2 * c.degree();
  out.n = 0;
  out.rational = c.is_rational();
  const Builder builder{c.degree(), 0};
  for (std::size_t a = 0; a < c.size(); ++a) builder.add(out, c.bezier(a), c.spans()[a], {0, 0});
  return out;
}

}  // namespace trimloop::closest
