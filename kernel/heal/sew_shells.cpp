// Faces that hang together become shells, turned alike; closed ones become solids.

#include <algorithm>

#include "kernel/check/measure.h"
#include "kernel/heal/make_face.h"
#include "kernel/heal/sew_detail.h"

namespace trimloop::heal {
namespace {

struct Neighbour {
  std::uint32_t face;
  bool same_way;  // both run along the common edge: one of the two faces has to be turned
};

std::vector<std::vector<Neighbour>> neighbours(const Sewing& s) {
  std::vector<std::vector<Neighbour>> out(s.body.faces.size());
  const auto along = [&](const Place& p) {
    return s.body[p.loop].coedges[p.coedge].reversed != s.body[p.face].reversed;
  };
  for (std::uint32_t e = 0; e < s.uses.size(); ++e) {
    const std::vector<Place>& u = s.uses[e];
    if (u.size() != 2 || s.body.edges[e].is_pole || u[0].face == u[1].face) continue;
    const bool same = along(u[0]) == along(u[1]);
    out[u[0].face.index].push_back({u[1].face.index, same});
    out[u[1].face.index].push_back({u[0].face.index, same});
  }
  return out;
}

double area_of(const Sewing& s, std::uint32_t f) { return area(s.body, FaceId{f}, 1e-2).value; }

constexpr std::uint32_t none = 0xffffffffu;

// The body that all of them came from, or none.
std::uint32_t common_origin(const Sewing& s, const std::vector<std::uint32_t>& faces) {
  const std::uint32_t first = s.origin[faces.front()];
  for (const std::uint32_t f : faces)
    if (s.origin[f] != first) return none;
  return first;
}

void turn(Sewing& s, const std::vector<std::uint32_t>& faces) {
  for (const std::uint32_t f : faces) s.body.faces[f].reversed = !s.body.faces[f].reversed;
  s.report.turned_faces += faces.size();
}

}  // namespace

void make_shells(Sewing& s) {
  const auto next_to = neighbours(s);
  std::vector<int> turned(s.body.faces.size(), -1);  // -1: not reached
  for (std::uint32_t first = 0; first < s.body.faces.size(); ++first) {
    if (s.stop.stop_requested()) return;
    if (turned[first] >= 0 || s.body.faces[first].status == FaceStatus::Failed) continue;
    std::vector<std::uint32_t> part{first}, against;
    turned[first] = 0;
    for (std::size_t i = 0; i < part.size(); ++i)
      for (const Neighbour& n : next_to[part[i]]) {
        if (turned[n.face] >= 0) continue;
        turned[n.face] = turned[part[i]] != static_cast<int>(n.same_way) ? 1 : 0;
        part.push_back(n.face);
      }
    // The larger area keeps its side.
    double kept = 0, given_up = 0;
    for (const std::uint32_t f : part)
      if (turned[f]) against.push_back(f);
    if (!against.empty()) {
      for (const std::uint32_t f : part) (turned[f] ? given_up : kept) += area_of(s, f);
      if (given_up > kept) {
        against.clear();
        for (const std::uint32_t f : part)
          if (!turned[f]) against.push_back(f);
      }
      turn(s, against);
    }
    Shell shell;
    const std::uint32_t from = common_origin(s, part);
    if (from != none && !s.origins[from].shells.empty()) shell.source = s.origins[from].shells[0].source;
    for (const std::uint32_t f : part) shell.faces.push_back({FaceId{f}, false});
    const ShellId id = s.body.add(std::move(shell));
    finish_shell(s.body, id);
    s.inward.resize(s.body.shells.size());
    s.inward.back() = false;
    if (s.body[id].closed) {
      const auto v = volume(s.body, id, 1e-3);
      double area = 0;
      for (const std::uint32_t f : part) area += area_of(s, f);
      if (!v || std::abs(v->value) <= s.tolerance_mm * area) {  // faces that lie on each other enclose nothing
        s.body.shells.pop_back();
        continue;
      }
      s.inward.back() = v->value < 0;
      if (v->value < 0) turn(s, part);
      ++s.report.closed_shells;
    } else if (part.size() == 1) {
      s.body.shells.pop_back();  // a face on its own is no shell
    } else {
      ++s.report.open_shells;
    }
  }
}

void list_open(Sewing& s) {
  std::vector<Point> points;
  std::vector<std::uint32_t> owner;  // track
  Box box;
  for (std::uint32_t i = 0; i < s.tracks.size(); ++i)
    for (const Point& p : s.tracks[i].points) points.push_back(p), owner.push_back(i), box.add(p);
  constexpr double reach_tolerances = 100, reach_share = 1e-3;
  const double reach = std::max(reach_tolerances * s.tolerance_mm, reach_share * box.diagonal());
  const PointGrid grid(points, box.diagonal(), reach);
  constexpr std::size_t most_candidates = 8;
  for (std::uint32_t i = 0; i < s.tracks.size(); ++i) {
    if (s.stop.stop_requested()) return;
    const Track& track = s.tracks[i];
    OpenEdge open{track.edge, track.face, evaluate(*s.body[track.edge].curve, s.body[track.edge].range.mid())};
    std::vector<std::pair<double, std::uint32_t>> near;
    Box around;
    around.add(open.at);
    if (s.measure_gaps)
      grid.near(grown(around, reach + track.length_mm / double(track.points.size())), [&](std::uint32_t k) {
      if (owner[k] != i) near.push_back({distance(points[k], open.at), owner[k]});
    });
    std::sort(near.begin(), near.end());
    std::vector<std::uint32_t> asked;
    for (const auto& [off, other] : near) {
      if (asked.size() == most_candidates) break;
      if (std::find(asked.begin(), asked.end(), other) != asked.end()) continue;
      asked.push_back(other);
      const double limit = open.gap_mm < 0 ? infinity : open.gap_mm;
      const double gap = one_sided(s.body, track, s.tracks[other], limit);
      if (gap < limit) open.gap_mm = gap;
    }
    s.report.open.push_back(open);
  }
  for (std::uint32_t e = 0; e < s.uses.size(); ++e)  // without a curve nothing can be measured
    if (s.uses[e].size() == 1 && !s.body.edges[e].is_pole && !s.body.edges[e].curve)
      s.report.open.push_back({EdgeId{e}, s.uses[e][0].face, s.body[s.body.edges[e].start].point});
}

namespace {

// The faces named, with what they use, as a body of their own.
class Extract {
 public:
  Extract(const Sewing& s, std::uint32_t origin, SewResult& result) : from_(s.body), result_(result) {
    if (origin == none) return;
    to_.attributes = s.origins[origin].attributes;
    to_.source = s.origins[origin].source;
  }

