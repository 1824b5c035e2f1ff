#include "formats/iges/records/table_record.h"

#include <algorithm>
#include <cstdlib>

#include "formats/iges/records/checks.h"
#include "formats/iges/rules.h"

namespace trimloop::iges {
namespace {

// Values that the attribute table definition (322) of a 422 asks for in one row; nothing when there is none.
std::optional<std::size_t> defined_attributes(const TokenReader& in) {
  const DirectoryEntry* definition = in.target(Ref{std::abs(in.entry().structure)});
  if (!definition || definition->type != 322) return std::nullopt;
  Report scratch;  // that record reports for itself
  const Parameters parameters = in.file().parameters(*definition, scratch);
  const auto integer_at = [&](std::size_t i) {
    const bool there = i < parameters.tokens.size() && parameters.tokens[i].kind == Token::Kind::Text;
    return there ? std::max<std::int64_t>(read_integer(parameters.tokens[i].text).value, 0) : 0;
  };
  std::size_t values = 0, next = 4;
  for (std::int64_t i = integer_at(3); i > 0 && next < parameters.tokens.size(); --i) {
    const auto own = static_cast<std::size_t>(integer_at(next + 2));
    if (own > parameters.tokens.size() && own > in.left()) return std::nullopt;
    values += own;
    next += 3 + own * static_cast<std::size_t>(std::clamp(definition->form, 0, 2));
  }
  return values;
}

// Reads one record along its layout.
class Decoder {
 public:
  Decoder(TokenReader& in, const Layout& layout) : in_(in), layout_(layout) {}

  std::vector<TableRecord::Value> decode() {
    constexpr int attribute_table_instance = 422;
    if (layout_.type == attribute_table_instance) {
      const std::optional<std::size_t> defined = defined_attributes(in_);
      if (!defined) {
        in_.fault_at(0, rules::e322::attribute, "the attribute table definition (322) that counts the values is not there");
        return {};
      }
      integers_.emplace_back("ATTRS", static_cast<std::int64_t>(*defined));
    }
    find_tail();
    nodes(layout_.nodes);
    return std::move(values_);
  }

 private:
  static constexpr std::size_t unbounded = SIZE_MAX;

  void nodes(const std::vector<LayoutNode>& list) {
    for (std::size_t i = 0; i < list.size() && in_.ok(); ++i) {
      const LayoutNode& node = list[i];
      switch (node.kind) {
        case LayoutNode::Kind::Field:
          if (&list == &layout_.nodes && i == tail_from_) in_.optional_tail(tail_fields_);
          field(node, list, i);
          break;
        case LayoutNode::Kind::List: {
          const std::size_t groups = count_of(node);
          // Values that are left out of a bounded list are left out of its record.
          if (!in_.room(std::min(room_, std::max<std::size_t>(node.least_width, 1) * groups))) return;
          for (std::size_t g = 0; g < groups && in_.ok() && room_ > 0; ++g) {
            const std::size_t before = in_.position();
            nodes(node.inside);
            if (in_.position() == before) break;  // groups of nothing
          }
          break;
        }
        case LayoutNode::Kind::Values: {
          room_ = count_of(node);
          if (!in_.room(room_)) return;
          nodes(node.inside);
          for (; room_ > 0 && in_.ok(); --room_) values_.emplace_back(in_.field());
          room_ = unbounded;
          break;
        }
        case LayoutNode::Kind::Choice:
          if (integer(node.name) == node.equals) nodes(node.inside);
          break;
      }
    }
  }

  // Fields with defaults at the record's end may be left out: the pointer groups can start where they would stand.
  // Where they begin, and how many they are without the lists that they count.
  void find_tail() {
    const std::vector<LayoutNode>& all = layout_.nodes;
    while (tail_from_ > 0) {
      const LayoutNode& node = all[tail_from_ - 1];
      const bool field = node.kind == LayoutNode::Kind::Field;
      if (field && !node.has_default) break;
      --tail_from_;
      tail_fields_ += field;
    }
    // A list counted by a field before the tail belongs there.
    while (tail_from_ < all.size() && all[tail_from_].kind != LayoutNode::Kind::Field) ++tail_from_;
  }

  void field(const LayoutNode& node, const std::vector<LayoutNode>& list, std::size_t at) {
    if (room_ != unbounded) {
      if (room_ == 0) return;  // fewer values than the form has (IG-E406-01)
      --room_;
      bounded_field(node);
      return;
    }
    switch (node.type) {
      case 'r':
        values_.emplace_back(node.has_default ? in_.real_or(fallback_real(node)) : in_.real());
        break;
      case 'i':
        keep(node, node.has_default ? in_.integer_or(fallback_integer(node)) : in_.integer());
        break;
      case 'n':
        keep(node, node.has_default ? in_.integer_or(fallback_integer(node)) : counted(node, list, at));
        break;
      case 'l':
        keep(node, in_.logical() ? 1 : 0);
        break;
      case 's':
        values_.emplace_back(in_.string_or({}));
        break;
      case 'p':
        values_.emplace_back(in_.ref());
        break;
      case 'P':
        values_.emplace_back(node.has_default ? Ref{static_cast<std::int32_t>(clamped(in_.integer_or(fallback_integer(node))))}
                                              : in_.signed_ref());
        break;
      default:
        values_.emplace_back(in_.field());
        break;
    }
  }

  // One of the values of a property: kept as it stands, integers remembered for the lists that they count.
  void bounded_field(const LayoutNode& node) {
    Field field = in_.field();
    if (node.type == 'n' || node.type == 'i') {
      const NumberText<std::int64_t> number = read_integer(field.text);
      remember(node.name, number && field.kind == Token::Kind::Text ? number.value : 0);
    }
    values_.emplace_back(std::move(field));
  }

