#pragma once
// Bytes of a file and places in them. Lines and columns are computed late, only for findings.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace trimloop {

struct LineColumn {
  std::size_t line = 0, column = 0;  // from 1
};

// Index of line starts (LF, CRLF, CR alone), built once in linear time when the first finding needs it.
class LineIndex {
 public:
  explicit LineIndex(std::string_view bytes);
  LineColumn locate(std::size_t offset) const;
  std::string_view line(std::size_t number) const;  // without its line end; empty if there is none

 private:
  std::string_view bytes_;
  std::vector<std::size_t> starts_;
};

// Bytes made safe to print: control and non-ASCII bytes as \xHH, cut to `max_length` with "...".
std::string printable(std::string_view bytes, std::size_t max_length = 120);

}  // namespace trimloop
