// The conservative profile and bodies as surfaces: what stands in the file, and that the shape is the same.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/iges/records/any.h"
#include "io/io.h"
#include "kernel/heal/make_face.h"
#include "tests/io/iges/imported.h"
#include "tests/support/builders.h"
#include "tests/support/corpus.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

io::WriteOptions options_of(io::IgesProfile profile, io::IgesBodies bodies) {
  io::WriteOptions out;
  out.format = io::Format::Iges;
  out.iges_profile = profile;
  out.iges_bodies = bodies;
  return out;
}

// What the profile forbids, where it is.
std::string broken_conservative(const iges::File& file, std::string_view bytes) {
  Report report;
  for (const iges::DirectoryEntry& e : file.directory()) {
    const iges::AnyRecord record = iges::read_any(file, e, Limits{}, report);
    if (const auto* trimmed = record.as<iges::TrimmedSurface>(); trimmed && !(trimmed->outer_given && trimmed->outer))
      return fmt::format("D{}: a trimmed surface without its outer loop", e.de);
    if (const auto* loop = record.as<iges::LoopRecord>())
      for (const auto& item : loop->items)
        if (item.is_vertex) return fmt::format("D{}: a vertex in a loop", e.de);
    const bool free = e.status.subordinate == 0;
    if (free && (e.type == 128 || e.type == 118 || e.type == 120 || e.type == 122 || e.type == 140)) return fmt::format("D{}: a bare surface", e.de);
  }
  if (!std::all_of(bytes.begin(), bytes.end(), [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); })) return "not ASCII";
  // 72 and 64 columns of data; no number runs over the end of a card.
  for (std::size_t at = 0; at < bytes.size(); at += 81) {
    if (at + 81 > bytes.size() || bytes[at + 80] != '\n') return "a card is not 80 columns wide";
    if (bytes[at + 72] == 'P' && bytes[at + 64] != ' ') return "column 65 is in use";
  }
  return {};
}

Model sampler() {
  Model model;
  model.name = "sampler";
  model.parts.resize(2);
  model.parts[0].bodies = {box({0, 0, 0}, {1, 2, 3}), cylinder({5, 0, 0}, 1, 2), sphere({10, 0, 0}, 1), cone({15, 0, 0}, 1, 2),
                           torus({20, 0, 0}, 3, 1)};
  Body sheet;
  heal::FaceInput patch;
  const std::vector<Point> poles{{0, 0, 9}, {0, 4, 9}, {8, 0, 9}, {8, 4, 9}};  // u slowest
  patch.surface = std::make_shared<const Surface>(Surface{*NurbsSurface::from_cartesian(1, 1, {0, 0, 1, 1}, {0, 0, 1, 1}, poles, {})});
  heal::add_face(sheet, patch);
  model.parts[0].bodies.push_back(sheet);
  model.parts[1].name = "pin";
  model.parts[1].bodies.push_back(cylinder({0, 0, 0}, 0.5, 1));
  Attributes named;
  named.name = "first pin";
  named.colour = Colour{0.25, 0.5, 0.75};
  named.layer = 4;
  model.parts[0].instances.push_back({1, Transform::translation({0, 0, 20}), model.add(named), {}});
  return model;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(profiles)

BOOST_AUTO_TEST_CASE(every_profile_keeps_the_shape) {
  const Model model = sampler();
  const auto before = measure(model, Limits{}).value();
  for (const auto profile : {io::IgesProfile::Full, io::IgesProfile::Conservative})
    for (const auto bodies : {io::IgesBodies::Solids, io::IgesBodies::Surfaces}) {
      const auto file = io::encode(model, {}, options_of(profile, bodies));
      BOOST_REQUIRE(file);
      const io::ReadResult back = io::read_bytes(file->bytes, "test.igs");
      for (const Diagnostic& d : back.report.items())
        BOOST_TEST((d.severity != Severity::Error && d.severity != Severity::Fatal), d.rule->id << ": " << d.text);
      const bool conservative = profile == io::IgesProfile::Conservative, surfaces = bodies == io::IgesBodies::Surfaces;
      const std::string broken = broken_conservative(*back.source.iges, file->bytes);
      BOOST_TEST(broken.empty() == conservative, broken);
      BOOST_TEST((back.source.entities.count("186:0") == 1) == !surfaces);
      BOOST_TEST(back.source.entities.at("308:0") == 1u);
      BOOST_TEST(back.source.entities.at("408:0") == 1u);
      // Two bodies have poles.
      BOOST_TEST(file->losses.size() == (surfaces ? 6u : conservative ? 2u : 0u));
      const auto after = measure(back.model, Limits{}).value();
      BOOST_TEST(std::abs(after.area_mm2 - before.area_mm2) <= 1e-9 * before.area_mm2);
      BOOST_TEST(distance(after.box.lo, before.box.lo) <= 1e-9);
      BOOST_TEST(distance(after.box.hi, before.box.hi) <= 1e-9);
      BOOST_TEST(count(back.model)->faces == count(model)->faces);
      const Attributes& pin = back.model[back.model.parts[0].instances.at(0).attributes];
      BOOST_TEST(pin.name == "first pin");
      BOOST_TEST(pin.layer == 4);
      BOOST_REQUIRE(pin.colour);
      BOOST_TEST(pin.colour->b == 0.75);
      if (surfaces) continue;
      const std::size_t solids = conservative ? 4 : 6;
      BOOST_TEST(count(back.model)->solids == solids);
    }
}

BOOST_AUTO_TEST_CASE(public_files_hold_to_the_conservative_profile) {
  std::size_t files = 0, faces = 0;
  for (const auto& path : corpus_files("iges")) {
    if (std::filesystem::file_size(path) > 60'000) continue;
    const io::ReadResult in = io::read(path);
    if (!in.usable || count(in.model)->faces == 0) continue;
    BOOST_TEST_CONTEXT(path.filename().string()) {
      const auto file = io::encode(in.model, in.source, options_of(io::IgesProfile::Conservative, io::IgesBodies::Solids));
      if (!file) continue;  // nothing of it can be written
      Report report;
      const std::string broken = broken_conservative(iges::File::parse(file->bytes, Limits{}, report), file->bytes);
      BOOST_TEST(broken.empty(), broken);
      const io::ReadResult back = io::read_bytes(file->bytes, "again.igs");
      const ModelCounts a = *count(in.model), b = *count(back.model);
      BOOST_TEST(b.faces - b.faces_failed == a.faces - a.faces_failed);
      const double before = measure(in.model, Limits{})->area_mm2, after = measure(back.model, Limits{})->area_mm2;
      BOOST_TEST(std::abs(after - before) <= 1e-5 * before, after << " is not " << before);
      ++files, faces += a.faces;
    }
  }
  BOOST_TEST_MESSAGE(files << " files, " << faces << " faces");
}

BOOST_AUTO_TEST_SUITE_END()
