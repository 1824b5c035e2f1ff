#include "kernel/boolean/meetings.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "kernel/boolean/curve_hits.h"
#include "kernel/boolean/first_error.h"
#include "kernel/boolean/section.h"
#include "kernel/intersect/intersect.h"

namespace trimloop::boolean {
namespace {

bool is_closed(const Curve& c, double tolerance) { return distance(start_point(c), end_point(c)) <= tolerance; }

class Finder {
 public:
  explicit Finder(const std::array<const Operand*, 2>& operands)
      : operands_(operands), tolerance_(operands[0]->tolerance()) {}

  Result<Meetings> run() {
    for (int k : {0, 1}) {
      out_.cuts[k].resize(op(k).edges().size());
      for (const Vertex& v : op(k).body().vertices) out_.vertex[k].push_back(node_at(v.point));
    }
    for (int k : {0, 1})
      for (std::uint32_t e = 0; e < op(k).edges().size(); ++e)
        for (std::uint32_t f = 0; f < op(1 - k).faces().size(); ++f)
          if (op(k).edges()[e].used && !apart(op(k).edges()[e].box, op(1 - k).faces()[f].box, tolerance_)) pierce(k, e, f);
    for (std::uint32_t f = 0; f < op(0).faces().size() && !error_; ++f)
      for (std::uint32_t g = 0; g < op(1).faces().size(); ++g)
        if (!apart(op(0).faces()[f].box, op(1).faces()[g].box, tolerance_)) meet(f, g);
    if (error_) return tl::unexpected<Error>(error_.error());
    return std::move(out_);
  }

 private:
  const Operand& op(int k) const { return *operands_[static_cast<std::size_t>(k)]; }

  NodeIndex node_at(Point p) {
    for (std::size_t i = 0; i < out_.nodes.size(); ++i)
      if (!apart(Box{p, p}, out_.nodes[i], tolerance_) && distance(out_.nodes[i], p) <= tolerance_)
        return static_cast<NodeIndex>(i);
    out_.nodes.push_back(p);
    return static_cast<NodeIndex>(out_.nodes.size() - 1);
  }

  std::vector<NodeIndex>& nodes_of(int k, std::uint32_t mine, std::uint32_t other) {
    return on_both_[k == 0 ? std::pair{mine, other} : std::pair{other, mine}];
  }
  void cut(int k, std::uint32_t edge, double t, NodeIndex node) {
    const Edge& e = op(k).body().edges[edge];
    if (node == out_.vertex[k][e.start.index] || node == out_.vertex[k][e.end.index]) return;
    for (const Cut& c : out_.cuts[k][edge])
      if (c.node == node) return;
    out_.cuts[k][edge].push_back({t, node});
  }
  // An edge of operand k meets a face of the other in a node.
  void note(int k, std::uint32_t edge, std::uint32_t face, const Place& place, NodeIndex node) {
    std::vector<std::uint32_t> others{face};
    if (place.where == Where::Border && place.edge) {
      cut(1 - k, place.edge.index, place.t, node);
      for (const std::uint32_t g : op(1 - k).edges()[place.edge.index].faces) others.push_back(g);
    }
    for (const std::uint32_t f : op(k).edges()[edge].faces)
      for (const std::uint32_t g : others) nodes_of(k, f, g).push_back(node);
  }

  // ---- Edge with face

  void pierce(int k, std::uint32_t e, std::uint32_t f) {
    const EdgeOf& edge = op(k).edges()[e];
    const FaceOf& face = op(1 - k).faces()[f];
    const Edge& of = op(k).body().edges[e];
    for (const VertexId v : {of.start, of.end}) {
      const Place place = op(1 - k).locate(face, op(k).body()[v].point);
      if (place.where != Where::Outside) note(k, e, f, place, out_.vertex[k][v.index]);
    }
    if (lies_in(edge.curve, face)) {
      out_.contained[k].push_back({e, f});
      return along(k, e, f);
    }
    if (const auto hits = curve_hits(edge.curve, *face.surface, tolerance_)) {
      for (const double t : *hits) take_hit(k, e, f, t, evaluate(edge.curve, t));
      return;
    }
    IntersectOptions options;
    options.tolerance_mm = 0.25 * tolerance_;
    const auto [u, v] = reach(face);
    const auto hits = intersect(edge.curve, *face.surface, options, u, v);
    if (!hits) return error_.keep(hits.error());
    if (!hits->undecided.empty()) return error_.keep("where an edge meets a face is not decided");
    const auto off = [&](Point p) { return closest_point(*face.surface, p).distance; };
    for (const CurveSurfacePoint& h : hits->points)
      if (!is_known_contact(k, e, h.t, off)) take_hit(k, e, f, h.t, h.point);
    if (hits->overlaps.empty()) return;
    out_.contained[k].push_back({e, f});
    for (const CurveSurfaceOverlap& o : hits->overlaps)
      for (const double t : {o.on_curve.lo, o.on_curve.hi}) take_hit(k, e, f, t, evaluate(edge.curve, t));
    along(k, e, f);
  }
  // Whether the edge keeps within the tolerance of the other shape from a node that it has already to the parameter: then
  // both are one contact (a tangency, spread out by rounding).
  template <class Off>
  bool is_known_contact(int k, std::uint32_t e, double t, Off off) const {
    const Edge& of = op(k).body().edges[e];
    std::vector<double> nodes{of.range.lo, of.range.hi};
    for (const Cut& c : out_.cuts[k][e]) nodes.push_back(c.t);
    const Curve& curve = op(k).edges()[e].curve;
    constexpr int samples = 8;
    const double reach = 1e-2 * of.range.length();  // a contact is no longer than that; what is, lies in the surface
    for (const double node : nodes) {
      bool together = std::abs(node - t) <= reach;
      for (int i = 0; i <= samples && together; ++i)
        together = off(evaluate(curve, node + (t - node) * i / samples)) <= tolerance_;
      if (together) return true;
    }
    return false;
  }
  void take_hit(int k, std::uint32_t e, std::uint32_t f, double t, Point p) {
    const Place place = op(1 - k).locate(op(1 - k).faces()[f], p);
    if (place.where == Where::Outside) return;
    const NodeIndex node = node_at(p);
    cut(k, e, t, node);
    note(k, e, f, place, node);
  }

