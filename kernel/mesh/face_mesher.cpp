#include "kernel/mesh/face_mesher.h"

#include <optional>

#include "kernel/mesh/seeds.h"
#include "kernel/mesh/turned_triangles.h"

namespace trimloop::mesh {
namespace {

// Samples miss a little of the largest distance: over the test surfaces 1.144 times the estimate was the worst seen.
constexpr double sampled_margin = 1.2;
constexpr double plane_rounding = 1e-14;  // of coordinates
constexpr int closer_look = 6;            // halvings of a piece to prove it

// Writes triangles, one face vertex per triangulation vertex and a new one for each fan triangle at a pole.
class Output {
 public:
  Output(const Surface& surface, bool reversed, const FaceBoundary& boundary, const Triangulation& triangulation,
         std::vector<std::uint32_t>& face_vertex, FaceResult& result)
      : surface_(surface), reversed_(reversed), boundary_(boundary), triangulation_(triangulation),
        face_vertex_(face_vertex), result_(result) {
    face_vertex_.assign(triangulation.points().size(), Triangulation::none);
  }

  // `vertex_at(i)` gives the SurfaceVertex of triangulation vertex i.
  template <class VertexAt>
  void write(const VertexAt& vertex_at, StopCheck& stop) {
    for (const std::array<std::uint32_t, 3>& v : triangulation_.inside_triangles(&stop)) {
      if (stop.spend()) return;
      if (same_point(v[0], v[1]) || same_point(v[1], v[2]) || same_point(v[2], v[0])) continue;  // along a pole or a join
      std::array<std::uint32_t, 3> out;
      for (std::size_t i = 0; i < 3; ++i) {
        const SurfaceVertex& corner = vertex_at(v[i]);
        out[i] = corner.pole == PoleSide::None
                     ? regular(v[i], corner)
                     : fan_centre(v[i], corner, vertex_at(v[(i + 1) % 3]), vertex_at(v[(i + 2) % 3]));
      }
      if (reversed_) std::swap(out[1], out[2]);
      result_.mesh.triangles.push_back(out);
    }
  }

 private:
  bool same_point(std::uint32_t a, std::uint32_t b) const {
    return a < boundary_.point.size() && b < boundary_.point.size() && boundary_.point[a] == boundary_.point[b];
  }

  std::uint32_t regular(std::uint32_t v, const SurfaceVertex& s) {
    if (face_vertex_[v] == Triangulation::none) face_vertex_[v] = append(point_of(v, s), s.uv, s.normal);
    return face_vertex_[v];
  }

  std::uint32_t fan_centre(std::uint32_t v, const SurfaceVertex& s, const SurfaceVertex& a, const SurfaceVertex& b) {
    Uv uv = s.uv;
    if (s.pole == PoleSide::AlongU) uv.u = 0.5 * (a.uv.u + b.uv.u);
    if (s.pole == PoleSide::AlongV) uv.v = 0.5 * (a.uv.v + b.uv.v);
    return append(point_of(v, s), uv, normal(surface_, uv));
  }

  std::uint32_t point_of(std::uint32_t v, const SurfaceVertex& s) {
    if (v < boundary_.point.size()) return boundary_.point[v];
    result_.own_points.push_back(s.point);
    return FaceResult::own_point + static_cast<std::uint32_t>(result_.own_points.size() - 1);
  }

  std::uint32_t append(std::uint32_t point, Uv uv, Vector n) {
    result_.mesh.vertices.push_back({point, uv, reversed_ ? -n : n});
    return static_cast<std::uint32_t>(result_.mesh.vertices.size() - 1);
  }

