#include "formats/csv/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number.h"

namespace trimloop::csv {

namespace {

std::string_view trimmed(std::string_view s) {
  const std::size_t from = s.find_first_not_of(" \t\r");
  if (from == std::string_view::npos) return {};
  return s.substr(from, s.find_last_not_of(" \t\r") - from + 1);
}

char separator(std::string_view line) {
  for (const char c : {';', '\t', ','})
    if (line.find(c) != std::string_view::npos) return c;
  return ' ';
}

std::vector<std::string> fields(std::string_view line) {
  const char by = separator(line);
  std::vector<std::string> out;
  while (true) {
    const std::size_t end = by == ' ' ? line.find_first_of(" \t") : line.find(by);
    std::string field(trimmed(line.substr(0, end)));
    if (by == ';') std::replace(field.begin(), field.end(), ',', '.');
    out.push_back(std::move(field));
    if (end == std::string_view::npos) return out;
    line.remove_prefix(end + 1);
    if (by == ' ') line = trimmed(line);
  }
}

}  // namespace

Result<std::vector<Block>> parse(std::string_view text, const Limits& limits) {
  std::vector<Block> blocks;
  bool open = false, heading_allowed = true;
  std::size_t number = 0, count = 0;
  while (!text.empty()) {
    ++number;
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const bool comment = line.find('#') != std::string_view::npos;
    line = trimmed(line.substr(0, line.find('#')));
    if (line.empty()) {
      if (!comment) open = false;
      continue;
    }
    const std::vector<std::string> row = fields(line);
    std::vector<double> values;
    for (const std::string& field : row) {
      const auto value = read_real(field);
      if (!value || !std::isfinite(value.value)) break;
      values.push_back(value.value);
    }
    if (values.empty() && heading_allowed) {
      heading_allowed = false;
      continue;
    }
    heading_allowed = false;
    if (values.size() != row.size())
      return fail(ErrorCode::InvalidArgument, fmt::format("line {}: \"{}\" is no number", number, row[values.size()]), static_cast<double>(number));
    if (!open) blocks.push_back({row.size(), {}, number});
    open = true;
    Block& block = blocks.back();
    if (row.size() != block.columns)
      return fail(ErrorCode::InvalidArgument, fmt::format("line {} has {} numbers, the rows above have {}", number, row.size(), block.columns),
                  static_cast<double>(number), static_cast<double>(block.columns));
    count += values.size();
    if (count > limits.list_count)
      return fail(ErrorCode::Limit, "more numbers than allowed", static_cast<double>(count), static_cast<double>(limits.list_count));
    block.values.insert(block.values.end(), values.begin(), values.end());
  }
  return blocks;
}

}  // namespace trimloop::csv
