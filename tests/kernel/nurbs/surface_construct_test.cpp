// Surfaces from curves against their definitions (The NURBS Book, chapters 8 and 10).
#include <boost/test/unit_test.hpp>

#include "kernel/math/transform.h"
#include "kernel/nurbs/construct_blend.h"
#include "kernel/nurbs/construct_conic.h"
#include "kernel/nurbs/construct_surface.h"
#include "tests/kernel/nurbs/random_nurbs.h"

using namespace trimloop;
using testing::Random;

namespace {

constexpr double tiny = 1e-12;

NurbsCurve over(const NurbsCurve& c, Interval range) { return reparametrized(c, range); }

template <class F>
void on_grid(F check) {
  for (int i = 0; i <= 8; ++i)
    for (int k = 0; k <= 8; ++k) check(i / 8.0, k / 8.0);
}

}  // namespace

BOOST_AUTO_TEST_CASE(bilinear_ruled_and_extruded_surfaces_follow_their_formulas) {
  const NurbsSurface b = bilinear({0, 0, 0}, {2, 0, 1}, {0, 3, 1}, {2, 3, 5}).value();
  on_grid([&](double u, double v) {
    BOOST_TEST(distance(evaluate(b, {u, v}), {2 * u, 3 * v, (1 - u) * v + u * (1 - v) + 5 * u * v}) < tiny);
  });
  Random random(101);
  for (int i = 0; i < 40; ++i) {
    const NurbsCurve c = random.curve(random.integer(1, 5), i % 2), d = random.curve(random.integer(1, 5), i % 3 == 0);
    const Interval r = c.range();
    const NurbsSurface e = extruded(c, {1, 2, 3}).value();
    on_grid([&](double u, double v) {
      BOOST_TEST(distance(evaluate(e, {r.at(u), v}), evaluate(c, r.at(u)) + v * Vector{1, 2, 3}) < tiny * 100);
    });
    const NurbsSurface s = ruled(c, d).value();
    const NurbsCurve second = over(d, r);
    on_grid([&](double u, double v) {
      const Point a = evaluate(c, r.at(u)), z = evaluate(second, r.at(u)), p = evaluate(s, {r.at(u), v});
      BOOST_TEST(norm(cross(p - a, z - a)) <= 1e-10 * (1 + dot(z - a, z - a)));  // on the ruling
      if (v == 0) BOOST_TEST(distance(p, a) < 1e-11);
      if (v == 1) BOOST_TEST(distance(p, z) < 1e-11);
    });
  }
}

BOOST_AUTO_TEST_CASE(cones_have_a_degenerate_side_or_an_ideal_one) {
  const NurbsCurve base = circle_arc({}, 2, {0, two_pi}).value();
  const NurbsSurface c = cone(base, {0, 0, 6, 1}).value();
  on_grid([&](double u, double v) {
    const Point p = evaluate(c, {base.range().at(u), v});
    BOOST_TEST(std::abs(std::hypot(p.x, p.y) - 2 * (1 - p.z / 6)) < tiny);
    if (v == 1) BOOST_TEST(distance(p, {0, 0, 6}) < tiny);
  });
  // The apex at infinity: a cylinder along z.
  const NurbsSurface cylinder = cone(base, {0, 0, 1, 0}).value();
  on_grid([&](double u, double v) {
    if (v == 1) return;
    const Point p = evaluate(cylinder, {base.range().at(u), v});
    BOOST_TEST(std::abs(std::hypot(p.x, p.y) - 2) < tiny);
    BOOST_TEST(std::abs(p.z - v / (1 - v)) < tiny * 10);
  });
}

BOOST_AUTO_TEST_CASE(translational_and_swung_surfaces_follow_their_formulas) {
  Random random(102);
  for (int i = 0; i < 30; ++i) {
    const NurbsCurve a = random.curve(random.integer(1, 4), i % 2), b = random.curve(random.integer(1, 4), i % 3 == 0);
    const NurbsSurface t = translational(a, b).value(), s = swung(a, b, 0.5).value();
    const Point start = evaluate(b, b.range().lo);
    on_grid([&](double u, double v) {
      const Uv at{a.range().at(u), b.range().at(v)};
      const Point p = evaluate(a, at.u), q = evaluate(b, at.v);
      BOOST_TEST(distance(evaluate(t, at), p + (q - start)) < 1e-11);
      BOOST_TEST(distance(evaluate(s, at), {0.5 * p.x * q.x, 0.5 * p.x * q.y, p.z}) < 1e-10);
    });
  }
}

