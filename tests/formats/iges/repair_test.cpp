// Repairs: each finding goes, no other comes, nothing else changes, and a second run has nothing to do.

#include <boost/test/unit_test.hpp>
#include <functional>
#include <map>
#include <set>

#include "formats/iges/records/any.h"
#include "formats/iges/repair.h"
#include "formats/iges/rules.h"
#include "tests/support/corpus.h"
#include "tests/support/iges_text.h"

using namespace trimloop;
using namespace trimloop::iges;
using namespace trimloop::test;

namespace {

// Two lines (1, 3), a matrix (5), a 126 (7) and a name (9).
IgesText sample() {
  IgesText text;
  for (int i = 0; i < 2; ++i) text.add(110, std::to_string(i) + ".,0.,0.,1.,1.,1.");
  text.add(124, "1.,0.,0.,5.,0.,1.,0.,6.,0.,0.,1.,7.");
  text.add(126, "1,1,1,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,8.,0.,0.,0.,1.,0.,0.,1.");
  text.add(406, "1,4Hname", {.form = 15});
  return text;
}

std::size_t index_of(char section, const std::vector<std::string>& cards) {
  std::size_t i = 0;
  while (cards[i].size() < 73 || cards[i][72] != section) ++i;
  return i;
}

struct Damage {
  const char* rule;
  std::function<void(std::vector<std::string>&)> change;  // cards of 80 columns
  std::function<void(std::string&)> change_text = {};
  std::string_view global_from = {}, global_to = {};
};

// The sample with this damage. Without trailing blanks where cards shall be short.
std::string damaged(const Damage& d) {
  IgesText file = sample();
  if (!d.global_from.empty()) file.global.replace(file.global.find(d.global_from), d.global_from.size(), d.global_to);
  std::vector<std::string> cards = file.cards();
  if (d.change) d.change(cards);
  std::string text;
  for (const std::string& card : cards) (text += std::string_view(d.rule) == "IG-F03" ? card.substr(0, card.find_last_not_of(' ') + 1) : card) += '\n';
  if (d.change_text) d.change_text(text);
  return text;
}

void set_field(std::vector<std::string>& cards, int de, int field, std::string_view value) {
  std::string& card = cards[index_of('D', cards) + static_cast<std::size_t>(de - 1 + (field > 10))];
  std::string text(8 - value.size(), ' ');
  text += value;
  card.replace(static_cast<std::size_t>((field - 1) % 10) * 8, 8, text);
}
void set_record(std::vector<std::string>& cards, std::string_view from, std::string_view to) {
  for (std::string& card : cards)
    if (card[72] == 'P')
      if (const std::size_t at = card.find(from); at != std::string::npos) {
        card.replace(at, from.size(), to);
        const std::size_t more = to.size() - from.size();
        for (std::size_t i = 0; i < more; ++i) card.erase(card.find("  "), 1);
        return;
      }
}

std::vector<Damage> damages() {
  return {
      {"IG-F11", {}, [](std::string& t) { t.insert(0, std::string_view("From: somebody\n\n")); }},
      {"IG-F12", {}, [](std::string& t) { t += "rubbish behind\n"; }},
      {"IG-F21", {}, [](std::string& t) { for (int i = 0; i < 3; ++i) t.erase(t.find('\n', 400), 1); }},
      {"IG-F08", {}, [](std::string& t) { t.insert(t.begin() + static_cast<std::ptrdiff_t>(t.find('\n', 300)), '\r'); }},
      {"IG-F03", [](auto& cards) { std::string& c = cards[index_of('D', cards)]; c.resize(73); c += '1'; }},
      {"IG-F06", [](auto& cards) { for (auto& c : cards) if (c[72] == 'P') c.replace(73, 7, "      1"); }},
      {"IG-F07", [](auto& cards) { for (auto& c : cards) if (c[72] == 'P') std::fill(c.begin() + 73, c.begin() + 79, '0'); }},
      {"IG-F19", [](auto& cards) { cards.erase(cards.begin()); cards.back().replace(0, 8, "S      0"); }},
      {"IG-F13", [](auto& cards) { cards.pop_back(); }},
      {"IG-F14", [](auto& cards) { cards.back().replace(25, 7, "     77"); }},
      {"IG-F22", [](auto& cards) { std::string& c = cards[index_of('P', cards)]; c.replace(64, 8, "1       "); }},
      {"IG-D06", [](auto& cards) { set_field(cards, 1, 14, "7"); }},
      {"IG-D07", [](auto& cards) { cards[index_of('P', cards) + 1].replace(64, 8, "        "); }},
      {"IG-G05", {}, {}, ",6Hauthor,3Horg,11,0,15H20260101.000000,", ""},
      {"IG-G10", {}, {}, ",32,38,6,", ",32,38,0,"},
      {"IG-G11", {}, {}, ",308,15,", ",0,-1,"},
      {"IG-G16", {}, {}, "2HMM", "4HINCH"},
      {"IG-G18", {}, {}, "2HMM,1,", "2HMM,0,"},
      {"IG-G26", {}, {}, "3Horg,11,", "3Horg,99,"},
      {"IG-G28", {}, {}, "11,0,15H", "11,9,15H"},
      {"IG-D01", [](auto& cards) { set_field(cards, 1, 11, "116"); }},
      {"IG-D11", [](auto& cards) { set_field(cards, 1, 3, "4"); }},
      {"IG-D12", [](auto& cards) { set_field(cards, 1, 4, "77"); }},
      {"IG-D17", [](auto& cards) { set_field(cards, 1, 9, "0000000x"); }},
      {"IG-D25", [](auto& cards) { set_field(cards, 1, 13, "12"); }},
      {"IG-D26", [](auto& cards) { set_field(cards, 1, 16, "junk"); }},
      {"IG-D32", [](auto& cards) { set_field(cards, 1, 7, "-5"); }},
      {"IG-P20", [](auto& cards) { set_record(cards, "1.,0.,0.,5.", "1.e0,0.,0.,5."); }},
      {"IG-P20", [](auto& cards) { set_record(cards, "4Hname", "4hname"); }},
      {"IG-E124-03", [](auto& cards) { set_field(cards, 5, 15, "1"); }},
      {"IG-E126-11", [](auto& cards) { set_record(cards, "126,1,1,1,0,", "126,1,1,1,1,"); }},
      {"IG-E126-13", [](auto& cards) { set_record(cards, "126,1,1,1,0,1,0,", "126,1,1,1,0,1,1,"); }},
  };
}

std::map<std::string_view, std::size_t> findings(const std::string& bytes) {
  Report report;
  const File file = File::parse(bytes, {}, report);
  for (const DirectoryEntry& e : file.directory())
    if (e.usable) read_any(file, e, Limits{}, report);
  std::map<std::string_view, std::size_t> out;
  for (const Diagnostic& d : report.items()) ++out[d.rule->id];
  return out;
}

Repaired all(const std::string& bytes) {
  return repair(bytes, [](const Rule&) { return true; }, Severity::Info, {});
}

}  // namespace

