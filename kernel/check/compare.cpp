#include "kernel/check/compare.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "kernel/check/measure.h"
#include "kernel/pcurve/lift.h"
#include "kernel/mesh/tessellate.h"
#include "kernel/topology/parameter_box.h"

namespace trimloop {

namespace {

// Of a similarity.
Transform inverse(const Transform& t) {
  const double s2 = scale_factor(t) * scale_factor(t);
  Transform out;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) out.r[i][j] = t.r[j][i] / s2;
  }
  out.t = -apply(out, t.t);
  return out;
}

// A face of a part in the part's own coordinates: what does not depend on the occurrence.
struct FaceSamples {
  std::vector<Point> inside;            // on the surface
  std::vector<Point> border;            // on the edges
  struct BorderEdge {
    CurvePtr curve;
    std::vector<Point> points;      // along it
    std::vector<double> parameters;
  };
  std::vector<BorderEdge> edges;
  Point centre;
  double area = 0, border_length = 0, extent = 0;
  bool usable = false;
};

// Every n-th, so that about `wanted` remain.
template <class T>
std::vector<T> thinned(const std::vector<T>& all, std::size_t wanted) {
  std::vector<T> out;
  const std::size_t step = std::max<std::size_t>(1, all.size() / wanted);
  for (std::size_t i = 0; i < all.size(); i += step) out.push_back(all[i]);
  return out;
}

class BodySampler {
 public:
  BodySampler(const Body& body, const mesh::BodyMesh& mesh, double lift_mm) : body_(body), mesh_(mesh), lift_mm_(lift_mm) {
    for (const mesh::EdgePolyline& p : mesh.edges) polylines_[p.edge.index] = &p;
  }

  FaceSamples sample(std::size_t f) {
    FaceSamples out;
    const Face& face = body_.faces[f];
    const mesh::FaceMesh& triangles = mesh_.faces[f];
    if (face.status == FaceStatus::Failed || triangles.triangles.empty()) return out;
    out.usable = true;
    out.area = area(body_, FaceId{static_cast<std::uint32_t>(f)}).value;
    std::vector<Point> vertices;
    for (const mesh::FaceVertex& v : triangles.vertices) vertices.push_back(evaluate(*face.surface, v.uv));
    Vector sum;
    double weight = 0;
    for (const auto& t : triangles.triangles) {
      const Point a = vertices[t[0]], b = vertices[t[1]], c = vertices[t[2]];
      const double w = norm(cross(b - a, c - a));
      sum += w / 3 * (to_vector(a) + to_vector(b) + to_vector(c));
      weight += w;
    }
    out.centre = weight > 0 ? to_point(sum / weight) : vertices.front();
    for (const Point& p : vertices) out.extent = std::max(out.extent, distance(p, out.centre));
    for (const auto& t : thinned(triangles.triangles, 16)) {  // middles of triangles, on the surface
      const Uv a = triangles.vertices[t[0]].uv, b = triangles.vertices[t[1]].uv, c = triangles.vertices[t[2]].uv;
      out.inside.push_back(evaluate(*face.surface, 1.0 / 3 * (a + b + c)));
    }
    add_border(face, out);
    return out;
  }

 private:
  void add_border(const Face& face, FaceSamples& out) {
    for (const LoopId id : face.loops) {
      for (const Coedge& c : body_[id].coedges) {
        const auto found = polylines_.find(c.edge.index);
        if (found == polylines_.end() || body_[c.edge].is_pole) continue;
        const CurvePtr curve = curve_of(face, c);
        if (!curve) continue;
        FaceSamples::BorderEdge& edge = out.edges.emplace_back();
        edge.curve = curve;
        edge.parameters = found->second->parameters;
        for (const std::uint32_t i : found->second->points) {
          if (!edge.points.empty()) out.border_length += distance(edge.points.back(), mesh_.points[i]);
          edge.points.push_back(mesh_.points[i]);
        }
        // On the curve itself, between its ends.
        for (const double s : {0.0, 0.3, 0.55, 0.8}) out.border.push_back(evaluate(*curve, body_[c.edge].range.at(s)));
      }
    }
    out.border = thinned(out.border, 24);
  }

  CurvePtr curve_of(const Face& face, const Coedge& c) {
    if (body_[c.edge].curve) return body_[c.edge].curve;
    CurvePtr& known = lifted_[c.edge.index];
    if (!known) {
      auto lifted = pcurve::lift(*face.surface, c.pcurve, body_[c.edge].range, lift_mm_);
      if (lifted) known = lifted->curve;
    }
    return known;
  }

  const Body& body_;
  const mesh::BodyMesh& mesh_;
  double lift_mm_;
  std::map<std::uint32_t, const mesh::EdgePolyline*> polylines_;
  std::map<std::uint32_t, CurvePtr> lifted_;
};

