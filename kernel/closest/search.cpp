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
  void add(Range r) { lo = std::min(lo, r.lo), hi = std::max(hi, r.hi); }
  double largest() const { return std::max(std::abs(lo), std::abs(hi)); }
};

// Of at(0) .. at(n - 1), n > 0. Four at a time: one comparison would wait for the other.
template <class At>
Range range_of(std::size_t n, At at) {
  std::array<double, 4> lo, hi;
  lo.fill(at(0));
  hi = lo;
  std::size_t k = 0;
  const auto add = [&](std::size_t i, double x) {
    lo[i] = x < lo[i] ? x : lo[i];
    hi[i] = x > hi[i] ? x : hi[i];
  };
  for (; k + 4 <= n; k += 4)
    for (std::size_t i = 0; i < 4; ++i) add(i, at(k + i));
  for (; k < n; ++k) add(0, at(k));
  return {std::min(std::min(lo[0], lo[1]), std::min(lo[2], lo[3])),
          std::max(std::max(hi[0], hi[1]), std::max(hi[2], hi[3]))};
}

// Second differences of coefficients: second derivatives but for the factors m (m - 1) and so on.
struct Curvature {
  Range uu, uv, vv;
  double scale_uu = 0, scale_uv = 0, scale_vv = 0;  // those factors
  bool surface = false;
  double bend_u() const { return uu.largest() * scale_uu; }
  double bend_v() const { return surface ? vv.largest() * scale_vv : 0; }
  bool convex(double error) const {
    const double a = (uu.lo - error) * scale_uu;
    if (!surface) return a > 0;
    const double b = (vv.lo - error) * scale_vv, c = (uv.largest() + error) * scale_uv;
    return a > 0 && b > 0 && a * b > c * c;
  }
};

// What is done with coefficients; the number of rows and columns may be known when this is compiled.
template <class Rows, class Columns>
struct Net {
  Rows rows;
  Columns columns;
  bool is_bicubic() const { return rows == 7 && columns == 7; }

  Curvature curvature(const double* f) const {
    Curvature c;
    c.surface = columns > 1;
    c.scale_uu = static_cast<double>((rows - 1) * (rows - 2));
    c.scale_uv = static_cast<double>((rows - 1) * (columns - 1));
    c.scale_vv = c.surface ? static_cast<double>((columns - 1) * (columns - 2)) : 0;
    const std::size_t n = columns;
    c.uu = range_of((rows - 2) * n, [&](std::size_t k) { return (f[k] - f[k + n]) + (f[k + 2 * n] - f[k + n]); });
    if (!c.surface) return c;
    for (std::size_t i = 0; i < rows; ++i) {
      const double *a = f + i * n, *b = a + n;
      c.vv.add(range_of(n - 2, [&](std::size_t k) { return (a[k] - a[k + 1]) + (a[k + 2] - a[k + 1]); }));
      if (i + 1 < rows) c.uv.add(range_of(n - 1, [&](std::size_t k) { return (a[k] - a[k + 1]) - (b[k] - b[k + 1]); }));
    }
    return c;
  }

  // By de Casteljau at the middle: `low` becomes its first half, `high` gets the other.
  void halve(double* low, double* high, bool along_u) const {
    along_u ? halve(low, high, rows, columns, columns, 1) : halve(low, high, columns, 1, rows, columns);
  }
  static void halve(double* low, double* high, std::size_t steps, std::size_t step, std::size_t lines,
                    std::size_t line) {
    const auto keep = [&](std::size_t i) {
      for (std::size_t l = 0; l < lines; ++l) high[i * step + l * line] = low[(steps - 1) * step + l * line];
    };
    keep(steps - 1);
    for (std::size_t r = 1; r < steps; ++r) {  // after r rounds entry i >= r is the point of poles i - r .. i
      for (std::size_t i = steps; i-- > r;)
        for (std::size_t l = 0; l < lines; ++l) {
          double* at = low + i * step + l * line;
          *at = 0.5 * (*at + *(at - step));
        }
      keep(steps - 1 - r);
    }
  }
};
using AnyNet = Net<std::size_t, std::size_t>;
using Seven = std::integral_constant<std::size_t, 7>;
using Bicubic = Net<Seven, Seven>;

class Search {
 public:
  Search(const SquaredDistance& field, const Shape& shape, const Question& question)
      : d_(field),
        shape_(shape),
        ask_(question),
        n_(static_cast<std::size_t>(field.n) + 1),
        count_(field.count()),
        net_{count_ / n_, n_},
        stride_(count_ * (field.rational ? 2 : 1)),
        known_(question.at_most),
        f_(count_) {}

