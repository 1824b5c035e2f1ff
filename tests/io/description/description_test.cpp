#include <boost/test/unit_test.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <random>

#include "formats/json/json.h"
#include "formats/svg/path.h"
#include "io/io.h"
#include "kernel/nurbs/join.h"
#include "kernel/nurbs/positive_weights.h"
#include "tests/support/corpus.h"
#include "tests/support/paths.h"

using namespace trimloop;

namespace {

io::ReadResult read(std::string text, const std::string& name = "x.json") { return io::read_bytes(std::move(text), name); }

std::string only_fatal(const io::ReadResult& r) {
  BOOST_TEST(!r.usable);
  BOOST_TEST(r.model.parts.empty());
  std::string all;
  for (const Diagnostic& d : r.report.items()) all += std::string(d.rule->id) + " " + d.text + "\n";
  return all;
}

bool mentions(const std::string& text, std::string_view what) {
  const bool found = text.find(what) != std::string::npos;
  if (!found) BOOST_TEST_MESSAGE("got: " << text);
  return found;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(descriptions)

BOOST_AUTO_TEST_CASE(every_sample_description_is_read_and_written_everywhere) {
  std::size_t seen = 0;
  for (const auto& entry : std::filesystem::directory_iterator(trimloop::test::source_dir() / "samples/descriptions")) {
    const auto in = io::read(entry.path());
    BOOST_REQUIRE(in.usable);
    BOOST_TEST(in.report.count(Severity::Error) == 0u);
    for (const io::Format format : {io::Format::Iges, io::Format::Step, io::Format::Json}) {
      io::WriteOptions how;
      how.format = format;
      how.to_nurbs = true;
      const auto out = io::encode(in.model, in.source, how);
      BOOST_REQUIRE(out.has_value());
      if (format == io::Format::Step) continue;
      const auto again = io::read_bytes(out->bytes, format == io::Format::Iges ? "x.igs" : "x.json");
      BOOST_TEST(again.usable);
      BOOST_TEST(again.report.count(Severity::Error) == 0u);
    }
    ++seen;
  }
  BOOST_TEST(seen >= 2u);
}

BOOST_AUTO_TEST_CASE(a_developable_strip_is_made_or_refused) {
  const auto described = [](const char* second) {
    return io::read_bytes(fmt::format(R"({{"shapes": [{{"type": "developable", "rulings": 33, "first": {{"type": "circle", "radius": 4,
        "start_deg": 0, "end_deg": 180}}, "second": {}}}]}})", second), "strip.json");
  };
  const auto cone = described(R"({"type": "circle", "centre": [0, 0, 3], "radius": 1, "start_deg": 0, "end_deg": 180})");
  BOOST_REQUIRE(cone.usable);
  BOOST_TEST(cone.report.count(Severity::Error) == 0u);
  const Surface& surface = *cone.model.parts[0].bodies[0].faces[0].surface;
  for (const double u : {0.2, 0.5, 0.8}) {
    const Point p = evaluate(surface, {u, 0.5});
    BOOST_TEST(std::abs(std::hypot(p.x, p.y) - (4 - p.z)) <= 2e-3);
  }
  const auto skew = described(R"({"type": "line", "start": [0, 9, 0], "end": [0, 9, 5]})");
  BOOST_TEST(!skew.usable);
  BOOST_TEST(skew.report.count("DS-02") == 1u);
}

