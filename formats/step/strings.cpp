#include "formats/step/strings.h"

#include <cstdint>
#include <optional>

#include "formats/step/latin_pages.h"

namespace trimloop::step {

namespace {

constexpr char32_t replacement = 0xFFFD;

void append_utf8(std::string& out, char32_t c) {
  const auto put = [&](char32_t byte) { out += static_cast<char>(byte); };
  if (c < 0x80) {
    put(c);
  } else if (c < 0x800) {
    put(0xC0 | c >> 6), put(0x80 | (c & 0x3F));
  } else if (c < 0x10000) {
    put(0xE0 | c >> 12), put(0x80 | (c >> 6 & 0x3F)), put(0x80 | (c & 0x3F));
  } else {
    put(0xF0 | c >> 18), put(0x80 | (c >> 12 & 0x3F)), put(0x80 | (c >> 6 & 0x3F)), put(0x80 | (c & 0x3F));
  }
}

// The scalar that begins at `text[at]` and its length; length 0 when the bytes there are not valid UTF-8.
struct Scalar {
  char32_t value = 0;
  std::size_t length = 0;
};
Scalar scalar_at(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[at + i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return {first, 1};
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || length > text.size() - at) return {};
  char32_t value = first & (0xFF >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {};
    value = value << 6 | (byte(i) & 0x3F);
  }
  constexpr char32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  if (value < least[length] || value > 0x10FFFF || (value >= 0xD800 && value <= 0xDFFF)) return {};
  return {value, length};
}

// `count` hexadecimal digits; small letters are read too.
std::optional<char32_t> hex(std::string_view text, std::size_t at, std::size_t count) {
  if (at > text.size() || count > text.size() - at) return std::nullopt;
  std::uint64_t value = 0;
  for (std::size_t i = at; i < at + count; ++i) {
    const char c = text[i];
    const int digit = c >= '0' && c <= '9' ? c - '0' : c >= 'A' && c <= 'F' ? c - 'A' + 10 : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
    if (digit < 0) return std::nullopt;
    value = value << 4 | static_cast<unsigned>(digit);
  }
  return static_cast<char32_t>(value);
}

void note(std::size_t& place, std::size_t at) {
  if (place == StringFaults::nowhere) place = at;
}

// Control bytes stand anywhere in a file, between the characters of a string too, and mean nothing.
std::string without_controls(std::string_view raw) {
  std::string out;
  for (const char c : raw) {
    if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7F) out += c;
  }
  return out;
}

class Decoder {
 public:
  Decoder(std::string_view raw, StringFaults& faults) : raw_(raw), faults_(faults) {}

  std::string run() {
    while (at_ < raw_.size()) {
      const char c = raw_[at_];
      if (c == '\'') {
        out_ += c;
        at_ += raw_.substr(at_ + 1, 1) == "'" ? 2 : 1;
      } else if (c == '\\') {
        if (!escape()) {
          note(faults_.escape, at_);
          out_ += raw_[at_++];
        }
      } else if (static_cast<unsigned char>(c) >= 0x80) {
        raw_bytes();
      } else {
        out_ += raw_[at_++];
      }
    }
    return std::move(out_);
  }

 private:
  bool follows(std::string_view what) const { return raw_.substr(at_, what.size()) == what; }

  // What stands here beginning with a backslash; false when it is no escape.
  bool escape() {
    if (follows("\\\\")) return take(2, '\\');
    if (follows("\\N\\")) return take(3, '\n');
    if (follows("\\F\\")) return take(3, '\f');
    if (follows("\\S\\")) return page_character();
    if (follows("\\P") && raw_.size() - at_ >= 4 && raw_[at_ + 3] == '\\' && raw_[at_ + 2] >= 'A' && raw_[at_ + 2] <= 'I') {
      page_ = raw_[at_ + 2] - 'A';
      at_ += 4;
      return true;
    }
    if (follows("\\X2\\")) return run_of(4);
    if (follows("\\X4\\")) return run_of(8);
    if (follows("\\X\\")) {
      const auto value = hex(raw_, at_ + 3, 2);
      return value && take(5, *value);
    }
    if (follows("\\X0\\")) {  // the end of a run that never began
      note(faults_.escape, at_);
      at_ += 4;
      return true;
    }
    return false;
  }

