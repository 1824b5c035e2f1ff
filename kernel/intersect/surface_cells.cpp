#include "kernel/intersect/surface_cells.h"

#include "kernel/intersect/points.h"

namespace trimloop::detail {
namespace {

constexpr double inflation = 1.0 / 16;

// Rows that make the columns `c` of a 3 x n matrix the identity; false when they are singular.
template <std::size_t N>
using Square = std::array<std::array<double, N>, N>;
template <std::size_t N>
bool inverse(Square<N> m, Square<N>& out) {
  out = {};
  for (std::size_t i = 0; i < N; ++i) out[i][i] = 1;
  for (std::size_t k = 0; k < N; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < N; ++i)
      if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
    if (m[pivot][k] == 0 || !std::isfinite(m[pivot][k])) return false;
    std::swap(m[k], m[pivot]);
    std::swap(out[k], out[pivot]);
    const double f = 1 / m[k][k];
    for (std::size_t c = 0; c < N; ++c) m[k][c] *= f, out[k][c] *= f;
    for (std::size_t i = 0; i < N; ++i) {
      if (i == k) continue;
      const double g = m[i][k];
      for (std::size_t c = 0; c < N; ++c) m[i][c] -= g * m[k][c], out[i][c] -= g * out[k][c];
    }
  }
  for (const auto& row : out)
    for (const double x : row)
      if (!std::isfinite(x)) return false;
  return true;
}

class Solver {
 public:
  Solver(const Bezier& a, const Bezier& b, double tolerance, std::size_t& cells)
      : a_(a), b_(b), tolerance_(tolerance), slack_(tolerance + blur(a) + blur(b)), cells_(cells) {
    const Box box_a = hull(a, a.net), box_b = hull(b, b.net);
    size_ = std::max(box_a.diagonal(), box_b.diagonal());
    contact_ = std::sqrt(slack_ * size_);
    floor_ = std::max(64 * slack_, 0.1 * contact_);
  }

  SurfaceCells run() {
    stack_.push_back({Interval{0, 1}, Interval{0, 1}, Interval{0, 1}, Interval{0, 1}});
    while (!stack_.empty()) {
      const Cell4 cell = stack_.back();
      stack_.pop_back();
      if (cells_ == 0) {
        out_.undecided.push_back(cell);
        continue;
      }
      --cells_;
      examine(cell);
    }
    // What is left beside a touch or a branch point belongs to it: nearer than that the surfaces cannot be told apart.
    std::erase_if(out_.undecided, [this](const Cell4& c) {
      const Point p = evaluate(a_, c[0].mid(), c[1].mid());
      return std::any_of(out_.touches.begin(), out_.touches.end(),
                         [&](const SurfaceTouch& t) { return distance(p, t.point) <= 8 * contact_; });
    });
    return std::move(out_);
  }

 private:
  struct View {
    Cell4 box;
    Parameters centre;
    Enclosure a, b;
    std::array<RangeVector, 4> columns;  // of the derivative of a - b, across the box
    Vector normal_a, normal_b;           // at about the middle
  };

  View look_at(const Cell4& box) {
    View v;
    v.box = box;
    for (int i = 0; i < 4; ++i) v.centre[i] = box[i].mid();
    restrict_to(a_, box[0], box[1], net_a_);
    restrict_to(b_, box[2], box[3], net_b_);
    v.a = enclose_points(a_, net_a_);
    v.b = enclose_points(b_, net_b_);
    return v;
  }
  void complete(View& v, bool second) const {
    enclose_derivatives(a_, net_a_, second, v.a);
    enclose_derivatives(b_, net_b_, second, v.b);
    v.columns = {v.a.du, v.a.dv, -v.b.du, -v.b.dv};
    v.normal_a = cross(v.a.du.mid(), v.a.dv.mid());
    v.normal_b = cross(v.b.du.mid(), v.b.dv.mid());
  }
  View look_at(const Cell4& box, bool second) {
    View v = look_at(box);
    complete(v, second);
    return v;
  }