BOOST_AUTO_TEST_CASE(each_repair_takes_its_finding_away_and_nothing_else) {
  const std::string good = sample().text();
  BOOST_TEST(findings(good).empty());
  std::set<std::string_view> seen;
  for (const Damage& d : damages()) {
    const std::string text = damaged(d);
    BOOST_TEST_CONTEXT(d.rule) {
      BOOST_TEST(findings(text)[d.rule] >= 1u);
      const Repaired selected = repair(text, [&](const Rule& r) { return r.id == d.rule; }, Severity::Hint, {});
      BOOST_TEST(findings(selected.bytes)[d.rule] == 0u);
      for (const auto& [rule, why] : selected.refused) BOOST_ERROR(rule->id << " refused: " << why);
      BOOST_TEST(!selected.changes.empty());
      const Repaired everything = all(text);
      BOOST_TEST(all(everything.bytes).changes.empty());
      for (const auto& [id, n] : findings(everything.bytes)) BOOST_TEST_MESSAGE(d.rule << " leaves " << id);
    }
    seen.insert(d.rule);
  }
  BOOST_TEST_MESSAGE(seen.size() << " rules of " << repairable_rules().size());
}

// The repair of the counters, columns and pointers gives the very bytes that were damaged.
BOOST_AUTO_TEST_CASE(structure_comes_back_byte_for_byte) {
  const std::string good = sample().text();
  for (const Damage& d : damages()) {
    const std::string_view family = std::string_view(d.rule).substr(0, 4);
    if ((family != "IG-F" && family != "IG-D") || std::string_view(d.rule) == "IG-F19") continue;
    const std::string text = damaged(d);
    const std::string repaired = all(text).bytes;
    if (d.rule == std::string_view("IG-D32")) continue;  // the sample has no matrix there to begin with
    BOOST_TEST((repaired == good), d.rule << " at byte " << (std::mismatch(repaired.begin(), repaired.end(), good.begin(), good.end()).first - repaired.begin()));
  }
}

