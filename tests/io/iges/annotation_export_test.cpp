// Annotation, views, drawings and layer names written and read again.
#include <algorithm>

#include "io/io.h"
#include "tests/io/iges/imported.h"
#include "tests/support/corpus.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

io::WriteResult written(const Model& model, io::WriteOptions options = {}) {
  options.format = io::Format::Iges;
  auto file = io::encode(model, {}, options);
  BOOST_REQUIRE_MESSAGE(file, (file ? "" : file.error().text));
  return std::move(*file);
}

io::ReadResult read_again(const io::WriteResult& file) {
  io::ReadResult back = io::read_bytes(file.bytes, "test.igs");
  for (const Diagnostic& d : back.report.items())
    BOOST_TEST((d.severity != Severity::Error && d.severity != Severity::Fatal), d.rule->id << ": " << d.text);
  return back;
}

// What annotation shows, whatever entities it came in.
struct Shown {
  std::vector<std::vector<Point>> strokes;
  std::vector<TextRun> texts;
};

void add(Shown& out, const std::vector<Annotation>& of) {
  for (const Annotation& a : of) {
    out.strokes.insert(out.strokes.end(), a.strokes.begin(), a.strokes.end());
    for (const TextRun& t : a.texts)
      if (!t.text.empty() && norm(cross(t.along, t.up)) > 0) out.texts.push_back(t);
  }
}

Shown shown(const Model& model) {
  Shown out;
  for (const Part& part : model.parts) add(out, part.annotation);
  for (const Drawing& d : model.drawings) add(out, d.annotation);
  return out;
}

void sort(Shown& s) {
  std::stable_sort(s.texts.begin(), s.texts.end(), [](const TextRun& a, const TextRun& b) { return a.text < b.text; });
}

double largest_distance(const Shown& a, const Shown& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.strokes.size(); ++i) {
    BOOST_REQUIRE(a.strokes[i].size() == b.strokes[i].size());
    for (std::size_t k = 0; k < a.strokes[i].size(); ++k) worst = std::max(worst, distance(a.strokes[i][k], b.strokes[i][k]));
  }
  for (std::size_t i = 0; i < a.texts.size(); ++i) {
    const TextRun &p = a.texts[i], &q = b.texts[i];
    BOOST_TEST(p.text == q.text);
    BOOST_TEST(p.vertical == q.vertical);
    BOOST_TEST(std::abs(p.slant_rad - q.slant_rad) <= 1e-12);
    worst = std::max({worst, distance(p.origin, q.origin), norm(p.along - q.along), norm(p.up - q.up)});
  }
  return worst;
}

