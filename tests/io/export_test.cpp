// Model -> IGES -> model: faces, areas, outward sides, attributes, placements, free curves and digits survive.

#include <boost/test/unit_test.hpp>

#include <cmath>

#include "formats/iges/records/any.h"
#include "io/io.h"
#include "kernel/check/measure.h"
#include "kernel/heal/make_face.h"
#include "tests/support/builders.h"
#include "tests/support/iges_text.h"

using namespace trimloop;

namespace {

// --- Building ------------------------------------------------------------------------------------------------------

template <class Shape>
CurvePtr curve(Shape shape) {
  return std::make_shared<const Curve>(Curve{std::move(shape)});
}

template <class Shape>
heal::FaceInput face(Shape shape) {
  heal::FaceInput input;
  input.surface = std::make_shared<const Surface>(Surface{std::move(shape)});
  return input;
}

heal::TrimLoop loop_of(std::vector<Curve2> curves) {
  heal::TrimLoop loop;
  for (Curve2& c : curves) {
    heal::TrimSegment segment;
    segment.pcurve = std::move(c);
    loop.segments.push_back(std::move(segment));
  }
  return loop;
}

heal::TrimLoop polygon(const std::vector<Uv>& corners) {
  std::vector<Curve2> sides;
  for (std::size_t i = 0; i < corners.size(); ++i)
    sides.push_back(make_line2(corners[i], corners[(i + 1) % corners.size()]));
  return loop_of(std::move(sides));
}

heal::TrimLoop round_loop(Uv centre, double radius) {
  Circle circle;
  circle.frame.origin = {centre.u, centre.v, 0};
  circle.radius = radius;
  return loop_of({Curve2{Curve{circle}}});
}

Model model_of(Body body) {
  Model model;
  model.name = "test";
  model.parts.emplace_back();
  model.parts[0].bodies.push_back(std::move(body));
  return model;
}

Model model_of(const std::vector<heal::FaceInput>& faces) {
  Body body;
  for (const heal::FaceInput& input : faces) heal::add_face(body, input);
  return model_of(std::move(body));
}

// A plane spline of four spans, degree 3, no symmetry.
NurbsCurve spline() {
  const std::vector<Point> poles = {{0, 0, 0}, {3, 7, 0}, {9, -4, 0}, {14, 5, 0}, {21, 6, 0}, {25, -2, 0}, {31, 1, 0}};
  auto made = NurbsCurve::from_cartesian(3, {0, 0, 0, 0, 0.3, 0.7, 1.1, 2, 2, 2, 2}, poles, {});
  BOOST_REQUIRE(made);
  return *made;
}

NurbsSurface wavy() {
  std::vector<Point> points;  // u slowest
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 5; ++j) points.push_back({10.0 * i, 9.0 * j, 3 * std::sin(1.3 * i) * std::cos(0.9 * j)});
  auto made = NurbsSurface::from_cartesian(3, 2, {0, 0, 0, 0, 0.4, 0.7, 1, 1, 1, 1}, {0, 0, 0, 0.3, 0.8, 2, 2, 2}, points, {});
  BOOST_REQUIRE(made);
  return *made;
}

Circle arc(double radius, double from, double to, Point centre = {}) {
  Circle c;
  c.frame.origin = centre;
  c.radius = radius;
  c.range = {from, to};
  return c;
}

Ellipse ellipse_arc(double a, double b, double from, double to) {
  Ellipse e;
  e.a = a;
  e.b = b;
  e.range = {from, to};
  return e;
}

// --- Comparing -----------------------------------------------------------------------------------------------------

struct Written {
  io::WriteResult file;
  io::ReadResult back;
};

