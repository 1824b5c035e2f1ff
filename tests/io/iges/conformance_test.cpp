// The micro-suite: files of a few entities, each with its closed-form answer. Every type and form of curve, surface and
// solid, and every construct that a widespread reader gets wrong. Deviations are at most 1e-12 of the size.
#include <fmt/format.h>

#include <functional>

#include "tests/io/iges/imported.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

constexpr double exact = 1e-12;

struct Case {
  const char* name;
  std::function<void(IgesText&)> build;
  std::function<Point(double)> point;  // of the one curve, at a fraction of its parameter range
  double size = 10;
};

// Curves: the point at a share of the range.
std::vector<Case> curve_cases() {
  const double s = std::sqrt(0.5);
  std::vector<Case> out;
  const auto add = [&](const char* name, std::function<void(IgesText&)> build, std::function<Point(double)> point) {
    out.push_back({name, std::move(build), std::move(point)});
  };
  add("100 arc at height ZT", [](IgesText& f) { f.add(100, "3.,1.,2.,6.,2.,1.,7."); },
      [](double t) { return Point{1 + 5 * std::cos(t * pi / 2), 2 + 5 * std::sin(t * pi / 2), 3}; });
  add("100 whole circle", [](IgesText& f) { f.add(100, "0.,0.,0.,5.,0.,5.,0."); },
      [](double t) { return Point{5 * std::cos(two_pi * t), 5 * std::sin(two_pi * t), 0}; });
  add("100 quarter under 124 form 1, x mirrored", [](IgesText& f) {
        const int m = f.add(124, "-1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.", {.form = 1});
        f.add(100, "0.,0.,0.,5.,0.,0.,5.", {.transform = m});
      }, [](double t) { return Point{-5 * std::cos(t * pi / 2), 5 * std::sin(t * pi / 2), 0}; });
  add("100 quarter under 124 form 1, z mirrored", [](IgesText& f) {
        const int m = f.add(124, "1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,-1.,0.", {.form = 1});
        f.add(100, "2.,0.,0.,5.,0.,0.,5.", {.transform = m});
      }, [](double t) { return Point{5 * std::cos(t * pi / 2), 5 * std::sin(t * pi / 2), -2}; });
  for (const int form : {0, 1})
    add("104 ellipse quarter", [form](IgesText& f) { f.add(104, ".04,0.,.25,0.,0.,-1.,0.,5.,0.,0.,2.", {.form = form}); },
        [](double t) { return Point{5 * std::cos(t * pi / 2), 2 * std::sin(t * pi / 2), 0}; });
  add("104 parabola", [](IgesText& f) { f.add(104, "1.,0.,0.,0.,-4.,0.,0.,-4.,4.,4.,4.", {.form = 3}); },
      [](double t) { return Point{-4 + 8 * t, (-4 + 8 * t) * (-4 + 8 * t) / 4, 0}; });
  add("106 form 11", [](IgesText& f) { f.add(106, "1,3,2.,0.,0.,4.,0.,4.,4.", {.form = 11}); },
      [](double t) { return t < 0.5 ? Point{8 * t, 0, 2} : Point{4, 8 * t - 4, 2}; });
  add("106 form 12", [](IgesText& f) { f.add(106, "2,3,0.,0.,0.,4.,0.,1.,4.,4.,2.", {.form = 12}); },
      [](double t) { return t < 0.5 ? Point{8 * t, 0, 2 * t} : Point{4, 8 * t - 4, 2 * t}; });
  add("106 form 13", [](IgesText& f) { f.add(106, "3,2,0.,0.,0.,0.,0.,1.,4.,0.,1.,0.,0.,1.", {.form = 13}); },
      [](double t) { return Point{4 * t, 0, t}; });
  add("106 form 63", [](IgesText& f) { f.add(106, "1,4,0.,0.,0.,3.,0.,0.,3.,0.,0.", {.form = 63}); },
      [](double t) {
        const double k = 3 * t;
        return k < 1 ? Point{3 * k, 0, 0} : k < 2 ? Point{3 - 3 * (k - 1), 3 * (k - 1), 0} : Point{0, 3 - 3 * (k - 2), 0};
      });
  add("110 segment", [](IgesText& f) { f.add(110, "1.,2.,3.,4.,6.,3."); },
      [](double t) { return Point{1 + 3 * t, 2 + 4 * t, 3}; });
  add("112 two cubics, wide parameters", [](IgesText& f) {
        f.add(112, "3,2,3,2,0.,2.,3.,0.,1.,0.,0.,0.,0.,1.,0.,1.,0.,0.,0.,2.,1.,0.,0.,4.,4.,1.,0.,1.,0.,0.,0.,"
                   "3.,1.,0.,0.,9.,6.,1.,0.,1.,0.,0.,0.");
      }, [](double t) { return Point{3 * t, 9 * t * t, 1}; });
  add("126 rational quarter", [s](IgesText& f) {
        f.add(126, fmt::format("2,2,1,0,0,0,0.,0.,0.,1.,1.,1.,1.,{},1.,5.,0.,0.,5.,5.,0.,0.,5.,0.,0.,1.,0.,0.,1.", s), {.form = 2});
      }, [s](double t) {
        const double a = (1 - t) * (1 - t), b = 2 * s * t * (1 - t), c = t * t, w = a + b + c;
        return Point{5 * (a + b) / w, 5 * (b + c) / w, 0};
      });
  add("126 sub-range of its knots", [](IgesText& f) { f.add(126, "1,1,1,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,8.,0.,0.,.25,.75,0.,0.,1."); },
      [](double t) { return Point{2 + 4 * t, 0, 0}; });
  add("130 FLAG 1 over all of a line", [](IgesText& f) {
        const int line = f.add(110, "0.,0.,0.,10.,0.,0.", {.status = dependent});
        f.add(130, "{},1,0,0,0,2.,0.,0.,0.,0.,0.,1.,0.,1.", {}, {line});
      }, [](double t) { return Point{10 * t, 2, 0}; });
  add("130 FLAG 2, tapered", [](IgesText& f) {
        const int line = f.add(110, "0.,0.,0.,10.,0.,0.", {.status = dependent});
        f.add(130, "{},2,0,0,2,2.,0.,3.,1.,0.,0.,1.,0.,1.", {}, {line});
      }, [](double t) { return Point{10 * t, 2 + t, 0}; });
  add("130 FLAG 3, a linear law", [](IgesText& f) {
        const int line = f.add(110, "0.,0.,0.,10.,0.,0.", {.status = dependent});
        const int law = f.add(110, "0.,1.,0.,1.,5.,0.", {.status = dependent});
        f.add(130, "{},3,{},2,2,0.,0.,0.,0.,0.,0.,1.,0.,1.", {}, {line, law});
      }, [](double t) { return Point{10 * t, 1 + 4 * t, 0}; });
  add("102 of a line and an arc", [](IgesText& f) {
        const int line = f.add(110, "0.,0.,0.,1.,0.,0.", {.status = dependent});
        const int arc = f.add(100, "0.,1.,1.,1.,0.,2.,1.", {.status = dependent});  // from -90 to 0 degrees
        f.add(102, "2,{},{}", {}, {line, arc});
      }, [](double t) {
        const double p = t * (1 + pi / 2);
        return p < 1 ? Point{p, 0, 0} : Point{1 + std::sin(p - 1), 1 - std::cos(p - 1), 0};
      });
  return out;
}

