#pragma once
// TokenReader and TokenWriter: what every record is read from and written to, and the two pointer groups that may
// follow any record's own parameters (IGES 5.3 2.2.4.5.2).

#include <cstdint>
#include <string>
#include <vector>

#include "formats/iges/file.h"

namespace trimloop::iges {

struct TrailingGroups {
  std::vector<Ref> associativities, properties;
};

// Reads parameters in order. A fault makes a finding (rule, place, parameter index) and gives a neutral value;
// `ok()` tells afterwards whether the record can be used. Counts are checked against the tokens left.
class TokenReader {
 public:
  TokenReader(const File& file, const DirectoryEntry& entry, const Parameters& parameters, const Limits& limits,
              Report& report);

  double real();                       // no default: missing is IG-P02
  double real_or(double fallback);
  std::int64_t integer();
  std::int64_t integer_or(std::int64_t fallback);
  bool logical();
  std::string string_or(std::string fallback);
  Ref ref();                           // 0 allowed
  Ref signed_ref();                    // negative allowed (colours, fonts, 180 operands)
  // A count of groups of `tokens_each` tokens that follow. 0 (with a finding) when negative, over the tokens left or over the limit.
  std::size_t count(std::size_t tokens_each, std::int64_t minimum = 0);
  std::size_t left() const;            // tokens not yet read
  bool ok() const;
  int form() const;
  std::size_t position() const;        // index of the next token (1 = first parameter)
  void fault(const Rule& rule, std::string text, double measured = not_measured, double limit = not_measured);  // record unusable
  void remark(const Rule& rule, std::string text, double measured = not_measured, double limit = not_measured); // usable all the same
  TrailingGroups trailing_groups();    // everything after the own parameters

 private:
  const File& file_;
  const DirectoryEntry& entry_;
  const Parameters& parameters_;
  const Limits& limits_;
  Report& report_;
  std::size_t next_ = 1;
  bool ok_ = true;
};

// Collects parameters as text tokens, one per parameter.
class TokenWriter {
 public:
  void real(double value);
  void integer(std::int64_t value);
  void logical(bool value);
  void string(const std::string& value);   // Hollerith; empty string = empty field
  void ref(Ref value);
  void empty();
  const std::vector<std::string>& tokens() const { return tokens_; }

 private:
  std::vector<std::string> tokens_;
};

}  // namespace trimloop::iges
