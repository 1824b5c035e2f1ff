// Boxes: hulls, and tight ones by a best-first search for the extreme of each coordinate.

#include <algorithm>
#include <queue>

#include "kernel/bounds/bounds.h"
#include "kernel/bounds/polynomial.h"

namespace trimloop {

namespace {

const Box everything{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};

struct PolesView {
  std::span<const Hpoint> poles;
  int p, q;
};
std::vector<PolesView> views(const CurvePieces& c) {
  std::vector<PolesView> out;
  for (std::size_t i = 0; i < c.size(); ++i) out.push_back({c.bezier(i), c.degree(), 0});
  return out;
}
std::vector<PolesView> views(const SurfacePieces& s) {
  std::vector<PolesView> out;
  for (std::size_t a = 0; a < s.spans_u().size(); ++a)
    for (std::size_t b = 0; b < s.spans_v().size(); ++b) out.push_back({s.bezier(a, b), s.degree_u(), s.degree_v()});
  return out;
}

double largest_coordinate(const Box& b) {
  return std::max(
      {std::abs(b.lo.x), std::abs(b.lo.y), std::abs(b.lo.z), std::abs(b.hi.x), std::abs(b.hi.y), std::abs(b.hi.z)});
}
// What the poles of a piece, projected, may be off, relative to the largest coordinate: knots inserted on weights that
// may be uneven.
double pole_roundings(const PolesView& v) {
  double lo = infinity, hi = 0;
  for (const Hpoint& h : v.poles) lo = std::min(lo, h.w), hi = std::max(hi, h.w);
  return bounds::eps * (12 * (v.p + v.q) + 12) * (lo > 0 ? hi / lo : infinity);
}

Box hull_of(const std::vector<PolesView>& pieces) {
  Box out;
  for (const PolesView& v : pieces) {
    Box box;
    for (const Hpoint& h : v.poles) {
      if (!(h.w > 0) || !is_finite(project(h))) return everything;
      box.add(project(h));
    }
    const double by = pole_roundings(v) * largest_coordinate(box);
    out.add(Box{box.lo - Vector{by, by, by}, box.hi + Vector{by, by, by}});
  }
  return out;
}

// The largest value of numerator / weight over pieces: halves of pieces, the most promising first.
class Extreme {
 public:
  Extreme(int p, int q, double tolerance)
      : rows_(static_cast<std::size_t>(p) + 1), columns_(static_cast<std::size_t>(q) + 1), tolerance_(tolerance) {}

  void add(const PolesView& v, double Hpoint::*coordinate, double sign, double origin) {
    std::vector<double> c(2 * count());
    for (std::size_t i = 0; i < rows_; ++i)
      for (std::size_t j = 0; j < columns_; ++j) {
        const Hpoint& h = v.poles[j * rows_ + i];
        c[i * columns_ + j] = sign * (h.*coordinate - origin * h.w);
        c[count() + i * columns_ + j] = h.w;
      }
    push(std::move(c));
  }
  // No value is larger than the first; the second is attained.
  std::pair<double, double> find() {
    for (std::size_t halved = 0; !heap_.empty() && halved < 4000; ++halved) {
      if (heap_.top().bound <= known_ + tolerance_) break;
      std::vector<double> cell = std::move(cells_[heap_.top().cell]);
      free_.push_back(heap_.top().cell);
      heap_.pop();
      std::vector<double> high = cell;
      halve(cell, high);
      push(std::move(cell));
      push(std::move(high));
    }
    return {heap_.empty() ? dropped_ : std::max(dropped_, heap_.top().bound), known_};
  }

 private:
  struct Item {
    double bound;
    std::size_t cell;
    bool operator<(const Item& o) const { return bound < o.bound || (bound == o.bound && cell > o.cell); }
  };
  std::size_t count() const { return rows_ * columns_; }

