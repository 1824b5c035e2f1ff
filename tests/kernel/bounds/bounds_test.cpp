// Bounds against dense samples and local maximisation: none is ever exceeded; tight boxes are tight.
//
// The long run, 100 000 boxes of surfaces and curves:
//   build/dev/tests/test_kernel_bounds --run_test=boxes_long_run --log_level=message
#include "kernel/bounds/bounds.h"

#include <boost/test/unit_test.hpp>

#include "kernel/batch/batch.h"
#include "tests/kernel/closest/surfaces.h"

using namespace trimloop;
using testing::Random;

namespace {

double component(Vector v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

// The largest sign * coordinate near the best samples: climbs by Newton's method on the jets, with a plain search by
// halved steps where that does not help. Shares nothing with the bounds.
double climb(const NurbsSurface& s, Uv from, int axis, double sign, Interval u, Interval v) {
  const auto value = [&](Uv at) { return sign * component(evaluate(s, at) - Point{}, axis); };
  double best = value(from), step_u = 0.1 * u.length(), step_v = 0.1 * v.length();
  for (int i = 0; i < 120 && (step_u > 1e-8 * u.length() || step_v > 1e-8 * v.length()); ++i) {
    bool better = false;
    const auto attempt = [&](Uv at) {
      at = {u.clamp(at.u), v.clamp(at.v)};
      if (const double x = value(at); x > best) best = x, from = at, better = true;
    };
    const SurfaceJet j = jet(s, from);
    const double gu = component(j.du, axis), gv = component(j.dv, axis), uu = component(j.duu, axis),
                 uv = component(j.duv, axis), vv = component(j.dvv, axis), det = uu * vv - uv * uv;
    const Uv base = from;
    if (det != 0) attempt(base + Uv{(uv * gv - vv * gu) / det, (uv * gu - uu * gv) / det});
    if (!better && uu != 0) attempt(base + Uv{-gu / uu, 0});
    if (!better && vv != 0) attempt(base + Uv{0, -gv / vv});
    for (int a = -1; a <= 1 && !better; ++a)
      for (int b = -1; b <= 1; ++b) attempt(base + Uv{a * step_u, b * step_v});
    if (!better) step_u *= 0.3, step_v *= 0.3;
  }
  return best;
}

// The largest sign * coordinate: peaks among (n + 1)^2 samples of each patch, the best of them climbed from.
double highest(const NurbsSurface& s, const SurfacePieces& pieces, int axis, double sign, int n, std::size_t climbs) {
  struct Start {
    double value;
    Uv uv;
    Interval u, v;
  };
  std::vector<Start> starts;
  const std::size_t row = static_cast<std::size_t>(n) + 1;
  std::vector<double> value(row * row);
  for (std::size_t a = 0; a < pieces.spans_u().size(); ++a)
    for (std::size_t b = 0; b < pieces.spans_v().size(); ++b) {
      const Interval u = pieces.spans_u()[a], v = pieces.spans_v()[b];
      const auto uv = [&](std::size_t i, std::size_t k) { return Uv{u.at(double(i) / n), v.at(double(k) / n)}; };
      for (std::size_t i = 0; i < row; ++i)
        for (std::size_t k = 0; k < row; ++k)
          value[i * row + k] = sign * component(evaluate(pieces, uv(i, k)) - Point{}, axis);
      for (std::size_t i = 0; i < row; ++i)
        for (std::size_t k = 0; k < row; ++k) {
          const double here = value[i * row + k];
          bool peak = true;
          for (std::size_t x = i > 0 ? i - 1 : 0; x <= std::min(i + 1, row - 1) && peak; ++x)
            for (std::size_t y = k > 0 ? k - 1 : 0; y <= std::min(k + 1, row - 1); ++y)
              peak = peak && value[x * row + y] <= here;
          if (peak) starts.push_back({here, uv(i, k), u, v});
        }
    }
  std::stable_sort(starts.begin(), starts.end(), [](const Start& x, const Start& y) { return x.value > y.value; });
  double top = -infinity;
  for (std::size_t k = 0; k < std::min(climbs, starts.size()); ++k)
    top = std::max(top, climb(s, starts[k].uv, axis, sign, starts[k].u, starts[k].v));
  return top;
}

struct Boxes {
  int asked = 0, outside = 0, loose = 0, hull_outside = 0;
  double worst = 0;
};

void ask(const NurbsSurface& s, Boxes& t) {
  const SurfacePieces pieces(s);
  const TightBox tight = tight_box(pieces);
  const Box hull = hull_box(pieces);
  ++t.asked;
  const double size = hull.diagonal() + norm(to_vector(hull.lo));
  for (int axis = 0; axis < 3; ++axis)
    for (double sign : {-1.0, 1.0}) {
      const auto side = [&](const Box& b) { return sign * component((sign > 0 ? b.hi : b.lo) - Point{}, axis); };
      double top = highest(s, pieces, axis, sign, 6, 8);
      // Some peaks are narrower than the samples are apart.
      if (side(tight.box) - top > 1e-9 * size) top = std::max(top, highest(s, pieces, axis, sign, 80, 60));
      t.outside += top > side(tight.box);
      t.hull_outside += top > side(hull);
      t.loose += side(tight.box) - top > 1e-9 * size;
      t.worst = std::max(t.worst, (side(tight.box) - top) / size);
    }
  t.loose += !(tight.slack <= 1e-9 * size);
}
void check(const Boxes& t) {
  BOOST_TEST_MESSAGE(t.asked << " boxes: " << t.outside << " sides exceeded, " << t.hull_outside
                             << " of hulls, farthest side beyond the extreme found " << t.worst << " of the size");
  BOOST_CHECK_EQUAL(t.outside, 0);
  BOOST_CHECK_EQUAL(t.hull_outside, 0);
  BOOST_CHECK_EQUAL(t.loose, 0);
}

double angle(Vector a, Vector b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }

}  // namespace

BOOST_AUTO_TEST_CASE(boxes_enclose_and_are_tight) {
  Random random(51);
  Boxes t;
  for (int round = 0; round < 200; ++round) ask(testing::any_surface(random, round), t);
  check(t);
}

BOOST_AUTO_TEST_CASE(boxes_long_run, *boost::unit_test::disabled()) {
  Random random(52);
  Boxes t;
  for (int round = 0; round < 100000; ++round) {
    const int kind =
        random.integer(0, 3);  // single patches and small nets of every degree: many shapes, not large ones
    const int p = random.integer(1, 5), q = random.integer(1, 5);
    ask(kind == 0 ? testing::sheet(random, p, q, static_cast<std::size_t>(p + 1), static_cast<std::size_t>(q + 1), 5,
                                   round % 2 == 0)
                  : testing::sheet(random, p, q, static_cast<std::size_t>(p + kind), static_cast<std::size_t>(q + kind),
                                   kind == 1 ? 0.5 : 10, round % 2 == 0),
        t);
  }
  check(t);
}

BOOST_AUTO_TEST_CASE(curve_boxes_enclose_and_are_tight) {
  Random random(53);
  for (int round = 0; round < 300; ++round) {
    const NurbsCurve c = random.curve(random.integer(1, 9), round % 3 != 0, round % 4 != 0);
    const CurvePieces pieces(c);
    const TightBox tight = tight_box(pieces);
    Box samples;
    for (std::size_t i = 0; i < pieces.size(); ++i)
      for (int k = 0; k <= 2000; ++k) samples.add(evaluate(c, pieces.spans()[i].at(k / 2000.0)));
    for (int axis = 0; axis < 3; ++axis) {
      const auto of = [&](Point p) { return component(p - Point{}, axis); };
      BOOST_CHECK_LE(of(samples.hi), of(tight.box.hi));
      BOOST_CHECK_GE(of(samples.lo), of(tight.box.lo));
      BOOST_CHECK_LE(of(tight.box.hi) - of(samples.hi), 1e-4);  // what the samples miss
    }
    BOOST_CHECK_LE(tight.slack, 1e-8);
  }
  // A circle of radius 2: the extremes are where they are.
  const NurbsCurve circle = to_nurbs(Curve{Circle{make_frame({1, 2, 3}, {1, 1, 1}), 2}})->curve;
  const TightBox box = tight_box(CurvePieces(circle));
  const double reach = 2 * std::sqrt(2.0 / 3);
  BOOST_CHECK_SMALL(box.box.hi.x - (1 + reach), 1e-9);
  BOOST_CHECK_SMALL(box.box.lo.z - (3 - reach), 1e-9);
  BOOST_CHECK_GE(box.box.hi.x, 1 + reach);
}

BOOST_AUTO_TEST_CASE(cones_hold_all_directions_and_derivative_bounds_all_derivatives) {
  Random random(54);
  int narrow = 0, cones = 0;
  for (int round = 0; round < 150; ++round) {
    const NurbsSurface s = testing::any_surface(random, round);
    const SurfacePieces pieces(s);
    for (std::size_t a = 0; a < pieces.spans_u().size(); ++a)
      for (std::size_t b = 0; b < pieces.spans_v().size(); ++b) {
        const DirectionCone normals = normal_cone(pieces, a, b), along_u = tangent_cone_u(pieces, a, b),
                            along_v = tangent_cone_v(pieces, a, b);
        const SurfaceDerivativeBounds d = derivative_bounds(pieces, a, b);
        ++cones;
        narrow += normals.half_angle_rad < pi / 2;
        const Interval u = pieces.spans_u()[a], v = pieces.spans_v()[b];
        Point corner[4];
        for (int k = 0; k < 4; ++k) corner[k] = evaluate(s, {k < 2 ? u.lo : u.hi, k % 2 == 0 ? v.lo : v.hi});
        const double deviation = bilinear_deviation_bound(pieces, a, b);
        for (int k = 0; k < 40; ++k) {
          const double x = random.real(0.001, 0.999), y = random.real(0.001, 0.999);
          const SurfaceJet j = jet(s, {u.at(x), v.at(y)});
          const double slack = 1e-9;
          if (norm(cross(j.du, j.dv)) > 1e-9 * norm(j.du) * norm(j.dv))
            BOOST_CHECK_LE(angle(normals.axis, cross(j.du, j.dv)), normals.half_angle_rad + 1e-7);
          if (norm(j.du) > 1e-9 * d.u) BOOST_CHECK_LE(angle(along_u.axis, j.du), along_u.half_angle_rad + 1e-7);
          if (norm(j.dv) > 1e-9 * d.v) BOOST_CHECK_LE(angle(along_v.axis, j.dv), along_v.half_angle_rad + 1e-7);
          BOOST_CHECK_LE(norm(j.du), d.u * (1 + slack));
          BOOST_CHECK_LE(norm(j.dv), d.v * (1 + slack));
          BOOST_CHECK_LE(norm(j.duu), d.uu * (1 + slack) + slack * d.u / u.length());
          BOOST_CHECK_LE(norm(j.duv), d.uv * (1 + slack) + slack * d.u / v.length());
          BOOST_CHECK_LE(norm(j.dvv), d.vv * (1 + slack) + slack * d.v / v.length());
          const Vector bilinear = (1 - x) * ((1 - y) * (corner[0] - Point{}) + y * (corner[1] - Point{})) +
                                  x * ((1 - y) * (corner[2] - Point{}) + y * (corner[3] - Point{}));
          BOOST_CHECK_LE(norm(j.point - to_point(bilinear)), deviation + 1e-11);
        }
      }
  }
  BOOST_CHECK_GT(narrow, cones / 3);  // that all were "any direction" would be no news
}

BOOST_AUTO_TEST_CASE(flattenings_stay_within_their_bound_and_need_few_points) {
  Random random(55);
  for (int round = 0; round < 150; ++round) {
    const NurbsCurve c = random.curve(random.integer(1, 7), round % 3 != 0, round % 4 != 0);
    const CurvePieces pieces(c);
    for (double tolerance : {1.0, 1e-3}) {
      const Flattening f = flatten(c, tolerance).value();
      BOOST_CHECK_LE(f.bound, tolerance);
      BOOST_REQUIRE_EQUAL(f.t.size(), f.points.size());
      for (std::size_t i = 0; i + 1 < f.t.size(); ++i)
        for (int k = 0; k <= 16; ++k) {
          const Point p = evaluate(c, Interval{f.t[i], f.t[i + 1]}.at(k / 16.0));
          const Vector along = f.points[i + 1] - f.points[i];
          const double x = dot(along, along) > 0 ? dot(p - f.points[i], along) / dot(along, along) : 0;
          BOOST_CHECK_LE(distance(p, f.points[i] + Interval{0, 1}.clamp(x) * along), f.bound + 1e-12);
        }
    }
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const CurveDerivativeBounds d = derivative_bounds(pieces, i);
      const DirectionCone cone = tangent_cone(pieces, i);
      for (int k = 0; k < 50; ++k) {
        const CurveJet j = jet(c, pieces.spans()[i].at(random.real(0.001, 0.999)));
        BOOST_CHECK_LE(norm(j.d1), d.first * (1 + 1e-9));
        BOOST_CHECK_LE(norm(j.d2), d.second * (1 + 1e-9) + 1e-9 * d.first / pieces.spans()[i].length());
        BOOST_CHECK_LE(angle(cone.axis, j.d1), cone.half_angle_rad + 1e-7);
      }
    }
  }
  // A circle: a tolerance of h needs arcs of 2 acos(1 - h / r); halving and the hull cost a factor below 4.
  const NurbsCurve circle = to_nurbs(Curve{Circle{Frame{}, 10}})->curve;
  const std::size_t least = static_cast<std::size_t>(pi / std::acos(1 - 1e-4 / 10));
  BOOST_CHECK_LE(flatten(circle, 1e-4)->t.size(), 4 * least);
  BOOST_CHECK(!flatten(circle, 1e-13, 1000));
  BOOST_CHECK(!flatten(circle, 0));
}

