#pragma once
// Findings: what is wrong with the data at hand, where, by how much, and under which rule.
// Every layer adds to one Report; nothing that goes wrong with input data travels by any other way.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/result.h"

namespace trimloop {

enum class Severity : std::uint8_t { Hint, Info, Warning, Error, Fatal };
std::string_view to_string(Severity);  // "hint" "info" "warning" "error" "fatal"

// A rule is data: static, one table per layer (formats/iges/rules.h, kernel/check/rules.h, io/rules.h).
// `trimloop explain ID` prints all of it.
struct Rule {
  std::string_view id;      // "IG-E126-04", never reused
  std::string_view slug;    // "knots-not-ascending"
  Severity severity;        // default severity
  std::string_view checks;  // what the rule looks at, one sentence
  std::string_view why;     // why it hurts the person holding the file
  std::string_view remedy;  // what to do or type next
  std::string_view unit;    // of measured and limit; empty when none
  std::string_view clause;  // "IGES 5.3 4.23", "ISO 10303-59 ...", or empty
};

struct Location {
  static constexpr std::size_t nowhere = static_cast<std::size_t>(-1);
  std::size_t offset = nowhere;  // bytes from the start of the file
  std::size_t length = 0;        // bytes
  std::size_t line = 0;          // physical line, from 1; 0 = not known
  std::size_t column = 0;        // byte column, from 1
  char section = 0;              // S G D P T, or 0
};

struct Diagnostic {
  const Rule* rule = nullptr;  // never null once reported; rules are static
  Severity severity = Severity::Error;
  std::string text;                // this case, one sentence: what was found, what was expected
  Location location;
  std::string entity;              // "D171", "#42", or empty
  std::string type;                // "126:0"
  int parameter = -1;              // index in the record, from 1; -1 = none
  std::vector<std::string> path;   // owners from near to far: {"D175", "D173"}
  double measured = not_measured;
  double limit = not_measured;
  std::string unit;                // overrides rule->unit when not empty
  std::optional<std::array<double, 3>> at;  // model space, mm
};

// Keeps every finding up to `stored_per_rule` of one rule and counts all of them.
class Report {
 public:
  static constexpr std::size_t stored_per_rule = 1000;

  // Adds a finding under the rule's own severity, or another one; the caller fills the rest. The severity is counted here:
  // do not change it afterwards. The reference is good until the next add().
  Diagnostic& add(const Rule& rule, std::string text);
  Diagnostic& add(const Rule& rule, Severity severity, std::string text);
  void add(Diagnostic diagnostic);
  void append(Report other);

  const std::vector<Diagnostic>& items() const { return items_; }
  std::size_t count(Severity severity) const { return by_severity_[static_cast<std::size_t>(severity)]; }
  std::size_t count(std::string_view rule_id) const;
  bool has_fatal() const { return count(Severity::Fatal) > 0; }
  void sort();  // by file offset, then rule id; stable

  // Lets whoever knows the file fill in lines and columns of the findings kept so far: fill(Location&).
  template <class Fill>
  void locate(Fill fill) {
    for (Diagnostic& item : items_) fill(item.location);
  }

 private:
  std::vector<Diagnostic> items_;
  std::array<std::size_t, 5> by_severity_{};
  std::unordered_map<std::string_view, std::size_t> by_rule_;
  Diagnostic discarded_;  // what add() hands out once a rule's store is full
};

}  // namespace trimloop
