#include "kernel/boolean/network.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "kernel/boolean/first_error.h"
#include "kernel/boolean/meetings.h"
#include "kernel/pcurve/project.h"

namespace trimloop::boolean {
namespace {

class Builder {
 public:
  Builder(const std::array<const Operand*, 2>& operands, Meetings found)
      : operands_(operands), tolerance_(operands[0]->tolerance()), found_(std::move(found)) {}

  Result<Network> run() {
    net_.nodes = found_.nodes;
    for (int k : {0, 1}) net_.faces[k].resize(op(k).faces().size());
    for (const auto& [f, g] : found_.coincident) {
      net_.faces[0][f].coincident.push_back(g);
      net_.faces[1][g].coincident.push_back(f);
    }
    for (int k : {0, 1}) cut_edges(k);
    for (int k : {0, 1}) imprint_edges(k);
    for (const Arc& a : found_.arcs) imprint(a);
    if (error_) return tl::unexpected<Error>(error_.error());
    return std::move(net_);
  }

 private:
  const Operand& op(int k) const { return *operands_[static_cast<std::size_t>(k)]; }

  // ---- Edges into pieces

  void cut_edges(int k) {
    pieces_[k].resize(op(k).edges().size());
    for (std::uint32_t i = 0; i < pieces_[k].size() && !error_; ++i) {
      if (!op(k).edges()[i].used) continue;
      const Edge& e = op(k).body().edges[i];
      std::vector<Cut>& cuts = found_.cuts[k][i];
      std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.t < b.t; });
      cuts.insert(cuts.begin(), {e.range.lo, found_.vertex[k][e.start.index]});
      cuts.push_back({e.range.hi, found_.vertex[k][e.end.index]});
      for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
        Segment s;
        s.curve = e.curve;
        s.range = {cuts[c].t, cuts[c + 1].t};
        s.start = cuts[c].node, s.end = cuts[c + 1].node;
        s.source = e.source;
        if (!(s.range.lo < s.range.hi)) return error_.keep("cuts of an edge are too close together");
        pieces_[k][i].push_back(place_piece(k, std::move(s)));
      }
    }
    for (std::uint32_t f = 0; f < op(k).faces().size() && !error_; ++f) add_border(k, f);
  }

  struct Piece {
    SegmentIndex segment = none;
    bool against = false;  // the edge runs against the segment
    Interval range;        // on the edge
  };

  // The segment of a piece of an edge: that of the other operand's edge where both run together.
  Piece place_piece(int k, Segment s) {
    const auto key = std::minmax(s.start, s.end);
    auto& known = by_ends_[{key.first, key.second}];
    const Point middle = evaluate(*s.curve, s.range.mid());
    for (const SegmentIndex i : known) {
      Segment& t = net_.segments[i];
      if (k == 0 || !t.is_edge[0] || t.is_edge[1]) continue;
      const CurveFoot foot = closest_point(with_range(*t.curve, t.range), middle);
      if (foot.distance > 2 * tolerance_) continue;
      t.is_edge[1] = t.meets = true;
      const bool against = dot(jet(*t.curve, foot.t).d1, jet(*s.curve, s.range.mid()).d1) < 0;
      return {i, against, s.range};
    }
    const auto index = static_cast<SegmentIndex>(net_.segments.size());
    known.push_back(index);
    const Interval range = s.range;
    s.is_edge[static_cast<std::size_t>(k)] = true;
    net_.segments.push_back(std::move(s));
    return {index, false, range};
  }

  void add_border(int k, std::uint32_t f) {
    const FaceOf& face = op(k).faces()[f];
    const Body& body = op(k).body();
    FaceNet& net = net_.faces[static_cast<std::size_t>(k)][f];
    for (const LoopId l : body[face.id].loops)
      for (const Coedge& c : body[l].coedges) {
        const Edge& e = body[c.edge];
        if (e.is_pole) {
          Use use;
          use.pole = found_.vertex[k][e.start.index];
          use.pcurve = c.pcurve;
          use.range = c.reversed ? Interval{c.pcurve_range.hi, c.pcurve_range.lo} : c.pcurve_range;
          net.border.push_back(std::move(use));
          continue;
        }
        for (const Piece& p : pieces_[k][c.edge.index]) {
          auto use = border_use(c, e, p, *face.surface);
          if (!use) return error_.keep(use.error());
          net.border.push_back(std::move(*use));
        }
      }
  }

  Result<Use> border_use(const Coedge& c, const Edge& e, const Piece& p, const Surface& surface) {
    const Segment& s = net_.segments[p.segment];
    Use use;
    use.pcurve = c.pcurve;
    use.range = {pcurve_parameter(c, e, p.range.lo), pcurve_parameter(c, e, p.range.hi)};
    use.gap_mm = c.gap_mm;
    for (const Uv m : c.map)
      if (m.u > p.range.lo && m.u < p.range.hi) use.map.push_back(m);
    if (!use.map.empty()) {
      use.map.insert(use.map.begin(), Uv{p.range.lo, use.range.lo});
      use.map.push_back({p.range.hi, use.range.hi});
    }
    const bool own = s.curve == e.curve && s.range.lo == p.range.lo && s.range.hi == p.range.hi;
    if (!own) {
      if (p.against) std::swap(use.range.lo, use.range.hi);
      use.map.clear();
      if (!follows(use, s, surface)) {
        auto fitted = image(*s.curve, s.range, surface, tolerance_);
        if (!fitted) return fitted;
        const Uv there = evaluate(use.pcurve, 0.5 * (use.range.lo + use.range.hi)), here = evaluate(fitted->pcurve, fitted->range.mid());
        const SurfaceDomain d = domain(surface);
        const auto turn = [](double by, double period) { return period > 0 ? period * std::round(by / period) : 0.0; };
        fitted->pcurve = shifted(fitted->pcurve, {turn(there.u - here.u, d.period_u), turn(there.v - here.v, d.period_v)});
        use.pcurve = std::move(fitted->pcurve);
        use.range = fitted->range;
        use.gap_mm = fitted->gap_mm;
      }
    }
    use.segment = p.segment;
    use.reversed = c.reversed != p.against;
    net_.bound_mm = std::max(net_.bound_mm, use.gap_mm);
    return use;
  }

  bool follows(Use& use, const Segment& s, const Surface& surface) const {
    constexpr int samples = 8;
    for (int i = 0; i <= samples; ++i) {
      const double x = double(i) / samples;
      const Uv uv = evaluate(use.pcurve, use.range.lo + x * (use.range.hi - use.range.lo));
      const double off = distance(evaluate(surface, uv), evaluate(*s.curve, s.range.at(x)));
      if (off > 2 * tolerance_) return false;
      use.gap_mm = std::max(use.gap_mm, off);
    }
    return true;
  }

  // ---- Into faces

  // Pieces of edges of operand k that run inside faces of the other.
  void imprint_edges(int k) {
    for (const Contained& c : found_.contained[k]) {
      if (error_) return;
      const FaceOf& face = op(1 - k).faces()[c.face];
      for (const Piece& p : pieces_[k][c.edge]) {
        Segment& s = net_.segments[p.segment];
        const Place place = op(1 - k).locate(face, evaluate(*s.curve, s.range.mid()));
        if (place.where != Where::Inside) continue;
        s.meets = true;
        auto use = image(*s.curve, s.range, *face.surface, tolerance_);
        if (!use) return error_.keep(use.error());
        add_inner(1 - k, c.face, p.segment, std::move(*use), place.uv);
      }
    }
  }

  void imprint(const Arc& arc) {
    if (error_) return;
    Segment s;
    s.curve = arc.branch.curve;
    s.range = arc.range;
    s.start = arc.start, s.end = arc.end;
    s.meets = true;
    const auto index = static_cast<SegmentIndex>(net_.segments.size());
    net_.segments.push_back(s);
    for (int k : {0, 1}) {
      const std::uint32_t f = k == 0 ? arc.f : arc.g;
      const FaceOf& face = op(k).faces()[f];
      const Place place = op(k).locate(face, evaluate(*s.curve, s.range.mid()));
      Result<Use> use = Use{};
      if (const auto& given = arc.branch.images[static_cast<std::size_t>(k)]) {
        use->pcurve = *given;
        use->range = s.range;
        use->gap_mm = arc.branch.bound_mm;
      } else {
        use = image(*s.curve, s.range, *face.surface, tolerance_);
      }
      if (!use) return error_.keep(use.error());
      add_inner(k, f, index, std::move(*use), place.uv);
    }
  }

  void add_inner(int k, std::uint32_t f, SegmentIndex segment, Use use, Uv middle) {
    const FaceOf& face = op(k).faces()[f];
    const Uv here = evaluate(use.pcurve, 0.5 * (use.range.lo + use.range.hi));
    const auto turn = [](double by, double period) { return period > 0 ? period * std::round(by / period) : 0.0; };
    const Uv by{turn(middle.u - here.u, face.period_u), turn(middle.v - here.v, face.period_v)};
    if (by.u != 0 || by.v != 0) use.pcurve = shifted(use.pcurve, by);
    use.segment = segment;
    net_.bound_mm = std::max(net_.bound_mm, use.gap_mm);
    net_.faces[static_cast<std::size_t>(k)][f].inner.push_back(std::move(use));
  }

  const std::array<const Operand*, 2>& operands_;
  const double tolerance_;
  Meetings found_;
  Network net_;
  FirstError error_;
  std::array<std::vector<std::vector<Piece>>, 2> pieces_;
  std::map<std::pair<NodeIndex, NodeIndex>, std::vector<SegmentIndex>> by_ends_;
};

}  // namespace

Result<Network> make_network(const std::array<const Operand*, 2>& operands) {
  auto found = find_meetings(operands);
  if (!found) return tl::unexpected<Error>(found.error());
  return Builder(operands, std::move(*found)).run();
}

Curve2 shifted(const Curve2& c, Uv by) {
  auto moved = transformed(c.curve, Transform::translation({by.u, by.v, 0}));
  return moved ? Curve2{std::move(*moved)} : c;
}

Result<Use> image(const Curve& curve, Interval range, const Surface& surface, double tolerance_mm) {
  ProjectOptions options;
  options.tolerance_mm = 0.25 * tolerance_mm;
  auto projected = project(curve, range, surface, options);
  if (!projected) return tl::unexpected<Error>(projected.error());
  if (const Deviation& d = projected->deviation; !(d.measured_mm <= 2 * tolerance_mm))
    return fail(ErrorCode::NoConvergence, "a curve has no image in a face that it lies in", d.measured_mm, tolerance_mm);
  Use use;
  use.pcurve = std::move(projected->pcurve);
  use.range = projected->range;
  use.gap_mm = std::min(projected->deviation.bound_mm, std::max(projected->deviation.measured_mm, tolerance_mm));
  return use;
}

}  // namespace trimloop::boolean
