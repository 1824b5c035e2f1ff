// Every typed record: from text to struct and back to the same text.
#include <fmt/format.h>

#include <boost/test/unit_test.hpp>

#include "tests/formats/iges/records/decode.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

struct Sample {
  int type, form;
  const char* text;  // spelt as TokenWriter spells
};

// Own parameters only; the stock of decode.h is what the pointers reach.
const Sample samples[] = {
    {100, 0, "0.5,1.,2.,3.,2.,1.,4."},
    {102, 0, "2,5,7"},
    {104, 1, "0.25,0.,1.,0.,0.,-1.,0.,2.,0.,0.,1."},
    {106, 1, "1,2,0.5,1.,2.,3.,4."},
    {106, 2, "2,2,1.,2.,3.,4.,5.,6."},
    {106, 3, "3,1,1.,2.,3.,0.,0.,1."},
    {106, 12, "2,3,0.,0.,0.,1.,0.,0.,1.,1.,0."},
    {106, 63, "1,4,0.,0.,0.,1.,0.,1.,1.,0.,0."},
    {108, 0, "0.,0.,1.,5.,0,0.,0.,5.,1."},
    {108, 1, "0.,0.,1.,5.,7,0.,0.,5.,1."},
    {110, 0, "0.,0.,0.,1.,2.,1.E-20"},
    {112, 0, "3,2,3,1,0.,2.,1.,1.,0.,0.,0.,2.,0.,0.,0.,0.,3.,0.,3.,1.,0.,0.,4.,2.,0.,0.,24.,36.,18.,3."},
    {116, 0, "1.,2.,3.,25"},
    {118, 1, "5,7,1,0"},
    {120, 0, "5,7,0.,6.283185307179586"},
    {122, 0, "7,0.,0.,10."},
    {123, 0, "0.,0.,-1."},
    {124, 0, "1.,0.,0.,5.,0.,0.6,-0.8,6.,0.,0.8,0.6,7."},
    {126, 0, "2,2,1,0,0,0,0.,0.,0.,1.,1.,1.,1.,0.7071067811865476,1.,1.,0.,0.,1.,1.,0.,0.,1.,0.,0.,1.,0.,0.,1."},
    {128, 0,
     "1,2,1,2,0,0,1,0,0,0.,0.,1.,1.,0.,0.,0.,1.,1.,1.,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,1.,1.,1.,1.,0.,2.,0.,"
     "1.,2.,0.,0.,1.,0.25,1."},
    {130, 0, "7,1,0,0,0,2.,0.,0.,0.,0.,0.,1.,0.,1."},
    {140, 0, "0.,0.,1.,0.5,9"},
    {141, 0, "1,2,9,2,5,1,1,31,7,2,2,31,31"},
    {142, 0, "1,9,31,5,3"},
    {143, 0, "0,9,2,13,13"},
    {144, 0, "9,1,2,11,11,11"},
    {186, 0, "23,1,1,33,0"},
    {190, 0, "1,3"},
    {190, 1, "1,3,3"},
    {192, 0, "1,3,2.5"},
    {192, 1, "1,3,2.5,3"},
    {194, 0, "1,3,2.5,30."},
    {194, 1, "1,3,2.5,30.,3"},
    {196, 0, "1,2.5"},
    {196, 1, "1,2.5,3,3"},
    {198, 0, "1,3,2.5,1."},
    {198, 1, "1,3,2.5,1.,3"},
    {308, 0, "1,6Hwi,;ng,2,5,7"},
    {314, 0, "12.5,0.,100.,4Hblue"},
    {402, 1, "2,5,7"},
    {402, 7, "1,7"},
    {402, 9, "1,2,5,7,31"},
    {402, 15, "3,5,7,31"},
    {402, 3, "1,2,0,5,7"},
    {406, 15, "1,4Hname"},
    {406, 17, "2,2,2HMM"},
    {406, 3, "2,5,5Hlayer"},
    {406, 27, "3,1.5,,3Habc"},
    {408, 0, "25,1.,2.,3.,0.5"},
    {502, 1, "2,0.,0.,0.,1.,0.,0."},
    {504, 1, "2,5,15,1,15,2,7,15,2,15,1"},
    {508, 1, "2,0,17,1,1,2,1,31,0,31,1,15,2,0,0"},
    {510, 1, "9,2,1,19,17"},
    {514, 1, "2,21,1,21,0"},
};

