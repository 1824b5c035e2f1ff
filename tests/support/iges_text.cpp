#include "tests/support/iges_text.h"

#include <cctype>
#include <cstdio>

namespace trimloop::test {
namespace {

std::string right(long long value, int width) {
  char text[32];
  std::snprintf(text, sizeof text, "%*lld", width, value);
  return text;
}

std::string left(std::string_view text, std::size_t width) {
  std::string out(text.substr(0, width));
  out.resize(width, ' ');
  return out;
}

// Length of the parameter at the start of `text`, its delimiter included; a Hollerith string is one piece.
std::size_t parameter_length(std::string_view text, char delimiter) {
  std::size_t digits = 0;
  while (digits < text.size() && std::isdigit(static_cast<unsigned char>(text[digits]))) ++digits;
  std::size_t from = 0;
  if (digits > 0 && digits < 10 && digits < text.size() && text[digits] == 'H')
    from = digits + 1 + std::stoul(std::string(text.substr(0, digits)));
  const std::size_t end = text.find(delimiter, std::min(from, text.size()));
  return end == std::string_view::npos ? text.size() : end + 1;
}

// Packs a record into pieces of at most `width` columns; only what is longer than a card is cut.
std::vector<std::string> wrap(std::string_view record, char delimiter, std::size_t width) {
  std::vector<std::string> lines(1);
  while (!record.empty()) {
    std::size_t length = parameter_length(record, delimiter);
    if (lines.back().size() + length > width && !lines.back().empty()) lines.emplace_back();
    while (length > width) {
      lines.back() = record.substr(0, width);
      lines.emplace_back();
      record.remove_prefix(width);
      length -= width;
    }
    lines.back() += record.substr(0, length);
    record.remove_prefix(length);
  }
  return lines;
}

}  // namespace

std::string iges_card(std::string_view data, char section, std::size_t sequence) {
  return left(data, 72) + section + right(static_cast<long long>(sequence), 7);
}

std::string join_cards(const std::vector<std::string>& cards, std::string_view line_end) {
  std::string out;
  for (const std::string& card : cards) (out += card) += line_end;
  return out;
}

std::string hollerith(std::string_view text) { return std::to_string(text.size()) + "H" + std::string(text); }

int IgesText::add(IgesEntity entity) {
  entities.push_back(std::move(entity));
  return static_cast<int>(entities.size()) * 2 - 1;
}

int IgesText::add(int type, std::string_view parameters, IgesOptions options, std::initializer_list<int> pointers) {
  std::string text(parameters);
  for (int pointer : pointers)
    if (const std::size_t at = text.find("{}"); at != std::string::npos) text.replace(at, 2, std::to_string(pointer));
  IgesEntity entity;
  entity.type = type;
  entity.parameters = std::move(text);
  entity.form = options.form;
  entity.status = options.status;
  entity.transform = options.transform;
  entity.colour = options.colour;
  entity.level = options.level;
  entity.label = options.label;
  return add(std::move(entity));
}

std::vector<std::string> IgesText::cards() const {
  std::vector<std::string> s, g, d, p;
  for (const std::string& line : start) s.push_back(iges_card(line, 'S', s.size() + 1));

  const char pd = parameter_delimiter, rd = record_delimiter;
  std::string record = std::string("1H") + pd + pd + "1H" + rd + pd + global + rd;
  for (const std::string& line : wrap(record, pd, 72)) g.push_back(iges_card(line, 'G', g.size() + 1));

  for (const IgesEntity& e : entities) {
    const long long de = static_cast<long long>(d.size()) + 1, first = static_cast<long long>(p.size()) + 1;
    record = std::to_string(e.type) + pd + e.parameters + rd + e.comment;
    for (const std::string& line : wrap(record, pd, 64))
      p.push_back(iges_card(left(line, 64) + right(de, 8), 'P', p.size() + 1));
    const long long count = static_cast<long long>(p.size()) + 1 - first;
    d.push_back(iges_card(right(e.type, 8) + right(first, 8) + right(0, 8) + right(e.line_font, 8) + right(e.level, 8) +
                              right(e.view, 8) + right(e.transform, 8) + right(0, 8) + left(e.status, 8),
                          'D', d.size() + 1));
    d.push_back(iges_card(right(e.type, 8) + right(e.line_weight, 8) + right(e.colour, 8) + right(count, 8) +
                              right(e.form, 8) + left("", 16) +
                              std::string(8 - std::min<std::size_t>(8, e.label.size()), ' ') + e.label.substr(0, 8) +
                              right(0, 8),
                          'D', d.size() + 1));
  }

  std::vector<std::string> all;
  for (const auto* section : {&s, &g, &d, &p}) all.insert(all.end(), section->begin(), section->end());
  const auto count = [](char letter, std::size_t n) { return letter + right(static_cast<long long>(n), 7); };
  all.push_back(
      iges_card(count('S', s.size()) + count('G', g.size()) + count('D', d.size()) + count('P', p.size()), 'T', 1));
  return all;
}

std::string IgesText::text(std::string_view line_end) const { return join_cards(cards(), line_end); }

}  // namespace trimloop::test
