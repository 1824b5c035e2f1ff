#include "kernel/mesh/face_refine.h"

#include "kernel/mesh/certify.h"
#include "kernel/mesh/distance.h"

namespace trimloop::mesh {
namespace {

constexpr double smallest_side = 0.3;      // of the deflection: shorter triangles are within it by size
constexpr int max_depth = 8;               // of halvings in a row for the sake of folds and turns
constexpr double least_height = 0.1;       // of the deflection: flatter triangles are not split to prove them
constexpr double nearest_to_side = 0.1;    // barycentric: a point nearer to a side goes to its middle
constexpr double fixed_share = 0.85;       // of the deflection: a boundary chord that takes more leaves too little for the rest
constexpr double tolerated_gap = 0.25;     // of the deflection: a larger gap between edge and surface is granted on top
constexpr double near_limit = 0.7;         // of the deflection
constexpr int closer_look_near = 3;        // halvings above that
constexpr int closer_look = 5;             // halvings of a triangle to prove it before it is split
constexpr int halvings_along = 5;          // before that, for ranges of derivatives
constexpr double cell_share = 0.35;         // of a triangle's extent: the cells of these
constexpr double sampled_share = 0.97;     // of the deflection, for samples when a proof follows
// A proof that wants more than this is given up, and the bound of the face is what samples say: surfaces that are noisy against their size.
constexpr std::size_t first_proof_triangles = 200;
constexpr double proof_growth = 1;         // triangles, as a share of those that samples asked for
constexpr std::size_t proof_pieces = 60;   // looked at, per triangle
constexpr double least_room = 1.5;         // see measure: nearer to a boundary chord than that a point would only make folds
constexpr double smallest_fold = 0.25;     // of the deflection
constexpr double smallest_fold_share = 0.005;  // of the longest side, for shapes below the deflection
constexpr double smallest_turn = 0.02;     // of the deflection: nor is the turn of the normal of any use there
constexpr double crease_side = 4;          // of the deflection: below, a turn that sits on one spot is a crease
constexpr double max_bow = 0.8;            // sideways bow of the surface over a side, as a share of the triangle's height
constexpr double doubt = 0.15;             // share of the estimate by which the centroid may contradict the quadratic

Uv between(Uv a, Uv b) { return {0.5 * (a.u + b.u), 0.5 * (a.v + b.v)}; }
Uv centroid(const std::array<Uv, 3>& q) {
  return {(q[0].u + q[1].u + q[2].u) / 3, (q[0].v + q[1].v + q[2].v) / 3};
}

int span_of(const std::vector<double>& breaks, double x) {
  if (breaks.size() <= 2) return 0;
  return static_cast<int>(std::upper_bound(breaks.begin() + 1, breaks.end() - 1, x) - breaks.begin());
}

// Lines of a grid that pass between three corners.
int lines_between(const std::array<int, 2>& a, const std::array<int, 2>& b, const std::array<int, 2>& c) {
  return std::max({a[0], b[0], c[0]}) - std::min({a[0], b[0], c[0]}) + std::max({a[1], b[1], c[1]}) - std::min({a[1], b[1], c[1]});
}

// h(l) = 4 (m0 l1 l2 + m1 l2 l0 + m2 l0 l1): the quadratic that vanishes at the corners and has the values m[i] at the
// middles of the sides opposite corner i. Its extremum inside the triangle, if there is one.
struct Extremum {
  double value = 0;
  std::array<double, 3> at{};
  bool inside = false;
};
Extremum extremum(const std::array<double, 3>& m) {
  Extremum e;
  const double k = m[2] - m[1] - m[0], det = 4 * m[0] * m[1] - k * k;
  if (!(det > 0)) return e;
  e.at[0] = m[0] * (2 * m[1] + k) / det;
  e.at[1] = m[1] * (2 * m[0] + k) / det;
  e.at[2] = 1 - e.at[0] - e.at[1];
  e.inside = e.at[0] > 0 && e.at[1] > 0 && e.at[2] > 0;
  e.value = 2 * (m[1] * e.at[0] + m[0] * e.at[1]);
  return e;
}

// Where the distance is largest as far as the sides tell, and not on a side that is fixed.
void aim(const std::array<SurfaceVertex, 3>& corner, const std::array<double, 3>& off, const std::array<bool, 3>& is_fixed,
         Uv& at) {
  at = centroid({corner[0].uv, corner[1].uv, corner[2].uv});
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i)
    if (!is_fixed[i] && std::abs(off[i]) > largest) largest = std::abs(off[i]), at = between(corner[(i + 1) % 3].uv, corner[(i + 2) % 3].uv);
}

}  // namespace