struct PlacedFace {
  FacePlace place;
  const Body* body;
  const FaceSamples* own;
  Transform to_world, to_part;
  double scale = 1;
  Point centre;
  double area = 0, extent = 0;
  std::string name;
  std::optional<Colour> colour;
  bool matched = false;
};

struct PlacedCurve {
  const Curve* curve;
  Transform to_world, to_part;
  double scale = 1, length = 0;
  Point middle;
  bool matched = false;
};

struct Side {
  std::vector<std::vector<FaceSamples>> samples;  // of each body of each part, by face; bodies in order
  std::vector<PlacedFace> faces;
  std::vector<PlacedCurve> curves;
  std::vector<Point> points;
  std::size_t failed = 0;
};

Result<Side> prepare(const Model& model, const CompareOptions& options) {
  Side side;
  const Limits& limits = options.execution.limits;
  const auto places = occurrences(model, limits.instances, limits.nesting_depth);
  if (!places) return tl::unexpected(places.error());
  std::vector<std::size_t> first_body;
  for (const Part& part : model.parts) {
    first_body.push_back(side.samples.size());
    for (const Body& body : part.bodies) {
      // Fine enough for the smallest face: its centre must not depend on how its surface is parametrized.
      Box box;
      double smallest = infinity;
      for (const Face& f : body.faces) {
        if (f.status == FaceStatus::Failed || !f.surface) continue;
        const ParameterBox used = parameter_box(body, f);
        if (!(used.u.lo <= used.u.hi)) continue;
        const Box own = bounding_box(*f.surface, used.u, used.v);
        box.add(own);
        if (own.diagonal() > 0) smallest = std::min(smallest, own.diagonal());
      }
      mesh::TessellationOptions coarse;
      coarse.deflection_mm = std::max(std::clamp(0.02 * smallest, 2e-4 * box.diagonal(), 0.02 * box.diagonal()), 1e-6);
      coarse.angle_rad = pi / 6;
      const auto mesh = mesh::tessellate(body, coarse, options.execution);
      if (!mesh) return tl::unexpected(mesh.error());
      BodySampler sampler(body, *mesh, 0.1 * options.tolerance_mm);
      std::vector<FaceSamples>& own = side.samples.emplace_back();
      for (std::size_t f = 0; f < body.faces.size(); ++f) own.push_back(sampler.sample(f));
    }
  }
  for (std::uint32_t o = 0; o < places->size(); ++o) {
    const Occurrence& at = (*places)[o];
    const Part& part = model.parts[at.part];
    const Transform back = inverse(at.transform);
    const double scale = scale_factor(at.transform);
    for (std::uint32_t b = 0; b < part.bodies.size(); ++b) {
      const Body& body = part.bodies[b];
      for (std::uint32_t f = 0; f < body.faces.size(); ++f) {
        const FaceSamples& own = side.samples[first_body[at.part] + b][f];
        if (!own.usable) {
          ++side.failed;
          continue;
        }
        PlacedFace p{{o, at.part, b, FaceId{f}}, &body, &own, at.transform, back, scale, apply(at.transform, own.centre),
                     own.area * scale * scale, own.extent * scale, {}, {}};
        const Attributes &of_face = model[body.faces[f].attributes], &of_body = model[body.attributes];
        p.name = !of_face.name.empty() ? of_face.name : of_body.name;
        p.colour = of_face.colour ? of_face.colour : of_body.colour;
        side.faces.push_back(std::move(p));
      }
    }
    for (const FreeCurve& c : part.curves) {
      if (!is_bounded(c.curve)) continue;
      const Point middle = evaluate(c.curve, range(c.curve).mid());
      side.curves.push_back({&c.curve, at.transform, back, scale, length(c.curve) * scale, apply(at.transform, middle)});
    }
    for (const FreePoint& p : part.points) side.points.push_back(apply(at.transform, p.point));
  }
  return side;
}

struct NearEdge {
  double chord = infinity;  // distance from the polyline
  double t = 0;
  const Curve* curve = nullptr;
};

NearEdge near_edge(Point q, const FaceSamples::BorderEdge& e) {
  NearEdge out;
  out.curve = e.curve.get();
  for (std::size_t i = 0; i + 1 < e.points.size(); ++i) {
    const Vector along = e.points[i + 1] - e.points[i];
    const double length2 = dot(along, along);
    const double s = length2 > 0 ? std::clamp(dot(q - e.points[i], along) / length2, 0.0, 1.0) : 0;
    const double d = distance(q, e.points[i] + s * along);
    if (d < out.chord) out.chord = d, out.t = e.parameters[i] + s * (e.parameters[i + 1] - e.parameters[i]);
  }
  return out;
}

