#include "kernel/check/part_mass.h"

#include <boost/test/unit_test.hpp>

#include "tests/support/builders.h"

using namespace trimloop;

BOOST_AUTO_TEST_SUITE(part_mass)

// A box 1 x 2 x 3 from the origin, placed as it is, twice as large, and mirrored in x: volumes 6, 48, 6, areas 22, 88, 22.
BOOST_AUTO_TEST_CASE(what_is_placed_counts_where_and_as_large_as_it_stands) {
  Model model;
  model.parts.resize(3);
  Body box = test::box({0, 0, 0}, {1, 2, 3});
  box.kind = BodyKind::Solid;
  model.parts[2].bodies = {box};
  model.parts[1].instances = {{2, Transform::scale(2), {}, {}}, {2, {}, {}, {}}};
  Transform mirror;
  mirror.r[0][0] = -1;
  mirror.t = {10, 0, 0};
  model.parts[0].instances = {{1, Transform::translation({0, 0, 100}), {}, {}}, {2, mirror, {}, {}}};
  PartMasses masses(model);
  const PartMass& all = masses.of(0);
  BOOST_TEST(all.volume_mm3 == 60, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(all.area_mm2 == 132, boost::test_tools::tolerance(1e-12));
  // Centres (1, 2, 103), (0.5, 1, 101.5), (9.5, 1, 1.5).
  const Vector centre = all.moment_mm4 / all.volume_mm3;
  BOOST_TEST(centre.x == (48 * 1 + 6 * 0.5 + 6 * 9.5) / 60, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(centre.y == (48 * 2 + 6 * 1 + 6 * 1) / 60., boost::test_tools::tolerance(1e-12));
  BOOST_TEST(centre.z == (48 * 103 + 6 * 101.5 + 6 * 1.5) / 60, boost::test_tools::tolerance(1e-12));
  BOOST_TEST((all.has_solid && all.complete));
  BOOST_TEST(all.box.lo.z <= 0);
  BOOST_TEST(all.box.hi.z >= 106);
}

BOOST_AUTO_TEST_CASE(sheets_have_no_volume_and_failed_faces_make_it_incomplete) {
  Body sheet = test::plate(10, 10, {});
  const PartMass m = mass_of(sheet);
  BOOST_TEST(m.area_mm2 == 100, boost::test_tools::tolerance(1e-12));
  BOOST_TEST((!m.has_solid && m.volume_mm3 == 0 && m.complete));
  sheet.faces[0].status = FaceStatus::Failed;
  BOOST_TEST(!mass_of(sheet).complete);
}

BOOST_AUTO_TEST_SUITE_END()