BOOST_AUTO_TEST_CASE(the_schema_names_every_type_that_is_read) {
  const std::string text = trimloop::test::read_file(trimloop::test::source_dir() / "docs/nurbs-schema.json");
  const auto schema = json::parse(text, {});
  BOOST_REQUIRE(schema.has_value());
  std::size_t types = 0;
  for (const char* kind : {"curve", "surface"}) {
    for (const json::Value& shape : schema->find("$defs")->find(kind)->find("oneOf")->items) {
      const std::string type = shape.find("title")->string;
      // A shape of nothing but its type: what is missing is exactly what the schema requires.
      const std::string said = only_fatal(read("{\"type\": \"" + type + "\"}"));
      for (const json::Value& needed : shape.find("required")->items) {
        if (needed.string == "type") continue;
        BOOST_TEST(mentions(said, "$." + needed.string + ": this member is missing"));
      }
      // And no member of the schema is unknown.
      std::string all = "{\"type\": \"" + type + "\"";
      for (const auto& member : shape.find("properties")->members)
        if (member.first != "type") all += ", \"" + member.first + "\": null";
      BOOST_TEST(!mentions(only_fatal(read(all + "}")), "DS-03"));
      ++types;
    }
  }
  BOOST_TEST(types == 43u);
  BOOST_TEST(mentions(only_fatal(read("{\"type\": \"blob\"}")), "is no shape"));
}

BOOST_AUTO_TEST_CASE(what_is_wrong_is_named_with_its_path) {
  const auto said = [](const char* text) { return only_fatal(read(text)); };
  BOOST_TEST(mentions(said("{\"shapes\": ["), "DS-01"));
  BOOST_TEST(mentions(said("{\"shapes\": []}"), "$.shapes: 0 entries"));
  BOOST_TEST(mentions(said("{\"unit\": \"cubit\", \"shapes\": [{\"type\": \"line\", \"start\": [0,0], \"end\": [1,0]}]}"), "$.unit"));
  BOOST_TEST(mentions(said(R"({"shapes": [{"type": "bezier", "points": [[0,0],[1,"x"]]}]})"), "$.shapes[0].points[1][1]: a number is expected"));
  BOOST_TEST(mentions(said(R"({"type": "bezier", "points": [[0,0],[1,1e999]]})"), "1e999"));
  BOOST_TEST(mentions(said(R"({"type": "bezier", "points": [[0,0],[1,1]], "wieghts": [1,1]})"), "DS-03 $.wieghts"));
  BOOST_TEST(mentions(said(R"({"type": "bezier", "points": [[0,0],[1,1]], "weights": [1]})"), "1 weights for 2 points"));
  BOOST_TEST(mentions(said(R"({"type": "nurbs", "degree": 3, "points": [[0,0],[1,1]]})"), "degree 3 needs 4"));
  BOOST_TEST(mentions(said(R"({"type": "nurbs", "degree": 1, "points": [[0,0],[1,1]], "knots": [0,0,1,0]})"), "DS-04"));
  BOOST_TEST(mentions(said(R"({"type": "nurbs", "degree": 1.5, "points": [[0,0],[1,1]]})"), "$.degree: a whole number"));
  BOOST_TEST(mentions(said(R"({"type": "overhauser", "points": [[0,0],[1,1],[1,1],[2,0]]})"), "points 1 and 2 coincide"));
  BOOST_TEST(mentions(said(R"({"type": "hermite", "points": [[0,0],[1,1]], "tangents": [[1,0],[1,0]], "parameters": [1, 0]})"), "parameters ascend"));
  BOOST_TEST(mentions(said(R"({"type": "ruled", "first": {"type": "line", "start": [0,0], "end": [0,0]}, "second": {"type": "line", "start": [0,0], "end": [1,0]}})"),
                      "$.first.end: the line has no length"));
  BOOST_TEST(mentions(said(R"({"type": "subdivision", "points": [[0,0],[1,0],[0,1]], "faces": [[0,1,7]]})"), "$.faces[0][2]"));
  BOOST_TEST(mentions(said(R"({"type": "subdivision", "points": [[0,0],[1,0],[0,1],[0,0,1],[0,0,2]], "faces": [[0,1,2],[1,0,3],[0,1,4]]})"), "3 faces"));
  BOOST_TEST(mentions(said(R"({"type": "subdivision", "scheme": "sqrt3", "points": [[0,0],[1,0],[0,1]], "faces": [[0,1,2]]})"), "no NURBS"));
  BOOST_TEST(mentions(said(R"({"type": "circle", "radius": -1})"), "a positive number is expected"));
  BOOST_TEST(mentions(said("[1]"), "an object is expected"));
}

