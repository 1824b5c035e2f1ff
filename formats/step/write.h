#pragma once
// Writing Part 21: instances in the order they are added, equal small ones shared, reals in their shortest exact form.
// The writer knows the grammar (ISO 10303-21 clauses 5 to 12); what an entity's attributes mean is its caller's business.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/result.h"

namespace trimloop::step {

struct InstanceId {  // #number
  std::uint64_t number = 0;  // 0: none
  explicit operator bool() const { return number != 0; }
  friend bool operator==(InstanceId a, InstanceId b) { return a.number == b.number; }
};

// What stands for an attribute besides numbers, text (a string), bool (.T. or .F.), InstanceId and lists of these.
struct Enumeration {  // .WORD.
  std::string_view word;
};
struct Unset {};    // $
struct Derived {};  // *
struct Measure {    // LENGTH_MEASURE(1.): a value of a SELECT
  std::string_view type;
  double value;
};
struct TrimSelect {  // (#1,PARAMETER_VALUE(0.5)): both forms of a trimming point
  InstanceId point;
  double parameter;
};
struct TypedText {  // DESCRIPTIVE_MEASURE('x')
  std::string_view type;
  std::string_view text;
};
struct TypedEnumeration {  // NULL_STYLE(.NULL.)
  std::string_view type;
  std::string_view word;
};

// The text of an instance's attributes, "(1.,'a',#3)".
class Attributes21 {
 public:
  template <class... A>
  static Attributes21 of(const A&... attributes) {
    Attributes21 out;
    out.text_ += '(';
    (out.item(attributes), ...);
    out.text_ += ')';
    return out;
  }
  const std::string& text() const { return text_; }
  bool finite() const { return finite_; }

 private:
  template <class T>
  void item(const T& value) {
    if (text_.size() > 1) text_ += ',';
    put(value);
  }
  void put(double value);
  void put(bool value);
  void put(std::int64_t value);
  void put(int value) { put(static_cast<std::int64_t>(value)); }
  void put(std::size_t value) { put(static_cast<std::int64_t>(value)); }
  void put(std::string_view text);
  void put(const std::string& text) { put(std::string_view(text)); }
  void put(const char* text) { put(std::string_view(text)); }
  void put(InstanceId id);
  void put(Enumeration value);
  void put(Unset) { text_ += '$'; }
  void put(Derived) { text_ += '*'; }
  void put(const Measure& value);
  void put(const TrimSelect& value);
  void put(const TypedText& value);
  void put(const TypedEnumeration& value);
  template <class T>
  void put(const std::vector<T>& list) { put_list(list); }
  template <class T, std::size_t n>
  void put(const std::array<T, n>& list) { put_list(list); }
  template <class List>
  void put_list(const List& list) {
    text_ += '(';
    bool first = true;
    for (const auto& value : list) {
      if (!first) text_ += ',';
      first = false;
      put(value);
    }
    text_ += ')';
  }

  std::string text_;
  bool finite_ = true;
};

struct Partial {  // one part of a complex instance: its keyword and its own attributes
  std::string_view keyword;
  Attributes21 attributes;
};
template <class... A>
Partial partial(std::string_view keyword, const A&... attributes) {
  return {keyword, Attributes21::of(attributes...)};
}

struct FileHeader {
  std::string description, level = "2;1";
  std::string name, time_stamp, author, organization, preprocessor, system, authorization;
  std::string schema;
};

class Writer {
 public:
  explicit Writer(const FileHeader&);

  template <class... A>
  InstanceId add(std::string_view keyword, const A&... attributes) {
    return append(keyword, Attributes21::of(attributes...));
  }
  // One instance for equal texts: points, directions, placements, colours.
  template <class... A>
  InstanceId add_shared(std::string_view keyword, const A&... attributes) {
    return append_shared(keyword, Attributes21::of(attributes...));
  }
  InstanceId add_complex(std::vector<Partial> parts);  // parts are put in ascending order of their keywords
  InstanceId add_copy(std::string_view value);         // of copy.h: put as it stands

  std::uint64_t instances() const { return last_; }
  // The whole file. InvalidArgument when a number that is not finite was among the attributes: nothing is to be written.
  Result<std::string> finish() const;

 private:
  InstanceId append(std::string_view keyword, const Attributes21& attributes);
  InstanceId append_shared(std::string_view keyword, const Attributes21& attributes);
  InstanceId begin();

  std::string text_;
  std::uint64_t last_ = 0;
  std::uint64_t not_finite_ = 0;  // first instance that holds such a number
  std::unordered_map<std::string, std::uint64_t> shared_;
};

}  // namespace trimloop::step