Written there_and_back(const Model& model, bool to_nurbs = false) {
  io::WriteOptions options;
  options.format = io::Format::Iges;
  options.to_nurbs = to_nurbs;
  auto file = io::encode(model, {}, options);
  BOOST_REQUIRE_MESSAGE(file, (file ? "" : file.error().text));
  for (const std::string& loss : file->losses) BOOST_ERROR("lost: " << loss);
  io::ReadResult back = io::read_bytes(file->bytes, "test.igs");
  for (const Diagnostic& d : back.report.items())
    if (d.severity == Severity::Error || d.severity == Severity::Fatal) BOOST_ERROR(d.rule->id << ": " << d.text);
  BOOST_REQUIRE(back.usable);
  return {std::move(*file), std::move(back)};
}

// What a face amounts to, whatever its parametrization: its area, its outward vector area and its flux about a point.
struct FaceMeasure {
  double area = 0;
  Vector outward;
  double flux = 0;
  FaceStatus status;
  std::string reason;
};

std::vector<FaceMeasure> measures(const Model& model) {
  const Point eye{-311, 127, 208};
  std::vector<FaceMeasure> out;
  for (const Part& part : model.parts) {
    for (const Body& body : part.bodies) {
      for (std::uint32_t i = 0; i < body.faces.size(); ++i) {
        const auto flux = [&](Point from) { return 3 * volume_contribution(body, FaceId{i}, from, 1e-11).value; };
        const double at_eye = flux(eye);
        constexpr double step = 1000;  // flux(eye + d) = flux(eye) - d . vector area
        const Vector outward{(at_eye - flux(eye + Vector{step, 0, 0})) / step, (at_eye - flux(eye + Vector{0, step, 0})) / step,
                             (at_eye - flux(eye + Vector{0, 0, step})) / step};
        out.push_back({area(body, FaceId{i}, 1e-11).value, outward, at_eye, body.faces[i].status, body.faces[i].reason});
      }
    }
  }
  return out;
}

void check_same_faces(const Model& before, const Model& after, double tolerance = 1e-9) {
  const auto a = measures(before), b = measures(after);
  BOOST_REQUIRE_EQUAL(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    BOOST_TEST_CONTEXT("face " << i) {
      BOOST_TEST((b[i].status == FaceStatus::Ok), b[i].reason);
      BOOST_TEST(std::abs(a[i].area - b[i].area) <= tolerance * a[i].area, a[i].area << " became " << b[i].area);
      const Vector turned = b[i].outward - a[i].outward;
      BOOST_TEST(norm(turned) <= tolerance * a[i].area, "vector area off by " << norm(turned));
      BOOST_TEST(std::abs(a[i].flux - b[i].flux) <= tolerance * 400 * a[i].area, "flux " << a[i].flux << " became " << b[i].flux);
    }
  }
}

void check_survives(const Model& model) {
  for (const bool to_nurbs : {false, true}) {
    BOOST_TEST_CONTEXT((to_nurbs ? "as NURBS" : "as it is")) {
      const Written w = there_and_back(model, to_nurbs);
      // A pcurve off by d moves the border by d: an area error of up to d times the border's length.
      const double area = std::max(1.0, measure(model, {})->area_mm2);
      const double stated = w.file.nurbs.max_deviation_mm;
      BOOST_TEST(stated <= 0.01 * model.resolution_mm);
      check_same_faces(model, w.back.model, 1e-9 + 10 * stated / std::sqrt(area));
    }
  }
}

