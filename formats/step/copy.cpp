#include "formats/step/copy.h"

#include <vector>

#include "base/number.h"
#include "formats/step/strings.h"

namespace trimloop::step {
namespace {

using Kind = Token::Kind;

// A real as it stands; in the one form of the grammar where it has another (".5", "1.D0").
void put_real(std::string& out, std::string_view text, double value) {
  const bool plain = text.find_first_of("eDd") == std::string_view::npos && text.front() != '.' && text.substr(0, 2) != "-." &&
                     text.substr(0, 2) != "+." && text.find('.') != std::string_view::npos && text.back() != 'E';
  out += plain ? std::string(text) : step_real(value);
}

// The token at `i`, which opens nothing.
bool put_plain(std::string& out, const Tape& tape, const Token& t) {
  const std::string_view text = tape.text(t);
  switch (t.kind) {
    case Kind::Unset: out += '$'; return true;
    case Kind::Derived: out += '*'; return true;
    case Kind::Integer: out += text; return true;
    case Kind::Real: put_real(out, text, t.real); return true;
    case Kind::String: out += encode_string(decode_string(text)); return true;
    case Kind::Enumeration: (out += '.') += text; out += '.'; return true;
    case Kind::Binary: (out += '"') += text; out += '"'; return true;
    default: return false;
  }
}

// Tokens from `first` to `end`, separated by commas. Nothing nests on the stack.
bool put_attributes(std::string& out, const Tape& tape, std::uint32_t first, std::uint32_t end, const Rename& rename) {
  struct Open {
    std::uint32_t end = 0;
    bool list = false;
    std::size_t written = 0, left_out = 0;
  };
  std::vector<Open> open{{end, false, 0, 0}};
  std::uint32_t i = first;
  for (;;) {
    while (i >= open.back().end) {
      if (open.size() == 1) return true;
      if (open.back().written == 0 && open.back().left_out > 0) return false;
      out += ')';
      open.pop_back();
    }
    const Token& t = tape[i++];
    Ref to;
    if (t.kind == Kind::Reference) {
      to = rename({t.id});
      if (!to && !open.back().list) return false;
      if (!to) {
        ++open.back().left_out;
        continue;
      }
    }
    if (open.back().written++ > 0) out += ',';
    if (t.kind == Kind::Reference) {
      (out += '#') += std::to_string(to.id);
    } else if (t.kind == Kind::List || t.kind == Kind::Typed) {
      if (t.kind == Kind::Typed) out += tape.text(t);
      out += '(';
      open.push_back({t.end, t.kind == Kind::List, 0, 0});
    } else if (!put_plain(out, tape, t)) {
      return false;
    }
  }
}

}  // namespace

std::optional<std::string> copy(const Tape& tape, const Rename& rename) {
  std::string out;
  const bool complex = tape.parts().size() > 1;
  if (complex) out += '(';
  for (const Tape::Part& part : tape.parts()) {
    (out += part.keyword) += '(';
    if (!put_attributes(out, tape, part.first, part.end, rename)) return std::nullopt;
    out += ')';
  }
  if (complex) out += ')';
  return out;
}

}  // namespace trimloop::step
