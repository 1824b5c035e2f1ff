#include "kernel/boolean/classify.h"

#include <array>

#include "kernel/boolean/curve_hits.h"
#include "kernel/intersect/intersect.h"

namespace trimloop::boolean {
namespace {

bool ray_meets(const Box& b, Point p, Vector d) {
  double lo = 0, hi = infinity;
  const auto slab = [&](double from, double along, double min, double max) {
    if (along == 0) {
      if (from < min || from > max) hi = -1;
      return;
    }
    const double s = (min - from) / along, t = (max - from) / along;
    lo = std::max(lo, std::min(s, t)), hi = std::min(hi, std::max(s, t));
  };
  slab(p.x, d.x, b.lo.x, b.hi.x);
  slab(p.y, d.y, b.lo.y, b.hi.y);
  slab(p.z, d.z, b.lo.z, b.hi.z);
  return lo <= hi;
}

// How often the segment crosses the face; nothing when that is not clear.
std::optional<int> crossings(const Operand& body, const FaceOf& face, const Curve& ray, Vector direction) {
  std::vector<double> hits;
  if (const auto found = curve_hits(ray, *face.surface, 0)) {
    hits = *found;
  } else {
    const auto all = intersect(ray, *face.surface, {}, face.uv.u, face.uv.v);
    if (!all || !all->overlaps.empty() || !all->undecided.empty()) return std::nullopt;
    for (const CurveSurfacePoint& h : all->points) {
      if (h.kind == ContactKind::Touch) return std::nullopt;
      hits.push_back(h.t);
    }
  }
  int count = 0;
  for (const double t : hits) {
    const Point p = evaluate(ray, t);
    const Place place = body.locate(face, p);
    if (place.where == Where::Outside) continue;
    constexpr double grazing = 1e-3;
    const bool unclear = place.where == Where::Border || t <= body.tolerance() ||
                         std::abs(dot(normal(*face.surface, place.uv), direction)) < grazing;
    if (unclear) return std::nullopt;
    ++count;
  }
  return count;
}

}  // namespace

std::optional<Side> side_of(const Operand& body, Point p) {
  Box all;
  for (const FaceOf& f : body.faces()) all.add(f.box);
  if (apart(all, p, body.tolerance())) return Side::Outside;
  const double length = 2 * all.diagonal();
  // Directions spread over the sphere (golden angle), none along an axis.
  constexpr int rays = 16;
  for (int i = 0; i < rays; ++i) {
    const double z = 0.37 + 1.2 * i / rays - (0.37 + 1.2 * i / rays > 1 ? 1.7 : 0), turn = 0.7 + 2.399963229728653 * i;
    const double across = std::sqrt(1 - z * z);
    const Vector d{across * std::cos(turn), across * std::sin(turn), z};
    const Curve ray{Line{p, p + d, {0, length}}};
    int count = 0;
    bool clear = true;
    for (const FaceOf& f : body.faces()) {
      if (!ray_meets(widened(f.box, body.tolerance()), p, d)) continue;
      const auto more = crossings(body, f, ray, d);
      clear = more.has_value();
      if (!clear) break;
      count += *more;
    }
    if (clear) return count % 2 == 1 ? Side::Inside : Side::Outside;
  }
  return std::nullopt;
}

}  // namespace trimloop::boolean
