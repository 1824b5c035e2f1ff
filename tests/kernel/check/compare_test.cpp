// Models compared by geometry: what is the same, changed, moved, renamed, missing.

#include <boost/test/unit_test.hpp>

#include "kernel/check/compare.h"
#include "kernel/topology/transform_body.h"
#include "tests/support/builders.h"

using namespace trimloop;

namespace {

Model model_of(std::vector<Body> bodies) {
  Model model;
  model.parts.emplace_back();
  model.parts[0].bodies = std::move(bodies);
  return model;
}

std::vector<Body> some_bodies() {
  return {test::box({0, 0, 0}, {10, 20, 30}), test::cylinder({50, 0, 0}, 4, 9), test::cone({80, 0, 0}, 4, 9),
          test::sphere({120, 0, 0}, 7), test::torus({160, 0, 0}, 9, 2), test::plate(40, 30, {{10, 10, 4}, {25, 20, 6}})};
}

Comparison compared(const Model& a, const Model& b) {
  auto c = compare(a, b, {});
  BOOST_REQUIRE(c);
  return *c;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(comparing)

BOOST_AUTO_TEST_CASE(a_model_is_the_same_as_itself) {
  const Model model = model_of(some_bodies());
  const Comparison c = compared(model, model);
  BOOST_TEST(c.count(Difference::Same) == 6u + 3 + 2 + 1 + 1 + 1);
  BOOST_TEST(c.faces.size() == c.count(Difference::Same));
  BOOST_TEST(c.max_deviation_mm < 1e-9);
  BOOST_TEST(!c.reordered);
}

BOOST_AUTO_TEST_CASE(order_and_placement_do_not_matter) {
  const Model flat = model_of(some_bodies());
  Model placed;
  placed.parts.resize(2);
  const Transform at = Transform::translation({5, 6, 7}) * Transform::rotation({0, 0, 0}, {1, 2, 3}, 0.8);
  Transform back = Transform::rotation({0, 0, 0}, {1, 2, 3}, -0.8) * Transform::translation({-5, -6, -7});
  for (const Body& body : some_bodies()) placed.parts[1].bodies.insert(placed.parts[1].bodies.begin(), *transformed(body, back));
  placed.parts[0].instances.push_back({1, at, {}, {}});
  const Comparison c = compared(flat, placed);
  BOOST_TEST(c.count(Difference::Same) == c.faces.size());
  BOOST_TEST(c.max_deviation_mm < 1e-9);
  BOOST_TEST(c.reordered);
}

BOOST_AUTO_TEST_CASE(what_moved_changed_or_is_missing_is_told) {
  const Model before = model_of(some_bodies());
  std::vector<Body> bodies = some_bodies();
  bodies[3] = test::sphere({120, 200, 0}, 7);        // moved by 200
  bodies[1] = test::cylinder({50, 0, 0}, 4.01, 9);   // 0.01 wider: the side and both discs change
  bodies.pop_back();                                  // the plate is gone
  bodies.push_back(test::sphere({300, 0, 0}, 2));    // a ball is new
  const Comparison c = compared(before, model_of(bodies));
  BOOST_TEST(c.count(Difference::Same) == 6u + 2 + 1);
  BOOST_TEST(c.count(Difference::Moved) == 1u);
  BOOST_TEST(c.count(Difference::Changed) == 3u);
  BOOST_TEST(c.count(Difference::OnlyFirst) == 1u);
  BOOST_TEST(c.count(Difference::OnlySecond) == 1u);
  for (const FacePair& p : c.faces) {
    if (p.difference == Difference::Moved) BOOST_TEST(p.deviation_mm == 200, boost::test_tools::tolerance(1e-6));
    if (p.difference == Difference::Changed) BOOST_TEST(p.deviation_mm == 0.01, boost::test_tools::tolerance(1e-6));
  }
}

BOOST_AUTO_TEST_CASE(a_hole_that_moved_changes_its_face) {
  const Model before = model_of({test::plate(40, 30, {{10, 10, 4}})}), after = model_of({test::plate(40, 30, {{10.5, 10, 4}})});
  const Comparison c = compared(before, after);
  BOOST_TEST(c.count(Difference::Changed) == 1u);
  BOOST_TEST(std::abs(c.max_deviation_mm - 0.5) < 0.02);  // of 24 samples of the border
}

BOOST_AUTO_TEST_CASE(names_and_colours_are_compared_apart) {
  Model before = model_of({test::box({0, 0, 0}, {1, 2, 3})}), after = before;
  after.parts[0].bodies[0].faces[1].attributes = after.add({"lid", {}, 0, true});
  after.parts[0].bodies[0].faces[2].attributes = after.add({"", Colour{1, 0, 0}, 0, true});
  const Comparison c = compared(before, after);
  BOOST_TEST(c.count(Difference::Same) == 6u);
  BOOST_TEST(std::count_if(c.faces.begin(), c.faces.end(), [](const FacePair& p) { return p.renamed; }) == 1);
  BOOST_TEST(std::count_if(c.faces.begin(), c.faces.end(), [](const FacePair& p) { return p.recoloured; }) == 1);
}

BOOST_AUTO_TEST_CASE(free_curves_and_points_are_matched) {
  Model before = model_of({}), after = before;
  Circle circle;
  before.parts[0].curves = {{Curve{circle}, {}, {}}, {Curve{Line{{0, 0, 0}, {3, 4, 0}}}, {}, {}}};
  after.parts[0].curves = {{Curve{Line{{3, 4, 0}, {0, 0, 0}}}, {}, {}}, {Curve{to_nurbs(Curve{circle})->curve}, {}, {}}};
  before.parts[0].points = {{{1, 2, 3}, {}, {}}};
  after.parts[0].points = {{{1, 2, 3.5}, {}, {}}};
  const Comparison c = compared(before, after);
  BOOST_TEST(c.curves_same == 2u);
  BOOST_TEST(c.curves_first + c.curves_second == 0u);
  BOOST_TEST(c.points_first == 1u);
  BOOST_TEST(c.points_second == 1u);
}

BOOST_AUTO_TEST_SUITE_END()
