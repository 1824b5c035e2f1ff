// compare_step [--boxes] [--schema ap214] [--faces] FILE...: writes each file as STEP, lets OpenCASCADE read that, and
// prints a row per file: faces, area and volume of both sides. A file that is STEP itself is also read as it stands
// with --direct.

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "io/io.h"
#include "kernel/check/measure.h"
#include "tests/oracle/step_occt.h"

using namespace trimloop;

namespace {

struct Options {
  bool boxes = false, faces = false, direct = false, to_nurbs = false;
  io::StepSchema schema = io::StepSchema::Ap242;
};

bool near(double a, double b, double relative) { return std::abs(a - b) <= relative * std::max(std::abs(a), std::abs(b)); }

void print_faces(const Model& model, const test::OcctStep& theirs) {
  const auto places = occurrences(model, 100000, 64);
  if (!places) return;
  std::size_t k = 0;
  for (const Occurrence& o : *places) {
    for (const Body& body : model.parts[o.part].bodies) {
      for (std::uint32_t f = 0; f < body.faces.size(); ++f) {
        if (body.faces[f].status == FaceStatus::Failed) continue;
        const double s = scale_factor(o.transform);
        const double ours = area(body, FaceId{f}).value * s * s;
        const double other = k < theirs.faces.size() ? theirs.faces[k].area : 0;
        if (!near(ours, other, 1e-6)) {
          const char* kinds[] = {"plane", "cylinder", "cone", "sphere", "torus", "revolution", "extrusion", "ruled", "offset", "nurbs"};
          fmt::print("    face {} ({}): ours {:.9g} theirs {:.9g} ({:.1e}); surface {}; {}; source {}\n", k,
                     body.faces[f].status == FaceStatus::Ok ? "ok" : "healed", ours, other, k < theirs.faces.size() ? theirs.faces[k].error : 0,
                     kinds[body.faces[f].surface->shape.index()], body.faces[f].reason,
                     body.faces[f].source.empty() ? 0 : body.faces[f].source[0].id);
        }
        ++k;
      }
    }
  }
}

// 0 agrees, 1 differs, 2 nothing to compare.
int compare(const std::string& path, const Options& options) {
  const io::ReadResult in = io::read(path);
  const auto counts = count(in.model);
  if (!in.usable || !counts || counts->faces == counts->faces_failed) {
    fmt::print("{}: no faces\n", path);
    return 2;
  }
  const std::string target = options.direct ? path : fmt::format("/tmp/trimloop_compare_{}.stp", getpid());
  if (!options.direct) {
    io::WriteOptions write;
    write.format = io::Format::Step;
    write.step_schema = options.schema;
    write.to_nurbs = options.to_nurbs;
    const auto written = io::encode(in.model, in.source, write);
    if (!written || !io::save(target, written->bytes, true)) {
      fmt::print("{}: NOT WRITTEN {}\n", path, written ? "" : written.error().text);
      return 1;
    }
    if (written->losses.size() > counts->faces_failed) {
      fmt::print("{}: {} losses, {}\n", path, written->losses.size(), written->losses.back());
    }
  }
  const auto theirs = test::read_step_with_occt(target, options.boxes, 300);
  if (!options.direct) std::remove(target.c_str());
  if (!theirs) {
    fmt::print("{}: NOT READ by OpenCASCADE\n", path);
    return 1;
  }
  const auto ours = measure(in.model, {});
  if (!ours) return 2;
  const std::size_t faces = counts->faces - counts->faces_failed;
  double volume = 0;  // of solids; closed shells of sheets are shells to OpenCASCADE
  const auto places = occurrences(in.model, 100000, 64);
  for (const Occurrence& o : places.value_or(std::vector<Occurrence>{})) {
    for (const Body& body : in.model.parts[o.part].bodies) {
      for (std::uint32_t s = 0; body.kind == BodyKind::Solid && s < body.shells.size(); ++s) {
        volume += std::abs(determinant(o.transform)) * trimloop::volume(body, ShellId{s}).value_or(Measured{}).value;
      }
    }
  }
  const bool same_faces = faces == theirs->faces.size(), same_area = std::abs(ours->area_mm2 - theirs->area()) <= 1e-6 * ours->area_mm2 + 2 * theirs->area_error(),
             same_volume = near(volume, theirs->volume(), 1e-6);
  // Where OpenCASCADE makes as much of the original, the difference is one of reading, not of writing.
  bool as_original = false;
  if (!options.direct && in.source.format == io::Format::Step && !(same_faces && same_area && same_volume)) {
    const auto original = test::read_step_with_occt(path, false, 60);
    as_original = original && original->faces.size() == theirs->faces.size() && near(original->volume(), theirs->volume(), 1e-6) &&
                  std::abs(original->area() - theirs->area()) <= 1e-6 * theirs->area() + 2 * theirs->area_error();
  }
  fmt::print("{}: {} faces {} {} area {:.10g} {:.10g} ({:.1e}) plain {:.10g} volume {:.10g} {:.10g}\n", path,
             same_faces && same_area && same_volume ? "same" : as_original ? "as the original" : "DIFFERS", faces, theirs->faces.size(), ours->area_mm2,
             theirs->area(), theirs->area_error(), theirs->area_plain(), volume, theirs->volume());
  if (options.faces && !same_area) print_faces(in.model, *theirs);
  if (options.boxes) {
    for (const test::OcctOccurrence& o : theirs->tree) {
      fmt::print("    {} [{:.6g} {:.6g} {:.6g}] [{:.6g} {:.6g} {:.6g}]\n", o.path, o.lo.x, o.lo.y, o.lo.z, o.hi.x, o.hi.y, o.hi.z);
    }
  }
  return (same_faces && same_area && same_volume) || as_original ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  int same = 0, differ = 0, nothing = 0;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--boxes") options.boxes = true;
    else if (word == "--faces") options.faces = true;
    else if (word == "--direct") options.direct = true;
    else if (word == "--to-nurbs") options.to_nurbs = true;
    else if (word == "--ap214") options.schema = io::StepSchema::Ap214;
    else {
      const int result = compare(word, options);
      std::fflush(stdout);
      (result == 0 ? same : result == 1 ? differ : nothing)++;
    }
  }
  fmt::print("{} the same, {} differ, {} without faces\n", same, differ, nothing);
  return differ ? 1 : 0;
}
