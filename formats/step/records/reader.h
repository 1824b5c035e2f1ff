#pragma once
// Attributes of one record by entity and place, checked. A record is Record::read(Reader&); what is wrong becomes a
// finding, and ok() says whether the record can be used.

#include <optional>
#include <string>
#include <vector>

#include "formats/step/file.h"
#include "formats/step/tape.h"

namespace trimloop::step {

// A value whose kind the reader decides: a SELECT.
struct Select {
  enum class Kind : std::uint8_t { None, Reference, Number, Text, Word } kind = Kind::None;
  Ref ref;
  double number = 0;
  std::string text;   // of a string; or the word of an enumeration
  std::string type;   // keyword of a typed value: "PARAMETER_VALUE"
};

class Reader {
 public:
  Reader(const File& file, const Instance& instance, const Limits& limits, Tape& tape, Report& report);

  // Attributes are from now on those that entity `e` declares itself. False (SP-X04 unless `optional`) when the record
  // has none of its parts named so.
  bool at(Entity e, bool optional = false);
  bool is(Entity e) const { return file_.is(instance_, e); }
  int count() const { return static_cast<int>(starts_.size()) - first_; }  // attributes from the first one of `e` on

  // Attribute `i`, from 0. Missing or of the wrong kind: a finding, and ok() is false from then on.
  Ref ref(int i);
  Ref optional_ref(int i);                  // $ gives none
  std::vector<Ref> refs(int i);             // members that are not references are reported and left out
  double real(int i);
  std::optional<double> optional_real(int i);
  std::int64_t integer(int i);
  std::vector<double> reals(int i);
  std::vector<int> integers(int i);
  std::string text(int i);                  // $ gives nothing
  bool boolean(int i, bool otherwise);      // anything but .T. and .F. gives `otherwise`, reported unless .U. or $
  std::string word(int i);                  // of an enumeration
  Select select(int i);
  std::vector<Select> selects(int i);
  std::vector<std::vector<Ref>> ref_rows(int i);
  std::vector<std::vector<double>> real_rows(int i);
  std::vector<std::vector<int>> integer_rows(int i);
  bool is_set(int i) const;                 // neither $ nor * nor missing

  bool ok() const { return ok_; }
  Diagnostic& add(const Rule& rule, std::string text, int attribute = -1);
  void fail() { ok_ = false; }

 private:
  std::uint32_t token(int i) const;         // its index, typed values opened; none: tape_.size()
  bool wrong(int i, std::string_view wanted);
  std::string string_at(std::uint32_t token);
  Select select_at(std::uint32_t token);
  bool number_at(std::uint32_t token, double& out) const;
  std::uint32_t opened(std::uint32_t token) const;

  const File& file_;
  const Instance& instance_;
  Tape& tape_;
  Report& report_;
  bool ok_ = true;
  int first_ = 0;                           // first attribute of the entity in hand
  std::size_t part_ = 0;
  std::vector<std::uint32_t> starts_;       // tokens of the attributes of the part in hand
};

// Names and place of an instance put into a finding.
void place(Diagnostic& d, const File& file, const Instance& instance);
// The findings for what the tape met.
void report_faults(const File& file, const Instance& instance, const Tape& tape, Report& report);

}  // namespace trimloop::step
