#include "kernel/mesh/certify.h"

namespace trimloop::mesh {
namespace {

// Bound for the strip between a curve in the parameter plane over [s.lo, s.hi] and the chord uv[0]-uv[1] of its ends.
double strip_bound(Certificate& certificate, const Curve& pcurve, Interval s, std::array<Uv, 2> uv, std::span<const Facet> facets,
                   const Certificate::Aim& aim) {
  std::vector<double> cuts{s.lo};
  const double slack = 1e-11 * s.length();
  for (const double b : breaks(pcurve))
    if (b > s.lo + slack && b < s.hi - slack) cuts.push_back(b);
  cuts.push_back(s.hi);
  double worst = 0;
  const auto cover = [&](const std::array<Uv, 3>& piece) { worst = std::max(worst, certificate.bound(piece, facets, aim)); };
  Uv a = uv[0];
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const bool is_last = i + 2 == cuts.size();
    const Point end = evaluate(pcurve, cuts[i + 1]);
    const Uv b = is_last ? uv[1] : Uv{end.x, end.y};
    if (i > 0) cover({uv[0], a, b});
    CurveBalls balls;
    const Interval part{cuts[i], cuts[i + 1]};
    if (!enclose(pcurve, part, balls)) return infinity;
    // p(s) lies within s (1 - s) / 2 length^2 p'' of the chord.
    const Uv along = b - a, second{balls[2].centre.x, balls[2].centre.y};
    const double length = norm(along), reach = part.length() * part.length() / 8;
    if (length > 0) {
      const Uv t = (1 / length) * along, n{-t.v, t.u};
      const double across = dot(second, n), lengthwise = std::abs(dot(second, t)) + balls[2].radius;
      const double lo = std::min(0.0, -reach * (across + balls[2].radius)), hi = std::max(0.0, -reach * (across - balls[2].radius));
      if (hi - lo > 1e-13 * (std::abs(a.u) + std::abs(a.v) + length)) {
        const double over = 4 * reach * lengthwise <= length ? 0 : reach * lengthwise;
        const Uv first = a - over * t, last = b + over * t;
        cover({first + lo * n, last + lo * n, last + hi * n});
        cover({first + lo * n, last + hi * n, first + hi * n});
      }
    } else {
      const double r = reach * (norm(second) + balls[2].radius);
      cover({a + Uv{-r, -r}, a + Uv{3 * r, -r}, a + Uv{-r, 3 * r}});
    }
    a = b;
  }
  return worst;
}

std::uint64_t side_key(std::uint64_t a, std::uint64_t b) { return std::min(a, b) << 32 | std::max(a, b); }

}  // namespace

std::vector<Pole> poles_of(const Body& body, const Face& face) {
  std::vector<Pole> poles;
  for (const LoopId loop : face.loops) {
    for (const Coedge& c : body[loop].coedges) {
      if (!body[c.edge].is_pole) continue;
      const Uv a = start_uv(body, c), b = end_uv(body, c);
      poles.push_back({body[body[c.edge].start].point, std::abs(a.u - b.u) > std::abs(a.v - b.v) ? PoleSide::AlongU : PoleSide::AlongV});
    }
  }
  return poles;
}

double FaceBounds::largest() const {
  double worst = beside_chords;
  for (const double b : triangle) worst = std::max(worst, b);
  return worst;
}

std::array<std::array<Uv, 3>, 2> fan_pieces(Uv apex, PoleSide side, Uv b, Uv c) {
  const auto on_pole = [&](Uv p) { return side == PoleSide::AlongU ? Uv{p.u, apex.v} : Uv{apex.u, p.v}; };
  return {{{on_pole(b), b, c}, {on_pole(b), c, on_pole(c)}}};
}

Facet FaceCertifier::facet(std::uint32_t t) const {
  const auto& v = face_.triangles[t];
  return {place_[v[0]], place_[v[1]], place_[v[2]]};
}

void FaceCertifier::index_sides() {
  if (!sides_.empty()) return;
  sides_.reserve(3 * face_.triangles.size());
  for (std::uint32_t t = 0; t < face_.triangles.size(); ++t) {
    const auto& v = face_.triangles[t];
    for (std::size_t i = 0; i < 3; ++i)
      sides_.push_back({side_key(face_.vertices[v[i]].point, face_.vertices[v[(i + 1) % 3]].point), t});
  }
  std::sort(sides_.begin(), sides_.end());
}

template <class Take>
void FaceCertifier::at_side(std::uint32_t a, std::uint32_t b, Take take) {
  index_sides();
  const std::uint64_t wanted = side_key(a, b);
  auto it = std::lower_bound(sides_.begin(), sides_.end(), std::pair{wanted, std::uint32_t{0}});
  for (; it != sides_.end() && it->first == wanted; ++it) take(it->second);
}

