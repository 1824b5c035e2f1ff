// round_trip FILE...: each file through the other format and back, IGES -> STEP -> IGES or STEP -> IGES -> STEP; after each
// step the model is compared with the one before: counts, and the distance of faces, curves and points measured.
// OpenCASCADE takes no part. Prints a row per file and a summary.

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "io/io.h"
#include "kernel/check/compare.h"
#include "kernel/check/measure.h"

using namespace trimloop;

namespace {

struct Outcome {
  bool usable = false, written = false, same = false, counts = false;
  bool listed = false;  // what differs is a shape within the distance that the losses tell, or a face they name
  std::size_t faces = 0, losses = 0;
  double size = 0, deviation = 0;  // mm
};

// Solids none of whose faces failed: the others are written as sheets, and said.
std::size_t sound_solids(const Model& model) {
  std::size_t n = 0;
  const auto places = occurrences(model, 1'000'000, 64);
  for (const Occurrence& o : places.value_or(std::vector<Occurrence>{})) {
    for (const Body& body : model.parts[o.part].bodies) {
      n += body.kind == BodyKind::Solid && !body.shells.empty() &&
           std::none_of(body.faces.begin(), body.faces.end(), [](const Face& f) { return f.status == FaceStatus::Failed; });
    }
  }
  return n;
}

std::string source(const io::ReadResult& in, const std::optional<FacePlace>& p) {
  if (!p) return "-";
  const Face& face = in.model.parts[p->part].bodies[p->body].faces[p->face.index];
  return face.source.empty() ? "?" : io::source_name(in.source.format, face.source.front());
}

Outcome go_round(const std::string& path) {
  Outcome out;
  io::ReadResult in = io::read(path);
  const auto before = count(in.model);
  const auto ours = measure(in.model, {});
  if (!in.usable || !before || !ours) return out;
  if (before->faces - before->faces_failed + before->curves + before->points == 0) return out;  // nothing to carry
  out.usable = true;
  out.faces = before->faces - before->faces_failed;
  out.size = ours->box.diagonal();
  const io::Format home = in.source.format, away = home == io::Format::Step ? io::Format::Iges : io::Format::Step;
  out.same = out.counts = true;
  io::ReadResult now = std::move(in);
  for (const io::Format format : {away, home}) {
    io::WriteOptions write;
    write.format = format;
    const auto written = io::encode(now.model, now.source, write);
    out.written = written.has_value();
    if (!written) {
      fmt::print("    not written as {}: {}\n", to_string(format), written.error().text);
      out.same = false;
      return out;
    }
    out.losses += written->losses.size();
    for (std::size_t i = 0; i < written->losses.size() && i < 3; ++i) fmt::print("    loss: {}\n", written->losses[i]);
    io::ReadResult next = io::read_bytes(written->bytes, format == io::Format::Step ? "x.stp" : "x.igs");
    const auto a = count(now.model), b = count(next.model);
    CompareOptions options;
    options.tolerance_mm = 1e-9 * out.size;
    const auto c = a && b ? compare(now.model, next.model, options) : tl::unexpected(Error{});
    if (!c) {
      out.same = out.counts = false;
      return out;
    }
    // Faces that failed and faces of no area have no shape to keep; what else is left out must be named as lost.
    const auto differs = [](const FacePair& p) { return p.difference != Difference::Same; };
    const bool counts_kept = sound_solids(now.model) == sound_solids(next.model) && b->faces_failed == 0 &&
                             c->count(Difference::OnlyFirst) == c->count(Difference::OnlySecond) && c->curves_first == 0 &&
                             c->points_first == 0;
    const bool same = counts_kept && std::none_of(c->faces.begin(), c->faces.end(), differs);
    for (const std::string& loss : written->losses) {
      out.listed = out.listed || (!same && counts_kept && loss.find(": within ") != std::string::npos);
    }
    if (!same) {
      fmt::print("    as {}: solids {} {} faces {} {} failed {} {}; same {} changed {} moved {} only {} {}; curves {} {} {}; points {} {} {}; at most {:.2g}\n",
                 to_string(format), a->solids, b->solids, a->faces, b->faces, a->faces_failed, b->faces_failed,
                 c->count(Difference::Same), c->count(Difference::Changed), c->count(Difference::Moved),
                 c->count(Difference::OnlyFirst), c->count(Difference::OnlySecond), c->curves_same, c->curves_first,
                 c->curves_second, c->points_same, c->points_first, c->points_second, c->max_deviation_mm);
    }
    for (const FacePair& p : c->faces) {
      if (differs(p)) fmt::print("      {} {} {}: {:.3g} mm, areas {:.12g} {:.12g}\n", to_string(p.difference), source(now, p.first), source(next, p.second), p.deviation_mm, p.area_first_mm2, p.area_second_mm2);
    }
    out.counts = out.counts && counts_kept;
    out.same = out.same && same;
    out.deviation = std::max(out.deviation, c->max_deviation_mm);
    now = std::move(next);
  }
  return out;
}

// In a process of its own, so that one file cannot take the others along.
int guarded(const std::string& path, unsigned patience_s) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    alarm(patience_s);
    const Outcome o = go_round(path);
    const char* word = !o.usable ? "unusable" : o.same ? "same" : o.listed && o.counts ? "SAME AS LISTED" : o.counts ? "SHAPES DIFFER" : "COUNTS DIFFER";
    fmt::print("{}: {}; {} faces, {} losses, at most {:.2g} mm apart ({:.2g} of the size)\n", path, word, o.faces, o.losses,
               o.deviation, o.size > 0 ? o.deviation / o.size : 0.0);
    std::fflush(stdout);
    _exit(!o.usable ? 3 : o.same ? 0 : o.listed && o.counts ? 5 : o.counts ? 1 : 2);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status)) return WEXITSTATUS(status);
  fmt::print("{}: ended by signal {}\n", path, WTERMSIG(status));
  return 4;
}

}  // namespace

int main(int argc, char** argv) {
  int counts[6] = {};
  for (int i = 1; i < argc; ++i) ++counts[guarded(argv[i], 120)];
  fmt::print("{} the same, {} within the distance listed, {} with shapes that differ, {} with other counts, {} unusable, {} ended early\n", counts[0], counts[5],
             counts[1], counts[2], counts[3], counts[4]);
  return counts[1] + counts[2] + counts[4] ? 1 : 0;
}
