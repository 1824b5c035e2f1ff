// Which Parameter cards belong to which Directory entry. Two sources say so: the entry's pointer and count (fields 2
// and 14), and the back pointer in columns 66-72 of every card. Where they disagree, an entry takes the cards that name
// it back; cards that name nobody are taken by the pointer alone.

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "formats/iges/directory.h"
#include "formats/iges/rules.h"

namespace trimloop::iges {
namespace {

class Assigner {
 public:
  Assigner(const Cards& cards, const Global& global, Directory& directory, Report& report)
      : cards_(cards), section_(cards.parameter), global_(global), directory_(directory), report_(report) {}

  std::vector<CardRange> run() {
    ranges_.resize(directory_.entries.size());
    std::vector<std::size_t> doubtful;
    for (std::size_t i = 0; i < ranges_.size(); ++i)
      if (!take_named(i)) doubtful.push_back(i);
    if (!doubtful.empty()) {
      index_runs();
      for (std::size_t i : doubtful) recover(i);
    }
    if (may_overlap_) separate();
    for (std::size_t i = 0; i < ranges_.size(); ++i) check_first_token(i);
    find_orphans();
    return std::move(ranges_);
  }

 private:
  DirectoryEntry& entry(std::size_t i) { return directory_.entries[i]; }

  // Columns 66-72; 0 when they name nobody.
  int back_pointer(std::size_t card) const {
    return std::max(0, read_columns(cards_.columns(section_.cards[card], 65, 7)).value_or(0));
  }

  // First parameter of a card, which is an entity type when a record starts there; -1 when it is no integer.
  int first_token(std::size_t card) const {
    std::string_view data = cards_.columns(section_.cards[card], 0, 64);
    const char delimiters[] = {global_.parameter_delimiter, global_.record_delimiter};
    data = data.substr(0, data.find_first_of({delimiters, 2}));
    return data.find_first_not_of(' ') == std::string_view::npos ? -1 : read_columns(data).value_or(-1);
  }
  bool starts_record_of(std::size_t card, const DirectoryEntry& e) const { return first_token(card) == e.type; }

  std::size_t run_length(std::size_t first, int de) const {
    std::size_t end = first;
    while (end < section_.size() && back_pointer(end) == de) ++end;
    return end - first;
  }

  void set(std::size_t i, std::size_t first, std::size_t count) {
    ranges_[i] = {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count)};
  }

  // 1. The usual case: the pointer leads to a card that names the entry back. False when it does not.
  bool take_named(std::size_t i) {
    const DirectoryEntry& e = entry(i);
    if (e.type == 0 && e.parameter_pointer == 0) return true;  // a null entity without data
    const std::size_t first = section_.index_of(e.parameter_pointer);
    if (first >= section_.size() || back_pointer(first) != e.de) return false;
    if (first > 0 && back_pointer(first - 1) == e.de && !starts_record_of(first, e)) return false;  // into the middle
    take_run(i, first, run_length(first, e.de));
    return true;
  }

  void take_run(std::size_t i, std::size_t first, std::size_t length) {
    const DirectoryEntry& e = entry(i);
    const auto stated = static_cast<std::size_t>(std::max(0, e.parameter_count));
    // Some writers name the entry on its first card only: cards that name nobody go on with it, as far as it counts
    // them.
    std::size_t count = length;
    while (count < stated && first + count < section_.size() && back_pointer(first + count) == 0) ++count;
    set(i, first, count);
    if (count > length) {
      may_overlap_ = true;
      say(rules::pd_back_pointer, i, first + length,
          fmt::format("{} of its {} Parameter cards do not name it back", count - length, count));
    }
    if (stated != count || e.parameter_count < 0) say_count(i, count);
  }

  void say_count(std::size_t i, std::size_t real) {
    const DirectoryEntry& e = entry(i);
    Diagnostic& d = report_.add(rules::pd_line_count,
                                fmt::format("it states {} Parameter cards and has {}", e.parameter_count, real));
    d.location = {e.offset, 8};
    name(d, e, 14);
    d.measured = e.parameter_count;
    d.limit = static_cast<double>(real);
  }

  // 2. The others: by their own name on the cards, else by the pointer.
  void index_runs() {
    for (std::size_t card = 0; card < section_.size();) {
      const int de = back_pointer(card);
      const std::size_t length = std::max<std::size_t>(1, run_length(card, de));
      if (de > 0) runs_.push_back({de, static_cast<std::uint32_t>(card)});
      card += length;
    }
    std::sort(runs_.begin(), runs_.end(),
              [](const Run& a, const Run& b) { return a.de != b.de ? a.de < b.de : a.first < b.first; });
  }

