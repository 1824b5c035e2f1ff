#pragma once
// Numbers in rows, as spreadsheets and instruments write them: separated by commas, semicolons, tabs or blanks; '#'
// begins a comment; a first line of words is a heading; an empty line ends a block.

#include <string>
#include <string_view>
#include <vector>

#include "base/limits.h"
#include "base/result.h"

namespace trimloop::csv {

struct Block {
  std::size_t columns = 0;
  std::vector<double> values;  // row by row
  std::size_t line = 0;        // of its first row, from 1
  std::size_t rows() const { return columns ? values.size() / columns : 0; }
};

// Blocks with at least one row. A decimal comma is understood where the separator is a semicolon. InvalidArgument names
// the line in text and in `measured`: a field that is no finite number, or a row of another length.
Result<std::vector<Block>> parse(std::string_view text, const Limits&);

}  // namespace trimloop::csv
