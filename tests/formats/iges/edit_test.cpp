// Edits change what they say and no other byte.
#include "formats/iges/edit.h"

#include <boost/test/unit_test.hpp>

#include "base/number.h"
#include "formats/iges/records/any.h"
#include "tests/support/iges_text.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

iges::File parsed(std::string bytes) {
  Report report;
  return iges::File::parse(std::move(bytes), {}, report);
}

// Three lines and a note between them whose text runs over several cards.
IgesText sample() {
  IgesText file;
  file.add(110, "0.,0.,0.,1.,0.,0.");
  file.add(126, "1,1,1,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,1.25,1.5,1.75,0.,1.,0.,0.,1.");
  file.add(212, "1,80,80.,2.,1,1.5,0.,0,0,0.,0.,0.," + hollerith(std::string(80, 'x')));
  file.add({.type = 110, .parameters = "0.,0.,0.,2.,0.,0.", .comment = "a comment"});
  return file;
}

std::size_t differing(std::string_view a, std::string_view b) {
  std::size_t n = a.size() > b.size() ? a.size() - b.size() : b.size() - a.size();
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) n += a[i] != b[i];
  return n;
}

std::string token(const iges::File& file, int de, std::size_t index) {
  Report report;
  const auto parameters = file.parameters(*file.find(iges::Ref{de}), report);
  return index < parameters.tokens.size() ? std::string(parameters.tokens[index].text) : "?";
}

}  // namespace

BOOST_AUTO_TEST_SUITE(edit)

BOOST_AUTO_TEST_CASE(a_number_of_the_same_length_changes_its_own_bytes_only) {
  for (const char* line_end : {"\n", "\r\n", ""}) {
    const std::string bytes = sample().text(line_end);
    const auto changed = iges::set_parameter(parsed(bytes), iges::Ref{1}, 4, "7.");
    BOOST_REQUIRE_MESSAGE(changed, changed.error().text);
    BOOST_TEST(differing(bytes, *changed) == 1u);
    BOOST_TEST(token(parsed(*changed), 1, 4) == "7.");
  }
}

BOOST_AUTO_TEST_CASE(setting_what_is_there_changes_nothing) {
  const std::string bytes = sample().text();
  const iges::File file = parsed(bytes);
  for (const iges::DirectoryEntry& e : file.directory()) {
    Report report;
    const auto parameters = file.parameters(e, report);
    for (std::size_t i = 1; i < parameters.tokens.size(); ++i) {
      const iges::Token& t = parameters.tokens[i];
      const std::string text = t.kind == iges::Token::Kind::Hollerith ? hollerith(t.text) : std::string(t.text);
      const auto changed = iges::set_parameter(file, iges::Ref{e.de}, i, text);
      BOOST_REQUIRE(changed);
      BOOST_TEST(differing(bytes, *changed) == 0u, "D" << e.de << " parameter " << i);
    }
  }
}

BOOST_AUTO_TEST_CASE(text_that_needs_a_card_more_moves_counters_and_pointers) {
  const std::string bytes = sample().text();
  const iges::File before = parsed(bytes);
  const auto changed = iges::set_parameter(before, iges::Ref{1}, 4, "1.2345678901234567E-200");
  BOOST_REQUIRE(changed);
  const std::string long_text(50, '1');
  const auto longer = iges::set_parameter(before, iges::Ref{1}, 4, long_text);
  BOOST_REQUIRE(longer);
  BOOST_TEST(longer->size() == bytes.size() + 81);
  Report report;
  const iges::File after = iges::File::parse(*longer, {}, report);
  for (const Diagnostic& d : report.items()) BOOST_TEST((d.severity <= Severity::Info), d.text);
  BOOST_REQUIRE(after.directory().size() == before.directory().size());
  BOOST_TEST(after.directory()[0].parameter_count == before.directory()[0].parameter_count + 1);
  for (std::size_t i = 1; i < after.directory().size(); ++i) {
    BOOST_TEST(after.directory()[i].parameter_pointer == before.directory()[i].parameter_pointer + 1);
    Report r;
    BOOST_TEST(iges::write_any(iges::read_any(after, after.directory()[i], {}, r)) ==
               iges::write_any(iges::read_any(before, before.directory()[i], {}, r)));
  }
  BOOST_TEST(token(after, 1, 4) == long_text);
  BOOST_TEST(token(after, 1, 5) == "0.");
  // And back again: the card goes.
  const auto back = iges::set_parameter(after, iges::Ref{1}, 4, "1.");
  BOOST_REQUIRE(back);
  BOOST_TEST(token(parsed(*back), 1, 6) == "0.");
}

BOOST_AUTO_TEST_CASE(a_string_over_several_cards_can_change) {
  const iges::File file = parsed(sample().text());
  for (const std::size_t length : {1u, 60u, 79u, 81u, 200u}) {
    const auto changed = iges::set_parameter(file, iges::Ref{5}, 13, hollerith(std::string(length, 'y')));
    BOOST_REQUIRE(changed);
    Report report;
    const iges::File after = iges::File::parse(*changed, {}, report);
    for (const Diagnostic& d : report.items()) BOOST_TEST((d.severity <= Severity::Info), d.text);
    BOOST_TEST(token(after, 5, 13) == std::string(length, 'y'));
    BOOST_TEST(token(after, 7, 4) == "2.");
    Report r;
    BOOST_TEST(after.parameters(*after.find(iges::Ref{7}), r).comment == "a comment");
  }
}

