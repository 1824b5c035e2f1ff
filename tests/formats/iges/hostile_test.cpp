// What text made to hurt may cost: parsing stays below 3 x its size in memory, records below 20 x, all of it in linear
// time.

#include <malloc.h>

#include <boost/test/unit_test.hpp>
#include <chrono>
#include <cstdlib>
#include <new>
#include <random>

#include "formats/iges/file.h"
#include "formats/iges/records/any.h"
#include "tests/support/iges_text.h"

namespace {

std::size_t in_use = 0, most_in_use = 0;  // bytes from operator new; the tests have one thread

}  // namespace

// Not inlined: g++ would take malloc beside delete for a mistake.
[[gnu::noinline]] void* operator new(std::size_t size) {
  void* block = std::malloc(size);
  if (block == nullptr) std::abort();
  in_use += malloc_usable_size(block);
  most_in_use = std::max(most_in_use, in_use);
  return block;
}
[[gnu::noinline]] void operator delete(void* block) noexcept {
  if (block) in_use -= malloc_usable_size(block);
  std::free(block);
}
[[gnu::noinline]] void operator delete(void* block, std::size_t) noexcept { operator delete(block); }

namespace {

using namespace trimloop;
using namespace trimloop::iges;
using namespace trimloop::test;

constexpr std::size_t size = 4 << 20;
constexpr std::size_t constant = 10 << 20;  // a thousand findings of each rule are kept

std::string without_terminate() {
  auto cards = IgesText{}.cards();
  cards.pop_back();
  return join_cards(cards);
}

void check_costs(const char* name, std::string bytes) {
  const std::size_t length = bytes.size(), before = in_use - malloc_usable_size(bytes.data());
  const auto start = std::chrono::steady_clock::now();
  most_in_use = in_use;
  Report report;
  const File file = File::parse(std::move(bytes), {}, report);
  BOOST_TEST(most_in_use - before < 3 * length + constant, name << " parse: " << most_in_use - before << " bytes");
  std::size_t tokens = 0;
  for (const DirectoryEntry& entry : file.directory()) {
    const Parameters parameters = file.parameters(entry, report);
    tokens += parameters.tokens.size();
  }
  BOOST_TEST(most_in_use - before < 20 * length + constant, name << " records: " << most_in_use - before << " bytes");
  BOOST_TEST(tokens <= length);
  BOOST_TEST(!report.items().empty(), name);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  BOOST_TEST(seconds < 10.0,
             name << ": " << seconds << " s");  // some 0.2 s alone on a core; quadratic would be minutes
}

// One entity (406 form 15) whose Parameter data are `record`.
std::string one_record(const std::string& record) {
  std::string out = without_terminate();
  out += iges_card("     406       1", 'D', 1) + "\n" + iges_card("     406       0       0 9999999      15", 'D', 2) +
         "\n";
  std::size_t sequence = 0;
  for (std::size_t at = 0; at < record.size(); at += 64) {
    std::string data = record.substr(at, 64);
    data.resize(64, ' ');
    out += iges_card(data + "       1", 'P', ++sequence) + "\n";
  }
  return out;
}

std::string repeated(std::string text, const std::string& piece) {
  while (text.size() < size) text += piece;
  return text;
}

template <class Card>
std::string of_cards(Card card) {
  std::string out = without_terminate();
  for (std::size_t i = 1; out.size() < size; ++i) out += card(i) + "\n";
  return out;
}

}  // namespace

BOOST_AUTO_TEST_CASE(lines_that_are_no_cards) {
  for (const char* piece : {"\n", "\r", "\t", "x\n", " ", "\t\t\t\t\t\t\t\t\tP1\n", "\xff"})
    check_costs(piece, repeated(without_terminate(), piece));
  check_costs("nothing but newlines", std::string(size, '\n'));
  std::mt19937 random(1);
  std::string noise;
  while (noise.size() < size) noise += static_cast<char>(random());
  check_costs("noise", without_terminate() + noise);
}

BOOST_AUTO_TEST_CASE(directories_full_of_faults) {
  check_costs("letters", of_cards([](std::size_t i) { return iges_card(std::string(72, 'X'), 'D', i); }));
  check_costs("pointers", of_cards([](std::size_t i) {
                return iges_card("     110 9999999       0      -7      -7      -7      -7      -7 99999999", 'D', i);
              }));
  check_costs("first halves", of_cards([](std::size_t i) { return iges_card("     110       1", 'D', 2 * i - 1); }));
  check_costs("terminates", of_cards([](std::size_t i) { return iges_card("", 'T', i); }));
  std::mt19937 random(2);
  check_costs("shuffled",
              of_cards([&](std::size_t) { return iges_card("x", "SGDPsgdp"[random() % 8], random() % 100); }));
}

BOOST_AUTO_TEST_CASE(parameter_ranges_that_claim_everything) {
  for (const bool shared : {true, false}) {
    std::string bytes = without_terminate();
    for (std::size_t i = 1; bytes.size() < size / 2; ++i) {
      std::string pointer = std::to_string(shared ? 1 : (i + 1) / 2);
      pointer.insert(0, 8 - pointer.size(), ' ');
      bytes += iges_card(i % 2 ? "     110" + pointer : "     110       0       0 9999999", 'D', i) + "\n";
    }
    for (std::size_t i = 1; bytes.size() < size; ++i) bytes += iges_card("110,", 'P', i) + "\n";
    check_costs(shared ? "shared" : "overlapping", bytes);
  }
}

BOOST_AUTO_TEST_CASE(records_full_of_faults) {
  for (const char* piece :
       {"1H", "99999999Hx", "9H,", "0H,", ",", " ", "9", "0H                              x", "2H,;", "H", "\x01"})
    check_costs(piece, one_record(repeated("406,", piece)));
  check_costs("one string", one_record(repeated("406,1,4000000H", "x") + ";"));
  check_costs("commas that end", one_record(repeated("406", ",") + ";"));
}

BOOST_AUTO_TEST_CASE(a_global_section_without_end) {
  const std::string text = repeated("1H,,1H;,", "5Hx,");
  std::string bytes;
  for (std::size_t at = 0, i = 1; at < text.size(); at += 72, ++i)
    bytes += iges_card(text.substr(at, 72), 'G', i) + "\n";
  check_costs("global", bytes);
}