// Distance from the border; what is within `enough` need not be exact. The three edges nearest by their chords are asked.
double to_border(Point q, const FaceSamples& face, double enough) {
  std::vector<NearEdge> near;
  for (const FaceSamples::BorderEdge& e : face.edges) near.push_back(near_edge(q, e));
  std::sort(near.begin(), near.end(), [](const NearEdge& x, const NearEdge& y) { return x.chord < y.chord; });
  near.resize(std::min<std::size_t>(near.size(), 3));
  double d = infinity;
  for (const NearEdge& e : near) d = std::min(d, closest_point_near(*e.curve, q, e.t).distance);
  for (std::size_t i = 0; i < near.size() && d > enough; ++i) d = std::min(d, closest_point(*near[i].curve, q).distance);
  return d;
}

// Largest distance of the samples of `from` from the face `to`; stops early above `enough`.
double one_way(const PlacedFace& from, const PlacedFace& to, double enough) {
  const Surface& surface = *to.body->faces[to.place.face.index].surface;
  const ParameterBox box = parameter_box(*to.body, to.body->faces[to.place.face.index]);
  const Transform across = to.to_part * from.to_world;
  double worst = 0;
  std::optional<Uv> near;
  for (const Point& p : from.own->inside) {
    const Point q = apply(across, p);
    double d = infinity;
    if (near) d = closest_point_near(surface, q, *near).distance;
    if (!(d * to.scale <= worst)) {
      const SurfaceFoot foot = closest_point(surface, q, box.u, box.v);
      if (foot.distance < d) d = foot.distance, near = foot.uv;
    }
    worst = std::max(worst, d * to.scale);
    if (worst > enough) return worst;
  }
  for (const Point& p : from.own->border) {
    const Point q = apply(across, p);
    if (to.own->edges.empty()) break;  // a face that has poles alone
    worst = std::max(worst, to_border(q, *to.own, worst / to.scale) * to.scale);
    if (worst > enough) return worst;
  }
  return worst;
}

double deviation(const PlacedFace& a, const PlacedFace& b, double enough) {
  return std::max(one_way(a, b, enough), one_way(b, a, enough));
}

bool same_colour(const std::optional<Colour>& a, const std::optional<Colour>& b) {
  constexpr double step = 1.0 / 512;  // half a step of 8 bits
  if (a.has_value() != b.has_value()) return false;
  return !a || (std::abs(a->r - b->r) <= step && std::abs(a->g - b->g) <= step && std::abs(a->b - b->b) <= step);
}

class FaceMatcher {
 public:
  FaceMatcher(Side& a, Side& b, const CompareOptions& options, Comparison& out)
      : a_(a), b_(b), options_(options), out_(out), by_x_(b.faces.size()) {
    std::iota(by_x_.begin(), by_x_.end(), 0u);
    std::stable_sort(by_x_.begin(), by_x_.end(),
                     [&](std::uint32_t i, std::uint32_t j) { return b.faces[i].centre.x < b.faces[j].centre.x; });
    pair_.assign(a.faces.size(), {});
  }

  void run() {
    match(1e-4, options_.tolerance_mm, Difference::Same);
    match(1, infinity, Difference::Changed);
    match_moved();
    for (std::size_t i = 0; i < a_.faces.size(); ++i) {
      if (!pair_[i].first) pair_[i] = found(&a_.faces[i], nullptr, Difference::OnlyFirst, 0);
      out_.faces.push_back(pair_[i]);
    }
    for (PlacedFace& f : b_.faces) {
      if (!f.matched) out_.faces.push_back(found(nullptr, &f, Difference::OnlySecond, 0));
    }
    std::optional<std::size_t> before;
    for (std::size_t i = 0; i < a_.faces.size(); ++i) {
      if (!partner_.count(i)) continue;
      out_.reordered = out_.reordered || (before && partner_[i] < *before);
      before = partner_[i];
    }
  }

 private:
  static FacePair found(const PlacedFace* a, const PlacedFace* b, Difference d, double deviation_mm) {
    FacePair p;
    p.difference = d;
    p.deviation_mm = deviation_mm;
    if (a) p.first = a->place, p.area_first_mm2 = a->area;
    if (b) p.second = b->place, p.area_second_mm2 = b->area;
    if (a && b) {
      p.renamed = a->name != b->name;
      p.recoloured = !same_colour(a->colour, b->colour);
    }
    return p;
  }

