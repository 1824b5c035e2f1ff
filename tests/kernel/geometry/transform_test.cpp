// Moved, turned round and cut shapes have the same points.

#include <boost/test/unit_test.hpp>

#include "shapes.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

Transform mirror() {
  Transform m;
  m.r[1][1] = -1;
  m.t = {1, 2, 3};
  return m;
}
std::vector<Transform> similarities() {
  const Transform turn = Transform::rotation({1, 2, 3}, {1, -1, 2}, 1.1);
  return {turn, Transform::scale(2.5), mirror(), mirror() * turn * Transform::scale(0.4), turn * mirror()};
}
Transform shear() {
  Transform m = Transform::rotation({0, 0, 1}, {1, 1, 0}, 0.4);
  m.r[0][1] += 0.7;
  m.r[2][2] *= 3;
  return m;
}
constexpr Interval patch_part{0.05, 0.95};

}  // namespace

BOOST_AUTO_TEST_SUITE(transforms)

BOOST_AUTO_TEST_CASE(similarities_keep_the_parameters_of_curves) {
  for (const Transform& m : similarities())
    for (const Curve& c : every_curve()) {
      const auto moved = transformed(c, m);
      BOOST_REQUIRE(moved.has_value());
      BOOST_TEST(moved->shape.index() == c.shape.index());
      BOOST_TEST(range(*moved).lo == range(c).lo);
      BOOST_TEST(range(*moved).hi == range(c).hi);
      for (const double f : {0.0, 0.3, 0.5, 0.9, 1.0})
        BOOST_TEST(distance(evaluate(*moved, range(c).at(f)), apply(m, evaluate(c, range(c).at(f)))) < 1e-12);
    }
}

BOOST_AUTO_TEST_CASE(other_affine_maps_shift_the_range) {
  for (const Curve& c : every_curve()) {
    const auto moved = transformed(c, shear());
    if (std::holds_alternative<OffsetCurve>(c.shape)) {
      BOOST_TEST((moved.error().code == ErrorCode::Unsupported));
      continue;
    }
    BOOST_REQUIRE(moved.has_value());
    BOOST_TEST(range(*moved).length() == range(c).length(), boost::test_tools::tolerance(1e-14));
    for (const double f : {0.0, 0.3, 0.5, 0.9, 1.0})
      BOOST_TEST(distance(evaluate(*moved, range(*moved).at(f)), apply(shear(), evaluate(c, range(c).at(f)))) < 1e-12);
  }
  const auto ellipse = transformed(Curve{Circle{{}, 2}}, shear());
  BOOST_REQUIRE(ellipse.has_value());
  BOOST_TEST(std::holds_alternative<Ellipse>(ellipse->shape));
}

BOOST_AUTO_TEST_CASE(a_singular_map_is_refused_for_conics_only) {
  Transform flat;
  flat.r[0][0] = 0;
  BOOST_TEST(!transformed(Curve{Circle{}}, flat).has_value());
  BOOST_TEST(!transformed(Curve{Hyperbola{{}, 1, 1}}, flat).has_value());
  BOOST_TEST(transformed(Curve{Line{{1, 1, 1}, {2, 3, 4}}}, flat).has_value());
  BOOST_TEST(transformed(Curve{wavy_curve()}, flat).has_value());
  Transform nothing;
  nothing.r[2][2] = not_measured;
  BOOST_TEST(!transformed(Curve{Line{}}, nothing).has_value());
  BOOST_TEST(!transformed(Surface{Plane{}}, nothing).has_value());
}

BOOST_AUTO_TEST_CASE(moved_surfaces_agree_through_the_parameter_map) {
  for (const Transform& m : similarities())
    for (const Patch& patch : every_patch()) {
      BOOST_TEST_CONTEXT(patch.name << " det " << determinant(m)) {
        const auto moved = transformed(patch.surface, m);
        BOOST_REQUIRE(moved.has_value());
        BOOST_TEST(moved->shape.index() == patch.surface.shape.index());
        const UvMap map = parameter_map(patch.surface, m);
        for (const double a : {patch_part.lo, 0.4, patch_part.hi})
          for (const double b : {patch_part.lo, 0.6, patch_part.hi}) {
            const Uv p{patch.u.at(a), patch.v.at(b)};
            BOOST_TEST(distance(evaluate(*moved, apply(map, p)), apply(m, evaluate(patch.surface, p))) < 1e-12);
          }
        const SurfaceDomain before = domain(patch.surface), after = domain(*moved);
        BOOST_TEST(after.u.lo == before.u.lo);  // the domain is mapped onto itself, but for lengths
        BOOST_TEST(after.u.hi == before.u.hi);
      }
    }
}

