#include "kernel/boolean/assemble.h"

#include <numeric>

#include "kernel/heal/make_face.h"

namespace trimloop::boolean {
namespace {

struct Half {
  HalfEdge edge;
  std::size_t piece = 0;  // index of the kept piece
  bool gone = false;
};

class Assembler {
 public:
  Assembler(const Prepared& given, const std::vector<KeptPiece>& kept, Cuts cuts) : given_(given), kept_(kept), cuts_(cuts) {}

  Result<Body> run() {
    collect();
    dissolve();
    move_pieces();
    pair_uses();
    if (auto bad = build_faces()) return tl::unexpected<Error>(*bad);
    build_shells();
    return std::move(body_);
  }

 private:
  const FaceOf& face_of(const KeptPiece& p) const {
    return given_.operands[static_cast<std::size_t>(p.operand)]->faces()[p.face];
  }
  const Segment& segment(const Half& h) const { return given_.network.segments[h.edge.use.segment]; }

  void collect() {
    for (std::size_t p = 0; p < kept_.size(); ++p) {
      const FacePieces& from = given_.faces[static_cast<std::size_t>(kept_[p].operand)][kept_[p].face];
      for (const std::uint32_t first : from.pieces[kept_[p].piece].cycles) {
        const auto base = static_cast<std::uint32_t>(halves_.size());
        std::uint32_t k = first, n = 0;
        do {
          halves_.push_back({from.half_edges[k], p, false});
          k = from.half_edges[k].next;
          ++n;
        } while (k != first);
        for (std::uint32_t i = 0; i < n; ++i) {
          halves_[base + i].edge.next = base + (i + 1) % n;
          halves_[base + i].edge.previous = base + (i + n - 1) % n;
        }
      }
    }
    uses_.resize(given_.network.segments.size());
    for (std::uint32_t i = 0; i < halves_.size(); ++i)
      if (halves_[i].edge.use.segment != none) uses_[halves_[i].edge.use.segment].push_back(i);
  }

  // ---- Pieces of one face with nothing but a segment between them

  std::size_t root(std::size_t p, Uv& by) const {
    by = {};
    while (parent_[p] != p) {
      by = by + offset_[p];
      p = parent_[p];
    }
    return p;
  }

  void dissolve() {
    parent_.resize(kept_.size());
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    offset_.resize(kept_.size());
    for (std::vector<std::uint32_t>& uses : uses_) {
      if (uses.size() != 2) continue;
      const Half &h = halves_[uses[0]], &t = halves_[uses[1]];
      const KeptPiece &p = kept_[h.piece], &q = kept_[t.piece];
      if (p.operand != q.operand || p.face != q.face || h.edge.use.reversed == t.edge.use.reversed) continue;
      const FaceOf& face = face_of(p);
      // t has to move by this to lie on h.
      Uv by = evaluate(h.edge.use.pcurve, h.edge.use.range.lo) - evaluate(t.edge.use.pcurve, t.edge.use.range.lo);
      const auto whole = [](double& x, double period, double size) {
        const double turns = period > 0 ? std::round(x / period) : 0, left = x - turns * period;
        x = turns * period;
        return std::abs(left) <= 1e-6 * size;
      };
      if (!whole(by.u, face.period_u, face.uv.u.length()) || !whole(by.v, face.period_v, face.uv.v.length())) continue;
      const bool moves = by.u != 0 || by.v != 0;
      if (!moves && (cuts_ == Cuts::Kept || segment(h).is_edge[static_cast<std::size_t>(p.operand)])) continue;
      Uv by_h, by_t;
      const std::size_t a = root(h.piece, by_h), b = root(t.piece, by_t);
      const Uv difference = by_h + by - by_t;  // root b has to move by this into root a
      if (a == b && (std::abs(difference.u) > 0.5 * face.period_u || std::abs(difference.v) > 0.5 * face.period_v)) continue;
      if (a != b) parent_[b] = a, offset_[b] = difference;
      remove(uses[0], uses[1]);
      uses.clear();
    }
  }