  void examine(const Cell4& cell) {
    Cell4 wider;
    for (int i = 0; i < 4; ++i) {
      const double by = inflation * cell[i].length();
      wider[i] = {cell[i].lo - by, cell[i].hi + by};
    }
    View view = look_at(wider);
    if (!view.a.valid || !view.b.valid) return split(cell, view);
    if (boxes_apart(view)) return;
    complete(view, false);
    if (separated(view)) return;
    Cell4 smaller = cell;
    switch (regular(cell, view, smaller)) {
      case Verdict::Settled:
      case Verdict::Empty:
        return;
      case Verdict::Smaller:
        stack_.push_back(smaller);
        return;
      case Verdict::Unknown:
        break;
    }
    if (normals_may_be_parallel(view)) {
      const View more = look_at(wider, true);
      if (parallel_normals(cell, more) || ridge(cell, more)) return;
    }
    if (extent_of(view) < floor_) {
      if (!meets_at_pole(cell)) out_.undecided.push_back(cell);
    } else {
      split(cell, view);
    }
  }

  // ---- Separation

  bool apart_along(Vector direction) const {
    const double size = norm(direction);
    if (!(size > 0)) return false;
    direction = direction / size;
    const Range a = extent(a_, net_a_, direction), b = extent(b_, net_b_, direction);
    return a.lo - b.hi > tolerance_ || b.lo - a.hi > tolerance_;
  }
  bool boxes_apart(const View& v) const {
    const RangeVector d = points(v.a) - points(v.b);
    const auto apart = [this](Range r) { return r.lo > tolerance_ || r.hi < -tolerance_; };
    return apart(d.x) || apart(d.y) || apart(d.z);
  }
  bool separated(const View& v) const {
    const Vector along = cross(v.normal_a, v.normal_b);
    for (const Vector& direction : {v.normal_a, v.normal_b, cross(along, v.normal_a), cross(along, v.normal_b), along,
                                    v.a.du.mid(), v.a.dv.mid()})
      if (apart_along(direction)) return true;
    return false;
  }

  double extent_of(const View& v) const {
    double most = 0;
    for (const RangeVector& c : v.columns) most = std::max(most, norm(c.mid()));
    return most;
  }

  // ---- Arcs

  enum class Verdict { Settled, Empty, Smaller, Unknown };

  // Three equations in four unknowns over a box; values with their allowances at its centre.
  struct System {
    std::array<Range, 3> value;
    std::array<std::array<Range, 4>, 3> slope;  // across the box
  };
  System plain(const View& v) const {
    const Vector f = evaluate(a_, v.centre[0], v.centre[1]) - evaluate(b_, v.centre[2], v.centre[3]);
    System s;
    s.value = {around(f.x, slack_), around(f.y, slack_), around(f.z, slack_)};
    for (std::size_t c = 0; c < 4; ++c)
      s.slope[0][c] = v.columns[c].x, s.slope[1][c] = v.columns[c].y, s.slope[2][c] = v.columns[c].z;
    return s;
  }

  // The operator for the unknowns other than k. `image`: where solutions of the box are, in units of the box about its
  // centre. Returns whether the map is a contraction.
  static bool krawczyk(const System& s, int k, std::array<Range, 4>& image) {
    std::array<std::size_t, 3> c{};
    std::size_t n = 0;
    for (std::size_t i = 0; i < 4; ++i)
      if (static_cast<int>(i) != k) c[n++] = i;
    Square<3> m{}, y{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) m[i][j] = s.slope[i][c[j]].mid();
    image = {Range{-0.5, 0.5}, Range{-0.5, 0.5}, Range{-0.5, 0.5}, Range{-0.5, 0.5}};
    if (!inverse(m, y)) {
      for (const std::size_t i : c) image[i] = {-infinity, infinity};
      return false;
    }
    bool contracting = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto row = [&](const Range& p, const Range& q, const Range& r) {
        return y[i][0] * p + y[i][1] * q + y[i][2] * r;
      };
      Range value = -row(s.value[0], s.value[1], s.value[2]);
      const std::size_t free = static_cast<std::size_t>(k);
      value = value - row(s.slope[0][free], s.slope[1][free], s.slope[2][free]) * Range{-0.5, 0.5};
      double sum = 0;
      for (std::size_t j = 0; j < 3; ++j) {
        const double off =
            (Range(i == j ? 1.0 : 0.0) - row(s.slope[0][c[j]], s.slope[1][c[j]], s.slope[2][c[j]])).magnitude();
        sum += off;
        value = value + Range{-0.5 * off, 0.5 * off};
      }
      contracting = contracting && sum < 1;
      image[c[i]] = value;
    }
    return contracting;
  }

