#include "kernel/mesh/edge_net.h"

namespace trimloop::mesh {
namespace {

// Chords of edges stay well within the deflection, so that the triangles beside them have some left.
constexpr double edge_share = 0.6;
constexpr double stuck_share = 0.8;  // of the bound of a chord: when its parts have more than that, cutting it did not help
constexpr int most_failures = 4;     // in a row of that

}  // namespace

EdgeNet::EdgeNet(const Body& body, const TessellationOptions& options)
    : body_(body), bounds_{edge_share * options.deflection_mm, options.angle_rad}, deflection_mm_(options.deflection_mm),
      edges_(body.edges.size()), faces_of_edge_(body.edges.size()), ancestry_(body.edges.size()) {
  bounds_.max_chords = std::max<std::size_t>(options.max_triangles_per_face / 4, 8);
  for (std::size_t f = 0; f < body_.faces.size(); ++f) {
    const Face& face = body_.faces[f];
    if (face.status == FaceStatus::Failed || !face.surface) continue;
    for (const LoopId loop : face.loops) {
      for (const Coedge& coedge : body_[loop].coedges) {
        edges_[coedge.edge.index].uses.push_back({face.surface.get(), &coedge});
        faces_of_edge_[coedge.edge.index].push_back(f);
      }
    }
  }
}

void EdgeNet::sample(std::size_t edge, StopCheck& stop) {
  edges_[edge].samples = sample_edge(body_, body_.edges[edge], edges_[edge].uses, bounds_, stop);
}

// Vertices share one point over all their edges; points inside edges follow in edge order.
void EdgeNet::number_points() {
  constexpr std::uint32_t none = Triangulation::none;
  std::vector<std::uint32_t> vertex_point(body_.vertices.size(), none);
  const auto of_vertex = [&](VertexId id) {
    std::uint32_t& point = vertex_point[id.index];
    if (point == none) point = add_point(body_[id].point);
    return point;
  };
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    SampledEdge& edge = edges_[i];
    const Edge& source = body_.edges[i];
    for (std::size_t k = 0; k < edge.samples.t.size(); ++k) {
      const bool last = k + 1 == edge.samples.t.size();
      edge.points.push_back(k == 0 || source.is_pole ? of_vertex(source.start)
                            : last                   ? of_vertex(source.end)
                                                     : add_point(edge.samples.points[k]));
    }
  }
}

std::uint32_t EdgeNet::add_point(Point p) {
  points_.push_back(p);
  return static_cast<std::uint32_t>(points_.size() - 1);
}

std::size_t EdgeNet::samples_around(FaceId face) const {
  std::size_t count = 0;
  for (const LoopId loop : body_[face].loops)
    for (const Coedge& c : body_[loop].coedges) count += edges_[c.edge.index].samples.t.size();
  return count;
}

std::vector<std::size_t> EdgeNet::refine(std::span<const FaceResult> all, std::span<const std::size_t> meshed) {
  std::vector<NewSample> wanted;
  for (const std::size_t f : meshed) {
    for (const EdgeCut& cut : all[f].cuts) wanted.push_back({cut.edge.index, cut.t, {}});
    for (const CoarseChord& chord : all[f].coarse) cut_coarse(chord, wanted);
  }
  std::stable_sort(wanted.begin(), wanted.end());
  std::vector<std::size_t> faces;
  for (std::size_t i = 0; i < wanted.size();) {
    std::size_t end = i;
    while (end < wanted.size() && wanted[end].edge == wanted[i].edge) ++end;
    if (insert(wanted[i].edge, std::span(wanted).subspan(i, end - i))) {
      const std::vector<std::size_t>& touched = faces_of_edge_[wanted[i].edge];
      faces.insert(faces.end(), touched.begin(), touched.end());
    }
    i = end;
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

// Halves a chord, or quarters it where that has been of use, and not where it has been of none: what is left then is
// a gap between edge and surface, or a surface of which no more can be proven.
void EdgeNet::cut_coarse(const CoarseChord& chord, std::vector<NewSample>& wanted) const {
  const std::vector<Ancestry>& ancestry = ancestry_[chord.edge.index];
  const Ancestry before = ancestry.empty() ? Ancestry{} : ancestry[chord.index];
  const bool has_failed = chord.bound_mm > stuck_share * before.bound_mm;
  const Ancestry own{std::min(chord.bound_mm, before.bound_mm), has_failed ? before.failures + 1 : 0};
  if (own.failures == most_failures) return;
  const std::vector<double>& t = edges_[chord.edge.index].samples.t;
  const double a = t[chord.index], b = t[chord.index + 1], middle = 0.5 * (a + b);
  wanted.push_back({chord.edge.index, middle, own});
  const bool is_useful = std::isfinite(before.bound_mm) && !has_failed;
  if (!is_useful || !(chord.bound_mm > 16 * deflection_mm_)) return;  // a half bows a quarter as far: two halvings are due
  wanted.push_back({chord.edge.index, 0.5 * (a + middle), own});
  wanted.push_back({chord.edge.index, 0.5 * (middle + b), own});
}

// `wanted`: of one edge, ascending. False when none was new.
bool EdgeNet::insert(std::uint32_t index, std::span<const NewSample> wanted) {
  SampledEdge& edge = edges_[index];
  const Edge& source = body_.edges[index];
  std::vector<Ancestry>& before = ancestry_[index];
  before.resize(edge.samples.t.size() - 1);
  const SampledEdge old = std::move(edge);
  const std::vector<Ancestry> old_before = std::move(before);
  edge.samples.deviation_mm = old.samples.deviation_mm;
  edge.uses = old.uses;
  before.clear();
  const auto keep = [&](double t, Point p, std::uint32_t point) {
    edge.samples.t.push_back(t), edge.samples.points.push_back(p), edge.points.push_back(point);
  };
  std::size_t next = 0;
  for (std::size_t i = 0; i < old.samples.t.size(); ++i) {
    const double t = old.samples.t[i];
    keep(t, old.samples.points[i], old.points[i]);
    if (i + 1 == old.samples.t.size()) break;
    Ancestry of{0, most_failures};  // what gives most hope
    std::size_t added = 0;
    for (; next < wanted.size() && wanted[next].t < old.samples.t[i + 1]; ++next) {
      if (!(wanted[next].t > t)) continue;
      of = {std::max(of.bound_mm, wanted[next].of.bound_mm), std::min(of.failures, wanted[next].of.failures)};
      if (wanted[next].t == edge.samples.t.back()) continue;
      const Point p = edge_point(body_, source, edge.uses, wanted[next].t);
      keep(wanted[next].t, p, source.is_pole ? old.points.front() : add_point(p));
      ++added;
    }
    before.insert(before.end(), added + 1, added > 0 ? of : old_before[i]);
  }
  return edge.samples.t.size() > old.samples.t.size();
}

void EdgeNet::release(BodyMesh& mesh) {
  mesh.points = std::move(points_);
  for (std::uint32_t i = 0; i < edges_.size(); ++i) {
    if (body_.edges[i].is_pole) continue;
    mesh.edges.push_back({EdgeId{i}, std::move(edges_[i].points), std::move(edges_[i].samples.t)});
  }
}

}  // namespace trimloop::mesh