BOOST_AUTO_TEST_CASE(revolved_curves_keep_distance_and_height) {
  Random random(103);
  const Point origin{1, 2, 3};
  const Vector axis = normalized({1, -2, 2});
  for (int i = 0; i < 40; ++i) {
    const NurbsCurve c = random.curve(random.integer(1, 4), i % 2);
    const Interval angle{0.5, i % 5 == 0 ? 0.5 + two_pi : random.real(0.6, 6)};
    const NurbsSurface s = revolved(c, origin, axis, angle).value();
    on_grid([&](double u, double v) {
      const double t = c.range().at(v);
      const Point p = evaluate(s, {s.domain_u().at(u), t}), g = evaluate(c, t);
      const auto height = [&](Point x) { return dot(x - origin, axis); };
      const auto reach = [&](Point x) { return norm(cross(x - origin, axis)); };
      BOOST_TEST(std::abs(height(p) - height(g)) < 1e-11);
      BOOST_TEST(std::abs(reach(p) - reach(g)) < 1e-11);
    });
    // Starts at the angle asked for.
    const Point g = evaluate(c, c.range().mid()), p = evaluate(s, {s.domain_u().lo, c.range().mid()});
    const Vector arm = g - origin, radial = arm - dot(arm, axis) * axis;
    BOOST_TEST(distance(p, g + (std::cos(0.5) - 1) * radial + std::sin(0.5) * cross(axis, radial)) < 1e-11);
  }
  BOOST_TEST(!revolved(random.curve(2, false), origin, {}, {0, 1}).has_value());
}

BOOST_AUTO_TEST_CASE(compatible_curves_keep_their_shapes) {
  Random random(104);
  for (int i = 0; i < 20; ++i) {
    const std::vector<NurbsCurve> given{random.curve(2, i % 2), random.curve(4, false), random.curve(3, true, false)};
    const std::vector<NurbsCurve> out = made_compatible(given);
    for (std::size_t k = 0; k < 3; ++k) {
      BOOST_TEST(out[k].degree() == 4);
      BOOST_TEST(out[k].knots() == out[0].knots(), boost::test_tools::per_element());
      for (int j = 0; j <= 20; ++j)
        BOOST_TEST(distance(evaluate(out[k], out[k].range().at(j / 20.0)),
                            evaluate(given[k], given[k].range().at(j / 20.0))) < 1e-10);
    }
  }
}

BOOST_AUTO_TEST_CASE(skins_contain_their_sections) {
  Random random(105);
  std::vector<NurbsCurve> sections;
  for (int k = 0; k < 6; ++k)
    sections.push_back(
        transformed(random.curve(random.integer(1, 4), false), Transform::translation({0, 0, 20.0 * k})));
  const Skin s = skinned(sections, 3).value();
  BOOST_TEST(s.error < 1e-10);
  for (std::size_t k = 0; k < 6; ++k)
    for (int j = 0; j <= 20; ++j) {
      const Interval r = sections[k].range(), u = s.surface.domain_u();
      BOOST_TEST(distance(evaluate(s.surface, {u.at(j / 20.0), s.v[k]}), evaluate(sections[k], r.at(j / 20.0))) <=
                 s.error + 1e-11);
    }
  // Circles of growing radius: each isocurve is the circle itself.
  std::vector<NurbsCurve> circles;
  for (int k = 0; k < 5; ++k) circles.push_back(circle_arc({{0, 0, 1.0 * k}}, 1 + 0.3 * k * k, {0, two_pi}).value());
  const Skin cup = skinned(circles, 3).value();
  for (std::size_t k = 0; k < 5; ++k)
    for (int j = 0; j <= 20; ++j) {
      const Point p = evaluate(cup.surface, {cup.surface.domain_u().at(j / 20.0), cup.v[k]});
      BOOST_TEST(std::abs(std::hypot(p.x, p.y) - (1 + 0.3 * static_cast<double>(k * k))) < 1e-12);
    }
  BOOST_TEST(!skinned(std::vector<NurbsCurve>{sections[0]}, 1).has_value());
  BOOST_TEST(!skinned(std::vector<NurbsCurve>{sections[0], sections[0]}, 1).has_value());
}

