// docs/losses.md: each kind that it lists has a fixture here, and is named in the list of losses of that fixture.

#include <boost/test/unit_test.hpp>

#include <fstream>
#include <functional>
#include <map>

#include "io/io.h"
#include "kernel/geometry/surface.h"
#include "tests/support/builders.h"
#include "tests/support/paths.h"

using namespace trimloop;

namespace {

struct Row {
  std::string kind, phrase;
};

// Rows of the page's tables: | kind | `phrase` | ... |
std::vector<Row> rows_of_page() {
  std::vector<Row> rows;
  std::ifstream page(trimloop::test::source_dir() / "docs" / "losses.md");
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("| step-", 0) != 0 && line.rfind("| iges-", 0) != 0) continue;
    const std::size_t end = line.find(' ', 2), from = line.find('`') + 1, to = line.find('`', from);
    rows.push_back({line.substr(2, end - 2), line.substr(from, to - from)});
  }
  return rows;
}

Model one_part() {
  Model model;
  model.name = "fixture";
  model.parts.resize(1);
  model.parts[0].points.push_back({{1, 2, 3}, {}, {}});  // so that there is always something to write
  return model;
}

Model with_body(Body body) {
  Model model = one_part();
  model.parts[0].bodies.push_back(std::move(body));
  return model;
}

Model with_curve(Curve curve) {
  Model model = one_part();
  model.parts[0].curves.push_back({std::move(curve), {}, {}});
  return model;
}

Model with_occurrence(const Transform& t, const Attributes& attributes, bool empty_part = false) {
  Model model = one_part();
  model.parts.emplace_back();
  model.parts[1].name = "pin";
  if (!empty_part) model.parts[1].bodies.push_back(test::cylinder({0, 0, 0}, 1, 2));
  model.parts[0].instances.push_back({1, t, model.add(attributes), {}});
  return model;
}

// An occurrence of an assembly, which has no shape of its own.
Model with_assembly(const Attributes& attributes) {
  Model model = with_occurrence({}, {});
  model.parts.emplace_back();
  model.parts[2].name = "pair";
  model.parts[2].instances = {{1, {}, {}, {}}, {1, Transform::translation({5, 0, 0}), {}, {}}};
  model.parts[0].instances.push_back({2, {}, model.add(attributes), {}});
  return model;
}

Body with_failed_face() {
  Body body = test::plate(10, 10, {});
  Face failed;
  failed.surface = body.faces[0].surface;
  failed.status = FaceStatus::Failed;
  failed.reason = "for the test";
  body.add(failed);
  return body;
}

// A plate whose surface was replaced by one that has no points of its own.
Body with_degenerate_surface() {
  Body body = test::plate(10, 10, {});
  Extrusion nowhere;
  nowhere.directrix = std::make_shared<const Curve>(Curve{Line{{0, 0, 0}, {0, 0, 0}}});
  nowhere.direction = {0, 0, 0};
  body.faces[0].surface = std::make_shared<const Surface>(Surface{nowhere});
  return body;
}

Body open_solid() {  // one side of it failed
  Body body = test::box({0, 0, 0}, {1, 1, 1});
  body.faces[3].status = FaceStatus::Failed;
  body.faces[3].reason = "for the test";
  body.faces[3].loops.clear();
  return body;
}

// A quarter of a circle against a line, matched by angle: no rational surface runs like that.
Body ruled_face() {
  Circle arc;
  arc.radius = 5;
  arc.range = {0, pi / 2};
  const auto rail = std::make_shared<const Curve>(Curve{arc});
  const auto line = std::make_shared<const Curve>(Curve{Line{{7, 0, 4}, {0, 7, 4}}});
  Body body = test::plate(1, 1, {});  // over [0, 1] x [0, 1]
  body.faces[0].surface = std::make_shared<const Surface>(Surface{make_ruled(rail, line)});
  for (Edge& e : body.edges) e.curve = nullptr;
  return body;
}

