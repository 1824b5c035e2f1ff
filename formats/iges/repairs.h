#pragma once
// What the single repairs share (repair_*.cpp); the table of them is in repair.cpp.

#include <string>

#include "formats/iges/patches.h"
#include "formats/iges/repair.h"

namespace trimloop::iges {

// One rule at work on one reading of a file.
class Repair {
 public:
  Repair(const File& f, const Report& findings, const Rule& r, Severity s) : file(f), report(findings), rule(r), least(s) {}

  const File& file;
  const Report& report;
  const Rule& rule;
  Severity least;
  std::vector<Change> changes;
  std::string refusal;  // why nothing could be done

  const Cards& cards() const { return file.cards(); }
  void replace(std::size_t offset, std::size_t length, std::string text, std::string entity = {});
  void columns(const Card& card, std::size_t from, std::string text, std::string entity = {});  // nothing where they hold it already
  // A parameter of a record: in its place where the text is no longer than the old one; else by an edit that moves cards,
  // one for each reading.
  void parameter(const DirectoryEntry& entry, std::size_t index, std::string text);
  void count_card(std::size_t column, std::int64_t more);  // of the Terminate card
  bool empty() const { return patches_.empty() && edited_.empty(); }
  std::string apply();

  // The findings of this rule that are to be repaired.
  template <class Each>
  void findings(Each each) {
    for (const Diagnostic& d : report.items())
      if (d.rule == &rule && d.severity >= least) each(d);
  }
  const DirectoryEntry* entry(const Diagnostic& d) const;

 private:
  Patches patches_;
  std::string edited_;  // the whole file after an edit; counts only while there are no patches
  Change edit_;
};

// Where a column of the joined text of some cards stands in the file; npos where it does not.
std::size_t place_of(const std::vector<Card>& cards, std::size_t first, std::size_t columns, std::size_t position);

// Cards (IG-F..), their pointers back (IG-D06, IG-D07)
void remove_leading_text(Repair&);
void remove_text_behind(Repair&);
void unify_line_ends(Repair&);
void separate_cards(Repair&);
void pad_cards(Repair&);
void number_cards(Repair&);
void add_terminate(Repair&);
void correct_counts(Repair&);
void add_start(Repair&);
void clear_column_65(Repair&);
void correct_card_count(Repair&);
void correct_back_pointers(Repair&);
// Fields of the Global section (IG-G..) and of the Directory (IG-D..)
void complete_global(Repair&);
void correct_global(Repair&);
void correct_directory(Repair&);
// Records (IG-E.., IG-P..)
void turn_flag(Repair&);
void correct_form(Repair&);
void correct_parameter(Repair&);
void correct_use_flag(Repair&);
void write_capitals(Repair&);

}  // namespace trimloop::iges
