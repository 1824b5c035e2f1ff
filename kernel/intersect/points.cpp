#include "kernel/intersect/points.h"

namespace trimloop::detail {
namespace {

constexpr double inflation = 1.0 / 16;  // of a cell on either side, so that roots on cell borders are inside of some
constexpr Cell whole{Interval{0, 1}, Interval{0, 1}, Interval{0, 1}};

// ---- Small linear algebra

// Rows of the pseudo-inverse of the matrix with columns `j` (two or three of them); false when it is singular.
bool invert(const std::array<Vector, 3>& j, int n, std::array<Vector, 3>& rows) {
  if (n == 2) {
    const double a = dot(j[0], j[0]), b = dot(j[0], j[1]), c = dot(j[1], j[1]), det = a * c - b * b;
    if (!(det > 1e-26 * a * c)) return false;
    rows[0] = (c * j[0] - b * j[1]) / det;
    rows[1] = (a * j[1] - b * j[0]) / det;
  } else {
    const Vector x = cross(j[1], j[2]);
    const double det = dot(j[0], x);
    if (!(std::abs(det) > 1e-26 * norm(j[0]) * norm(j[1]) * norm(j[2]))) return false;
    rows[0] = x / det;
    rows[1] = cross(j[2], j[0]) / det;
    rows[2] = cross(j[0], j[1]) / det;
  }
  for (int i = 0; i < n; ++i)
    if (!is_finite(rows[static_cast<std::size_t>(i)])) return false;
  return true;
}

// Solves the symmetric n x n system by elimination with a little damping on the diagonal; true when it could.
bool solve(std::array<std::array<double, 3>, 3> m, std::array<double, 3> r, int n, std::array<double, 3>& x) {
  for (int k = 0; k < n; ++k) {
    if (!(m[k][k] > 0)) return false;
    for (int i = k + 1; i < n; ++i) {
      const double f = m[i][k] / m[k][k];
      for (int c = k; c < n; ++c) m[i][c] -= f * m[k][c];
      r[i] -= f * r[k];
    }
  }
  for (int k = n; k-- > 0;) {
    x[k] = r[k];
    for (int c = k + 1; c < n; ++c) x[k] -= m[k][c] * x[c];
    x[k] /= m[k][k];
  }
  return true;
}

// ---- The solver

class Solver {
 public:
  Solver(const Bezier& a, const Bezier& b, double tolerance, std::size_t& cells, Known known, const void* context)
      : a_(a), b_(b), n_(1 + b.dimensions()), tolerance_(tolerance), cells_(cells), known_(known), context_(context) {}

  PointContacts run() {
    Cell start = whole;
    if (n_ == 2) start[2] = {0, 0};
    stack_.push_back(start);
    while (!stack_.empty()) {
      const Cell cell = stack_.back();
      stack_.pop_back();
      if (cells_ == 0) {
        out_.undecided.push_back(cell);
        continue;
      }
      --cells_;
      examine(cell);
    }
    settle_terminals();
    return std::move(out_);
  }

 private:
  struct View {
    Cell cell;  // inflated
    Enclosure a, b;
  };

  void examine(const Cell& cell) {
    if (is_settled(cell) || (known_ && known_(context_, cell))) return;
    Cell wider;
    for (int i = 0; i < n_; ++i) {
      const double by = inflation * cell[i].length();
      wider[i] = {cell[i].lo - by, cell[i].hi + by};
    }
    View view = look_at(wider);
    if (!view.a.valid || !view.b.valid) return split(cell, view);  // the inflation met a zero weight
    if (boxes_apart(view)) return;
    complete(view);
    if (separated(view)) return;
    Cell smaller = cell;
    switch (contract(cell, view, smaller)) {
      case Verdict::Settled:
      case Verdict::Empty:
        return;
      case Verdict::Smaller:
        stack_.push_back(smaller);
        return;
      case Verdict::Unknown:
        break;
    }
    if (is_thin(cell, view))
      terminals_.push_back(cell);
    else
      split(cell, view);
  }

