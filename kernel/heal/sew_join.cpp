// Border edges with the same ends are compared along their whole length and joined in pairs.

#include <algorithm>

#include "kernel/heal/match.h"
#include "kernel/heal/sew_detail.h"

namespace trimloop::heal {
namespace {

struct Pair {
  std::size_t a, b;  // tracks, a < b
  double gap_mm;
};

class Joiner {
 public:
  explicit Joiner(Sewing& s) : s_(s), joined_(s.tracks.size(), false), parts_(s.body.faces.size()), sheets_(s.body.faces.size()) {}

  void run() {
    find_pairs();
    // Where exactly two edges meet there is nothing to choose.
    for (const std::vector<Pair>& group : groups_) {
      if (s_.stop.stop_requested()) return;
      if (group.size() == 1) join(group[0]);
    }
    std::erase_if(groups_, [](const std::vector<Pair>& g) { return g.size() == 1; });
    choose();
  }

 private:
  std::pair<std::uint32_t, std::uint32_t> ends(const Track& t) {
    const std::uint32_t a = s_.vertices.find(s_.body[t.edge].start.index), b = s_.vertices.find(s_.body[t.edge].end.index);
    return {std::min(a, b), std::max(a, b)};
  }

  // Groups of pairs that have an edge in common.
  void find_pairs() {
    const std::size_t n = s_.tracks.size();
    std::vector<std::pair<std::uint32_t, std::uint32_t>> keys(n);
    std::vector<std::size_t> order(n);
    for (std::size_t i = 0; i < n; ++i) keys[i] = ends(s_.tracks[i]), order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
    constexpr std::size_t most_neighbours = 64;  // of one edge with the same ends
    for (std::size_t first = 0; first < n;) {
      std::size_t last = first + 1;
      while (last < n && keys[order[last]] == keys[order[first]]) ++last;
      std::vector<Pair> pairs;
      Sets sets(last - first);
      if (s_.stop.stop_requested()) return;
      for (std::size_t i = first; i < last; ++i)
        for (std::size_t j = i + 1; j < std::min(last, i + most_neighbours); ++j) {
          const std::size_t a = std::min(order[i], order[j]), b = std::max(order[i], order[j]);
          if (!may_join(a, b)) continue;
          const double gap = separation(s_.body, s_.tracks[a], s_.tracks[b], s_.tolerance_mm);
          if (!(gap <= s_.tolerance_mm)) continue;
          pairs.push_back({a, b, gap});
          sets.unite(static_cast<std::uint32_t>(i - first), static_cast<std::uint32_t>(j - first));
        }
      add_groups(pairs, sets, order, first, last);
      first = last;
    }
  }

  void add_groups(const std::vector<Pair>& pairs, Sets& sets, const std::vector<std::size_t>& order, std::size_t first,
                  std::size_t last) {
    if (pairs.empty()) return;
    std::vector<std::uint32_t> set_of(s_.tracks.size() ? last - first : 0);
    std::unordered_map<std::size_t, std::uint32_t> by_track;
    for (std::size_t i = first; i < last; ++i) by_track[order[i]] = sets.find(static_cast<std::uint32_t>(i - first));
    std::unordered_map<std::uint32_t, std::size_t> group_of;
    for (const Pair& p : pairs) {
      const auto [at, fresh] = group_of.try_emplace(by_track[p.a], groups_.size());
      if (fresh) groups_.emplace_back();
      groups_[at->second].push_back(p);
    }
  }

  // The two sides of one face may be a seam; then they run against each other.
  bool may_join(std::size_t a, std::size_t b) const {
    const Track &x = s_.tracks[a], &y = s_.tracks[b];
    if (x.face != y.face) return true;
    const auto along = [&](const Track& t) {
      const Place& p = s_.uses[t.edge.index][0];
      return !s_.body[p.loop].coedges[p.coedge].reversed;
    };
    const auto there = [&](double f) {
      return foot(s_.body, y, evaluate(*s_.body[x.edge].curve, s_.body[x.edge].range.at(f))).t;
    };
    const bool same_way = there(0.3) < there(0.7);
    return (along(x) == along(y)) != same_way;
  }

  std::uint32_t part(std::size_t track) { return parts_.find(s_.tracks[track].face.index); }