  FaceId face(FaceId id) {
    if (const auto known = faces_.find(id); known != faces_.end()) return known->second;
    Face f = from_[id];
    for (LoopId& loop : f.loops) {
      Loop copy = from_[loop];
      for (Coedge& c : copy.coedges) c.edge = edge(c.edge);
      loop = to_.add(std::move(copy));
    }
    return faces_[id] = to_.add(std::move(f));
  }
  void shell(const Shell& whole) {
    Shell s = whole;
    for (Shell::Use& use : s.faces) use.face = face(use.face);
    to_.add(std::move(s));
  }
  void finish(BodyKind kind, const std::vector<OpenEdge>& open) {
    to_.kind = kind;
    SewReport report;
    for (OpenEdge o : open) {
      const auto found = edges_.find(o.edge);
      if (found == edges_.end()) continue;
      o.edge = found->second;
      o.face = faces_.at(o.face);
      report.open.push_back(o);
    }
    result_.reports.push_back(std::move(report));
    result_.bodies.push_back(std::move(to_));
  }

 private:
  EdgeId edge(EdgeId id) {
    if (const auto known = edges_.find(id); known != edges_.end()) return known->second;
    Edge e = from_[id];
    e.start = vertex(e.start);
    e.end = vertex(e.end);
    return edges_[id] = to_.add(std::move(e));
  }
  VertexId vertex(VertexId id) {
    if (const auto known = vertices_.find(id); known != vertices_.end()) return known->second;
    return vertices_[id] = to_.add(from_[id]);
  }

  const Body& from_;
  SewResult& result_;
  Body to_;
  std::unordered_map<FaceId, FaceId> faces_;
  std::unordered_map<EdgeId, EdgeId> edges_;
  std::unordered_map<VertexId, VertexId> vertices_;
};

}  // namespace

namespace {

std::vector<std::uint32_t> faces_of(const Shell& shell) {
  std::vector<std::uint32_t> out;
  for (const Shell::Use& use : shell.faces) out.push_back(use.face.index);
  return out;
}

}  // namespace

SewResult separated(Sewing&& s) {
  SewResult result;
  std::vector<std::uint32_t> home = s.origin;  // where a face goes that is in no solid
  std::vector<bool> in_solid(s.body.faces.size(), false);
  std::vector<bool> inward;
  for (std::size_t i = 0; i < s.body.shells.size(); ++i) {
    const Shell& shell = s.body.shells[i];
    const std::vector<std::uint32_t> faces = faces_of(shell);
    const std::uint32_t from = common_origin(s, faces);
    for (const std::uint32_t f : faces) in_solid[f] = shell.closed, home[f] = from;
    if (!shell.closed) continue;
    inward.push_back(s.inward[i]);
    Extract solid(s, from, result);
    solid.shell(shell);
    solid.finish(BodyKind::Solid, s.report.open);
  }
  std::vector<std::size_t> voids = nest_shells(result.bodies, inward);
  s.report.voids = voids.size();
  for (std::size_t i = voids.size(); i-- > 0;) {
    result.bodies.erase(result.bodies.begin() + static_cast<std::ptrdiff_t>(voids[i]));
    result.reports.erase(result.reports.begin() + static_cast<std::ptrdiff_t>(voids[i]));
  }
  std::vector<std::uint32_t> homes;
  for (std::uint32_t f = 0; f < s.body.faces.size(); ++f)
    if (!in_solid[f]) homes.push_back(home[f]);
  std::sort(homes.begin(), homes.end());
  homes.erase(std::unique(homes.begin(), homes.end()), homes.end());
  for (const std::uint32_t h : homes) {
    Extract rest(s, h, result);
    for (std::uint32_t f = 0; f < s.body.faces.size(); ++f)
      if (!in_solid[f] && home[f] == h) rest.face(FaceId{f});
    for (const Shell& shell : s.body.shells)
      if (!shell.closed && home[shell.faces[0].face.index] == h) rest.shell(shell);
    rest.finish(BodyKind::Sheet, s.report.open);
  }
  if (result.reports.empty()) result.reports.emplace_back(), result.bodies.emplace_back();
  // The counts of the whole stand in the first report.
  std::vector<OpenEdge> first = std::move(result.reports[0].open);
  s.report.open = std::move(first);
  result.reports[0] = std::move(s.report);
  return result;
}

}  // namespace trimloop::heal
