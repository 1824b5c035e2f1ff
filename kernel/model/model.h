#pragma once
// Model: what a file means. Parts (definitions) and instances (placements), never flattened inside.
// Lengths in millimetres. Attributes are shared through one table.

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/result.h"
#include "kernel/math/transform.h"
#include "kernel/topology/polygon_mesh.h"

namespace trimloop {

struct Colour {
  double r = 0, g = 0, b = 0;  // 0..1
};

struct Attributes {
  std::string name;
  std::optional<Colour> colour;
  int layer = 0;
  bool visible = true;
  int line_font = 0;          // 0 not stated, 1 solid, 2 dashed, 3 phantom, 4 centre, 5 dotted
  double line_weight_mm = 0;  // 0 not stated
};

struct FreeCurve {
  Curve curve;
  AttributesId attributes;
  SourceRefs source;
};
struct FreePoint {
  Point point;
  AttributesId attributes;
  SourceRefs source;
};

// A run of text: baseline start, the way it runs (x) and up (y), both with the character box's size as their length.
struct TextRun {
  std::string text;          // as the file has it, one line
  Point origin;              // lower left corner of the box
  Vector along, up;          // of the whole run: its width and the height of its letters, mm
  double slant_rad = pi / 2; // angle of the letters' stems with `along`
  bool vertical = false;     // letters below one another
};
// What a drawing says about a shape: strokes and texts, in model space.
struct Annotation {
  std::string kind;                       // "linear dimension", "general note", ...
  std::vector<std::vector<Point>> strokes;  // polylines: leaders, witness lines, arrow heads, symbols, hatches
  std::vector<TextRun> texts;
  AttributesId attributes;
  SourceRefs source;
};

// A sheet and the views placed on it.
struct View {
  std::string name;
  int number = 0;
  double scale = 1;
  Transform from_model;  // model space -> view space, without the scale
  SourceRefs source;
};
struct Drawing {
  struct Placed {
    std::uint32_t view = 0;  // index into Model::views
    Uv origin;               // on the sheet, mm
    double angle_rad = 0;
  };
  std::string name;
  double width_mm = 0, height_mm = 0;  // 0 not stated
  std::vector<Placed> views;
  std::vector<Annotation> annotation;  // on the sheet itself
  SourceRefs source;
};

struct Instance {
  std::uint32_t part = 0;      // index into Model::parts
  Transform transform;         // rigid x uniform scale x mirror
  AttributesId attributes;
  SourceRefs source;
};

struct Part {
  std::string name;
  std::vector<Body> bodies;
  std::vector<PolygonMesh> meshes;
  std::vector<FreeCurve> curves;
  std::vector<FreePoint> points;
  std::vector<Annotation> annotation;
  std::vector<Instance> instances;  // acyclic; depth bounded by Limits::nesting_depth
  SourceRefs source;
};

enum class LengthUnit : std::uint8_t { Millimetre, Inch, Foot, Mile, Metre, Kilometre, Mil, Micron, Centimetre, MicroInch };
double millimetres_per(LengthUnit);
std::string_view to_string(LengthUnit);           // "mm" "inch" "foot" ...
std::optional<LengthUnit> unit_from_name(std::string_view);

struct Model {
  std::vector<Part> parts;      // parts[0] is the root
  std::vector<Attributes> attributes;
  std::vector<std::string> layer_names;  // of layers from 1 on, where the source names them
  std::vector<View> views;
  std::vector<Drawing> drawings;
  LengthUnit source_unit = LengthUnit::Millimetre;
  double source_scale = 1;      // mm per file unit, model space scale included
  bool unit_known = true;
  double resolution_mm = 1e-3;  // what the sender calls coincident
  std::string name;
  std::unordered_multimap<std::size_t, std::uint32_t> attribute_places;  // hash -> index, kept by add

  AttributesId add(const Attributes&);                       // shares equal ones
  int layer_number(std::string_view name);                   // of a named layer, from 1; a new name gets the next one
  const Attributes& operator[](AttributesId id) const;       // `none` gives the defaults
};

// Every occurrence, depth first, root first. ErrorCode::Limit when there are more than `max_instances` or when they are
// nested deeper than `max_depth` (so a cycle ends here too).
struct Occurrence {
  std::uint32_t part;
  Transform transform;
  std::vector<std::uint32_t> path;  // indices into Part::instances, from the root
};
Result<std::vector<Occurrence>> occurrences(const Model&, std::size_t max_instances, std::size_t max_depth);

struct ModelCounts {  // once per occurrence
  std::size_t solids = 0, shells = 0, faces = 0, faces_healed = 0, faces_failed = 0, edges = 0, curves = 0, points = 0;
  std::size_t meshes = 0, mesh_faces = 0, mesh_triangles = 0;  // those that stand for bodies included
};
Result<ModelCounts> count(const Model&, std::size_t max_instances = 1'000'000, std::size_t max_depth = 64);

}  // namespace trimloop
