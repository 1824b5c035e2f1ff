#include "kernel/check/part_mass.h"

#include <cmath>

#include "kernel/check/measure.h"

namespace trimloop {

namespace {

void add(PartMass& to, const PartMass& m) {
  to.area_mm2 += m.area_mm2;
  to.volume_mm3 += m.volume_mm3;
  to.moment_mm4 += m.moment_mm4;
  if (!m.box.empty()) to.box.add(m.box);
  to.has_solid = to.has_solid || m.has_solid;
  to.complete = to.complete && m.complete;
}

// Integral of x over the volume moved by x -> A x + t: |A| (A moment + volume t).
PartMass placed(const PartMass& m, const Transform& at) {
  PartMass out = m;
  const double det = std::abs(determinant(at)), scale = scale_factor(at);
  Transform linear = at;
  linear.t = {};
  out.area_mm2 = m.area_mm2 * scale * scale;
  out.volume_mm3 = m.volume_mm3 * det;
  out.moment_mm4 = det * (to_vector(apply(linear, to_point(m.moment_mm4))) + m.volume_mm3 * at.t);
  out.box = {};
  for (int k = 0; k < 8 && !m.box.empty(); ++k)
    out.box.add(apply(at, Point{k & 1 ? m.box.hi.x : m.box.lo.x, k & 2 ? m.box.hi.y : m.box.lo.y, k & 4 ? m.box.hi.z : m.box.lo.z}));
  return out;
}

}  // namespace

PartMass mass_of(const Body& body) {
  PartMass out;
  for (std::uint32_t f = 0; f < body.faces.size(); ++f) {
    out.complete = out.complete && body.faces[f].status != FaceStatus::Failed;
    out.area_mm2 += area(body, FaceId{f}).value;
    out.box.add(bounding_box(body, FaceId{f}));
  }
  if (body.kind != BodyKind::Solid) return out;
  for (std::uint32_t s = 0; s < body.shells.size(); ++s) {
    const auto v = volume(body, ShellId{s});
    const auto c = centroid(body, ShellId{s});
    if (!v || !c) {
      out.complete = false;
      continue;
    }
    out.has_solid = true;
    out.volume_mm3 += v->value;
    out.moment_mm4 += v->value * to_vector(*c);
  }
  return out;
}

const PartMass& PartMasses::of(std::uint32_t part) {
  if (done_[part]) return known_[part];
  PartMass sum;
  for (const Body& body : model_.parts[part].bodies) add(sum, mass_of(body));
  for (const Instance& i : model_.parts[part].instances) add(sum, placed(of(i.part), i.transform));
  done_[part] = true;
  return known_[part] = sum;
}

}  // namespace trimloop
