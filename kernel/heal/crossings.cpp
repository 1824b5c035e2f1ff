#include "kernel/heal/crossings.h"

#include <algorithm>

#include "kernel/heal/run_tree.h"
#include "kernel/mesh/predicates.h"

namespace trimloop::heal {
namespace {

int sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

class Search {
 public:
  // Of one ring with itself, or of several with each other; `tolerance_mm` is of the first.
  Search(const Sheet& sheet, const std::vector<const Ring*>& rings, double tolerance_mm)
      : sheet_(sheet), is_mutual_(rings.size() > 1), tolerance_(tolerance_mm) {
    for (std::uint32_t r = 0; r < rings.size(); ++r) {
      const auto first_chord = static_cast<std::uint32_t>(chords_.size());
      for (const Piece& piece : rings[r]->pieces) {
        const auto p = static_cast<std::uint32_t>(pieces_.size());
        pieces_.push_back(&piece);
        const std::vector<Sample>& s = piece.samples;
        first_.push_back(samples_.size());
        if (!is_mutual_)
          for (const Sample& at : s) samples_.push_back(at.uv);
        if (piece.is_pole || (is_mutual_ && piece.seam >= 0)) continue;
        for (std::uint32_t i = 0; i + 1 < s.size(); ++i)
          if (s[i].uv.u != s[i + 1].uv.u || s[i].uv.v != s[i + 1].uv.v) chords_.push_back({p, i, s[i].uv, s[i + 1].uv});
      }
      runs_.resize(chords_.size(), {first_chord, static_cast<std::uint32_t>(chords_.size())});
      for (std::size_t i = first_chord; i < chords_.size(); ++i) runs_[i].second = static_cast<std::uint32_t>(chords_.size());
    }
  }

  Crossings run() {
    Crossings out;
    if (chords_.size() < 4) return out;
    out.complete = RunTree(chords_).pairs(most_tests(chords_.size()), out.tests, [&](std::size_t i, std::size_t j) {
      if (is_mutual_ ? runs_[i] == runs_[j] : j == i + 1 || (i == 0 && j + 1 == chords_.size())) return true;
      const std::optional<Crossing> c = crossing(i, j);
      if (c && !is_known(out.found, *c) && is_visible(*c)) out.found.push_back(*c);
      return out.found.size() <= most_crossings;
    });
    std::sort(out.found.begin(), out.found.end(), [](const Crossing& x, const Crossing& y) {
      return x.piece[0] != y.piece[0] ? x.piece[0] < y.piece[0] : x.at.u != y.at.u ? x.at.u < y.at.u : x.at.v < y.at.v;
    });
    return out;
  }

 private:
  const Chord& before(std::size_t i) const { return chords_[i == runs_[i].first ? runs_[i].second - 1 : i - 1]; }

  // The strand at chord i crosses the strand at chord j.
  std::optional<Crossing> crossing(std::size_t i, std::size_t j) const {
    const Chord &x = chords_[i], &y = chords_[j];
    const int a = sign(mesh::orient2d(y.a, y.b, x.a)), b = sign(mesh::orient2d(y.a, y.b, x.b));
    const int c = sign(mesh::orient2d(x.a, x.b, y.a)), d = sign(mesh::orient2d(x.a, x.b, y.b));
    if (a * b > 0 || c * d > 0 || (a == 0 && b == 0)) return std::nullopt;
    if (a * b < 0 && c * d < 0) return settled(x, y);
    // A vertex of one lies on the other. Counted where that chord begins; its neighbour tells whether the strand goes through.
    if (b == 0 || d == 0) return std::nullopt;
    const Uv at = a == 0 ? x.a : y.a;
    const Uv x_back = a == 0 ? before(i).a : x.a, y_back = c == 0 ? before(j).a : y.a;
    if (!goes_through(at, x_back, x.b, y_back, y.b)) return std::nullopt;
    return settled(x, y);
  }

  // Round `at`, the two ends of the one strand lie on different sides of the other, none of them along it.
  static bool goes_through(Uv at, Uv x0, Uv x1, Uv y0, Uv y1) {
    return is_left(at, x0, x1, y0) * is_left(at, x0, x1, y1) < 0;
  }
  // 1 when p lies left of the way from x0 over `at` to x1, -1 right of it, 0 on it.
  static int is_left(Uv at, Uv x0, Uv x1, Uv p) {
    const int corner = sign(mesh::orient2d(x0, at, x1));
    const int in = sign(mesh::orient2d(x0, at, p)), out = sign(mesh::orient2d(at, x1, p));
    if (corner > 0) return in > 0 && out > 0 ? 1 : in < 0 || out < 0 ? -1 : 0;
    if (corner < 0) return in < 0 && out < 0 ? -1 : in > 0 || out > 0 ? 1 : 0;
    return in;
  }