  // The parameter along which the solutions of the linear system run most, in units of the box.
  static int best_parameter(const System& s) {
    std::array<double, 4> minor{};
    for (std::size_t k = 0; k < 4; ++k) {
      std::array<std::size_t, 3> c{};
      std::size_t n = 0;
      for (std::size_t i = 0; i < 4; ++i)
        if (i != k) c[n++] = i;
      const auto m = [&](std::size_t i, std::size_t j) { return s.slope[i][c[j]].mid(); };
      minor[k] = std::abs(m(0, 0) * (m(1, 1) * m(2, 2) - m(1, 2) * m(2, 1)) -
                          m(0, 1) * (m(1, 0) * m(2, 2) - m(1, 2) * m(2, 0)) +
                          m(0, 2) * (m(1, 0) * m(2, 1) - m(1, 1) * m(2, 0)));
    }
    return static_cast<int>(std::max_element(minor.begin(), minor.end()) - minor.begin());
  }

  template <class Build>
  Verdict arcs_of(const Cell4& cell, const View& view, const ArcSystem& kind, Build build, Cell4& smaller) {
    const System s = build(view);
    const int k = best_parameter(s);
    std::array<Range, 4> image;
    const bool contracting = krawczyk(s, k, image);
    double share = 1;
    for (int i = 0; i < 4; ++i) {
      const double w = view.box[i].length();
      smaller[i] = {std::max(cell[i].lo, view.centre[i] + w * image[i].lo),
                    std::min(cell[i].hi, view.centre[i] + w * image[i].hi)};
      if (!(smaller[i].lo <= smaller[i].hi)) return Verdict::Empty;
      share *= smaller[i].length() / std::max(cell[i].length(), 1e-300);
    }
    if (contracting && widen_to_arc(view, kind, build, k, image)) return Verdict::Settled;
    return share < 0.7 ? Verdict::Smaller : Verdict::Unknown;
  }

  // A box about the cell that the operator maps into itself over the whole range of parameter k.
  template <class Build>
  bool widen_to_arc(const View& view, const ArcSystem& kind, Build build, int k, const std::array<Range, 4>& image) {
    Cell4 box = view.box;
    for (int i = 0; i < 4; ++i) {
      if (i == k) continue;
      const double w = box[i].length(), by = 0.1 * w * std::max(1.0, image[i].width());
      box[i] = {std::min(box[i].lo, view.centre[i] + w * image[i].lo - by),
                std::max(box[i].hi, view.centre[i] + w * image[i].hi + by)};
      if (!(box[i].length() < 1e3 * w)) return false;
    }
    for (int attempt = 0; attempt < 2; ++attempt) {
      const View v = look_at(box, kind.ridge);
      if (!v.a.valid || !v.b.valid) return false;
      std::array<Range, 4> inner;
      const bool contracting = krawczyk(build(v), k, inner);
      if (!contracting) return false;
      bool inside = true;
      for (int i = 0; i < 4; ++i)
        if (i != k) inside = inside && inner[i].lo > -0.5 && inner[i].hi < 0.5;
      if (inside) return add_arc(box, k, kind);
      for (int i = 0; i < 4; ++i) {
        if (i == k) continue;
        const double w = v.box[i].length(), by = 0.1 * w;
        box[i] = {std::min(box[i].lo, v.centre[i] + w * inner[i].lo - by),
                  std::max(box[i].hi, v.centre[i] + w * inner[i].hi + by)};
      }
    }
    return false;
  }
  bool add_arc(const Cell4& box, int k, const ArcSystem& kind) {
    SurfaceArc arc{box, k, box[k], {}, kind};
    for (int i = 0; i < 4; ++i) arc.middle[i] = box[i].mid();
    if (!solve_on_arc(a_, b_, kind, k, arc.middle)) return false;
    // A collapsed side on the other surface is an arc in the parameters, a point in space.
    Box box_in_space;
    for (const double f : {0.0, 0.5, 1.0}) {
      Parameters x = arc.middle;
      x[k] = arc.range.at(f);
      if (f != 0.5 && !solve_on_arc(a_, b_, kind, k, x)) return false;
      box_in_space.add(evaluate(a_, x[0], x[1]));
    }
    if (box_in_space.diagonal() <= 16 * slack_) {
      const Point p = box_in_space.lo;
      out_.touches.push_back({arc.middle, p, 0, true, true, box});
      return true;
    }
    out_.arcs.push_back(arc);
    return true;
  }

