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

// Finds line and column of a byte. Lines end with LF, CRLF or CR alone. Built once in linear time when the first finding
// needs it; remembers one checkpoint per block of bytes, so that a file of nothing but line ends, or of one endless line,
// costs little memory and every question a bounded scan.
class LineIndex {
 public:
  explicit LineIndex(std::string_view bytes);
  LineColumn locate(std::size_t offset) const;      // an offset past the end counts as the end
  std::string_view line(std::size_t number) const;  // without its line end; empty if there is none

 private:
  struct Checkpoint {
    std::size_t line = 0, start = 0;  // the line that holds the block's first byte, and where that line starts
  };
  static constexpr std::size_t block = 4096;
  bool starts_line(std::size_t offset) const;

  std::string_view bytes_;
  std::vector<Checkpoint> checkpoints_;
};

// Bytes made safe to print: control and non-ASCII bytes as \xHH, cut to `max_length` with "...".
std::string printable(std::string_view bytes, std::size_t max_length = 120);

}  // namespace trimloop