BOOST_AUTO_TEST_CASE(joined_cones_hold_both) {
  Random random(56);
  const auto direction = [&] { return normalized(Vector{random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)}); };
  for (int round = 0; round < 300; ++round) {
    const DirectionCone a{direction(), random.real(0, 1)}, b{direction(), random.real(0, 1)};
    const DirectionCone both = joined(a, b);
    for (int k = 0; k < 100; ++k) {
      const Vector d = direction();
      if (angle(d, a.axis) <= a.half_angle_rad || angle(d, b.axis) <= b.half_angle_rad)
        BOOST_CHECK_LE(angle(d, both.axis), both.half_angle_rad + 1e-12);
    }
  }
}

BOOST_AUTO_TEST_CASE(weights_that_are_not_positive_give_no_finite_bound) {
  const NurbsCurve half =
      NurbsCurve::from_homogeneous(2, {0, 0, 0, 1, 1, 1}, {{1, 0, 0, 1}, {0, 1, 0, 0}, {-1, 0, 0, 1}}).value();
  const CurvePieces pieces(half);
  BOOST_CHECK(std::isinf(tight_box(pieces).box.hi.x));
  BOOST_CHECK(std::isinf(derivative_bounds(pieces, 0).first));
  BOOST_CHECK(std::isinf(chord_height_bound(pieces, 0)));
  BOOST_CHECK_EQUAL(tangent_cone(pieces, 0).half_angle_rad, pi);
}
