// Border edges are given curves, shortened to poles where they are of no length, and cut where others end on them.

#include <algorithm>
#include <map>

#include "kernel/pcurve/lift.h"
#include "kernel/heal/sew_detail.h"
#include "kernel/heal/shared_edges.h"

namespace trimloop::heal {
namespace {

struct Cut {
  double t = 0, off_mm = 0;
  std::uint32_t vertex = 0;  // set
};

// Sets of vertices that lie on the inside of the track's edge, with the place of each.
std::vector<Cut> cuts_of(Sewing& s, const Track& track, const PointGrid& grid, const std::vector<std::uint32_t>& ids) {
  const Edge& edge = s.body[track.edge];
  const double tol = s.tolerance_mm;
  const std::uint32_t start = s.vertices.find(edge.start.index), end = s.vertices.find(edge.end.index);
  std::vector<std::uint32_t> seen;
  const auto look = [&](Point a, Point b, double sag) {
    Box box;
    box.add(a), box.add(b);
    grid.near(grown(box, sag + tol), [&](std::uint32_t i) { seen.push_back(ids[i]); });
  };
  for (std::size_t i = 1; i < track.points.size(); ++i) {
    const Point a = track.points[i - 1], b = track.points[i];
    // So many steps that neither their length nor what is left of the bow spans many cells.
    const double wanted = std::max(distance(a, b) / (2 * grid.cell()), std::sqrt(track.sag_mm / grid.cell()));
    const int steps = static_cast<int>(std::clamp(std::ceil(wanted), 1.0, 1e4));
    const Interval part{track.t[i - 1], track.t[i]};
    Point from = a;
    for (int k = 1; k <= steps; ++k) {
      const Point to = k == steps ? b : evaluate(*edge.curve, part.at(double(k) / steps));
      look(from, to, 2 * track.sag_mm / (double(steps) * steps));
      from = to;
    }
  }
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  std::map<std::uint32_t, Cut> best;  // by set
  const Point first = track.points.front(), last = track.points.back();
  for (const std::uint32_t v : seen) {
    const std::uint32_t set = s.vertices.find(v);
    if (set == start || set == end) continue;
    const Point p = s.body.vertices[v].point;
    const TrackFoot f = foot(s.body, track, p);
    if (!(f.distance <= tol)) continue;
    const Point on = evaluate(*edge.curve, f.t);
    if (distance(on, first) <= tol || distance(on, last) <= tol) continue;
    const auto [at, fresh] = best.try_emplace(set, Cut{f.t, f.distance, v});
    if (!fresh && f.distance < at->second.off_mm) at->second = {f.t, f.distance, v};
  }
  std::vector<Cut> cuts;
  for (const auto& [set, cut] : best) cuts.push_back(cut);
  std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.t < b.t; });
  const double least = 1e-12 * edge.range.length();
  cuts.erase(std::unique(cuts.begin(), cuts.end(), [&](const Cut& a, const Cut& b) { return b.t - a.t <= least; }), cuts.end());
  return cuts;
}

void cut_edge(Sewing& s, EdgeId id, const std::vector<Cut>& cuts, std::vector<Coedge>& out, const Coedge& whole) {
  const Edge before = s.body[id];
  std::vector<Coedge> parts;
  VertexId from = before.start;
  for (std::size_t k = 0; k <= cuts.size(); ++k) {
    const bool is_last = k == cuts.size();
    const Interval range{k == 0 ? before.range.lo : cuts[k - 1].t, is_last ? before.range.hi : cuts[k].t};
    VertexId to = before.end;
    if (!is_last) {
      to = s.body.add(Vertex{evaluate(*before.curve, range.hi), 0});
      s.vertices.unite(s.vertices.add(), cuts[k].vertex);
    }
    Edge edge = before;
    edge.range = range;
    edge.start = from;
    edge.end = to;
    Coedge part = part_of(whole, before, range);
    if (k == 0) s.body[id] = edge;
    part.edge = k == 0 ? id : s.body.add(std::move(edge));
    parts.push_back(std::move(part));
    from = to;
  }
  if (whole.reversed) std::reverse(parts.begin(), parts.end());
  for (Coedge& part : parts) out.push_back(std::move(part));
  s.report.splits += cuts.size();
}

}  // namespace

