#include "kernel/mesh/tessellate.h"

#include <memory>

#include "kernel/mesh/edge_net.h"
#include "kernel/mesh/parallel.h"

namespace trimloop::mesh {
namespace {

constexpr int max_rounds = 8;           // of adding samples to edges whose chords cross or leave too little
constexpr double edges_progress = 0.1;  // of the whole; most of what is left is the first round of faces
constexpr double later_progress = 0.05;

// One body while it is meshed.
struct Work {
  const Body* body;
  const TessellationOptions* options;
  EdgeNet edges;
  std::vector<FaceResult> faces;
  std::vector<std::size_t> pending;  // faces to be meshed in this round
  std::vector<char> no_draft;        // by face: its edges gave what they can

  explicit Work(const BodyTask& task) : body(task.body), options(&task.options), edges(*task.body, task.options), faces(task.body->faces.size()), no_draft(task.body->faces.size()) {
    for (std::size_t f = 0; f < faces.size(); ++f) pending.push_back(f);
  }
  // Those whose edges got more samples, and drafts whose edges did not: these are meshed to the end.
  std::vector<std::size_t> next_pending() {
    std::vector<std::size_t> next = edges.refine(faces, pending);
    const std::size_t touched = next.size();
    for (const std::size_t f : pending) {
      if (!faces[f].is_draft || std::binary_search(next.begin(), next.begin() + static_cast<std::ptrdiff_t>(touched), f)) continue;
      next.push_back(f);
      no_draft[f] = 1;
    }
    std::inplace_merge(next.begin(), next.begin() + static_cast<std::ptrdiff_t>(touched), next.end());
    return next;
  }
  std::size_t triangle_count() const {
    std::size_t count = 0;
    for (const FaceResult& face : faces) count += face.mesh.triangles.size();
    return count;
  }
};

BodyMesh merged(Work& work) {
  BodyMesh mesh;
  work.edges.release(mesh);
  std::size_t points = mesh.points.size();
  for (const FaceResult& face : work.faces) points += face.own_points.size();
  mesh.points.reserve(points);
  mesh.faces.reserve(work.faces.size());
  for (FaceResult& face : work.faces) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (FaceVertex& vertex : face.mesh.vertices)
      if (vertex.point >= FaceResult::own_point) vertex.point += first - FaceResult::own_point;
    mesh.points.insert(mesh.points.end(), face.own_points.begin(), face.own_points.end());
    mesh.faces.push_back(std::move(face.mesh));
  }
  return mesh;
}

// Edges, then faces, then again those faces that wanted more of their edges: each step over all bodies at once, so that
// threads wait for each other only at its end.
class Session {
 public:
  Session(std::span<const BodyTask> tasks, const Execution& execution) : tasks_(tasks), execution_(execution) {
    const std::size_t workers = static_cast<std::size_t>(std::max(execution.jobs, 1));
    for (std::size_t w = 0; w < workers; ++w) {
      spaces_.push_back(std::make_unique<MeshingSpace>());
      spaces_.back()->stop = StopCheck(execution.stop, tasks.empty() ? nullptr : &tasks.front().options.on_look);
    }
  }

  Result<std::vector<BodyMesh>> run() {
    bodies_.resize(tasks_.size());
    each(tasks_.size(), [&](StopCheck&, std::size_t i) { bodies_[i] = std::make_unique<Work>(tasks_[i]); });
    sample_edges();
    for (int round = 1; !is_stopped(); ++round) {
      if (!mesh_faces(round)) break;
      for (const auto& work : bodies_)
        if (const std::size_t count = work ? work->triangle_count() : 0; count > execution_.limits.triangles)
          return fail(ErrorCode::Limit, "more triangles than the limit for one mesh", static_cast<double>(count),
                      static_cast<double>(execution_.limits.triangles));
      each(bodies_.size(), [&](StopCheck&, std::size_t i) {
        Work& work = *bodies_[i];
        work.pending = round < max_rounds ? work.next_pending() : std::vector<std::size_t>{};
      });
    }
    if (is_stopped()) return fail(ErrorCode::Cancelled, "stopped while meshing");
    std::vector<BodyMesh> meshes(bodies_.size());
    each(bodies_.size(), [&](StopCheck&, std::size_t i) { meshes[i] = merged(*bodies_[i]); });
    if (execution_.progress) execution_.progress(1);
    return meshes;
  }

