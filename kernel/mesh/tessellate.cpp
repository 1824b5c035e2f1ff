#include "kernel/mesh/tessellate.h"

#include <memory>

#include "kernel/mesh/face_mesher.h"
#include "kernel/mesh/parallel.h"

namespace trimloop::mesh {
namespace {

// Chords of edges stay well within the deflection, so that the triangles beside them have some left.
constexpr double edge_share = 0.6;
constexpr int max_rounds = 8;   // of adding samples to edges whose chords cross or leave too little
constexpr double stuck_share = 0.8;  // of the bound of a chord: when its parts have more than that, cutting it did not help
constexpr int most_failures = 4;     // in a row of that

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
      pending = round < max_rounds ? refine_edges(pending) : std::vector<std::size_t>{};
    }
    return merged();
  }

 private:
  tl::unexpected<Error> cancelled() const { return fail(ErrorCode::Cancelled, "stopped while meshing"); }

  void collect_uses() {
    edges_.resize(body_.edges.size());
    ancestry_.resize(body_.edges.size());
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

  // Adds the samples that the faces just meshed ask for; returns the faces that must be meshed again, ascending.
  std::vector<std::size_t> refine_edges(const std::vector<std::size_t>& meshed) {
    std::vector<NewSample> wanted;
    for (const std::size_t f : meshed) {
      for (const EdgeCut& cut : faces_[f].cuts) wanted.push_back({cut.edge.index, cut.t, {}});
      for (const CoarseChord& chord : faces_[f].coarse) cut_coarse(chord, wanted);
    }
    std::stable_sort(wanted.begin(), wanted.end());
    std::vector<std::size_t> faces;
    for (std::size_t i = 0; i < wanted.size();) {
      std::size_t end = i;
      while (end < wanted.size() && wanted[end].edge == wanted[i].edge) ++end;
      if (insert_samples(wanted[i].edge, std::span(wanted).subspan(i, end - i))) {
        const std::vector<std::size_t>& touched = faces_of_edge_[wanted[i].edge];
        faces.insert(faces.end(), touched.begin(), touched.end());
      }
      i = end;
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
  }

  // What came before a chord: the least bound of those it is a part of, and how often in a row cutting did not improve it.
  struct Ancestry {
    double bound_mm = infinity;
    int failures = 0;
  };
  struct NewSample {
    std::uint32_t edge;
    double t;
    Ancestry of;      // the chord it is to improve
    bool operator<(const NewSample& o) const { return edge != o.edge ? edge < o.edge : t < o.t; }
  };

  // Halves a chord, or quarters it where that has been of use, and not where it has been of none: what is left then is
  // a gap between edge and surface, or a surface of which no more can be proven.
  void cut_coarse(const CoarseChord& chord, std::vector<NewSample>& wanted) const {
    const std::vector<Ancestry>& ancestry = ancestry_[chord.edge.index];
    const Ancestry before = ancestry.empty() ? Ancestry{} : ancestry[chord.index];
    const bool has_failed = chord.bound_mm > stuck_share * before.bound_mm;
    const Ancestry own{std::min(chord.bound_mm, before.bound_mm), has_failed ? before.failures + 1 : 0};
    if (own.failures == most_failures) return;
    const std::vector<double>& t = edges_[chord.edge.index].samples.t;
    const double a = t[chord.index], b = t[chord.index + 1], middle = 0.5 * (a + b);
    wanted.push_back({chord.edge.index, middle, own});
    const bool is_useful = std::isfinite(before.bound_mm) && !has_failed;
    if (!is_useful || !(chord.bound_mm > 16 * options_.deflection_mm)) return;  // a half bows a quarter as far: two halvings are due
    wanted.push_back({chord.edge.index, 0.5 * (a + middle), own});
    wanted.push_back({chord.edge.index, 0.5 * (middle + b), own});
  }

  // `wanted`: of one edge, ascending. False when none was new.
  bool insert_samples(std::uint32_t index, std::span<const NewSample> wanted) {
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
  std::vector<std::vector<Ancestry>> ancestry_;  // by edge, by chord; empty: nothing came before
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
