#include "io/step/raw_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "base/bytes.h"
#include "io/step/pmi.h"

namespace trimloop::io {
namespace {

// Not in the table of entities, and written anew all the same: what every product, unit and style needs.
constexpr std::string_view written_anew[] = {"DESIGN_CONTEXT", "DIMENSIONAL_EXPONENTS", "MECHANICAL_CONTEXT", "PRODUCT_CONTEXT",
                                             "PRODUCT_DEFINITION_CONTEXT", "PRODUCT_RELATED_PRODUCT_CATEGORY"};

}  // namespace

bool is_raw(const step::Keyword& keyword) {
  if (keyword.is.test(static_cast<std::size_t>(step::Entity::Document))) return true;
  return keyword.is.none() && !is_pmi(keyword.name) &&
         std::find(std::begin(written_anew), std::end(written_anew), keyword.name) == std::end(written_anew);
}

std::string list_raw_data(const std::map<std::string_view, std::size_t>& count) {
  constexpr std::size_t named = 8;  // a line, not a census: `info` has that
  std::vector<std::pair<std::string_view, std::size_t>> kinds(count.begin(), count.end());
  std::stable_sort(kinds.begin(), kinds.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string out;
  std::size_t others = 0;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    if (k >= named) others += kinds[k].second;
    else out += fmt::format("{}{} {}", k == 0 ? "other data: " : ", ", kinds[k].second, printable(kinds[k].first, 60));
  }
  if (others > 0) out += fmt::format(", {} of {} more kinds", others, kinds.size() - named);
  return out;
}

}  // namespace trimloop::io