struct FaceCase {
  const char* name;
  std::function<void(IgesText&)> build;
  double area;
  std::function<Point(Uv)> point;  // at a share of the natural rectangle; empty: area only
};

int line(IgesText& f, const char* points) { return f.add(110, points, {.status = dependent}); }

std::vector<FaceCase> face_cases() {
  std::vector<FaceCase> out;
  const auto add = [&](const char* name, double area, std::function<void(IgesText&)> build, std::function<Point(Uv)> point = {}) {
    out.push_back({name, std::move(build), area, std::move(point)});
  };
  const std::string square = "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,8.,0.,0.,0.,4.,0.,8.,4.,0.,";
  add("128 with U0, U1, V0, V1 = 0, .5, .25, .75", 8, [square](IgesText& f) { f.add(128, square + "0.,.5,.25,.75"); },
      [](Uv p) { return Point{4 * p.u, 1 + 2 * p.v, 0}; });
  add("128 with a part of its knots", 8, [square](IgesText& f) { f.add(128, square + ".25,.75,.25,.75"); },
      [](Uv p) { return Point{2 + 4 * p.u, 1 + 2 * p.v, 0}; });
  add("114 a bilinear patch", 32, [](IgesText& f) {
        const std::string zeros = "0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.", none = "0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.";
        const std::string patch = "0.,8.," + zeros + ",0.,0.,0.,0.,4.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.," + none;
        f.add(114, "3,1,1,1,0.,1.,0.,1.," + patch + "," + none + "," + none + "," + none + "," + none + "," + none + "," + none +
                       "," + none + "," + none + "," + none);
      });
  add("118 form 1, equal parameters", 20, [](IgesText& f) {
        const int a = line(f, "0.,0.,0.,10.,0.,0."), b = line(f, "0.,2.,0.,10.,2.,0.");
        f.add(118, "{},{},0,0", {.form = 1}, {a, b});
      }, [](Uv p) { return Point{10 * p.u, 2 * p.v, 0}; });
  add("118 form 0, equal arc length under uneven speed", 20, [](IgesText& f) {
        const int a = f.add(126, "2,2,1,0,1,0,0.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,3.,0.,0.,10.,0.,0.,0.,1.,0.,0.,1.", {.status = dependent});
        const int b = line(f, "0.,2.,0.,10.,2.,0.");
        f.add(118, "{},{},0,0", {.form = 0}, {a, b});
      }, [](Uv p) { return Point{10 * p.u, 2 * p.v, 0}; });
  add("118 with DIRFLG 1", 10, [](IgesText& f) {
        const int a = line(f, "0.,0.,0.,10.,0.,0."), b = line(f, "10.,2.,0.,0.,2.,0.");
        f.add(118, "{},{},1,0", {.form = 1}, {a, b});
      }, [](Uv p) { return Point{10 * p.u, 2 * p.v, 0}; });
  out.back().area = 20;
  add("120 a cone's side about a line", pi * 2 * std::sqrt(13.0), [](IgesText& f) {
        const int axis = line(f, "0.,0.,0.,0.,0.,1."), side = line(f, "2.,0.,0.,0.,0.,3.");
        f.add(120, "{},{},0.,6.283185307179586", {}, {axis, side});
      });
  add("122 to its terminate point", 50, [](IgesText& f) {
        const int base = line(f, "1.,0.,0.,11.,0.,0.");
        f.add(122, "{},1.,3.,4.", {}, {base});
      }, [](Uv p) { return Point{1 + 10 * p.u, 3 * p.v, 4 * p.v}; });
  add("140 with its indicator against the normal", 32, [square](IgesText& f) {
        const int base = f.add(128, square + "0.,1.,0.,1.", {.status = dependent});
        f.add(140, "0.,0.,-1.,2.,{}", {}, {base});
      }, [](Uv p) { return Point{8 * p.u, 4 * p.v, -2}; });
  add("140 of a 140", 32, [square](IgesText& f) {
        const int base = f.add(128, square + "0.,1.,0.,1.", {.status = dependent});
        const int once = f.add(140, "0.,0.,1.,2.,{}", {.status = dependent}, {base});
        f.add(140, "0.,0.,1.,3.,{}", {}, {once});
      }, [](Uv p) { return Point{8 * p.u, 4 * p.v, 5}; });
  add("143 over a 141 without curves", 32, [square](IgesText& f) {
        const int base = f.add(128, square + "0.,1.,0.,1.", {.status = dependent});
        const int border = f.add(141, "1,2,{},0", {.status = dependent}, {base});
        f.add(143, "1,{},1,{}", {}, {base, border});
      });
  add("144 with N1 = 0 and a hole", 32 - pi, [square](IgesText& f) {
        const int base = f.add(128, square + "0.,1.,0.,1.", {.status = dependent});
        const int circle = f.add(100, "0.,4.,2.,5.,2.,5.,2.", {.status = dependent});
        const int hole = f.add(142, "1,{},0,{},2", {.status = dependent}, {base, circle});
        f.add(144, "{},0,1,0,{}", {}, {base, hole});
      });
  add("108 with a hole by 402 form 9", 100 - pi, [](IgesText& f) {
        const int border = f.add(106, "1,5,0.,0.,0.,10.,0.,10.,10.,0.,10.,0.,0.", {.form = 63, .status = dependent});
        const int circle = f.add(100, "0.,5.,5.,6.,5.,6.,5.", {.status = dependent});
        const int plane = f.add(108, "0.,0.,1.,0.,{}", {.form = 1}, {border});
        const int hole = f.add(108, "0.,0.,1.,0.,{}", {.form = -1, .status = dependent}, {circle});
        f.add(402, "1,1,{},{}", {.form = 9}, {plane, hole});
      });
  for (const int form : {0, 1})
    add("196 whole sphere", 36 * pi, [form](IgesText& f) {
      const int centre = f.add(116, "1.,2.,3.,0", {.status = dependent}), z = f.add(123, "0.,0.,1.", {.status = dependent});
      const int x = f.add(123, "1.,0.,0.", {.status = dependent});
      form == 0 ? f.add(196, "{},3.", {}, {centre}) : f.add(196, "{},3.,{},{}", {.form = 1}, {centre, z, x});
    });
  for (const int form : {0, 1})
    add("198 whole torus", 40 * pi * pi, [form](IgesText& f) {
      const int centre = f.add(116, "1.,2.,3.,0", {.status = dependent}), z = f.add(123, "0.,0.,1.", {.status = dependent});
      const int x = f.add(123, "1.,0.,0.", {.status = dependent});
      form == 0 ? f.add(198, "{},{},5.,2.", {}, {centre, z}) : f.add(198, "{},{},5.,2.,{}", {.form = 1}, {centre, z, x});
    });
  return out;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(conformance)

BOOST_AUTO_TEST_CASE(curves_are_where_their_formulas_are) {
  double worst = 0;
  for (const Case& c : curve_cases()) {
    IgesText file;
    c.build(file);
    const Imported in = imported(file);
    BOOST_TEST_CONTEXT(c.name) {
      BOOST_REQUIRE(in.root().curves.size() == 1u);
      const Interval r = range(in.curve());
      for (const double t : {0.0, 0.1, 0.25, 0.5, 0.8, 1.0}) {
        const double off = distance(evaluate(in.curve(), r.at(t)), c.point(t)) / c.size;
        BOOST_TEST(off <= exact, "at " << t << " off by " << off);
        worst = std::max(worst, off);
      }
    }
  }
  BOOST_TEST_MESSAGE("curves: largest deviation " << worst << " of the size");
}

BOOST_AUTO_TEST_CASE(rays_and_lines_have_no_end) {
  IgesText file;
  file.add(110, "1.,0.,0.,2.,0.,0.", {.form = 1});
  file.add(110, "1.,0.,0.,2.,0.,0.", {.form = 2});
  const Imported in = imported(file);
  BOOST_TEST(range(in.curve(0)).lo == 0);
  BOOST_TEST(range(in.curve(0)).hi == infinity);
  BOOST_TEST(range(in.curve(1)).lo == -infinity);
  check_point(evaluate(in.curve(1), -3), {-2, 0, 0});
}

BOOST_AUTO_TEST_CASE(faces_have_their_areas_and_points) {
  double worst = 0;
  for (const FaceCase& c : face_cases()) {
    IgesText file;
    c.build(file);
    const Imported in = imported(file);
    BOOST_TEST_CONTEXT(c.name) {
      in.check_sound();
      BOOST_REQUIRE(in.faces().size() == 1u);
      BOOST_TEST(in.area() == c.area, boost::test_tools::tolerance(1e-7));
      if (!c.point) continue;
      const SurfaceDomain d = domain(in.surface());
      for (const Uv p : {Uv{0, 0}, Uv{0.25, 0.5}, Uv{1, 0.75}, Uv{0.5, 1}}) {
        const double off = distance(evaluate(in.surface(), {d.u.at(p.u), d.v.at(p.v)}), c.point(p)) / 10;
        // Arc length is a table of quadratures: 1e-10, as arc_length.h says.
        const double limit = std::string_view(c.name).find("arc length") == std::string_view::npos ? exact : 1e-9;
        BOOST_TEST(off <= limit, "at " << p.u << " " << p.v << " off by " << off);
        if (limit == exact) worst = std::max(worst, off);
      }
    }
  }
  BOOST_TEST_MESSAGE("surfaces: largest deviation " << worst << " of the size");
}

BOOST_AUTO_TEST_CASE(a_weight_that_is_all_but_nothing_stays) {
  IgesText file;
  file.add(128, "1,1,1,1,0,0,0,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.E-10,0.,0.,0.,1.,0.,0.,0.,1.,0.,1.,1.,0.,0.,1.,0.,1.");
  const Imported in = imported(file);
  const auto* nurbs = std::get_if<NurbsSurface>(&in.surface().shape);
  BOOST_REQUIRE(nurbs);
  BOOST_TEST(nurbs->poles().back().w == 1e-10);
  BOOST_TEST(in.finding("IG-E128-06").measured == 1e10);
}

BOOST_AUTO_TEST_CASE(instances_scale_then_shift_then_turn) {
  IgesText file;
  const int point = file.add(116, "1.,0.,0.,0", {.status = dependent});
  const int definition = file.add(308, "0,1Hp,1,{}", {.status = "00000200"}, {point});
  const int turn = file.add(124, "0.,-1.,0.,0.,1.,0.,0.,0.,0.,0.,1.,0.");
  file.add(408, "{},0.,0.,0.,2.", {}, {definition});                     // scaled, no matrix
  file.add(408, "{},10.,0.,0.,2.", {.transform = turn}, {definition});  // 2 x -> (12, 0) -> turned (0, 12)
  const Imported in = imported(file);
  const auto all = occurrences(in.model, 10, 10);
  BOOST_REQUIRE(all);
  BOOST_REQUIRE(all->size() == 3u);
  const Point p = in.model.parts[1].points.at(0).point;
  check_point(apply((*all)[1].transform, p), {2, 0, 0});
  check_point(apply((*all)[2].transform, p), {0, 12, 0});
}

BOOST_AUTO_TEST_CASE(what_crashes_others_is_read_or_named) {
  IgesText file;
  file.add(402, "1,0,0,0,0,0,0,0", {.form = 20});                   // piping flow
  file.add(320, "0,3Hnet,0,0,0,0,0", {.status = "00000200"});      // network subfigure definition
  file.add(128, "1,1,1,1,0,0,1,0,0,0.,0.,1.");                     // cut short
  file.add(110, "0.,0.,0.,1.,0.,0.");
  const Imported in = imported(file);
  BOOST_TEST(in.root().curves.size() == 1u);
  BOOST_TEST(in.report.count(Severity::Error) > 0u);
}

BOOST_AUTO_TEST_SUITE_END()