// What is known of the sides of one triangle; side i lies opposite corner i.
struct FaceRefiner::Sides {
  std::array<Point, 3> middle;   // S there
  std::array<Vector, 3> bow;     // from the middle of the chord
  std::array<double, 3> off{};   // of `middle` from the triangle's plane
  std::array<bool, 3> is_fixed{};  // constrained
};

FaceRefiner::FaceRefiner(const Surface& surface, const Chart& chart, const FaceBoundary& boundary, std::span<const Point> points,
                         Triangulation& triangulation, const RefineLimits& limits, Certificate* certificate,
                         StopCheck& stop)
    : surface_(surface), chart_(chart), boundary_(boundary), triangulation_(triangulation), limits_(limits), points_(points),
      certificate_(certificate && certificate->proves() ? certificate : nullptr), stop_(stop), breaks_u_(breaks_u(surface)), breaks_v_(breaks_v(surface)) {
  while (vertices_.size() < triangulation.points().size() && !stop.spend()) add_vertex();
}

SurfaceVertex FaceRefiner::surface_vertex(Uv uv, PoleSide pole) const {
  SurfaceVertex r;
  Vector du, dv;
  jet1(surface_, uv, r.point, du, dv);
  const Vector n = cross(du, dv);
  const double area = norm(n);
  r.normal = area > 1e-9 * norm(du) * norm(dv) ? n / area : normal(surface_, uv);
  r.uv = uv;
  r.place = r.point;
  r.span = {span_of(breaks_u_, uv.u), span_of(breaks_v_, uv.v)};
  r.cell = {span_of(chart_.u.from, uv.u), span_of(chart_.v.from, uv.v)};
  r.pole = pole;
  return r;
}

// The next of those that the triangulation has and we do not.
void FaceRefiner::add_vertex() {
  const std::size_t i = vertices_.size();
  const bool known = i < boundary_.uv.size();
  vertices_.push_back(surface_vertex(known ? boundary_.uv[i] : chart_.to_uv(triangulation_.points()[i]),
                                     known ? boundary_.pole[i] : PoleSide::None));
  if (known) vertices_.back().place = points_[boundary_.point[i]];
}

void FaceRefiner::enqueue(std::uint32_t t, bool is_same) {
  if (t >= stamp_.size()) {
    stamp_.resize(triangulation_.triangle_count(), 0);
    sides_.resize(triangulation_.triangle_count());
    verdict_.resize(triangulation_.triangle_count());
  }
  stamp_[t]++;
  if (!is_same) sides_[t] = {};
  verdict_[t] = {};
  const bool is_wanted = part_ != Part::Boundary || triangulation_.triangle(t).constrained != 0;
  if (is_wanted && triangulation_.is_inside(t)) queue_.push_back({t, stamp_[t]});
}

void FaceRefiner::run(bool is_draft) {
  if (cancelled()) return;
  for (std::uint32_t t = 0; t < triangulation_.triangle_count(); ++t) triangles_ += triangulation_.is_inside(t);
  share_ = certificate_ ? sampled_share : 1;
  work_off(Part::All);
  if (certificate_ && !cancelled()) {
    share_ = 1;
    most_triangles_ = first_proof_triangles + triangles_ + static_cast<std::size_t>(proof_growth * static_cast<double>(triangles_));
    most_pieces_ = certificate_->pieces() + proof_pieces * (triangles_ + first_proof_triangles);
    is_proving_ = true;
    certificate_->set_cells(cell_share * mean_extent());
    if (prove_flat()) return;
    work_off(is_draft ? Part::Boundary : Part::All);
    if (is_draft && is_proven() && !cancelled()) {
      collect_coarse();
      is_draft_ = !coarse_.empty();
      if (is_draft_) return;
      work_off(Part::Rest);
    }
  }
  for (std::uint32_t t = 0; t < triangulation_.triangle_count(); ++t)
    if (triangulation_.is_inside(t)) deviation_ = std::max(deviation_, verdict_[t].deviation);
  if (is_proven()) collect_coarse();
}