  // Places where more than two edges meet: bodies that touch. Faces that hang together already are joined first, so that
  // each body gets its own.
  void choose() {
    s_.report.non_manifold += groups_.size();
    for (std::vector<Pair>& group : groups_)
      std::stable_sort(group.begin(), group.end(), [](const Pair& p, const Pair& q) { return p.gap_mm < q.gap_mm; });
    const auto take = [&](std::vector<Pair>& group, bool any) {
      for (const Pair& p : group) {
        if (joined_[p.a] || joined_[p.b] || (!any && part(p.a) != part(p.b))) continue;
        join(p);
        return true;
      }
      return false;
    };
    bool progress = true;
    while (progress && !s_.stop.stop_requested()) {
      progress = false;
      for (std::vector<Pair>& group : groups_)
        while (take(group, false)) progress = true;
      for (std::vector<Pair>& group : groups_) {
        if (progress) break;
        progress = take(group, true);
      }
      std::erase_if(groups_, [&](const std::vector<Pair>& g) {
        return std::all_of(g.begin(), g.end(), [&](const Pair& p) { return joined_[p.a] || joined_[p.b]; });
      });
    }
  }

  const Sheet& sheet(FaceId face) {
    auto& at = sheets_[face.index];
    if (!at) at = std::make_unique<Sheet>(*s_.body[face].surface, s_.tolerance_mm);
    return *at;
  }

  // The second edge's face takes the first edge.
  void join(const Pair& pair) {
    const Track &keep = s_.tracks[pair.a], &drop = s_.tracks[pair.b];
    joined_[pair.a] = joined_[pair.b] = true;
    Coedge& c = s_.coedge(s_.uses[drop.edge.index][0]);
    Edge& edge = s_.body[keep.edge];
    Piece p;
    p.pcurve = c.pcurve;
    p.t0 = c.pcurve_range.lo;
    p.t1 = c.pcurve_range.hi;
    p.curve = edge.curve;
    p.c0 = edge.range.lo;
    p.c1 = edge.range.hi;
    if (!take_samples(p)) return;
    Match m = match(sheet(drop.face), p, 0.1 * s_.tolerance_mm);
    const double allowed = s_.tolerance_mm + c.gap_mm + m.allowed_mm;
    if (!(m.off_mm <= allowed)) return;
    const Edge& other = s_.body[drop.edge];
    if (s_.vertices.find(edge.start.index) != s_.vertices.find((m.against ? other.end : other.start).index)) return;
    c.edge = keep.edge;
    c.reversed = c.reversed != m.against;
    c.pcurve_range = m.against ? Interval{p.t1, p.t0} : Interval{p.t0, p.t1};
    c.map = std::move(m.map);
    c.gap_mm = m.gap_mm;
    edge.source.insert(edge.source.end(), other.source.begin(), other.source.end());
    parts_.unite(keep.face.index, drop.face.index);
    ++s_.report.joined;
    s_.report.max_gap_mm = std::max(s_.report.max_gap_mm, pair.gap_mm);
  }

  Sewing& s_;
  std::vector<bool> joined_;
  std::vector<std::vector<Pair>> groups_;
  Sets parts_;  // faces that hang together
  std::vector<std::unique_ptr<Sheet>> sheets_;
};

}  // namespace

void join_edges(Sewing& s) {
  Joiner(s).run();
  s.find_uses();
  s.make_tracks();
}

void settle_vertices(Sewing& s) {
  Body& body = s.body;
  // The point of a set is its smallest one, whatever the order they came in.
  const auto smaller = [](Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; };
  std::vector<Point> points(body.vertices.size());
  std::vector<bool> known(body.vertices.size(), false);
  for (std::uint32_t v = 0; v < body.vertices.size(); ++v) {
    const std::uint32_t set = s.vertices.find(v);
    if (!known[set] || smaller(body.vertices[v].point, points[set])) points[set] = body.vertices[v].point;
    known[set] = true;
  }
  for (std::uint32_t v = 0; v < body.vertices.size(); ++v)
    if (s.vertices.find(v) == v) body.vertices[v].point = points[v];
  for (Edge& e : body.edges) {
    e.start = VertexId{s.vertices.find(e.start.index)};
    e.end = VertexId{s.vertices.find(e.end.index)};
  }
  for (std::uint32_t i = 0; i < body.edges.size(); ++i) {
    const Edge& e = body.edges[i];
    if (s.uses[i].empty() || !e.curve) continue;
    const auto widen = [&](VertexId id, Point end) {
      body[id].gap_mm = std::max(body[id].gap_mm, distance(body[id].point, end));
    };
    widen(e.start, evaluate(*e.curve, e.range.lo));
    widen(e.end, evaluate(*e.curve, e.range.hi));
  }
}

}  // namespace trimloop::heal
