// Primitives at random places: the identities of volumes, and every structural promise.
#include <boost/test/unit_test.hpp>
#include <array>
#include <cstdlib>

#include "kernel/boolean/boolean.h"
#include "kernel/check/measure.h"
#include "tests/kernel/boolean/primitives.h"

using namespace trimloop;

namespace {

double volume_of(const std::vector<Body>& bodies) {
  double sum = 0;
  for (const Body& b : bodies)
    for (std::uint32_t s = 0; s < b.shells.size(); ++s) sum += volume(b, ShellId{s}, 1e-10)->value;
  return sum;
}

}  // namespace

BOOST_AUTO_TEST_CASE(volumes_of_random_pairs_add_up) {
  const char* stated = std::getenv("TRIMLOOP_BOOLEAN_PAIRS");  // a longer run
  const unsigned pairs = stated ? static_cast<unsigned>(std::atoi(stated)) : 80;
  double worst = 0;
  for (unsigned seed = 0; seed < pairs; ++seed) {
    std::mt19937 bits(seed);
    const Body a = *test::body_of(test::random_primitive(bits)), b = *test::body_of(test::random_primitive(bits));
    BOOST_TEST_CONTEXT("pair " << seed) {
      std::array<double, 4> v{};
      const std::pair<const Body*, const Body*> order[]{{&a, &b}, {&a, &b}, {&a, &b}, {&b, &a}};
      const BooleanOperation operations[]{BooleanOperation::Union, BooleanOperation::Intersection,
                                          BooleanOperation::Difference, BooleanOperation::Difference};
      for (std::size_t i = 0; i < 4; ++i) {
        const auto r = combine(*order[i].first, *order[i].second, operations[i]);
        BOOST_REQUIRE_MESSAGE(r, r.error().text);
        for (const Body& body : r->bodies)
          for (const std::string& broken : broken_promises(body, 1e-6)) BOOST_ERROR(broken);
        v[i] = volume_of(r->bodies);
      }
      const double va = volume_of({a}), vb = volume_of({b});
      const double off = std::max({std::abs(v[0] + v[1] - va - vb), std::abs(v[2] + v[1] - va), std::abs(v[3] + v[1] - vb)});
      BOOST_TEST(off <= 1e-9 * (va + vb));
      worst = std::max(worst, off / (va + vb));
    }
  }
  BOOST_TEST_MESSAGE(pairs << " pairs, the identities hold to " << worst << " of the volumes");
}
