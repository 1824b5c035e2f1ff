#include "kernel/mesh/tessellate.h"

#include <memory>

#include "kernel/mesh/face_mesher.h"
#include "kernel/mesh/parallel.h"

namespace trimloop::mesh {
namespace {

// Chords of edges stay well within the deflection, so that the triangles beside them have some left.
constexpr double edge_share = 0.6;
constexpr int max_rounds = 8;   // of halving chords that cross or leave too little

class Tessellator {
 public:
  Tessellator(const Body& body, const TessellationOptions& options, const Execution& execution)
      : body_(body), options_(options), execution_(execution) {}

  Result<BodyMesh> run() {
    collect_uses();
    if (!sample_edges()) return cancelled();
    std::vector<std::size_t> pending(body_.faces.size());
    for (std::size_t i = 0; i < pending.size(); ++i) pending[i] = i;
    faces_.resize(body_.faces.size());
    for (int round = 1; !pending.empty(); ++round) {
      if (!mesh_faces(pending)) return cancelled();
      if (triangle_count() > execution_.limits.triangles)
        return fail(ErrorCode::Limit, "more triangles than the limit for one mesh", static_cast<double>(triangle_count()),
                    static_cast<double>(execution_.limits.triangles));
      pending = round < max_rounds ? halve_crossed(pending) : std::vector<std::size_t>{};
    }
    return merged();
  }

 private:
  tl::unexpected<Error> cancelled() const { return fail(ErrorCode::Cancelled, "stopped while meshing"); }

  void collect_uses() {
    edges_.resize(body_.edges.size());
    faces_of_edge_.resize(body_.edges.size());
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

  bool sample_edges() {
    SampleBounds bounds{edge_share * options_.deflection_mm, options_.angle_rad};
    bounds.max_chords = std::max<std::size_t>(options_.max_triangles_per_face / 4, 8);
    for_each_index(edges_.size(), execution_.jobs, [&](std::size_t, std::size_t i) {
      if (execution_.stop.stop_requested()) return;
      edges_[i].samples = sample_edge(body_, body_.edges[i], edges_[i].uses, bounds);
    });
    if (execution_.stop.stop_requested()) return false;
    number_points();
    return true;
  }

  // Vertices share one point over all their edges; points inside edges follow in edge order.
  void number_points() {
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

  std::uint32_t add_point(Point p) {
    points_.push_back(p);
    return static_cast<std::uint32_t>(points_.size() - 1);
  }

  std::size_t boundary_points(std::size_t face) const {
    std::size_t count = 0;
    for (const LoopId loop : body_.faces[face].loops)
      for (const Coedge& c : body_[loop].coedges) count += edges_[c.edge.index].samples.t.size();
    return count;
  }

  bool mesh_faces(std::vector<std::size_t> pending) {
    // Those with the longest borders first: a large face begun last would leave the other threads idle.
    if (execution_.jobs > 1)
      std::stable_sort(pending.begin(), pending.end(),
                       [&](std::size_t a, std::size_t b) { return boundary_points(a) > boundary_points(b); });
    std::vector<std::unique_ptr<FaceMesher>> mesher(worker_count(execution_.jobs, pending.size()));
    for_each_index(pending.size(), execution_.jobs, [&](std::size_t worker, std::size_t i) {
      if (execution_.stop.stop_requested()) return;
      if (!mesher[worker]) mesher[worker] = std::make_unique<FaceMesher>(body_, points_, options_, execution_.stop);
      FaceResult& face = faces_[pending[i]];
      face = mesher[worker]->mesh({static_cast<std::uint32_t>(pending[i])}, edges_, std::move(face.certificate));
      if (worker == 0 && execution_.progress) execution_.progress(static_cast<double>(i + 1) / static_cast<double>(pending.size()));
    });
    return !execution_.stop.stop_requested();
  }

  // Halves what the faces just meshed complain about; returns the faces that must be meshed again, ascending.
  std::vector<std::size_t> halve_crossed(const std::vector<std::size_t>& meshed) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> chords;
    for (const std::size_t f : meshed)
      for (const auto* wanted : {&faces_[f].crossed, &faces_[f].coarse})
        for (const FaceBoundary::Chord& chord : *wanted) chords.push_back({chord.edge.index, chord.index});
    std::sort(chords.begin(), chords.end());
    chords.erase(std::unique(chords.begin(), chords.end()), chords.end());
    std::vector<std::size_t> faces;
    for (auto chord = chords.rbegin(); chord != chords.rend(); ++chord) {  // later chords first: indices stay valid
      if (!halve(chord->first, chord->second)) continue;
      const std::vector<std::size_t>& touched = faces_of_edge_[chord->first];
      faces.insert(faces.end(), touched.begin(), touched.end());
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
  }

  bool halve(std::uint32_t index, std::uint32_t chord) {
    SampledEdge& edge = edges_[index];
    const Edge& source = body_.edges[index];
    std::vector<double>& t = edge.samples.t;
    const double middle = 0.5 * (t[chord] + t[chord + 1]);
    if (!(middle > t[chord]) || !(middle < t[chord + 1])) return false;
    const Point p = edge_point(body_, source, edge.uses, middle);
    const auto at = static_cast<std::ptrdiff_t>(chord) + 1;
    t.insert(t.begin() + at, middle);
    edge.samples.points.insert(edge.samples.points.begin() + at, p);
    edge.points.insert(edge.points.begin() + at, source.is_pole ? edge.points.front() : add_point(p));
    return true;
  }

  std::size_t triangle_count() const {
    std::size_t count = 0;
    for (const FaceResult& face : faces_) count += face.mesh.triangles.size();
    return count;
  }

  BodyMesh merged() {
    BodyMesh mesh;
    mesh.points = std::move(points_);
    for (FaceResult& face : faces_) {
      const auto first = static_cast<std::uint32_t>(mesh.points.size());
      for (FaceVertex& vertex : face.mesh.vertices)
        if (vertex.point >= FaceResult::own_point) vertex.point += first - FaceResult::own_point;
      mesh.points.insert(mesh.points.end(), face.own_points.begin(), face.own_points.end());
      mesh.faces.push_back(std::move(face.mesh));
    }
    for (std::uint32_t i = 0; i < edges_.size(); ++i) {
      if (body_.edges[i].is_pole) continue;
      mesh.edges.push_back({EdgeId{i}, std::move(edges_[i].points), std::move(edges_[i].samples.t)});
    }
    return mesh;
  }

  const Body& body_;
  const TessellationOptions& options_;
  const Execution& execution_;
  std::vector<SampledEdge> edges_;
  std::vector<std::vector<std::size_t>> faces_of_edge_;
  std::vector<Point> points_;
  std::vector<FaceResult> faces_;
};

}  // namespace

Result<BodyMesh> tessellate(const Body& body, const TessellationOptions& options, const Execution& execution) {
  if (!(options.deflection_mm > 0) || !std::isfinite(options.deflection_mm))
    return fail(ErrorCode::InvalidArgument, "the deflection must be a positive length", options.deflection_mm, 0);
  if (!(options.angle_rad > 0))
    return fail(ErrorCode::InvalidArgument, "the angle must be positive", options.angle_rad, 0);
  return Tessellator(body, options, execution).run();
}

}  // namespace trimloop::mesh
