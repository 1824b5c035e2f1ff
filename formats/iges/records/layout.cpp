#include "formats/iges/records/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/assert.h"
#include "base/number.h"

namespace trimloop::iges {
namespace {

bool is_name(char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; }

class Compiler {
 public:
  explicit Compiler(std::string_view text) : text_(text) {}

  std::vector<LayoutNode> layout(char closing) {
    std::vector<LayoutNode> out;
    for (skip(); at_ < text_.size() && text_[at_] != closing; skip()) out.push_back(node());
    if (closing != '\0') expect(closing);
    return out;
  }

 private:
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  bool accept(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) { TRIMLOOP_ASSERT(accept(c), "a layout keeps to its grammar"); }
  void skip() {
    while (peek() == ' ') ++at_;
  }
  std::string_view word() {
    const std::size_t from = at_;
    while (is_name(peek())) ++at_;
    TRIMLOOP_ASSERT(at_ > from, "a layout has a name or number here");
    return text_.substr(from, at_ - from);
  }
  LayoutTerm term() {
    const std::string_view text = word();
    const NumberText<std::int64_t> number = read_integer(text);
    return number ? LayoutTerm{{}, number.value} : LayoutTerm{text, 0};
  }

  LayoutNode node() {
    LayoutNode out;
    const LayoutTerm first = term();
    if (accept(':')) {
      out.name = first.name;
      out.type = text_[at_++];
      out.has_default = accept('=');
      const std::size_t from = at_;
      while (out.has_default && peek() != ' ' && peek() != ')' && peek() != ']' && peek() != '\0') ++at_;
      out.fallback = text_.substr(from, at_ - from);
      return out;
    }
    if (accept('=')) {
      out.kind = LayoutNode::Kind::Choice;
      out.name = first.name;
      out.equals = term().number;
      expect('?');
      expect('(');
      out.inside = layout(')');
      return out;
    }
    out.count.push_back(first);
    while (accept('+')) out.count.push_back(term());
    expect('*');
    if (accept('[')) {
      out.kind = LayoutNode::Kind::Values;
      out.inside = layout(']');
      out.width = out.least_width = 1;
      return out;
    }
    out.kind = LayoutNode::Kind::List;
    out.inner_first = accept('~');
    if (accept('@')) {
      out.first_negative = accept('-');
      out.first = term();
    }
    expect('(');
    out.inside = layout(')');
    measure(out);
    return out;
  }