  Verdict regular(const Cell4& cell, const View& view, Cell4& smaller) {
    return arcs_of(
        cell, view, {}, [this](const View& v) { return plain(v); }, smaller);
  }

  // ---- Parallel normals

  static bool normals_may_be_parallel(const View& v) {
    const RangeVector n = cross(cross(v.a.du, v.a.dv), cross(v.b.du, v.b.dv));
    return !n.x.excludes_zero() && !n.y.excludes_zero() && !n.z.excludes_zero();
  }

  struct Tangency {
    Vector e1, e2, e3;            // e3 the common normal, e1 the direction in which the gap bends most
    double bend1 = 0, bend2 = 0;  // second derivatives of the gap along e1 and e2, 1/mm
  };
  // About the middle of the view.
  bool tangency(const BezierJet& p, const BezierJet& q, Tangency& t) const {
    const Vector n = cross(p.du, p.dv), m = cross(q.du, q.dv);
    t.e3 = normalized(n);
    if (!(norm(t.e3) > 0) || !(norm(m) > 0)) return false;
    Vector x = normalized(p.du), y = cross(t.e3, x);
    // Second fundamental forms in the frame x, y: h = e3 . S_ij with the parameters changed to lengths.
    const auto form = [&](const BezierJet& j, double& xx, double& xy, double& yy) {
      const double a = dot(j.du, x), b = dot(j.dv, x), c = dot(j.du, y), d = dot(j.dv, y), det = a * d - b * c;
      if (det == 0) return false;
      // du/dx, dv/dx, du/dy, dv/dy
      const double ux = d / det, vx = -c / det, uy = -b / det, vy = a / det;
      const double l = dot(j.duu, t.e3), mm = dot(j.duv, t.e3), nn = dot(j.dvv, t.e3);
      xx = l * ux * ux + 2 * mm * ux * vx + nn * vx * vx;
      xy = l * ux * uy + mm * (ux * vy + uy * vx) + nn * vx * vy;
      yy = l * uy * uy + 2 * mm * uy * vy + nn * vy * vy;
      return true;
    };
    double pxx, pxy, pyy, qxx, qxy, qyy;
    if (!form(p, pxx, pxy, pyy) || !form(q, qxx, qxy, qyy)) return false;
    const double xx = pxx - qxx, xy = pxy - qxy, yy = pyy - qyy;
    const double angle = 0.5 * std::atan2(2 * xy, xx - yy), c = std::cos(angle), s = std::sin(angle);
    const double one = xx * c * c + 2 * xy * c * s + yy * s * s, two = xx * s * s - 2 * xy * c * s + yy * c * c;
    const Vector along = c * x + s * y, across = c * y - s * x;
    const bool first = std::abs(one) >= std::abs(two);
    t.e1 = first ? along : across;
    t.e2 = first ? across : along;
    t.bend1 = first ? one : two;
    t.bend2 = first ? two : one;
    return std::isfinite(one) && std::isfinite(two);
  }