  const Surface& surface_;
  bool reversed_;
  const FaceBoundary& boundary_;
  const Triangulation& triangulation_;
  std::vector<std::uint32_t>& face_vertex_;
  FaceResult& result_;
};

void add_reason(FaceMesh& mesh, const char* reason) {
  if (!mesh.reason.empty()) mesh.reason += "; ";
  mesh.reason += reason;
}

}  // namespace

FaceResult FaceMesher::mesh(FaceId id, std::span<const SampledEdge> edges, std::unique_ptr<Certificate> certificate, bool may_draft) {
  FaceResult result;
  result.certificate = std::move(certificate);
  result.mesh.face = id;
  const Face& face = body_[id];
  if (face.status == FaceStatus::Failed || !face.surface || face.loops.empty()) {
    result.mesh.reason = face.reason.empty() ? "the face has no loops" : face.reason;
    result.mesh.deflection_met = false;
    return result;
  }
  collect_boundary(body_, face, edges, boundary_);
  if (!boundary_.finite || !(boundary_.u.length() > 0) || !(boundary_.v.length() > 0)) {
    result.mesh.reason = boundary_.finite ? "the loops enclose nothing" : "a boundary point is not finite";
    result.mesh.deflection_met = false;
    return result;
  }
  if (const Plane* plane = std::get_if<Plane>(&face.surface->shape)) {
    flat(*plane, face.reversed, edges, result);
  } else {
    curved(*face.surface, face.reversed, edges, may_draft, result);
  }
  if (result.mesh.triangles.empty() && result.mesh.reason.empty()) result.mesh.reason = "the loops enclose nothing";
  if (result.mesh.triangles.empty()) result.mesh.deflection_met = false;
  if (result.cuts.empty() && result.coarse.empty()) result.certificate.reset();
  return result;
}

bool FaceMesher::triangulate(std::span<const SampledEdge> edges, const Chart* chart, FaceResult& result) {
  const Result<void> built = triangulation_.build(input_, boundary_.segments, &stop_);
  if (!built) {
    result.mesh.reason = built.error().text;
    result.mesh.deflection_met = false;
    return false;
  }
  triangulation_.classify(Inside::Odd);
  report_crossings(edges, chart, result);
  return true;
}

// Chords that cross leave their edge: more samples on both sides of the edge mend most of it.
void FaceMesher::report_crossings(std::span<const SampledEdge> edges, const Chart* chart, FaceResult& result) const {
  for (const Triangulation::Crossing& crossing : triangulation_.crossings()) {
    if (!boundary_.chords[crossing.constraint].edge) continue;
    add_reason(result.mesh, "loops touch or cross; parity decides what is inside");
    break;
  }
  result.cuts = part_crossings(body_, boundary_, edges, triangulation_, chart);
  for (std::uint32_t t = 0; t < triangulation_.triangle_count(); ++t)
    if (triangulation_.is_inside(t)) return;
  const std::vector<EdgeCut> bowed = halve_bowed(body_, boundary_, edges, chart);
  result.cuts.insert(result.cuts.end(), bowed.begin(), bowed.end());
}

// A plane needs no point inside, and its parameters are lengths.
void FaceMesher::flat(const Plane& plane, bool reversed, std::span<const SampledEdge> edges, FaceResult& result) {
  const Surface& surface = *body_[result.mesh.face].surface;
  input_.assign(boundary_.uv.begin(), boundary_.uv.end());
  if (!triangulate(edges, nullptr, result)) return;
  Output output(surface, reversed, boundary_, triangulation_, face_vertex_, result);
  SurfaceVertex vertex;
  vertex.normal = plane.frame.z;
  output.write([&](std::uint32_t v) -> const SurfaceVertex& {
    vertex.uv = triangulation_.points()[v];
    if (v >= boundary_.uv.size()) vertex.point = evaluate(surface, vertex.uv);
    return vertex;
  }, stop_);
  // The plane's parameters are lengths: a triangle is as far off as its farthest corner.
  double gap = 0, size = 0;
  std::vector<Point> place;
  for (std::size_t i = 0; i < result.mesh.vertices.size(); ++i) {
    if (stop_.spend()) return;
    const FaceVertex& v = result.mesh.vertices[i];
    place.push_back(v.point < FaceResult::own_point ? points_[v.point] : result.own_points[v.point - FaceResult::own_point]);
    const Point p = evaluate(surface, v.uv);
    gap = std::max(gap, distance(p, place[i]));
    size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  Certificate certificate(surface, boundary_.u, boundary_.v);
  FaceCertifier certifier(body_, result.mesh, place, {options_.deflection_mm, 1.05, closer_look});
  const double beside = options_.prove ? strips(certifier, certificate, edges, result) : 0;
  const double proven = std::max(gap, beside) + plane_rounding * size;
  const double estimate = boundary_.edge_deviation_mm + boundary_.gap_mm;
  state_bound(options_.prove || estimate == 0 ? proven : infinity, estimate, result.mesh);
}

// Bound for what lies between the boundary's chords and the parameter curves; chords that stand too far off are noted.
double FaceMesher::strips(FaceCertifier& certifier, Certificate& certificate, std::span<const SampledEdge> edges, FaceResult& result) const {
  double worst = 0;
  std::size_t pieces = certificate.pieces();
  for (const LoopId loop : body_[result.mesh.face].loops) {
    for (const Coedge& coedge : body_[loop].coedges) {
      if (body_[coedge.edge].is_pole) continue;
      const SampledEdge& edge = edges[coedge.edge.index];
      for (std::uint32_t i = 0; i + 1 < edge.points.size(); ++i) {
        if (stop_.spend(1 + certificate.pieces() - pieces)) return infinity;
        pieces = certificate.pieces();
        const double bound = certifier.strip(certificate, coedge, {edge.samples.t[i], edge.samples.t[i + 1]}, edge.points[i], edge.points[i + 1]);
        worst = std::max(worst, bound);
        if (bound > options_.deflection_mm && std::isfinite(bound)) result.coarse.push_back({coedge.edge, i, bound});
      }
    }
  }
  return worst;
}

void FaceMesher::state_bound(double proven, double estimate, FaceMesh& mesh) const {
  mesh.bound_kind = std::isfinite(proven) ? BoundKind::Proven : BoundKind::Sampled;
  mesh.bound_mm = std::isfinite(proven) ? proven : estimate;
  const double margin = mesh.bound_kind == BoundKind::Proven ? 1 : sampled_margin;
  mesh.deflection_met = mesh.bound_mm <= options_.deflection_mm * margin;
}

// Largest distance between the boundary points and the surface: what no refinement of the face can remove.
double FaceMesher::boundary_gap(const FaceRefiner& refiner) const {
  double gap = 0;
  for (std::size_t i = 0; i < boundary_.point.size(); ++i)
    gap = std::max(gap, distance(refiner.vertices()[i].point, points_[boundary_.point[i]]));
  return gap;
}

void FaceMesher::curved(const Surface& surface, bool reversed, std::span<const SampledEdge> edges, bool may_draft, FaceResult& result) {
  Box box;
  for (const std::uint32_t p : boundary_.point) box.add(points_[p]);
  box.add(evaluate(surface, {boundary_.u.mid(), boundary_.v.mid()}));
  const double size = std::max(box.diagonal(), options_.deflection_mm);
  chart_ = make_chart(surface, boundary_.u, boundary_.v, size, options_.deflection_mm, options_.angle_rad);
  input_.clear();
  for (const Uv uv : boundary_.uv) input_.push_back(chart_.to_chart(uv));
  const std::vector<Uv> seeds = seed_points(chart_, input_, boundary_.segments, options_.max_triangles_per_face / 2);
  input_.insert(input_.end(), seeds.begin(), seeds.end());
  if (!triangulate(edges, &chart_, result)) return;

  const RefineLimits limits{options_.deflection_mm, options_.angle_rad, options_.max_triangles_per_face};
  std::unique_ptr<Certificate>& certificate = result.certificate;
  if (options_.prove && !(certificate && certificate->covers(boundary_.u, boundary_.v)))
    certificate = std::make_unique<Certificate>(surface, boundary_.u, boundary_.v);
  std::optional<FaceRefiner> attempt;
  attempt.emplace(surface, chart_, boundary_, points_, triangulation_, limits, certificate.get(), stop_);
  attempt->run(may_draft);
  if (attempt->gave_up() && !attempt->cancelled()) {
    if (!triangulation_.build(input_, boundary_.segments, &stop_)) return;
    triangulation_.classify(Inside::Odd);
    attempt.emplace(surface, chart_, boundary_, points_, triangulation_, limits, nullptr, stop_);
    attempt->run(false);
  }
  if (stop_.stopped()) return;
  const FaceRefiner& refiner = *attempt;
  result.is_draft = refiner.is_draft();
  Output output(surface, reversed, boundary_, triangulation_, face_vertex_, result);
  output.write([&](std::uint32_t v) -> const SurfaceVertex& { return refiner.vertices()[v]; }, stop_);

  FaceMesh& mesh = result.mesh;
  std::vector<Point> place;
  for (const FaceVertex& v : mesh.vertices)
    place.push_back(v.point < FaceResult::own_point ? points_[v.point] : result.own_points[v.point - FaceResult::own_point]);
  if (stop_.stopped()) return;
  const std::vector<std::uint32_t> turned = turn_back(mesh, place, surface, reversed, options_, stop_);
  if (stop_.stopped()) return;
  FaceCertifier certifier(body_, mesh, place, {options_.deflection_mm, 1.05, closer_look});
  double proven = refiner.is_proven() ? refiner.deviation_mm() : infinity;
  if (std::isfinite(proven)) proven = std::max(proven, certifier.around(*certificate, turned));
  if (std::isfinite(proven)) proven = std::max(proven, strips(certifier, *certificate, edges, result));
  for (const FaceRefiner::Coarse& coarse : refiner.coarse_constraints()) {
    const FaceBoundary::Chord& chord = boundary_.chords[coarse.constraint];
    if (chord.edge) result.coarse.push_back({chord.edge, chord.index, coarse.deviation_mm});
  }
  state_bound(proven, sampled_margin * (std::max(refiner.deviation_mm(), boundary_.edge_deviation_mm) + boundary_gap(refiner)), mesh);
  if (refiner.limit_reached()) add_reason(mesh, "the limit of triangles per face was reached before the deflection");
  if (mesh.triangles.size() > options_.max_triangles_per_face) {
    mesh.vertices.clear(), mesh.triangles.clear(), result.own_points.clear();
    add_reason(mesh, "the boundary alone needs more triangles than the limit per face");
  }
}

}  // namespace trimloop::mesh
