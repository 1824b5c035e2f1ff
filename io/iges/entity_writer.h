#pragma once
// What every part of the IGES export shares: the record writer, file units, and attributes on their way to the
// directory (colour, level, visibility) and to properties (name).

#include <map>
#include <string>
#include <vector>

#include "formats/iges/write.h"
#include "io/file_units.h"
#include "io/io.h"

namespace trimloop::io::iges_export {

// Lengths in the file's unit (io/file_units.h), points as records have them.
class Units : public FileUnits {
 public:
  using FileUnits::FileUnits;
  iges::Xyz point(Point p) const { return {length(p.x), length(p.y), length(p.z)}; }
};

// Status of a directory entry: how it depends on others, and its use.
enum class Role : std::uint8_t { Independent, Child, ParameterCurve, Definition, Annotation, AnnotationPart, Logical };

// How widths of lines stand in the Global section: a number of steps up to the widest.
struct LineWeights {
  int steps = 1;
  double widest_mm = 0.25;
  int step_of(double mm) const;  // 0: not stated
};
LineWeights line_weights(const Model&);

class EntityWriter {
 public:
  EntityWriter(const Model& from, iges::Global global, double mm_per_unit, const LineWeights& line_widths, const WriteOptions& how,
               std::vector<std::string>& lost)
      : model(from), units(mm_per_unit), weights(line_widths), options(how), losses(lost), writer_(std::move(global)) {}

  const Model& model;
  const Units units;
  const LineWeights weights;
  const WriteOptions& options;
  std::vector<std::string>& losses;
  NurbsStatement statement;  // what --to-nurbs kept exact and what it approximated

  template <class Record>
  iges::Ref add(const Record& record, Role role, int form = 0) {
    return writer_.add(entry(role, form, {}), record);
  }
  // With a matrix, and with the attributes of what it stands for.
  template <class Record>
  iges::Ref add(const Record& record, Role role, int form, const Transform* placement, AttributesId attributes) {
    iges::DirectoryEntry e = entry(role, form, attributes);
    if (placement != nullptr) e.transform = matrix(*placement).de;
    return writer_.add(std::move(e), record, groups_of(attributes));
  }
  // A record given as its tokens.
  iges::Ref add_tokens(int type, const iges::TokenWriter& tokens, Role role, int form, const Transform* placement, AttributesId attributes,
                       iges::TrailingGroups groups = {});
  iges::Ref add_on_level(int type, const iges::TokenWriter& tokens, int form, int level);
  iges::TrailingGroups attributes_of_name(const std::string& name);  // its 406 form 15; nothing for an empty one
  std::string text(const std::string& of);  // as the profile has it: the conservative one is in ASCII, with a loss
  Result<std::string> finish() const { return writer_.finish(); }
  std::size_t entities() const { return writer_.entities(); }

 private:
  iges::DirectoryEntry entry(Role role, int form, AttributesId attributes);
  iges::TrailingGroups groups_of(AttributesId attributes);
  iges::Ref matrix(const Transform& placement);  // lengths to file units here
  int colour_of(const Colour& colour);           // DE field 13: a standard colour, or minus a 314

  iges::Writer writer_;
  std::map<std::array<double, 3>, int> colours_;
  std::map<std::string, iges::Ref> names_;
};

// A curve as 110, 100, 106 or 126; the parameter runs as in `curve`. Loss (and no reference) for offsets.
iges::Ref write_curve(EntityWriter&, const Curve& curve, Role role, AttributesId attributes = {});
// A curve in parameter space as 110 or 126: nothing is scaled.
iges::Ref write_pcurve(EntityWriter&, const Curve& curve, bool as_nurbs);

// Parameters of the record of a curve that write_curve keeps at its own speed: what range(curve) becomes. Nothing for
// the others, which are written as the NURBS they are equal to.
std::optional<Interval> recorded_range(const Curve& curve);

// Parameters of a surface whose NURBS, or that of its profile, runs at another speed: each direction by itself.
struct Bend {
  ParameterMap u, v;
};
inline Uv apply(const Bend& b, Uv p) { return {map_to_nurbs(b.u, p.u), map_to_nurbs(b.v, p.v)}; }
inline Uv undo(const Bend& b, Uv p) { return {map_from_nurbs(b.u, p.u), map_from_nurbs(b.v, p.v)}; }

// How a surface stands in the file: its record, and its own (u, v) -> the record's, first through `bend`, then through
// the affine `map`.
struct WrittenSurface {
  iges::Ref ref;
  Transform map;        // affine, in the plane; determinant < 0 turns loops round
  std::optional<Bend> bend;
};
// `flip`: the record's normal is to be opposite to Su x Sv. Over the rectangle that the loops use.
Result<WrittenSurface> write_surface(EntityWriter&, const Surface&, Interval u, Interval v, bool flip, bool to_nurbs,
                                     Role role, AttributesId attributes);

// A face as 144 over 142, or (unless every border is to be explicit) as its bare surface when its loop is the surface's own
// border.
void write_face(EntityWriter&, const Body&, const Face&, bool as_nurbs, Role role, std::vector<iges::Ref>& written);

// The coedge's pcurve from its start to its end, in the record's parameters.
Result<Curve> record_pcurve(EntityWriter&, const Surface& own, const Coedge&, const WrittenSurface&);
// The shells of a body as 186 or 514. False, and nothing written but what stands alone, when an edge has no record: its
// faces are then to be written one by one.
bool write_shells(EntityWriter&, const Body&, bool as_nurbs, Role role, std::vector<iges::Ref>& written);

}  // namespace trimloop::io::iges_export