void FaceRefiner::collect_coarse() {
  coarse_.clear();
  for (std::uint32_t t = 0; t < triangulation_.triangle_count(); ++t) {
    if (!triangulation_.is_inside(t) || !verdict_[t].over) continue;
    for (int i = 0; i < 3; ++i)
      if (triangulation_.is_constrained(t, i)) coarse_.push_back({triangulation_.constraint_of(t, i), verdict_[t].deviation});
  }
}

// All triangles at once, where the face is nearly a plane.
bool FaceRefiner::prove_flat() {
  if (!triangulation_.crossings().empty()) return false;
  Vector n;
  double moved = 0;
  std::uint32_t corner = Triangulation::none;
  std::vector<std::array<Uv, 2>> border;
  for (std::uint32_t t = 0; t < triangulation_.triangle_count(); ++t) {
    if (!triangulation_.is_inside(t)) continue;
    const std::array<std::uint32_t, 3>& v = triangulation_.triangle(t).v;
    const SurfaceVertex &a = vertices_[v[0]], &b = vertices_[v[1]], &c = vertices_[v[2]];
    if (a.pole != PoleSide::None || b.pole != PoleSide::None || c.pole != PoleSide::None) return false;
    n += cross(b.point - a.point, c.point - a.point);
    corner = v[0];
    for (std::size_t i = 0; i < 3; ++i) {
      moved = std::max(moved, distance(vertices_[v[i]].point, vertices_[v[i]].place));
      if (triangulation_.is_constrained(t, static_cast<int>(i))) border.push_back({vertices_[v[(i + 1) % 3]].uv, vertices_[v[(i + 2) % 3]].uv});
    }
  }
  if (corner == Triangulation::none || !(norm(n) > 0)) return false;
  const double limit = limits_.deflection_mm - moved, bound = certificate_->flat_bound(normalized(n), vertices_[corner].point, border, limit);
  if (!(bound <= limit)) return false;
  deviation_ = bound + moved;
  return true;
}

// Of the inside triangles, in the parameter plane.
Uv FaceRefiner::mean_extent() const {
  Uv sum{0, 0};
  for (std::uint32_t t = 0; t < triangulation_.triangle_count(); ++t) {
    if (!triangulation_.is_inside(t)) continue;
    const auto& v = triangulation_.triangle(t).v;
    const Uv a = vertices_[v[0]].uv, b = vertices_[v[1]].uv, c = vertices_[v[2]].uv;
    sum = sum + Uv{std::max({a.u, b.u, c.u}) - std::min({a.u, b.u, c.u}), std::max({a.v, b.v, c.v}) - std::min({a.v, b.v, c.v})};
  }
  return (1 / static_cast<double>(std::max<std::size_t>(triangles_, 1))) * sum;
}

// Measures all triangles, and those that come of splitting.
void FaceRefiner::work_off(Part part) {
  queue_.clear();
  part_ = part;
  for (std::uint32_t t = 0; t < triangulation_.triangle_count(); ++t)
    if (part != Part::Rest || !verdict_[t].known) enqueue(t, is_proving_);
  std::size_t pieces = certificate_ ? certificate_->pieces() : 0;
  for (std::size_t head = 0; head < queue_.size(); ++head) {
    if (stop_.spend(1 + (certificate_ ? certificate_->pieces() - pieces : 0))) return;
    if (certificate_) pieces = certificate_->pieces();
    const Entry entry = queue_[head];
    if (stamp_[entry.triangle] != entry.stamp) continue;
    const Finding finding = measure(entry.triangle);
    if (unprovable_ && is_proving_) return;
    verdict_[entry.triangle] = {finding.deviation, finding.leans, finding.deviation > finding.limit, true};
    if (!finding.split) continue;
    if (triangles_ + 2 > limits_.max_triangles) {
      limit_reached_ = true;
      continue;
    }
    if (is_proving_ && (triangles_ > most_triangles_ || certificate_->pieces() > most_pieces_)) {
      unprovable_ = true;
      return;
    }
    if (insert(entry.triangle, finding)) triangles_ += 2;
  }
}