 private:
  // work(stop, i) for each index, unless stopped.
  template <class Do>
  void each(std::size_t count, Do work) {
    for_each_index(count, execution_.jobs, [&](std::size_t worker, std::size_t i) {
      if (!spaces_[worker]->stop.spend()) work(spaces_[worker]->stop, i);
    });
  }

  bool is_stopped() const {
    if (execution_.stop.stop_requested()) return true;
    for (const auto& space : spaces_)
      if (space->stop.stopped()) return true;
    return false;
  }

  void sample_edges() {
    struct Item {
      std::uint32_t body, edge;
    };
    std::vector<Item> items;
    for (std::uint32_t b = 0; b < bodies_.size() && bodies_[b]; ++b)
      for (std::uint32_t e = 0; e < bodies_[b]->edges.size(); ++e) items.push_back({b, e});
    each(items.size(), [&](StopCheck& stop, std::size_t i) { bodies_[items[i].body]->edges.sample(items[i].edge, stop); });
    if (is_stopped()) return;
    each(bodies_.size(), [&](StopCheck&, std::size_t i) { bodies_[i]->edges.number_points(); });
    if (execution_.progress) execution_.progress(edges_progress);
  }

  // False when there was none to mesh.
  bool mesh_faces(int round) {
    struct Item {
      std::uint32_t body, face;
      std::size_t size;
    };
    std::vector<Item> items;
    for (std::uint32_t b = 0; b < bodies_.size(); ++b) {
      for (const std::size_t f : bodies_[b]->pending) {
        const FaceId id{static_cast<std::uint32_t>(f)};
        items.push_back({b, id.index, bodies_[b]->edges.samples_around(id)});
      }
    }
    // Those with the longest borders first: a large face begun last would leave the other threads idle.
    if (execution_.jobs > 1)
      std::stable_sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.size > b.size; });
    std::atomic<std::size_t> done{0};
    for_each_index(items.size(), execution_.jobs, [&](std::size_t worker, std::size_t i) {
      MeshingSpace& space = *spaces_[worker];
      if (space.stop.spend()) return;
      Work& work = *bodies_[items[i].body];
      FaceResult& face = work.faces[items[i].face];
      FaceMesher mesher(*work.body, work.edges.points(), *work.options, space);
      face = mesher.mesh({items[i].face}, work.edges.edges(), std::move(face.certificate), round < max_rounds && !work.no_draft[items[i].face]);
      const double share = static_cast<double>(++done) / static_cast<double>(items.size());
      if (worker == 0 && execution_.progress) execution_.progress(progress(round, share));
    });
    return !items.empty();
  }

  static double progress(int round, double share) {
    constexpr double first = 1 - edges_progress - later_progress;
    return round == 1 ? edges_progress + first * share : 1 - later_progress * std::pow(0.5, round - 2) * (1 - 0.5 * share);
  }

  std::span<const BodyTask> tasks_;
  const Execution& execution_;
  std::vector<std::unique_ptr<MeshingSpace>> spaces_;  // one per thread
  std::vector<std::unique_ptr<Work>> bodies_;
};

}  // namespace

Result<std::vector<BodyMesh>> tessellate(std::span<const BodyTask> tasks, const Execution& execution) {
  for (const BodyTask& task : tasks) {
    const TessellationOptions& options = task.options;
    if (!(options.deflection_mm > 0) || !std::isfinite(options.deflection_mm))
      return fail(ErrorCode::InvalidArgument, "the deflection must be a positive length", options.deflection_mm, 0);
    if (!(options.angle_rad > 0))
      return fail(ErrorCode::InvalidArgument, "the angle must be positive", options.angle_rad, 0);
  }
  return Session(tasks, execution).run();
}

Result<BodyMesh> tessellate(const Body& body, const TessellationOptions& options, const Execution& execution) {
  const BodyTask task{&body, options};
  auto meshes = tessellate(std::span(&task, 1), execution);
  if (!meshes) return tl::unexpected(meshes.error());
  return std::move(meshes->front());
}

}  // namespace trimloop::mesh
