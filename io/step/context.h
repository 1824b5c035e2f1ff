#pragma once
// What every reader of the STEP import shares: the file, records read with findings, references resolved and checked,
// the guard against instances that are part of themselves, and units by representation context.

#include <memory>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/limits.h"
#include "base/report.h"
#include "formats/step/records/product.h"
#include "formats/step/records/reader.h"
#include "kernel/model/model.h"

namespace trimloop::io::step_import {

using step::Entity;
using step::Ref;
// An entry of the file's index; `Instance` alone is an occurrence in the model.
using Record = step::Instance;

// Units of one representation context.
struct Units {
  double mm = 1;                   // of one length unit
  double rad = 1;                  // of one plane angle unit
  double uncertainty_mm = 1e-3;    // as stated where that can be believed, else a micrometre
  LengthUnit unit = LengthUnit::Millimetre;
  bool is_known = false;
};

class Context {
 public:
  Context(const step::File& file, const Execution& execution, std::optional<LengthUnit> assume_unit, Report& report);

  const step::File& file;
  const Execution& execution;
  std::optional<LengthUnit> assume_unit;
  Report& report;

  // The instance at `ref` when it is a `wanted`; else null and a finding (SP-F16, SP-X05) about `owner`.
  const Record* resolve(const Record& owner, Ref ref, Entity wanted);
  const Record* find(Ref ref) const { return ref ? file.find(ref) : nullptr; }
  bool is(const Record& i, Entity e) const { return file.is(i, e); }

  // The record as a struct of formats/step/records; nothing after findings that say what is wrong.
  template <class T>
  std::optional<T> read(const Record& instance) {
    step::Reader reader(file, instance, execution.limits, tape_, report);
    T record = T::read(reader);
    if (!reader.ok()) return std::nullopt;
    return record;
  }
  template <class T>
  std::optional<T> read(const Record& owner, Ref ref, Entity wanted = T::type) {
    const Record* instance = resolve(owner, ref, wanted);
    return instance ? read<T>(*instance) : std::nullopt;
  }
  // Every instance a record refers to, in the order of its text.
  std::vector<Ref> references(const Record& instance);

  // Units of the context that a representation names; the first ones of the file where it names none.
  const Units& units_of(const Record* representation_context);
  const Units& first_units();

  Diagnostic& add(const Record& instance, const Rule& rule, std::string text, double measured = not_measured,
                  double limit = not_measured);
  Diagnostic& add(const Record& instance, const Rule& rule, Severity severity, std::string text,
                  double measured = not_measured, double limit = not_measured);
  const std::string& last_text() const { return last_text_; }  // of the last finding: why a face could not be made
  void forget_text() { last_text_.clear(); }

  std::size_t index(const Record& i) const { return file.index(i); }
  bool is_consumed(const Record& i) const { return consumed_[index(i)]; }
  void consume(const Record& i) { consumed_[index(i)] = true; }

 private:
  friend class Visit;
  step::Tape tape_;
  std::string last_text_;
  std::vector<bool> consumed_, busy_;
  std::size_t depth_ = 0;
  std::unordered_map<std::size_t, std::unique_ptr<Units>> units_;
  std::unique_ptr<Units> first_units_;
};

// An instance being read. False when it is already being read (SP-F17) or the nesting is too deep (LM-05): said so.
class Visit {
 public:
  Visit(Context& context, const Record& instance);
  ~Visit();
  Visit(const Visit&) = delete;
  Visit& operator=(const Visit&) = delete;
  explicit operator bool() const { return entered_; }

 private:
  Context& context_;
  const Record& instance_;
  bool entered_ = false;
};

inline SourceRef source_of(const Record& i, std::uint8_t role = 0) { return {i.id, role}; }

// Value of a unit: mm of a length unit, radians of an angle unit. Nothing when it leads nowhere.
std::optional<double> unit_value(Context& context, const Record& unit, bool angle);
// Reads a context's units, with findings.
Units read_units(Context& context, const Record& representation_context);

}  // namespace trimloop::io::step_import
