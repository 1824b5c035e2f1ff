#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

#include "formats/csv/table.h"
#include "formats/font/outline.h"
#include "formats/json/json.h"
#include "formats/obj/read.h"
#include "formats/svg/document.h"
#include "tests/support/corpus.h"

using namespace trimloop;

BOOST_AUTO_TEST_SUITE(text_formats)

BOOST_AUTO_TEST_CASE(json_is_read_exactly_and_within_limits) {
  const auto v = json::parse(R"({"a": [1, -2.5e-3, 0.1, 18446744073709551615], "b": {"c": "x\u00e9"}, "d": true, "e": null})", {});
  BOOST_REQUIRE(v.has_value());
  BOOST_TEST(v->find("a")->items[2].number == 0.1);
  BOOST_TEST(v->find("a")->items[3].number == 18446744073709551615.0);
  BOOST_TEST(v->find("b")->find("c")->string == "x\xC3\xA9");
  BOOST_TEST(v->find("d")->boolean);
  BOOST_TEST(!v->find("z"));
  for (const char* bad : {"", "{", "[1,]", "{\"a\":1,\"a\":2}", "nul", "[1] 2", "{\"a\":NaN}"}) BOOST_TEST(!json::parse(bad, {}));
  Limits limits;
  limits.nesting_depth = 8;
  BOOST_TEST((json::parse(std::string(100000, '['), limits).error().code == ErrorCode::Limit));
  limits.list_count = 10;
  BOOST_TEST((json::parse("[1,2,3,4,5,6,7,8,9,10,11]", limits).error().code == ErrorCode::Limit));
  BOOST_TEST(json::parse("{\"a\": [1, 2", {}).error().measured > 5);
}

BOOST_AUTO_TEST_CASE(path_data_are_read_in_every_spelling) {
  const auto p = svg::parse_path("M10-20l5,5h-3V7c1 2 3 4 5 6s1 1 2 2Q0 0 1.5.5t1 1a5 5 0 0110 0z m1 1 2 2");
  BOOST_REQUIRE(p.has_value());
  BOOST_TEST(p->size() == 12u);
  using Kind = svg::Segment::Kind;
  BOOST_TEST(((*p)[0].at[0] == std::array<double, 2>{10, -20}));
  BOOST_TEST(((*p)[1].at[0] == std::array<double, 2>{15, -15}));
  BOOST_TEST(((*p)[2].at[0] == std::array<double, 2>{12, -15}));
  BOOST_TEST(((*p)[3].at[0] == std::array<double, 2>{12, 7}));
  BOOST_TEST(((*p)[4].at[1] == std::array<double, 2>{15, 11}));
  BOOST_TEST(((*p)[5].at[0] == std::array<double, 2>{19, 15}));  // reflected
  BOOST_TEST(((*p)[6].at[1] == std::array<double, 2>{1.5, 0.5}));
  BOOST_TEST(((*p)[7].at[0] == std::array<double, 2>{3, 1}));    // reflected
  BOOST_TEST(((*p)[8].kind == Kind::Arc && !(*p)[8].large && (*p)[8].sweep));
  BOOST_TEST(((*p)[9].kind == Kind::Close));
  BOOST_TEST(((*p)[10].at[0] == std::array<double, 2>{11, -19}));
  BOOST_TEST(((*p)[11].kind == Kind::Line));
  for (const char* bad : {"L1 1", "M1", "M1 2 3", "M0 0 C1 2 3 4", "M0 0 A1 1 0 2 0 3 3", "M0 0 X", "M1e999 0"}) BOOST_TEST(!svg::parse_path(bad));
}

BOOST_AUTO_TEST_CASE(absolute_path_data_keep_their_bits) {
  std::mt19937_64 engine(7);
  std::vector<svg::Segment> path(1);
  for (int i = 0; i < 2000; ++i) {
    svg::Segment s;
    s.kind = svg::Segment::Kind::Cubic;
    for (auto& p : s.at)
      for (double& c : p) c = std::ldexp(static_cast<double>(engine() >> 11), static_cast<int>(engine() % 40) - 60) * (engine() % 2 ? 1 : -1);
    path.push_back(s);
  }
  const auto again = svg::parse_path(svg::path_text(path));
  BOOST_REQUIRE(again.has_value());
  BOOST_REQUIRE(again->size() == path.size());
  for (std::size_t i = 0; i < path.size(); ++i) BOOST_REQUIRE((path[i].at == (*again)[i].at));
}

