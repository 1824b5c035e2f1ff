#include "formats/step/scan.h"

#include <array>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace trimloop::step {
namespace {

constexpr std::size_t npos = std::string_view::npos;

bool is_special(char c) { return c == ';' || c == '\'' || c == '/' || c == '='; }

// First of ; ' / = at or after `at`. Sixteen bytes at a time: most of a file is none of them.
std::size_t find_special(std::string_view bytes, std::size_t at) {
#if defined(__SSE2__)
  const __m128i semicolon = _mm_set1_epi8(';'), quote = _mm_set1_epi8('\''), slash = _mm_set1_epi8('/'),
                equals = _mm_set1_epi8('=');
  for (; at + 16 <= bytes.size(); at += 16) {
    const __m128i block = _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes.data() + at));
    const __m128i hit = _mm_or_si128(_mm_or_si128(_mm_cmpeq_epi8(block, semicolon), _mm_cmpeq_epi8(block, quote)),
                                     _mm_or_si128(_mm_cmpeq_epi8(block, slash), _mm_cmpeq_epi8(block, equals)));
    const int mask = _mm_movemask_epi8(hit);
    if (mask != 0) return at + static_cast<std::size_t>(__builtin_ctz(static_cast<unsigned>(mask)));
  }
#endif
  while (at < bytes.size() && !is_special(bytes[at])) ++at;
  return at;
}

// The '#' before the '=' at `at` when digits stand between them: the beginning of an instance.
std::size_t instance_start(std::string_view bytes, std::size_t equals, std::size_t not_before) {
  std::size_t at = equals;
  while (at > not_before && is_blank(bytes[at - 1])) --at;
  const std::size_t end = at;
  while (at > not_before && is_digit(bytes[at - 1])) --at;
  return at < end && at > not_before && bytes[at - 1] == '#' ? at - 1 : npos;
}

// "#digits=" on a new line after `at`.
bool instance_follows(std::string_view bytes, std::size_t at) {
  constexpr std::size_t looked_at = 64;
  const std::string_view head = bytes.substr(at, looked_at);
  std::size_t i = 0;
  bool new_line = false;
  for (; i < head.size() && is_blank(head[i]); ++i) new_line = new_line || head[i] == '\n' || head[i] == '\r';
  if (!new_line || i >= head.size() || head[i] != '#') return false;
  const std::size_t first = ++i;
  while (i < head.size() && is_digit(head[i])) ++i;
  if (i == first) return false;
  while (i < head.size() && is_blank(head[i])) ++i;
  return i < head.size() && head[i] == '=';
}

// \S\ before the apostrophe at `at`, and not the end of an escaped backslash.
bool after_page_escape(std::string_view bytes, std::size_t at, std::size_t begin) {
  if (at < begin + 4 || bytes[at - 1] != '\\' || bytes[at - 2] != 'S' || bytes[at - 3] != '\\') return false;
  return at < begin + 5 || bytes[at - 4] != '\\';
}

}  // namespace

std::size_t skip_blanks(std::string_view bytes, std::size_t at, bool* open_comment) {
  for (;;) {
    while (at < bytes.size() && is_blank(bytes[at])) ++at;
    if (at + 1 >= bytes.size() || bytes[at] != '/' || bytes[at + 1] != '*') return at;
    const std::size_t end = bytes.find("*/", at + 2);
    if (end == npos) {
      if (open_comment) *open_comment = true;
      return bytes.size();
    }
    at = end + 2;
  }
}

std::size_t end_of_string(std::string_view bytes, std::size_t begin) {
  std::size_t at = begin + 1;
  for (;;) {
    at = bytes.find('\'', at);
    if (at == npos) return npos;
    const bool doubled = at + 1 < bytes.size() && bytes[at + 1] == '\'';
    if (doubled) {
      at += 2;
    } else if (after_page_escape(bytes, at, begin) && at + 1 < bytes.size() && bytes[at + 1] != ',' && bytes[at + 1] != ')') {
      ++at;
    } else {
      return at;
    }
  }
}

StatementEnd find_statement_end(std::string_view bytes, std::size_t at) {
  using Kind = StatementEnd::Kind;
  const std::size_t begin = at;
  for (;;) {
    at = find_special(bytes, at);
    if (at >= bytes.size()) return {Kind::EndOfFile, bytes.size(), bytes.size()};
    switch (bytes[at]) {
      case ';': return {Kind::Semicolon, at, at + 1};
      case '\'': {
        const std::size_t end = end_of_string(bytes, at);
        // A string with a ';' in it, after which another instance begins on a new line, is one that was not closed.
        const std::string_view inside = bytes.substr(at, (end == npos ? bytes.size() : end) - at);
        for (std::size_t semicolon = inside.find(';'); semicolon != npos; semicolon = inside.find(';', semicolon + 1)) {
          if (instance_follows(bytes, at + semicolon + 1)) return {Kind::OpenString, at, at + semicolon + 1};
        }
        if (end == npos) return {Kind::EndOfFile, at, bytes.size()};
        at = end + 1;
        break;
      }
      case '/': {
        if (at + 1 >= bytes.size() || bytes[at + 1] != '*') {
          ++at;
          break;
        }
        const std::size_t end = bytes.find("*/", at + 2);
        if (end == npos) return {Kind::OpenComment, at, bytes.size()};
        at = end + 2;
        break;
      }
      default: {
        const std::size_t next = instance_start(bytes, at, begin);
        if (next != npos) return {Kind::NextInstance, next, next};
        ++at;
      }
    }
  }
}

}  // namespace trimloop::step