  std::int64_t counted(const LayoutNode& node, const std::vector<LayoutNode>& list, std::size_t at) {
    // What the count needs at least: the groups of the lists that it alone counts.
    std::size_t each = 0;
    for (std::size_t i = at + 1; i < list.size(); ++i) {
      const LayoutNode& l = list[i];
      if (l.kind != LayoutNode::Kind::List && l.kind != LayoutNode::Kind::Values) continue;
      if (l.count.size() == 1 && l.count[0].name == node.name) each += l.least_width;
    }
    return static_cast<std::int64_t>(in_.count(each));
  }

  static std::int64_t clamped(std::int64_t v) { return std::clamp<std::int64_t>(v, INT32_MIN, INT32_MAX); }
  static double fallback_real(const LayoutNode& node) { return read_real(node.fallback).value; }
  static std::int64_t fallback_integer(const LayoutNode& node) { return read_integer(node.fallback).value; }

  void keep(const LayoutNode& node, std::int64_t value) {
    remember(node.name, value);
    values_.emplace_back(value);
  }
  void remember(std::string_view name, std::int64_t value) {
    const auto same = std::find_if(integers_.begin(), integers_.end(), [&](const auto& i) { return i.first == name; });
    if (same != integers_.end())
      same->second = value;
    else
      integers_.emplace_back(name, value);
  }
  std::int64_t integer(std::string_view name) const {
    const auto found = std::find_if(integers_.begin(), integers_.end(), [&](const auto& i) { return i.first == name; });
    return found == integers_.end() ? 0 : found->second;
  }
  std::size_t count_of(const LayoutNode& node) const {
    std::size_t sum = 0;
    for (const LayoutTerm& t : node.count) {
      const std::int64_t v = t.name.empty() ? t.number : integer(t.name);
      sum += v > 0 ? std::min(static_cast<std::size_t>(v), std::size_t{1} << 40) : 0;
    }
    return sum;
  }

  TokenReader& in_;
  const Layout& layout_;
  std::vector<TableRecord::Value> values_;
  std::vector<std::pair<std::string_view, std::int64_t>> integers_;
  std::size_t room_ = unbounded;           // values left in a bounded list
  std::size_t tail_from_ = layout_.nodes.size(), tail_fields_ = 0;
};

}  // namespace

TableRecord TableRecord::read(TokenReader& in, const Layout& layout) {
  return checked(TableRecord{&layout, Decoder(in, layout).decode()}, in);
}

void TableRecord::write(TokenWriter& out) const {
  for (const Value& value : values) {
    if (const auto* integer = std::get_if<std::int64_t>(&value)) out.integer(*integer);
    if (const auto* real = std::get_if<double>(&value)) out.real(*real);
    if (const auto* string = std::get_if<std::string>(&value)) out.string(*string);
    if (const auto* ref = std::get_if<Ref>(&value)) out.ref(*ref);
    if (const auto* field = std::get_if<Field>(&value)) out.field(*field);
  }
}

const TableRecord::Value* TableRecord::find(std::string_view name, std::initializer_list<std::size_t> at) const {
  const auto integer_at = [this](std::size_t index) -> std::optional<std::int64_t> {
    if (index == 0 || index > values.size()) return std::nullopt;
    if (const auto* integer = std::get_if<std::int64_t>(&values[index - 1])) return *integer;
    if (const auto* field = std::get_if<Field>(&values[index - 1]))
      if (const auto number = read_integer(field->text); number && field->kind == Token::Kind::Text) return number.value;
    return std::nullopt;
  };
  if (!layout) return nullptr;
  const std::size_t index = LayoutWalk(*layout, values.size(), integer_at).find(name, at);
  return index == 0 || index > values.size() ? nullptr : &values[index - 1];
}

double TableRecord::real(std::string_view name, std::initializer_list<std::size_t> at) const {
  const Value* value = find(name, at);
  if (!value) return 0;
  if (const auto* real = std::get_if<double>(value)) return *real;
  if (const auto* field = std::get_if<Field>(value)) return read_real(field->text).value;
  return 0;
}

std::int64_t TableRecord::integer(std::string_view name, std::initializer_list<std::size_t> at) const {
  const Value* value = find(name, at);
  if (!value) return 0;
  if (const auto* integer = std::get_if<std::int64_t>(value)) return *integer;
  if (const auto* field = std::get_if<Field>(value)) return read_integer(field->text).value;
  return 0;
}

Ref TableRecord::ref(std::string_view name, std::initializer_list<std::size_t> at) const {
  const Value* value = find(name, at);
  const auto* ref = value ? std::get_if<Ref>(value) : nullptr;
  return ref ? *ref : Ref{};
}

std::string_view TableRecord::string(std::string_view name, std::initializer_list<std::size_t> at) const {
  const Value* value = find(name, at);
  if (!value) return {};
  if (const auto* string = std::get_if<std::string>(value)) return *string;
  const auto* field = std::get_if<Field>(value);
  return field ? std::string_view(field->text) : std::string_view();
}

std::size_t TableRecord::count(std::string_view name) const {
  const std::int64_t n = integer(name);
  return n > 0 ? std::min(static_cast<std::size_t>(n), values.size()) : 0;
}

std::vector<Ref> pointers(const TableRecord& record) {
  std::vector<Ref> out;
  for (const TableRecord::Value& value : record.values)
    if (const auto* ref = std::get_if<Ref>(&value); ref && *ref) out.push_back({std::abs(ref->de)});
  return out;
}

}  // namespace trimloop::iges