  // An edge that runs in the face's surface: where it crosses the face's edges.
  void along(int k, std::uint32_t e, std::uint32_t f) {
    const EdgeOf& edge = op(k).edges()[e];
    for (const EdgeId other : op(1 - k).faces()[f].edges) {
      const EdgeOf& border = op(1 - k).edges()[other.index];
      if (apart(edge.box, border.box, tolerance_)) continue;
      IntersectOptions options;
      options.tolerance_mm = 0.25 * tolerance_;
      const auto hits = intersect(edge.curve, border.curve, options);
      if (!hits) return error_.keep(hits.error());
      if (!hits->undecided.empty()) return error_.keep("where two edges meet is not decided");
      const auto take = [&](double t, double s, Point p) {
        const NodeIndex node = node_at(p);
        cut(k, e, t, node);
        note(k, e, f, {Where::Border, {}, other, s}, node);
      };
      const auto off = [&](Point p) { return closest_point(border.curve, p).distance; };
      for (const CurveCurvePoint& h : hits->points)
        if (!is_known_contact(k, e, h.t_first, off)) take(h.t_first, h.t_second, h.point);
      for (const CurveCurveOverlap& o : hits->overlaps)
        for (const bool hi : {false, true}) {
          const double t = hi ? o.first.hi : o.first.lo;
          take(t, hi != o.opposed ? o.second.hi : o.second.lo, evaluate(edge.curve, t));
        }
    }
  }

  // The face's parameters, a little widened where the surface goes on.
  static std::pair<Interval, Interval> reach(const FaceOf& face) {
    const SurfaceDomain d = domain(*face.surface);
    const auto wide = [](Interval box, Interval all, double period) {
      if (period > 0 && box.length() >= period * (1 - 1e-9)) return box;
      const double by = 0.01 * box.length();
      return Interval{std::max(box.lo - by, all.lo), std::min(box.hi + by, all.hi)};
    };
    const Interval free{-infinity, infinity};
    return {wide(face.uv.u, face.period_u > 0 ? free : d.u, face.period_u),
            wide(face.uv.v, face.period_v > 0 ? free : d.v, face.period_v)};
  }

  // Lines and conics in elementary surfaces: more points than they can have in common without lying there.
  bool lies_in(const Curve& curve, const FaceOf& face) const {
    const bool conic = curve.shape.index() <= 4;
    if (!conic || !is_elementary(*face.surface)) return false;
    constexpr int samples = 17;
    const Interval r = range(curve);
    for (int i = 0; i <= samples; ++i)
      if (closest_point(*face.surface, evaluate(curve, r.at(double(i) / samples))).distance > tolerance_)
        return false;
    return true;
  }
  static bool is_elementary(const Surface& s) { return s.shape.index() <= 4; }

  // ---- Face with face

  void meet(std::uint32_t f, std::uint32_t g) {
    const FaceOf &a = op(0).faces()[f], &b = op(1).faces()[g];
    const Box near{{std::max(a.box.lo.x, b.box.lo.x), std::max(a.box.lo.y, b.box.lo.y), std::max(a.box.lo.z, b.box.lo.z)},
                   {std::min(a.box.hi.x, b.box.hi.x), std::min(a.box.hi.y, b.box.hi.y), std::min(a.box.hi.z, b.box.hi.z)}};
    Box both = a.box;
    both.add(b.box);
    if (coincidence(*a.surface, *b.surface, both, tolerance_).same) return coincide(f, g);
    std::vector<Branch> branches;
    if (auto curves = section(*a.surface, *b.surface, widened(near, 4 * tolerance_), tolerance_)) {
      for (Curve& c : *curves) {
        Branch branch;
        branch.range = trimloop::range(c);
        branch.closed = branch.extends = std::holds_alternative<Circle>(c.shape) || std::holds_alternative<Ellipse>(c.shape);
        branch.curve = std::make_shared<const Curve>(std::move(c));
        branches.push_back(std::move(branch));
      }
    } else if (!general(f, g, branches)) {
      return;
    }
    add_crossings(f, g, branches);
    for (const Branch& branch : branches) add_arcs(f, g, branch);
  }

