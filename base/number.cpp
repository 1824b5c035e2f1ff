#include "base/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <system_error>

#include "base/assert.h"

namespace trimloop {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

// Drops a leading +; what follows must then be a digit or a point ("+-1" is no number).
bool drop_plus(std::string_view& text) {
  if (text.front() != '+') return true;
  text.remove_prefix(1);
  return !text.empty() && (is_digit(text.front()) || text.front() == '.');
}

// std::from_chars also reads "nan" and "inf", which no exchange format has: a number starts with a digit or a point.
bool starts_like_a_number(std::string_view text) {
  if (text.front() == '-') text.remove_prefix(1);
  return !text.empty() && (is_digit(text.front()) || text.front() == '.');
}

// Decimal exponent of the leading non-zero digit, saturated; `text` is a well-formed real that is out of range.
bool is_huge(std::string_view text) {
  constexpr long long far = 1'000'000'000'000;
  long long scale = 0;
  bool seen_point = false, seen_digit = false;
  std::size_t i = 0;
  for (; i < text.size() && text[i] != 'e' && text[i] != 'E'; ++i) {
    if (text[i] == '.') seen_point = true;
    if (!is_digit(text[i])) continue;
    if (text[i] != '0') seen_digit = true;
    if (seen_digit && !seen_point) ++scale;
    if (!seen_digit && seen_point) --scale;
  }
  if (i < text.size()) {
    std::string_view digits = text.substr(i + 1);
    const bool negative = digits.front() == '-';
    if (negative || digits.front() == '+') digits.remove_prefix(1);
    long long exponent = 0;
    for (char c : digits) exponent = exponent < far ? exponent * 10 + (c - '0') : exponent;
    scale += negative ? -exponent : exponent;
  }
  return scale > 0;
}

// Plain decimals of at most 15 digits, which is what most tokens are: both the digits and the power of ten are exact
// doubles, so that one division rounds correctly (Clinger 1990). Anything else is left to std::from_chars, twice as
// slow.
bool read_short_decimal(std::string_view text, double& value) {
  static constexpr double powers[] = {1,   1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                      1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  if (text.size() > 17) return false;
  const bool negative = text.front() == '-';
  std::size_t i = negative ? 1 : 0, digits = 0, decimals = 0;
  std::int64_t mantissa = 0;
  for (; i < text.size() && is_digit(text[i]); ++i, ++digits) mantissa = mantissa * 10 + (text[i] - '0');
  if (i < text.size() && text[i] == '.')
    for (++i; i < text.size() && is_digit(text[i]); ++i, ++digits, ++decimals)
      mantissa = mantissa * 10 + (text[i] - '0');
  if (i != text.size() || digits == 0 || digits > 15) return false;
  const double magnitude = static_cast<double>(mantissa) / powers[decimals];
  value = negative ? -magnitude : magnitude;
  return true;
}

// `text`: no blanks, no plus, exponent letter e or E.
NumberText<double> read_plain_real(std::string_view text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value, std::chars_format::general);
  if (stop != end || error == std::errc::invalid_argument) return {0.0, NumberFault::Syntax};
  if (error == std::errc{}) return {value, NumberFault::None};
  const bool negative = text.front() == '-', huge = is_huge(text);
  const double magnitude = huge ? std::numeric_limits<double>::infinity() : 0.0;
  return {negative ? -magnitude : magnitude, huge ? NumberFault::Overflow : NumberFault::Underflow};
}

// What the longest number takes: a sign, "0.0000" or a point, 17 digits and an exponent.
constexpr std::size_t longest_real = 32;

// Positional between 1e-5 and 1e16, else d.dddE±x; "D" numbers always state their exponent, because that letter is what
// makes them double precision. Returns the end of the text, which needs `longest_real` places.
char* put_pointed_real(char* to, double value, char letter) {
  TRIMLOOP_ASSERT(std::isfinite(value), "only finite numbers can be written");
  char* const limit = to + longest_real;
  if (std::signbit(value)) *to++ = '-';
  const double magnitude = std::fabs(value);
  if (letter == 'E' && magnitude < 1e15) {
    const auto whole = static_cast<std::int64_t>(magnitude);
    if (static_cast<double>(whole) == magnitude) {  // knots, weights and flags mostly
      to = std::to_chars(to, limit, whole).ptr;
      *to++ = '.';
      return to;
    }
    if (magnitude >= 1e-5) return std::to_chars(to, limit, magnitude, std::chars_format::fixed).ptr;
  }
  char text[longest_real];  // d.ddde±xx
  const char* const end = std::to_chars(text, text + sizeof text, magnitude, std::chars_format::scientific).ptr;
  const char* const e = static_cast<const char*>(std::memchr(text, 'e', static_cast<std::size_t>(end - text)));
  int exponent = 0;
  std::from_chars(e[1] == '+' ? e + 2 : e + 1, end, exponent);
  const char* const decimals = e - text > 1 ? text + 2 : e;
  *to++ = text[0];
  if (letter == 'E' && exponent == 15) {
    const char* const point = std::min(decimals + 15, e);
    to = std::copy(decimals, point, to);
    to = std::fill_n(to, 15 - (point - decimals), '0');
    *to++ = '.';
    return std::copy(point, e, to);
  }
  *to++ = '.';
  to = std::copy(decimals, e, to);
  *to++ = letter;
  return std::to_chars(to, limit, exponent).ptr;
}

std::string pointed_real(double value, char letter) {
  char text[longest_real];
  return std::string(text, put_pointed_real(text, value, letter));
}

}  // namespace

NumberText<double> read_real(std::string_view text) {
  text = trim(text);
  if (text.empty()) return {0.0, NumberFault::Empty};
  if (!drop_plus(text) || !starts_like_a_number(text)) return {0.0, NumberFault::Syntax};
  double value = 0;
  if (read_short_decimal(text, value)) return {value, NumberFault::None};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value, std::chars_format::general);
  if (stop == end && error == std::errc{}) return {value, NumberFault::None};
  if (stop == end || (*stop != 'd' && *stop != 'D')) return read_plain_real(text);

  const auto d = static_cast<std::size_t>(stop - text.data());
  constexpr std::size_t small = 64;  // longer ones are legal, but nobody writes them
  if (text.size() <= small) {
    char copy[small];
    std::memcpy(copy, text.data(), text.size());
    copy[d] = 'E';
    return read_plain_real({copy, text.size()});
  }
  std::string copy(text);
  copy[d] = 'E';
  return read_plain_real(copy);
}

NumberText<std::int64_t> read_integer(std::string_view text) {
  text = trim(text);
  if (text.empty()) return {0, NumberFault::Empty};
  if (!drop_plus(text)) return {0, NumberFault::Syntax};
  std::int64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (stop != end || error == std::errc::invalid_argument) return {0, NumberFault::Syntax};
  if (error == std::errc{}) return {value, NumberFault::None};
  using Range = std::numeric_limits<std::int64_t>;
  return {text.front() == '-' ? Range::min() : Range::max(), NumberFault::Overflow};
}

std::string iges_real(double value, char exponent) { return pointed_real(value, exponent); }

void append_iges_real(std::string& out, double value) {
  char text[longest_real];
  out.append(text, put_pointed_real(text, value, 'E'));
}

std::string step_real(double value) { return pointed_real(value, 'E'); }

std::string json_real(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

}  // namespace trimloop