  bool take(std::size_t length, char32_t value) {
    append_utf8(out_, value);
    at_ += length;
    return true;
  }

  // \S\c: 128 is added to c. An apostrophe is doubled as everywhere.
  bool page_character() {
    if (raw_.size() - at_ < 4) return false;
    const unsigned char c = static_cast<unsigned char>(raw_[at_ + 3]);
    if (c < 0x20 || c > 0x7E) return false;
    const bool doubled = c == '\'' && raw_.substr(at_ + 4, 1) == "'";
    const char32_t value = page_ == 0 ? c + 0x80u : latin_pages[page_ - 1][c - 0x20];
    return take(doubled ? 5 : 4, value);
  }

  // Groups of `digits` up to \X0\. A run without its end goes to the last whole group.
  bool run_of(std::size_t digits) {
    const std::size_t begin = at_;
    at_ += 4;
    char32_t high = 0;
    const auto drop_high = [&] {
      if (high) note(faults_.surrogate, begin), append_utf8(out_, replacement);
      high = 0;
    };
    while (const auto group = hex(raw_, at_, digits)) {
      at_ += digits;
      char32_t value = *group;
      const bool low = value >= 0xDC00 && value <= 0xDFFF;
      if (digits == 4 && low && high) {
        append_utf8(out_, 0x10000 + ((high - 0xD800) << 10) + (value - 0xDC00));
        high = 0;
        continue;
      }
      drop_high();
      if (digits == 4 && value >= 0xD800 && value <= 0xDBFF) {
        high = value;
        continue;
      }
      if (value > 0x10FFFF || (value >= 0xD800 && value <= 0xDFFF)) {
        note(faults_.surrogate, begin);
        value = replacement;
      }
      append_utf8(out_, value);
    }
    drop_high();
    if (follows("\\X0\\")) at_ += 4;
    else note(faults_.escape, begin);
    return true;
  }

  void raw_bytes() {
    note(faults_.raw_byte, at_);
    if (const Scalar s = scalar_at(raw_, at_); s.length) {
      out_ += raw_.substr(at_, s.length);
      at_ += s.length;
    } else {
      take(1, static_cast<unsigned char>(raw_[at_]));
    }
  }

  std::string_view raw_;
  StringFaults& faults_;
  std::string out_;
  std::size_t at_ = 0;
  int page_ = 0;
};

void append_hex(std::string& out, char32_t value, int digits) {
  for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4) out += "0123456789ABCDEF"[value >> shift & 0xF];
}

}  // namespace

std::string decode_string(std::string_view raw, StringFaults* faults) {
  StringFaults ignored;
  StringFaults& met = faults ? *faults : ignored;
  met = {};
  bool plain = true, controls = false;
  for (const char c : raw) {
    const unsigned char byte = static_cast<unsigned char>(c);
    plain = plain && byte >= 0x20 && byte < 0x7F && c != '\'' && c != '\\';
    controls = controls || byte < 0x20 || byte == 0x7F;
  }
  if (plain) return std::string(raw);
  if (!controls) return Decoder(raw, met).run();
  const std::string cleaned = without_controls(raw);  // offsets of faults then count in the cleaned text
  return Decoder(cleaned, met).run();
}

std::string encode_string(std::string_view utf8) {
  std::string out = "'";
  int run = 0;  // digits of the open run: 0, 4 or 8
  const auto change_run = [&](int digits) {
    if (run == digits) return;
    if (run) out += "\\X0\\";
    if (digits) out += digits == 4 ? "\\X2\\" : "\\X4\\";
    run = digits;
  };
  for (std::size_t i = 0; i < utf8.size();) {
    const Scalar s = scalar_at(utf8, i);
    if (s.length == 0) {
      change_run(0);
      out += "\\X\\";
      append_hex(out, static_cast<unsigned char>(utf8[i]), 2);
      ++i;
      continue;
    }
    i += s.length;
    if (s.value >= 0x20 && s.value < 0x7F) {
      change_run(0);
      if (s.value == '\'' || s.value == '\\') out += static_cast<char>(s.value);
      out += static_cast<char>(s.value);
    } else {
      change_run(s.value < 0x10000 ? 4 : 8);
      append_hex(out, s.value, s.value < 0x10000 ? 4 : 8);
    }
  }
  change_run(0);
  return out + "'";
}

}  // namespace trimloop::step
