// A budget of triangles: kept to, with what it cost said; refused where no mesh is so small.
#include <boost/test/unit_test.hpp>

#include "io/io.h"
#include "tests/support/builders.h"

using namespace trimloop;

namespace {

Model torus() {
  Model model;
  model.parts.emplace_back();
  model.parts[0].bodies.push_back(test::torus({5, 6, 7}, 12.5, 3));
  return model;
}

Result<io::WriteResult> stl(std::optional<std::size_t> budget) {
  io::WriteOptions how;
  how.format = io::Format::Stl;
  how.deflection = "0.002mm";
  how.max_triangles = budget;
  return io::encode(torus(), {}, how);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(triangle_budget)

BOOST_AUTO_TEST_CASE(the_budget_holds_and_the_bound_says_what_it_costs) {
  const auto free = stl({});
  BOOST_REQUIRE(free);
  BOOST_TEST(free->coarsened == 1);
  BOOST_TEST(free->max_bound_mm <= 0.002);
  double before = free->max_bound_mm;
  for (const std::size_t budget : {free->triangles / 2, free->triangles / 10, free->triangles / 50}) {
    const auto kept = stl(budget);
    BOOST_REQUIRE(kept);
    BOOST_TEST(kept->triangles <= budget);
    BOOST_TEST(kept->triangles > budget / 2);
    BOOST_TEST(kept->deflection_mm == 0.002);
    BOOST_TEST(kept->coarsened > 1);
    BOOST_TEST(kept->max_bound_mm > before);
    BOOST_TEST(kept->open_edges == 0u);
    before = kept->max_bound_mm;
  }
}

BOOST_AUTO_TEST_CASE(a_budget_that_is_large_enough_changes_nothing) {
  const auto free = stl({}), kept = stl(free->triangles);
  BOOST_TEST((kept->bytes == free->bytes));
}

BOOST_AUTO_TEST_CASE(what_no_mesh_can_keep_to_is_refused) {
  const auto none = stl(3);
  BOOST_REQUIRE(!none);
  BOOST_TEST((none.error().code == ErrorCode::Limit));
  BOOST_TEST(none.error().limit == 3);
}

BOOST_AUTO_TEST_SUITE_END()
