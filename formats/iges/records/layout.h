#pragma once
// What stands where in the parameter data of every entity type and form of IGES 5.3: one table (layouts.cpp) from which
// records without a struct are decoded and encoded, parameters are named and docs/iges-entities.md is written.
//
// A layout is a line of text:
//
//   layout = { field | list | values | choice }
//   field  = NAME ":" kind [ "=" default ]
//   kind   = "r" real | "i" integer | "n" count | "l" logical | "s" string | "p" pointer | "P" integer or -pointer
//          | "t" whatever stands there
//   list   = count "*" [ "~" ] [ "@" first ] "(" layout ")"   -- `count` groups, numbered from `first` (1 when not given);
//                                                                "~": the index of the lists inside comes first (128)
//   values = count "*" "[" layout "]"                         -- `count` single values (406): the layout says what the
//                                                                first of them are, the others are V(1), V(2), ...
//   choice = NAME "=" integer "?" "(" layout ")"              -- there only when NAME has that value
//   count  = term { "+" term };  first = [ "-" ] term;  term = NAME | integer

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace trimloop::iges {

struct LayoutTerm {
  std::string_view name;  // empty: `number`
  std::int64_t number = 0;
};

struct LayoutNode {
  enum class Kind : std::uint8_t { Field, List, Values, Choice } kind = Kind::Field;
  std::string_view name;                // Field, Choice
  char type = 't';                      // Field: the letter of its kind
  bool has_default = false;             // Field
  std::string_view fallback;            // Field: the default's text
  std::vector<LayoutTerm> count;        // List, Values: a sum
  LayoutTerm first{{}, 1};              // List
  bool first_negative = false;          // List: numbered from -first
  bool inner_first = false;             // List: "~"
  std::int64_t equals = 0;              // Choice
  std::vector<LayoutNode> inside;       // List, Values, Choice
  std::size_t width = 0;                // of one group in parameters, 0 when groups differ
  std::size_t least_width = 0;          // of one group
};

// One row of the table.
struct Layout {
  int type = 0;
  int first_form = 0, last_form = 0;
  std::string_view name;  // of the type, or of the form where forms have names of their own
  std::string_view text;
  std::vector<LayoutNode> nodes;  // compiled from `text`
};

// All rows, by type and first form.
std::span<const Layout> layouts();
// The row of a type and form. A form that the standard does not have gets its type's first row, 406 the row of any
// values, 402 none; types beyond the standard have none.
const Layout* find_layout(int type, int form);

// The nodes of a layout text. What is wrong in it is our mistake (asserted).
std::vector<LayoutNode> compile_layout(std::string_view text);

// Walks over a record whose integers `integer_at` gives (parameter from 1; nothing when there is none or it is none).
class LayoutWalk {
 public:
  using IntegerAt = std::function<std::optional<std::int64_t>(std::size_t index)>;
  LayoutWalk(const Layout& layout, std::size_t parameters, IntegerAt integer_at);

  // "K", "T(-3)", "X(2)", "PSCPT(1,2)"; "" beyond the own parameters or where a count cannot be told.
  std::string name(std::size_t index);
  std::vector<std::string> names();  // of all own parameters, at once
  std::string kinds();               // their letters: "rrip"
  // Parameter index of field `name` under the list indices given (each counted from 1); 0 when it is not there.
  std::size_t find(std::string_view name, std::initializer_list<std::size_t> at = {});
  // Own parameters, as the counts have it; nothing when a count cannot be told.
  std::optional<std::size_t> count();

 private:
  struct Wanted;
  bool walk(const std::vector<LayoutNode>& nodes, Wanted& wanted);
  bool walk_list(const LayoutNode& node, Wanted& wanted);
  bool walk_values(const LayoutNode& node, Wanted& wanted);
  void take(const LayoutNode& field, std::size_t index);
  std::optional<std::int64_t> value(const LayoutTerm& term) const;
  std::optional<std::size_t> count_of(const LayoutNode& node) const;

  const Layout& layout_;
  std::size_t parameters_;
  IntegerAt integer_at_;
  std::size_t next_ = 1;
  std::vector<std::pair<std::string_view, std::optional<std::int64_t>>> integers_;  // the last one of a name counts
  std::vector<std::int64_t> indices_;  // of the lists around
  bool inner_first_ = false;           // name the list inside first
};

}  // namespace trimloop::iges