  Answer run() {
    for (std::uint32_t g = 0; g < d_.groups.size(); ++g)
      push(squared_distance_of(d_.groups[g], ask_.p), Kind::Group, g);
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
  void prove(double squared) {
    answer_.lower = first_proof_ ? squared : std::min(answer_.lower, squared);
    first_proof_ = false;
  }
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
    const double* w = a + count_;
    if (d_.rational)
      for (std::size_t k = 0; k < count_; ++k) f_[k] = a[k] - t * w[k];
    else
      for (std::size_t k = 0; k < count_; ++k) f_[k] = a[k] - t;
    return range_of(count_, [&](std::size_t k) { return f_[k]; });
  }
  Range weights(const double* a) const {
    if (!d_.rational) return {1, 1};
    return range_of(count_, [&](std::size_t k) { return a[count_ + k]; });
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
    if (ask_.inside && (has_no_stationary_point(a, t, lower(f.lo - error), error) ||
                        (ask_.outside && ask_.outside(cells_[slot].u, cells_[slot].v)))) {
      prove(t);
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
    cell.along_u = no_v || (!no_u && c.bend_u() >= c.bend_v());
    const double key = lower(f.lo - error);
    push_cell(key, slot);
    return false;
  }
  // Where D is stationary with the value m, so is w^2 (D - m): its derivative along u or v is of one sign for m at both
  // ends of the range of values, and so for all between. Leaves F in f_.
  bool has_no_stationary_point(const double* a, double t, double lowest, double error) {
    Range along_u, along_v;
    for (double m : {lowest, t}) {
      subtract(a, m);
      const double* f = f_.data();
      along_u.add(range_of(count_ - n_, [&](std::size_t k) { return f[k + n_] - f[k]; }));
      for (std::size_t i = 0; n_ > 1 && i < count_; i += n_)
        along_v.add(range_of(n_ - 1, [&](std::size_t k) { return f[i + k + 1] - f[i + k]; }));
    }
    const auto one_sign = [&](const Range& r) { return r.lo > 2 * error || r.hi < -2 * error; };
    return one_sign(along_u) || (n_ > 1 && one_sign(along_v));
  }
  void push_cell(double key, std::uint32_t slot) { heap_.push({key, slot, Kind::Cell}); }

  Curvature curvature() const { return net_.is_bicubic() ? Bicubic{}.curvature(f_.data()) : net_.curvature(f_.data()); }

  // F is convex: one valley. Whether F is proven not to be negative (or, when valleys are collected, whether that one
  // is all there is).
  bool settle(std::uint32_t slot, double t, const Range& w) {
    const Cell& cell = cells_[slot];
    Uv start{cell.u.mid(), cell.v.mid()};
    if (known_ < infinity && answer_.best.piece == cell.piece)
      start = {cell.u.clamp(answer_.best.uv.u), cell.v.clamp(answer_.best.uv.v)};
    const bool plain = !ask_.collect && !ask_.inside;
    if (plain && above_tangent_plane(cell, foot_at(shape_, cell.piece, ask_.p, start), t, w)) return true;
    const Foot foot = descend(shape_, cell.piece, cell.u, cell.v, ask_.p, start);
    const bool better = foot.squared < known_;
    consider(foot);
    if (ask_.collect) {
      if (foot.squared <= threshold()) answer_.feet.push_back(foot);
      return true;
    }
    // With `inside`, a point of interest is stationary, and the bottom is the only such point of the cell.
    if (ask_.inside) return prove(t), true;
    if (better) {  // F has changed with T
      t = threshold();
      const Range f = subtract(numbers(slot), t);
      if (f.lo >= cell.error) return prove(t), true;
      if (!curvature().convex(8 * cell.error)) return false;
    }
    return above_tangent_plane(cell, foot, t, w);
  }

  // F(x) >= F(foot) + F'(foot) (x - foot), F' = w^2 D' + (D - T) (w^2)'; the derivative of w^2 over the cell is at most
  // its degree times the spread of its coefficients.
  bool above_tangent_plane(const Cell& cell, const Foot& foot, double t, const Range& w) {
    const auto fall = [](double g, double at, Interval i) { return g > 0 ? g * (at - i.lo) : -g * (i.hi - at); };
    const double down = fall(foot.gu, foot.uv.u, cell.u) + fall(foot.gv, foot.uv.v, cell.v);
    const double above = foot.squared - t, change = (d_.m + d_.n) * (w.hi - w.lo);
    const double f = (above < 0 ? above * (w.hi + change) : above * (w.lo - change)) - w.hi * down;
    if (f < 0 && -f > 1e-12 * w.lo * t) return false;
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
    for (std::size_t part = 0; part < stride_; part += count_) {
      double *first = numbers(slot) + part, *second = numbers(other) + part;
      net_.is_bicubic() ? Bicubic{}.halve(first, second, along_u) : net_.halve(first, second, along_u);
    }
    examine(slot);
    examine(other);
  }

  const SquaredDistance& d_;
  const Shape& shape_;
  const Question& ask_;
  std::size_t n_, count_;
  AnyNet net_;
  std::size_t stride_;
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
