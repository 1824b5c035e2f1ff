#include "kernel/mesh/crossings.h"

#include "kernel/mesh/predicates.h"

namespace trimloop::mesh {
namespace {

constexpr int most_halvings = 8;        // in a row: the bow shrinks to a fifteen-thousandth of a chord's
constexpr int most_steps = 500;         // spent on one pair of chords
constexpr double straight = 1e-10;      // of a chord's length: a smaller bow is rounding
constexpr double one_sided = 0.25;      // of the other's bow: a chord that bows less than that is left whole

// A chord, or a part of one, between two parameters of its edge.
struct Piece {
  const Coedge* coedge = nullptr;  // null: a straight join
  double t_a = 0, t_b = 0;
  Uv a, b;                         // in the chart
};

bool same(Uv a, Uv b) { return a.u == b.u && a.v == b.v; }

// Whether y lies on the ray from s through x, given that the three are collinear.
bool same_way(Uv s, Uv x, Uv y) { return (x.u - s.u) * (y.u - s.u) + (x.v - s.v) * (y.v - s.v) > 0; }

bool within_box(Uv p, Uv a, Uv b) {
  return std::min(a.u, b.u) <= p.u && p.u <= std::max(a.u, b.u) && std::min(a.v, b.v) <= p.v && p.v <= std::max(a.v, b.v);
}

// Whether two segments share more than a common end.
bool meet(const Piece& p, const Piece& q) {
  for (const bool turn_p : {false, true}) {
    for (const bool turn_q : {false, true}) {
      const Uv s = turn_p ? p.b : p.a, x = turn_p ? p.a : p.b, y = turn_q ? q.a : q.b;
      if (!same(s, turn_q ? q.b : q.a)) continue;
      return same(x, y) || (orient2d(s, x, y) == 0 && same_way(s, x, y));
    }
  }
  const double qa = orient2d(p.a, p.b, q.a), qb = orient2d(p.a, p.b, q.b);
  const double pa = orient2d(q.a, q.b, p.a), pb = orient2d(q.a, q.b, p.b);
  if (qa == 0 && qb == 0)
    return within_box(q.a, p.a, p.b) || within_box(q.b, p.a, p.b) || within_box(p.a, q.a, q.b) || within_box(p.b, q.a, q.b);
  const auto apart = [](double x, double y) { return (x > 0 && y > 0) || (x < 0 && y < 0); };
  return !apart(qa, qb) && !apart(pa, pb);
}

class Parter {
 public:
  Parter(const Body& body, const FaceBoundary& boundary, std::span<const SampledEdge> edges, const Chart* chart)
      : body_(body), boundary_(boundary), edges_(edges), chart_(chart) {}

  Piece piece(std::uint32_t constraint) const {
    const FaceBoundary::Chord& chord = boundary_.chords[constraint];
    const Segment ends = boundary_.segments[constraint];
    Piece p;
    p.a = place(boundary_.uv[ends.a]), p.b = place(boundary_.uv[ends.b]);
    if (!(p.coedge = chord.coedge)) return p;
    const std::vector<double>& t = edges_[chord.edge.index].samples.t;
    p.t_a = t[chord.index], p.t_b = t[chord.index + 1];
    if (p.coedge->reversed) std::swap(p.t_a, p.t_b);
    return p;
  }

  // Where the curve is half-way, and how far that is from the chord; no bow when there is nothing to halve.
  struct Middle {
    double t = 0, bow = 0;
    Uv at;
  };
  Middle middle(const Piece& p) const {
    Middle m;
    if (!p.coedge) return m;
    m.t = 0.5 * (p.t_a + p.t_b);
    if (!(m.t > std::min(p.t_a, p.t_b)) || !(m.t < std::max(p.t_a, p.t_b))) return m;
    m.at = place(uv_at(body_, *p.coedge, m.t));
    const Uv along = p.b - p.a, off = m.at - p.a;
    const double length = std::hypot(along.u, along.v);
    const double bow = length > 0 ? std::abs(along.u * off.v - along.v * off.u) / length : std::hypot(off.u, off.v);
    if (bow > straight * length) m.bow = bow;
    return m;
  }

  // Adds the cuts that part two chords; false, and nothing, when halving does not.
  bool part(std::uint32_t first, std::uint32_t second, std::vector<EdgeCut>& cuts) {
    const std::size_t before = cuts.size();
    steps_ = 0;
    if (part(piece(first), piece(second), most_halvings, cuts)) return true;
    cuts.resize(before);
    return false;
  }