  View look_at(const Cell& cell) {
    View view;
    view.cell = cell;
    restrict_to(a_, cell[0], {0, 1}, net_a_);
    restrict_to(b_, cell[1], n_ == 3 ? cell[2] : Interval{0, 1}, net_b_);
    view.a = enclose_points(a_, net_a_);
    view.b = enclose_points(b_, net_b_);
    return view;
  }
  void complete(View& view) const {
    enclose_derivatives(a_, net_a_, false, view.a);
    enclose_derivatives(b_, net_b_, false, view.b);
  }

  bool is_settled(const Cell& cell) const {
    for (const Cell& s : settled_) {
      bool inside = true;
      for (int i = 0; i < n_; ++i) inside &= s[i].lo <= cell[i].lo && cell[i].hi <= s[i].hi;
      if (inside) return true;
    }
    return false;
  }

  // ---- Separation

  bool apart(Range d) const { return d.lo > tolerance_ || d.hi < -tolerance_; }
  bool apart_along(Vector direction) const {
    const double size = norm(direction);
    if (!(size > 0)) return false;
    direction = direction / size;
    const Range a = extent(a_, net_a_, direction), b = extent(b_, net_b_, direction);
    return a.lo - b.hi > tolerance_ || b.lo - a.hi > tolerance_;
  }
  std::array<Vector, 5> directions(const View& view) const {
    const Vector t = view.a.du.mid(), s = view.b.du.mid();
    if (n_ == 3) {
      const Vector n = cross(s, view.b.dv.mid());
      return {n, cross(n, t), cross(s, t), cross(view.b.dv.mid(), t), {}};
    }
    Vector n = cross(t, s);
    if (!(norm(n) > 1e-9 * norm(t) * norm(s))) {
      const Vector between = view.a.centre - view.b.centre;
      n = cross(t, between);  // nearly parallel: the plane of both
      if (!(norm(n) > 0)) n = cross(t, std::abs(t.x) < std::abs(t.y) ? Vector{1, 0, 0} : Vector{0, 1, 0});
    }
    return {cross(n, t), cross(n, s), n, {}, {}};
  }
  bool boxes_apart(const View& view) const {
    const RangeVector d = points(view.a) - points(view.b);
    return apart(d.x) || apart(d.y) || apart(d.z);
  }
  bool separated(const View& view) const {
    for (const Vector& direction : directions(view))
      if (apart_along(direction)) return true;
    return false;
  }

  // ---- Contraction

  enum class Verdict { Settled, Empty, Smaller, Unknown };

  Verdict contract(const Cell& cell, const View& view, Cell& smaller) {
    const std::array<RangeVector, 3> columns{view.a.du, -view.b.du, -view.b.dv};
    std::array<Vector, 3> middle{columns[0].mid(), columns[1].mid(), columns[2].mid()}, rows{};
    if (!invert(middle, n_, rows)) return Verdict::Unknown;
    std::array<double, 3> centre{};
    for (int i = 0; i < n_; ++i) centre[i] = view.cell[i].mid();
    const Vector f = evaluate(a_, centre[0], 0) - evaluate(b_, centre[1], n_ == 3 ? centre[2] : 0);
    const double slack = tolerance_ + rounding();
    bool contracting = true;
    std::array<Range, 3> k;
    for (int i = 0; i < n_; ++i) {
      const Vector& row = rows[i];
      Range value = around(-dot(row, f), slack * (std::abs(row.x) + std::abs(row.y) + std::abs(row.z)));
      double sum = 0;
      for (int c = 0; c < n_; ++c) {
        const double off = (Range(i == c ? 1.0 : 0.0) - dot(row, columns[c])).magnitude();
        sum += off;
        value = value + Range{-0.5 * off, 0.5 * off};
      }
      contracting &= sum < 1 && value.lo > -0.5 && value.hi < 0.5;
      k[i] = value;
      // Back in the cell's own parameters; all contacts of the inflated cell are in there.
      const double w = view.cell[i].length();
      const Interval found{centre[i] + w * value.lo, centre[i] + w * value.hi};
      smaller[i] = {std::max(cell[i].lo, found.lo), std::min(cell[i].hi, found.hi)};
      if (!(smaller[i].lo <= smaller[i].hi)) return Verdict::Empty;
    }
    if (contracting) {
      accept(view, centre, k);
      return Verdict::Settled;
    }
    double share = 1;
    for (int i = 0; i < n_; ++i) share *= smaller[i].length() / std::max(cell[i].length(), 1e-300);
    return share < 0.4 ? Verdict::Smaller : Verdict::Unknown;
  }