  static void measure(LayoutNode& list) {
    bool fixed = true;
    for (const LayoutNode& n : list.inside) {
      if (n.kind == LayoutNode::Kind::Field)
        ++list.least_width;
      else
        fixed = false;
    }
    if (fixed) list.width = list.least_width;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<LayoutNode> compile_layout(std::string_view text) { return Compiler(text).layout('\0'); }

// What a walk is after: the name of a parameter, the parameter of a name, or the end.
struct LayoutWalk::Wanted {
  std::size_t index = 0;  // of the parameter to be named
  std::string_view name;  // of the field to be found ...
  std::span<const std::size_t> at;  // ... under these indices, each from 1
  std::string found_name;
  std::size_t found_index = 0;
  bool found = false;
  std::vector<std::string>* all = nullptr;  // takes the names of all parameters
  std::string* kinds = nullptr;             // takes their letters
  bool everything() const { return all || kinds; }
};

LayoutWalk::LayoutWalk(const Layout& layout, std::size_t parameters, IntegerAt integer_at)
    : layout_(layout), parameters_(parameters), integer_at_(std::move(integer_at)) {}

std::optional<std::int64_t> LayoutWalk::value(const LayoutTerm& term) const {
  if (term.name.empty()) return term.number;
  const auto last = std::find_if(integers_.rbegin(), integers_.rend(), [&](const auto& i) { return i.first == term.name; });
  return last == integers_.rend() ? std::nullopt : last->second;
}

// Nothing when a term is unknown, negative or counts more than the record holds.
std::optional<std::size_t> LayoutWalk::count_of(const LayoutNode& node) const {
  std::size_t sum = 0;
  for (const LayoutTerm& t : node.count) {
    const std::optional<std::int64_t> v = value(t);
    if (!v || *v < 0 || (!t.name.empty() && static_cast<std::uint64_t>(*v) > parameters_)) return std::nullopt;
    sum += static_cast<std::size_t>(*v);
  }
  return sum;
}

void LayoutWalk::take(const LayoutNode& field, std::size_t index) {
  if (field.type != 'n' && field.type != 'i') return;
  std::optional<std::int64_t> v = integer_at_(index);
  if (!v && field.has_default) v = read_integer(field.fallback).value;
  const auto same = std::find_if(integers_.begin(), integers_.end(), [&](const auto& i) { return i.first == field.name; });
  if (same != integers_.end())
    same->second = v;
  else
    integers_.emplace_back(field.name, v);
}

namespace {

std::string indexed(std::string_view name, std::vector<std::int64_t> indices, bool inner_first) {
  if (inner_first) std::reverse(indices.begin(), indices.end());
  return indices.empty() ? std::string(name) : fmt::format("{}({})", name, fmt::join(indices, ","));
}

}  // namespace

// False when the walk is over: found, or something cannot be told.
bool LayoutWalk::walk(const std::vector<LayoutNode>& nodes, Wanted& wanted) {
  for (const LayoutNode& node : nodes) {
    switch (node.kind) {
      case LayoutNode::Kind::Field: {
        const std::size_t index = next_++;
        take(node, index);
        if (wanted.all && index <= parameters_) wanted.all->push_back(indexed(node.name, indices_, inner_first_));
        if (wanted.kinds && index <= parameters_) wanted.kinds->push_back(node.type);
        if (wanted.index == index) wanted.found_name = indexed(node.name, indices_, inner_first_);
        if (wanted.name == node.name && wanted.at.empty()) wanted.found_index = index;
        if (wanted.index == index || wanted.found_index != 0) {
          wanted.found = true;
          return false;
        }
        break;
      }
      case LayoutNode::Kind::List:
        if (!walk_list(node, wanted)) return false;
        break;
      case LayoutNode::Kind::Values:
        if (!walk_values(node, wanted)) return false;
        break;
      case LayoutNode::Kind::Choice: {
        const std::optional<std::int64_t> v = value({node.name, 0});
        if (!v) return false;
        if (*v == node.equals && !walk(node.inside, wanted)) return false;
        break;
      }
    }
  }
  return true;
}

bool LayoutWalk::walk_list(const LayoutNode& node, Wanted& wanted) {
  const std::optional<std::size_t> count = count_of(node);
  const std::optional<std::int64_t> first = value(node.first);
  if (!count || !first) return false;
  const std::int64_t from = node.first_negative ? -*first : *first;
  const auto enter = [&](std::size_t group) { indices_.push_back(from + static_cast<std::int64_t>(group)); };
  const bool by_name = !wanted.name.empty();
  const bool named_here = by_name && !wanted.at.empty();
  // Groups that are not looked into: those before the one wanted, or all of them.
  std::size_t begin = 0, end = *count;
  if (node.width > 0 && !wanted.everything()) {
    const std::size_t start = next_;
    if (by_name && named_here && wanted.at.size() == 1) {
      begin = wanted.at[0] - 1;
      end = begin < *count ? begin + 1 : begin;
    } else if (!by_name && wanted.index >= start && wanted.index < start + *count * node.width) {
      begin = (wanted.index - start) / node.width;
      end = begin + 1;
    } else {
      begin = end = 0;
    }
    const std::span<const std::size_t> outer = wanted.at;
    for (std::size_t group = begin; group < end; ++group) {
      next_ = start + group * node.width;
      enter(group);
      wanted.at = {};
      const bool on = walk(node.inside, wanted);
      indices_.pop_back();
      wanted.at = outer;
      if (!on) return false;
    }
    next_ = start + *count * node.width;
    return true;
  }
  for (std::size_t group = begin; group < end && next_ <= std::max(parameters_, wanted.index); ++group) {
    enter(group);
    const std::span<const std::size_t> outer = wanted.at;
    const bool here = !named_here || outer[0] == group + 1;
    const std::string_view name = wanted.name;
    if (named_here) wanted.at = outer.subspan(1);
    if (!here) wanted.name = "?";  // no field's name
    inner_first_ = node.inner_first;
    const bool on = walk(node.inside, wanted);
    wanted.name = name;
    wanted.at = outer;
    inner_first_ = false;
    indices_.pop_back();
    if (!on) return false;
  }
  return true;
}

bool LayoutWalk::walk_values(const LayoutNode& node, Wanted& wanted) {
  const std::optional<std::size_t> count = count_of(node);
  if (!count) return false;
  const std::size_t end = next_ + *count;
  const std::size_t whole = std::exchange(parameters_, std::min(parameters_, end - 1));
  walk(node.inside, wanted);
  parameters_ = whole;
  if (wanted.everything()) {
    for (std::size_t i = next_; i < end && i <= parameters_; ++i) {
      if (wanted.all) wanted.all->push_back(fmt::format("V({})", i - (end - *count) + 1));
      if (wanted.kinds) wanted.kinds->push_back('t');
    }
    next_ = end;
    return true;
  }
  if (wanted.found && (wanted.found_index >= end || wanted.index >= end)) {
    wanted.found = false;
    wanted.found_index = 0;
    wanted.found_name.clear();
  }
  if (wanted.found) return false;
  if (wanted.index >= next_ && wanted.index < end) {
    wanted.found_name = fmt::format("V({})", wanted.index - (end - *count) + 1);
    wanted.found = true;
    return false;
  }
  next_ = end;
  return true;
}

std::string LayoutWalk::name(std::size_t index) {
  next_ = 1;
  integers_.clear();
  indices_.clear();
  if (index == 0) return {};
  Wanted wanted;
  wanted.index = index;
  walk(layout_.nodes, wanted);
  return std::move(wanted.found_name);
}

std::vector<std::string> LayoutWalk::names() {
  next_ = 1;
  integers_.clear();
  indices_.clear();
  std::vector<std::string> out;
  Wanted wanted;
  wanted.all = &out;
  walk(layout_.nodes, wanted);
  return out;
}

std::string LayoutWalk::kinds() {
  next_ = 1;
  integers_.clear();
  indices_.clear();
  std::string out;
  Wanted wanted;
  wanted.kinds = &out;
  walk(layout_.nodes, wanted);
  return out;
}

std::size_t LayoutWalk::find(std::string_view name, std::initializer_list<std::size_t> at) {
  next_ = 1;
  integers_.clear();
  indices_.clear();
  Wanted wanted;
  wanted.name = name;
  wanted.at = {at.begin(), at.size()};
  walk(layout_.nodes, wanted);
  return wanted.found_index <= parameters_ ? wanted.found_index : 0;
}

std::optional<std::size_t> LayoutWalk::count() {
  next_ = 1;
  integers_.clear();
  indices_.clear();
  Wanted wanted;
  wanted.name = "?";
  if (!walk(layout_.nodes, wanted)) return std::nullopt;
  return next_ - 1;
}

}  // namespace trimloop::iges
