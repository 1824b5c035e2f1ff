// compare_reading [--boxes] [--list] [--export [--ap214]] FILE...: reads each STEP file with ours and with OpenCASCADE's
// STEPCAFControl and compares what both found: paths of the assembly tree, box of each occurrence (1e-6 of its size), volume
// of each solid (1e-6), area (1e-4), name and colour of each face. A row per file, then a table. --list names each
// difference. With --export OpenCASCADE reads what we write of the file (IGES too), areas are compared to 1e-6, and, where
// the source is STEP, the product manufacturing information that it finds in both.
// Volumes and areas of OpenCASCADE's faces are integrated by our quadrature over its geometry (occt_flux.h).

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "io/io.h"
#include "kernel/check/extent.h"
#include "kernel/check/flux.h"
#include "tests/oracle/step_occt.h"

using namespace trimloop;
namespace fs = std::filesystem;

namespace {

bool list = false;
bool exported = false;
io::StepSchema schema = io::StepSchema::Ap242;
double area_tolerance = 1e-4;

struct Score {
  std::size_t right = 0, of = 0;
  void add(bool good) { right += good, ++of; }
  bool all() const { return right == of; }
};
struct Scores {
  Score tree, boxes, volumes, areas, names, colours, pmi;
  std::size_t unnamed = 0;  // faces that have a name in their record and none in OpenCASCADE: not held against either
};

struct OurFace {
  double area = 0;
  std::string name;
  std::optional<Colour> colour;
  std::uint64_t source = 0;
};
// What the volume of a solid cannot settle: how far it differs when the fluxes are taken about points one diagonal away (0
// where the faces close), and the sum of gap times length of the edges.
struct Room {
  double spread_mm3 = 0, gap_area_mm2 = 0;
};
struct Ours {
  std::vector<test::OcctOccurrence> tree;
  std::vector<double> volumes;
  std::vector<std::pair<const Body*, double>> solids;  // of each volume: the body and the scale that was applied
  std::vector<OurFace> faces;
};

void add_boxes(std::vector<test::OcctOccurrence>& tree, const std::vector<std::vector<std::uint32_t>>& paths) {
  for (std::size_t i = tree.size(); i-- > 0;) {
    for (std::size_t k = i; k-- > 0;) {  // the nearest one before it that is one level up holds it
      if (paths[k].size() + 1 != paths[i].size()) continue;
      if (tree[i].has_box) {
        Box both;
        if (tree[k].has_box) both.add(tree[k].lo), both.add(tree[k].hi);
        both.add(tree[i].lo), both.add(tree[i].hi);
        tree[k].lo = both.lo, tree[k].hi = both.hi, tree[k].has_box = true;
      }
      break;
    }
  }
}

Ours examine(const Model& model, bool boxes) {
  Ours out;
  const auto places = occurrences(model, 100'000, 64);
  if (!places) return out;
  std::vector<std::vector<std::uint32_t>> paths;
  for (const Occurrence& o : *places) {
    test::OcctOccurrence& node = out.tree.emplace_back();
    const Part& part = model.parts[o.part];
    std::uint32_t p = 0;
    node.path = model.parts[0].name;
    for (const std::uint32_t step : o.path) {
      p = model.parts[p].instances[step].part;
      node.path += "/" + model.parts[p].name;
    }
    paths.push_back(o.path);
    Box box;
    const double s = scale_factor(o.transform);
    for (const Body& body : part.bodies) {
      double volume = 0;
      for (std::uint32_t k = 0; body.kind == BodyKind::Solid && k < body.shells.size(); ++k)
        volume += trimloop::volume(body, ShellId{k}, 1e-9).value_or(Measured{}).value;
      if (body.kind == BodyKind::Solid) {
        out.volumes.push_back(volume * std::abs(determinant(o.transform)));
        out.solids.push_back({&body, std::abs(determinant(o.transform))});
      }
      for (std::uint32_t f = 0; f < body.faces.size(); ++f) {
        if (exported && body.faces[f].status == FaceStatus::Failed) continue;
        const Attributes& a = model[body.faces[f].attributes];
        const Attributes& all = model[body.attributes];
        out.faces.push_back({area(body, FaceId{f}, 1e-9).value * s * s, a.name, a.colour ? a.colour : all.colour,
                             body.faces[f].source.empty() ? 0 : body.faces[f].source[0].id});
        if (boxes) detail::add_face(box, body, body.faces[f], &o.transform);
      }
    }
    for (const FreeCurve& c : part.curves)
      if (boxes && is_bounded(c.curve)) detail::add_curve(box, c.curve, range(c.curve), &o.transform);
    for (const FreePoint& point : part.points) box.add(apply(o.transform, point.point));
    if (!box.empty()) node.lo = box.lo, node.hi = box.hi, node.has_box = true;
  }
  add_boxes(out.tree, paths);
  // A root that only gathers several products is ours alone.
  if (model.parts[0].name.empty() && model.parts[0].bodies.empty() && model.parts[0].curves.empty() && !model.parts[0].instances.empty()) {
    out.tree.erase(out.tree.begin());
    for (test::OcctOccurrence& o : out.tree) o.path.erase(0, 1);
  }
  return out;
}

// OpenCASCADE makes parts of its own from the compounds and the solids of one product, named after their kind.
void drop_kinds(std::vector<test::OcctOccurrence>& tree) {
  const auto is_kind = [](std::string_view name) {
    return name == "COMPOUND" || name == "COMPSOLID" || name == "SOLID" || name == "SHELL" || name == "FACE" || name == "WIRE" || name == "EDGE";
  };
  const auto last = [](const std::string& path) { return std::string_view(path).substr(path.rfind('/') + 1); };
  // A part without name and shape says nothing.
  std::erase_if(tree, [&](const auto& o) { return last(o.path).empty() && !o.has_box; });
  std::erase_if(tree, [&](const auto& o) { return o.path.find('/') != std::string::npos && is_kind(last(o.path)); });
}

bool near(double a, double b, double relative) { return std::abs(a - b) <= relative * std::max(std::abs(a), std::abs(b)); }

void compare_trees(std::vector<test::OcctOccurrence> a, std::vector<test::OcctOccurrence> b, bool boxes, Scores& s) {
  const auto by_path = [](const auto& x, const auto& y) { return x.path < y.path; };
  std::stable_sort(a.begin(), a.end(), by_path);
  std::stable_sort(b.begin(), b.end(), by_path);
  std::size_t i = 0, k = 0;
  while (i < a.size() || k < b.size()) {
    const bool ours_only = k == b.size() || (i < a.size() && a[i].path < b[k].path);
    const bool theirs_only = i == a.size() || (k < b.size() && b[k].path < a[i].path);
    s.tree.add(!ours_only && !theirs_only);
    if (ours_only || theirs_only) {
      if (list) fmt::print("    tree: only {}: {}\n", ours_only ? "ours" : "theirs", ours_only ? a[i].path : b[k].path);
      ours_only ? ++i : ++k;
      continue;
    }
    if (boxes && (a[i].has_box || b[k].has_box)) {
      const double size = b[k].has_box ? distance(b[k].lo, b[k].hi) : 0;
      const Vector lo = a[i].lo - b[k].lo, hi = a[i].hi - b[k].hi;
      const double off = std::max({std::abs(lo.x), std::abs(lo.y), std::abs(lo.z), std::abs(hi.x), std::abs(hi.y), std::abs(hi.z)});
      const bool good = a[i].has_box && b[k].has_box && off <= 1e-6 * size;
      s.boxes.add(good);
      if (!good && list)
        fmt::print("    box: {}: off by {:.2e} of its size: ours [{:.9g} {:.9g} {:.9g}] [{:.9g} {:.9g} {:.9g}] theirs [{:.9g} {:.9g} {:.9g}] [{:.9g} {:.9g} {:.9g}]\n",
                   a[i].path, off / size, a[i].lo.x, a[i].lo.y, a[i].lo.z, a[i].hi.x, a[i].hi.y, a[i].hi.z, b[k].lo.x, b[k].lo.y, b[k].lo.z,
                   b[k].hi.x, b[k].hi.y, b[k].hi.z);
    }
    ++i, ++k;
  }
}

bool same_name(const OurFace& a, const test::OcctFace& b) {
  return a.name == b.name || b.name == "NONE" || b.name.empty();  // "NONE" is how some senders write no name
}
bool same_colour(const OurFace& a, const test::OcctFace& b) {
  if (a.colour.has_value() != b.has_colour) return false;
  if (!b.has_colour) return true;  // OpenCASCADE keeps colours as floats
  return std::abs(a.colour->r - b.colour[0]) + std::abs(a.colour->g - b.colour[1]) + std::abs(a.colour->b - b.colour[2]) < 1e-5;
}

void compare_faces(const Ours& ours, const test::OcctStep& theirs, Scores& s) {
  for (std::size_t i = 0; i < std::max(ours.faces.size(), theirs.faces.size()); ++i) {
    if (i >= ours.faces.size() || i >= theirs.faces.size()) {
      s.areas.add(false), s.names.add(false), s.colours.add(false);
      continue;
    }
    const OurFace& a = ours.faces[i];
    const test::OcctFace& b = theirs.faces[i];
    const bool same_area = std::abs(a.area - b.area) <= area_tolerance * std::max(a.area, b.area) + 2 * b.error;
    const bool name = same_name(a, b);
    s.unnamed += b.name.empty() && !a.name.empty();
    const bool colour = same_colour(a, b);
    s.areas.add(same_area), s.names.add(name), s.colours.add(colour);
    if (list && !(same_area && name && colour)) {
      const Colour c = a.colour.value_or(Colour{-1, -1, -1});
      fmt::print("    face {} #{}: area {:.10g} {:.10g} ({:.1e}); name '{}' '{}'; colour {} {} {} / {} {} {} {}\n", i, a.source, a.area, b.area, b.error,
                 a.name, b.name, c.r, c.g, c.b, b.has_colour, b.colour[0], b.colour[1], b.colour[2]);
    }
  }
}

Room room_of(const Body& body) {
  Room room;
  Box box;
  for (const Face& face : body.faces) detail::add_face(box, body, face, nullptr);
  for (const Loop& loop : body.loops)
    for (const Coedge& c : loop.coedges)
      if (const Edge& e = body[c.edge]; e.curve) room.gap_area_mm2 += c.gap_mm * length(with_range(*e.curve, e.range), 1e-3);
  Interval seen{infinity, -infinity};
  for (const double step : {0.0, 1.0, -1.0})
    for (const Vector axis : {Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}}) {
      const Point about = midpoint(box.lo, box.hi) + step * box.diagonal() * axis;
      double sum = 0;
      for (const Shell& shell : body.shells)
        for (const Shell::Use& use : shell.faces) {
          const double flux = detail::face_integral(body, use.face, detail::What::Volume, about, 1e-10).value;
          sum += body[use.face].reversed != use.reversed ? -flux : flux;
        }
      seen = {std::min(seen.lo, sum), std::max(seen.hi, sum)};
    }
  room.spread_mm3 = seen.length();
  return room;
}

// Our faces in the order of OpenCASCADE's, which puts solids before shells: each with the nearest area among those of its
// name (where it has one) and colour.
void match_faces(Ours& ours, test::OcctStep& theirs) {
  std::vector<std::size_t> order(ours.volumes.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ours.volumes[a] < ours.volumes[b]; });
  const Ours as_read = {{}, ours.volumes, ours.solids, {}};
  for (std::size_t i = 0; i < order.size(); ++i) {
    ours.volumes[i] = as_read.volumes[order[i]];
    if (order.size() == as_read.solids.size()) ours.solids[i] = as_read.solids[order[i]];
  }
  std::stable_sort(theirs.volumes.begin(), theirs.volumes.end());
  if (ours.faces.size() != theirs.faces.size()) return;
  std::stable_partition(theirs.faces.begin(), theirs.faces.end(), [](const test::OcctFace& f) { return !f.name.empty(); });
  std::vector<OurFace> matched;
  std::vector<bool> used(ours.faces.size());
  for (const test::OcctFace& b : theirs.faces) {
    std::size_t best = used.size();
    double least = infinity;
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (used[i] || !(same_name(ours.faces[i], b) && same_colour(ours.faces[i], b))) continue;
      const double off = std::abs(ours.faces[i].area - b.area);
      if (off < least) least = off, best = i;
    }
    if (best == used.size()) best = static_cast<std::size_t>(std::find(used.begin(), used.end(), false) - used.begin());
    used[best] = true;
    matched.push_back(ours.faces[best]);
  }
  ours.faces = std::move(matched);
}