std::string named(const Sample& sample) { return fmt::format("{}:{} {}", sample.type, sample.form, sample.text); }

}  // namespace

BOOST_AUTO_TEST_CASE(every_typed_record_goes_back_with_the_text_it_came_with) {
  for (const Sample& sample : samples) {
    const Decoded decoded = decode(sample.type, sample.form, sample.text);
    BOOST_TEST_CONTEXT(named(sample)) {
      BOOST_TEST(!decoded.record.is_raw());
      BOOST_TEST(joined(decoded.written()) == sample.text);
    }
  }
}

// An exchange of two fields in `read` and in `write` alike would not show above: it shows in the struct.
BOOST_AUTO_TEST_CASE(fields_arrive_where_their_names_say) {
  using namespace iges;
  const Decoded arc = decode(100, 0, "0.5,1.,2.,3.,2.,1.,4.");
  BOOST_TEST(arc.as<CircularArc>().zt == 0.5);
  BOOST_TEST(arc.as<CircularArc>().yc == 2);
  BOOST_TEST(arc.as<CircularArc>().ye == 4);
  const Decoded on_surface = decode(142, 0, "1,9,31,5,3");
  BOOST_TEST(on_surface.as<CurveOnSurface>().surface.de == stock::surface);
  BOOST_TEST(on_surface.as<CurveOnSurface>().pcurve.de == stock::pcurve);
  BOOST_TEST(on_surface.as<CurveOnSurface>().curve.de == stock::line);
  const Decoded trimmed = decode(144, 0, "9,1,1,11,11");
  BOOST_TEST(trimmed.as<TrimmedSurface>().outer_given);
  BOOST_TEST(trimmed.as<TrimmedSurface>().outer.de == stock::curve_on_surface);
  BOOST_TEST(trimmed.as<TrimmedSurface>().inner.size() == 1u);
  const Decoded offset = decode(130, 0, "7,2,0,0,1,2.,0.25,3.,0.75,0.,0.,1.,0.125,1.");
  BOOST_TEST(offset.as<OffsetCurve>().td1 == 0.25);
  BOOST_TEST(offset.as<OffsetCurve>().d2 == 3);
  BOOST_TEST(offset.as<OffsetCurve>().normal.z == 1);
  BOOST_TEST(offset.as<OffsetCurve>().tt1 == 0.125);
  const Decoded loop = decode(508, 1, "2,0,17,1,0,1,1,31,1,15,2,1,0");
  BOOST_REQUIRE(loop.as<LoopRecord>().items.size() == 2);
  BOOST_TEST(!loop.as<LoopRecord>().items[0].agrees);
  BOOST_TEST(loop.as<LoopRecord>().items[0].pcurves[0].isoparametric);
  BOOST_TEST(loop.as<LoopRecord>().items[1].is_vertex);
  BOOST_TEST(loop.as<LoopRecord>().items[1].index == 2);
  const Decoded cone = decode(194, 1, "1,3,2.5,30.,3");
  BOOST_TEST(cone.as<ConicalSurface>().half_angle_deg == 30);
  BOOST_TEST(cone.as<ConicalSurface>().reference.de == stock::direction);
  const Decoded sphere = decode(196, 1, "1,2.5,3,3");
  BOOST_TEST(sphere.as<SphericalSurface>().radius == 2.5);
  const Decoded name = decode(406, 15, "1,4Hname");
  BOOST_TEST(name.as<Property>().name == "name");
  const Decoded parent = decode(402, 9, "1,2,5,7,31");
  BOOST_TEST(parent.as<Associativity>().parent.de == stock::line);
  BOOST_TEST(parent.as<Associativity>().members.size() == 2u);
}