  struct NormalSlopes {
    RangeVector product;                // n x m over the box
    std::array<RangeVector, 4> slopes;  // of it, across the box
  };
  static NormalSlopes normal_slopes(const View& v) {
    const Enclosure &p = v.a, &q = v.b;
    const RangeVector n = cross(p.du, p.dv), m = cross(q.du, q.dv);
    const RangeVector nu = cross(p.duu, p.dv) + cross(p.du, p.duv), nv = cross(p.duv, p.dv) + cross(p.du, p.dvv);
    const RangeVector ms = cross(q.duu, q.dv) + cross(q.du, q.duv), mt = cross(q.duv, q.dv) + cross(q.du, q.dvv);
    return {cross(n, m), {cross(nu, m), cross(nv, m), cross(n, ms), cross(n, mt)}};
  }
  // n x m at the centre by the unit parameters of the view, with an allowance for its rounding.
  Vector centre_product(const View& v, const BezierJet& p, const BezierJet& q, double& allowance) const {
    const double wu = v.box[0].length(), wv = v.box[1].length(), ws = v.box[2].length(), wt = v.box[3].length();
    const Vector au = wu * p.du, av = wv * p.dv, bu = ws * q.du, bv = wt * q.dv;
    const Vector n = cross(au, av), m = cross(bu, bv);
    const double noise_a = 4 * a_.degree_u * blur(a_) * (norm(au) + norm(av)) * 2,
                 noise_b = 4 * b_.degree_u * blur(b_) * (norm(bu) + norm(bv)) * 2;
    // Derivatives of the unit patch are known to about its noise times degree; the box scales them down.
    const double scale_a = std::max(wu, wv), scale_b = std::max(ws, wt);
    allowance = noise_a * scale_a * norm(m) + noise_b * scale_b * norm(n) + 1e-15 * norm(n) * norm(m);
    return cross(n, m);
  }