// What OpenCASCADE makes of the original it makes of ours: then the difference is one of reading, not of writing.
bool as_original(const test::OcctStep& a, test::OcctStep b) {
  Ours first;
  for (const test::OcctFace& f : a.faces)
    first.faces.push_back({f.area, f.name, f.has_colour ? std::optional(Colour{f.colour[0], f.colour[1], f.colour[2]}) : std::nullopt, 0});
  first.volumes = a.volumes;
  match_faces(first, b);
  if (a.faces.size() != b.faces.size() || a.volumes.size() != b.volumes.size()) return false;
  for (std::size_t i = 0; i < a.faces.size(); ++i) {
    const OurFace& x = first.faces[i];
    const test::OcctFace& y = b.faces[i];
    if (!same_name(x, y) || !same_colour(x, y) || std::abs(x.area - y.area) > 1e-6 * x.area + 4 * y.error) return false;
  }
  for (std::size_t i = 0; i < a.volumes.size(); ++i)
    if (!near(first.volumes[i], b.volumes[i], 1e-6)) return false;
  return true;
}

void compare_volumes(const Ours& ours, const test::OcctStep& theirs, Scores& s) {
  for (std::size_t i = 0; i < std::max(ours.volumes.size(), theirs.volumes.size()); ++i) {
    const double a = i < ours.volumes.size() ? ours.volumes[i] : 0, b = i < theirs.volumes.size() ? theirs.volumes[i] : 0;
    s.volumes.add(near(a, b, 1e-6));
    if (!list || near(a, b, 1e-6)) continue;
    fmt::print("    solid {}: volume {:.12g} {:.12g}: {:.1e}", i, a, b, std::abs(a - b) / std::max(std::abs(a), std::abs(b)));
    if (i < ours.solids.size()) {
      const Room room = room_of(*ours.solids[i].first);
      const double scale = ours.solids[i].second;
      fmt::print("; ours differs by {:.3g} ({:.1e}) with the point that fluxes are taken about; gaps times lengths of the edges {:.3g} mm2",
                 scale * room.spread_mm3, scale * room.spread_mm3 / std::abs(a), std::pow(scale, 2.0 / 3) * room.gap_area_mm2);
    }
    fmt::print("\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  bool boxes = false;
  std::size_t files = 0, same = 0, alike = 0, unread = 0;
  Scores in_files;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--boxes") { boxes = true; continue; }
    if (word == "--list") { list = true; continue; }
    if (word == "--export") { exported = true, area_tolerance = 1e-6; continue; }
    if (word == "--ap214") { schema = io::StepSchema::Ap214; continue; }
    io::ReadResult in = io::read(word);
    if (exported)  // products have names: those that our writer gives are not what is compared
      for (std::size_t p = 0; p < in.model.parts.size(); ++p)
        if (std::string& name = in.model.parts[p].name; name.empty() && (p > 0 || !in.model.parts[0].bodies.empty() || in.model.parts[0].instances.empty() || in.source.format == io::Format::Iges))
          name = p == 0 ? in.model.name : fmt::format("unnamed {}", p);
    // In a folder of its own: OpenCASCADE follows references into other files, we name them.
    const fs::path folder = fs::temp_directory_path() / fmt::format("trimloop_reading_{}", getpid()), alone = folder / "file.step";
    fs::create_directory(folder);
    std::optional<test::OcctStep> original;
    if (exported) {
      if (in.source.format == io::Format::Step) {
        fs::copy_file(word, alone, fs::copy_options::overwrite_existing);
        original = test::read_step_with_occt(alone, false, 300);
      }
      io::WriteOptions options;
      options.format = io::Format::Step;
      options.step_schema = schema;
      const auto written = io::encode(in.model, in.source, options);
      if (written && !io::save(alone, written->bytes, true)) return 3;
      if (written && list)
        for (const std::string& loss : written->losses) fmt::print("    loss: {}\n", loss);
    } else {
      fs::copy_file(word, alone, fs::copy_options::overwrite_existing);
    }
    auto theirs = fs::exists(alone) ? test::read_step_with_occt(alone, boxes, 300) : std::nullopt;
    fs::remove_all(folder);
    if (!theirs || !in.usable) {
      fmt::print("{}: {}\n", word, !theirs ? "not read by OpenCASCADE" : "not read by us");
      ++unread;
      continue;
    }
    Scores s;
    Ours ours = examine(in.model, boxes);
    drop_kinds(ours.tree);
    drop_kinds(theirs->tree);
    compare_trees(ours.tree, theirs->tree, boxes, s);
    if (exported) match_faces(ours, *theirs);
    compare_volumes(ours, *theirs, s);
    compare_faces(ours, *theirs, s);
    if (original && !in.source.pmi.empty() && schema == io::StepSchema::Ap242) {
      s.pmi.add(original->pmi == theirs->pmi);
      const auto text = [](const auto& p) { return fmt::format("{} dimensions, {} tolerances, {} datums, {} shapes", p[0], p[1], p[2], p[3]); };
      if (list && original->pmi != theirs->pmi) fmt::print("    pmi: {} in the original, {} in ours\n", text(original->pmi), text(theirs->pmi));
      else if (list) fmt::print("    pmi: {} in both\n", text(theirs->pmi));
    }
    ++files;
    bool all = true;
    std::string row;
    const auto one = [&](const char* what, const Score& mine, Score& total) {
      total.add(mine.all());
      all = all && mine.all();
      row += fmt::format(" {} {}/{}", what, mine.right, mine.of);
    };
    one("tree", s.tree, in_files.tree);
    one("boxes", s.boxes, in_files.boxes);
    one("volumes", s.volumes, in_files.volumes);
    one("areas", s.areas, in_files.areas);
    one("names", s.names, in_files.names);
    one("colours", s.colours, in_files.colours);
    if (s.pmi.of) one("pmi", s.pmi, in_files.pmi);
    const bool reading = !all && original && s.tree.all() && s.pmi.all() && as_original(*original, *theirs);
    same += all;
    alike += reading;
    in_files.unnamed += s.unnamed;
    fmt::print("{}: {}{}\n", word, all ? "same" : reading ? "as the original" : "DIFFERS", row);
    std::fflush(stdout);
  }
  fmt::print("{} files read by both, {} all the same, {} as OpenCASCADE reads the original, {} not read by both\n", files, same, alike, unread);
  for (const auto& [what, score] : {std::pair("tree", in_files.tree), std::pair("boxes", in_files.boxes), std::pair("volumes", in_files.volumes),
                                    std::pair("areas", in_files.areas), std::pair("names", in_files.names), std::pair("colours", in_files.colours), std::pair("pmi", in_files.pmi)})
    fmt::print("  {}: {} of {} files\n", what, score.right, score.of);
  fmt::print("  faces that only we name: {}\n", in_files.unnamed);
  return same + alike == files ? 0 : 1;
}
