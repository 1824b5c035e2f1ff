#include <fmt/format.h>

#include <cmath>

#include "formats/iges/records/checks.h"
#include "formats/iges/rules.h"

namespace trimloop::iges {
namespace {

// ---- 150-168: sizes and axes

void check_positive(const TableRecord& r, TokenReader& in, std::initializer_list<std::string_view> names) {
  std::size_t parameter = 0;
  for (const std::string_view name : names) {
    ++parameter;
    const double value = r.real(name);
    if (!(value > 0) || !std::isfinite(value))
      in.fault_at(parameter, rules::e150::size, fmt::format("{} is {}, it must be positive", name, value), value, 0);
  }
}

void check_at_most(const TableRecord& r, TokenReader& in, std::string_view less, std::string_view more, bool equal) {
  const double a = r.real(less), b = r.real(more);
  if (in.ok() && !(equal ? a <= b : a < b))
    in.fault_at(2, rules::e150::size, fmt::format("{} {} must be {} {} {}", less, a, equal ? "at most" : "below", more, b),
                a, b);
}

void check_axes(const TableRecord& r, TokenReader& in, bool two) {
  constexpr double right_angle = 1e-4;
  const Xyz a = two ? r.xyz("I1", "J1", "K1") : Xyz{1, 0, 0}, b = two ? r.xyz("I2", "J2", "K2") : r.xyz("I1", "J1", "K1");
  const double la = std::hypot(a.x, a.y, a.z), lb = std::hypot(b.x, b.y, b.z);
  const std::size_t last = r.values.size();
  if (!(la > 0) || !(lb > 0) || !std::isfinite(la + lb)) {
    in.fault_at(last, rules::e150::axes, "an axis of the primitive has no direction", std::min(la, lb), 0);
    return;
  }
  const double cosine = std::abs(a.x * b.x + a.y * b.y + a.z * b.z) / la / lb;
  if (two && cosine > right_angle)
    in.remark_at(last, rules::e150::axes, "the axes of the primitive are not at right angles", cosine, right_angle);
}

void check_primitive(const TableRecord& r, TokenReader& in) {
  switch (r.layout->type) {
    case 150:
      check_positive(r, in, {"LX", "LY", "LZ"});
      return check_axes(r, in, true);
    case 152:
      check_positive(r, in, {"LX", "LY", "LZ"});
      if (r.real("LTX") < 0) in.fault_at(4, rules::e150::size, "LTX is negative", r.real("LTX"), 0);
      check_at_most(r, in, "LTX", "LX", false);
      return check_axes(r, in, true);
    case 154:
      check_positive(r, in, {"H", "R"});
      return check_axes(r, in, false);
    case 156:
      check_positive(r, in, {"H", "R1"});
      if (r.real("R2") < 0) in.fault_at(3, rules::e150::size, "R2 is negative", r.real("R2"), 0);
      check_at_most(r, in, "R2", "R1", true);
      return check_axes(r, in, false);
    case 158:
      return check_positive(r, in, {"R"});
    case 160:
      check_positive(r, in, {"R1", "R2"});
      check_at_most(r, in, "R2", "R1", false);
      return check_axes(r, in, false);
    default:  // 168
      check_positive(r, in, {"LX", "LY", "LZ"});
      return check_axes(r, in, true);
  }
}

void check_sweep(const TableRecord& r, TokenReader& in) {
  const bool turned = r.layout->type == 162;
  const double value = r.real(turned ? "F" : "L");
  if (!(value > 0) || (turned && value > 1) || !std::isfinite(value))
    in.fault_at(2, rules::e162::fraction,
                turned ? fmt::format("a turn of {}, it is above 0 and at most 1", value)
                       : fmt::format("a length of {}, it is above 0", value),
                value, turned ? 1 : 0);
  check_axes(r, in, false);
}

// ---- 180: operands are -DE, operators 1 union, 2 intersection, 3 difference

void check_tree(const TableRecord& r, TokenReader& in) {
  std::size_t depth = 0, parameter = 1;
  for (auto value = r.values.begin() + 1; value != r.values.end(); ++value) {
    ++parameter;
    const Ref* term = std::get_if<Ref>(&*value);
    if (!term) continue;
    if (term->de < 0) {
      const Ref operand{-term->de};
      if (!in.target(operand)) in.remark_at(parameter, rules::dangling, fmt::format("D{} is not in the directory", operand.de));
      ++depth;
    } else if (term->de < 1 || term->de > 3 || depth < 2) {
      return in.fault_at(parameter, rules::e180::postfix,
                         depth < 2 ? fmt::format("operator {} has less than two operands", term->de)
                                   : fmt::format("{} is no operator", term->de),
                         static_cast<double>(term->de), 3);
    } else {
      --depth;
    }
  }
  if (depth != 1)
    in.fault_at(1, rules::e180::postfix, fmt::format("the expression leaves {} operands, there must be one", depth),
                static_cast<double>(depth), 1);
}

// ---- 212, 213

void check_note(const TableRecord& r, TokenReader& in) {
  // All strings have the same width in values, so that one look-up serves all.
  const std::size_t strings = r.count("NS");
  const std::size_t width = strings > 0 ? (r.values.size() - (r.layout->type == 213 ? 11 : 1)) / strings : 0;
  if (width < 12) return;
  const std::size_t first = r.layout->type == 213 ? 11 : 1;
  for (std::size_t i = 0; i < strings; ++i) {
    const std::size_t at = first + i * width, note = at + width - 12;
    const auto* length = std::get_if<std::int64_t>(&r.values[note]);
    const auto* text = std::get_if<std::string>(&r.values[at + width - 1]);
    if (length && text && *length != static_cast<std::int64_t>(text->size()))
      in.remark_at(at + width, rules::e212::text_length,
                   fmt::format("{} characters are declared, the text has {}", *length, text->size()),
                   static_cast<double>(*length), static_cast<double>(text->size()));
    const auto* mirror = std::get_if<std::int64_t>(&r.values[note + 6]);
    const auto* rotate = std::get_if<std::int64_t>(&r.values[note + 7]);
    if ((mirror && (*mirror < 0 || *mirror > 2)) || (rotate && (*rotate < 0 || *rotate > 1)))
      in.remark_at(note + 7, rules::e212::text_codes, "the mirror flag is 0 to 2, the rotate flag 0 or 1");
  }
}

// ---- 412, 414

void check_array(const TableRecord& r, TokenReader& in) {
  const bool rows = r.layout->type == 412;
  const std::int64_t columns = r.integer(rows ? "NC" : "NX"), lines = rows ? r.integer("NR") : 1;
  if (columns < 1 || lines < 1)
    return in.fault_at(rows ? 6 : 2, rules::e412::array, fmt::format("an array of {} x {}", columns, lines),
                       static_cast<double>(std::min(columns, lines)), 1);
  const std::size_t listed = r.count("LC"), first = r.values.size() - listed;
  for (std::size_t i = 0; i < listed; ++i) {
    const auto* number = std::get_if<std::int64_t>(&r.values[first + i]);
    if (number && (*number < 1 || (*number - 1) / lines >= columns))
      in.remark_at(first + i + 1, rules::e412::array, fmt::format("position {} is not in the array", *number),
                   static_cast<double>(*number), static_cast<double>(columns) * static_cast<double>(lines));
  }
}

}  // namespace

void check(const TableRecord& r, TokenReader& in) {
  switch (r.layout->type) {
    case 150: case 152: case 154: case 156: case 158: case 160: case 168: return check_primitive(r, in);
    case 162: case 164: return check_sweep(r, in);
    case 180: return check_tree(r, in);
    case 184:
      if (r.count("N") == 0) in.fault_at(1, rules::e184::assembly, "an assembly of nothing", 0, 1);
      return;
    case 212: case 213: return check_note(r, in);
    case 304:
      if (r.layout->first_form == 2 && r.count("M") == 0) in.remark_at(1, rules::e304::pattern, "a line font without segments", 0, 1);
      return;
    case 404:
      if (r.count("NV") == 0) in.remark_at(1, rules::e404::drawing, "a drawing without views", 0, 1);
      return;
    case 410:
      if (!(r.real("SCALE") > 0)) in.remark_at(2, rules::e410::view, "the scale of the view is not positive", r.real("SCALE"), 0);
      return;
    case 412: case 414: return check_array(r, in);
    case 416:
      if (r.values.empty() || std::get_if<std::string>(&r.values[0])->empty())
        in.remark_at(1, rules::e416::external, "the reference names nothing");
      return;
    default: return;
  }
}

}  // namespace trimloop::iges