BOOST_AUTO_TEST_CASE(what_may_change_the_meaning_is_refused) {
  // Numbers with a gap are believed: pointers go by them.
  auto cards = sample().cards();
  const std::size_t first = index_of('P', cards);
  cards.erase(cards.begin() + static_cast<std::ptrdiff_t>(first));
  const Repaired gap = repair(join_cards(cards), [](const Rule& r) { return r.id == "IG-F06"; }, Severity::Hint, {});
  BOOST_TEST(gap.changes.empty());
  BOOST_REQUIRE(gap.refused.size() == 1u);
  BOOST_TEST((gap.bytes == join_cards(cards)));
  // A second file behind the first is not rubbish.
  const std::string two = sample().text() + sample().text();
  BOOST_TEST((all(two).bytes == two));
}

BOOST_AUTO_TEST_CASE(remedies_promise_repairs_where_there_are_some) {
  const auto repairable = repairable_rules();
  for (const Rule* rule : rules::all()) {
    const bool able = std::find(repairable.begin(), repairable.end(), rule) != repairable.end();
    const std::string_view text = rule->remedy;
    const bool promised = text.find("`trimloop fix`") != std::string_view::npos;
    BOOST_TEST(able == promised, rule->id << ": " << text);
    BOOST_TEST(text.find("fix --all") == std::string_view::npos, rule->id);
  }
}

BOOST_AUTO_TEST_CASE(public_files_keep_their_records) {
  const auto files = corpus_files("iges");
  std::size_t repaired = 0, changes = 0, before = 0, after = 0;
  for (const auto& path : files) {
    if (std::filesystem::file_size(path) > 100'000) continue;
    const std::string bytes = read_file(path);
    Report report;
    const File old = File::parse(bytes, {}, report);
    if (report.has_fatal()) continue;
    const Repaired r = all(bytes);
    ++repaired;
    changes += r.changes.size();
    for (const auto& [id, n] : findings(bytes)) before += n;
    for (const auto& [id, n] : findings(r.bytes)) after += n;
    if (r.changes.empty()) BOOST_TEST((r.bytes == bytes), path.string());
    Report again;
    const File now = File::parse(r.bytes, {}, again);
    BOOST_REQUIRE(now.directory().size() == old.directory().size());
    for (std::size_t i = 0; i < old.directory().size(); ++i) {
      const Parameters a = old.parameters(old.directory()[i], report), b = now.parameters(now.directory()[i], again);
      BOOST_TEST_REQUIRE(a.tokens.size() == b.tokens.size(), path.string());
      BOOST_TEST(old.directory()[i].type == now.directory()[i].type);
      BOOST_TEST(old.directory()[i].transform == now.directory()[i].transform);
    }
  }
  BOOST_TEST(after <= before);
  BOOST_TEST_MESSAGE(repaired << " public files: " << changes << " changes, findings " << before << " -> " << after);
}