BOOST_AUTO_TEST_CASE(uneven_maps_of_surfaces_are_exact_or_refused) {
  for (const Patch& patch : every_patch()) {
    BOOST_TEST_CONTEXT(patch.name) {
      const auto moved = transformed(patch.surface, shear());
      const std::size_t type = patch.surface.shape.index();
      const auto* ruled = std::get_if<Ruled>(&patch.surface.shape);
      const bool exact = type == Surface{Plane{}}.shape.index() || type == Surface{Cylinder{}}.shape.index() ||
                         type == Surface{Extrusion{}}.shape.index() || (ruled && !ruled->equal_arc_length) ||
                         std::holds_alternative<NurbsSurface>(patch.surface.shape);
      BOOST_TEST(moved.has_value() == exact);
      if (!moved) continue;
      const UvMap map = parameter_map(patch.surface, shear());
      for (const double a : {patch_part.lo, 0.4, patch_part.hi})
        for (const double b : {patch_part.lo, 0.6, patch_part.hi}) {
          const Uv p{patch.u.at(a), patch.v.at(b)};
          BOOST_TEST(distance(evaluate(*moved, apply(map, p)), apply(shear(), evaluate(patch.surface, p))) < 1e-12);
        }
    }
  }
  const Surface tube{Extrusion{share(Ellipse{tilted_frame(), 2, 1, {0.3, 4}}), {0, 0, 1}}};
  const UvMap map = parameter_map(tube, shear());
  const Uv p{1.3, 0.4};
  BOOST_TEST(distance(evaluate(*transformed(tube, shear()), apply(map, p)), apply(shear(), evaluate(tube, p))) < 1e-13);
}

BOOST_AUTO_TEST_CASE(a_mirrored_offset_stays_on_its_side) {
  for (const Surface& basis :
       {Surface{Sphere{tilted_frame(), 2}}, Surface{wavy_surface(4)}, Surface{Plane{tilted_frame()}}}) {
    const Surface s{OffsetSurface{std::make_shared<const Surface>(basis), 0.3}};
    const auto moved = transformed(s, mirror());
    BOOST_REQUIRE(moved.has_value());
    const Uv p{0.7, 0.4};
    BOOST_TEST(distance(evaluate(*moved, apply(parameter_map(s, mirror()), p)), apply(mirror(), evaluate(s, p))) <
               1e-13);
  }
}

BOOST_AUTO_TEST_CASE(reversed_curves_run_the_other_way) {
  for (const Curve& c : every_curve()) {
    const Curve back = reversed(c);
    BOOST_TEST(range(back).length() == range(c).length(), boost::test_tools::tolerance(1e-14));
    for (const double f : {0.01, 0.3, 0.53, 0.9, 0.99}) {
      const double t = range(c).at(f), s = range(back).lo + (range(c).hi - t);
      BOOST_TEST(distance(evaluate(back, s), evaluate(c, t)) < 1e-12);
      BOOST_TEST(norm(jet(back, s).d1 + jet(c, t).d1) < 1e-11);
    }
  }
  const Curve line{Line{{0, 0, 0}, {1, 2, 3}, {0, infinity}}};
  BOOST_TEST(range(reversed(line)).lo == -infinity);
  BOOST_TEST(distance(evaluate(reversed(line), -2), evaluate(line, 2)) == 0);
}

BOOST_AUTO_TEST_CASE(parts_keep_the_parameter) {
  for (const Curve& c : every_curve()) {
    const Interval part{range(c).at(0.15), range(c).at(0.8)};
    const Curve cut = with_range(c, part);
    BOOST_TEST(range(cut).lo == part.lo, boost::test_tools::tolerance(1e-15));
    BOOST_TEST(range(cut).hi == part.hi, boost::test_tools::tolerance(1e-15));
    for (const double f : {0.0, 0.21, 0.5, 0.77, 1.0})
      BOOST_TEST(distance(evaluate(cut, part.at(f)), evaluate(c, part.at(f))) < 1e-13);
  }
  const Curve beyond = with_range(Curve{wavy_curve()}, {-5, 50});
  BOOST_TEST(range(beyond).lo == 0);
  BOOST_TEST(range(beyond).hi == 4);
}

BOOST_AUTO_TEST_SUITE_END()
