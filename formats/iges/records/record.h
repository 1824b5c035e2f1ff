#pragma once
// TokenReader and TokenWriter: what every record is read from and written to, and the two pointer groups that may
// follow any record's own parameters (IGES 5.3 2.2.4.5.2).

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/number.h"
#include "formats/iges/file.h"

namespace trimloop::iges {

struct Xyz {
  double x = 0, y = 0, z = 0;
};

// One parameter kept as text: of forms that have no struct of their own, and of records that could not be read.
struct Field {
  Token::Kind kind = Token::Kind::Empty;
  std::string text;  // Text: blanks trimmed; Hollerith: the string's bytes
};

struct TrailingGroups {
  std::vector<Ref> associativities, properties;
};

// Where a file spells a record otherwise than TokenWriter would: fields left empty or left out for their default, an
// integer with a point, a flag that is neither 0 nor 1. With it a record goes back with exactly the tokens it came
// with.
struct AsGiven {
  struct Note {
    std::size_t index = 0;  // parameter, from 1
    std::string canonical;  // what TokenWriter gives for the value that was understood
    Field given;
    bool omitted = false;  // the record ended before this field
  };
  std::size_t canonical_count = 0;  // of tokens that TokenWriter gives
  std::vector<Note> notes;          // by ascending index

  // Puts the file's spelling back where a token still has the value it was read as; edited values stay. A record that
  // meanwhile has more or fewer tokens is left as it is; fields that were left out stay out only together.
  void restore(std::vector<std::string>& tokens) const;
};

// Reads parameters in order. A fault makes a finding (rule, place, parameter index) and gives a neutral value;
// `ok()` tells afterwards whether the record can be used. Counts are checked against the tokens left.
class TokenReader {
 public:
  TokenReader(const File& file, const DirectoryEntry& entry, const Parameters& parameters, const Limits& limits,
              Report& report);

  double real();  // no default: an empty field is IG-P02 and read as 0, a missing one is a fault
  double real_or(double fallback);
  void reals(std::span<double> values);
  std::vector<double> reals(std::size_t count);  // the caller has asked `room` first
  Xyz xyz();
  Xyz xyz_or(Xyz fallback);
  std::int64_t integer();
  std::int64_t integer_or(std::int64_t fallback);
  int small_integer();  // as `integer`, IG-P09 beyond int
  int small_integer_or(int fallback);
  bool logical();
  bool logical_or(bool fallback);
  std::string string_or(std::string fallback);
  Ref ref();                                 // 0 allowed; IG-R01, IG-R02 when there is no such directory entry
  std::vector<Ref> refs(std::size_t count);  // the count comes from `count`
  Ref signed_ref();                          // negative allowed (colours, fonts, 180 operands)
  Field field();                             // whatever stands there, undecoded
  // A count of groups of `tokens_each` tokens that follow. 0 (with a finding) when negative, over the tokens left or
  // over the limit.
  std::size_t count(std::size_t tokens_each, std::int64_t minimum = 0);
  // True when `tokens` more tokens are there and under the limit; else a fault (IG-P17). Ask before every allocation.
  bool room(std::size_t tokens);
  // The next `tokens` fields are optional. Where the pointer groups start here instead, the next `tokens` `..._or` and
  // `ref` calls give their defaults without taking a token; IG-P21 when both readings would do.
  void optional_tail(std::size_t tokens);
  // The pointer groups do not start here, but `tokens` fields later: the record has more fields than its form asks for.
  bool groups_start_after(std::size_t tokens) const;

  std::size_t left() const;  // tokens not yet read
  bool ok() const { return ok_; }
  int form() const { return entry_.form; }
  std::size_t position() const { return next_; }  // index of the next token (1 = first parameter)
  const DirectoryEntry& entry() const { return entry_; }
  const DirectoryEntry* target(Ref ref) const { return file_.find(ref); }
  const Global& global() const { return file_.global(); }
  const File& file() const { return file_; }

  // Findings at the parameter read last, or at a given one.
  void fault(const Rule& rule, std::string text, double measured = not_measured,
             double limit = not_measured);  // record unusable
  void remark(const Rule& rule, std::string text, double measured = not_measured,
              double limit = not_measured);  // usable all the same
  void fault_at(std::size_t parameter, const Rule& rule, std::string text, double measured = not_measured,
                double limit = not_measured);
  void remark_at(std::size_t parameter, const Rule& rule, std::string text, double measured = not_measured,
                 double limit = not_measured);
  void remark_at(std::size_t parameter, Severity severity, const Rule& rule, std::string text,
                 double measured = not_measured, double limit = not_measured);

  TrailingGroups trailing_groups();  // everything after the own parameters
  AsGiven as_given();                // once, after the last read

 private:
  const Token* next();
  void missing(const char* wanted);
  double decode_real(const Token& token);
  double unread_real(const Token& token, NumberText<double> number);
  void style(std::string_view text);
  std::int64_t decode_integer(const Token& token);
  std::int64_t unread_integer(const Token& token, NumberFault fault);
  int narrowed(std::int64_t value);
  bool truth(std::int64_t value, const Token* token);
  void lose(const Rule& rule, std::string text, double measured, double limit);
  std::size_t group_end(std::size_t at, std::initializer_list<int> kinds) const;
  bool groups_fit(std::size_t at) const;
  std::vector<Ref> group(const char* name, std::initializer_list<int> kinds);
  void add(std::size_t parameter, Severity severity, const Rule& rule, std::string text, double measured, double limit);
  void bad_token(const Rule& rule, std::string text);
  void odd_token(Severity severity, const Rule& rule, std::string text);
  void note(std::string canonical, const Token* given);

  const File& file_;
  const DirectoryEntry& entry_;
  const std::vector<Token>& tokens_;
  const Limits& limits_;
  Report& report_;
  std::size_t next_ = 1;           // token to be read next
  std::size_t canonical_ = 0;      // fields asked for so far, whether there or not
  std::size_t absent_ = 0;         // fields of an optional tail that are still to be given as absent
  std::size_t broken_groups_ = 0;  // trailing groups that could not be read
  std::size_t token_findings_ = 0;
  bool ok_ = true;
  bool lost_ = false;  // a count was wrong or the record too short: nothing more can be told apart
  bool integer_for_real_ = false, lower_case_ = false;
  AsGiven as_given_;
};

// Collects parameters as text tokens, one per parameter.
class TokenWriter {
 public:
  void real(double value);
  void reals(std::span<const double> values);
  void xyz(const Xyz& value);
  void integer(std::int64_t value);
  void count(std::size_t value);
  void logical(bool value);
  void string(const std::string& value);  // Hollerith; empty string = empty field
  void ref(Ref value);
  void refs(const std::vector<Ref>& values);
  void empty();
  void field(const Field& value);
  void trailing_groups(const TrailingGroups& groups);
  std::size_t size() const { return ends_.size(); }
  std::string_view operator[](std::size_t i) const {
    const std::size_t start = i == 0 ? 0 : ends_[i - 1];
    return {text_.data() + start, ends_[i] - start};
  }
  std::string_view text() const { return text_; }  // all of them one after another
  std::vector<std::string> tokens() const;

 private:
  void end() { ends_.push_back(text_.size()); }

  std::string text_;
  std::vector<std::size_t> ends_;
};

}  // namespace trimloop::iges
