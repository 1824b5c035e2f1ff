#include "base/bytes.h"

#include <algorithm>

namespace trimloop {

LineIndex::LineIndex(std::string_view bytes) : bytes_(bytes) {
  checkpoints_.reserve(bytes.size() / block + 1);
  Checkpoint here{1, 0};
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (starts_line(i)) here = {here.line + 1, i};
    if (i % block == 0) checkpoints_.push_back(here);
  }
  if (checkpoints_.empty()) checkpoints_.push_back(here);
}

// True behind a line end; the first line's start is not asked for.
bool LineIndex::starts_line(std::size_t offset) const {
  if (offset == 0) return false;
  const char before = bytes_[offset - 1];
  return before == '\n' || (before == '\r' && (offset == bytes_.size() || bytes_[offset] != '\n'));
}

LineColumn LineIndex::locate(std::size_t offset) const {
  offset = std::min(offset, bytes_.size());
  const std::size_t index = std::min(offset / block, checkpoints_.size() - 1);
  Checkpoint here = checkpoints_[index];
  for (std::size_t i = index * block + 1; i <= offset; ++i)
    if (starts_line(i)) here = {here.line + 1, i};
  return {here.line, offset - here.start + 1};
}

std::string_view LineIndex::line(std::size_t number) const {
  if (number == 0) return {};
  // The last checkpoint at or before the line's start: the line starts in that block, or is its checkpoint's own line.
  auto after = std::partition_point(checkpoints_.begin(), checkpoints_.end(),
                                    [number](const Checkpoint& c) { return c.line < number; });
  Checkpoint here;
  if (after != checkpoints_.end() && after->line == number) {
    here = *after;
  } else {
    if (after == checkpoints_.begin()) return {};
    here = *(after - 1);
    std::size_t i = static_cast<std::size_t>(after - 1 - checkpoints_.begin()) * block + 1;
    for (; i < bytes_.size() && here.line < number; ++i)
      if (starts_line(i)) here = {here.line + 1, i};
    if (here.line != number) return {};
  }
  const std::size_t end = std::min(bytes_.find_first_of("\r\n", here.start), bytes_.size());
  return bytes_.substr(here.start, end - here.start);
}

std::string printable(std::string_view bytes, std::size_t max_length) {
  constexpr char hex[] = "0123456789ABCDEF";
  std::string out;
  for (char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = byte >= 0x20 && byte < 0x7f;
    if (out.size() + (plain ? 1 : 4) > max_length) return out + "...";
    if (plain) {
      out += c;
    } else {
      out += "\\x";
      out += hex[byte >> 4];
      out += hex[byte & 15];
    }
  }
  return out;
}

}  // namespace trimloop
