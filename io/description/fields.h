#pragma once
// The members of one object of a description, asked for by name. What is missing or wrong becomes a finding with its
// JSON path; the caller goes on with a harmless value and looks at good() before it makes a shape.

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/report.h"
#include "formats/json/json.h"
#include "kernel/math/vec.h"

namespace trimloop::io::description {

class Fields {
 public:
  Fields(const json::Value& value, std::string path, Report& report);

  bool has(std::string_view name) const { return value_.find(name) != nullptr; }
  double number(std::string_view name);
  double number_or(std::string_view name, double otherwise);
  double positive(std::string_view name);
  int integer(std::string_view name, int least, int most);
  int integer_or(std::string_view name, int otherwise, int least, int most);
  bool flag(std::string_view name);  // false when it is not there
  std::string text_or(std::string_view name, std::string_view otherwise);
  // One of `words`; its index. The first is taken when the member is not there.
  std::size_t choice(std::string_view name, std::initializer_list<std::string_view> words);
  std::vector<double> numbers(std::string_view name);
  std::vector<double> numbers_or_none(std::string_view name);
  std::vector<int> integers_or_none(std::string_view name, int least, int most);
  Point point(std::string_view name);   // [x, y] or [x, y, z]
  Point point_or(std::string_view name, Point otherwise);
  std::vector<Point> points(std::string_view name, std::size_t least);
  struct Net {
    std::size_t rows = 0, columns = 0;
    std::vector<Point> points;  // row by row
  };
  Net net(std::string_view name);                                // rows of points, all of one length
  std::vector<double> net_numbers_or_none(std::string_view name, const Net& like);
  Fields object(std::string_view name);
  std::vector<Fields> objects(std::string_view name, std::size_t least);
  std::vector<std::vector<int>> lists(std::string_view name, int least, int most);  // lists of indices

  const std::string& path() const { return path_; }
  bool good() const { return *good_; }
  void wrong(std::string_view name, std::string what, double measured = not_measured, double limit = not_measured);
  void impossible(const Error&);  // the shape that these members describe cannot be made
  void finish();                  // when all is good so far: members that nobody asked for are findings

 private:
  const json::Value* get(std::string_view name, json::Value::Kind kind, bool needed);
  double as_number(const json::Value&, const std::string& path);
  Point as_point(const json::Value&, const std::string& path);
  void add(const Rule& rule, const std::string& path, std::string text, double measured = not_measured, double limit = not_measured);

  const json::Value& value_;
  bool muted_ = false;  // stands for an object that is not there, which has been said
  std::string path_;
  Report* report_;
  std::set<std::string, std::less<>> asked_;
  std::shared_ptr<bool> good_;  // shared with the objects inside
};

}  // namespace trimloop::io::description