// An edge known only as a zigzag in parameter space, with so many bends that no spline follows it to the resolution.
Body lifted_edge() {
  Body body = ruled_face();
  Coedge& c = body.loops[0].coedges[0];
  std::vector<Point> poles;
  const int n = 3000;
  for (int i = 0; i < n; ++i) poles.push_back({i / (n - 1.0), i % 2 ? 0.9 : 0.0, 0});
  poles.front() = {0, 0, 0};
  poles.back() = {1, 0, 0};
  std::vector<double> knots(4, 0.0);
  for (int i = 1; i < n - 3; ++i) knots.push_back(double(i) / (n - 3));
  knots.insert(knots.end(), 4, 1.0);
  c.pcurve.curve.shape = *NurbsCurve::from_cartesian(3, knots, poles, {});
  c.pcurve_range = {0, 1};
  body[c.edge].range = {0, 1};
  return body;
}

// A plate whose first side, as a model curve, runs a thousandth of its size beside the border of the face.
Body second_border() {
  Body body = test::plate(10, 10, {});
  Coedge& c = body.loops[0].coedges[0];
  Edge& e = body[c.edge];
  const auto moved = transformed(*e.curve, Transform::translation({0, 0, 0.01}));
  e.curve = std::make_shared<const Curve>(*moved);
  c.gap_mm = 0.01;
  return body;
}

// The side of a cylinder whose seam came as two edges, a hair apart.
Body two_seam_edges() {
  Body body = test::cylinder({0, 0, 0}, 2, 5);
  for (Face& f : body.faces) {
    if (!std::holds_alternative<Cylinder>(f.surface->shape)) continue;
    std::vector<Coedge>& coedges = body[f.loops[0]].coedges;
    for (std::size_t i = 0; i < coedges.size(); ++i) {
      for (std::size_t j = i + 1; j < coedges.size(); ++j) {
        if (coedges[i].edge != coedges[j].edge) continue;
        Edge twin = body[coedges[j].edge];
        twin.curve = std::make_shared<const Curve>(*transformed(*twin.curve, Transform::translation({1e-4, 0, 0})));
        coedges[j].edge = body.add(std::move(twin));
        return body;
      }
    }
  }
  return body;
}

Transform flat() {
  Transform t;
  t.r[2][2] = 0;
  return t;
}

Attributes attributes(std::optional<Colour> colour, int layer, bool visible) { return {"", colour, layer, visible}; }

