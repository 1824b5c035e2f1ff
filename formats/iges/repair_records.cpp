// Repairs of single parameters: flags that contradict the numbers beside them, counts of strings, small letters.

#include <fmt/format.h>

#include "base/number.h"
#include "formats/iges/repairs.h"
#include "formats/iges/rules.h"

namespace trimloop::iges {

void turn_flag(Repair& r) {
  r.findings([&](const Diagnostic& d) {
    const DirectoryEntry* entry = r.entry(d);
    if (!entry || d.parameter < 1) return;
    // 144: N1 follows from the outer boundary, wherever the finding is.
    const std::size_t index = &r.rule == &rules::e144::flags ? 2 : static_cast<std::size_t>(d.parameter);
    Report ignored;
    const Parameters p = r.file.parameters(*entry, ignored);
    if (index >= p.tokens.size()) return;
    r.parameter(*entry, index, p.tokens[index].text == "1" ? "0" : "1");
  });
}

void correct_parameter(Repair& r) {
  r.findings([&](const Diagnostic& d) {
    const DirectoryEntry* entry = r.entry(d);
    if (!entry || d.parameter < 1) return;
    const auto index = static_cast<std::size_t>(d.parameter);
    if (&r.rule == &rules::e142::flags) return r.parameter(*entry, index, "0");
    constexpr std::size_t count_before_text = 11;  // NC stands that far before its TEXT
    if (index > count_before_text) r.parameter(*entry, index - count_before_text, fmt::format("{}", d.limit));
  });
}

// 'h' of a string's count, exponent letters of reals.
void write_capitals(Repair& r) {
  constexpr std::size_t data_columns = 64;
  r.findings([&](const Diagnostic& d) {
    const DirectoryEntry* entry = r.entry(d);
    if (!entry) return;
    Report ignored;
    const Parameters p = r.file.parameters(*entry, ignored);
    const auto raise = [&](const char* at) {
      const auto position = static_cast<std::size_t>(at - p.joined.data());
      const std::size_t place = place_of(r.cards().parameter.cards, p.first_card, data_columns, position);
      if (place != std::string::npos) r.replace(place, 1, std::string(1, static_cast<char>(*at - 'a' + 'A')), d.entity);
    };
    for (std::size_t i = 1; i < p.tokens.size(); ++i) {
      const Token& token = p.tokens[i];
      if (token.kind == Token::Kind::Hollerith && token.text.data()[-1] == 'h') raise(token.text.data() - 1);
      if (token.kind != Token::Kind::Text || !read_real(token.text)) continue;
      for (const char& c : token.text)
        if (c == 'e' || c == 'd') raise(&c);
    }
  });
}

}  // namespace trimloop::iges