void check_survives_both_ways_round(heal::FaceInput input) {
  for (const bool reversed : {false, true}) {
    BOOST_TEST_CONTEXT((reversed ? "reversed" : "forward")) {
      input.reversed = reversed;
      check_survives(model_of(std::vector{input}));
    }
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(export_iges)

// --- Faces ---------------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(solids_made_by_hand_survive) {
  check_survives(model_of(test::box({1, 2, 3}, {11, 7, 33})));
  check_survives(model_of(test::cylinder({1, -2, 3}, 4, 25)));
  check_survives(model_of(test::cone({1, -2, 3}, 4, 9)));
  check_survives(model_of(test::sphere({5, 6, 7}, 12.5)));
  check_survives(model_of(test::torus({5, 6, 7}, 12.5, 3)));
  check_survives(model_of(test::plate(40, 30, {{10, 10, 4}, {25, 20, 6}})));
}

BOOST_AUTO_TEST_CASE(solids_stay_solids_and_share_their_edges) {
  for (const Body& body : {test::box({1, 2, 3}, {11, 7, 33}), test::cylinder({1, -2, 3}, 4, 25), test::cone({1, -2, 3}, 4, 9),
                           test::sphere({5, 6, 7}, 12.5), test::torus({5, 6, 7}, 12.5, 3)}) {
    const Model model = model_of(body);
    const Written w = there_and_back(model, false);
    const auto before = count(model), after = count(w.back.model);
    BOOST_REQUIRE((before && after));
    BOOST_TEST(after->solids == 1u);
    BOOST_TEST(after->shells == 1u);
    BOOST_TEST(after->edges == before->edges);
    const auto a = measure(model, {}), b = measure(w.back.model, {});
    BOOST_REQUIRE((a && b && a->volume_mm3 && b->volume_mm3));
    BOOST_TEST(*b->volume_mm3 == *a->volume_mm3, boost::test_tools::tolerance(1e-9));
  }
}

BOOST_AUTO_TEST_CASE(a_plane_with_holes_survives) {
  heal::FaceInput input = face(Plane{make_frame({1, 2, 3}, {1, 2, 2}, {2, -2, 1})});
  input.loops = {polygon({{0, 0}, {40, 5}, {35, 30}, {-3, 25}}), round_loop({10, 10}, 4), polygon({{20, 15}, {28, 15}, {24, 22}})};
  check_survives_both_ways_round(input);
}

BOOST_AUTO_TEST_CASE(parts_of_analytic_surfaces_survive) {
  const Frame frame = make_frame({1, 2, 3}, {1, 2, 2}, {2, -2, 1});
  const auto trimmed = [](auto shape, double v_lo, double v_hi) {
    heal::FaceInput input = face(shape);
    const double d = (v_hi - v_lo) / 10;
    input.loops = {polygon({{0.3, v_lo}, {2.1, v_lo}, {2.1, v_hi - d}, {1.9, v_hi}, {0.3, v_hi - d}}),
                   polygon({{0.8, v_lo + 3 * d}, {1.5, v_lo + 3 * d}, {1.2, v_lo + 6 * d}})};
    return input;
  };
  check_survives_both_ways_round(trimmed(Cylinder{frame, 7}, -2, 11));
  check_survives_both_ways_round(trimmed(Cone{frame, 7, 0.3}, -2, 11));
  check_survives_both_ways_round(trimmed(Sphere{frame, 12}, -0.9, 1.2));
  check_survives_both_ways_round(trimmed(Torus{frame, 12, 3}, -0.9, 2.2));
}

BOOST_AUTO_TEST_CASE(whole_periodic_surfaces_survive) {
  heal::FaceInput wall = face(Cylinder{make_frame({1, 2, 3}, {1, 2, 2}, {}), 7});
  wall.range_v = Interval{-3, 8};
  check_survives_both_ways_round(wall);
  heal::FaceInput cone = face(Cone{make_frame({1, 2, 3}, {1, 2, 2}, {}), 7, -0.4});
  cone.range_v = Interval{-3, 8};
  check_survives_both_ways_round(cone);
  check_survives_both_ways_round(face(Sphere{make_frame({1, 2, 3}, {1, 2, 2}, {}), 7}));
  check_survives_both_ways_round(face(Torus{make_frame({1, 2, 3}, {1, 2, 2}, {}), 7, 2}));
}

BOOST_AUTO_TEST_CASE(extrusions_survive) {
  for (const CurvePtr& directrix : {curve(spline()), curve(arc(9, 0.4, 2.5)), curve(ellipse_arc(9, 4, 0.4, 2.5)),
                                    curve(Line{{0, 0, 0}, {30, 4, 0}, {0, 1}}), curve(Polyline{{{0, 0, 0}, {9, 5, 0}, {14, 3, 0}}})}) {
    Extrusion swept;
    swept.directrix = directrix;
    swept.direction = {1, 2, 9};
    swept.range_v = {0, 2};
    heal::FaceInput input = face(swept);
    check_survives_both_ways_round(input);
    const Interval u = range(*directrix);
    const auto at = [&](double s, double v) { return Uv{u.lo + s * u.length(), v}; };
    input.loops = {polygon({at(0.1, 0.2), at(0.9, 0.3), at(0.7, 1.8), at(0.2, 1.5)})};
    check_survives_both_ways_round(input);
  }
}

BOOST_AUTO_TEST_CASE(revolutions_survive) {
  NurbsCurve profile = spline();
  Ellipse bulge = ellipse_arc(9, 4, 0.4, 2.5);
  bulge.frame = make_frame({0, 20, 0}, {0, 0, 1}, {1, 0, 0});
  for (const CurvePtr& generatrix : {curve(profile), curve(arc(9, 0.4, 2.5, {0, 20, 0})), curve(bulge),
                                     curve(Line{{0, 21, 0}, {30, 25, 0}, {0, 1}})}) {
    Revolution turned;
    turned.axis_origin = {0, -15, 0};
    turned.axis = {1, 0, 0};
    turned.generatrix = generatrix;
    turned.range_u = {0.2, 2.9};
    heal::FaceInput input = face(turned);
    check_survives_both_ways_round(input);
    const Interval v = range(*generatrix);
    const auto at = [&](double u, double s) { return Uv{u, v.lo + s * v.length()}; };
    input.loops = {polygon({at(0.4, 0.2), at(2.5, 0.3), at(2.2, 0.9), at(0.8, 0.8)})};
    check_survives_both_ways_round(input);
    turned.range_u = {0, two_pi};
    check_survives_both_ways_round(face(turned));
  }
}

BOOST_AUTO_TEST_CASE(ruled_surfaces_survive) {
  for (const bool backwards : {false, true}) {
    const CurvePtr second = backwards ? curve(Line{{30, 4, 12}, {0, 0, 15}, {0, 1}}) : curve(Line{{0, 0, 15}, {30, 4, 12}, {0, 1}});
    heal::FaceInput input = face(make_ruled(curve(spline()), second, backwards));
    check_survives_both_ways_round(input);
    input.loops = {polygon({{0.1, 0.1}, {0.8, 0.2}, {0.7, 0.9}, {0.2, 0.7}})};
    check_survives_both_ways_round(input);
  }
}

BOOST_AUTO_TEST_CASE(a_wavy_nurbs_face_with_a_hole_survives) {
  heal::FaceInput input = face(wavy());
  check_survives_both_ways_round(input);  // bare: its own border
  input.loops = {polygon({{0.1, 0.2}, {0.9, 0.1}, {0.95, 1.8}, {0.2, 1.7}}), round_loop({0.5, 0.9}, 0.2)};
  check_survives_both_ways_round(input);
}

BOOST_AUTO_TEST_CASE(a_part_of_a_nurbs_stays_that_part) {
  // The range is smaller than the knots: receivers that overlook it must still see the right face.
  check_survives_both_ways_round(face(wavy().with_range({0.2, 0.9}, {0.1, 1.5})));
}

BOOST_AUTO_TEST_CASE(a_knot_that_stands_once_too_often_without_a_jump_is_left_out) {
  // A step of a double between two knots can vanish when the curve is turned round: degree 1, knot 1 twice.
  const std::vector<Point> poles = {{0, 0, 0}, {5, 1, 0}, {5, 1, 0}, {9, 0, 0}, {12, 4, 0}};
  auto made = NurbsCurve::from_cartesian(1, {0, 0, 1, std::nextafter(1.0, 2.0), 2, 9, 9}, poles, {});
  BOOST_REQUIRE(made);
  Model model;
  model.parts.emplace_back();
  model.parts[0].curves.push_back({reversed(Curve{*made}), {}, {}});
  const auto& turned = std::get<NurbsCurve>(model.parts[0].curves[0].curve.shape);
  BOOST_REQUIRE(turned.knots()[3] == turned.knots()[4]);
  const Written w = there_and_back(model);
  const auto& found = w.back.model.parts[0].curves;
  BOOST_REQUIRE_EQUAL(found.size(), 1u);
  BOOST_TEST(length(found[0].curve) == length(model.parts[0].curves[0].curve), boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(offset_surfaces_survive) {
  for (const double distance : {1.5, -1.5}) {
    OffsetSurface offset{std::make_shared<const Surface>(Surface{wavy()}), distance};
    heal::FaceInput input = face(offset);
    input.loops = {polygon({{0.1, 0.2}, {0.9, 0.1}, {0.95, 1.8}, {0.2, 1.7}})};
    check_survives_both_ways_round(input);
  }
}

// --- Attributes, placements ----------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(names_colours_levels_and_visibility_survive) {
  const std::vector<Attributes> wanted = {{"first", Colour{0.3, 0.55, 0.85}, 7, true},
                                          {"second, with; odd 5Hsigns", Colour{1, 0, 0}, 0, true},
                                          {"", Colour{1.0 / 3, 0.1, 0.007}, 12, false},
                                          {"no colour", {}, 3, true}};
  Model model;
  model.parts.emplace_back();
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    Body body = test::plate(4 + static_cast<double>(i), 5, {});
    body.faces[0].attributes = model.add(wanted[i]);
    model.parts[0].bodies.push_back(std::move(body));
  }
  const Written w = there_and_back(model);
  std::vector<Attributes> found;
  for (const Body& body : w.back.model.parts[0].bodies) {
    for (const Face& f : body.faces) found.push_back(w.back.model[f.attributes ? f.attributes : body.attributes]);
  }
  BOOST_REQUIRE_EQUAL(found.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    BOOST_TEST_CONTEXT("face " << i) {
      BOOST_TEST(found[i].name == wanted[i].name);
      BOOST_TEST(found[i].layer == wanted[i].layer);
      BOOST_TEST(found[i].visible == wanted[i].visible);
      BOOST_REQUIRE(found[i].colour.has_value() == wanted[i].colour.has_value());
      if (!wanted[i].colour) continue;
      // What percent of a double can say comes back exactly; 1/3 and 0.007 lie between two such values.
      const double allowed = i == 2 ? 1e-16 : 0;
      BOOST_TEST(std::abs(found[i].colour->r - wanted[i].colour->r) <= allowed);
      BOOST_TEST(std::abs(found[i].colour->g - wanted[i].colour->g) <= allowed);
      BOOST_TEST(std::abs(found[i].colour->b - wanted[i].colour->b) <= allowed);
    }
  }
}

BOOST_AUTO_TEST_CASE(instances_keep_their_part_scale_rotation_and_mirror) {
  Model model;
  model.parts.resize(3);
  model.parts[1].name = "bracket";
  model.parts[1].bodies.push_back(test::plate(40, 30, {{10, 10, 4}}));
  model.parts[1].curves.push_back({Curve{arc(3, 0.1, 2)}, {}, {}});
  model.parts[2].name = "pair";
  const Transform turned = Transform::rotation({1, 2, 3}, normalized(Vector{1, 2, 2}), 0.7);
  Transform mirror;
  mirror.r[0][0] = -1;
  Instance instance;
  instance.part = 1;
  instance.transform = Transform::translation({5, 6, 7}) * turned * Transform::scale(2.5);
  model.parts[2].instances.push_back(instance);
  instance.transform = turned * mirror * Transform::translation({-9, 0, 1});
  model.parts[2].instances.push_back(instance);
  instance.part = 2;
  instance.transform = Transform::scale(0.5) * Transform::translation({100, 0, 0});
  model.parts[0].instances.push_back(instance);

  const Written w = there_and_back(model);
  const auto before = occurrences(model, 100, 10), after = occurrences(w.back.model, 100, 10);
  BOOST_REQUIRE((before && after));
  BOOST_REQUIRE_EQUAL(before->size(), after->size());
  BOOST_TEST(w.back.model.parts.size() == model.parts.size());
  const std::vector<Point> probes = {{0, 0, 0}, {40, 0, 0}, {0, 30, 0}, {0, 0, 10}};
  for (std::size_t i = 0; i < before->size(); ++i) {
    const Part& was = model.parts[(*before)[i].part];
    const Part& is = w.back.model.parts[(*after)[i].part];
    BOOST_TEST(is.name == was.name);
    BOOST_TEST(is.bodies.size() == was.bodies.size());
    BOOST_TEST(is.curves.size() == was.curves.size());
    for (const Point p : probes)
      BOOST_TEST(distance(apply((*before)[i].transform, p), apply((*after)[i].transform, p)) < 1e-11);
  }
  const auto a = measure(model, {}), b = measure(w.back.model, {});
  BOOST_REQUIRE((a && b));
  BOOST_TEST(a->area_mm2 == b->area_mm2, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(distance(a->box.lo, b->box.lo) < 1e-6);
  BOOST_TEST(distance(a->box.hi, b->box.hi) < 1e-6);
}

// --- Free curves and points ----------------------------------------------------------------------------------------

std::vector<Curve> every_curve() {
  const Frame tilted = make_frame({1, 2, 3}, {1, 2, 2}, {2, -2, 1});
  Circle part = arc(5, -0.7, 1.9);
  part.frame = tilted;
  Circle whole = arc(5, 0, two_pi);
  whole.frame = tilted;
  Ellipse ellipse = ellipse_arc(7, 3, 0.2, 4);
  ellipse.frame = tilted;
  Ellipse tall = ellipse_arc(2, 6, 0, two_pi);
  tall.frame = tilted;
  std::vector<CompositeCurve::Segment> chain;
  chain.push_back({curve(Line{{0, 0, 0}, {10, 0, 0}, {0, 1}}), false});
  chain.push_back({curve(Circle{make_frame({10, 5, 0}, {0, 0, 1}, {0, -1, 0}), 5, {0, pi / 2}}), false});  // to (15, 5, 0)
  chain.push_back({curve(Line{{15, 25, 1}, {15, 5, 0}, {0, 1}}), true});
  return {{Line{{1, 2, 3}, {4, 6, 15}, {0, 1}}},
          {Line{{1, 2, 3}, {4, 6, 15}, {0.25, 2}}},
          {part},
          {whole},
          {ellipse},
          {tall},
          {Parabola{tilted, 1.5, {-2, 3}}},
          {Hyperbola{tilted, 2, 1.5, {-1, 0.8}}},
          {Polyline{{{0, 0, 0}, {1, 5, 2}, {4, 4, 4}, {9, 1, 0}}}},
          {spline()},
          {OffsetCurve{curve(arc(9, 0.4, 2.5)), 1.25, {0, 0, 1}}},
          {make_composite(std::move(chain))}};
}

BOOST_AUTO_TEST_CASE(free_curves_of_every_type_survive) {
  Model model;
  model.parts.emplace_back();
  for (const Curve& c : every_curve()) model.parts[0].curves.push_back({c, {}, {}});
  for (const bool to_nurbs : {false, true}) {
    const Written w = there_and_back(model, to_nurbs);
    const auto& found = w.back.model.parts[0].curves;
    BOOST_REQUIRE_EQUAL(found.size(), model.parts[0].curves.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      BOOST_TEST_CONTEXT("curve " << i << (to_nurbs ? " as NURBS" : "")) {
        const Curve& was = model.parts[0].curves[i].curve;
        const Curve& is = found[i].curve;
        const double size = length(was, 1e-11);
        BOOST_TEST(std::abs(length(is, 1e-11) - size) <= 1e-9 * size, length(is, 1e-11) << " was " << size);
        BOOST_TEST(distance(start_point(was), start_point(is)) <= 1e-12 * size);
        BOOST_TEST(distance(end_point(was), end_point(is)) <= 1e-12 * size);
        for (int k = 1; k < 8; ++k) {
          const Point p = evaluate(was, range(was).lo + k / 8.0 * range(was).length());
          BOOST_TEST(closest_point(is, p).distance <= 1e-9 * size);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(rays_and_lines_without_ends_survive) {
  Model model;
  model.parts.emplace_back();
  model.parts[0].curves.push_back({Curve{Line{{1, 2, 3}, {4, 6, 15}, {0, infinity}}}, {}, {}});
  model.parts[0].curves.push_back({Curve{Line{{1, 2, 3}, {4, 6, 15}, {-infinity, infinity}}}, {}, {}});
  const Written w = there_and_back(model);
  const auto& found = w.back.model.parts[0].curves;
  BOOST_REQUIRE_EQUAL(found.size(), 2u);
  BOOST_TEST(range(found[0].curve).lo == 0.0);
  BOOST_TEST(std::isinf(range(found[0].curve).hi));
  BOOST_TEST(std::isinf(range(found[1].curve).lo));
}

BOOST_AUTO_TEST_CASE(free_points_survive) {
  Model model;
  model.parts.emplace_back();
  const std::vector<Point> points = {{1, 2, 3}, {0.1, -1.0 / 3, 1e-7}, {1e6, 0, -0.0}};
  for (const Point p : points) model.parts[0].points.push_back({p, {}, {}});
  const Written w = there_and_back(model);
  const auto& found = w.back.model.parts[0].points;
  BOOST_REQUIRE_EQUAL(found.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) BOOST_TEST(distance(found[i].point, points[i]) == 0.0);
}

// --- Units ---------------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(an_inch_file_keeps_its_digits) {
  test::IgesText text;
  text.global =
      "4Htest,8Htest.igs,8Htrimloop,8Htrimloop,32,38,6,308,15,4Htest,1.,1,2HIN,1,1.,15H20260101.000000,1.E-6,1000.,"
      "6Hauthor,3Horg,11,0,15H20260101.000000,";
  text.add(126, "3,3,1,0,1,0,0.,0.,0.,0.,1.,1.,1.,1.,1.,1.,1.,1.,"
                "0.1,0.2,0.3,1.7,-2.333333,4.9,12.0001,3.14159265358979,0.007,25.4,1.1,-99.99,0.,1.,0.,0.,1.");
  const io::ReadResult first = io::read_bytes(text.text(), "inch.igs");
  BOOST_REQUIRE(first.usable);
  BOOST_TEST((first.model.source_unit == LengthUnit::Inch));
  const Written w = there_and_back(first.model);
  Report report;
  const auto file = iges::File::parse(w.file.bytes, {}, report);
  BOOST_TEST(file.global().unit_flag == 1);
  const double wanted[4][3] = {{0.1, 0.2, 0.3}, {1.7, -2.333333, 4.9}, {12.0001, 3.14159265358979, 0.007}, {25.4, 1.1, -99.99}};
  std::size_t curves = 0;
  for (const iges::DirectoryEntry& entry : file.directory()) {
    const iges::AnyRecord any = iges::read_any(file, entry, {}, report);
    const auto* record = any.as<iges::RationalBSplineCurve>();
    if (!record) continue;
    ++curves;
    BOOST_REQUIRE_EQUAL(record->points.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
      BOOST_TEST(record->points[i].x == wanted[i][0]);
      BOOST_TEST(record->points[i].y == wanted[i][1]);
      BOOST_TEST(record->points[i].z == wanted[i][2]);
    }
  }
  BOOST_TEST(curves == 1u);
}

BOOST_AUTO_TEST_CASE(an_inch_model_keeps_its_faces) {
  Model model = model_of(test::cylinder({1, -2, 3}, 4, 25));
  model.source_unit = LengthUnit::Inch;
  model.source_scale = 25.4;
  check_survives(model);
}

BOOST_AUTO_TEST_SUITE_END()