  // Pairs whose centres are within a share of their size and whose deviation is within `limit`, the nearest first.
  void match(double area_share, double limit, Difference kind) {
    for (std::size_t i = 0; i < a_.faces.size(); ++i) {
      PlacedFace& f = a_.faces[i];
      if (f.matched || options_.execution.stop.stop_requested()) continue;
      const double reach = 0.1 * f.extent + options_.tolerance_mm;
      const auto from = std::lower_bound(by_x_.begin(), by_x_.end(), f.centre.x - reach,
                                         [&](std::uint32_t j, double x) { return b_.faces[j].centre.x < x; });
      double best = std::min(limit, 0.25 * f.extent);
      std::optional<std::size_t> chosen;
      for (auto it = from; it != by_x_.end() && b_.faces[*it].centre.x <= f.centre.x + reach; ++it) {
        PlacedFace& g = b_.faces[*it];
        if (g.matched || distance(f.centre, g.centre) > reach) continue;
        if (std::abs(f.area - g.area) > area_share * std::max(f.area, g.area) + options_.tolerance_mm * f.extent) continue;
        const double d = deviation(f, g, best);
        if (d <= best && (!chosen || d < best || *it < *chosen)) best = d, chosen = *it;
        if (best == 0) break;
      }
      if (!chosen) continue;
      f.matched = b_.faces[*chosen].matched = true;
      pair_[i] = found(&f, &b_.faces[*chosen], kind, best);
      partner_[i] = *chosen;
      out_.max_deviation_mm = std::max(out_.max_deviation_mm, best);
    }
  }

  void match_moved() {
    const auto close = [](double x, double y, double share) { return std::abs(x - y) <= share * std::max(x, y); };
    for (std::size_t i = 0; i < a_.faces.size(); ++i) {
      PlacedFace& f = a_.faces[i];
      if (f.matched) continue;
      for (PlacedFace& g : b_.faces) {
        const double border_f = f.own->border_length * f.scale, border_g = g.own->border_length * g.scale;
        if (g.matched || !close(f.area, g.area, 1e-5) || !close(border_f, border_g, 1e-2) || !close(f.extent, g.extent, 2e-2)) {
          continue;
        }
        f.matched = g.matched = true;
        pair_[i] = found(&f, &g, Difference::Moved, distance(f.centre, g.centre));
        break;
      }
    }
  }

  Side &a_, &b_;
  const CompareOptions& options_;
  Comparison& out_;
  std::vector<std::uint32_t> by_x_;
  std::vector<FacePair> pair_;
  std::map<std::size_t, std::size_t> partner_;
};

double one_way(const PlacedCurve& from, const PlacedCurve& to) {
  const Transform across = to.to_part * from.to_world;
  double worst = 0;
  for (const double s : {0.0, 0.13, 0.27, 0.41, 0.55, 0.69, 0.83, 1.0}) {
    const Point p = apply(across, evaluate(*from.curve, range(*from.curve).at(s)));
    worst = std::max(worst, closest_point(*to.curve, p).distance * to.scale);
  }
  return worst;
}

void match_curves(Side& a, Side& b, double tolerance, Comparison& out) {
  for (PlacedCurve& c : a.curves) {
    for (PlacedCurve& d : b.curves) {
      if (d.matched || std::abs(c.length - d.length) > 1e-6 * c.length + 10 * tolerance) continue;
      if (std::max(one_way(c, d), one_way(d, c)) > tolerance) continue;
      c.matched = d.matched = true;
      ++out.curves_same;
      break;
    }
    out.curves_first += !c.matched;
  }
  out.curves_second = b.curves.size() - out.curves_same;
}

void match_points(const Side& a, const Side& b, double tolerance, Comparison& out) {
  std::vector<Point> left = b.points;
  for (const Point& p : a.points) {
    const auto same = std::find_if(left.begin(), left.end(), [&](const Point& q) { return distance(p, q) <= tolerance; });
    if (same == left.end()) {
      ++out.points_first;
      continue;
    }
    ++out.points_same;
    left.erase(same);
  }
  out.points_second = left.size();
}

}  // namespace

std::string_view to_string(Difference d) {
  switch (d) {
    case Difference::Same: return "same";
    case Difference::Changed: return "changed";
    case Difference::Moved: return "moved";
    case Difference::OnlyFirst: return "only-first";
    case Difference::OnlySecond: return "only-second";
  }
  return "same";
}

std::size_t Comparison::count(Difference d) const {
  return static_cast<std::size_t>(
      std::count_if(faces.begin(), faces.end(), [&](const FacePair& p) { return p.difference == d; }));
}

Result<Comparison> compare(const Model& first, const Model& second, const CompareOptions& options) {
  auto a = prepare(first, options), b = prepare(second, options);
  if (!a) return tl::unexpected(a.error());
  if (!b) return tl::unexpected(b.error());
  Comparison out;
  out.failed_first = a->failed;
  out.failed_second = b->failed;
  FaceMatcher(*a, *b, options, out).run();
  match_curves(*a, *b, options.tolerance_mm, out);
  match_points(*a, *b, options.tolerance_mm, out);
  if (options.execution.stop.stop_requested()) return fail(ErrorCode::Cancelled, "the comparison was ended early");
  return out;
}

}  // namespace trimloop
