#include "kernel/closest/search.h"

#include <array>
#include <queue>

namespace trimloop::closest {

namespace {

double squared_distance_of(const Box& b, Point p) {
  const auto out = [](double x, double lo, double hi) { return std::max({lo - x, x - hi, 0.0}); };
  const double x = out(p.x, b.lo.x, b.hi.x), y = out(p.y, b.lo.y, b.hi.y), z = out(p.z, b.lo.z, b.hi.z);
  return (x * x + y * y + z * z) * (1 - 8 * std::numeric_limits<double>::epsilon());
}

struct Range {
  double lo = infinity, hi = -infinity;
  void add(double x) { lo = std::min(lo, x), hi = std::max(hi, x); }
  double largest() const { return std::max(std::abs(lo), std::abs(hi)); }
};

class Search {
 public:
  Search(const SquaredDistance& field, const Shape& shape, const Question& question)
      : d_(field),
        shape_(shape),
        ask_(question),
        n_(static_cast<std::size_t>(field.n) + 1),
        count_(field.count()),
        stride_(count_ * (field.rational ? 2 : 1)),
        known_(question.at_most),
        f_(count_) {}

  Answer run() {
    for (std::uint32_t g = 0; g < d_.groups.size(); ++g) push(squared_distance_of(d_.groups[g], ask_.p), Kind::Group, g);
    std::size_t halved = 0;
    while (!heap_.empty()) {
      const Item item = heap_.top();
      if (item.key >= threshold()) break;
      heap_.pop();
      if (item.kind == Kind::Group) {
        open_group(item.index);
      } else if (item.kind == Kind::Piece) {
        open_piece(item.index);
      } else if (halved < ask_.most_cells) {
        ++halved;
        halve(item.index);
      } else {
        answer_.complete = false;
        prove(item.key);
        break;  // the others are farther
      }
    }
    prove(threshold());
    return std::move(answer_);
  }

 private:
  enum class Kind : std::uint8_t { Group, Piece, Cell };
  struct Item {
    double key;
    std::uint32_t index;
    Kind kind;
    bool operator<(const Item& o) const { return key > o.key || (key == o.key && index > o.index); }  // smallest on top
  };
  struct Cell {
    std::uint32_t piece;
    std::uint32_t depth;
    Interval u, v;
    double error;
    bool along_u = true;  // the way to halve it
  };

  // What is not nearer than this is of no interest: squared distances.
  double threshold() const {
    if (known_ == infinity) return infinity;
    if (ask_.collect) return std::pow(std::sqrt(known_) * (1 + 1e-9) + ask_.within, 2);
    const double distance = std::sqrt(known_), cut = distance * (1 - 1e-11) - ask_.tolerance;
    return cut > 0 ? cut * cut : 0;
  }
  void prove(double squared) { answer_.lower = first_proof_ ? squared : std::min(answer_.lower, squared); first_proof_ = false; }
  void push(double key, Kind kind, std::uint32_t index) {
    if (key < threshold()) heap_.push({key, index, kind});
  }

  void open_group(std::uint32_t group) {
    const std::size_t first = group * SquaredDistance::group;
    const std::size_t last = std::min(first + SquaredDistance::group, d_.pieces.size());
    for (std::size_t i = first; i < last; ++i)
      push(squared_distance_of(d_.pieces[i].box, ask_.p), Kind::Piece, static_cast<std::uint32_t>(i));
  }

  void open_piece(std::uint32_t piece) {
    const std::uint32_t slot = new_cell();
    double* product = numbers(slot);
    Cell& cell = cells_[slot];
    cell = {piece, 0, d_.pieces[piece].u, d_.pieces[piece].v, 0, true};
    cell.error = d_.combine(piece, ask_.p, product, product + count_);
    examine(slot);
  }

  std::uint32_t new_cell() {
    if (!free_.empty()) {
      const std::uint32_t slot = free_.back();
      free_.pop_back();
      return slot;
    }
    cells_.emplace_back();
    numbers_.resize(numbers_.size() + stride_);
    return static_cast<std::uint32_t>(cells_.size() - 1);
  }
  double* numbers(std::uint32_t slot) { return numbers_.data() + slot * stride_; }
  double weight(const double* numbers, std::size_t k) const { return d_.rational ? numbers[count_ + k] : 1; }

  // ---- A cell: dropped, or put in the queue to be halved.

  void examine(std::uint32_t slot) {
    try_corners(slot);
    if (examine_bounds(slot)) free_.push_back(slot);
  }