  void push(std::vector<double> c) {
    double bound = -infinity;
    for (std::size_t k = 0; k < count(); ++k) bound = std::max(bound, c[k] / c[count() + k]);
    for (std::size_t k : {std::size_t{0}, columns_ - 1, count() - columns_, count() - 1})
      known_ = std::max(known_, c[k] / c[count() + k]);
    if (bound <= known_ + tolerance_) {
      dropped_ = std::max(dropped_, bound);
      return;
    }
    std::size_t slot = cells_.size();
    if (free_.empty()) {
      cells_.emplace_back();
    } else {
      slot = free_.back();
      free_.pop_back();
    }
    cells_[slot] = std::move(c);
    heap_.push({bound, slot});
  }

  // Along the direction in which the coefficients are bent more.
  void halve(std::vector<double>& low, std::vector<double>& high) const {
    const auto bend = [&](std::size_t i, std::size_t step) {
      const double w = low[count() + i];
      return std::abs((low[i] - low[i + step]) + (low[i + 2 * step] - low[i + step])) / w +
             std::abs((low[count() + i] - low[count() + i + step]) +
                      (low[count() + i + 2 * step] - low[count() + i + step])) /
                 w * std::abs(low[i] / w);
    };
    double in_u = 0, in_v = 0;
    for (std::size_t i = 0; i < rows_; ++i)
      for (std::size_t j = 0; j < columns_; ++j) {
        if (i + 2 < rows_) in_u = std::max(in_u, bend(i * columns_ + j, columns_));
        if (j + 2 < columns_) in_v = std::max(in_v, bend(i * columns_ + j, 1));
      }
    // Bilinear coefficients may be twisted; then both directions take turns by their spread.
    const bool along_u = columns_ == 1 || (rows_ > 1 && (in_u > in_v || (in_u == in_v && rows_ >= columns_)));
    const std::size_t steps = along_u ? rows_ : columns_, step = along_u ? columns_ : 1;
    const std::size_t lines = along_u ? columns_ : rows_, line = along_u ? 1 : columns_;
    for (std::size_t part = 0; part < 2 * count(); part += count())
      for (std::size_t l = 0; l < lines; ++l) {
        double *a = low.data() + part + l * line, *b = high.data() + part + l * line;
        for (std::size_t r = 1; r < steps; ++r) {
          for (std::size_t i = steps; i-- > r;) a[i * step] = 0.5 * (a[i * step] + a[(i - 1) * step]);
          b[(steps - 1 - r) * step] = a[(steps - 1) * step];
        }
      }
  }

  std::size_t rows_, columns_;
  double tolerance_, known_ = -infinity, dropped_ = -infinity;
  std::vector<std::vector<double>> cells_;
  std::vector<std::size_t> free_;
  std::priority_queue<Item> heap_;
};

TightBox tight_of(const std::vector<PolesView>& pieces, double share) {
  const Box hull = hull_of(pieces);
  TightBox out{hull, infinity};
  if (!is_finite(hull.lo) || !is_finite(hull.hi)) return out;
  double roundings = 0;
  for (const PolesView& v : pieces) roundings = std::max(roundings, pole_roundings(v));
  const double size = largest_coordinate(hull) + hull.diagonal(), by = 2 * roundings * size;
  const Point middle = midpoint(hull.lo, hull.hi);
  out.slack = 0;
  const auto side = [&](double Hpoint::*coordinate, double Point::*at, double sign) {
    Extreme extreme(pieces.front().p, pieces.front().q, share * size);
    for (const PolesView& v : pieces) extreme.add(v, coordinate, sign, middle.*at);
    const auto [bound, attained] = extreme.find();
    out.slack = std::max(out.slack, bound - attained + 2 * by);
    return middle.*at + sign * (bound + by);
  };
  Box tight{{side(&Hpoint::x, &Point::x, -1), side(&Hpoint::y, &Point::y, -1), side(&Hpoint::z, &Point::z, -1)},
            {side(&Hpoint::x, &Point::x, 1), side(&Hpoint::y, &Point::y, 1), side(&Hpoint::z, &Point::z, 1)}};
  out.box = tight;
  return out;
}

}  // namespace

Box hull_box(const CurvePieces& c) { return hull_of(views(c)); }
Box hull_box(const SurfacePieces& s) { return hull_of(views(s)); }
TightBox tight_box(const CurvePieces& c, double share) { return tight_of(views(c), share); }
TightBox tight_box(const SurfacePieces& s, double share) { return tight_of(views(s), share); }

}  // namespace trimloop