  // Newton on the curves themselves, from where the chords cross.
  std::optional<Crossing> settled(const Chord& x, const Chord& y) const {
    const Piece &p = *pieces_[x.piece], &q = *pieces_[y.piece];
    const Sample &p0 = p.samples[x.sample], &p1 = p.samples[x.sample + 1];
    const Sample &q0 = q.samples[y.sample], &q1 = q.samples[y.sample + 1];
    const Uv dx = x.b - x.a, dy = y.b - y.a;
    const double det = cross(dx, dy);
    double f = det != 0 ? cross(y.a - x.a, dy) / det : 0.5, g = det != 0 ? cross(y.a - x.a, dx) / det : 0.5;
    if (!std::isfinite(f) || !std::isfinite(g)) return std::nullopt;
    const double size = norm(dx) + norm(dy);
    const auto t_of = [](const Sample& s, const Sample& e, double share) { return s.t + share * (e.t - s.t); };
    constexpr int most_steps = 20;
    constexpr double slack = 0.25;  // a crossing of the curves may lie in the neighbouring chord
    for (int k = 0; k < most_steps; ++k) {
      const double t = t_of(p0, p1, f), s = t_of(q0, q1, g);
      const Uv miss = uv_of(q, s) - uv_of(p, t);
      if (norm(miss) <= 1e-13 * size || k + 1 == most_steps) {
        if (!(norm(miss) <= 1e-9 * size)) return std::nullopt;
        return in_order(x, y, std::clamp(t, std::min(p.t0, p.t1), std::max(p.t0, p.t1)),
                        std::clamp(s, std::min(q.t0, q.t1), std::max(q.t0, q.t1)));
      }
      const Vector u = jet(p.pcurve.curve, t).d1, v = jet(q.pcurve.curve, s).d1;
      const Uv du{u.x * (p1.t - p0.t), u.y * (p1.t - p0.t)}, dv{v.x * (q1.t - q0.t), v.y * (q1.t - q0.t)};
      const double slope = cross(du, dv);
      if (!(std::abs(slope) > 0)) return std::nullopt;
      f += cross(miss, dv) / slope;
      g += cross(miss, du) / slope;
      if (!(f > -slack && f < 1 + slack && g > -slack && g < 1 + slack)) return std::nullopt;
    }
    return std::nullopt;
  }

  Crossing in_order(const Chord& x, const Chord& y, double t, double s) const {
    Crossing c;
    c.piece[0] = x.piece, c.piece[1] = y.piece;
    c.t[0] = t, c.t[1] = s;
    c.at = uv_of(*pieces_[x.piece], t);
    return c;
  }

  bool is_known(const std::vector<Crossing>& found, const Crossing& c) const {
    return std::any_of(found.begin(), found.end(), [&](const Crossing& o) {
      return o.piece[0] == c.piece[0] && o.piece[1] == c.piece[1] && std::abs(o.t[0] - c.t[0]) <= 1e-12 * span(c.piece[0]) &&
             std::abs(o.t[1] - c.t[1]) <= 1e-12 * span(c.piece[1]);
    });
  }
  double span(std::size_t piece) const { return std::abs(pieces_[piece]->t1 - pieces_[piece]->t0); }

  // Neither part of the ring is as small as the tolerance, and the strands do not merely graze.
  bool is_visible(const Crossing& c) const {
    Point at;
    Vector su, sv;
    sheet_.jet(c.at, at, su, sv);
    const auto along = [&](int k) {
      const Vector d = jet(pieces_[c.piece[k]]->pcurve.curve, c.t[k]).d1;
      return d.x * su + d.y * sv;
    };
    const Vector x = along(0), y = along(1);
    constexpr double least_sine = 1e-3;
    if (!(norm(cross(x, y)) > least_sine * norm(x) * norm(y))) return false;
    return is_mutual_ || leaves(c, at);
  }

  // Between the two passages, and from the second round to the first, the ring is away from `at`.
  bool leaves(const Crossing& c, Point at) const {
    const std::size_t x = passage(c, 0), y = passage(c, 1), n = samples_.size();
    const auto is_away = [&](std::size_t from, std::size_t count) {
      for (std::size_t i = 0; i < count; ++i)
        if (distance(sheet_.point(samples_[(from + i) % n]), at) > tolerance_) return true;
      return false;
    };
    const std::size_t between = x <= y ? y - x : y + n - x;
    return is_away(x, between) && is_away(y, n - between);
  }

  // How many samples of the ring come before it.
  std::size_t passage(const Crossing& c, int k) const {
    const Piece& p = *pieces_[c.piece[k]];
    return first_[c.piece[k]] + static_cast<std::size_t>(std::count_if(p.samples.begin(), p.samples.end(), [&](const Sample& s) {
             return (s.t - p.t0) * (c.t[k] - s.t) >= 0 && s.t != c.t[k];
           }));
  }

  const Sheet& sheet_;
  bool is_mutual_;
  double tolerance_;
  std::vector<const Piece*> pieces_;
  std::vector<Chord> chords_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> runs_;  // of each chord: the chords of its ring
  std::vector<Uv> samples_;         // of all pieces
  std::vector<std::size_t> first_;  // of each piece
};

}  // namespace

Crossings self_crossings(const Sheet& sheet, const Ring& ring, double tolerance_mm) {
  return Search(sheet, {&ring}, tolerance_mm).run();
}

Crossings mutual_crossings(const Sheet& sheet, const std::vector<Ring>& rings) {
  if (rings.size() < 2) return {};
  std::vector<const Ring*> all;
  for (const Ring& ring : rings) all.push_back(&ring);
  return Search(sheet, all, 0).run();
}

}  // namespace trimloop::heal
