// Primitives and swept solids (150-168) -> boundary representations.

#include "formats/iges/rules.h"
#include "io/iges/curves.h"
#include "io/iges/placement.h"
#include "io/iges/solids.h"
#include "io/rules.h"
#include "kernel/solids/primitives.h"
#include "kernel/solids/sweep.h"

namespace trimloop::io::iges_import {
namespace {

namespace igr = iges::rules;

// Numbers of one primitive in model space. Its matrix may turn, shift, mirror and scale evenly.
class Numbers {
 public:
  Numbers(Context& context, const DirectoryEntry& entry, const iges::TableRecord& record)
      : record_(record), place_(model_placement(context, entry)), mm_(context.unit.scale) {}

  double length(std::string_view name) const { return record_.real(name) * mm_ * scale_factor(place_); }
  Point origin() const {
    const iges::Xyz p = record_.xyz("X1", "Y1", "Z1");
    return apply(place_, Point{p.x * mm_, p.y * mm_, p.z * mm_});
  }
  Vector direction(std::string_view i, std::string_view j, std::string_view k) const {
    const iges::Xyz v = record_.xyz(i, j, k);
    return normalized(apply(place_, Vector{v.x, v.y, v.z}));
  }
  Vector axis() const { return direction("I1", "J1", "K1"); }
  // Local axes x and z, y = z cross x; left-handed under a mirror.
  Frame axes() const {
    const double hand = determinant(place_) < 0 ? -1 : 1;
    Frame f = make_frame(origin(), direction("I2", "J2", "K2"), direction("I1", "J1", "K1"));
    f.y = hand * f.y;
    return f;
  }
  const Transform& place() const { return place_; }
  bool is_mirrored() const { return determinant(place_) < 0; }

 private:
  const iges::TableRecord& record_;
  Transform place_;
  double mm_;
};

// Points of a profile closer than this are one: the file's resolution, or what seven digits leave of its size, or the
// gaps that it has, when they are small against it (said so).
double profile_tolerance(Context& context, const DirectoryEntry& entry, const Profile& profile, bool open) {
  constexpr double seven_digits = 1e-6, small = 1e-3;
  const double size = bounding_box(profile).diagonal(), gap = largest_gap(profile, open);
  const double tolerance = std::max(context.resolution_mm, seven_digits * size);
  if (!(gap > tolerance) || gap > small * size) return tolerance;
  context.add(entry, rules::gap_in_loop, "the profile has gaps; they are closed", gap, tolerance);
  return 1.001 * gap;
}

// The profile of a swept solid in model space: its own matrix, then that of the solid.
std::optional<Profile> profile(Context& context, const iges::TableRecord& record, const Transform& place) {
  const DirectoryEntry* e = context.resolve(record.ref("PTR"), is_curve, "a curve");
  CurvePtr curve = e ? moved(context, model_curve(context, *e), place) : nullptr;
  if (!curve || !is_bounded(*curve)) return std::nullopt;
  return pieces_of(*curve);
}

Result<Body> build(Context& context, const DirectoryEntry& entry, const iges::TableRecord& record) {
  const Numbers n(context, entry, record);
  switch (entry.type) {
    case 150: return make_block(n.axes(), n.length("LX"), n.length("LY"), n.length("LZ"));
    case 152: return make_wedge(n.axes(), n.length("LX"), n.length("LY"), n.length("LZ"), n.length("LTX"));
    case 154: return make_cylinder(make_frame(n.origin(), n.axis()), n.length("R"), n.length("H"));
    case 156: return make_cone(make_frame(n.origin(), n.axis()), n.length("R1"), n.length("R2"), n.length("H"));
    case 158: return make_sphere(make_frame(n.origin(), {0, 0, 1}), n.length("R"));
    case 160: return make_torus(make_frame(n.origin(), n.axis()), n.length("R1"), n.length("R2"));
    case 168: {
      const Frame f = n.axes();
      return make_ellipsoid(make_frame(f.origin, f.z, f.x), n.length("LX"), n.length("LY"), n.length("LZ"));
    }
    default: break;
  }
  const auto curves = profile(context, record, n.place());
  if (!curves) return fail(ErrorCode::Degenerate, "its profile cannot be used");
  const double open_gap = distance(end_point(curves->back()), start_point(curves->front()));
  const bool open = entry.type == 162 && open_gap > 1e-3 * bounding_box(*curves).diagonal();
  const double tolerance = profile_tolerance(context, entry, *curves, open);
  if (entry.type == 164) return extrude(*curves, n.length("L") * n.axis(), tolerance);
  // A mirror turns the other way about the mirrored axis.
  const Axis axis{n.origin(), n.is_mirrored() ? -n.axis() : n.axis()};
  return revolve(*curves, axis, two_pi * record.real("F"), entry.form == 0, tolerance);
}

}  // namespace

bool is_primitive(const DirectoryEntry& e) {
  switch (e.type) {
    case 150: case 152: case 154: case 156: case 158: case 160: case 162: case 164: case 168: return true;
    default: return false;
  }
}

std::optional<Body> primitive_body(Context& context, const DirectoryEntry& entry) {
  Visit visit(context, entry);
  const iges::TableRecord* record = visit ? context.table(entry) : nullptr;
  if (!record) return std::nullopt;
  context.state(entry).consumed = true;
  auto body = build(context, entry, *record);
  if (!body) {
    context.add(entry, rules::unsupported, Severity::Error, "the solid failed: " + body.error().text, body.error().measured,
                body.error().limit);
    return std::nullopt;
  }
  body->source.push_back(source_of(entry));
  for (Face& face : body->faces) face.source.push_back(source_of(entry));
  for (Shell& shell : body->shells) shell.source.push_back(source_of(entry));
  return std::move(*body);
}

}  // namespace trimloop::io::iges_import
