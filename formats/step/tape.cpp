#include "formats/step/tape.h"

#include <charconv>
#include <cmath>
#include <limits>

#include "base/number.h"
#include "formats/step/scan.h"

namespace trimloop::step {
namespace {

using Kind = Token::Kind;

constexpr double powers_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }
bool is_hex(char c) { return is_digit(c) || (c >= 'A' && c <= 'F') || (c >= 'a' && c <= 'f'); }

}  // namespace

// value   := keyword parameters | '(' { keyword parameters } ')'
// parameters := '(' [ parameter { ',' parameter } ] ')'
// parameter  := '$' | '*' | number | string | enumeration | binary | '#' digits | '<' name '>' | parameters
//             | keyword parameters                                                   ISO 10303-21 table 3
bool Tape::read(std::string_view text, const Limits& limits) {
  text_ = text;
  at_ = 0;
  tokens_.clear();
  parts_.clear();
  faults_.clear();
  const auto deepest = static_cast<std::uint32_t>(std::min<std::size_t>(limits.nesting_depth * 4, 256));
  at_ = skip_blanks(text_, at_);
  const bool complex = at_ < text_.size() && text_[at_] == '(';
  if (complex) ++at_;
  for (;;) {
    at_ = skip_blanks(text_, at_);
    if (complex && at_ < text_.size() && text_[at_] == ')') {
      ++at_;
      break;
    }
    if (!read_part() || !read_attributes(deepest, limits.list_count)) return false;
    if (!complex) break;
  }
  at_ = skip_blanks(text_, at_);
  if (at_ < text_.size()) fault(Fault::Kind::Garbage, at_, text_.size() - at_);
  if (parts_.empty()) fault(Fault::Kind::Unterminated, 0, text_.size());  // "()": an instance of nothing
  return !parts_.empty();
}

bool Tape::read_part() {
  const std::size_t begin = at_;
  if (at_ < text_.size() && text_[at_] == '!') ++at_;
  while (at_ < text_.size() && is_word(text_[at_])) ++at_;
  const std::string_view keyword = text_.substr(begin, at_ - begin);
  at_ = skip_blanks(text_, at_);
  if (keyword.empty() || at_ >= text_.size() || text_[at_] != '(') {
    fault(Fault::Kind::Unterminated, std::min(at_, text_.size()));
    return false;
  }
  ++at_;
  parts_.push_back({keyword, size(), size()});
  return true;
}