BOOST_AUTO_TEST_CASE(drawings_give_their_outlines_with_matrices) {
  const auto d = svg::parse(R"svg(<?xml version="1.0"?><svg xmlns="http://www.w3.org/2000/svg" width="200mm" viewBox="0 0 100 50">
    <g transform="translate(10 5) scale(2)"><path id="p" d="M0 0L1 1"/><circle r="3" cx="1"/></g>
    <rect width="4" height="2"/><polygon points="0,0 1,0 1,1"/><text>no</text><path d="M0 0 Q"/><rect width="0" height="3"/>
    <path transform="spin(3)" d="M0 0L1 1"/></svg>)svg", {});
  BOOST_REQUIRE(d.has_value());
  BOOST_TEST(d->user_unit_mm == 2);
  BOOST_TEST(d->outlines.size() == 4u);
  BOOST_TEST(d->outlines[0].id == "p");
  BOOST_TEST((d->outlines[0].matrix == svg::Matrix{2, 0, 0, 2, 10, 5}));
  BOOST_TEST(d->outlines[1].path.size() == 4u);
  BOOST_TEST(d->faults.size() == 2u);
  BOOST_TEST(d->left_out.at("text") == 1u);
  BOOST_TEST(!svg::parse("<svg", {}));
  BOOST_TEST(!svg::parse("<html/>", {}));
  BOOST_TEST(svg::sniff("<?xml version=\"1.0\"?>\n<svg "));
  BOOST_TEST(!svg::sniff("plain <svg"));
  std::string deep = "<svg>";
  for (int i = 0; i < 100000; ++i) deep += "<g>";
  deep += "<path d='M0 0L1 1'/>";
  for (int i = 0; i < 100000; ++i) deep += "</g>";
  const auto nested = svg::parse(deep + "</svg>", {});
  BOOST_REQUIRE(nested.has_value());
  BOOST_TEST(nested->outlines.empty());
  BOOST_TEST(nested->faults.size() == 1u);
}

BOOST_AUTO_TEST_CASE(tables_of_numbers_in_any_separator) {
  const auto blocks = csv::parse("# heights\nx;y;z\n1,5;2;3\n4;5,25;6\n\n0 1\n2\t3 # two\n", {});
  BOOST_REQUIRE(blocks.has_value());
  BOOST_TEST(blocks->size() == 2u);
  BOOST_TEST((*blocks)[0].values[0] == 1.5);
  BOOST_TEST((*blocks)[0].rows() == 2u);
  BOOST_TEST((*blocks)[1].columns == 2u);
  BOOST_TEST(csv::parse("1,2\n3,x\n", {}).error().measured == 2);
  BOOST_TEST(csv::parse("1,2\n3,4,5\n", {}).error().measured == 2);
  BOOST_TEST(!csv::parse("1,inf\n", {}));
  BOOST_TEST(csv::parse("", {})->empty());
}

BOOST_AUTO_TEST_CASE(control_meshes_of_obj_files) {
  const auto m = obj::read("# cube side\nv 0 0 0\nv 1 0 0\nv 1 1 0 0.5\nv 0 1 0\nvt 0 0\nf 1/1 2//1 3/1/1 -1\nl 1 2 3\n", {});
  BOOST_REQUIRE(m.has_value());
  BOOST_TEST((m->corners == std::vector<std::uint32_t>{0, 1, 2, 3}));
  BOOST_TEST(m->lines.size() == 2u);
  BOOST_TEST(m->passed_over == 1u);
  for (const char* bad : {"v 1 2\n", "v 0 0 0\nf 1 1 2\n", "v 0 0 0\nf 1 1\n", "f 0 1 2\n", "v 1 2 nan\n"}) BOOST_TEST(!obj::read(bad, {}));
}

BOOST_AUTO_TEST_CASE(glyphs_come_in_font_units) {
  const std::string bytes = trimloop::test::read_file("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf");
  BOOST_TEST(!font::outline("no font", "A"));
  if (bytes.empty()) {
    BOOST_TEST_MESSAGE("SKIPPED: DejaVu Sans is not installed (fonts-dejavu-core)");
    return;
  }
  BOOST_TEST(font::sniff(bytes));
  const auto o = font::outline(bytes, "O");
  BOOST_REQUIRE(o.has_value());
  BOOST_TEST(o->units_per_em == 2048);
  std::size_t closed = 0;
  for (const font::Segment& s : o->path) {
    closed += s.kind == font::Segment::Kind::Close;
    for (const auto& p : s.at) BOOST_TEST((p[0] == std::floor(p[0]) && p[1] == std::floor(p[1])));
  }
  BOOST_TEST(closed == 2u);
  const auto line = font::outline(bytes, "AV \xF4\x80\x80\x80");
  BOOST_TEST(line->missing.size() == 1u);
  BOOST_TEST(line->width > o->width);
}

BOOST_AUTO_TEST_SUITE_END()