  void recover(std::size_t i) {
    const DirectoryEntry& e = entry(i);
    const auto run = std::lower_bound(runs_.begin(), runs_.end(), e.de, [](const Run& r, int de) { return r.de < de; });
    const bool named = run != runs_.end() && run->de == e.de;
    const std::size_t pointed = section_.index_of(e.parameter_pointer);
    if (named && starts_record_of(run->first, e)) {
      say(rules::pd_pointer, i, run->first,
          fmt::format("its parameter pointer is {}; the cards that name it start at {} and are taken",
                      e.parameter_pointer, section_.number(run->first)));
      take_run(i, run->first, run_length(run->first, e.de));
    } else if (pointed < section_.size() && starts_record_of(pointed, e)) {
      say(rules::pd_back_pointer, i, pointed,
          fmt::format("Parameter card {} does not name it back; the pointer is believed", section_.number(pointed)));
      const auto stated = static_cast<std::size_t>(std::max(1, e.parameter_count));
      set(i, pointed, std::min(stated, section_.size() - pointed));
      may_overlap_ = true;
    } else {
      say(rules::pd_pointer, i, section_.size(),
          fmt::format("its parameter pointer is {}, which leads to no record of type {}", e.parameter_pointer, e.type));
      entry(i).usable = false;
    }
  }

  // 3. Ranges taken by pointer may run into others: whoever starts later ends what started before.
  void separate() {
    std::vector<std::uint32_t> order(ranges_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [this](std::uint32_t a, std::uint32_t b) {
      if (ranges_[a].first != ranges_[b].first) return ranges_[a].first < ranges_[b].first;
      return rank(a) != rank(b) ? rank(a) < rank(b) : a < b;
    });
    std::size_t before = ranges_.size();  // the last entry that holds cards
    for (std::uint32_t i : order) {
      if (ranges_[i].count == 0) continue;
      if (before < ranges_.size()) keep_apart(before, i);
      if (ranges_[i].count > 0) before = i;
    }
  }
  // Of two entries with the same first card, the one that the card names comes first.
  int rank(std::size_t i) const {
    const DirectoryEntry& e = directory_.entries[i];
    return ranges_[i].count > 0 && back_pointer(ranges_[i].first) == e.de ? 0 : 1;
  }

  void keep_apart(std::size_t earlier, std::size_t later) {
    CardRange &a = ranges_[earlier], &b = ranges_[later];
    if (b.first >= a.first + a.count) return;
    say(rules::pd_shared, later, b.first,
        fmt::format("its Parameter cards start within those of D{}", entry(earlier).de));
    if (a.first == b.first) {
      b.count = 0;
      entry(later).usable = false;
    } else {
      a.count = b.first - a.first;
      say_count(earlier, a.count);
    }
  }

  // 4. The first parameter repeats the type.
  void check_first_token(std::size_t i) {
    const CardRange range = ranges_[i];
    DirectoryEntry& e = entry(i);
    if (!e.usable || range.count == 0) return;
    const int token = first_token(range.first);
    if (token == e.type || e.type == 0) return;
    const auto& others = directory_.other_types;
    const auto other = std::lower_bound(others.begin(), others.end(), i,
                                        [](const Directory::OtherType& o, std::size_t at) { return o.entry < at; });
    if (other != others.end() && other->entry == i && other->type == token) {
      e.type = token;
      return;
    }
    say(rules::pd_first_token, i, range.first,
        token < 0 ? fmt::format("its Parameter data do not start with an entity type, but it is of type {}", e.type)
                  : fmt::format("its Parameter data are of type {}, but it is of type {}", token, e.type));
    e.usable = false;
  }

  // 5. Cards that nobody has.
  void find_orphans() {
    std::size_t owned = 0;
    for (const CardRange& range : ranges_) owned += range.count;
    if (owned >= section_.size()) return;
    std::vector<bool> taken(section_.size());
    for (const CardRange& range : ranges_) std::fill_n(taken.begin() + range.first, range.count, true);
    const auto first = static_cast<std::size_t>(std::find(taken.begin(), taken.end(), false) - taken.begin());
    Diagnostic& d = report_.add(rules::pd_orphan, fmt::format("{} Parameter cards belong to no entry, from card {} on",
                                                              section_.size() - owned, section_.number(first)));
    d.location = {section_.cards[first].offset, 80};
    d.measured = static_cast<double>(section_.size() - owned);
  }

  void say(const Rule& rule, std::size_t i, std::size_t card, std::string text) {
    Diagnostic& d = report_.add(rule, std::move(text));
    d.location = card < section_.size() ? Location{section_.cards[card].offset, 80} : Location{entry(i).offset + 8, 8};
    name(d, entry(i), card < section_.size() ? -1 : 2);
  }
  static void name(Diagnostic& d, const DirectoryEntry& e, int field) {
    d.entity = fmt::format("D{}", e.de);
    d.type = fmt::format("{}:{}", e.type, e.form);
    d.parameter = field;
  }

  struct Run {
    int de;
    std::uint32_t first;
  };

  const Cards& cards_;
  const Section& section_;
  const Global& global_;
  Directory& directory_;
  Report& report_;
  std::vector<CardRange> ranges_;
  std::vector<Run> runs_;  // by back pointer; only when an entry needs it
  bool may_overlap_ = false;
};

}  // namespace

std::vector<CardRange> assign_parameter_cards(const Cards& cards, const Global& global, Directory& directory,
                                              Report& report) {
  return Assigner(cards, global, directory, report).run();
}

}  // namespace trimloop::iges
