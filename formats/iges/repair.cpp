#include "formats/iges/repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/number.h"
#include "formats/iges/edit.h"
#include "formats/iges/records/any.h"
#include "formats/iges/repairs.h"
#include "formats/iges/rules.h"

namespace trimloop::iges {
namespace {

struct Row {
  const Rule* rule;
  void (*apply)(Repair&);
};

// Layout first: what stands on cards can only be repaired once the cards stand in the file.
constexpr Row table[] = {
    {&rules::leading_junk, remove_leading_text},
    {&rules::after_terminate, remove_text_behind},
    {&rules::merged_cards, separate_cards},
    {&rules::line_ending_mix, unify_line_ends},
    {&rules::card_length, pad_cards},
    {&rules::sequence_number, number_cards},
    {&rules::sequence_justify, number_cards},
    {&rules::start_missing, add_start},
    {&rules::terminate_missing, add_terminate},
    {&rules::terminate_counts, correct_counts},
    {&rules::pd_column65, clear_column_65},
    {&rules::pd_line_count, correct_card_count},
    {&rules::pd_back_pointer, correct_back_pointers},
    {&rules::global_field_count, complete_global},
    {&rules::single_precision, correct_global},
    {&rules::double_precision, correct_global},
    {&rules::units_name, correct_global},
    {&rules::weight_gradations, correct_global},
    {&rules::version_flag, correct_global},
    {&rules::drafting_flag, correct_global},
    {&rules::type_twice, correct_directory},
    {&rules::structure, correct_directory},
    {&rules::line_font, correct_directory},
    {&rules::status_format, correct_directory},
    {&rules::colour, correct_directory},
    {&rules::reserved, correct_directory},
    {&rules::pointer_sign, correct_directory},
    {&rules::letter_case, write_capitals},
    {&rules::e104::form_vs_coeffs, correct_form},
    {&rules::e108::form_vs_bound, correct_form},
    {&rules::e124::handedness, correct_form},
    {&rules::e190::form_vs_ref, correct_form},
    {&rules::e126::planar_flag, turn_flag},
    {&rules::e126::closed_flag, turn_flag},
    {&rules::e126::polynomial_flag, turn_flag},
    {&rules::e126::periodic_flag, turn_flag},
    {&rules::e128::flags, turn_flag},
    {&rules::e142::flags, correct_parameter},
    {&rules::e142::use_flag, correct_use_flag},
    {&rules::e144::flags, turn_flag},
    {&rules::e212::text_length, correct_parameter},
};

constexpr auto listed = [] {
  std::array<const Rule*, std::size(table)> out{};
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = table[i].rule;
  return out;
}();

struct Reading {
  Report report;
  File file;
  Reading(std::string bytes, const Limits& limits) : file(File::parse(std::move(bytes), limits, report)) {
    for (const DirectoryEntry& entry : file.directory())
      if (entry.usable) read_any(file, entry, limits, report);
  }
};

// Empty: better. Else what is worse.
std::string worse(const Reading& before, const Reading& after, const Rule& rule) {
  if (after.file.directory().size() != before.file.directory().size()) return "it would change the number of entities";
  for (const Rule* other : rules::all())
    if (other != &rule && after.report.count(other->id) > before.report.count(other->id))
      return fmt::format("it would make a finding of {}", other->id);
  if (after.report.count(rule.id) >= before.report.count(rule.id)) return "the finding would stay";
  return {};
}

bool has_findings(const Report& report, const Rule& rule, Severity least) {
  return std::any_of(report.items().begin(), report.items().end(),
                     [&](const Diagnostic& d) { return d.rule == &rule && d.severity >= least; });
}

}  // namespace

void Repair::replace(std::size_t offset, std::size_t length, std::string text, std::string entity) {
  const Location place = offset < file.bytes().size() ? file.locate(offset) : Location{};
  changes.push_back({&rule, std::move(entity), place.line, std::string(file.bytes().substr(offset, length)), text});
  patches_.replace(offset, length, std::move(text));
}

void Repair::columns(const Card& card, std::size_t from, std::string text, std::string entity) {
  if (!stands_in_file(card)) {
    refusal = "its cards do not stand in the file as 80 columns";
    return;
  }
  const std::size_t width = text.size();
  if (cards().columns(card, from, width) != text) replace(card.offset + from, width, std::move(text), std::move(entity));
}

std::size_t place_of(const std::vector<Card>& cards, std::size_t first, std::size_t columns, std::size_t position) {
  const std::size_t card = first + position / columns;
  if (card >= cards.size() || !stands_in_file(cards[card])) return std::string::npos;
  return cards[card].offset + position % columns;
}

void Repair::parameter(const DirectoryEntry& entry, std::size_t index, std::string text) {
  constexpr std::size_t data_columns = 64;
  Report ignored;
  const Parameters p = file.parameters(entry, ignored);
  if (index >= p.tokens.size() || p.tokens[index].kind == Token::Kind::Hollerith) return;
  const std::string_view old = p.tokens[index].text;
  const std::string name = fmt::format("D{}", entry.de);
  const auto first = static_cast<std::size_t>(old.data() - p.joined.data());
  const std::size_t place = place_of(cards().parameter.cards, p.first_card, data_columns, first);
  const bool one_card = !old.empty() && first / data_columns == (first + old.size() - 1) / data_columns;
  if (one_card && text.size() <= old.size() && place != std::string::npos) {
    text.insert(0, old.size() - text.size(), ' ');
    return replace(place, old.size(), std::move(text), name);
  }
  if (!edited_.empty()) return;
  auto edited = set_parameter(file, Ref{entry.de}, index, text);
  if (!edited) {
    refusal = edited.error().text;
    return;
  }
  edited_ = std::move(*edited);
  edit_ = {&rule, name, place == std::string::npos ? 0 : file.locate(place).line, std::string(old), std::move(text)};
}

std::string Repair::apply() {
  if (!patches_.empty()) return patches_.apply(file.bytes());
  changes.push_back(std::move(edit_));
  return std::move(edited_);
}

void Repair::count_card(std::size_t column, std::int64_t more) {
  if (cards().terminated) shift_field(patches_, cards(), cards().terminate, column, 7, more);
}

const DirectoryEntry* Repair::entry(const Diagnostic& d) const {
  const NumberText<std::int64_t> de = read_integer(d.entity.empty() ? std::string_view() : std::string_view(d.entity).substr(1));
  return de && de.value <= 9'999'999 ? file.find(Ref{static_cast<std::int32_t>(de.value)}) : nullptr;
}

std::span<const Rule* const> repairable_rules() { return listed; }

Repaired repair(std::string bytes, const std::function<bool(const Rule&)>& wanted, Severity least, const Limits& limits) {
  Repaired out;
  auto now = std::make_unique<Reading>(std::move(bytes), limits);
  for (const Row& row : table) {
    if (!wanted(*row.rule)) continue;
    // A thousand findings of a rule are stored, and a repair may show what it hid: until nothing is left to do.
    while (!now->report.has_fatal() && has_findings(now->report, *row.rule, least)) {
      Repair repair(now->file, now->report, *row.rule, least);
      row.apply(repair);
      std::string why = repair.empty() ? repair.refusal.empty() ? "nothing can be told from the file" : repair.refusal : "";
      if (why.empty()) {
        auto next = std::make_unique<Reading>(repair.apply(), limits);
        why = worse(*now, *next, *row.rule);
        if (why.empty()) now = std::move(next);
      }
      if (!why.empty()) {
        out.refused.emplace_back(row.rule, std::move(why));
        break;
      }
      out.changes.insert(out.changes.end(), std::make_move_iterator(repair.changes.begin()), std::make_move_iterator(repair.changes.end()));
    }
  }
  out.bytes = now->file.write();
  return out;
}

}  // namespace trimloop::iges