BOOST_AUTO_TEST_CASE(units_scale_what_is_described) {
  const auto in = read(R"({"unit": "inch", "shapes": [{"type": "line", "start": [0, 0], "end": [1, 2, 3]}]})");
  BOOST_REQUIRE(in.usable);
  BOOST_TEST(distance(end_point(in.model.parts[0].curves[0].curve), {25.4, 50.8, 76.2}) <= 1e-13);
}

BOOST_AUTO_TEST_CASE(power_series_are_exact_over_any_range) {
  const auto in = read(R"({"type": "power", "coefficients": [[1, 2], [0, -3], [4, 0], [-1, 5]], "range": [-2, 3]})");
  BOOST_REQUIRE(in.usable);
  const Curve& c = in.model.parts[0].curves[0].curve;
  for (double t = -2; t <= 3; t += 0.25)
    BOOST_TEST(distance(evaluate(c, t), {1 + 4 * t * t - t * t * t, 2 - 3 * t + 5 * t * t * t, 0}) <= 1e-12);
}

BOOST_AUTO_TEST_CASE(helix_keeps_its_bound) {
  const auto in = read(R"({"type": "helix", "radius": 7, "pitch": 3, "turns": 2.5, "tolerance": 0.001})");
  BOOST_REQUIRE(in.usable);
  double bound = 0;
  for (const Diagnostic& d : in.report.items()) bound = std::max(bound, d.measured);
  BOOST_TEST(bound <= 0.001);
  const Curve& c = in.model.parts[0].curves[0].curve;
  double worst = 0;
  for (int i = 0; i <= 20000; ++i) {
    const double t = range(c).at(i / 20000.0);
    worst = std::max(worst, distance(evaluate(c, t), {7 * std::cos(t), 7 * std::sin(t), 3 * t / two_pi}));
  }
  BOOST_TEST(worst <= bound);
  BOOST_TEST(worst >= 0.3 * bound);
}

BOOST_AUTO_TEST_CASE(transcendental_curves_keep_their_bounds) {
  struct Case {
    const char* text;
    Point (*at)(double);
  };
  const Case cases[] = {
      {R"({"type": "sine", "amplitude": 3, "wavelength": 10, "range": [-7, 12], "tolerance": 1e-5})",
       [](double t) { return Point{t, 3 * std::sin(two_pi * t / 10), 0}; }},
      {R"({"type": "catenary", "parameter": 4, "range": [-10, 12], "tolerance": 1e-4})", [](double t) { return Point{t, 4 * std::cosh(t / 4), 0}; }},
      {R"({"type": "cycloid", "radius": 2, "end_deg": 800, "tolerance": 1e-6})",
       [](double t) { return Point{2 * t - 2 * std::sin(t), 2 - 2 * std::cos(t), 0}; }},
      {R"({"type": "spiral", "radius": 1, "growth_per_turn": 3, "start_deg": -90, "end_deg": 1200, "tolerance": 1e-5})",
       [](double t) { return Point{(1 + 3 * t / two_pi) * std::cos(t), (1 + 3 * t / two_pi) * std::sin(t), 0}; }},
      {R"({"type": "spiral", "form": "logarithmic", "radius": 0.5, "factor_per_turn": 3, "end_deg": 1080, "tolerance": 1e-5})",
       [](double t) {
         const double r = 0.5 * std::pow(3, t / two_pi);
         return Point{r * std::cos(t), r * std::sin(t), 0};
       }},
      {R"({"type": "involute", "radius": 2, "end_deg": 700, "tolerance": 1e-5})",
       [](double t) { return Point{2 * (std::cos(t) + t * std::sin(t)), 2 * (std::sin(t) - t * std::cos(t)), 0}; }}};
  for (const Case& c : cases) BOOST_TEST_CONTEXT(c.text) {
    const auto in = read(c.text);
    BOOST_REQUIRE(in.usable);
    BOOST_REQUIRE(in.report.items().size() == 1u);
    const double bound = in.report.items()[0].measured;
    const Curve& curve = in.model.parts[0].curves[0].curve;
    BOOST_TEST(continuity(std::get<NurbsCurve>(curve.shape)).parametric >= 1);
    double worst = 0;
    for (int i = 0; i <= 20000; ++i) {
      const double t = range(curve).at(i / 20000.0);
      worst = std::max(worst, distance(evaluate(curve, t), c.at(t)));
    }
    BOOST_TEST(worst <= bound);
    BOOST_TEST(worst >= 0.1 * bound);  // no idle promise
  }
  BOOST_TEST(mentions(only_fatal(read(R"({"type": "sine", "amplitude": 1, "wavelength": 1, "range": [0, 10], "tolerance": 1e-30})")), "pieces"));
  BOOST_TEST(mentions(only_fatal(read(R"({"type": "catenary", "parameter": 0.001, "range": [0, 10]})")), "DS-04"));
  BOOST_TEST(mentions(only_fatal(read(R"({"type": "spiral", "growth_per_turn": 1, "end_deg": -5})")), "$.end_deg: the angle runs upwards"));
}