  double rounding() const { return blur(a_) + blur(b_); }
  // The one root of the cell, if it lies on both shapes: at most a tolerance beyond their ends.
  void accept(const View& view, const std::array<double, 3>& centre, const std::array<Range, 3>& k) {
    settled_.push_back(view.cell);
    std::array<double, 3> at{};
    for (int i = 0; i < n_; ++i) at[i] = centre[i] + view.cell[i].length() * k[i].mid();
    NearestPair pair = nearest_pair(a_, b_, view.cell, at);
    Cell inside = view.cell;
    bool beyond = false;
    for (int i = 0; i < n_; ++i) {
      inside[i] = {std::max(inside[i].lo, 0.0), std::min(inside[i].hi, 1.0)};
      beyond |= !(0 <= pair.at[i] && pair.at[i] <= 1);
      if (!(inside[i].lo <= inside[i].hi)) return;
    }
    if (beyond) {
      for (int i = 0; i < n_; ++i) pair.at[i] = inside[i].clamp(pair.at[i]);
      pair = nearest_pair(a_, b_, inside, pair.at);
    }
    if (!(pair.distance <= tolerance_ + rounding())) return;
    out_.contacts.push_back({pair.at, midpoint(pair.a, pair.b), pair.distance, true, view.cell});
  }

  // ---- What cannot be settled

  // Both parts in a slab about which nothing can be told apart any more.
  bool is_thin(const Cell& cell, const View& view) const {
    const double thick = 4 * (tolerance_ + rounding());
    const auto thickness = [&](Vector direction) {
      const double size = norm(direction);
      if (!(size > 0)) return infinity;
      direction = direction / size;
      const Range both = hull(extent(a_, net_a_, direction), extent(b_, net_b_, direction));
      return both.width();
    };
    bool shortest = true;
    for (int i = 0; i < n_; ++i) shortest &= cell[i].length() < 1e-14;
    if (shortest) return true;
    const Vector t = view.a.du.mid();
    if (n_ == 3) {
      if (thickness(cross(view.b.du.mid(), view.b.dv.mid())) > thick) return false;
    } else {
      const Vector any = std::abs(t.x) < std::abs(t.y) ? Vector{1, 0, 0} : Vector{0, 1, 0};
      const Vector n1 = cross(t, any), n2 = cross(t, n1);
      if (thickness(n1) > thick || thickness(n2) > thick) return false;
    }
    // Parts that only meet end to end are halved on: the contact is a point.
    const double size = norm(t);
    if (!(size > 16 * thick)) return true;
    const Range a = extent(a_, net_a_, t / size), b = extent(b_, net_b_, t / size);
    return std::min(a.hi, b.hi) - std::max(a.lo, b.lo) > 0.25 * std::min(a.width(), b.width());
  }

  void split(const Cell& cell, const View& view) {
    const double sizes[3] = {norm(view.a.du.mid()), norm(view.b.du.mid()), norm(view.b.dv.mid())};
    int widest = 0;
    double most = -1;
    for (int i = 0; i < n_; ++i) {
      // Of shapes that stand still in the middle the longer parameter.
      const double size = cell[i].length() < 1e-15 ? -1 : (view.a.valid && view.b.valid ? sizes[i] : cell[i].length());
      if (size > most) most = size, widest = i;
    }
    if (most < 0) {
      terminals_.push_back(cell);
      return;
    }
    Cell one = cell, two = cell;
    one[widest].hi = two[widest].lo = cell[widest].at(0.5 - 0.0137);  // roots of symmetric shapes are not on the cut
    stack_.push_back(two);
    stack_.push_back(one);
  }

  // ---- Touches

