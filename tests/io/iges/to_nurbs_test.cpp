// Every type that --to-nurbs promises, composed, converted to IGES and to STEP: what the statement says of it, that what
// comes back is a spline, and that it has kept its length or area.
#include <functional>

#include "io/io.h"
#include "tests/io/iges/imported.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

using Form = io::NurbsEntity::Form;

struct Case {
  const char* name;
  std::function<void(IgesText&)> build;
  const char* shape;
  Form form = Form::Exact;
};

int line(IgesText& f, const char* points) { return f.add(110, points, {.status = dependent}); }
int point(IgesText& f) { return f.add(116, "1.,2.,3.,0", {.status = dependent}); }
int direction(IgesText& f, const char* v) { return f.add(123, v, {.status = dependent}); }
// The rectangle [0.2, 1.2] x [0.5, 2] of a surface.
void trim(IgesText& f, int surface) {
  const int border = f.add(106, "1,5,0.,.2,.5,1.2,.5,1.2,2.,.2,2.,.2,.5", {.form = 63, .status = parametric});
  const int loop = f.add(142, "1,{},{},0,1", {.status = dependent}, {surface, border});
  f.add(144, "{},1,0,{}", {}, {surface, loop});
}

std::vector<Case> cases() {
  const std::string none = "0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.";
  return {
      {"100 arc", [](IgesText& f) { f.add(100, "3.,1.,2.,6.,2.,1.,7."); }, "circle"},
      {"100 whole circle", [](IgesText& f) { f.add(100, "0.,0.,0.,5.,0.,5.,0."); }, "circle"},
      {"102", [](IgesText& f) {
         const int first = line(f, "0.,0.,0.,1.,0.,0.");
         const int second = f.add(100, "0.,1.,1.,1.,0.,2.,1.", {.status = dependent});
         f.add(102, "2,{},{}", {}, {first, second});
       }, "composite curve"},
      {"104 ellipse", [](IgesText& f) { f.add(104, ".04,0.,.25,0.,0.,-1.,0.,5.,0.,0.,2.", {.form = 1}); }, "ellipse"},
      {"104 hyperbola", [](IgesText& f) {
         f.add(104, "1.,0.,-1.,0.,0.,-1.,0.,1.,0.,1.25,.75", {.form = 2});
       }, "hyperbola"},
      {"104 parabola", [](IgesText& f) { f.add(104, "1.,0.,0.,0.,-4.,0.,0.,-4.,4.,4.,4.", {.form = 3}); }, "parabola"},
      {"106 form 12", [](IgesText& f) { f.add(106, "2,3,0.,0.,0.,4.,0.,1.,4.,4.,2.", {.form = 12}); }, "polyline"},
      {"110", [](IgesText& f) { f.add(110, "1.,2.,3.,4.,6.,3."); }, "line"},
      {"110 without end", [](IgesText& f) { f.add(110, "1.,0.,0.,2.,0.,0.", {.form = 2}); }, "line", Form::Kept},
      {"112", [](IgesText& f) {
         f.add(112, "3,2,3,1,0.,2.,0.,1.,0.,0.,0.,0.,1.,0.,1.,0.,0.,0.,2.,1.,0.,0.,4.,4.,1.,0.,1.,0.,0.,0.");
       }, "NURBS"},
      {"114", [none](IgesText& f) {
         const std::string zeros = "0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.";
         std::string text = "3,1,1,1,0.,1.,0.,1.,0.,8.," + zeros + ",0.,0.,0.,0.,4.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.," + none;
         for (int k = 0; k < 9; ++k) text += "," + none;
         f.add(114, text);
       }, "NURBS"},
      {"118 form 1", [](IgesText& f) {
         const int a = line(f, "0.,0.,0.,10.,0.,0."), b = line(f, "0.,2.,0.,10.,2.,3.");
         f.add(118, "{},{},0,0", {.form = 1}, {a, b});
       }, "ruled"},
      {"118 form 0 over uneven speed", [](IgesText& f) {
         const int a = f.add(126, "2,2,1,0,1,0,0.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,3.,0.,0.,10.,0.,0.,0.,1.,0.,0.,1.",
                             {.status = dependent});
         const int b = line(f, "0.,2.,0.,10.,2.,0.");
         f.add(118, "{},{},0,0", {.form = 0}, {a, b});
       }, "ruled", Form::Kept},
      {"120", [](IgesText& f) {
         const int axis = line(f, "0.,0.,0.,0.,0.,1."), side = line(f, "2.,0.,0.,1.,0.,3.");
         f.add(120, "{},{},0.,4.", {}, {axis, side});
       }, "revolution"},
      {"122", [](IgesText& f) {
         const int base = f.add(100, "0.,0.,0.,5.,0.,0.,5.", {.status = dependent});
         f.add(122, "{},1.,3.,4.", {}, {base});
       }, "extrusion"},
      {"140 of a cylinder's part", [](IgesText& f) {
         const int base = f.add(100, "0.,0.,0.,5.,0.,0.,5.", {.status = dependent});
         const int tube = f.add(122, "{},5.,0.,4.", {.status = dependent}, {base});
         f.add(140, "1.,0.,0.,2.,{}", {}, {tube});
       }, "offset", Form::Kept},
      {"190", [](IgesText& f) { trim(f, f.add(190, "{},{},{}", {.form = 1, .status = dependent},
                                              {point(f), direction(f, "0.,0.,1."), direction(f, "1.,0.,0.")})); }, "plane"},
      {"192", [](IgesText& f) { trim(f, f.add(192, "{},{},3.,{}", {.form = 1, .status = dependent},
                                              {point(f), direction(f, "0.,0.,1."), direction(f, "1.,0.,0.")})); }, "cylinder"},
      {"194", [](IgesText& f) { trim(f, f.add(194, "{},{},3.,20.,{}", {.form = 1, .status = dependent},
                                              {point(f), direction(f, "0.,0.,1."), direction(f, "1.,0.,0.")})); }, "cone"},
      {"196", [](IgesText& f) { f.add(196, "{},3.", {}, {point(f)}); }, "sphere"},
      {"198", [](IgesText& f) { f.add(198, "{},{},5.,2.", {}, {point(f), direction(f, "0.,0.,1.")}); }, "torus"},
  };
}