bool FaceRefiner::insert(std::uint32_t triangle, const Finding& finding) {
  const std::array<std::uint32_t, 3> v = triangulation_.triangle(triangle).v;
  const int depth = std::max({vertices_[v[0]].depth, vertices_[v[1]].depth, vertices_[v[2]].depth}) + finding.by_shape;
  if (finding.by_shape && depth > max_depth) return false;
  touched_.clear();
  std::uint32_t vertex = triangulation_.insert(chart_.to_chart(finding.at), triangle, touched_);
  if (vertex == Triangulation::none) {
    const std::vector<Uv>& p = triangulation_.points();
    touched_.clear();
    vertex = triangulation_.insert(centroid({p[v[0]], p[v[1]], p[v[2]]}), triangle, touched_);
  }
  if (vertex == Triangulation::none) return false;
  add_vertex();
  vertices_[vertex].depth = depth;
  for (const std::uint32_t t : touched_) enqueue(t, false);
  for (const std::uint32_t t : touched_) {  // what was proven with the help of triangles that are gone
    for (const std::uint32_t n : triangulation_.triangle(t).n)
      if (n < verdict_.size() && verdict_[n].leans) enqueue(n, true);
  }
  return true;
}

// Points are put where the chart says, whose triangles never turn over.
Uv FaceRefiner::half_way(Uv a, Uv b) const {
  return is_proven() ? between(a, b) : chart_.to_uv(between(chart_.to_chart(a), chart_.to_chart(b)));
}

const Point& FaceRefiner::side_middle(std::uint32_t t, int i, Uv a, Uv b) {
  Side& side = sides_[t][i];
  if (side.known) return side.middle;
  const std::uint32_t other = triangulation_.triangle(t).n[i];
  if (other < sides_.size()) {
    const auto& back = triangulation_.triangle(other).n;
    for (std::size_t k = 0; k < 3; ++k)
      if (back[k] == t && sides_[other][k].known) return side = sides_[other][k], side.middle;
  }
  side = {evaluate(surface_, certificate_ ? between(a, b) : half_way(a, b)), true};
  return side.middle;
}

Facet FaceRefiner::facet_of(std::uint32_t t) const {
  const auto& v = triangulation_.triangle(t).v;
  return {vertices_[v[0]].place, vertices_[v[1]].place, vertices_[v[2]].place};
}