double FaceCertifier::triangle(Certificate& certificate, std::uint32_t t) {
  const auto& v = face_.triangles[t];
  facets_.assign(1, facet(t));
  for (std::size_t i = 0; i < 3; ++i) {
    at_side(face_.vertices[v[i]].point, face_.vertices[v[(i + 1) % 3]].point, [&](std::uint32_t other) {
      if (other != t) facets_.push_back(facet(other));
    });
  }
  const std::array<Uv, 3> uv{face_.vertices[v[0]].uv, face_.vertices[v[1]].uv, face_.vertices[v[2]].uv};
  const Pole* pole = nullptr;
  std::size_t apex = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (const Pole& p : poles_)
      if (distance(place_[v[i]], p.point) == 0) pole = &p, apex = i;
  if (!pole) return certificate.bound(uv, facets_, aim_);
  double worst = 0;
  for (const auto& piece : fan_pieces(uv[apex], pole->side, uv[(apex + 1) % 3], uv[(apex + 2) % 3]))
    worst = std::max(worst, certificate.bound(piece, facets_, aim_));
  return worst;
}

std::vector<double> FaceCertifier::triangles(Certificate& certificate) {
  std::vector<double> result;
  for (std::uint32_t t = 0; t < face_.triangles.size(); ++t) result.push_back(triangle(certificate, t));
  return result;
}

double FaceCertifier::around(Certificate& certificate, std::span<const std::uint32_t> changed) {
  std::vector<std::uint32_t> all;
  for (const std::uint32_t t : changed) {
    const auto& v = face_.triangles[t];
    for (std::size_t i = 0; i < 3; ++i)
      at_side(face_.vertices[v[i]].point, face_.vertices[v[(i + 1) % 3]].point, [&](std::uint32_t other) { all.push_back(other); });
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  double worst = 0;
  for (const std::uint32_t t : all) worst = std::max(worst, triangle(certificate, t));
  return worst;
}

double FaceCertifier::strip(Certificate& certificate, const Coedge& coedge, Interval t, std::uint32_t a, std::uint32_t b) {
  if (std::holds_alternative<Line>(coedge.pcurve.curve.shape)) return 0;
  double s0 = pcurve_parameter(coedge, body_[coedge.edge], t.lo), s1 = pcurve_parameter(coedge, body_[coedge.edge], t.hi);
  if (s1 < s0) std::swap(s0, s1);
  if (!(s1 > s0)) return 0;
  facets_.clear();
  at_side(a, b, [&](std::uint32_t triangle) { facets_.push_back(facet(triangle)); });
  if (facets_.empty()) return infinity;
  return strip_bound(certificate, coedge.pcurve.curve, {s0, s1}, {evaluate(coedge.pcurve, s0), evaluate(coedge.pcurve, s1)}, facets_, aim_);
}

std::vector<FaceBounds> certify(const Body& body, const BodyMesh& mesh, const Certificate::Aim& aim) {
  std::vector<const EdgePolyline*> edges(body.edges.size(), nullptr);
  for (const EdgePolyline& line : mesh.edges) edges[line.edge.index] = &line;
  std::vector<FaceBounds> result(mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const FaceMesh& face = mesh.faces[f];
    if (face.triangles.empty()) continue;
    Interval u{infinity, -infinity}, v{infinity, -infinity};
    std::vector<Point> place;
    for (const FaceVertex& x : face.vertices) {
      u = {std::min(u.lo, x.uv.u), std::max(u.hi, x.uv.u)};
      v = {std::min(v.lo, x.uv.v), std::max(v.hi, x.uv.v)};
      place.push_back(mesh.points[x.point]);
    }
    Certificate certificate(*body[face.face].surface, u, v);
    if (!certificate.proves()) continue;
    FaceCertifier certifier(body, face, place, aim);
    result[f].kind = BoundKind::Proven;
    result[f].triangle = certifier.triangles(certificate);
    for (const LoopId loop : body[face.face].loops) {
      for (const Coedge& c : body[loop].coedges) {
        const EdgePolyline* line = edges[c.edge.index];
        for (std::size_t i = 0; line && i + 1 < line->points.size(); ++i) {
          const double strip = certifier.strip(certificate, c, {line->parameters[i], line->parameters[i + 1]}, line->points[i], line->points[i + 1]);
          result[f].beside_chords = std::max(result[f].beside_chords, strip);
        }
      }
    }
  }
  return result;
}

}  // namespace trimloop::mesh