  // Values at corners are coefficients: a start where one is nearer than what is known.
  void try_corners(std::uint32_t slot) {
    const double* a = numbers(slot);
    const std::size_t last_row = count_ - n_;
    const std::array<std::size_t, 4> corner{0, n_ - 1, last_row, count_ - 1};
    double best = known_;
    int which = -1;
    for (int i = 0; i < 4; ++i) {
      const double w = weight(a, corner[static_cast<std::size_t>(i)]);
      const double value = a[corner[static_cast<std::size_t>(i)]] / w;
      if (w > 0 && value < best) best = value, which = i;
    }
    if (which < 0) return;
    const Cell& cell = cells_[slot];
    const SquaredDistance::Piece& piece = d_.pieces[cell.piece];
    const Uv start{which < 2 ? cell.u.lo : cell.u.hi, which % 2 == 0 ? cell.v.lo : cell.v.hi};
    consider(descend(shape_, cell.piece, piece.u, piece.v, ask_.p, start));
  }

  void consider(const Foot& foot) {
    if (!(foot.squared < known_) || (ask_.inside && !ask_.inside(foot.uv))) return;
    known_ = foot.squared;
    answer_.best = foot;
  }

  // F = w^2 (D - T); returns its range.
  Range subtract(const double* a, double t) {
    Range r;
    if (d_.rational) {
      const double* w = a + count_;
      for (std::size_t k = 0; k < count_; ++k) f_[k] = a[k] - t * w[k];
    } else {
      for (std::size_t k = 0; k < count_; ++k) f_[k] = a[k] - t;
    }
    for (std::size_t k = 0; k < count_; ++k) r.add(f_[k]);
    return r;
  }
  Range weights(const double* a) const {
    if (!d_.rational) return {1, 1};
    Range r;
    for (std::size_t k = 0; k < count_; ++k) r.add(a[count_ + k]);
    return r;
  }

  bool examine_bounds(std::uint32_t slot) {
    const double* a = numbers(slot);
    double t = threshold();
    if (t == infinity) t = 4 * (d_.size * d_.size + dot(to_vector(ask_.p), to_vector(ask_.p)));  // none known yet
    Range f = subtract(a, t);
    const Range w = weights(a);
    const double error = cells_[slot].error + 4 * std::numeric_limits<double>::epsilon() * t * w.largest();
    const auto lower = [&](double of_f) { return w.lo > 0 ? std::max(0.0, t + std::min(of_f, 0.0) / w.lo) : 0; };
    if (f.lo >= -error) {  // the sign is beyond what rounding lets us tell
      prove(f.lo >= error ? t : lower(f.lo - error));
      return true;
    }
    const Curvature c = curvature();
    if (c.convex(4 * error) && w.lo > 0 && settle(slot, t, w)) return true;
    Cell& cell = cells_[slot];
    const bool no_u = !(cell.u.mid() > cell.u.lo && cell.u.mid() < cell.u.hi),
               no_v = n_ == 1 || !(cell.v.mid() > cell.v.lo && cell.v.mid() < cell.v.hi);
    if ((no_u && no_v) || cell.depth > 100) {
      prove(lower(f.lo - error));
      answer_.complete = answer_.complete && ask_.collect == false;
      return true;
    }
    cell.along_u = no_v || (!no_u && c.bend_u >= c.bend_v);
    const double key = lower(f.lo - error);
    push_cell(key, slot);
    return false;
  }
  void push_cell(double key, std::uint32_t slot) { heap_.push({key, slot, Kind::Cell}); }

  // Second differences of F: its second derivatives but for the factors m (m - 1) and so on.
  struct Curvature {
    Range uu, uv, vv;
    double bend_u = 0, bend_v = 0;
    bool surface = false;
    double scale_uu = 0, scale_uv = 0, scale_vv = 0;
    bool convex(double error) const {
      const double a = (uu.lo - error) * scale_uu;
      if (!surface) return a > 0;
      const double b = (vv.lo - error) * scale_vv, c = (uv.largest() + error) * scale_uv;
      return a > 0 && b > 0 && a * b > c * c;
    }
  };
  Curvature curvature() const {
    Curvature c;
    const std::size_t rows = count_ / n_, m = rows - 1, n = n_ - 1;
    c.surface = n > 0;
    c.scale_uu = static_cast<double>(m * (m - 1));
    c.scale_uv = static_cast<double>(m * n);
    c.scale_vv = n > 0 ? static_cast<double>(n * (n - 1)) : 0;
    for (std::size_t i = 0; i + 2 < rows; ++i)
      for (std::size_t j = 0; j < n_; ++j) {
        const double* f = f_.data() + i * n_ + j;
        c.uu.add(f[0] - 2 * f[n_] + f[2 * n_]);
      }
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j + 2 < n_; ++j) {
        const double* f = f_.data() + i * n_ + j;
        c.vv.add(f[0] - 2 * f[1] + f[2]);
      }
    for (std::size_t i = 0; i + 1 < rows; ++i)
      for (std::size_t j = 0; j + 1 < n_; ++j) {
        const double* f = f_.data() + i * n_ + j;
        c.uv.add((f[0] - f[1]) - (f[n_] - f[n_ + 1]));
      }
    c.bend_u = c.uu.largest() * c.scale_uu;
    c.bend_v = n > 0 ? c.vv.largest() * c.scale_vv : 0;
    return c;
  }

