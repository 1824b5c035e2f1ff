// Trimmed faces that no sender should write, from file to triangles: each ends with a verdict and its reason, and with an
// amount of triangles and memory that its size explains.

#include <boost/test/unit_test.hpp>

#include "io/io.h"
#include "kernel/check/measure.h"
#include "tests/support/allocations.h"
#include "tests/support/iges_text.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

constexpr const char* dependent = "00010000";
constexpr const char* parametric = "00010500";

struct Outcome {
  io::ReadResult in;
  io::WriteResult stl;
  std::size_t bytes = 0, largest = 0;

  const Body& body() const { return in.model.parts.front().bodies.front(); }
  const Face& face() const { return body().faces.front(); }
  double area() const { return trimloop::area(body(), FaceId{0}).value; }
  bool has(std::string_view rule) const { return in.report.count(rule) > 0; }
};

Outcome through(const IgesText& file) {
  Outcome out;
  std::string text = file.text();
  out.bytes = text.size();
  forget_allocations();
  io::ReadOptions read;
  read.sew = read.measure_findings = true;
  out.in = io::read_bytes(std::move(text), "hostile.igs", read);
  BOOST_REQUIRE(out.in.usable);
  io::WriteOptions write;
  write.format = io::Format::Stl;
  if (auto made = io::encode(out.in.model, out.in.source, write)) out.stl = std::move(*made);
  out.largest = largest_allocation();
  BOOST_REQUIRE(!out.in.model.parts.empty());
  BOOST_REQUIRE(out.in.model.parts.front().bodies.size() == 1u);
  BOOST_REQUIRE(out.body().faces.size() == 1u);
  if (out.face().status != FaceStatus::Ok) BOOST_TEST(!out.face().reason.empty());
  return out;
}

// x from 0 to width, y from 0 to height, which are its parameters too.
int add_plate(IgesText& file, double width, double height) {
  const std::string w = std::to_string(width), h = std::to_string(height);
  return file.add(128,
                  "1,1,1,1,0,0,1,0,0,0.,0.," + w + "," + w + ",0.,0.," + h + "," + h + ",1.,1.,1.,1.,0.,0.,0.," + w + ",0.,0.,0.," + h +
                      ",0.," + w + "," + h + ",0.,0.," + w + ",0.," + h,
                  {.status = dependent});
}

int add_path(IgesText& file, const std::vector<Uv>& points) {
  std::string out = "1," + std::to_string(points.size()) + ",0.";
  for (const Uv p : points) out += "," + std::to_string(p.u) + "," + std::to_string(p.v);
  return file.add(106, out, {.form = 11, .status = parametric});
}

int add_boundary(IgesText& file, int surface, std::vector<Uv> points, bool closed = true) {
  if (closed) points.push_back(points.front());
  return file.add(142, "1,{},{},0,1", {.status = dependent}, {surface, add_path(file, points)});
}

IgesText trimmed_plate(double width, double height, const std::vector<Uv>& loop, bool closed = true) {
  IgesText file;
  const int plate = add_plate(file, width, height), border = add_boundary(file, plate, loop, closed);
  file.add(144, "{},1,0,{}", {}, {plate, border});
  return file;
}

const auto nearly = boost::test_tools::tolerance(1e-6);

}  // namespace

BOOST_AUTO_TEST_SUITE(hostile_trims)

BOOST_AUTO_TEST_CASE(a_loop_that_closes_nowhere) {
  const Outcome line = through(trimmed_plate(10, 10, {{1, 1}, {9, 8}}, false));
  BOOST_TEST((line.face().status == FaceStatus::Failed));
  BOOST_TEST(line.has("MD-12"));
  // Three sides of a square: closed by the fourth, which is said with its length.
  const Outcome open = through(trimmed_plate(10, 10, {{1, 1}, {9, 1}, {9, 9}, {1, 9}}, false));
  BOOST_TEST((open.face().status == FaceStatus::Healed));
  BOOST_TEST(open.area() == 64, nearly);
  BOOST_TEST(open.has("IG-E144-02"));
  BOOST_TEST(open.stl.triangles == 2u);
}

BOOST_AUTO_TEST_CASE(a_loop_that_crosses_itself) {
  const Outcome bow = through(trimmed_plate(10, 10, {{1, 1}, {9, 9}, {9, 1}, {1, 9}}));
  BOOST_TEST((bow.face().status == FaceStatus::Healed));
  BOOST_TEST(bow.area() == 32, nearly);
  BOOST_TEST(bow.stl.triangles == 2u);
  BOOST_REQUIRE(bow.has("IG-E144-04"));
  for (const Diagnostic& d : bow.in.report.items())
    if (d.rule->id == "IG-E144-04") {
      BOOST_REQUIRE(d.at.has_value());
      BOOST_TEST((*d.at)[0] == 5, nearly);
      BOOST_TEST((*d.at)[1] == 5, nearly);
    }
}