FaceRefiner::Finding FaceRefiner::measure(std::uint32_t t) {
  const Triangulation::Triangle triangle = triangulation_.triangle(t);
  std::array<SurfaceVertex, 3> corner;
  std::array<bool, 3> moved{};  // poles, to the middle of their fan triangle
  Uv to_pole;                   // half-way from the pole to the opposite side
  for (std::size_t i = 0; i < 3; ++i) corner[i] = vertices_[triangle.v[i]];
  double gap = 0;               // between the boundary's points and the surface
  for (std::size_t i = 0; i < 3; ++i) {
    gap = std::max(gap, distance(corner[i].point, corner[i].place));
    if (corner[i].pole == PoleSide::None) continue;
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    if (corner[j].pole != PoleSide::None || corner[k].pole != PoleSide::None) return {};  // nothing but the pole
    const Uv middle = half_way(corner[j].uv, corner[k].uv);
    Uv uv = corner[i].uv;
    (corner[i].pole == PoleSide::AlongU ? uv.u : uv.v) = corner[i].pole == PoleSide::AlongU ? middle.u : middle.v;
    const Point place = corner[i].place;
    corner[i] = surface_vertex(uv, corner[i].pole);
    corner[i].place = place;
    moved[i] = true;
    to_pole = between(uv, middle);
  }
  // A sampled distance leaves out the gap, which is added at the end.
  const Facet facet = is_proven() ? Facet(corner[0].place, corner[1].place, corner[2].place)
                                  : Facet(corner[0].point, corner[1].point, corner[2].point);

  Finding finding;
  const double eps = limits_.deflection_mm;
  finding.limit = !is_proven() ? share_ * eps : gap <= tolerated_gap * eps ? eps : eps + gap;  // no refinement of the face can remove it
  Sides sides;
  double room = infinity;       // least height over a boundary chord, as a multiple of the chord's own bow
  double longest2 = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const SurfaceVertex &a = corner[(i + 1) % 3], &b = corner[(i + 2) % 3];
    const bool is_shared = !moved[(i + 1) % 3] && !moved[(i + 2) % 3];
    sides.middle[i] = is_shared ? side_middle(t, static_cast<int>(i), a.uv, b.uv) : evaluate(surface_, half_way(a.uv, b.uv));
    sides.bow[i] = sides.middle[i] - midpoint(a.point, b.point);
    sides.off[i] = facet.is_needle() ? distance(sides.middle[i], facet) : dot(sides.middle[i] - facet.corner[0], facet.normal);
    sides.is_fixed[i] = (triangle.constrained >> i & 1) != 0;
    const Vector edge = b.point - a.point;
    longest2 = std::max(longest2, dot(edge, edge));
    const double off_chord = norm(cross(sides.bow[i], edge));
    if (sides.is_fixed[i] && off_chord > 0) room = std::min(room, facet.area / off_chord);
  }
  if (!is_proven()) {
    sample(corner, facet, sides, finding);
  } else if (moved[0] || moved[1] || moved[2]) {
    prove_fan(corner, facet, finding);
  } else {
    prove(t, corner, facet, sides, finding);
  }
  if (is_proven() && !(finding.deviation < infinity)) {  // nothing is known there, for weights or overflow
    unprovable_ = true;
    return finding;
  }

  if (room < least_room) return finding;
  if (finding.is_stuck) return finding;
  if (is_proven() && finding.deviation > finding.limit) {
    double fixed = 0, open = 0;
    for (std::size_t i = 0; i < 3; ++i) (sides.is_fixed[i] ? fixed : open) = std::max(sides.is_fixed[i] ? fixed : open, std::abs(sides.off[i]));
    if (fixed > fixed_share * finding.limit && open <= finding.limit) return finding;  // the boundary's chord must be halved
  }
  finding.split = finding.deviation > finding.limit && longest2 > smallest_side * smallest_side * eps * eps;
  // Slivers beside a chord of the boundary that is too long: only its halves would help.
  if (is_proven() && facet.area < least_height * eps * std::sqrt(longest2)) return finding.split = false, finding;
  if (moved[0] || moved[1] || moved[2]) {  // one point per fan triangle: together a new ring around the pole
    finding.at = to_pole;
    return finding;
  }
  if (room < 2 * least_room) return finding;
  if (finding.split) return finding;
  finding.by_shape = (!facet.is_needle() && folds(triangle, corner, sides, facet.normal, finding)) ||
                     turns_too_far(triangle, corner, finding);
  finding.split = finding.by_shape;
  return finding;
}