bool Tape::read_attributes(std::uint32_t deepest, std::size_t most) {
  open_.clear();
  bool wants_value = true, after_comma = false;
  for (;;) {
    if (at_ < text_.size() && (is_blank(text_[at_]) || text_[at_] == '/')) at_ = skip_blanks(text_, at_);
    if (at_ >= text_.size()) {
      fault(Fault::Kind::Unterminated, at_);
      break;
    }
    const char c = text_[at_];
    if (c == ')') {
      if (wants_value && after_comma) fault(Fault::Kind::Separator, at_);
      ++at_;
      if (open_.empty()) break;
      tokens_[open_.back()].end = size();
      open_.pop_back();
      wants_value = after_comma = false;
      continue;
    }
    if (c == ',') {
      if (wants_value) {  // nothing stands before it
        fault(Fault::Kind::Separator, at_);
        push(Kind::Unset, at_, 0);
      }
      ++at_;
      wants_value = after_comma = true;
      continue;
    }
    if (!wants_value) fault(Fault::Kind::Separator, at_);
    if (tokens_.size() >= most) {
      fault(Fault::Kind::TooMany, at_);
      parts_.back().end = size();
      return false;
    }
    wants_value = after_comma = false;
    switch (c) {
      case '(':
        if (open_.size() >= deepest) {
          fault(Fault::Kind::Depth, at_);
          return false;
        }
        open_.push_back(size());
        push(Kind::List, at_++, 1);
        wants_value = true;
        break;
      case '$': push(Kind::Unset, at_++, 1); break;
      case '*': push(Kind::Derived, at_++, 1); break;
      case '#': {
        const std::size_t begin = at_++;
        std::uint64_t id = 0;
        const std::size_t first = at_;
        bool over = false;
        while (at_ < text_.size() && is_digit(text_[at_])) {
          over = over || id > (std::numeric_limits<std::uint64_t>::max() - 9) / 10;
          id = id * 10 + static_cast<std::uint64_t>(text_[at_++] - '0');
        }
        const bool good = at_ > first && !over;
        if (!good) fault(Fault::Kind::InstanceForm, begin, at_ - begin);
        push(good ? Kind::Reference : Kind::Bad, begin, at_ - begin).id = good ? id : 0;
        break;
      }
      case '\'': {
        const std::size_t end = end_of_string(text_, at_);
        if (end == std::string_view::npos) {
          fault(Fault::Kind::OpenString, at_, text_.size() - at_);
          push(Kind::Bad, at_, text_.size() - at_);
          at_ = text_.size();
        } else {
          push(Kind::String, at_ + 1, end - at_ - 1);
          at_ = end + 1;
        }
        break;
      }
      case '"': {
        const std::size_t begin = ++at_;
        while (at_ < text_.size() && is_hex(text_[at_])) ++at_;
        const bool closed = at_ < text_.size() && text_[at_] == '"';
        const bool good = closed && at_ > begin && text_[begin] >= '0' && text_[begin] <= '3';
        if (!good) fault(Fault::Kind::BinaryForm, begin - 1, at_ - begin + 1);
        push(good ? Kind::Binary : Kind::Bad, begin, at_ - begin);
        if (closed) ++at_;
        else skip_rubbish();
        break;
      }
      case '<': {
        const std::size_t end = text_.find('>', at_);
        if (end == std::string_view::npos) {
          fault(Fault::Kind::Garbage, at_, text_.size() - at_);
          push(Kind::Bad, at_, text_.size() - at_);
          at_ = text_.size();
        } else {
          push(Kind::Anchor, at_ + 1, end - at_ - 1);
          at_ = end + 1;
        }
        break;
      }
      case '.':
        if (at_ + 1 < text_.size() && is_digit(text_[at_ + 1])) {
          read_number();
        } else {
          const std::size_t begin = ++at_;
          bool lower = false;
          while (at_ < text_.size() && is_word(text_[at_])) lower = lower || (text_[at_] >= 'a' && text_[at_] <= 'z'), ++at_;
          const bool closed = at_ < text_.size() && text_[at_] == '.';
          if (!closed || at_ == begin || lower) fault(Fault::Kind::EnumForm, begin - 1, at_ - begin + 1);
          push(at_ == begin ? Kind::Bad : Kind::Enumeration, begin, at_ - begin);
          if (closed) ++at_;
        }
        break;
      default:
        if (is_digit(c) || c == '-' || c == '+') {
          read_number();
        } else if (is_letter(c) || c == '!') {
          read_word();
          if (at_ < text_.size() && text_[at_] == '(') {  // a typed value: its contents follow
            if (open_.size() >= deepest) {
              fault(Fault::Kind::Depth, at_);
              return false;
            }
            ++at_;
            open_.push_back(size() - 1);
            wants_value = true;
          }
        } else {
          const std::size_t begin = at_;
          skip_rubbish();
          if (at_ == begin) ++at_;
          fault(Fault::Kind::Garbage, begin, at_ - begin);
          push(Kind::Bad, begin, at_ - begin);
        }
    }
  }
  for (const std::uint32_t i : open_) tokens_[i].end = size();
  parts_.back().end = size();
  return true;
}

