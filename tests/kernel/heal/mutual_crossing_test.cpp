// Loops of one face that cross each other: what is inside, where that is said, what stays as it is.

#include "kernel/heal/crossings.h"
#include "tests/kernel/heal/helpers.h"

namespace trimloop::heal::test {

BOOST_AUTO_TEST_SUITE(mutual_crossings)

namespace {

TrimLoop rectangle(double u0, double v0, double u1, double v1) { return polygon({{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}}); }
TrimLoop circle(Uv centre, double radius) { return loop_of(drawn(circle2(centre, radius))); }

// Segment of the unit circle beyond a chord at distance d.
double segment(double d) { return std::acos(d) - d * std::sqrt(1 - d * d); }

}  // namespace

BOOST_AUTO_TEST_CASE(a_hole_over_the_border_takes_away_what_it_covers) {
  // A circle of radius 1 whose centre is 0.25 inside the side x = 10 of a square.
  for (const bool turned : {false, true}) {
    FaceInput in = input(Plane{}, {rectangle(0, 0, 10, 10), circle({9.75, 5}, 1)});
    in.loops[0].claimed_outer = true;
    if (turned) turn(in.loops[1]);
    const Made m = make(in);
    check_area(m, 100 - (pi - segment(0.25)), 1e-9);
    BOOST_TEST((m.face().status == FaceStatus::Healed));
    BOOST_TEST(m.face().loops.size() == 1u);
    const StepRecord& s = m.first(Step::LoopsParted);
    BOOST_TEST(std::abs(s.at.x - 10) < 1e-9);
    BOOST_TEST(std::abs(s.before_mm - std::hypot(0.75, 2 * std::sqrt(1 - 0.0625))) < 0.02);  // by samples
  }
}

BOOST_AUTO_TEST_CASE(a_hole_mostly_outside_is_a_hole_where_the_file_says_so) {
  FaceInput in = input(Plane{}, {rectangle(0, 0, 10, 10), circle({10.5, 5}, 1)});
  in.loops[0].claimed_outer = true;
  check_area(make(in), 100 - segment(0.5), 1e-9);
  in.loops[0].claimed_outer = false;  // nothing is known: two outer loops
  check_area(make(in), 100 + pi - segment(0.5), 1e-9);
  in.brep_sense = true;  // both counter-clockwise
  check_area(make(in), 100 + pi - segment(0.5), 1e-9);
  turn(in.loops[1]);
  check_area(make(in), 100 - segment(0.5), 1e-9);
}

BOOST_AUTO_TEST_CASE(holes_that_overlap_take_away_both) {
  FaceInput in = input(Plane{}, {rectangle(0, 0, 10, 10), circle({4.5, 5}, 1), circle({5.5, 5}, 1), circle({2, 2}, 1)});
  const Made m = make(in);
  check_area(m, 100 - (2 * pi - 2 * segment(0.5)) - pi, 1e-9);
  BOOST_TEST(m.face().loops.size() == 3u);
  // In any order.
  std::swap(in.loops[0], in.loops[3]);
  std::swap(in.loops[1], in.loops[2]);
  check_area(make(in), 100 - (2 * pi - 2 * segment(0.5)) - pi, 1e-9);
}

BOOST_AUTO_TEST_CASE(a_hole_through_the_whole_face_leaves_two_parts) {
  FaceInput in = input(Plane{}, {rectangle(0, 0, 10, 10), rectangle(4, -1, 5, 11), circle({2, 5}, 1), circle({4.5, 5}, 0.25)});
  in.loops[0].claimed_outer = true;
  const Made m = make(in);
  check_area(m, 90 - pi + pi / 16, 1e-9);  // the small circle is an island in what is taken away
  BOOST_TEST(m.face().loops.size() == 4u);
}

BOOST_AUTO_TEST_CASE(touching_by_less_than_the_tolerance_stays_as_it_is) {
  FaceInput in = input(Plane{}, {rectangle(0, 0, 10, 10), circle({9 + 1e-6, 5}, 1)});
  in.loops[0].claimed_outer = true;
  const Made m = make(in);
  check_ok(m);
  check_area(m, 100 - pi, 1e-6);
  BOOST_TEST(m.count(Step::LoopsParted) == 0);
  BOOST_TEST(m.face().loops.size() == 2u);
}

BOOST_AUTO_TEST_CASE(a_hole_over_the_border_of_a_cylinder_and_its_seam) {
  // Band of radius 2 and height 3; a hole of 1 x 1 rad-mm in parameters, half over the upper border, at the seam.
  const auto border = [](double z) { return loop_of(in_space(curve(horizontal_circle({0, 0, z}, 2)))); };
  for (const double at : {0.0, 1.0}) {
    FaceInput in = input(Cylinder{{}, 2}, {border(0), border(3), rectangle(at - 0.5, 2.5, at + 0.5, 3.5)});
    const Made m = make(in);
    if (m.face().status == FaceStatus::Failed) {
      BOOST_TEST(at == 0.0);  // at the seam it is refused, with the reason
      BOOST_TEST(!m.face().reason.empty());
      continue;
    }
    check_area(m, 2 * (two_pi * 3 - 0.5), 1e-7);
  }
}

BOOST_AUTO_TEST_CASE(too_many_crossings_fail_and_forbidden_ones_too) {
  std::vector<Uv> comb;
  for (int i = 0; i <= 200; ++i) comb.push_back({i * 0.05, i % 2 ? 9.0 : 11.0});
  comb.push_back({10, 12});
  comb.push_back({0, 12});
  const Made m = make(input(Plane{}, {rectangle(-1, 0, 11, 10), polygon(comb)}));
  BOOST_TEST(m.count(Step::LoopsParted) > 0);
  std::vector<Uv> finer;
  for (int i = 0; i <= 400; ++i) finer.push_back({i * 0.025, i % 2 ? 9.0 : 11.0});
  finer.push_back({10, 12});
  finer.push_back({0, 12});
  const Made many = make(input(Plane{}, {rectangle(-1, 0, 11, 10), polygon(finer)}));
  BOOST_TEST((many.face().status == FaceStatus::Failed));
  BOOST_TEST(many.face().reason.find("256") != std::string::npos);
  FaceInput in = input(Plane{}, {rectangle(0, 0, 10, 10), circle({9.75, 5}, 1)});
  in.forbidden = StepSet{}.with(Step::LoopsParted);
  BOOST_TEST((make(in).face().status == FaceStatus::Failed));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace trimloop::heal::test
