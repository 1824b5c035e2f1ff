#include "formats/obj/read.h"

#include <fmt/format.h>

#include <cmath>

#include "base/number.h"

namespace trimloop::obj {

namespace {

std::string_view next_word(std::string_view& line) {
  const std::size_t from = line.find_first_not_of(" \t\r");
  if (from == std::string_view::npos) {
    line = {};
    return {};
  }
  const std::size_t end = std::min(line.find_first_of(" \t\r", from), line.size());
  const std::string_view word = line.substr(from, end - from);
  line.remove_prefix(end);
  return word;
}

// "7", "7/2", "7//3", "-1": an index from 0, or nothing.
bool index_of(std::string_view word, std::size_t positions, std::uint32_t& index) {
  const auto n = read_integer(word.substr(0, word.find('/')));
  if (!n || n.value == 0) return false;
  const std::int64_t i = n.value > 0 ? n.value - 1 : static_cast<std::int64_t>(positions) + n.value;
  if (i < 0 || i >= static_cast<std::int64_t>(positions)) return false;
  index = static_cast<std::uint32_t>(i);
  return true;
}

}  // namespace

Result<Polygons> read(std::string_view text, const Limits& limits) {
  Polygons out;
  std::size_t number = 0;
  const auto bad = [&number](std::string what) {
    return fail(ErrorCode::InvalidArgument, fmt::format("line {}: {}", number, what), static_cast<double>(number));
  };
  while (!text.empty()) {
    ++number;
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    line = line.substr(0, line.find('#'));
    const std::string_view word = next_word(line);
    if (word.empty()) continue;
    if (out.positions.size() + out.corners.size() > limits.list_count)
      return fail(ErrorCode::Limit, "more points and corners than allowed", static_cast<double>(out.positions.size() + out.corners.size()),
                  static_cast<double>(limits.list_count));
    if (word == "v") {
      std::array<double, 3> p{};
      for (double& c : p) {
        const auto value = read_real(next_word(line));
        if (!value || !std::isfinite(value.value)) return bad("a point has three finite numbers");
        c = value.value;
      }
      out.positions.push_back(p);
    } else if (word == "f" || word == "l") {
      std::vector<std::uint32_t> corners;
      for (std::string_view at = next_word(line); !at.empty(); at = next_word(line)) {
        std::uint32_t index = 0;
        if (!index_of(at, out.positions.size(), index)) return bad(fmt::format("\"{}\" is the index of no point", at));
        corners.push_back(index);
      }
      if (word == "f") {
        if (corners.size() < 3) return bad(fmt::format("a face of {} corners", corners.size()));
        out.corners.insert(out.corners.end(), corners.begin(), corners.end());
        out.face_start.push_back(static_cast<std::uint32_t>(out.corners.size()));
      } else {
        for (std::size_t i = 0; i + 1 < corners.size(); ++i) out.lines.push_back({corners[i], corners[i + 1]});
      }
    } else {
      ++out.passed_over;
    }
  }
  return out;
}

}  // namespace trimloop::obj
