#pragma once
// Files and models meet here: read anything readable, write anything writable. Neither prints nor throws.

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/limits.h"
#include "base/report.h"
#include "io/external.h"
#include "kernel/mesh/tessellate.h"
#include "kernel/model/model.h"

namespace trimloop::iges {
class File;
}
namespace trimloop::step {
class File;
}

namespace trimloop::io {

enum class Format : std::uint8_t { Unknown, Iges, Step, Stl, Obj, Ply, Glb, Json, Svg, Csv, Font };
std::string_view to_string(Format);
std::optional<Format> format_from_extension(const std::filesystem::path&);
Format sniff(std::string_view first_bytes);

struct ReadOptions {
  std::optional<LengthUnit> assume_unit;   // only where the file does not say
  bool sew = false;                        // join faces edge to edge (kernel/heal/sew.h)
  std::optional<double> sew_mm;            // within this; nothing: ten times the file's resolution, at most 1e-4 of the extent
  bool measure_findings = false;           // areas of healed faces (MD-30), gaps at open edges (SQ-241); costs time
  double tolerance_mm = 1e-3;              // of what has no exact NURBS form: caps of control meshes (OBJ)
  std::string font_text;                   // what to set in a font
  double em_mm = 10;                       // its em square
  Resolver resolve;                        // gives files that an IGES file refers to (416); none: they are listed and left out
  Execution execution;
};

// What was in the file beside the model: sender, census, names of sources.
struct SourceInfo {
  std::string name;                 // file name without folder
  std::size_t bytes = 0;
  Format format = Format::Unknown;
  std::string version;              // "5.3"
  std::string unit;                 // as the file says: "mm", "inch"
  std::string sender;
  std::string date;
  std::map<std::string, std::size_t> entities;  // "126:0" -> 812
  std::shared_ptr<const iges::File> iges;       // repair road and dump
  std::shared_ptr<const step::File> step;
  std::shared_ptr<const std::string> packed;    // the bytes as they came, where the file was compressed
  std::map<std::string, std::size_t> pmi;       // STEP: dimensions, tolerances, datums, annotations, views; kept raw, see list_pmi
};

// One piece of product manufacturing information of a STEP file, kept raw.
struct PmiItem {
  std::uint64_t id = 0;             // #42
  std::string_view kind;            // "dimensions", ...: as counted in SourceInfo::pmi
  std::string entity, name;         // "FLATNESS_TOLERANCE", 'Flatness.1'
  std::vector<std::uint64_t> shapes;  // faces, edges and other topology that it speaks of, ascending
};
// Everything that SourceInfo::pmi counts, in the file's order. Linear in the file for each item at worst.
std::vector<PmiItem> list_pmi(const SourceInfo& source, const Limits& limits = {});

struct Timings {
  double read_ms = 0, import_ms = 0, sew_ms = 0, mesh_ms = 0, write_ms = 0;
};

struct ReadResult {
  Model model;
  SourceInfo source;
  Report report;
  Timings timings;
  bool usable = false;              // a model exists, if only of free points
  bool io_failed = false;           // the operating system refused (exit 3)
  bool limit_reached = false;       // a whole-file ceiling ended the work (exit 4)
};

ReadResult read(const std::filesystem::path& path, const ReadOptions& options = {});
ReadResult read_bytes(std::string bytes, std::string name, const ReadOptions& options = {});

// Name of a source object for people: "D171".
std::string source_name(Format format, const SourceRef& ref);

enum class StepSchema : std::uint8_t { Ap242, Ap214 };

// Full: IGES 5.3 as it is. Conservative: what weak readers take: every border explicit (144 with its outer 142), no loop
// with a vertex for a pole (508), text in ASCII.
enum class IgesProfile : std::uint8_t { Full, Conservative };
// Shells as 186 or 514 with their shared edges, or face by face as 144.
enum class IgesBodies : std::uint8_t { Solids, Surfaces };

struct WriteOptions {
  Format format = Format::Unknown;          // Unknown: by extension
  std::optional<LengthUnit> unit;           // STL/OBJ/PLY: mm unless given; IGES and STEP: the source's unless given
  bool to_nurbs = false;
  StepSchema step_schema = StepSchema::Ap242;
  IgesProfile iges_profile = IgesProfile::Full;
  IgesBodies iges_bodies = IgesBodies::Solids;
  std::string deflection = "0.1%";          // a length in mm or a share of the diagonal
  double angle_deg = 20;
  std::optional<std::size_t> max_triangles;  // of all bodies, each counted once: both bounds are widened until it holds
  std::string timestamp;                    // "YYYYMMDD.HHNNSS"; empty: fixed null stamp
  Execution execution;
};

struct FaceReport {
  std::uint32_t id = 0;
  std::string source;                       // "D171"
  FaceStatus status = FaceStatus::Ok;
  std::string reason;
  double area_before_mm2 = -1, area_mm2 = -1;  // of healed faces, before and after; < 0: see reason
  std::size_t triangles = 0;
  double bound_mm = 0;
  mesh::BoundKind bound_kind = mesh::BoundKind::Sampled;
};

// What became of one face's surface and edges, or of one free curve, under to_nurbs.
struct NurbsEntity {
  enum class Form : std::uint8_t { Exact, Near, Kept };  // Near: joined over gaps; Kept: no rational spline is equal to it
  std::string source;                       // "D171"
  std::string_view shape;                   // "cylinder", "conic arc", ...: a static word
  bool is_surface = false;
  Form form = Form::Exact;
  double deviation_mm = 0;                  // of Near: the largest gap that was joined
  std::string reason;                       // of Kept
  std::size_t edges = 0, edges_kept = 0;    // of a face: model curves of its edges, and those that no spline is equal to
};

// What became of curves and surfaces under to_nurbs.
struct NurbsStatement {
  std::vector<NurbsEntity> entities;      // each face and each free curve of each part, in the model's order
  std::size_t exact_surfaces = 0, exact_curves = 0;
  std::size_t approximated_pcurves = 0;   // trimming curves whose parameter map is not affine
  double max_deviation_mm = 0;            // of these, measured on the surface
  std::size_t lifted_curves = 0;          // model curves made for edges known by their parameter curve alone
  double max_lifted_mm = 0;               // how far, at most, these were seen to be off
  std::size_t slivers_left_out = 0;       // gap-closing edges too short to be written: the gap of the file stays
};

struct WriteResult {
  std::string bytes;                        // the whole output file
  std::vector<FaceReport> faces;
  std::size_t triangles = 0, vertices = 0, open_edges = 0;
  double deflection_mm = 0, max_bound_mm = 0;
  double coarsened = 1;                     // by what max_triangles widened the deflection
  NurbsStatement nurbs;
  std::vector<std::string> losses;          // each thing that has no home in the target format
  Report report;
  Timings timings;
};
// Encodes a model in memory.
Result<WriteResult> encode(const Model& model, const SourceInfo& source, const WriteOptions& options);
// Writes to a temporary file beside `path` and renames; the old file stays as it was on failure.
Result<void> save(const std::filesystem::path& path, std::string_view bytes, bool overwrite);

const Rule* find_rule(std::string_view id_or_slug);   // over the tables of all layers
std::vector<const Rule*> all_rules();

}  // namespace trimloop::io
