// The layout table: every row decodes, encodes, names and documents its records.
#include <boost/test/unit_test.hpp>
#include <fstream>
#include <iterator>
#include <map>

#include "formats/iges/names.h"
#include "tests/formats/iges/records/decode.h"
#include "tests/support/paths.h"

using namespace trimloop;
using namespace trimloop::test;

namespace {

// A record as a layout asks for it: lists of two, plausible values, all defaults written out.
class Sample {
 public:
  explicit Sample(const iges::Layout& layout) : layout_(layout) { nodes(layout.nodes); }
  const std::vector<std::string>& tokens() const { return tokens_; }

 private:
  void nodes(const std::vector<iges::LayoutNode>& list) {
    for (const iges::LayoutNode& node : list) {
      using Kind = iges::LayoutNode::Kind;
      if (node.kind == Kind::Field) field(node);
      if (node.kind == Kind::Choice && integers_[node.name] == node.equals) nodes(node.inside);
      if (node.kind == Kind::List)
        for (std::int64_t i = count(node); i > 0; --i) nodes(node.inside);
      if (node.kind == Kind::Values) {
        const std::size_t head = tokens_.size();
        nodes(node.inside);
        if (tokens_.size() == head) tokens_.push_back("9");
        tokens_[0] = std::to_string(tokens_.size() - head);  // NP
      }
    }
  }
  std::int64_t count(const iges::LayoutNode& node) {
    std::int64_t sum = 0;
    for (const iges::LayoutTerm& t : node.count) sum += t.name.empty() ? t.number : integers_[t.name];
    return sum;
  }
  void field(const iges::LayoutNode& node) {
    const bool property = layout_.type == 406;
    switch (node.type) {
      case 'r': tokens_.push_back(std::to_string(++reals_) + ".5"); break;
      case 'n': tokens_.push_back(std::to_string(integers_[node.name] = layout_.type == 180 ? 3 : 2)); break;
      case 'i': tokens_.push_back(std::to_string(integers_[node.name] = node.name == "NV" || node.name == "NP" ? 2 : 1)); break;
      case 'l': tokens_.push_back("1"); break;
      case 's': tokens_.push_back(layout_.type == 212 || layout_.type == 213 ? "1Ha" : "3Ha,b"); break;
      case 'p': tokens_.push_back(std::to_string(stock::point)); break;
      case 'P': tokens_.push_back(layout_.type != 180 ? "1" : ++operands_ < 3 ? "-1" : "1"); break;
      default: tokens_.push_back(property ? "3Habc" : "7"); break;
    }
  }

