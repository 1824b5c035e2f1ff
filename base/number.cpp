#include "base/number.h"

#include <fmt/format.h>

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

// Shortest digits and exponent: |value| = d.ddd x 10^exponent, `digits` without the point.
struct Decimal {
  char digits[24];
  int count = 0, exponent = 0;
};

Decimal shortest(double magnitude) {
  Decimal d;
  char text[40];
  const auto [end, error] = std::to_chars(text, text + sizeof text, magnitude, std::chars_format::scientific);
  TRIMLOOP_ASSERT(error == std::errc{}, "40 characters hold every shortest double");
  const char* e = static_cast<const char*>(std::memchr(text, 'e', static_cast<std::size_t>(end - text)));
  for (const char* c = text; c != e; ++c)
    if (is_digit(*c)) d.digits[d.count++] = *c;
  std::from_chars(e[1] == '+' ? e + 2 : e + 1, end, d.exponent);
  return d;
}

// Positional between 1e-5 and 1e16, else d.dddE±x; "D" numbers always state their exponent, because that letter is what
// makes them double precision.
std::string pointed_real(double value, char letter) {
  TRIMLOOP_ASSERT(std::isfinite(value), "only finite numbers can be written");
  const Decimal d = shortest(std::fabs(value));
  std::string out = std::signbit(value) ? "-" : "";
  const bool positional = letter == 'E' && d.exponent >= -5 && d.exponent < 16;
  if (!positional) {
    out += d.digits[0];
    out += '.';
    out.append(d.digits + 1, d.count - 1);
    out += letter;
    out += std::to_string(d.exponent);
  } else if (d.exponent < 0) {
    out += "0.";
    out.append(static_cast<std::size_t>(-d.exponent - 1), '0');
    out.append(d.digits, d.count);
  } else {
    const int whole = d.exponent + 1;
    for (int i = 0; i < whole; ++i) out += i < d.count ? d.digits[i] : '0';
    out += '.';
    for (int i = whole; i < d.count; ++i) out += d.digits[i];
  }
  return out;
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

std::string step_real(double value) { return pointed_real(value, 'E'); }

std::string json_real(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

}  // namespace trimloop