BOOST_AUTO_TEST_CASE(what_cannot_be_set_is_refused) {
  const iges::File file = parsed(sample().text());
  BOOST_TEST(!iges::set_parameter(file, iges::Ref{1}, 0, "1.").has_value());
  BOOST_TEST(!iges::set_parameter(file, iges::Ref{1}, 99, "1.").has_value());
  BOOST_TEST(!iges::set_parameter(file, iges::Ref{99}, 1, "1.").has_value());
  BOOST_TEST(!iges::set_parameter(file, iges::Ref{1}, 1, "1.,2.").has_value());
  BOOST_TEST(!iges::set_parameter(file, iges::Ref{1}, 1, "1.\n").has_value());
  BOOST_TEST(iges::set_parameter(file, iges::Ref{5}, 13, "3Ha,b").has_value());
}

BOOST_AUTO_TEST_CASE(values_are_spelled_by_their_kind) {
  const iges::File file = parsed(sample().text());
  BOOST_TEST(iges::parameter_text(file, iges::Ref{1}, 1, "0.25").value() == "0.25");
  BOOST_TEST(iges::parameter_text(file, iges::Ref{1}, 1, "3").value() == "3.");
  BOOST_TEST(iges::parameter_text(file, iges::Ref{1}, 1, "1e-3").value() == iges_real(1e-3));
  BOOST_TEST(!iges::parameter_text(file, iges::Ref{1}, 1, "abc").has_value());
  BOOST_TEST(iges::parameter_text(file, iges::Ref{3}, 1, "2").value() == "2");
  BOOST_TEST(!iges::parameter_text(file, iges::Ref{3}, 1, "2.5").has_value());
  BOOST_TEST(iges::parameter_text(file, iges::Ref{5}, 13, "a,b").value() == "3Ha,b");
}

BOOST_AUTO_TEST_CASE(new_reals_keep_to_the_precision_that_the_file_declares) {
  IgesText text = sample();
  const auto with = [&](const char* precision) {
    const std::string usual = "32,38,6,308,15,";
    IgesText changed = text;
    changed.global.replace(changed.global.find(usual), usual.size(), precision);
    return changed.text();
  };
  const char* third = "0.33333333333333331";
  const iges::File usual = parsed(with("32,38,6,308,15,")), full = parsed(with("32,38,6,308,17,")), poor = parsed(with("32,38,6,38,6,"));
  BOOST_TEST(iges::parameter_text(usual, iges::Ref{1}, 1, third).value() == "0.333333333333333");
  BOOST_TEST(read_real(iges::parameter_text(full, iges::Ref{1}, 1, third).value()).value == 1.0 / 3);
  BOOST_TEST(iges::parameter_text(poor, iges::Ref{1}, 1, third).value() == "0.333333");
  BOOST_TEST(iges::parameter_text(poor, iges::Ref{1}, 1, "0.25").value() == "0.25");
  BOOST_TEST(!iges::parameter_text(poor, iges::Ref{1}, 1, "1e39").has_value());
  BOOST_TEST(iges::parameter_text(usual, iges::Ref{1}, 1, "1e39").has_value());
}

BOOST_AUTO_TEST_CASE(an_entity_is_added_behind_all_others) {
  const std::string bytes = sample().text();
  iges::DirectoryEntry entry;
  entry.type = 116;
  const auto added = iges::add_entity(parsed(bytes), entry, {"1.", "2.", "3.", "0"});
  BOOST_REQUIRE_MESSAGE(added, added.error().text);
  BOOST_TEST(added->bytes.size() == bytes.size() + 3 * 81);
  Report report;
  const iges::File after = iges::File::parse(added->bytes, {}, report);
  for (const Diagnostic& d : report.items()) BOOST_TEST((d.severity <= Severity::Info), d.text);
  BOOST_REQUIRE(after.find(added->entity));
  BOOST_TEST(token(after, added->entity.de, 3) == "3.");
}

BOOST_AUTO_TEST_CASE(a_removed_entity_becomes_null) {
  IgesText text = sample();
  text.add(102, "2,{},{}", {}, {1, 3});
  const iges::File file = parsed(text.text());
  BOOST_TEST(!iges::remove_entity(file, iges::Ref{1}).has_value());  // the composite points to it
  BOOST_TEST(iges::pointing_at(file, iges::Ref{1}).size() == 1u);
  const auto removed = iges::remove_entity(file, iges::Ref{5});
  BOOST_REQUIRE_MESSAGE(removed, removed.error().text);
  Report report;
  const iges::File after = iges::File::parse(*removed, {}, report);
  BOOST_REQUIRE(after.directory().size() == file.directory().size());
  BOOST_TEST(after.find(iges::Ref{5})->type == 0);
  BOOST_TEST(after.find(iges::Ref{5})->parameter_count == 1);
  BOOST_TEST(token(after, 7, 4) == "2.");
}

BOOST_AUTO_TEST_SUITE_END()
