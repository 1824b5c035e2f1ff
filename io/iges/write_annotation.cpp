#include "io/iges/write_annotation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/iges/records/curves.h"
#include "formats/iges/records/structure.h"

namespace trimloop::io::iges_export {

namespace {

// Axes of the plane that runs of text lie in; the origin stays that of the model.
struct Plane {
  Vector x, y, z;
};

std::optional<Plane> plane_of(const TextRun& run) {
  const Vector n = cross(run.along, run.up);
  const double size = norm(n);
  if (!(size > 0) || !std::isfinite(size)) return std::nullopt;
  const Vector z = (1 / size) * n;
  if (z.x == 0 && z.y == 0) return Plane{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Vector x = normalized(run.along);
  return Plane{x, cross(z, x), z};
}

constexpr double same_plane = 1e-9;

bool lies_in(const TextRun& run, const Plane& plane) {
  const double a = norm(run.along), b = norm(run.up);
  return a > 0 && b > 0 && std::abs(dot(run.along, plane.z)) <= same_plane * a && std::abs(dot(run.up, plane.z)) <= same_plane * b;
}

Transform placement_of(const Plane& p) {
  Transform t;
  t.r = {{{p.x.x, p.y.x, p.z.x}, {p.x.y, p.y.y, p.z.y}, {p.x.z, p.y.z, p.z.z}}};
  return t;
}

// 212 form 0: NS strings, each with its box, font, slant, turn, mirror and start.
iges::Ref write_note(EntityWriter& writer, const Plane& plane, const std::vector<const TextRun*>& runs, Role role, AttributesId attributes) {
  iges::TokenWriter out;
  out.count(runs.size());
  for (const TextRun* run : runs) {
    // Written backwards about its foot where it reads from behind.
    const bool mirrored = dot(cross(run->along, run->up), plane.z) < 0;
    const Vector along = mirrored ? -run->along : run->along;
    const Vector start = run->origin - Point{};
    const std::string text = writer.text(run->text);
    out.count(text.size());
    out.real(writer.units.length(norm(run->along)));
    out.real(writer.units.length(norm(run->up)));
    out.integer(1);  // font code: default
    out.real(run->slant_rad);
    out.real(std::atan2(dot(along, plane.y), dot(along, plane.x)));
    out.integer(mirrored ? 1 : 0);
    out.integer(run->vertical ? 1 : 0);
    out.xyz(writer.units.point({dot(start, plane.x), dot(start, plane.y), dot(start, plane.z)}));
    out.string(text);
  }
  const Transform placement = placement_of(plane);
  return writer.add_tokens(212, out, role, 0, is_identity(placement) ? nullptr : &placement, attributes);
}

iges::Ref write_stroke(EntityWriter& writer, const std::vector<Point>& points) {
  iges::CopiousData record;
  for (const Point& p : points) {
    const iges::Xyz at = writer.units.point(p);
    record.values.insert(record.values.end(), {at.x, at.y, at.z});
  }
  return writer.add(record, Role::AnnotationPart, 12);
}

// What reads back as what it was: a plain note, or lines without further meaning.
bool keeps_its_kind(const Annotation& a) { return a.kind == "General Note" || a.kind == "General Symbol"; }

}  // namespace

std::vector<iges::Ref> write_annotation(EntityWriter& writer, const Annotation& a, Role role, std::map<std::string, std::size_t>& kinds_lost) {
  std::vector<iges::Ref> written;
  std::vector<std::pair<Plane, std::vector<const TextRun*>>> groups;
  for (const TextRun& run : a.texts) {
    if (run.text.empty()) continue;
    auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return lies_in(run, g.first); });
    if (group == groups.end()) {
      const auto plane = plane_of(run);
      if (!plane) {
        writer.losses.push_back("a text without size");
        continue;
      }
      group = groups.insert(groups.end(), {*plane, {}});
    }
    group->second.push_back(&run);
  }
  const bool symbol = !a.strokes.empty();
  iges::Ref note;
  for (const auto& [plane, runs] : groups) {
    const bool part = symbol && !note;  // of the symbol; a 228 has one note
    const iges::Ref ref = write_note(writer, plane, runs, part ? Role::AnnotationPart : role, part ? AttributesId{} : a.attributes);
    if (part) note = ref;
    else written.push_back(ref);
  }
  if (symbol) {
    std::vector<iges::Ref> strokes;
    for (const auto& points : a.strokes) strokes.push_back(write_stroke(writer, points));
    iges::TokenWriter out;
    out.ref(note);
    out.count(strokes.size());
    out.refs(strokes);
    out.count(0);  // leaders
    written.push_back(writer.add_tokens(228, out, role, 0, nullptr, a.attributes));
  }
  if (!written.empty() && !keeps_its_kind(a)) ++kinds_lost[a.kind];
  return written;
}

void write_drawings(EntityWriter& writer, std::map<std::string, std::size_t>& kinds_lost) {
  constexpr int level_of_size = 16;
  std::vector<iges::Ref> views;
  const auto named = [&](const std::string& name) { return writer.attributes_of_name(name); };
  for (const View& view : writer.model.views) {
    iges::TokenWriter out;
    out.integer(view.number);
    out.real(view.scale);
    for (int plane = 0; plane < 6; ++plane) out.integer(0);  // nothing is cut off
    views.push_back(writer.add_tokens(410, out, Role::Independent, 0, is_identity(view.from_model) ? nullptr : &view.from_model, {},
                                      named(view.name)));
  }
  for (const Drawing& drawing : writer.model.drawings) {
    std::vector<iges::Ref> notes;
    for (const Annotation& a : drawing.annotation)
      for (const iges::Ref ref : write_annotation(writer, a, Role::AnnotationPart, kinds_lost)) notes.push_back(ref);
    iges::TokenWriter out;
    out.count(drawing.views.size());
    for (const Drawing::Placed& placed : drawing.views) {
      out.ref(views.at(placed.view));
      out.real(writer.units.length(placed.origin.u));
      out.real(writer.units.length(placed.origin.v));
      out.real(placed.angle_rad);
    }
    out.count(notes.size());
    out.refs(notes);
    iges::TrailingGroups groups = named(drawing.name);
    if (drawing.width_mm > 0 && drawing.height_mm > 0) {
      iges::TokenWriter size;
      size.count(2);
      size.real(writer.units.length(drawing.width_mm));
      size.real(writer.units.length(drawing.height_mm));
      groups.properties.push_back(writer.add_tokens(406, size, Role::Logical, level_of_size, nullptr, {}));
    }
    writer.add_tokens(404, out, Role::Annotation, 1, nullptr, {}, groups);
  }
}

void write_layer_names(EntityWriter& writer) {
  constexpr int level_function = 3;
  for (std::size_t i = 0; i < writer.model.layer_names.size(); ++i) {
    if (writer.model.layer_names[i].empty()) continue;
    iges::TokenWriter out;
    out.count(2);
    out.integer(0);
    out.string(writer.text(writer.model.layer_names[i]));
    writer.add_on_level(406, out, level_function, static_cast<int>(i) + 1);
  }
}

}  // namespace trimloop::io::iges_export