struct Amounts {
  std::size_t faces = 0, curves = 0, splines = 0;  // splines among both
  double area = 0, length = 0;
};
Amounts amounts(const Model& model) {
  Amounts out;
  for (const Part& part : model.parts) {
    for (const FreeCurve& c : part.curves) {
      ++out.curves;
      out.splines += std::holds_alternative<NurbsCurve>(c.curve.shape);
      if (is_bounded(c.curve)) out.length += length(c.curve, 1e-12);
    }
    for (const Body& body : part.bodies) {
      for (std::uint32_t i = 0; i < body.faces.size(); ++i) {
        ++out.faces;
        out.splines += std::holds_alternative<NurbsSurface>(body.faces[i].surface->shape);
        out.area += area(body, FaceId{i}, 1e-11).value;
      }
    }
  }
  return out;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(to_nurbs_statement)

BOOST_AUTO_TEST_CASE(each_type_is_exact_or_said_to_be_kept) {
  for (const io::Format format : {io::Format::Iges, io::Format::Step}) {
    for (const Case& c : cases()) {
      BOOST_TEST_CONTEXT(c.name << (format == io::Format::Iges ? " to IGES" : " to STEP")) {
        IgesText file;
        c.build(file);
        const io::ReadResult in = io::read_bytes(file.text(), "test.igs");
        BOOST_REQUIRE(in.usable);
        io::WriteOptions how;
        how.format = format;
        how.to_nurbs = true;
        const auto written = io::encode(in.model, in.source, how);
        if (c.form == Form::Kept && !written) continue;  // a STEP file of nothing but a line without end is refused
        BOOST_REQUIRE_MESSAGE(written, written.error().text);
        BOOST_REQUIRE_EQUAL(written->nurbs.entities.size(), 1u);
        const io::NurbsEntity& row = written->nurbs.entities.front();
        BOOST_TEST(row.shape == c.shape);
        BOOST_TEST((row.form == c.form), row.reason);
        BOOST_TEST(row.reason.empty() == (c.form != Form::Kept));
        BOOST_TEST(row.source.starts_with("D"));
        BOOST_TEST(row.deviation_mm == 0);
        BOOST_TEST(row.edges_kept == 0u);
        if (c.form == Form::Kept) continue;

        const io::ReadResult back = io::read_bytes(written->bytes, format == io::Format::Iges ? "t.igs" : "t.stp");
        BOOST_REQUIRE(back.usable);
        const Amounts was = amounts(in.model), is = amounts(back.model);
        BOOST_TEST(is.faces == was.faces);
        BOOST_TEST(is.curves == was.curves);
        BOOST_TEST(is.splines == is.faces + is.curves);
        BOOST_TEST(std::abs(is.area - was.area) <= 1e-9 * was.area, was.area << " became " << is.area);
        BOOST_TEST(std::abs(is.length - was.length) <= 1e-9 * was.length, was.length << " became " << is.length);
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