  const iges::Layout& layout_;
  std::vector<std::string> tokens_;
  std::map<std::string_view, std::int64_t> integers_;
  int reals_ = 0, operands_ = 0;
};

bool has_struct_of_its_own(const iges::Layout& row) {
  return iges::has_struct(row.type) && !(row.type == 402 && !iges::Associativity::has_members(row.first_form));
}

std::string forms(const iges::Layout& row) {
  if (row.type == 0) return "any";
  if (row.first_form == row.last_form) return std::to_string(row.first_form);
  return std::to_string(row.first_form) + " to " + std::to_string(row.last_form);
}

std::string page() {
  std::string out =
      "# IGES 5.3 entities\n\nWritten from the table in `formats/iges/records/layouts.cpp` (`test_formats_iges_records` "
      "compares). A row says what\nstands in the parameter data: `NAME:kind`, with `=default` where a field may be left "
      "out. Kinds: r real, i integer, n count,\nl logical, s string, p pointer, P integer or negated pointer, t any. "
      "`N*(...)` is a list of N groups, `NP*[...]` a list of NP single\nvalues, `IP=1?(...)` is there only when IP is 1. "
      "Two groups of pointers (associativities, properties) may follow every record.\nRecord: `struct` has a type of its "
      "own in `formats/iges/records`, `table` is a `TableRecord`. 306 (macro text), 402 and 228 forms 5001\nto 9999 "
      "without a definition and types that are not listed keep their text.\n\n| type | forms | name | record | parameters "
      "|\n|---|---|---|---|---|\n";
  for (const iges::Layout& row : iges::layouts())
    out += "| " + std::to_string(row.type) + " | " + forms(row) + " | " + std::string(row.name) + " | " +
           (has_struct_of_its_own(row) ? "struct" : row.type == 0 ? "text" : "table") + " | " +
           (row.text.empty() ? "" : "`" + std::string(row.text) + "`") + " |\n";
  return out;
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_row_of_the_table_decodes_and_encodes) {
  for (const iges::Layout& row : iges::layouts()) {
    if (row.type == 0 || row.type == 422 || has_struct_of_its_own(row)) continue;
    BOOST_TEST_CONTEXT(row.type << ":" << row.first_form << " " << row.text) {
      std::vector<std::string> tokens = Sample(row).tokens();
      if (row.type == 152) tokens[3] = "0.5";                          // LTX < LX
      if (row.type == 156 || row.type == 160) std::swap(tokens[row.type == 156 ? 1 : 0], tokens[row.type == 156 ? 2 : 1]);
      if (row.type == 162) tokens[1] = "0.5";
      const std::size_t own = tokens.size();
      for (const char* group : {"1", "29", "1", "27"}) tokens.push_back(group);
      const Decoded decoded = decode(row.type, row.first_form, joined(tokens));
      const auto* record = decoded.record.as<iges::TableRecord>();
      BOOST_REQUIRE_MESSAGE(record, (decoded.report.items().empty() ? "no finding" : decoded.report.items()[0].text));
      BOOST_TEST(record->values.size() == own);
      BOOST_TEST(joined(decoded.written()) == joined(tokens));
      BOOST_TEST((decoded.record.groups.associativities == std::vector<iges::Ref>{iges::Ref{29}}));
      BOOST_TEST((decoded.record.groups.properties == std::vector<iges::Ref>{iges::Ref{27}}));
      for (std::size_t i = 1; i <= own; ++i)
        BOOST_TEST(iges::parameter_name(row.type, row.first_form, i, decoded.parameters) != "", "parameter " << i);
      BOOST_TEST(iges::parameter_name(row.type, row.first_form, own + 1, decoded.parameters) == "");
      const std::vector<std::string> names = iges::parameter_names(row.type, row.first_form, decoded.parameters);
      BOOST_REQUIRE(names.size() == own);
      for (std::size_t i = 1; i <= own; ++i)
        BOOST_TEST(names[i - 1] == iges::parameter_name(row.type, row.first_form, i, decoded.parameters));
    }
  }
}

BOOST_AUTO_TEST_CASE(values_are_found_by_the_standards_names) {
  const Decoded note = decode(212, 0, "2,1,1.,2.,1,1.5,0.,0,0,3.,4.,5.,1Ha,2,1.,2.,1,1.5,0.,0,0,6.,7.,8.,2Hbc");
  const auto& r = note.as<iges::TableRecord>();
  BOOST_TEST(r.count("NS") == 2u);
  BOOST_TEST(r.string("TEXT", {2}) == "bc");
  BOOST_TEST(r.xyz("XS", "YS", "ZS", {1}).y == 4);
  BOOST_TEST(r.real("XS", {3}) == 0);  // not there
  BOOST_TEST(r.real("NONE") == 0);
  const Decoded table = decode(310, 0, "1,4Hfont,0,10,2,65,1,0,1,0,2,3,66,1,0,2,1,4,5,0,6,7");
  const auto& font = table.as<iges::TableRecord>();
  BOOST_TEST(font.integer("AC", {2}) == 66);
  BOOST_TEST(font.integer("X", {2, 2}) == 6);
  BOOST_TEST(font.integer("Y", {1, 1}) == 3);
}

BOOST_AUTO_TEST_CASE(defaults_may_be_left_out_before_the_pointer_groups) {
  const Decoded block = decode(150, 0, "1.,2.,3.,0,1,27");
  const auto& r = block.as<iges::TableRecord>();
  BOOST_TEST(r.real("I1") == 1);
  BOOST_TEST(r.real("K2") == 1);
  BOOST_TEST(block.record.groups.properties.size() == 1u);
  BOOST_TEST(joined(block.written()) == "1.,2.,3.,0,1,27");
  const Decoded array = decode(412, 0, "25,,0.,0.,0.,3,2,1.,1.,0.");
  BOOST_TEST(array.as<iges::TableRecord>().real("S") == 1);
  BOOST_TEST(joined(array.written()) == "25,,0.,0.,0.,3,2,1.,1.,0.");
}

BOOST_AUTO_TEST_CASE(counts_that_lie_make_a_record_unusable_at_once) {
  for (const char* text : {"2147483647,1,1.", "-1", "99999999999999999999"})
    for (int type : {138, 146, 148, 180, 184, 212, 213, 228, 302, 310, 316, 322, 404}) {
      const Decoded decoded = decode(type, 0, text);
      BOOST_TEST(!decoded.report.items().empty(), type);
    }
  const Decoded property = decode(406, 27, "3,1Ha,1000000000000,1");
  BOOST_TEST(property.report.items().size() < 10u);
}

BOOST_AUTO_TEST_CASE(the_page_of_entities_is_current) {
  const auto path = source_dir() / "docs/iges-entities.md";
  std::ifstream stream(path, std::ios::binary);
  const std::string written{std::istreambuf_iterator<char>(stream), {}};
  const std::string wanted = page();
  BOOST_TEST((written == wanted));
  if (written == wanted) return;
  const auto fresh = binary_dir() / "iges-entities.md";
  std::ofstream(fresh, std::ios::binary) << wanted;
  BOOST_ERROR("docs/iges-entities.md is not what the table says; copy " << fresh.string() << " there");
}

BOOST_AUTO_TEST_CASE(attribute_tables_take_their_counts_from_their_definition) {
  IgesText text;
  const int definition = text.add(322, "4Hattr,1,2,10,1,2,11,3,1");
  text.add(422, "1,2,4Hname,0,0");
  text.add(422, "2,1,2,3Hone,3,4,3Htwo,0,0", {.form = 1});
  text.add(422, "1,2,4Hname,0,0");  // without a definition
  std::string bytes = text.text();
  // Field 3 (structure) of the first two instances; the composer has none.
  for (int entry : {3, 5}) {
    std::vector<std::string> cards = text.cards();
    for (std::size_t at = 0, card = 0; card < cards.size(); at += 81, ++card)
      if (cards[card][72] == 'D' && std::stoi(cards[card].substr(73)) == entry)
        bytes.replace(at + 16, 8, "      -" + std::to_string(definition));
  }
  Report report;
  const iges::File file = iges::File::parse(bytes, {}, report);
  const auto read = [&](std::size_t i) { return iges::read_any(file, file.directory()[i], {}, report); };
  const iges::AnyRecord one = read(1), rows = read(2), lost = read(3);
  BOOST_REQUIRE(one.as<iges::TableRecord>());
  BOOST_TEST(one.as<iges::TableRecord>()->values.size() == 3u);
  BOOST_REQUIRE(rows.as<iges::TableRecord>());
  BOOST_TEST(rows.as<iges::TableRecord>()->values.size() == 7u);
  BOOST_TEST(lost.is_raw());
  BOOST_TEST(report.count("IG-E322-01") == 1u);
}
