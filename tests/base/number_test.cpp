#include "base/number.h"

#include <fmt/format.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>

using namespace trimloop;

namespace {

std::uint64_t bits(double value) {
  std::uint64_t out;
  std::memcpy(&out, &value, sizeof out);
  return out;
}

std::vector<double> awkward_doubles() {
  std::vector<double> values = {0.0,
                                -0.0,
                                1.0,
                                0.1,
                                100.0,
                                1e15,
                                1e16,
                                1e17,
                                1e-4,
                                1e-5,
                                1e-6,
                                1.0 / 3,
                                4.9e-324,
                                1e-320,
                                2.2250738585072011e-308,
                                1.7976931348623157e308,
                                123456789.125,
                                -9007199254740993.0,
                                1234567890123456.5,
                                999999999999999.9,
                                9.9999999999999991e-6};
  std::mt19937_64 random(7);
  while (values.size() < 10000)  // lengths of a part, where numbers are written without an exponent
    values.push_back(std::ldexp(static_cast<double>(static_cast<std::int64_t>(random())), -8 - static_cast<int>(random() % 72)));
  while (values.size() < 20000) {
    const std::uint64_t pattern = random();
    double value;
    std::memcpy(&value, &pattern, sizeof value);
    if (std::isfinite(value)) values.push_back(value);
  }
  return values;
}

}  // namespace

BOOST_AUTO_TEST_CASE(printed_reals_read_back_to_the_same_bits) {
  for (double value : awkward_doubles())
    for (const std::string& text : {iges_real(value), iges_real(value, 'D'), step_real(value), json_real(value)}) {
      const auto back = read_real(text);
      BOOST_TEST_REQUIRE(bool(back), text);
      BOOST_TEST_REQUIRE(bits(back.value) == bits(value), text);
    }
}

BOOST_AUTO_TEST_CASE(reading_agrees_with_the_c_library_to_the_last_bit) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 20000; ++i) {
    std::string text = std::to_string(random()) + "." + std::to_string(random()) + "E" +
                       std::to_string(static_cast<int>(random() % 600) - 320);
    const double expected = std::strtod(text.c_str(), nullptr);
    if (!std::isfinite(expected) || expected == 0) continue;
    BOOST_TEST_REQUIRE(bits(read_real(text).value) == bits(expected), text);
  }
}

BOOST_AUTO_TEST_CASE(short_decimals_agree_with_the_c_library_to_the_last_bit) {
  std::mt19937_64 random(13);
  for (int i = 0; i < 200000; ++i) {
    std::string text = std::to_string(random()).substr(0, random() % 18);
    const std::size_t point = random() % (text.size() + 1);
    text = fmt::format("{}{}.{}", random() % 2 ? "-" : "", text.substr(0, point), text.substr(point));
    if (text.find_first_of("0123456789") == std::string::npos) continue;
    BOOST_TEST_REQUIRE(bits(read_real(text).value) == bits(std::strtod(text.c_str(), nullptr)), text);
  }
  BOOST_TEST(bits(read_real("-0.").value) == bits(-0.0));
}

BOOST_AUTO_TEST_CASE(reals_are_printed_in_the_form_each_format_asks_for) {
  BOOST_TEST(iges_real(1) == "1.");
  BOOST_TEST(iges_real(0.1) == "0.1");
  BOOST_TEST(iges_real(-0.0) == "-0.");
  BOOST_TEST(iges_real(1e-20) == "1.E-20");
  BOOST_TEST(iges_real(1.5e300) == "1.5E300");
  BOOST_TEST(iges_real(1200) == "1200.");
  BOOST_TEST(iges_real(0.00025) == "0.00025");
  BOOST_TEST(iges_real(1, 'D') == "1.D0");
  BOOST_TEST(iges_real(25.4, 'D') == "2.54D1");
  BOOST_TEST(json_real(1) == "1");
  BOOST_TEST(json_real(std::numeric_limits<double>::infinity()) == "null");
  BOOST_TEST(json_real(std::nan("")) == "null");
}

BOOST_AUTO_TEST_CASE(every_spelling_of_a_real_is_read) {
  for (const char* one : {"1", "1.", "+1", "+1.0", "  1. ", "1E0", "1.e0", "1.D0", "1d+0", "10.D-1", ".1D1", "\t1"})
    BOOST_TEST(read_real(one).value == 1.0, one);
  BOOST_TEST(read_real("-.5").value == -0.5);
  BOOST_TEST(read_real(std::string(100, '0') + "2.5D1").value == 25.0);
}

BOOST_AUTO_TEST_CASE(what_is_no_real_is_refused) {
  for (const char* bad :
       {"1.D",  "1D+",    ".D0",  "--1",  "+-1",   "-+1",   "1 2", "1..2", "1,5", "NAN", "nan",   "INF",
        "-inf", "1.#IND", "****", "0x10", "1E5E5", "1D5D5", ".",   "+",    "-",   "E5",  "1.0E 5"})
    BOOST_TEST((read_real(bad).fault == NumberFault::Syntax), bad);
  BOOST_TEST((read_real("   ").fault == NumberFault::Empty));
  BOOST_TEST((read_real("").fault == NumberFault::Empty));
}

BOOST_AUTO_TEST_CASE(reals_out_of_range_say_on_which_side) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const char* huge : {"1E309", "1E99999", "1D999999999999999999999", "10000E308"}) {
    BOOST_TEST((read_real(huge).fault == NumberFault::Overflow), huge);
    BOOST_TEST(read_real(huge).value == infinity);
  }
  BOOST_TEST(read_real("-1E309").value == -infinity);
  for (const char* tiny : {"1E-400", "1D-99999", "0.0001E-330", "-1E-999999999999999999999"}) {
    BOOST_TEST((read_real(tiny).fault == NumberFault::Underflow), tiny);
    BOOST_TEST(read_real(tiny).value == 0.0);
  }
  BOOST_TEST((read_real("0E99999").fault == NumberFault::None));
  BOOST_TEST((read_real("1E-320").fault == NumberFault::None));
}

BOOST_AUTO_TEST_CASE(integers_are_read_or_refused) {
  BOOST_TEST(read_integer(" +12 ").value == 12);
  BOOST_TEST(read_integer("-0012").value == -12);
  BOOST_TEST(read_integer("9223372036854775807").value == INT64_MAX);
  for (const char* bad : {"1.", "1E3", "12A", "--1", "+-1", "1 2", "-", "+"})
    BOOST_TEST((read_integer(bad).fault == NumberFault::Syntax), bad);
  BOOST_TEST((read_integer("").fault == NumberFault::Empty));
  BOOST_TEST((read_integer("99999999999999999999").fault == NumberFault::Overflow));
  BOOST_TEST(read_integer("99999999999999999999").value == INT64_MAX);
  BOOST_TEST(read_integer("-99999999999999999999").value == INT64_MIN);
}