  void join(std::uint32_t a, std::uint32_t b) {
    halves_[a].edge.next = b;
    halves_[b].edge.previous = a;
  }
  void remove(std::uint32_t h, std::uint32_t t) {
    const std::uint32_t hn = halves_[h].edge.next, hp = halves_[h].edge.previous, tn = halves_[t].edge.next,
                        tp = halves_[t].edge.previous;
    halves_[h].gone = halves_[t].gone = true;
    if (hn == t && tn == h) return;
    if (hn == t) return join(hp, tn);
    if (tn == h) return join(tp, hn);
    if (hn == h) return join(tp, tn);  // a closed curve about nothing else
    if (tn == t) return join(hp, hn);
    join(hp, tn);
    join(tp, hn);
  }

  void move_pieces() {
    for (Half& h : halves_) {
      Uv by;
      h.piece = root(h.piece, by);
      if (by.u != 0 || by.v != 0) h.edge.use.pcurve = shifted(h.edge.use.pcurve, by);
    }
  }

  // ---- Edges: two uses each

  void pair_uses() {
    edge_of_.assign(halves_.size(), EdgeId{});
    for (SegmentIndex s = 0; s < uses_.size(); ++s) {
      std::vector<std::uint32_t>& uses = uses_[s];
      if (uses.size() > 2 && uses.size() % 2 == 0) {
        // Where the result touches itself: each wedge of material has an edge of its own.
        for (const auto& [a, b] : wedges(s)) edge_of_[a] = edge_of_[b] = add_edge(s);
      } else if (!uses.empty()) {
        const EdgeId e = add_edge(s);
        for (const std::uint32_t u : uses) edge_of_[u] = e;
      }
    }
  }

  std::vector<std::pair<std::uint32_t, std::uint32_t>> wedges(SegmentIndex s) const {
    const Segment& seg = given_.network.segments[s];
    const CurveJet j = jet(*seg.curve, seg.range.mid());
    const Vector along = normalized(j.d1);
    struct Leaf {
      double angle;
      bool material_after;
      std::uint32_t half;
    };
    std::vector<Leaf> leaves;
    Vector x;
    for (const std::uint32_t u : uses_[s]) {
      const Half& h = halves_[u];
      const FaceOf& face = face_of(kept_[h.piece]);
      const Vector n = normal(*face.surface, evaluate(h.edge.use.pcurve, h.edge.use.range.mid()));
      const Vector into = cross(n, h.edge.use.reversed ? -along : along);
      const Vector outward = face.reversed != kept_[h.piece].turned ? -n : n;
      if (norm(x) == 0) x = into;
      const double angle = std::atan2(dot(cross(x, into), along), dot(x, into));
      leaves.push_back({angle < -1e-9 ? angle + two_pi : angle, dot(outward, cross(along, into)) < 0, u});
    }
    std::sort(leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) {
      if (std::abs(a.angle - b.angle) > 1e-9) return a.angle < b.angle;
      return !a.material_after && b.material_after;
    });
    std::vector<std::pair<std::uint32_t, std::uint32_t>> out;
    for (std::size_t i = 0; i < leaves.size(); ++i)
      if (leaves[i].material_after) out.push_back({leaves[i].half, leaves[(i + 1) % leaves.size()].half});
    return out;
  }

  VertexId vertex(NodeIndex n) {
    if (vertex_of_.empty()) vertex_of_.resize(given_.network.nodes.size());
    if (!vertex_of_[n]) vertex_of_[n] = body_.add(Vertex{given_.network.nodes[n], 0});
    return vertex_of_[n];
  }
  EdgeId add_edge(SegmentIndex index) {
    const Segment& s = given_.network.segments[index];
    Edge e;
    e.curve = s.curve;
    e.range = s.range;
    e.start = vertex(s.start), e.end = vertex(s.end);
    e.source = s.source;
    const auto widen = [&](VertexId v, double t) {
      body_[v].gap_mm = std::max(body_[v].gap_mm, distance(body_[v].point, evaluate(*s.curve, t)));
    };
    widen(e.start, s.range.lo), widen(e.end, s.range.hi);
    return body_.add(std::move(e));
  }

  // ---- Faces

  Coedge coedge(const Half& h, EdgeId edge) {
    Coedge c;
    c.edge = edge;
    c.reversed = h.edge.use.reversed;
    c.pcurve = h.edge.use.pcurve;
    c.pcurve_range = h.edge.use.range;
    c.map = h.edge.use.map;
    c.gap_mm = h.edge.use.gap_mm;
    if (!c.edge) {
      Edge pole;
      pole.is_pole = true;
      pole.range = {std::min(c.pcurve_range.lo, c.pcurve_range.hi), std::max(c.pcurve_range.lo, c.pcurve_range.hi)};
      c.reversed = c.pcurve_range.lo > c.pcurve_range.hi;
      c.pcurve_range = pole.range;
      pole.start = pole.end = vertex(h.edge.use.pole);
      c.edge = body_.add(std::move(pole));
    }
    return c;
  }