BOOST_AUTO_TEST_CASE(a_gordon_surface_contains_both_families) {
  // Curves of a bicubic surface at given parameters: the families meet exactly.
  Random random(106);
  const std::vector<double> bezier{0, 0, 0, 0, 1, 1, 1, 1};
  const NurbsSurface base = NurbsSurface::from_homogeneous(3, 3, bezier, bezier, random.poles(16, false)).value();
  const std::vector<double> u{0, 0.3, 0.6, 1}, v{0, 0.5, 0.8, 1};
  std::vector<NurbsCurve> along_u, along_v;
  for (const double t : v) along_u.push_back(isocurve_v(base, t));
  for (const double t : u) along_v.push_back(isocurve_u(base, t));
  const Gordon g = gordon(along_u, v, along_v, u, 1e-9).value();
  BOOST_TEST(g.largest_miss < 1e-13);
  on_grid([&](double a, double b) {
    BOOST_TEST(distance(evaluate(g.surface, {a, b}), evaluate(base, {a, b})) < 1e-11);
  });
  // And of a surface that is no bicubic: both families still lie on it.
  const NurbsSurface wavy = NurbsSurface::from_homogeneous(3, 3, {0, 0, 0, 0, 0.4, 0.7, 1, 1, 1, 1},
                                                           {0, 0, 0, 0, 0.5, 1, 1, 1, 1}, random.poles(30, false))
                                .value();
  along_u.clear(), along_v.clear();
  for (const double t : v) along_u.push_back(isocurve_v(wavy, t));
  for (const double t : u) along_v.push_back(isocurve_u(wavy, t));
  const Gordon w = gordon(along_u, v, along_v, u, 1e-9).value();
  for (int i = 0; i <= 20; ++i) {
    for (const double t : v)
      BOOST_TEST(distance(evaluate(w.surface, {i / 20.0, t}), evaluate(wavy, {i / 20.0, t})) < 1e-11);
    for (const double t : u)
      BOOST_TEST(distance(evaluate(w.surface, {t, i / 20.0}), evaluate(wavy, {t, i / 20.0})) < 1e-11);
  }
  BOOST_TEST(!gordon(along_u, v, along_v, std::vector<double>{0, 0.2, 0.6, 1}, 1e-9).has_value());
}

