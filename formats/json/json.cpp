#include "formats/json/json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/number.h"

namespace trimloop::json {

namespace {

constexpr std::size_t most_members = 1000;  // of one object; each new name is compared with the others

// Builds the tree from nlohmann's events; the parser itself does not recurse.
class Builder {
 public:
  using Text = nlohmann::json::string_t;
  explicit Builder(const Limits& limits) : limits_(limits) {}

  bool null() { return put({}); }
  bool boolean(bool b) {
    Value v;
    v.kind = Value::Kind::Boolean;
    v.boolean = b;
    return put(std::move(v));
  }
  bool number_integer(std::int64_t n) { return number(static_cast<double>(n)); }
  bool number_unsigned(std::uint64_t n) { return number(static_cast<double>(n)); }
  bool number_float(double, const Text& text) { return number(read_real(text).value); }  // overflow stays infinite
  bool string(Text& text) {
    Value v;
    v.kind = Value::Kind::String;
    v.string = std::move(text);
    return put(std::move(v));
  }
  bool binary(nlohmann::json::binary_t&) { return false; }
  bool start_object(std::size_t) { return open(Value::Kind::Object); }
  bool start_array(std::size_t) { return open(Value::Kind::Array); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool key(Text& name) {
    Value& object = *open_.back();
    if (object.members.size() >= most_members)
      return refuse(ErrorCode::Limit, "an object has more members than allowed", static_cast<double>(most_members + 1), most_members);
    for (const Member& member : object.members)
      if (member.first == name) return refuse(ErrorCode::InvalidArgument, fmt::format("\"{}\" stands twice in one object", name));
    object.members.push_back({std::move(name), Value{}});
    return true;
  }
  bool parse_error(std::size_t at, const std::string&, const nlohmann::json::exception& e) {
    const std::string_view what = e.what();
    const std::size_t words = what.find("syntax error");
    return refuse(ErrorCode::InvalidArgument, std::string(words == std::string_view::npos ? what : what.substr(words)),
                  static_cast<double>(at));
  }

  Result<Value> take() {
    if (!error_.text.empty()) return tl::unexpected(error_);
    return std::move(root_);
  }
  bool failed() const { return !error_.text.empty(); }

 private:
  bool refuse(ErrorCode code, std::string text, double measured = not_measured, double limit = not_measured) {
    error_ = {code, std::move(text), measured, limit};
    return false;
  }
  bool number(double n) {
    Value v;
    v.kind = Value::Kind::Number;
    v.number = n;
    return put(std::move(v));
  }
  Value* place(Value v) {
    if (++count_ > limits_.list_count) {
      refuse(ErrorCode::Limit, "more values than allowed", static_cast<double>(count_), static_cast<double>(limits_.list_count));
      return nullptr;
    }
    if (open_.empty()) return &(root_ = std::move(v));
    Value& in = *open_.back();
    if (in.kind == Value::Kind::Object) return &(in.members.back().second = std::move(v));
    in.items.push_back(std::move(v));
    return &in.items.back();
  }
  bool put(Value v) { return place(std::move(v)) != nullptr; }
  bool open(Value::Kind kind) {
    if (open_.size() >= limits_.nesting_depth)
      return refuse(ErrorCode::Limit, "nested deeper than allowed", static_cast<double>(open_.size() + 1),
                    static_cast<double>(limits_.nesting_depth));
    Value v;
    v.kind = kind;
    Value* at = place(std::move(v));
    if (at) open_.push_back(at);  // stays valid: only the innermost open value grows
    return at != nullptr;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  const Limits& limits_;
  Value root_;
  std::vector<Value*> open_;
  std::size_t count_ = 0;
  Error error_;
};

}  // namespace

const Value* Value::find(std::string_view name) const {
  for (const Member& member : members)
    if (member.first == name) return &member.second;
  return nullptr;
}

std::string_view to_string(Value::Kind kind) {
  switch (kind) {
    case Value::Kind::Null: return "null";
    case Value::Kind::Boolean: return "true or false";
    case Value::Kind::Number: return "a number";
    case Value::Kind::String: return "a text";
    case Value::Kind::Array: return "a list";
    case Value::Kind::Object: return "an object";
  }
  return "nothing";
}

Result<Value> parse(std::string_view text, const Limits& limits) {
  Builder builder(limits);
  const bool whole = nlohmann::json::sax_parse(text.begin(), text.end(), &builder);
  if (!whole && !builder.failed()) return fail(ErrorCode::InvalidArgument, "this is no JSON text");
  return builder.take();
}

}  // namespace trimloop::json