BOOST_AUTO_TEST_CASE(cubic_segments_go_from_svg_to_iges_and_back_with_their_bits) {
  std::mt19937_64 engine(3);
  std::vector<svg::Segment> path(1);
  for (int i = 0; i < 2999; ++i) {
    svg::Segment s;
    s.kind = i % 500 == 499 ? svg::Segment::Kind::Move : svg::Segment::Kind::Cubic;
    for (std::size_t k = 0; k < (s.kind == svg::Segment::Kind::Move ? 1u : 3u); ++k)
      for (double& c : s.at[k]) c = static_cast<double>(static_cast<std::int64_t>(engine())) * 0x1p-55;
    path.push_back(s);
  }
  const auto in = io::read_bytes("<svg><path d=\"" + svg::path_text(path) + "\"/></svg>", "x.svg");
  BOOST_REQUIRE(in.usable);
  io::WriteOptions how;
  how.format = io::Format::Iges;
  const auto iges = io::encode(in.model, in.source, how);
  BOOST_REQUIRE(iges.has_value());
  const auto back = io::read_bytes(iges->bytes, "x.igs");
  BOOST_REQUIRE(back.usable);
  how.format = io::Format::Svg;
  const auto drawing = io::encode(back.model, back.source, how);
  BOOST_REQUIRE(drawing.has_value());
  std::vector<svg::Segment> again;
  for (std::size_t at = drawing->bytes.find(" d=\""); at != std::string::npos; at = drawing->bytes.find(" d=\"", at)) {
    at += 4;
    const auto part = svg::parse_path(std::string_view(drawing->bytes).substr(at, drawing->bytes.find('"', at) - at));
    again.insert(again.end(), part->begin(), part->end());
  }
  BOOST_REQUIRE(again.size() == path.size());
  for (std::size_t i = 0; i < path.size(); ++i) BOOST_REQUIRE((again[i].at == path[i].at));
}