void FaceRefiner::prove(std::uint32_t t, const std::array<SurfaceVertex, 3>& corner, const Facet& facet, const Sides& sides,
                        Finding& finding) {
  const std::array<Uv, 3> uv{corner[0].uv, corner[1].uv, corner[2].uv};
  aim(corner, sides.off, sides.is_fixed, finding.at);
  const SurfacePiece piece{uv, {corner[0].point, corner[1].point, corner[2].point}, sides.middle};
  if (!certificate_->crosses_crease(uv)) {
    // The facets of the points on the surface: those of the mesh are as far off as its points are.
    const Facet own(corner[0].point, corner[1].point, corner[2].point);
    std::array<Facet, 3> beside;
    std::array<const Facet*, 3> neighbours{};
    double moved = 0;
    for (const SurfaceVertex& c : corner) moved = std::max(moved, distance(c.point, c.place));
    for (std::size_t i = 0; i < 3; ++i) {
      if (sides.is_fixed[i]) continue;
      const auto& v = triangulation_.triangle(triangulation_.triangle(t).n[i]).v;
      for (const std::uint32_t x : v) moved = std::max(moved, distance(vertices_[x].point, vertices_[x].place));
      beside[i] = {vertices_[v[0]].point, vertices_[v[1]].point, vertices_[v[2]].point};
      neighbours[i] = &beside[i];
    }
    finding.leans = neighbours[0] || neighbours[1] || neighbours[2];
    finding.deviation = certificate_->look_along(piece, own, neighbours, finding.limit - moved, halvings_along) + moved;
    if (finding.deviation <= finding.limit) return;
    const Certificate::Estimate e = certificate_->estimate(piece, own, neighbours);
    const bool on_side = std::min({e.at[0], e.at[1], e.at[2]}) < nearest_to_side;
    if (!on_side && e.is_measured) finding.at = e.at[0] * uv[0] + e.at[1] * uv[1] + e.at[2] * uv[2];
    finding.deviation = e.bound + moved;
    if (finding.deviation <= finding.limit || (e.is_measured && e.likely > finding.limit && !on_side)) return;
    for (std::size_t i = 0; i < 3; ++i)
      if (!sides.is_fixed[i] && std::abs(sides.off[i]) > finding.limit) return;
  }
  finding.leans = true;
  facets_.assign(1, facet);
  for (const std::uint32_t n : triangulation_.triangle(t).n)
    if (triangulation_.is_inside(n)) facets_.push_back(facet_of(n));
  // A triangle that nearly takes the deflection is sooner split than proven.
  const bool is_near = std::max({std::abs(sides.off[0]), std::abs(sides.off[1]), std::abs(sides.off[2])}) > near_limit * finding.limit;
  finding.deviation = certificate_->bound(piece, facets_, {finding.limit, 0, is_near ? closer_look_near : closer_look});
  if (finding.deviation <= finding.limit) return;
  const std::size_t i = certificate_->hardest_side(uv);
  if (sides.is_fixed[i]) finding.is_stuck = true;
  else finding.at = between(uv[(i + 1) % 3], uv[(i + 2) % 3]);
}

void FaceRefiner::prove_fan(const std::array<SurfaceVertex, 3>& corner, const Facet& facet, Finding& finding) {
  const std::size_t i = corner[0].pole != PoleSide::None ? 0 : corner[1].pole != PoleSide::None ? 1 : 2;
  for (const auto& piece : fan_pieces(corner[i].uv, corner[i].pole, corner[(i + 1) % 3].uv, corner[(i + 2) % 3].uv))
    finding.deviation = std::max(finding.deviation, certificate_->bound(piece, {&facet, 1}, {finding.limit, 0, closer_look}));
}

void FaceRefiner::sample(const std::array<SurfaceVertex, 3>& corner, const Facet& facet, const Sides& sides, Finding& finding) {
  const double eps = finding.limit;
  finding.deviation = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double off = std::abs(sides.off[i]);
    if (sides.is_fixed[i]) {
      finding.deviation = std::max(finding.deviation, std::min(off, eps));
    } else if (off > finding.deviation) {
      finding.deviation = off, finding.at = half_way(corner[(i + 1) % 3].uv, corner[(i + 2) % 3].uv);
    }
  }
  const Extremum top = facet.is_needle() ? Extremum{} : extremum(sides.off);
  if (top.inside && std::abs(top.value) > finding.deviation) {
    finding.deviation = std::abs(top.value);
    finding.at = top.at[0] * corner[0].uv + top.at[1] * corner[1].uv + top.at[2] * corner[2].uv;
  }
  if (certificate_) return;  // the proof sees the rest
  const Uv c = chart_.to_uv(centroid({chart_.to_chart(corner[0].uv), chart_.to_chart(corner[1].uv), chart_.to_chart(corner[2].uv)}));
  const Point p = evaluate(surface_, c);
  const double at_centroid = facet.is_needle() ? distance(p, facet) : dot(p - facet.corner[0], facet.normal);
  const double contradiction = std::abs(at_centroid - 4.0 / 9 * (sides.off[0] + sides.off[1] + sides.off[2]));
  if (std::abs(at_centroid) > finding.deviation || finding.deviation == 0) finding.deviation = std::abs(at_centroid), finding.at = c;
  finding.deviation += 0.5 * contradiction;
  const int lines = lines_between(corner[0].span, corner[1].span, corner[2].span);
  const bool bent = lines > 0 || lines_between(corner[0].cell, corner[1].cell, corner[2].cell) > 0;
  const bool doubtful = contradiction > doubt * std::max(finding.deviation, 0.3 * eps) ||
                        (bent && finding.deviation > 0.6 * eps);
  if (!facet.is_needle() && finding.deviation <= eps && (lines > 1 || doubtful))
    look_closer(corner, facet, std::clamp(lines + 2, 4, 10), finding);
}