  std::optional<Error> build_faces() {
    struct Cycle {
      std::uint32_t first;
      double area;
    };
    std::vector<std::vector<Cycle>> cycles(kept_.size());
    std::vector<HalfEdge> edges;
    for (std::size_t i = 0; i < halves_.size(); ++i) {
      edges.push_back(halves_[i].edge);
      if (!halves_[i].gone && halves_[i].edge.use.segment != none && !edge_of_[i])
        return Error{ErrorCode::Degenerate, "which faces meet along an edge of the result is not decided"};
    }
    std::vector<bool> seen(halves_.size(), false);
    for (std::uint32_t i = 0; i < halves_.size(); ++i) {
      if (halves_[i].gone || seen[i]) continue;
      for (std::uint32_t k = i; !seen[k]; k = halves_[k].edge.next) seen[k] = true;
      cycles[halves_[i].piece].push_back({i, area_of(polygon(edges, i))});
    }
    for (std::size_t p = 0; p < kept_.size(); ++p) {
      if (parent_[p] != p) continue;
      std::stable_sort(cycles[p].begin(), cycles[p].end(), [](const Cycle& a, const Cycle& b) { return a.area > b.area; });
      if (cycles[p].empty() || !(cycles[p].front().area > 0) || (cycles[p].size() > 1 && cycles[p][1].area > 0))
        return Error{ErrorCode::Degenerate, "a face of the result has no outer loop of its own"};
      const FaceOf& of = face_of(kept_[p]);
      const Face& source = given_.operands[static_cast<std::size_t>(kept_[p].operand)]->body()[of.id];
      Face face;
      face.surface = source.surface;
      face.reversed = source.reversed != kept_[p].turned;
      face.status = source.status;
      face.reason = source.reason;
      face.attributes = source.attributes;
      face.source = source.source;
      for (const Cycle& c : cycles[p]) {
        Loop loop;
        std::uint32_t k = c.first;
        do {
          loop.coedges.push_back(coedge(halves_[k], edge_of_[k]));
          k = halves_[k].edge.next;
        } while (k != c.first);
        face.loops.push_back(body_.add(std::move(loop)));
      }
      body_.add(std::move(face));
    }
    return std::nullopt;
  }

  void build_shells() {
    std::vector<std::size_t> group(body_.faces.size());
    std::iota(group.begin(), group.end(), std::size_t{0});
    const auto top = [&](std::size_t i) {
      while (group[i] != i) i = group[i] = group[group[i]];
      return i;
    };
    std::vector<std::size_t> first(body_.edges.size(), body_.faces.size());
    for (std::size_t f = 0; f < body_.faces.size(); ++f)
      for (const LoopId l : body_.faces[f].loops)
        for (const Coedge& c : body_[l].coedges) {
          if (body_[c.edge].is_pole) continue;
          std::size_t& with = first[c.edge.index];
          if (with == body_.faces.size()) with = f;
          else group[std::max(top(f), top(with))] = std::min(top(f), top(with));
        }
    std::map<std::size_t, Shell> shells;
    for (std::size_t f = 0; f < body_.faces.size(); ++f)
      shells[top(f)].faces.push_back({FaceId{static_cast<std::uint32_t>(f)}, false});
    for (auto& [key, shell] : shells) heal::finish_shell(body_, body_.add(std::move(shell)));
  }

  const Prepared& given_;
  const std::vector<KeptPiece>& kept_;
  const Cuts cuts_;
  std::vector<Half> halves_;
  std::vector<std::vector<std::uint32_t>> uses_;  // by segment
  std::vector<std::size_t> parent_;
  std::vector<Uv> offset_;
  std::vector<EdgeId> edge_of_;
  std::vector<VertexId> vertex_of_;
  Body body_;
};

}  // namespace

Result<Body> assemble(const Prepared& given, const std::vector<KeptPiece>& kept, Cuts cuts) {
  return Assembler(given, kept, cuts).run();
}

}  // namespace trimloop::boolean