  // Four equations: the points agree in the tangent plane and the normals are parallel.
  bool parallel_normals(const Cell4& cell, const View& v) {
    const BezierJet p = jet(a_, v.centre[0], v.centre[1]), q = jet(b_, v.centre[2], v.centre[3]);
    Tangency t;
    if (!tangency(p, q, t)) return false;
    const Vector f = p.point - q.point;
    const NormalSlopes slopes = normal_slopes(v);
    double allowance = 0;
    const Vector product = centre_product(v, p, q, allowance);
    const std::array<Range, 4> value{around(dot(f, t.e1), slack_), around(dot(f, t.e2), slack_),
                                     around(dot(product, t.e1), allowance), around(dot(product, t.e2), allowance)};
    std::array<std::array<Range, 4>, 4> slope;
    for (std::size_t c = 0; c < 4; ++c) {
      slope[0][c] = dot(t.e1, v.columns[c]), slope[1][c] = dot(t.e2, v.columns[c]);
      slope[2][c] = dot(t.e1, slopes.slopes[c]), slope[3][c] = dot(t.e2, slopes.slopes[c]);
    }
    Square<4> m{}, y{};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) m[i][j] = slope[i][j].mid();
    if (!inverse(m, y)) return false;
    bool contracting = true, inside = true;
    Parameters root{};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto row = [&](std::size_t j) {
        return y[i][0] * slope[0][j] + y[i][1] * slope[1][j] + y[i][2] * slope[2][j] + y[i][3] * slope[3][j];
      };
      Range image = -(y[i][0] * value[0] + y[i][1] * value[1] + y[i][2] * value[2] + y[i][3] * value[3]);
      double sum = 0;
      for (std::size_t j = 0; j < 4; ++j) {
        const double off = (Range(i == j ? 1.0 : 0.0) - row(j)).magnitude();
        sum += off;
        image = image + Range{-0.5 * off, 0.5 * off};
      }
      contracting = contracting && sum < 1;
      inside = inside && image.lo > -0.5 && image.hi < 0.5;
      root[i] = v.centre[i] + v.box[i].length() * image.mid();
    }
    if (!contracting || !inside) return false;
    return judge(cell, v, root);
  }

  // The one place of the box where normals are parallel: what it means for the cell.
  bool judge(const Cell4& cell, const View& v, Parameters root) {
    Tangency t;
    BezierJet p, q;
    for (int iteration = 0; iteration < 8; ++iteration) {
      p = jet(a_, root[0], root[1]), q = jet(b_, root[2], root[3]);
      if (!tangency(p, q, t) || !polish(p, q, t, root)) return false;
    }
    p = jet(a_, root[0], root[1]), q = jet(b_, root[2], root[3]);
    if (!tangency(p, q, t)) return false;
    for (int i = 0; i < 4; ++i)
      if (!(v.box[i].lo <= root[i] && root[i] <= v.box[i].hi)) return false;
    const double gap = dot(p.point - q.point, t.e3);
    const bool bowl = t.bend1 * t.bend2 > 0;
    if (bowl && std::abs(gap) <= slack_) {
      add_touch(cell, root, p, q, false);
      return true;
    }
    if (bowl && gap * t.bend1 > 0) return true;  // the gap is smallest there and too large
    if (!bowl && std::abs(gap) <= slack_ && extent_of(v) < 16 * contact_) {
      add_touch(cell, root, p, q, true);
      return true;
    }
    return false;
  }

  // One Newton step of the four equations.
  bool polish(const BezierJet& p, const BezierJet& q, const Tangency& t, Parameters& x) const {
    const Vector f = p.point - q.point;
    const Vector n = cross(p.du, p.dv), m = cross(q.du, q.dv);
    const Vector nu = cross(p.duu, p.dv) + cross(p.du, p.duv), nv = cross(p.duv, p.dv) + cross(p.du, p.dvv);
    const Vector ms = cross(q.duu, q.dv) + cross(q.du, q.duv), mt = cross(q.duv, q.dv) + cross(q.du, q.dvv);
    const std::array<Vector, 4> j{p.du, p.dv, -q.du, -q.dv}, k{cross(nu, m), cross(nv, m), cross(n, ms), cross(n, mt)};
    Square<4> matrix{}, y{};
    for (std::size_t c = 0; c < 4; ++c)
      matrix[0][c] = dot(j[c], t.e1), matrix[1][c] = dot(j[c], t.e2), matrix[2][c] = dot(k[c], t.e1),
      matrix[3][c] = dot(k[c], t.e2);
    if (!inverse(matrix, y)) return false;
    const Vector w = cross(n, m);
    const std::array<double, 4> r{dot(f, t.e1), dot(f, t.e2), dot(w, t.e1), dot(w, t.e2)};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t c = 0; c < 4; ++c) x[i] -= y[i][c] * r[c];
    return std::isfinite(x[0] + x[1] + x[2] + x[3]);
  }

  void add_touch(const Cell4& cell, Parameters at, const BezierJet& p, const BezierJet& q, bool branching) {
    // A touch beside the patches (the box is wider than they are) belongs to others, or to nothing.
    for (int i = 0; i < 4; ++i) {
      const double speed = norm(i == 0 ? p.du : i == 1 ? p.dv : i == 2 ? q.du : q.dv);
      const double by = speed > 0 ? contact_ / speed : 0;
      if (at[i] < -by || at[i] > 1 + by) return;
      at[i] = std::clamp(at[i], 0.0, 1.0);
    }
    const Point one = evaluate(a_, at[0], at[1]), two = evaluate(b_, at[2], at[3]);
    out_.touches.push_back({at, midpoint(one, two), distance(one, two), branching, false, cell});
  }

  // ---- Ridges

  bool ridge(const Cell4& cell, const View& v) {
    if (extent_of(v) < 8 * contact_) return false;  // nothing comes apart over so short a way
    const BezierJet p = jet(a_, v.centre[0], v.centre[1]), q = jet(b_, v.centre[2], v.centre[3]);
    Tangency t;
    if (!tangency(p, q, t)) return false;
    const ArcSystem kind{true, t.e1, t.e2};
    const auto build = [this, t](const View& w) {
      const BezierJet pw = jet(a_, w.centre[0], w.centre[1]), qw = jet(b_, w.centre[2], w.centre[3]);
      const Vector f = pw.point - qw.point;
      double allowance = 0;
      const Vector product = centre_product(w, pw, qw, allowance);
      const NormalSlopes slopes = normal_slopes(w);
      System s;
      s.value = {around(dot(f, t.e1), slack_), around(dot(f, t.e2), slack_), around(dot(product, t.e2), allowance)};
      for (std::size_t c = 0; c < 4; ++c) {
        s.slope[0][c] = dot(t.e1, w.columns[c]);
        s.slope[1][c] = dot(t.e2, w.columns[c]);
        s.slope[2][c] = dot(t.e2, slopes.slopes[c]);
      }
      return s;
    };
    const std::size_t before = out_.arcs.size();
    Cell4 smaller = cell;
    if (arcs_of(cell, v, kind, build, smaller) != Verdict::Settled) return false;
    // A tangential arc if there is no gap along all of it; otherwise the cell is of another kind.
    const SurfaceArc arc = out_.arcs[before];
    bool touching = true;
    for (int i = 0; i <= 8 && touching; ++i) {
      Parameters x = arc.middle;
      x[arc.k] = arc.range.at(i / 8.0);
      touching = solve_on_arc(a_, b_, kind, arc.k, x) &&
                 distance(evaluate(a_, x[0], x[1]), evaluate(b_, x[2], x[3])) <= 4 * slack_;
    }
    if (!touching) out_.arcs.resize(before);
    return touching;
  }

  // ---- The rest

  // A collapsed side: the cell is a point in space, though not in the parameters. Arcs may end there.
  bool meets_at_pole(const Cell4& cell) {
    bool wide = false;
    for (const Interval& i : cell) wide = wide || i.length() > 1e-2;
    if (!wide) return false;
    Parameters x{};
    for (int i = 0; i < 4; ++i) {
      x[i] = cell[i].mid();
      if (cell[i].length() <= 1e-2 && cell[i].contains(0)) x[i] = 0;
      if (cell[i].length() <= 1e-2 && cell[i].contains(1)) x[i] = 1;
    }
    const Point p = evaluate(a_, x[0], x[1]), q = evaluate(b_, x[2], x[3]);
    if (distance(p, q) > 4 * floor_) return false;
    out_.touches.push_back({x, p, distance(p, q), true, true, cell});
    return true;
  }

  void split(const Cell4& cell, const View& view) {
    int widest = 0;
    double most = -1;
    for (int i = 0; i < 4; ++i) {
      const double size = cell[i].length() < 1e-13 ? -1
                          : view.a.valid && view.b.valid
                              ? std::max(norm(view.columns[i].mid()), 1e-6 * size_ * cell[i].length())
                              : cell[i].length();
      if (size > most) most = size, widest = i;
    }
    if (most < 0) {
      out_.undecided.push_back(cell);
      return;
    }
    Cell4 one = cell, two = cell;
    one[widest].hi = two[widest].lo = cell[widest].at(0.5 - 0.0137);
    stack_.push_back(two);
    stack_.push_back(one);
  }

  const Bezier &a_, &b_;
  const double tolerance_, slack_;
  double size_ = 1;
  double contact_ = 0;  // about how far from a tangency surfaces of that size come apart by the tolerance
  double floor_ = 0;    // smallest cell
  std::size_t& cells_;
  std::vector<Cell4> stack_;
  std::vector<Hpoint> net_a_, net_b_;
  SurfaceCells out_;
};

}  // namespace

SurfaceCells common_arcs(const Bezier& a, const Bezier& b, double tolerance, std::size_t& cells) {
  return Solver(a, b, tolerance, cells).run();
}

}  // namespace trimloop::detail