BOOST_AUTO_TEST_CASE(a_coons_patch_contains_its_sides) {
  Random random(107);
  for (int i = 0; i < 20; ++i) {
    // Four random curves with ends pulled onto common corners; the first rational.
    const Point corner[4] = {{0, 0, 0}, {10, 0, 1}, {0, 10, 2}, {10, 10, -3}};
    const auto side = [&](Point a, Point b, bool rational) {
      std::vector<Hpoint> poles = random.poles(6, rational);
      poles.front() = poles.front().w * Hpoint{a.x, a.y, a.z, 1};
      poles.back() = poles.back().w * Hpoint{b.x, b.y, b.z, 1};
      return NurbsCurve::from_homogeneous(3, {0, 0, 0, 0, random.real(0.1, 0.5), random.real(0.5, 0.9), 1, 1, 1, 1},
                                          poles)
          .value();
    };
    const bool rational = i % 2;
    const NurbsCurve bottom = side(corner[0], corner[1], rational), top = side(corner[2], corner[3], false);
    const NurbsCurve left = side(corner[0], corner[2], false), right = side(corner[1], corner[3], false);
    const Coons c = coons(bottom, top, left, right, 1e-9).value();
    BOOST_TEST(c.largest_miss < 1e-12);
    for (int k = 0; k <= 20; ++k) {
      const double t = k / 20.0;
      if (!rational) BOOST_TEST(distance(evaluate(c.surface, {t, 0}), evaluate(bottom, t)) < 1e-11);
      BOOST_TEST(distance(evaluate(c.surface, {t, 1}), evaluate(top, t)) < 1e-11);
      BOOST_TEST(distance(evaluate(c.surface, {0, t}), evaluate(left, t)) < 1e-11);
      BOOST_TEST(distance(evaluate(c.surface, {1, t}), evaluate(right, t)) < 1e-11);
    }
    if (rational) {  // the same points at other parameters
      double worst = 0;
      for (int k = 0; k <= 20; ++k) {
        double least = infinity;
        for (int j = 0; j <= 4000; ++j)
          least = std::min(least, distance(evaluate(c.surface, {k / 20.0, 0}), evaluate(bottom, j / 4000.0)));
        worst = std::max(worst, least);
      }
      BOOST_TEST(worst < 0.05);
    }
    if (!rational)  // the Boolean sum itself
      on_grid([&](double u, double v) {
        const Vector in_v = (1 - v) * to_vector(evaluate(bottom, u)) + v * to_vector(evaluate(top, u));
        const Vector in_u = (1 - u) * to_vector(evaluate(left, v)) + u * to_vector(evaluate(right, v));
        const Vector flat = (1 - v) * ((1 - u) * to_vector(corner[0]) + u * to_vector(corner[1])) +
                            v * ((1 - u) * to_vector(corner[2]) + u * to_vector(corner[3]));
        BOOST_TEST(distance(evaluate(c.surface, {u, v}), to_point(in_v + in_u - flat)) < 1e-10);
      });
  }
}

BOOST_AUTO_TEST_CASE(sweeps_are_exact_on_lines_and_arcs_and_near_elsewhere) {
  Random random(108);
  const NurbsCurve section = circle_arc(make_frame({5, 0, 0}, {0, 1, 0}), 1, {0, two_pi}).value();
  const NurbsCurve arc = circle_arc({}, 5, {0, 2}).value();
  const Sweep torus = swept(section, arc, Frames::Following).value();
  BOOST_TEST(torus.exact);
  const Interval u = torus.surface.domain_u(), v = torus.surface.domain_v();
  on_grid([&](double a, double b) {
    const Point p = evaluate(torus.surface, {u.at(a), v.at(b)});
    BOOST_TEST(std::abs(std::hypot(std::hypot(p.x, p.y) - 5, p.z) - 1) < 1e-13);
  });
  // A pipe about a space cubic: points stay at the radius from the path within the deviation.
  const std::vector<Point> path_poles{{0, 0, 0}, {10, 0, 0}, {10, 10, 5}, {0, 20, 10}};
  const NurbsCurve path = NurbsCurve::from_cartesian(3, {0, 0, 0, 0, 1, 1, 1, 1}, path_poles, {}).value();
  const NurbsCurve ring = circle_arc(make_frame({0, 0, 0}, {1, 0, 0}), 1, {0, two_pi}).value();
  const Sweep pipe = swept(ring, path, Frames::Following, 1e-6).value();
  BOOST_TEST(!pipe.exact);
  BOOST_TEST(pipe.deviation <= 1e-6);
  on_grid([&](double a, double b) {
    const double t = 0.01 + 0.97 * b;
    const Point p = evaluate(pipe.surface, {pipe.surface.domain_u().at(a), t});
    const CurveJet j = jet(path, t);
    BOOST_TEST(std::abs(distance(p, j.point) - 1) < 2e-6);
    BOOST_TEST(std::abs(dot(p - j.point, normalized(j.d1))) < 2e-6);
  });
  const Sweep kept = swept(ring, path, Frames::Parallel).value();
  BOOST_TEST(kept.exact);
  BOOST_TEST(distance(evaluate(kept.surface, {ring.range().mid(), 1}),
                      evaluate(ring, ring.range().mid()) + (path_poles[3] - path_poles[0])) < 1e-12);
}
