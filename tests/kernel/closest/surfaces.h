#pragma once
// Random surfaces of every kind that closest points and bounds are asked about, and an exhaustive search to compare
// with: dense samples, then descents (of kernel/geometry, which shares nothing with the certified search) from every
// valley.

#include "kernel/batch/batch.h"
#include "kernel/geometry/surface_descent.h"
#include "tests/kernel/nurbs/random_nurbs.h"

namespace trimloop::testing {

inline NurbsSurface sheet(Random& random, int p, int q, std::size_t rows, std::size_t columns, double height,
                          bool rational) {
  const auto knots = [&](int degree, std::size_t poles) {
    std::vector<double> k(static_cast<std::size_t>(degree) + 1, 0.0);
    const std::size_t inner = poles - static_cast<std::size_t>(degree) - 1;
    for (std::size_t i = 1; i <= inner; ++i) k.push_back(static_cast<double>(i) + random.real(-0.3, 0.3));
    k.insert(k.end(), static_cast<std::size_t>(degree) + 1, static_cast<double>(inner + 1));
    return k;
  };
  std::vector<Hpoint> poles;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j) {
      const double w = rational ? random.real(0.4, 2.5) : 1,
                   x = 10.0 * static_cast<double>(i) / static_cast<double>(rows - 1),
                   y = 10.0 * static_cast<double>(j) / static_cast<double>(columns - 1);
      poles.push_back({w * x, w * y, w * random.real(-height, height), w});
    }
  return NurbsSurface::from_homogeneous(p, q, knots(p, rows), knots(q, columns), std::move(poles)).value();
}

// Kinds 0 .. 9: flat, wavy, folded, wild, of high degree, a sphere with poles, a cone with its apex, a torus, a tube, a
// part of the domain.
inline NurbsSurface any_surface(Random& random, int kind) {
  const auto size = [&](int degree) { return static_cast<std::size_t>(degree + random.integer(1, 6)); };
  const int p = random.integer(1, 4), q = random.integer(1, 4);
  const bool rational = random.integer(0, 1) == 1;
  const auto of = [&](const Surface& s, Interval u, Interval v) { return to_nurbs(s, u, v)->surface; };
  const Frame frame =
      make_frame({random.real(-3, 3), 0, random.real(-3, 3)}, {random.real(-1, 1), random.real(-1, 1), 1});
  switch (kind % 10) {
    case 0:
      return sheet(random, p, q, size(p), size(q), 0, rational);
    case 1:
      return sheet(random, 3, 3, 8, 8, 1.5, true);
    case 2:
      return sheet(random, std::max(p, 2), std::max(q, 2), size(4), size(4), 15, rational);
    case 3:
      return random.surface(p, q, rational);
    case 4:
      return random.surface(random.integer(5, 9), random.integer(1, 7), rational);
    case 5:
      return of({Sphere{frame, 4}}, {0, two_pi}, {-pi / 2, pi / 2});
    case 6:
      return of({Cone{frame, 0, 0.5}}, {0, two_pi}, {0, 8});
    case 7:
      return of({Torus{frame, 5, random.real(0.5, 4)}}, {0, two_pi}, {0, two_pi});
    case 8:
      return of({Cylinder{frame, 3}}, {0.3, 5.1}, {-4, 6});
    default: {
      const NurbsSurface whole = sheet(random, 3, 2, 9, 7, 4, rational);
      return whole.with_range({whole.domain_u().at(0.13), whole.domain_u().at(0.77)},
                              {whole.domain_v().at(0.31), whole.domain_v().hi});
    }
  }
}

class Exhaustive {
 public:
  explicit Exhaustive(const NurbsSurface& s, int per_span = 12) : surface_{s}, rectangle_{s.range_u(), s.range_v()} {
    const auto cut = [&](const std::vector<double>& at, int degree) {
      std::vector<double> out;
      const int parts = degree == 1 ? 4 : per_span;
      for (std::size_t i = 0; i + 1 < at.size(); ++i)
        for (int k = 0; k < parts; ++k) out.push_back(Interval{at[i], at[i + 1]}.at(double(k) / parts));
      out.push_back(at.back());
      return out;
    };
    u_ = cut(breaks_u(s), s.degree_u());
    v_ = cut(breaks_v(s), s.degree_v());
    for (double u : u_)
      for (double v : v_) at_.push_back(evaluate(s, {u, v}));
  }
  double nearest(Point p, std::size_t descents = 16) const {
    const std::size_t rows = u_.size(), columns = v_.size();
    std::vector<double> d(at_.size());
    for (std::size_t k = 0; k < d.size(); ++k) d[k] = dot(at_[k] - p, at_[k] - p);
    std::vector<std::size_t> valleys;
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j) {
        const double here = d[i * columns + j];
        bool valley = true;
        for (std::size_t a = i > 0 ? i - 1 : 0; a <= std::min(i + 1, rows - 1) && valley; ++a)
          for (std::size_t b = j > 0 ? j - 1 : 0; b <= std::min(j + 1, columns - 1); ++b)
            valley = valley && d[a * columns + b] >= here;
        if (valley) valleys.push_back(i * columns + j);
      }
    std::sort(valleys.begin(), valleys.end(), [&](std::size_t a, std::size_t b) { return d[a] < d[b]; });
    if (valleys.size() > descents) valleys.resize(descents);
    double best = infinity;
    for (std::size_t k : valleys) {
      const std::size_t i = k / columns, j = k % columns;
      // Held in the neighbouring cells, so that no descent runs away to another valley.
      const detail::Rectangle r{{u_[i > 0 ? i - 1 : 0], u_[std::min(i + 1, rows - 1)]},
                                {v_[j > 0 ? j - 1 : 0], v_[std::min(j + 1, columns - 1)]}};
      best = std::min({best, std::sqrt(d[k]), detail::descend(surface_, p, {u_[i], v_[j]}, r, 50, false).distance});
    }
    return best;
  }
  const std::vector<Point>& samples() const { return at_; }

 private:
  Surface surface_;
  detail::Rectangle rectangle_;
  std::vector<double> u_, v_;
  std::vector<Point> at_;
};

}  // namespace trimloop::testing