// A real needs a digit and a point, the exponent is E. What else is plainly meant is taken and reported.
void Tape::read_number() {
  const char* const all = text_.data();
  const std::size_t begin = at_, size_of_text = text_.size();
  const bool negative = all[at_] == '-';
  if (negative || all[at_] == '+') ++at_;
  std::uint64_t mantissa = 0;
  int digits = 0, exponent = 0;  // digits: that went into the mantissa
  bool any = false, point = false, exact = true, form = false;
  const auto take = [&](int shift) {
    for (; at_ < size_of_text && is_digit(all[at_]); ++at_) {
      any = true;
      if (digits < 18) {
        mantissa = mantissa * 10 + static_cast<std::uint64_t>(all[at_] - '0');
        digits += mantissa != 0;
        exponent += shift;
      } else {
        exact = false;
      }
    }
  };
  take(0);
  const bool whole = any;
  if (at_ < size_of_text && all[at_] == '.') {
    point = true;
    ++at_;
    take(-1);
  }
  form = !whole;
  bool has_exponent = false;
  if (any && at_ < size_of_text && (all[at_] == 'E' || all[at_] == 'e' || all[at_] == 'D' || all[at_] == 'd')) {
    form = form || all[at_] != 'E' || !point;
    has_exponent = true;
    ++at_;
    bool minus = false;
    if (at_ < size_of_text && (all[at_] == '-' || all[at_] == '+')) minus = all[at_++] == '-';
    int power = 0;
    const std::size_t first = at_;
    for (; at_ < size_of_text && is_digit(all[at_]); ++at_) power = power < 100000 ? power * 10 + (all[at_] - '0') : power;
    if (at_ == first) form = true;
    exponent += minus ? -power : power;
  }
  const std::size_t length = at_ - begin;
  if (!any || (at_ < size_of_text && is_word(all[at_]))) {
    skip_rubbish();
    fault(Fault::Kind::RealForm, begin, at_ - begin);
    push(Kind::Bad, begin, at_ - begin);
    return;
  }
  if (!point && !has_exponent) {
    if (exact) {
      push(Kind::Integer, begin, length).integer = negative ? -static_cast<std::int64_t>(mantissa) : static_cast<std::int64_t>(mantissa);
      return;
    }
    const auto value = read_integer(text_.substr(begin, length));
    if (!value) fault(Fault::Kind::IntegerOverflow, begin, length);
    push(value ? Kind::Integer : Kind::Bad, begin, length).integer = value.value;
    return;
  }
  double value = 0;
  constexpr std::uint64_t exact_below = std::uint64_t{1} << 53;
  if (exact && mantissa < exact_below && exponent >= -22 && exponent <= 22) {
    // One rounding of exact operands (Clinger 1990).
    value = static_cast<double>(mantissa);
    value = exponent < 0 ? value / powers_of_ten[-exponent] : value * powers_of_ten[exponent];
    if (negative) value = -value;
  } else {
    const char* first = all + begin + (all[begin] == '+');
    const auto [end, error] = std::from_chars(first, all + begin + length, value);
    if (error != std::errc{} || end != all + begin + length) {
      std::string_view whole_text = text_.substr(begin, length);
      while (!whole_text.empty() && is_letter(whole_text.back())) whole_text.remove_suffix(1);  // "1.E"
      const auto read = read_real(whole_text);
      value = read.value;
      if (read.fault == NumberFault::Overflow || read.fault == NumberFault::Syntax || read.fault == NumberFault::Empty) {
        fault(read.fault == NumberFault::Overflow ? Fault::Kind::RealOverflow : Fault::Kind::RealForm, begin, length);
        push(Kind::Bad, begin, length);
        return;
      }
      if (read.fault == NumberFault::Underflow) fault(Fault::Kind::Underflow, begin, length);
    }
  }
  if (form) fault(Fault::Kind::RealForm, begin, length);
  push(Kind::Real, begin, length).real = value;
}

// A keyword before its '(' becomes a typed value; any other word is not known to the grammar.
void Tape::read_word() {
  const std::size_t begin = at_;
  if (text_[at_] == '!') ++at_;
  while (at_ < text_.size() && is_word(text_[at_])) ++at_;
  const std::size_t length = at_ - begin;
  const std::size_t next = skip_blanks(text_, at_);
  if (next < text_.size() && text_[next] == '(') {
    at_ = next;
    push(Kind::Typed, begin, length);
    return;
  }
  const std::string_view word = text_.substr(begin, length);
  const bool number_word = word == "NAN" || word == "INF" || word == "NaN" || word == "Inf" || word == "nan" || word == "inf";
  fault(number_word ? Fault::Kind::RealForm : Fault::Kind::EnumForm, begin, length);
  push(Kind::Bad, begin, length);
}

void Tape::skip_rubbish() {
  while (at_ < text_.size() && text_[at_] != ',' && text_[at_] != ')' && text_[at_] != '(' && text_[at_] != '\'') ++at_;
}

void Tape::fault(Fault::Kind kind, std::size_t offset, std::size_t length) {
  constexpr std::size_t kept = 20;  // of one record: a screenful of rubbish is one finding often enough
  if (faults_.size() < kept)
    faults_.push_back({kind, static_cast<std::uint32_t>(offset), static_cast<std::uint32_t>(std::min<std::size_t>(length, 60))});
}

Token& Tape::push(Token::Kind kind, std::size_t offset, std::size_t length) {
  Token& t = tokens_.emplace_back();
  t.kind = kind;
  t.end = size();
  t.offset = static_cast<std::uint32_t>(offset);
  t.length = static_cast<std::uint32_t>(length);
  return t;
}

std::uint32_t Tape::count(std::uint32_t list) const {
  std::uint32_t n = 0;
  for (std::uint32_t i = list + 1; i < tokens_[list].end; i = tokens_[i].end) ++n;
  return n;
}

}  // namespace trimloop::step
