#include "formats/iges/tokens.h"

// The one source that includes Spirit: it costs seconds of compile time.
#include <algorithm>
#include <boost/spirit/home/x3.hpp>
#include <cstring>

namespace trimloop::iges {
namespace {

namespace x3 = boost::spirit::x3;

bool is_blank(char c) { return c == ' ' || c == '\t'; }

const char* skip_blanks(const char* at, const char* last) {
  while (at != last && is_blank(*at)) ++at;
  return at;
}

// What a record's terminals need to know of their surroundings.
struct Scan {
  const char* begin;
  const char* last;
  char parameter_delimiter, record_delimiter;
  std::vector<Token>& tokens;
  std::vector<LexFault>& faults;
  std::size_t most;                          // tokens
  mutable const char* record_end = nullptr;  // the next record delimiter, looked up once and remembered

  bool ends_at(const char* at) const { return at == last || *at == parameter_delimiter || *at == record_delimiter; }
  static const char* find(char c, const char* from, const char* to) {
    const void* found = std::memchr(from, c, static_cast<std::size_t>(to - from));
    return found ? static_cast<const char*>(found) : to;
  }
  const char* find_end(const char* at) const {
    if (record_end == nullptr || record_end < at) record_end = find(record_delimiter, at, last);
    return find(parameter_delimiter, at, record_end);
  }
  std::size_t position(const char* at) const { return static_cast<std::size_t>(at - begin); }
  void push(Token::Kind kind, const char* from, const char* to, const char* start) const {
    tokens.push_back({kind, {from, static_cast<std::size_t>(to - from)}, position(start)});
  }
  bool full() const { return tokens.size() >= most; }
  void fault(LexFault::Kind kind, const char* at) const {
    if (faults.size() < Lexer::most_faults) faults.push_back({kind, tokens.size(), position(at)});
  }
};

// string = digits "H" n-bytes, delimiters inside being data. The count is believed when a delimiter follows. When not:
// a delimiter inside the counted bytes ends the string (count too large), else what is left before the next one is
// dropped.
struct HollerithParser : x3::parser<HollerithParser> {
  using attribute_type = x3::unused_type;
  static constexpr bool has_attribute = false;
  const Scan& scan;
  explicit HollerithParser(const Scan& s) : scan(s) {}

  template <class Context, class RuleContext, class Attribute>
  bool parse(const char*& first, const char* const& last, const Context&, RuleContext&, Attribute&) const {
    if (scan.full()) return false;
    const char* start = skip_blanks(first, last);
    const char* h = start;
    std::size_t count = 0;
    for (; h != last && *h >= '0' && *h <= '9'; ++h)
      if (count < 1'000'000'000'000) count = count * 10 + static_cast<std::size_t>(*h - '0');
    if (h == start || h == last || (*h != 'H' && *h != 'h')) return false;

    const char* text = h + 1;
    const std::size_t room = static_cast<std::size_t>(last - text);
    if (*h == 'h') scan.fault(LexFault::Kind::SmallH, start);
    if (count == 0) scan.fault(LexFault::Kind::EmptyString, start);
    const char* end = text + std::min(count, room);
    const char* next = count <= room ? skip_blanks(end, last) : nullptr;
    if (next && scan.ends_at(next)) {
      scan.push(Token::Kind::Hollerith, text, end, start);
      first = next;
      return true;
    }
    const char* delimiter = scan.find_end(text);
    if (count <= room && delimiter >= end) {
      scan.fault(LexFault::Kind::TextBehindString, start);
    } else {
      const bool absurd = count > static_cast<std::size_t>(last - scan.begin);
      scan.fault(absurd ? LexFault::Kind::CountPassesAll : LexFault::Kind::CountPassesEnd, start);
      end = delimiter;
    }
    scan.push(Token::Kind::Hollerith, text, end, start);
    first = delimiter;
    return true;
  }
};

// number, pointer or nothing = everything up to the next delimiter, blanks at both ends cut. Runs of numbers are nine
// tenths of a file, which is why this is written by hand.
struct RunParser : x3::parser<RunParser> {
  using attribute_type = x3::unused_type;
  static constexpr bool has_attribute = false;
  const Scan& scan;
  explicit RunParser(const Scan& s) : scan(s) {}

  template <class Context, class RuleContext, class Attribute>
  bool parse(const char*& first, const char* const& last, const Context&, RuleContext&, Attribute&) const {
    if (scan.full()) return false;
    const char* start = skip_blanks(first, last);
    const char* next = scan.find_end(start);
    const char* end = next;
    while (end != start && is_blank(end[-1])) --end;
    scan.push(end == start ? Token::Kind::Empty : Token::Kind::Text, start, end, start);
    first = next;
    return true;
  }
};

}  // namespace

Lexer::Lexer(char parameter_delimiter, char record_delimiter)
    : parameter_delimiter_(parameter_delimiter), record_delimiter_(record_delimiter) {}

// record = parameter { pd parameter } rd
// parameter = string | run
Lexed Lexer::lex(std::string_view text, std::vector<Token>& tokens, std::vector<LexFault>& faults) const {
  const char* first = text.data();
  const char* const last = first + text.size();
  const std::size_t most = tokens.size() + most_tokens(text.size());
  const auto delimiters = static_cast<std::size_t>(std::count(first, last, parameter_delimiter_));
  tokens.reserve(std::min(most, tokens.size() + delimiters + 1));
  const Scan scan{first, last, parameter_delimiter_, record_delimiter_, tokens, faults, most};
  const auto parameter = HollerithParser(scan) | RunParser(scan);
  x3::parse(first, last, parameter % x3::lit(parameter_delimiter_));
  const bool terminated = x3::parse(first, last, x3::lit(record_delimiter_));
  if (!terminated && scan.full())
    faults.push_back({LexFault::Kind::TooManyTokens, tokens.size() - 1, scan.position(first)});
  return {scan.position(first), terminated};
}

// opening = [ "1H" pd ] pd [ "1H" rd ] ( pd | rd )
std::optional<Delimiters> read_delimiters(std::string_view text) {
  const char* first = text.data();
  const char* const last = first + text.size();
  const auto blanks = x3::omit[*x3::char_(" \t")];
  const auto stated = blanks >> x3::omit[x3::char_('1') >> x3::char_("Hh")] >> x3::char_;

  Delimiters out;
  x3::parse(first, last, stated, out.parameter);
  const auto delimiter = [&](char c) {  // a blank one is refused later, by its name
    return x3::parse(first, last, x3::lit(c)) || x3::parse(first, last, blanks >> x3::lit(c));
  };
  if (!delimiter(out.parameter)) return std::nullopt;
  x3::parse(first, last, stated, out.record);
  if (!delimiter(out.parameter)) {
    if (!delimiter(out.record)) return std::nullopt;
    out.record_ends = true;
  }
  out.end = static_cast<std::size_t>(first - text.data());
  return out;
}

}  // namespace trimloop::iges
