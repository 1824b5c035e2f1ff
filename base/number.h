#pragma once
// Text <-> number, exactly and without a locale.
// Reading is correctly rounded; printing gives the shortest text that reads back to the same bits.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace trimloop {

enum class NumberFault : std::uint8_t { None, Empty, Syntax, Overflow, Underflow };

template <class T>
struct NumberText {
  T value{};
  NumberFault fault = NumberFault::None;  // Overflow: value is +-inf (real) or clamped (integer); Underflow: value is +-0
  explicit operator bool() const { return fault == NumberFault::None; }
};

// The whole text is one number, blanks at either end allowed. Accepts a leading +, exponent letters E e D d,
// ".5", "5.", and an integer where a real is wanted. Refuses NAN, INF, "1.D", "--1", embedded blanks.
NumberText<double> read_real(std::string_view text);
NumberText<std::int64_t> read_integer(std::string_view text);

// IGES form: always with a point, exponent letter 'E' or 'D' ("1.", "0.1", "1.E-20"). With 'D' the exponent is always
// there ("1.D0"): the letter is what makes a literal double precision. Finite values only.
std::string iges_real(double value, char exponent = 'E');
void append_iges_real(std::string& out, double value);  // with 'E'
// STEP form: as above with 'E' and a digit before the point.
std::string step_real(double value);
// Plain shortest form for JSON, SVG and people ("1", "0.1", "1e-20"); "null" for what is not finite.
std::string json_real(double value);

}  // namespace trimloop