 private:
  Uv place(Uv uv) const { return chart_ ? chart_->to_chart(uv) : uv; }

  bool part(const Piece& p, const Piece& q, int halvings, std::vector<EdgeCut>& cuts) {
    if (!meet(p, q)) return true;
    if (halvings == 0 || ++steps_ > most_steps) return false;
    const Middle mp = middle(p), mq = middle(q);
    const bool cut_p = mp.bow > 0 && mp.bow >= one_sided * mq.bow, cut_q = mq.bow > 0 && mq.bow >= one_sided * mp.bow;
    if (!cut_p && !cut_q) return false;
    if (cut_p) cuts.push_back({p.coedge->edge, mp.t});
    if (cut_q) cuts.push_back({q.coedge->edge, mq.t});
    const std::array<Piece, 2> ps = halves(p, mp), qs = halves(q, mq);
    for (std::size_t i = 0; i < (cut_p ? 2u : 1u); ++i)
      for (std::size_t j = 0; j < (cut_q ? 2u : 1u); ++j)
        if (!part(cut_p ? ps[i] : p, cut_q ? qs[j] : q, halvings - 1, cuts)) return false;
    return true;
  }

  static std::array<Piece, 2> halves(const Piece& p, const Middle& m) {
    return {Piece{p.coedge, p.t_a, m.t, p.a, m.at}, Piece{p.coedge, m.t, p.t_b, m.at, p.b}};
  }

  const Body& body_;
  const FaceBoundary& boundary_;
  std::span<const SampledEdge> edges_;
  const Chart* chart_;
  int steps_ = 0;
};

// Pairs of constraints that meet at a vertex inside one of them. Where many meet, each with the next: parting these
// leaves the rest for another round.
std::vector<std::pair<std::uint32_t, std::uint32_t>> meeting(const FaceBoundary& boundary, const Triangulation& triangulation) {
  struct At {
    std::uint32_t vertex, constraint;
    bool operator<(const At& o) const { return vertex != o.vertex ? vertex < o.vertex : constraint < o.constraint; }
  };
  std::vector<At> through, ending;
  for (const Triangulation::Crossing& c : triangulation.crossings()) through.push_back({c.vertex, c.constraint});
  std::sort(through.begin(), through.end());
  for (std::uint32_t i = 0; i < boundary.segments.size(); ++i)
    for (const std::uint32_t end : {boundary.segments[i].a, boundary.segments[i].b})
      ending.push_back({triangulation.vertex_of(end), i});
  std::sort(ending.begin(), ending.end());
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  const auto add = [&](std::uint32_t a, std::uint32_t b) {
    if (a != b) pairs.push_back({std::min(a, b), std::max(a, b)});
  };
  for (std::size_t i = 0; i < through.size(); ++i) {
    if (i > 0 && through[i].vertex == through[i - 1].vertex) add(through[i - 1].constraint, through[i].constraint);
    const auto first = std::lower_bound(ending.begin(), ending.end(), At{through[i].vertex, 0});
    if (first != ending.end() && first->vertex == through[i].vertex) add(first->constraint, through[i].constraint);
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

std::vector<EdgeCut> part_crossings(const Body& body, const FaceBoundary& boundary, std::span<const SampledEdge> edges,
                                    const Triangulation& triangulation, const Chart* chart) {
  std::vector<EdgeCut> cuts;
  if (triangulation.crossings().empty()) return cuts;
  Parter parter(body, boundary, edges, chart);
  for (const auto& [a, b] : meeting(boundary, triangulation)) parter.part(a, b, cuts);
  return cuts;
}

std::vector<EdgeCut> halve_bowed(const Body& body, const FaceBoundary& boundary, std::span<const SampledEdge> edges,
                                 const Chart* chart) {
  std::vector<EdgeCut> cuts;
  const Parter parter(body, boundary, edges, chart);
  for (std::uint32_t i = 0; i < boundary.chords.size(); ++i) {
    const Parter::Middle m = parter.middle(parter.piece(i));
    if (m.bow > 0) cuts.push_back({boundary.chords[i].edge, m.t});
  }
  return cuts;
}

}  // namespace trimloop::mesh
