#include "kernel/heal/sew.h"

#include <algorithm>
#include <iterator>
#include <tuple>

#include "kernel/heal/sew_detail.h"

namespace trimloop::heal {
namespace {

auto key(Point p) { return std::tuple(p.x, p.y, p.z); }

// Equal for equal curves whichever way they run, so that faces may come in any order.
auto key(const Track& track) {
  const auto a = key(track.points.front()), b = key(track.points.back());
  const Point m = midpoint(track.points[track.points.size() / 2], track.points[(track.points.size() - 1) / 2]);
  return std::tuple(std::min(a, b), std::max(a, b), key(m), track.length_mm);
}

template <class Id>
Id moved(Id id, std::size_t by) {
  return Id{static_cast<std::uint32_t>(id.index + by)};
}

}  // namespace

void append(Body& to, Body&& from) {
  const std::size_t vertices = to.vertices.size(), edges = to.edges.size(), loops = to.loops.size();
  for (Edge& e : from.edges) {
    e.start = moved(e.start, vertices);
    e.end = moved(e.end, vertices);
  }
  for (Loop& l : from.loops)
    for (Coedge& c : l.coedges) c.edge = moved(c.edge, edges);
  for (Face& f : from.faces)
    for (LoopId& l : f.loops) l = moved(l, loops);
  const auto take = [](auto& all, auto& more) {
    all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  };
  take(to.vertices, from.vertices);
  take(to.edges, from.edges);
  take(to.loops, from.loops);
  take(to.faces, from.faces);
}

void Sewing::find_uses() {
  uses.assign(body.edges.size(), {});
  for (std::uint32_t f = 0; f < body.faces.size(); ++f)
    for (const LoopId loop : body.faces[f].loops)
      for (std::uint32_t k = 0; k < body[loop].coedges.size(); ++k)
        uses[body[loop].coedges[k].edge.index].push_back({FaceId{f}, loop, k});
}

void Sewing::make_tracks() {
  tracks.clear();
  for (std::uint32_t e = 0; e < body.edges.size(); ++e)
    if (is_border(EdgeId{e})) tracks.push_back(make_track(body, EdgeId{e}, uses[e][0].face));
  std::stable_sort(tracks.begin(), tracks.end(), [](const Track& a, const Track& b) { return key(a) < key(b); });
}

namespace {

void prepare(Sewing& s) {
  s.make_tracks();
  cluster_vertices(s);
}

}  // namespace

SewResult sew(std::vector<Body> bodies, const SewOptions& options) {
  Sewing work;
  work.tolerance_mm = options.tolerance_mm;
  work.measure_gaps = options.measure_gaps;
  work.stop = options.stop;
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    Body& shell = work.origins.emplace_back();
    shell.attributes = bodies[i].attributes;
    shell.source = bodies[i].source;
    if (bodies[i].shells.size() == 1) shell.shells = {{{}, false, false, bodies[i].shells[0].source}};
    work.origin.insert(work.origin.end(), bodies[i].faces.size(), i);
    append(work.body, std::move(bodies[i]));
  }
  work.find_uses();
  work.vertices = Sets(work.body.vertices.size());
  for (const auto stage : {lift_edges, collapse_short, prepare, split_edges, join_edges, settle_vertices, make_shells, list_open}) {
    stage(work);
    if (work.stop.stop_requested()) return {{}, {}, true};
  }
  return separated(std::move(work));
}

}  // namespace trimloop::heal