std::map<std::string, std::function<Model()>> fixtures() {
  const auto endless = [] {
    Line ray;
    ray.end = {1, 0, 0};
    ray.range = {0, infinity};
    return with_curve(Curve{ray});
  };
  std::map<std::string, std::function<Model()>> f;
  f["step-failed-face"] = f["iges-failed-face"] = [] { return with_body(with_failed_face()); };
  f["step-face-geometry"] = [] { return with_body(with_degenerate_surface()); };
  f["iges-face-surface"] = [] {
    Body body = test::plate(10, 10, {});
    Revolution nothing;
    nothing.generatrix = std::make_shared<const Curve>(Curve{CompositeCurve{}});
    body.faces[0].surface = std::make_shared<const Surface>(Surface{nothing});
    return with_body(std::move(body));
  };
  f["step-endless-curve"] = endless;
  f["step-degenerate-curve"] = [] { return with_curve(Curve{Line{{1, 1, 1}, {1, 1, 1}}}); };
  f["step-open-solid"] = f["iges-open-solid"] = [] { return with_body(open_solid()); };
  f["step-ruled"] = [] { return with_body(ruled_face()); };
  f["step-lifted-edge"] = [] {
    Model model = with_body(lifted_edge());
    model.resolution_mm = 1e-9;
    return model;
  };
  f["step-second-border"] = [] { return with_body(second_border()); };
  f["step-seam-edge"] = [] { return with_body(two_seam_edges()); };
  f["step-flat-occurrence"] = f["iges-flat-occurrence"] = [] { return with_occurrence(flat(), {}); };
  f["step-occurrence-colour"] = [] { return with_assembly(attributes(Colour{1, 0, 0}, 0, true)); };
  f["step-occurrence-hidden"] = [] { return with_assembly(attributes({}, 0, false)); };
  f["step-occurrence-layer"] = [] { return with_assembly(attributes({}, 3, true)); };
  f["step-mesh-ap214"] = f["iges-mesh"] = [] {
    Model model = one_part();
    PolygonMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.faces.push_back({{{0, {}}, {1, {}}, {2, {}}}, {{0, 1, 2}}, {}, {}, {}});
    model.parts[0].meshes.push_back(mesh);
    return model;
  };
  f["step-annotation"] = f["iges-annotation"] = [] {
    Model model = one_part();
    model.parts[0].annotation.push_back({"Linear Dimension", {{{0, 0, 0}, {1, 0, 0}}}, {}, {}, {}});
    return model;
  };
  f["iges-flat-text"] = [] {
    Model model = one_part();
    TextRun run;
    run.text = "nothing";
    model.parts[0].annotation.push_back({"General Note", {}, {run}, {}, {}});
    return model;
  };
  f["iges-surfaces"] = f["iges-conservative-poles"] = [] { return with_body(test::sphere({0, 0, 0}, 2)); };
  f["iges-conservative-text"] = [] { return with_occurrence({}, {"Gehäuse", {}, 0, true}); };
  f["step-drawing"] = [] {
    Model model = one_part();
    model.drawings.emplace_back();
    return model;
  };
  f["step-view"] = [] {
    Model model = one_part();
    model.views.emplace_back();
    return model;
  };
  f["step-pmi"] = f["iges-pmi"] = one_part;  // which the source has, not the model
  f["step-property"] = f["iges-property"] = one_part;
  f["step-other-data"] = f["iges-other-data"] = one_part;
  f["iges-empty-occurrence"] = [] { return with_occurrence({}, {}, true); };
  return f;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(losses)

BOOST_AUTO_TEST_CASE(every_kind_of_the_page_has_its_fixture) {
  auto all = fixtures();
  for (const Row& row : rows_of_page()) {
    BOOST_TEST_CONTEXT(row.kind) {
      const auto fixture = all.find(row.kind);
      BOOST_TEST((fixture != all.end()), "no fixture");
      if (fixture == all.end()) continue;
      io::WriteOptions options;
      options.format = row.kind[0] == 's' ? io::Format::Step : io::Format::Iges;
      if (row.kind.find("ap214") != std::string::npos) options.step_schema = io::StepSchema::Ap214;
      if (row.kind.find("conservative") != std::string::npos) options.iges_profile = io::IgesProfile::Conservative;
      if (row.kind == "iges-surfaces") options.iges_bodies = io::IgesBodies::Surfaces;
      io::SourceInfo source;
      if (row.kind.find("pmi") != std::string::npos) source.pmi["dimensions"] = 2;
      if (row.kind.find("property") != std::string::npos) {
        options.step_schema = io::StepSchema::Ap214;
        source = io::read(trimloop::test::source_dir() / "tests/data/step/pmi.stp").source;
      }
      if (row.kind.find("other-data") != std::string::npos) {
        source = io::read(trimloop::test::source_dir() / "tests/data/step/approval.stp").source;
      }
      const auto written = io::encode(fixture->second(), source, options);
      BOOST_REQUIRE_MESSAGE(written, (written ? std::string() : written.error().text));
      std::string told;
      bool named = false;
      for (const std::string& loss : written->losses) {
        named = named || loss.find(row.phrase) != std::string::npos;
        told += loss + "; ";
      }
      BOOST_TEST(named, "the losses are: " << told);
      all.erase(fixture);
    }
  }
  for (const auto& [kind, fixture] : all) BOOST_TEST(false, "docs/losses.md does not list " << kind);
}

// What stands in a STEP file and no model means is counted, whichever file is written; what is written anew is not.
BOOST_AUTO_TEST_CASE(other_data_of_a_step_file_is_counted) {
  const io::ReadResult in = io::read(trimloop::test::source_dir() / "tests/data/step/approval.stp");
  const std::string expected = "other data: 1 APPLIED_APPROVAL_ASSIGNMENT, 1 APPLIED_DOCUMENT_REFERENCE, 1 APPROVAL, 1 APPROVAL_STATUS, "
                               "1 DOCUMENT, 1 DOCUMENT_TYPE";
  for (const auto& [format, schema] : {std::pair{io::Format::Step, io::StepSchema::Ap242}, std::pair{io::Format::Step, io::StepSchema::Ap214},
                                       std::pair{io::Format::Iges, io::StepSchema::Ap242}}) {
    io::WriteOptions options;
    options.format = format;
    options.step_schema = schema;
    const auto written = io::encode(in.model, in.source, options);
    BOOST_REQUIRE_MESSAGE(written, (written ? std::string() : written.error().text));
    BOOST_TEST(written->losses == std::vector<std::string>{expected}, boost::test_tools::per_element());
  }
}

BOOST_AUTO_TEST_SUITE_END()