// Samples a barycentric grid of the triangle, without its corners.
void FaceRefiner::look_closer(const std::array<SurfaceVertex, 3>& corner, const Facet& facet, int points_per_side, Finding& finding) const {
  const double step = 1.0 / points_per_side;
  for (int i = 0; i <= points_per_side; ++i) {
    for (int j = 0; i + j <= points_per_side; ++j) {
      const int k = points_per_side - i - j;
      if (std::max({i, j, k}) == points_per_side) continue;
      const Uv at = (i * step) * corner[0].uv + (j * step) * corner[1].uv + (k * step) * corner[2].uv;
      const double off = std::abs(dot(evaluate(surface_, at) - facet.corner[0], facet.normal));
      if (off > finding.deviation) finding.deviation = off, finding.at = at;
    }
  }
}

// A triangle that lies near its plane and still does not stand for its piece of surface: it looks the other way, or the
// surface over one of its sides bows sideways by more than the triangle is high. Folds much smaller than the deflection
// are left: beside the boundary, whose chords bow themselves, no point inside can remove them.
bool FaceRefiner::folds(const Triangulation::Triangle& triangle, const std::array<SurfaceVertex, 3>& corner, const Sides& sides,
                        Vector n, Finding& finding) const {
  const double size = std::max({norm(corner[1].point - corner[0].point), norm(corner[2].point - corner[1].point),
                                norm(corner[0].point - corner[2].point)});
  const double smallest = std::min(smallest_fold * limits_.deflection_mm, smallest_fold_share * size);
  const bool turned_over = dot(n, corner[0].normal + corner[1].normal + corner[2].normal) < 0;
  double longest = 0, shortest_height = infinity;
  std::size_t side = 3;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector along = corner[(i + 2) % 3].point - corner[(i + 1) % 3].point;
    const double length = norm(along), height = norm(cross(along, corner[i].point - corner[(i + 1) % 3].point)) / length;
    const double sideways = std::abs(dot(sides.bow[i], cross(n, along))) / length;
    shortest_height = std::min(shortest_height, height);
    const bool bows_over = sideways > smallest && sideways > max_bow * height;
    if (!(triangle.constrained >> i & 1) && (turned_over || bows_over) && length > longest) longest = length, side = i;
  }
  if (side == 3 || (turned_over && shortest_height < smallest)) return false;
  finding.at = half_way(corner[(side + 1) % 3].uv, corner[(side + 2) % 3].uv);
  return true;
}

// The turn of the normal along the sides that may still be cut. A turn that does not halve with the side sits on a
// crease or a singular point and is followed only down to `crease_side`.
bool FaceRefiner::turns_too_far(const Triangulation::Triangle& triangle, const std::array<SurfaceVertex, 3>& corner,
                                Finding& finding) const {
  const double limit = std::cos(std::min(limits_.angle_rad * (1 + 1e-6), pi));
  double worst = limit;
  std::size_t side = 3;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector here = corner[(i + 1) % 3].normal, there = corner[(i + 2) % 3].normal;
    if (dot(here, here) == 0 || dot(there, there) == 0) continue;  // the surface has no normal there
    const double turn = dot(here, there);
    if (!(triangle.constrained >> i & 1) && turn < worst) worst = turn, side = i;
  }
  if (side == 3) return false;
  const SurfaceVertex &a = corner[(side + 1) % 3], &b = corner[(side + 2) % 3];
  const double length = distance(a.point, b.point);
  if (length < smallest_turn * limits_.deflection_mm) return false;
  const Uv middle = half_way(a.uv, b.uv);
  const SurfaceVertex m = surface_vertex(middle, PoleSide::None);
  const bool even = std::min(dot(a.normal, m.normal), dot(m.normal, b.normal)) > worst + 0.25 * (1 - worst);
  if (!even && length < crease_side * limits_.deflection_mm) return false;
  finding.at = middle;
  return true;
}

}  // namespace trimloop::mesh
