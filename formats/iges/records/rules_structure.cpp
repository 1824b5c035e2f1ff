#include <fmt/format.h>

#include <algorithm>

#include "formats/iges/records/checks.h"
#include "formats/iges/records/targets.h"
#include "formats/iges/rules.h"

namespace trimloop::iges {
namespace {

void check_null_members(const std::vector<Ref>& members, std::size_t first, TokenReader& in) {
  const auto null = std::find(members.begin(), members.end(), Ref{});
  if (null != members.end())
    in.remark_at(
        first + static_cast<std::size_t>(null - members.begin()), rules::group_null,
        fmt::format("{} of {} members are null", std::count(members.begin(), members.end(), Ref{}), members.size()));
}

}  // namespace

void check(const SubfigureDefinition& r, TokenReader& in) {
  if (r.name.empty()) in.remark_at(2, rules::e308::definition, "a subfigure without a name");
  if (r.members.empty()) in.remark_at(3, rules::e308::definition, "a subfigure without members", 0, 1);
  check_null_members(r.members, 4, in);
}

void check(const ColourDefinition& r, TokenReader& in) {
  const double parts[] = {r.red, r.green, r.blue};
  for (std::size_t i = 0; i < 3; ++i)
    if (!(parts[i] >= 0 && parts[i] <= 100))
      in.remark_at(1 + i, rules::e314::rgb, fmt::format("a colour component of {}, they run from 0 to 100", parts[i]),
                   parts[i], 100);
}

void check(const Associativity& r, TokenReader& in) {
  if (!r.raw.empty()) return;
  if (r.members.empty())
    in.remark_at(1, Severity::Warning, rules::e402::associativity, "a group without members", 0, 1);
  if (r.single_parent && !r.parent) in.remark_at(3, rules::e402::associativity, "the single parent is null");
  check_null_members(r.members, r.single_parent ? 4 : 2, in);
}

namespace {

struct ValueCount {
  int form;
  std::size_t least, most;
};

// Numbers of values that the forms of 406 have (IGES 5.3 4.98 and following); forms not listed take any.
constexpr ValueCount value_counts[] = {{2, 3, 3},  {3, 2, 2},  {5, 5, 5},    {6, 5, 5},  {7, 1, 1},  {8, 1, 1},
                                       {9, 4, 4},  {10, 6, 6}, {13, 2, 3},   {15, 1, 1}, {16, 2, 2}, {17, 2, 2},
                                       {18, 1, 1}, {19, 1, 1}, {20, 1, 1},   {21, 1, 1}, {22, 9, 9}, {26, 3, 3},
                                       {28, 6, 6}, {29, 8, 8}, {30, 14, 14}, {31, 8, 8}};

}  // namespace

void check(const Property& r, TokenReader& in) {
  const auto values = static_cast<std::size_t>(r.value_count);
  const auto row = std::find_if(std::begin(value_counts), std::end(value_counts),
                                [&](const ValueCount& v) { return v.form == in.form(); });
  if (row != std::end(value_counts) && (values < row->least || values > row->most))
    in.remark_at(1, rules::e406::property_count,
                 fmt::format("{} values, form {} has {}", values, in.form(), row->least), static_cast<double>(values),
                 static_cast<double>(row->least));
  constexpr int name_form = 15, drawing_units_form = 17;
  if (in.form() == name_form && r.name.empty())
    in.remark_at(2, rules::e406::property_range, "the name is empty or no string");
  if (in.form() == drawing_units_form && !r.raw.empty()) {
    const NumberText<std::int64_t> unit = read_integer(r.raw[0].text);
    if (!unit || unit.value < 1 || unit.value > 11)
      in.remark_at(2, rules::e406::property_range, fmt::format("unit flag {}, it is 1 to 11", unit.value),
                   static_cast<double>(unit.value), 11);
  }
}

void check(const SubfigureInstance& r, TokenReader& in) {
  require(in, 1, r.definition, subfigure);
  if (r.scale == 0) in.fault_at(5, rules::e408::scale, "the scale is 0", 0, 0);
  if (r.scale < 0)
    in.remark_at(5, Severity::Warning, rules::e408::scale, fmt::format("the scale {} mirrors", r.scale), r.scale, 0);
}

}  // namespace trimloop::iges