// The three orders that implementers get wrong: u0 u1 v0 v1, poles with u fastest, patches row by row.
BOOST_AUTO_TEST_CASE(a_rational_surface_keeps_the_order_of_ranges_and_poles) {
  const Decoded decoded = decode(
      128, 0,
      "1,2,1,2,0,0,1,0,0,0.,0.,1.,1.,0.,0.,0.,2.,2.,2.,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,1.,1.,1.,1.,0.,2.,0.,"
      "1.,2.,0.,0.,0.5,0.25,1.75");
  const auto& surface = decoded.as<iges::RationalBSplineSurface>();
  BOOST_REQUIRE(surface.points.size() == 6);
  BOOST_TEST(surface.knots_u.size() == 4u);
  BOOST_TEST(surface.knots_v.size() == 6u);
  BOOST_TEST(surface.u1 == 0.5);
  BOOST_TEST(surface.v0 == 0.25);
  BOOST_TEST(surface.v1 == 1.75);
  BOOST_TEST(surface.points[1].x == 1);  // the second pole is the second in u
  BOOST_TEST(surface.points[2].y == 1);
}

namespace {

std::string spline_surface_text(int m, int n, int patches) {
  std::string text = fmt::format("3,1,{},{}", m, n);
  for (int i = 0; i <= m; ++i) text += fmt::format(",{}.", i);
  for (int i = 0; i <= n; ++i) text += fmt::format(",{}.", i);
  for (int i = 0; i < patches * 48; ++i) text += fmt::format(",{}.", i);
  return text;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_parametric_spline_surface_keeps_its_place_holders) {
  const std::string text = spline_surface_text(2, 1, 6);
  const Decoded decoded = decode(114, 0, text + ",0,1,27");
  const auto& surface = decoded.as<iges::ParametricSplineSurface>();
  BOOST_TEST(surface.coefficients.size() == 6u);
  BOOST_TEST(decoded.record.groups.properties.size() == 1u);
  BOOST_TEST(!decoded.has("IG-E114-04"));
  BOOST_TEST(joined(decoded.written()) == text + ",0,1,27");
}

BOOST_AUTO_TEST_CASE(place_holders_may_be_missing) {
  const std::string text = spline_surface_text(2, 1, 2);
  const Decoded decoded = decode(114, 0, text);
  BOOST_TEST(decoded.as<iges::ParametricSplineSurface>().coefficients.size() == 2u);
  BOOST_TEST(decoded.has("IG-E114-04"));
  BOOST_TEST(joined(decoded.written()) == text);
}

BOOST_AUTO_TEST_CASE(pointer_groups_follow_every_record) {
  for (const Sample& sample : samples)
    for (const char* groups : {",0,0", ",1,29,0", ",0,1,27", ",1,29,2,27,27", ",1,29"}) {
      if (sample.type == 402 && sample.form == 3) continue;  // kept as text: where its groups start is not known
      const Decoded decoded = decode(sample.type, sample.form, std::string(sample.text) + groups);
      BOOST_TEST_CONTEXT(named(sample) << " with " << groups) {
        const auto& read = decoded.record.groups;
        BOOST_TEST(!decoded.record.is_raw());
        BOOST_TEST(read.associativities.size() == (groups[1] == '1' ? 1u : 0u));
        BOOST_TEST((read.properties.size() > 0) == (std::string(groups).find("27") != std::string::npos));
        BOOST_TEST(joined(decoded.written()) == sample.text + std::string(groups));
      }
    }
}

namespace {

struct Ending {
  int type, form;
  const char* text;
};

}  // namespace

BOOST_AUTO_TEST_CASE(optional_ends_may_be_missing_with_and_without_pointer_groups) {
  const Ending endings[] = {
      {116, 0, "1.,2.,3."},
      {116, 0, "1.,2.,3.,"},
      {116, 0, "1.,2.,3.,0,1,27"},
      {116, 0, "1.,2.,3.,1,29,1,27"},
      {108, 0, "0.,0.,1.,5."},
      {108, 1, "0.,0.,1.,5.,7"},
      {108, 1, "0.,0.,1.,5.,7,1,29,1,27"},
      {108, 0, "0.,0.,1.,5.,0,0,1,27"},
      {118, 0, "5,7"},
      {118, 0, "5,7,1"},
      {142, 0, ",9,31,5,"},
      {142, 0, "0,9,31,5"},
      {130, 0, "7,1,,,,2.,,,,0.,0.,1.,0.,1."},
      {314, 0, "1.,2.,3."},
      {314, 0, "1.,2.,3.,"},
      {408, 0, "25,0.,0.,0."},
      {408, 0, "25,0.,0.,0.,,0,1,27"},
      {126, 0, "1,1,0,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1."},
      {126, 0, "1,1,0,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,1,29,1,27"},
      {126, 0, "1,1,0,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0,0"},
      {110, 0, "0.,0.,0.,1.,,"},
  };
  for (const Ending& ending : endings) {
    const Decoded decoded = decode(ending.type, ending.form, ending.text);
    BOOST_TEST_CONTEXT(ending.type << " " << ending.text) {
      BOOST_TEST(!decoded.record.is_raw());
      BOOST_TEST(joined(decoded.written()) == ending.text);
      const bool has_name = std::string(ending.text).find("27") != std::string::npos;
      BOOST_TEST(decoded.record.groups.properties.size() == (has_name ? 1u : 0u));
    }
  }
}

BOOST_AUTO_TEST_CASE(other_spellings_of_a_value_come_back_as_they_were) {
  const Ending spellings[] = {
      {126, 0, "1.,1,2,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,0.,0."},  // a real for K, PROP1 = 2
      {314, 0, "0.,0.,0.,0H"},
      {314, 0, "0.,0.,0.,red"},
      {110, 0, "0.,0.,0.,1.,0.,0.,0,0,,"},
      {110, 0, "0.,0.,0.,1.,0.,0.,0,0,7,8"},
      {110, 0, "0.,0.,0.,1.,0.,0.,5,27"},
      {110, 0, "0.,0.,0.,1.,0.,0.,0,9,27"},
      {110, 0, "0.,0.,0.,1.,0.,0.,-1"},
      {110, 0, "0.,0.,0.,1.,0.,0.,2,27,99999999999"},
      {110, 0, "0.,0.,0.,1.,0.,0.,1,1.5"},
      {110, 0, "0.,0.,0.,1.,0.,1.E-400"},
      {142, 0, "0,9,31,99999999999,2"},
  };
  for (const Ending& spelling : spellings) {
    const Decoded decoded = decode(spelling.type, spelling.form, spelling.text);
    BOOST_TEST_CONTEXT(spelling.type << " " << spelling.text) {
      BOOST_TEST(!decoded.record.is_raw());
      BOOST_TEST(joined(decoded.written()) == spelling.text);
    }
  }
}

BOOST_AUTO_TEST_CASE(an_edit_wins_over_the_spelling_of_the_file) {
  Decoded decoded = decode(116, 0, "1.,2.,");  // z empty, PTR left out
  auto* point = std::get_if<iges::PointRecord>(&decoded.record.body);
  BOOST_REQUIRE(point);
  point->point.z = 7;
  BOOST_TEST(joined(decoded.written()) == "1.,2.,7.");
  point->symbol = iges::Ref{25};
  BOOST_TEST(joined(decoded.written()) == "1.,2.,7.,25,0,0");
  decoded.record.groups.properties = {iges::Ref{27}};
  BOOST_TEST(joined(decoded.written()) == "1.,2.,7.,25,0,1,27");
}

BOOST_AUTO_TEST_CASE(other_types_and_bad_records_are_kept_as_text) {
  const Decoded note = decode(212, 0, "1,5,1.,2.,1,1.5,0.,0,0,0.,0.,0.,5Ha,b;c");
  BOOST_TEST(note.record.as<iges::TableRecord>() != nullptr);
  BOOST_TEST(joined(note.written()) == "1,5,1.,2.,1,1.5,0.,0,0,0.,0.,0.,5Ha,b;c");
  BOOST_TEST(note.report.items().empty());
  const Decoded own = decode(5203, 0, "1,5,1.,2.,1,1.5,0.,0,0,0.,0.,0.,5Ha,b;c");
  BOOST_TEST(own.record.is_raw());
  BOOST_TEST(joined(own.written()) == "1,5,1.,2.,1,1.5,0.,0,0,0.,0.,0.,5Ha,b;c");
  const Decoded bad = decode(110, 0, "0.,0.,NAN,1.,--2,3Habc");
  BOOST_TEST(bad.record.is_raw());
  BOOST_TEST(joined(bad.written()) == "0.,0.,NAN,1.,--2,3Habc");
}

BOOST_AUTO_TEST_CASE(there_is_a_sample_for_every_typed_record) {
  for (int type = 0; type < 600; ++type)
    if (iges::has_struct(type) && type != 114)
      BOOST_TEST(std::any_of(std::begin(samples), std::end(samples), [&](const Sample& s) { return s.type == type; }),
                 "no sample of type " << type);
}