  bool neighbours(const Cell& a, const Cell& b) const {
    for (int i = 0; i < n_; ++i) {
      const double by = 0.25 * std::max(a[i].length(), b[i].length()) + 1e-15;
      if (a[i].hi + by < b[i].lo || b[i].hi + by < a[i].lo) return false;
    }
    return true;
  }

  // Crossings at so small an angle that no cell of the halving was right: cells about the root itself are tried.
  void settle_shallow() {
    constexpr std::size_t most = 256;
    for (std::size_t k = 0; k < terminals_.size() && k < most; ++k) {
      const Cell cell = terminals_[k];
      if (is_settled(cell)) continue;
      Cell wide = cell;
      std::array<double, 3> start{};
      for (int i = 0; i < n_; ++i) {
        start[i] = cell[i].mid();
        wide[i] = {cell[i].lo - cell[i].length(), cell[i].hi + cell[i].length()};
      }
      const NearestPair pair = nearest_pair(a_, b_, wide, start);
      if (!(pair.distance <= tolerance_ + rounding())) continue;
      for (double factor = 0.5; factor <= 8; factor *= 2) {
        Cell about = cell, smaller = cell;
        for (int i = 0; i < n_; ++i)
          about[i] = {pair.at[i] - factor * cell[i].length(), pair.at[i] + factor * cell[i].length()};
        View view = look_at(about);
        complete(view);
        if (view.a.valid && view.b.valid && contract(about, view, smaller) == Verdict::Settled) break;
      }
    }
    std::erase_if(terminals_, [this](const Cell& cell) { return is_settled(cell); });
  }

  void settle_terminals() {
    settle_shallow();
    std::vector<int> group(terminals_.size(), -1);
    for (std::size_t seed = 0; seed < terminals_.size(); ++seed) {
      if (group[seed] >= 0) continue;
      std::vector<std::size_t> members{seed}, todo{seed};
      group[seed] = static_cast<int>(seed);
      while (!todo.empty()) {
        const std::size_t at = todo.back();
        todo.pop_back();
        for (std::size_t k = 0; k < terminals_.size(); ++k)
          if (group[k] < 0 && neighbours(terminals_[at], terminals_[k])) {
            group[k] = static_cast<int>(seed);
            members.push_back(k);
            todo.push_back(k);
          }
      }
      settle_group(members);
    }
    for (const PointContact& d : doubtful_)
      if (!belongs_to_touch(d)) out_.undecided.push_back(d.within);
  }

  // Beside a contact the gap grows slowly: what is a little over the tolerance there is no contact of its own.
  bool belongs_to_touch(const PointContact& d) {
    const double near = 8 * (tolerance_ + rounding());
    if (d.gap > near) return false;
    for (PointContact& c : out_.contacts) {
      if (c.crossing) continue;
      bool together = true;
      Cell box = c.within;
      for (int i = 0; i < n_; ++i) box[i] = {std::min(box[i].lo, d.within[i].lo), std::max(box[i].hi, d.within[i].hi)};
      for (double f = 0.1; f < 0.95 && together; f += 0.1) {
        std::array<double, 3> start{};
        for (int i = 0; i < n_; ++i) start[i] = c.at[i] + f * (d.at[i] - c.at[i]);
        Cell there = box;
        there[0] = {start[0], start[0]};
        together = nearest_pair(a_, b_, there, start).distance <= near;
      }
      if (!together) continue;
      c.within = box;
      return true;
    }
    return false;
  }