  // F is convex: one valley. Its bottom, and whether F is proven not to be negative (or, when valleys are collected,
  // whether that one is all there is).
  bool settle(std::uint32_t slot, double t, const Range& w) {
    const Cell& cell = cells_[slot];
    Uv start{cell.u.mid(), cell.v.mid()};
    const Foot& best = answer_.best;
    if (best.squared < infinity && best.piece == cell.piece) start = {cell.u.clamp(best.uv.u), cell.v.clamp(best.uv.v)};
    const Foot foot = descend(shape_, cell.piece, cell.u, cell.v, ask_.p, start);
    const bool better = foot.squared < known_;
    consider(foot);
    if (ask_.collect) {
      if (foot.squared <= threshold()) answer_.feet.push_back(foot);
      return true;
    }
    // With `inside`, a point of interest is stationary, and the bottom is the only such point of the cell.
    if (ask_.inside && !better) return true;
    if (better) {  // F has changed with T
      t = threshold();
      const Range f = subtract(numbers(slot), t);
      if (f.lo >= cell.error) return prove(t), true;
      if (!curvature().convex(8 * cell.error)) return false;
    }
    // F(x) >= F(foot) + F'(foot) (x - foot), F' = w^2 D' + (D - T) (w^2)'; the derivative of w^2 over the cell is at
    // most its degree times the spread of its coefficients.
    const auto fall = [](double g, double at, Interval i) { return g > 0 ? g * (at - i.lo) : -g * (i.hi - at); };
    const double down = fall(foot.gu, foot.uv.u, cell.u) + fall(foot.gv, foot.uv.v, cell.v);
    const double above = foot.squared - t, change = (d_.m + d_.n) * (w.hi - w.lo);
    const double f = above * (w.lo - change) - w.hi * down;
    if (f < 0 && -f > 1e-12 * w.lo * (above + t)) return false;
    prove(f >= 0 ? t : std::max(0.0, t + f / w.lo));
    return true;
  }

  // ---- Halves, by de Casteljau at the middle.

  void halve(std::uint32_t slot) {
    const std::uint32_t other = new_cell();
    Cell &low = cells_[slot], &high = cells_[other];
    ++low.depth;
    high = low;
    const bool along_u = low.along_u;
    if (along_u)
      low.u.hi = high.u.lo = low.u.mid();
    else
      low.v.hi = high.v.lo = low.v.mid();
    for (std::size_t part = 0; part < stride_; part += count_)
      halve_numbers(numbers(slot) + part, numbers(other) + part, along_u);
    examine(slot);
    examine(other);
  }
  void halve_numbers(double* low, double* high, bool along_u) const {
    const std::size_t rows = count_ / n_;
    const std::size_t steps = along_u ? rows : n_, step = along_u ? n_ : 1;
    const std::size_t lines = along_u ? n_ : rows, line = along_u ? 1 : n_;
    // low becomes the row of first points of each column, high keeps the last ones.
    std::copy(low, low + count_, high);
    for (std::size_t r = 1; r < steps; ++r) {
      // After r rounds entry i >= r of `low` is the point b_{i - r .. i}; entry r is final for the lower half.
      for (std::size_t i = steps; i-- > r;)
        for (std::size_t l = 0; l < lines; ++l) {
          double* at = low + i * step + l * line;
          *at = 0.5 * (*at + *(at - step));
        }
      for (std::size_t l = 0; l < lines; ++l)
        high[(steps - 1 - r) * step + l * line] = low[(steps - 1) * step + l * line];
    }
  }

  const SquaredDistance& d_;
  const Shape& shape_;
  const Question& ask_;
  std::size_t n_, count_, stride_;
  double known_;
  std::vector<double> f_, numbers_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> free_;
  std::priority_queue<Item> heap_;
  Answer answer_;
  bool first_proof_ = true;
};

}  // namespace

Answer search(const SquaredDistance& field, const Shape& shape, const Question& question) {
  return Search(field, shape, question).run();
}

}  // namespace trimloop::closest