TextRun run(const char* text, Point origin, Vector along, Vector up) {
  TextRun out;
  out.text = text;
  out.origin = origin;
  out.along = along;
  out.up = up;
  return out;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(annotation_export)

BOOST_AUTO_TEST_CASE(texts_in_any_plane_and_strokes_come_back) {
  Model model;
  model.parts.resize(1);
  Annotation a;
  a.kind = "General Symbol";
  a.strokes = {{{0, 0, 0}, {1, 2, 3}, {4, 5, 6}}, {{7, 0, 0}, {7, 1, 0}}};
  a.texts = {run("flat", {1, 2, 3}, {10, 0, 0}, {0, 2, 0}),     run("turned", {1, 2, 4}, {0, 8, 0}, {-3, 0, 0}),
             run("backwards", {0, 0, 0}, {-5, 0, 0}, {0, 2, 0}), run("upside down", {0, 0, 0}, {5, 0, 0}, {0, -2, 0}),
             run("upright", {0, 1, 0}, {6, 0, 0}, {0, 0, 2})};
  a.texts[1].slant_rad = 1.2;
  a.texts[2].vertical = true;
  model.parts[0].annotation.push_back(a);
  const io::WriteResult file = written(model);
  BOOST_TEST(file.losses.empty());
  const io::ReadResult back = read_again(file);
  BOOST_TEST(back.model.parts[0].curves.empty());
  Shown before = shown(model), after = shown(back.model);
  BOOST_REQUIRE(after.strokes.size() == 2u);
  BOOST_REQUIRE(after.texts.size() == 5u);
  sort(before), sort(after);
  BOOST_TEST(largest_distance(before, after) <= 1e-12);
}

BOOST_AUTO_TEST_CASE(views_drawings_and_layers_come_back) {
  Model model;
  model.parts.resize(1);
  Attributes phantom;
  phantom.layer = 2;
  phantom.line_font = 3;
  phantom.line_weight_mm = 0.35;
  model.parts[0].points.push_back({{1, 2, 3}, model.add(phantom), {}});
  phantom.line_weight_mm = 0.7;  // the widest
  model.add(phantom);
  model.layer_names = {"", "walls"};
  View view;
  view.name = "front";
  view.number = 3;
  view.scale = 0.5;
  view.from_model = Transform::rotation({}, {1, 0, 0}, 0.5);
  model.views.push_back(view);
  Drawing drawing;
  drawing.name = "sheet";
  drawing.width_mm = 420;
  drawing.height_mm = 297;
  drawing.views.push_back({0, {100, 50}, 0.25});
  Annotation note;
  note.kind = "General Note";
  note.texts = {run("scale 1:2", {1, 2, 0}, {10, 0, 0}, {0, 2, 0})};
  drawing.annotation.push_back(note);
  model.drawings.push_back(drawing);
  io::WriteOptions options;
  options.unit = LengthUnit::Inch;
  const io::WriteResult file = written(model, options);
  BOOST_TEST(file.losses.empty());
  const io::ReadResult back = read_again(file);
  BOOST_REQUIRE(back.model.views.size() == 1u);
  BOOST_TEST(back.model.views[0].name == "front");
  BOOST_TEST(back.model.views[0].number == 3);
  BOOST_TEST(back.model.views[0].scale == 0.5);
  check_point(apply(back.model.views[0].from_model, Point{0, 1, 0}), apply(view.from_model, Point{0, 1, 0}));
  BOOST_REQUIRE(back.model.drawings.size() == 1u);
  const Drawing& d = back.model.drawings[0];
  BOOST_TEST(d.name == "sheet");
  BOOST_TEST(std::abs(d.width_mm - 420) <= 1e-12 * 420);
  BOOST_TEST(std::abs(d.height_mm - 297) <= 1e-12 * 297);
  BOOST_REQUIRE(d.views.size() == 1u);
  BOOST_TEST(std::abs(d.views[0].origin.u - 100) <= 1e-12 * 100);
  BOOST_TEST(d.views[0].angle_rad == 0.25);
  BOOST_REQUIRE(d.annotation.size() == 1u);
  BOOST_TEST(d.annotation[0].texts[0].text == "scale 1:2");
  BOOST_REQUIRE(back.model.layer_names.size() == 2u);
  BOOST_TEST(back.model.layer_names[1] == "walls");
  const Attributes& point = back.model[back.model.parts[0].points[0].attributes];
  BOOST_TEST(point.layer == 2);
  BOOST_TEST(point.line_font == 3);
  BOOST_TEST(std::abs(point.line_weight_mm - 0.35) <= 1e-12);
}

BOOST_AUTO_TEST_CASE(public_drawings_show_the_same_again) {
  std::size_t files = 0, strokes = 0, texts = 0;
  double worst = 0;
  for (const auto& path : corpus_files("iges")) {
    if (std::filesystem::file_size(path) > 200'000) continue;
    const io::ReadResult in = io::read(path);
    Shown before = shown(in.model);
    if (!in.usable || (before.strokes.empty() && before.texts.empty())) continue;
    BOOST_TEST_CONTEXT(path.filename().string()) {
      io::WriteOptions options;
      options.format = io::Format::Iges;
      const auto file = io::encode(in.model, in.source, options);
      BOOST_REQUIRE(file);
      const io::ReadResult back = io::read_bytes(file->bytes, "again.igs");
      Shown after = shown(back.model);
      BOOST_REQUIRE(before.strokes.size() == after.strokes.size());
      BOOST_REQUIRE(before.texts.size() == after.texts.size());
      sort(before), sort(after);
      double size = 1;
      for (const auto& s : before.strokes)
        for (const Point& p : s) size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
      worst = std::max(worst, largest_distance(before, after) / size);
      ++files, strokes += before.strokes.size(), texts += before.texts.size();
    }
  }
  BOOST_TEST(worst <= 1e-12);
  BOOST_TEST_MESSAGE(files << " files, " << strokes << " strokes, " << texts << " runs of text, off by " << worst << " of the size");
}

BOOST_AUTO_TEST_SUITE_END()