BOOST_AUTO_TEST_CASE(arcs_of_drawings_end_where_they_say) {
  std::mt19937 engine(9);
  std::uniform_real_distribution<double> coordinate(-50, 50), radius(1, 60), angle(-180, 180);
  for (int i = 0; i < 200; ++i) {
    svg::Segment move, arc;
    move.at[0] = {coordinate(engine), coordinate(engine)};
    arc.kind = svg::Segment::Kind::Arc;
    arc.at[0] = {coordinate(engine), coordinate(engine)};
    arc.rx = radius(engine), arc.ry = i % 3 ? radius(engine) : arc.rx;
    arc.rotation_deg = angle(engine);
    arc.large = engine() % 2, arc.sweep = engine() % 2;
    const auto in = io::read_bytes("<svg><path d=\"" + svg::path_text({move, arc}) + "\"/></svg>", "x.svg");
    BOOST_REQUIRE(in.usable);
    const Curve& c = in.model.parts[0].curves[0].curve;
    BOOST_TEST(distance(start_point(c), {move.at[0][0], -move.at[0][1], 0}) <= 1e-9);
    BOOST_TEST(distance(end_point(c), {arc.at[0][0], -arc.at[0][1], 0}) <= 1e-9);
    const double turn = range(c).length();
    BOOST_TEST((arc.large ? turn >= pi - 1e-6 : turn <= pi + 1e-6));
  }
}

BOOST_AUTO_TEST_CASE(tables_and_meshes_and_glyphs_become_models) {
  const auto table = io::read_bytes("x,y,z\n0,0,0\n1,2,3\n4,5,6\n\n7,8,9\n", "x.csv");
  BOOST_REQUIRE(table.usable);
  BOOST_TEST(table.model.parts[0].curves.size() == 1u);
  BOOST_TEST(table.model.parts[0].points.size() == 1u);
  BOOST_TEST(mentions(only_fatal(io::read_bytes("0,0\n1,x\n", "x.csv")), "line 2"));

  std::string cube = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n"
                     "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  const auto mesh = io::read_bytes(cube, "x.obj");
  BOOST_REQUIRE(mesh.usable);
  BOOST_TEST(mesh.model.parts[0].bodies[0].faces.size() > 24u);
  BOOST_TEST(mentions(only_fatal(io::read_bytes(cube + "f 1 3 8\n", "x.obj")), "3 faces"));

  const std::string font = trimloop::test::read_file("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf");
  if (font.empty()) return;
  io::ReadOptions how;
  how.font_text = "NURBS";
  how.em_mm = 20.48;
  const auto text = io::read_bytes(font, "x.ttf", how);
  BOOST_REQUIRE(text.usable);
  BOOST_TEST(text.model.parts[0].curves.size() == 8u);  // N, U, R with its hole, B with two, S
  for (const FreeCurve& c : text.model.parts[0].curves) BOOST_TEST(distance(start_point(c.curve), end_point(c.curve)) <= 1e-12);
}

BOOST_AUTO_TEST_CASE(weights_of_zero_and_less_are_written_positive_or_refused) {
  // The half circle with an ideal middle point, the rest of a circle by a negative weight, a hyperbola through infinity.
  const auto in = read(R"({"shapes": [
    {"type": "bezier", "points": [[1, 0], [0, 1], [-1, 0]], "weights": [1, 0, 1]},
    {"type": "conic", "start": [1, 0], "apex": [1, 1], "end": [0, 1], "weight": -0.70710678118654752},
    {"type": "conic", "start": [1, 0], "apex": [1, 1], "end": [0, 1], "weight": -2}]})");
  BOOST_REQUIRE(in.usable);
  io::WriteOptions how;
  how.format = io::Format::Iges;
  const auto out = io::encode(in.model, in.source, how);
  BOOST_REQUIRE(out.has_value());
  BOOST_TEST(out->losses.size() == 1u);
  BOOST_TEST(mentions(out->losses[0], "infinity"));
  const auto back = io::read_bytes(out->bytes, "x.igs");
  BOOST_REQUIRE(back.model.parts[0].curves.size() == 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& curve = std::get<NurbsCurve>(back.model.parts[0].curves[i].curve.shape);
    for (const Hpoint& h : curve.poles()) BOOST_TEST(h.w > 0);
    for (int k = 0; k <= 100; ++k) {
      const Point p = evaluate(curve, curve.range().at(k / 100.0));
      BOOST_TEST(std::abs(p.x * p.x + p.y * p.y - 1) <= 1e-14);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
