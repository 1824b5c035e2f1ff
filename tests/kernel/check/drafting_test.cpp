// Annotation compared: in any order, within the tolerance, letter by letter.
#include <boost/test/unit_test.hpp>
#include <algorithm>

#include "kernel/check/compare_drafting.h"

using namespace trimloop;

namespace {

TextRun run(const char* text, Point origin) {
  TextRun out;
  out.text = text;
  out.origin = origin;
  out.along = {10, 0, 0};
  out.up = {0, 2, 0};
  return out;
}

Model drawing() {
  Model model;
  model.parts.resize(2);
  model.parts[1].annotation.push_back({"note", {{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {0, 1, 0}}}, {run("a", {1, 2, 3}), run("b", {1, 2, 3})}, {}, {}});
  for (const double x : {0.0, 5.0}) model.parts[0].instances.push_back({1, Transform::translation({x, 0, 0}), {}, {}});
  return model;
}

DraftingComparison compared(const Model& a, const Model& b) {
  const auto out = compare_drafting(a, b, 1e-3, 1000, 64);
  BOOST_REQUIRE(out);
  return *out;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(drafting)

BOOST_AUTO_TEST_CASE(order_does_not_count) {
  Model other = drawing();
  std::reverse(other.parts[0].instances.begin(), other.parts[0].instances.end());
  Annotation& a = other.parts[1].annotation[0];
  std::reverse(a.strokes.begin(), a.strokes.end());
  std::reverse(a.texts.begin(), a.texts.end());
  a.strokes[0][1].y += 5e-4;  // within the tolerance
  const DraftingComparison c = compared(drawing(), other);
  BOOST_TEST(c.same());
  BOOST_TEST(c.strokes_same == 4u);
  BOOST_TEST(c.texts_same == 4u);
}

BOOST_AUTO_TEST_CASE(what_is_changed_stands_on_both_sides) {
  Model other = drawing();
  Annotation& a = other.parts[1].annotation[0];
  a.texts[1] = run("another", {1, 2, 3});
  a.strokes[0].push_back({2, 0, 0});
  other.parts[0].annotation.push_back({"note", {}, {run("new", {0, 0, 0})}, {}, {}});
  const DraftingComparison c = compared(drawing(), other);
  BOOST_TEST(!c.same());
  BOOST_TEST(c.texts_same == 2u);
  BOOST_TEST(c.texts_first == 2u);
  BOOST_TEST(c.texts_second == 3u);
  BOOST_TEST(c.strokes_same == 2u);
  BOOST_TEST(c.strokes_first == 2u);
  BOOST_TEST(c.strokes_second == 2u);
}

BOOST_AUTO_TEST_CASE(too_many_occurrences_are_a_limit) {
  const auto c = compare_drafting(drawing(), drawing(), 1e-3, 1, 64);
  BOOST_REQUIRE(!c);
  BOOST_TEST((c.error().code == ErrorCode::Limit));
}

BOOST_AUTO_TEST_SUITE_END()
