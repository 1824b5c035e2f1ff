#include "kernel/mesh/certify.h"

namespace trimloop::mesh {
namespace {

// How a curve over [s.lo, s.hi] strays from the chord a-b of its ends, in the parameter plane.
struct Bow {
  Uv along, across;            // unit
  double length, width = 0;    // of the chord; largest distance from its line
  bool is_over = false;        // it may reach beyond the ends

  Bow(Uv a, Uv b) : along(b - a), across{0, 0}, length(norm(along)) {
    if (!(length > 0)) return;
    along = (1 / length) * along;
    across = {-along.v, along.u};
  }
  void add_point(Uv from_a) {
    const double t = dot(from_a, along);
    width = std::max(width, std::abs(dot(from_a, across)));
    is_over = is_over || t < 0 || t > length;
  }
};

// From the poles of the second derivative: the curve is within s (1 - s) / 2 of them, times the interval squared. False where it has a corner.
bool add_bow(const NurbsCurve& c, Interval s, Uv a, Bow& bow) {
  if (c.is_rational() || !c.domain().contains(s.lo) || !c.domain().contains(s.hi)) return false;
  const std::vector<double>& knots = c.knots();
  const auto p = static_cast<std::size_t>(c.degree());
  const double slack = 1e-11 * s.length();
  const auto span = [&](double x) {
    const auto first = knots.begin() + static_cast<std::ptrdiff_t>(p) + 1, last = knots.begin() + static_cast<std::ptrdiff_t>(c.poles().size());
    return static_cast<std::size_t>(std::upper_bound(first, last, x) - knots.begin()) - 1;
  };
  const std::size_t first = span(s.lo + slack), last = std::max(first, span(s.hi - slack));
  const auto pole = [&](std::size_t i) { return Uv{c.poles()[i].x, c.poles()[i].y}; };
  if (p == 1) {
    for (std::size_t i = first; i < last; ++i) bow.add_point(pole(i) - a);
    return true;
  }
  double across = 0, along = 0;
  const auto slope = [&](std::size_t i) { return (static_cast<double>(p) / (knots[i + p + 1] - knots[i + 1])) * (pole(i + 1) - pole(i)); };
  for (std::size_t i = first - p; i + 2 <= last; ++i) {
    const double width = knots[i + p + 1] - knots[i + 2];
    if (!(width > 0)) return false;
    const Uv second = (static_cast<double>(p - 1) / width) * (slope(i + 1) - slope(i));
    across = std::max(across, std::abs(dot(second, bow.across))), along = std::max(along, std::abs(dot(second, bow.along)));
  }
  const double reach = 0.125 * s.length() * s.length();
  bow.width = reach * across;
  bow.is_over = !(4 * reach * along <= bow.length);
  return true;
}

// By smooth pieces: each is as far off as its ends and what its second derivative allows beyond that.
bool add_pieces(const Curve& curve, Interval s, Uv a, Bow& bow) {
  std::vector<double> cuts{s.lo};
  const double slack = 1e-11 * s.length();
  for (const double b : breaks(curve))
    if (b > s.lo + slack && b < s.hi - slack) cuts.push_back(b);
  cuts.push_back(s.hi);
  Uv from = a;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const Interval part{cuts[i], cuts[i + 1]};
    const Point p = evaluate(curve, part.hi);
    const Uv to{p.x, p.y};
    CurveBalls balls;
    if (!enclose(curve, part, balls)) return false;
    const Uv second{balls[2].centre.x, balls[2].centre.y};
    const double reach = 0.125 * part.length() * part.length(), run = dot(to - from, bow.along);
    const double ends = std::max(std::abs(dot(from - a, bow.across)), std::abs(dot(to - a, bow.across)));
    bow.width = std::max(bow.width, ends + reach * (std::abs(dot(second, bow.across)) + balls[2].radius));
    bow.is_over = bow.is_over || !(4 * reach * (std::abs(dot(second, bow.along)) + balls[2].radius) <= run);
    from = to;
  }
  return true;
}

bool add_bow(const Curve& curve, Interval s, Uv a, Bow& bow) {
  if (const auto* nurbs = std::get_if<NurbsCurve>(&curve.shape)) {
    Bow quick = bow;
    if (add_bow(*nurbs, s, a, quick)) {
      bow = quick;
      return true;
    }
  }
  if (const auto* line = std::get_if<Polyline>(&curve.shape)) {
    for (double i = std::floor(s.lo) + 1; i < s.hi && i < static_cast<double>(line->points.size()); ++i) {
      const Point p = line->points[static_cast<std::size_t>(std::max(i, 0.0))];
      bow.add_point(Uv{p.x, p.y} - a);
    }
    return true;
  }
  return add_pieces(curve, s, a, bow);
}

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
  std::array<std::size_t, 2> chord{};  // corners of the first facet
  at_side(a, b, [&](std::uint32_t triangle) {
    if (facets_.empty())
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t point = face_.vertices[face_.triangles[triangle][i]].point;
        if (point == a) chord[0] = i;
        if (point == b) chord[1] = i;
      }
    facets_.push_back(facet(triangle));
  });
  if (facets_.empty()) return infinity;
  const std::array<Uv, 2> ends{evaluate(coedge.pcurve, s0), evaluate(coedge.pcurve, s1)};
  Bow bow(ends[0], ends[1]);
  if (bow.length > 0 && add_bow(coedge.pcurve.curve, {s0, s1}, ends[0], bow) && !bow.is_over) {
    if (!(bow.width > 1e-13 * (std::abs(ends[0].u) + std::abs(ends[0].v) + bow.length))) return 0;
    const auto at_chord = [&](std::size_t i) { return facets_[0].corner[chord[i]]; };
    const double bound = certificate.beside_chord(ends, bow.width, facets_[0], {at_chord(0), at_chord(1)});
    if (bound <= aim_.enough_mm) return bound;
  }
  return strip_bound(certificate, coedge.pcurve.curve, {s0, s1}, ends, facets_, aim_);
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
