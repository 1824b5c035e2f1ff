#pragma once
// JSON text as a plain tree (RFC 8259), within limits. Members keep their order; a name that stands twice is refused.

#include <string>
#include <string_view>
#include <vector>

#include "base/limits.h"
#include "base/result.h"

namespace trimloop::json {

struct Member;

struct Value {
  enum class Kind : std::uint8_t { Null, Boolean, Number, String, Array, Object };
  Kind kind = Kind::Null;
  bool boolean = false;
  double number = 0;  // correctly rounded
  std::string string;
  std::vector<Value> items;                             // of an array
  std::vector<Member> members;                          // of an object

  const Value* find(std::string_view name) const;       // member, or null
};
struct Member {
  std::string first;
  Value second;
};
std::string_view to_string(Value::Kind);  // "a number", "an object", ...

// `measured` of the error is the byte offset. Limit: nested deeper than limits.nesting_depth, or more than
// limits.list_count values.
Result<Value> parse(std::string_view text, const Limits&);

}  // namespace trimloop::json