  void coincide(std::uint32_t f, std::uint32_t g) {
    out_.coincident.push_back({f, g});
  }

  bool general(std::uint32_t f, std::uint32_t g, std::vector<Branch>& branches) {
    const FaceOf &a = op(0).faces()[f], &b = op(1).faces()[g];
    SurfaceIntersectOptions options;
    options.fit_mm = 0.1 * tolerance_;
    const auto [ua, va] = reach(a);
    const auto [ub, vb] = reach(b);
    auto found = intersect(*a.surface, *b.surface, options, ua, va, ub, vb);
    if (!found) return error_.keep(found.error()), false;
    if (!found->undecided.empty()) return error_.keep("where two faces meet is not decided"), false;
    if (!found->overlaps.empty()) return coincide(f, g), false;
    for (IntersectionBranch& i : found->branches) {
      if (i.tangential) continue;
      Branch branch;
      branch.range = trimloop::range(i.curve);
      branch.closed = is_closed(i.curve, tolerance_);
      branch.curve = std::make_shared<const Curve>(std::move(i.curve));
      branch.images = {std::move(i.first), std::move(i.second)};
      branch.bound_mm = i.bound_mm;
      branches.push_back(std::move(branch));
    }
    return true;
  }

  // Curves of one pair of faces that cross each other (branch points).
  void add_crossings(std::uint32_t f, std::uint32_t g, const std::vector<Branch>& branches) {
    for (std::size_t i = 0; i < branches.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const auto hits = intersect(*branches[i].curve, *branches[j].curve);
        if (!hits) continue;
        for (const CurveCurvePoint& h : hits->points)
          if (is_in(f, g, h.point)) nodes_of(0, f, g).push_back(node_at(h.point));
      }
  }
  bool is_in(std::uint32_t f, std::uint32_t g, Point p) const {
    return op(0).locate(op(0).faces()[f], p).where != Where::Outside &&
           op(1).locate(op(1).faces()[g], p).where != Where::Outside;
  }

  void add_arcs(std::uint32_t f, std::uint32_t g, const Branch& branch) {
    std::vector<Cut> cuts;
    const auto add = [&](double t, NodeIndex node) {
      for (const Cut& c : cuts)
        if (c.node == node && std::abs(c.t - t) <= 1e-6 * branch.range.length()) return;
      cuts.push_back({t, node});
    };
    for (const NodeIndex node : nodes_of(0, f, g)) {
      const CurveFoot foot = closest_point(*branch.curve, out_.nodes[node]);
      if (foot.distance > 2 * tolerance_) continue;
      if (branch.closed && !branch.extends &&
          distance(foot.point, start_point(*branch.curve)) <= tolerance_) {
        add(branch.range.lo, node), add(branch.range.hi, node);
      } else {
        add(foot.t, node);
      }
    }
    if (cuts.empty() || (!branch.extends)) {
      for (const double t : {branch.range.lo, branch.range.hi}) {
        const Point p = evaluate(*branch.curve, t);
        if (is_in(f, g, p)) add(t, node_at(p));
      }
    }
    if (cuts.empty()) return;
    std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.t < b.t; });
    if (branch.extends && cuts.back().t - cuts.front().t < branch.range.length() * (1 - 1e-9))
      cuts.push_back({cuts.front().t + branch.range.length(), cuts.front().node});
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const Interval r{cuts[i].t, cuts[i + 1].t};
      if (distance(evaluate(*branch.curve, r.lo), evaluate(*branch.curve, r.mid())) <= tolerance_) continue;
      const Place a = op(0).locate(op(0).faces()[f], evaluate(*branch.curve, r.mid()));
      const Place b = op(1).locate(op(1).faces()[g], evaluate(*branch.curve, r.mid()));
      if (a.where == Where::Inside && b.where == Where::Inside)
        out_.arcs.push_back({f, g, branch, r, cuts[i].node, cuts[i + 1].node});
    }
  }

  const std::array<const Operand*, 2>& operands_;
  const double tolerance_;
  Meetings out_;
  FirstError error_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<NodeIndex>> on_both_;  // (face of 0, face of 1)
};

}  // namespace

Result<Meetings> find_meetings(const std::array<const Operand*, 2>& operands) { return Finder(operands).run(); }

}  // namespace trimloop::boolean
