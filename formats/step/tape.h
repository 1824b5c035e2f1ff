#pragma once
// One record (or header entity) as a flat row of tokens: lists and typed values are followed by their contents and know
// where those end. Made on demand, reused for the next record; nothing nests on the stack, however deep the text does.

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/limits.h"

namespace trimloop::step {

struct Token {
  enum class Kind : std::uint8_t {
    Unset,        // $
    Derived,      // *
    Integer, Real,
    String,       // text: between the apostrophes, undecoded
    Enumeration,  // text: between the points
    Binary,       // text: between the quotes
    Reference,    // #id
    Anchor,       // <name>
    List,
    Typed,        // text: the keyword; its contents follow
    Bad           // could not be read; a fault says why
  } kind = Kind::Bad;
  std::uint32_t end = 0;                  // index of the token behind this one and its contents
  std::uint32_t offset = 0, length = 0;   // of the text, in the record
  union {
    double real;
    std::int64_t integer;
    std::uint64_t id = 0;
  };
};

// What is wrong in a record's text; the file's rules have the same names (rules.h, SP-F..).
struct Fault {
  enum class Kind : std::uint8_t {
    Separator, Unterminated, OpenString, RealForm, RealOverflow, Underflow, IntegerOverflow, EnumForm, BinaryForm, Depth,
    TooMany, Garbage, InstanceForm, PartTwice
  } kind = Kind::Garbage;
  std::uint32_t offset = 0, length = 1;   // in the record
};

class Tape {
 public:
  struct Part {  // of a complex instance; a simple one is its only part
    std::string_view keyword;
    std::uint32_t first = 0, end = 0;     // tokens of its attributes
  };

  // `text` is a value: KEYWORD(...) or (KEYWORD(...)...); it must outlive the tape. False when no attribute of it can be
  // used; `faults` says what is wrong either way.
  bool read(std::string_view text, const Limits& limits);

  const std::vector<Part>& parts() const { return parts_; }
  const std::vector<Fault>& faults() const { return faults_; }
  const Token& operator[](std::uint32_t i) const { return tokens_[i]; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(tokens_.size()); }
  std::string_view text(const Token& t) const { return text_.substr(t.offset, t.length); }
  std::uint32_t count(std::uint32_t list) const;   // direct members of the list or typed value at that index

 private:
  bool read_part();
  bool read_attributes(std::uint32_t deepest, std::size_t most);
  void read_number();
  void read_word();
  void skip_rubbish();
  void fault(Fault::Kind kind, std::size_t offset, std::size_t length = 1);
  Token& push(Token::Kind kind, std::size_t offset, std::size_t length);

  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<Token> tokens_;
  std::vector<Part> parts_;
  std::vector<Fault> faults_;
  std::vector<std::uint32_t> open_;       // lists not closed yet
};

}  // namespace trimloop::step