void lift_edges(Sewing& s) {
  for (std::uint32_t e = 0; e < s.body.edges.size(); ++e) {
    if (s.stop.stop_requested()) return;
    Edge& edge = s.body.edges[e];
    if (edge.curve || edge.is_pole || s.uses[e].size() != 1) continue;
    Coedge& c = s.coedge(s.uses[e][0]);
    const Face& face = s.body[s.uses[e][0].face];
    // No finer than what can be seen of an edge of its length.
    const auto at = [&](double f) { return evaluate(*face.surface, evaluate(c.pcurve, edge.range.at(f))); };
    const double length = distance(at(0), at(0.5)) + distance(at(0.5), at(1));
    auto lifted = pcurve::lift(*face.surface, c.pcurve, edge.range, std::max(0.05 * s.tolerance_mm, 1e-6 * length));
    if (!lifted) continue;  // it stays a border edge that nothing can be joined to
    c.pcurve_range = edge.range;
    edge.curve = lifted->curve;
    edge.range = range(*edge.curve);
    c.gap_mm = std::max(c.gap_mm, lifted->deviation_mm);
  }
}

void collapse_short(Sewing& s) {
  for (const Face& face : s.body.faces)
    for (const LoopId loop : face.loops) {
      std::vector<Coedge>& coedges = s.body[loop].coedges;
      std::size_t left = coedges.size();
      for (Coedge& c : coedges) {
        if (left <= 2 || !s.is_border(c.edge)) continue;
        Edge& edge = s.body[c.edge];
        if (distance(evaluate(*edge.curve, edge.range.lo), evaluate(*edge.curve, edge.range.hi)) > s.tolerance_mm) continue;
        const Track track = make_track(s.body, c.edge, FaceId{0});
        if (!(track.length_mm + track.sag_mm <= s.tolerance_mm)) continue;
        // From now on parameters of the edge are those of the pcurve.
        c.map.clear();
        if (c.pcurve_range.lo > c.pcurve_range.hi) {
          std::swap(c.pcurve_range.lo, c.pcurve_range.hi);
          c.reversed = !c.reversed;
        }
        s.vertices.unite(edge.start.index, edge.end.index);
        edge.range = c.pcurve_range;
        edge.curve = nullptr;
        edge.is_pole = true;
        edge.end = edge.start;
        c.gap_mm = std::max(c.gap_mm, track.length_mm);
        ++s.report.collapsed;
        --left;
      }
    }
}

namespace {

// The vertices at which open edges end, each once, and where they are.
struct Ends {
  std::vector<std::uint32_t> ids;
  std::vector<Point> points;
};
Ends ends_of_tracks(const Sewing& s) {
  Ends out;
  for (const Track& t : s.tracks)
    for (const VertexId v : {s.body[t.edge].start, s.body[t.edge].end}) out.ids.push_back(v.index);
  std::sort(out.ids.begin(), out.ids.end());
  out.ids.erase(std::unique(out.ids.begin(), out.ids.end()), out.ids.end());
  for (const std::uint32_t v : out.ids) out.points.push_back(s.body.vertices[v].point);
  return out;
}

}  // namespace

void cluster_vertices(Sewing& s) {
  const Ends ends = ends_of_tracks(s);
  const std::vector<std::uint32_t>& ids = ends.ids;
  const std::vector<Point>& points = ends.points;
  const PointGrid grid(points, 0, s.tolerance_mm);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    Box box;
    box.add(points[i]);
    grid.near(grown(box, s.tolerance_mm), [&](std::uint32_t j) {
      if (j > i && distance(points[i], points[j]) <= s.tolerance_mm) s.vertices.unite(ids[i], ids[j]);
    });
  }
}

void split_edges(Sewing& s) {
  const Ends ends = ends_of_tracks(s);
  const std::vector<std::uint32_t>& ids = ends.ids;
  const std::vector<Point>& points = ends.points;
  Box all;
  for (const Track& t : s.tracks) all.add(t.box());
  const PointGrid grid(points, all.diagonal(), s.tolerance_mm);

  std::map<EdgeId, std::vector<Cut>> cuts;
  std::vector<LoopId> loops;
  for (const Track& track : s.tracks) {
    if (s.stop.stop_requested()) return;
    std::vector<Cut> found = cuts_of(s, track, grid, ids);
    if (found.empty()) continue;
    loops.push_back(s.uses[track.edge.index][0].loop);
    cuts.emplace(track.edge, std::move(found));
  }
  std::sort(loops.begin(), loops.end());
  loops.erase(std::unique(loops.begin(), loops.end()), loops.end());
  for (const LoopId loop : loops) {
    std::vector<Coedge> made;
    const std::vector<Coedge> before = s.body[loop].coedges;
    for (const Coedge& c : before) {
      const auto found = cuts.find(c.edge);
      if (found == cuts.end()) made.push_back(c);
      else cut_edge(s, c.edge, found->second, made, c);
    }
    s.body[loop].coedges = std::move(made);
  }
  if (loops.empty()) return;
  s.find_uses();
  s.make_tracks();
}

}  // namespace trimloop::heal