  void settle_group(const std::vector<std::size_t>& members) {
    Cell box = terminals_[members[0]];
    for (const std::size_t k : members)
      for (int i = 0; i < n_; ++i)
        box[i] = {std::min(box[i].lo, terminals_[k][i].lo), std::max(box[i].hi, terminals_[k][i].hi)};
    // The middle of the contact if it is one; else the best of several places.
    std::array<double, 3> start{};
    for (int i = 0; i < n_; ++i) start[i] = box[i].mid();
    NearestPair best = nearest_pair(a_, b_, box, start);
    const std::size_t step = std::max<std::size_t>(1, members.size() / 16);
    for (std::size_t k = 0; k < members.size() && best.distance > tolerance_; k += step) {
      for (int i = 0; i < n_; ++i) start[i] = terminals_[members[k]][i].mid();
      const NearestPair pair = nearest_pair(a_, b_, box, start);
      if (pair.distance < best.distance) best = pair;
    }
    if (!(best.distance <= tolerance_ + rounding())) {
      doubtful_.push_back({best.at, midpoint(best.a, best.b), best.distance, false, box});
      return;
    }
    for (const PointContact& c : out_.contacts) {  // a root beside: one contact with it
      bool meets = true;
      for (int i = 0; i < n_; ++i) meets &= c.within[i].lo <= box[i].hi && box[i].lo <= c.within[i].hi;
      if (meets && distance(c.point, best.a) <= 8 * (tolerance_ + rounding())) return;
    }
    out_.contacts.push_back({best.at, midpoint(best.a, best.b), best.distance, false, box});
  }

  const Bezier &a_, &b_;
  const int n_;
  const double tolerance_;
  std::size_t& cells_;
  Known known_;
  const void* context_;
  std::vector<Cell> stack_, settled_, terminals_;
  std::vector<PointContact> doubtful_;  // groups whose gap is a little more than the tolerance
  std::vector<Hpoint> net_a_, net_b_;
  PointContacts out_;
};

}  // namespace

NearestPair nearest_pair(const Bezier& curve, const Bezier& other, const Cell& cell, std::array<double, 3> x) {
  const int n = 1 + other.dimensions();
  const auto at = [&](const std::array<double, 3>& p, BezierJet& a, BezierJet& b) {
    a = jet(curve, p[0], 0);
    b = jet(other, p[1], n == 3 ? p[2] : 0);
    return a.point - b.point;
  };
  BezierJet a, b;
  Vector f = at(x, a, b);
  double damping = 0;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const std::array<Vector, 3> j{a.du, -b.du, -b.dv};
    std::array<double, 3> gradient{};
    std::array<bool, 3> held{};
    for (int i = 0; i < n; ++i) {
      gradient[i] = dot(j[i], f);
      held[i] = (x[i] <= cell[i].lo && gradient[i] > 0) || (x[i] >= cell[i].hi && gradient[i] < 0);
    }
    std::array<std::array<double, 3>, 3> m{};
    std::array<double, 3> r{}, step{};
    int free[3], count = 0;
    for (int i = 0; i < n; ++i)
      if (!held[i]) free[count++] = i;
    if (count == 0) break;
    for (int p = 0; p < count; ++p) {
      for (int q = 0; q < count; ++q) m[p][q] = dot(j[free[p]], j[free[q]]);
      m[p][p] = (1 + 1e-14 + damping) * m[p][p] + 1e-300;  // along a contact the pair stays where it is
      r[p] = -gradient[free[p]];
    }
    if (!solve(m, r, count, step)) {
      damping = damping == 0 ? 1e-8 : 10 * damping;
      if (damping > 1e8) break;
      continue;
    }
    std::array<double, 3> next = x;
    double moved = 0;
    for (int p = 0; p < count; ++p) {
      const int i = free[p];
      next[i] = cell[i].clamp(x[i] + step[p]);
      moved = std::max(moved, std::abs(next[i] - x[i]));
    }
    BezierJet next_a, next_b;
    const Vector g = at(next, next_a, next_b);
    if (norm(g) < norm(f)) {
      x = next, a = next_a, b = next_b, f = g;
      damping = damping < 1e-12 ? 0 : 0.1 * damping;
      if (moved < 1e-17) break;
    } else {
      if (moved < 1e-15) break;
      damping = damping == 0 ? 1e-8 : 10 * damping;
      if (damping > 1e8) break;
    }
  }
  return {x, a.point, b.point, norm(f)};
}

PointContacts common_points(const Bezier& curve, const Bezier& other, double tolerance, std::size_t& cells, Known known,
                            const void* context) {
  return Solver(curve, other, tolerance, cells, known, context).run();
}

}  // namespace trimloop::detail