BOOST_AUTO_TEST_CASE(a_million_times_longer_than_wide) {
  const Outcome o = through(trimmed_plate(1e6, 1, {{0, 0}, {1e6, 0}, {1e6, 1}, {0, 1}}));
  BOOST_TEST((o.face().status == FaceStatus::Ok), o.face().reason);
  BOOST_TEST(o.area() == 1e6, nearly);
  BOOST_TEST(o.stl.triangles == 2u);
}

BOOST_AUTO_TEST_CASE(a_hundred_thousand_points) {
  constexpr int n = 100'000;
  std::vector<Uv> loop;
  for (int i = 0; i < n; ++i) loop.push_back({500 + 400 * std::cos(two_pi * i / n), 500 + 400 * std::sin(two_pi * i / n)});
  const Outcome o = through(trimmed_plate(1000, 1000, loop));
  BOOST_TEST((o.face().status == FaceStatus::Ok), o.face().reason);
  BOOST_TEST(o.area() == pi * 160'000, nearly);
  BOOST_TEST(o.stl.triangles <= std::size_t{n});
  BOOST_TEST(o.largest < 16 * o.bytes);
}

BOOST_AUTO_TEST_CASE(ten_thousand_holes) {
  IgesText file;
  const int plate = add_plate(file, 300, 300);
  const int border = add_boundary(file, plate, {{0, 0}, {300, 0}, {300, 300}, {0, 300}});
  std::string holes;
  for (int i = 0; i < 100; ++i)
    for (int k = 0; k < 100; ++k) {
      const double u = 3 * i + 1, v = 3 * k + 1;
      holes += "," + std::to_string(add_boundary(file, plate, {{u, v}, {u + 1, v}, {u + 1, v + 1}, {u, v + 1}}));
    }
  file.add(144, "{},1,10000,{}" + holes, {}, {plate, border});
  const Outcome o = through(file);
  BOOST_TEST((o.face().status == FaceStatus::Ok), o.face().reason);
  BOOST_TEST(o.face().loops.size() == 10'001u);
  BOOST_TEST(o.area() == 80'000, nearly);
  // v + 2 h - 2 triangles for v corners and h holes
  BOOST_TEST(o.stl.triangles == 40'004u + 20'000u - 2u);
  BOOST_TEST(o.largest < 16 * o.bytes);
}

BOOST_AUTO_TEST_CASE(a_surface_folded_on_itself) {
  IgesText file;  // there and back over the same place
  const int fold = file.add(128,
                            "2,1,2,1,0,0,1,0,0,0.,0.,0.,1.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,1.,1.,0.,0.,0.,10.,0.,0.,0.,0.,0.,"
                            "0.,5.,0.,10.,5.,0.,0.,5.,0.,0.,1.,0.,1.",
                            {.status = dependent});
  const int border = add_boundary(file, fold, {{0.125, 0.125}, {0.875, 0.125}, {0.875, 0.875}, {0.125, 0.875}});
  file.add(144, "{},1,0,{}", {}, {fold, border});
  const Outcome o = through(file);
  // x = 20 u (1 - u) runs from 2.1875 to 5 and back.
  BOOST_TEST(o.area() == 2 * (5 - 2.1875) * 5 * 0.75, boost::test_tools::tolerance(1e-4));
  BOOST_TEST(o.stl.triangles < 10'000u);
}

BOOST_AUTO_TEST_CASE(poles_at_the_end_of_the_numbers) {
  for (const char* far : {"1.E308", "-1.E308"}) {
    IgesText file;
    const std::string f = far;
    const int huge = file.add(128, "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.," + f + ",0.,0.,0.," + f + ",0.," + f + "," + f +
                                       ",0.,0.,1.,0.,1.",
                              {.status = dependent});
    const int border = add_boundary(file, huge, {{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}});
    file.add(144, "{},1,0,{}", {}, {huge, border});
    const Outcome o = through(file);
    BOOST_TEST((o.face().status != FaceStatus::Ok || !o.in.report.items().empty()));
    BOOST_TEST(o.stl.triangles < 10'000u);
    BOOST_TEST(o.largest < std::size_t{64} << 20);
  }
}

BOOST_AUTO_TEST_SUITE_END()
