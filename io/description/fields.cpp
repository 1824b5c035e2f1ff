#include "io/description/fields.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/description/rules.h"

namespace trimloop::io::description {

using Kind = json::Value::Kind;

namespace {

std::string item(const std::string& path, std::size_t i) { return fmt::format("{}[{}]", path, i); }

}  // namespace

Fields::Fields(const json::Value& value, std::string path, Report& report)
    : value_(value), path_(std::move(path)), report_(&report), good_(std::make_shared<bool>(true)) {
  if (value.kind != Kind::Object) add(description_rules::field, path_, fmt::format("an object is expected, this is {}", to_string(value.kind)));
}

void Fields::add(const Rule& rule, const std::string& path, std::string text, double measured, double limit) {
  *good_ = false;
  if (muted_) return;
  Diagnostic& d = report_->add(rule, fmt::format("{}: {}", path, text));
  d.entity = path;
  d.measured = measured;
  d.limit = limit;
}

void Fields::wrong(std::string_view name, std::string what, double measured, double limit) {
  add(description_rules::field, fmt::format("{}.{}", path_, name), std::move(what), measured, limit);
}

void Fields::impossible(const Error& error) { add(description_rules::shape, path_, error.text, error.measured, error.limit); }

void Fields::finish() {
  if (!good()) return;  // members may not have been asked for then
  for (const auto& member : value_.members)
    if (!asked_.count(member.first)) add(description_rules::unknown, fmt::format("{}.{}", path_, member.first), "this member has no meaning here");
}

const json::Value* Fields::get(std::string_view name, Kind kind, bool needed) {
  asked_.emplace(name);
  const json::Value* found = value_.find(name);
  if (!found) {
    if (needed) wrong(name, "this member is missing");
    return nullptr;
  }
  if (found->kind != kind) {
    wrong(name, fmt::format("{} is expected, this is {}", to_string(kind), to_string(found->kind)));
    return nullptr;
  }
  return found;
}

double Fields::as_number(const json::Value& value, const std::string& path) {
  if (value.kind != Kind::Number) {
    add(description_rules::field, path, fmt::format("a number is expected, this is {}", to_string(value.kind)));
    return 0;
  }
  if (std::isfinite(value.number)) return value.number;
  add(description_rules::field, path, "the number is not finite", value.number);
  return 0;
}

Point Fields::as_point(const json::Value& value, const std::string& path) {
  if (value.kind != Kind::Array || value.items.size() < 2 || value.items.size() > 3) {
    add(description_rules::field, path, "a point is a list of two or three numbers", static_cast<double>(value.items.size()), 3);
    return {};
  }
  Point p{as_number(value.items[0], item(path, 0)), as_number(value.items[1], item(path, 1)), 0};
  if (value.items.size() == 3) p.z = as_number(value.items[2], item(path, 2));
  return p;
}

double Fields::number(std::string_view name) {
  const json::Value* v = get(name, Kind::Number, true);
  return v ? as_number(*v, fmt::format("{}.{}", path_, name)) : 0;
}

double Fields::number_or(std::string_view name, double otherwise) {
  asked_.emplace(name);
  return has(name) ? number(name) : otherwise;
}

double Fields::positive(std::string_view name) {
  const double n = number(name);
  if (good() && !(n > 0)) wrong(name, "a positive number is expected", n, 0);
  return n > 0 ? n : 1;
}

int Fields::integer(std::string_view name, int least, int most) {
  const double n = number(name);
  if (!(n >= least && n <= most) || n != std::floor(n)) {
    if (has(name)) wrong(name, fmt::format("a whole number from {} to {} is expected", least, most), n, n < least ? least : most);
    return least;
  }
  return static_cast<int>(n);
}

int Fields::integer_or(std::string_view name, int otherwise, int least, int most) {
  asked_.emplace(name);
  return has(name) ? integer(name, least, most) : otherwise;
}

bool Fields::flag(std::string_view name) {
  const json::Value* v = get(name, Kind::Boolean, false);
  return v && v->boolean;
}

std::string Fields::text_or(std::string_view name, std::string_view otherwise) {
  const json::Value* v = get(name, Kind::String, false);
  return v ? v->string : std::string(otherwise);
}

std::size_t Fields::choice(std::string_view name, std::initializer_list<std::string_view> words) {
  const std::string word = text_or(name, *words.begin());
  const auto found = std::find(words.begin(), words.end(), word);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  wrong(name, fmt::format("\"{}\" is none of {}", word, fmt::join(words, ", ")));
  return 0;
}

std::vector<double> Fields::numbers(std::string_view name) {
  const json::Value* v = get(name, Kind::Array, true);
  std::vector<double> out;
  if (v)
    for (std::size_t i = 0; i < v->items.size(); ++i) out.push_back(as_number(v->items[i], item(fmt::format("{}.{}", path_, name), i)));
  return out;
}

std::vector<double> Fields::numbers_or_none(std::string_view name) {
  asked_.emplace(name);
  return has(name) ? numbers(name) : std::vector<double>{};
}

std::vector<int> Fields::integers_or_none(std::string_view name, int least, int most) {
  std::vector<int> out;
  for (const double n : numbers_or_none(name)) {
    if (!(n >= least && n <= most) || n != std::floor(n)) {
      wrong(name, fmt::format("{} is no whole number from {} to {}", n, least, most), n, n < least ? least : most);
      return {};
    }
    out.push_back(static_cast<int>(n));
  }
  return out;
}

Point Fields::point(std::string_view name) {
  const json::Value* v = get(name, Kind::Array, true);
  return v ? as_point(*v, fmt::format("{}.{}", path_, name)) : Point{};
}

Point Fields::point_or(std::string_view name, Point otherwise) {
  asked_.emplace(name);
  return has(name) ? point(name) : otherwise;
}

std::vector<Point> Fields::points(std::string_view name, std::size_t least) {
  const json::Value* v = get(name, Kind::Array, true);
  std::vector<Point> out;
  if (!v) return out;
  const std::string path = fmt::format("{}.{}", path_, name);
  for (std::size_t i = 0; i < v->items.size(); ++i) out.push_back(as_point(v->items[i], item(path, i)));
  if (out.size() < least)
    wrong(name, fmt::format("{} points, at least {} are needed", out.size(), least), static_cast<double>(out.size()), static_cast<double>(least));
  return out;
}

Fields::Net Fields::net(std::string_view name) {
  const json::Value* v = get(name, Kind::Array, true);
  Net out;
  if (!v) return out;
  const std::string path = fmt::format("{}.{}", path_, name);
  for (std::size_t i = 0; i < v->items.size(); ++i) {
    const json::Value& row = v->items[i];
    if (i == 0) out.columns = row.items.size();
    if (row.kind != Kind::Array || row.items.size() != out.columns || out.columns == 0) {
      add(description_rules::field, item(path, i), fmt::format("a row of {} points is expected, as the first has", out.columns),
          static_cast<double>(row.items.size()), static_cast<double>(out.columns));
      return {};
    }
    for (std::size_t j = 0; j < row.items.size(); ++j) out.points.push_back(as_point(row.items[j], item(item(path, i), j)));
    ++out.rows;
  }
  if (out.rows == 0) wrong(name, "a net has rows of points", 0, 1);
  return out;
}

std::vector<double> Fields::net_numbers_or_none(std::string_view name, const Net& like) {
  asked_.emplace(name);
  if (!has(name)) return {};
  const json::Value* v = get(name, Kind::Array, true);
  std::vector<double> out;
  if (!v) return out;
  const std::string path = fmt::format("{}.{}", path_, name);
  for (std::size_t i = 0; i < v->items.size(); ++i) {
    for (std::size_t j = 0; j < v->items[i].items.size(); ++j) out.push_back(as_number(v->items[i].items[j], item(item(path, i), j)));
    if (v->items[i].items.size() != like.columns)
      add(description_rules::field, item(path, i), fmt::format("{} numbers, the net has {} columns", v->items[i].items.size(), like.columns),
          static_cast<double>(v->items[i].items.size()), static_cast<double>(like.columns));
  }
  if (good() && v->items.size() != like.rows)
    wrong(name, fmt::format("{} rows, the net has {}", v->items.size(), like.rows), static_cast<double>(v->items.size()), static_cast<double>(like.rows));
  return out;
}

Fields Fields::object(std::string_view name) {
  const json::Value* v = get(name, Kind::Object, true);
  static const json::Value absent = [] {
    json::Value empty;
    empty.kind = Kind::Object;
    return empty;
  }();
  Fields inner(v ? *v : absent, fmt::format("{}.{}", path_, name), *report_);
  inner.good_ = good_;
  inner.muted_ = muted_ || !v;
  return inner;
}

std::vector<Fields> Fields::objects(std::string_view name, std::size_t least) {
  const json::Value* v = get(name, Kind::Array, true);
  std::vector<Fields> out;
  if (!v) return out;
  const std::string path = fmt::format("{}.{}", path_, name);
  if (v->items.size() < least)
    wrong(name, fmt::format("{} entries, at least {} are needed", v->items.size(), least), static_cast<double>(v->items.size()), static_cast<double>(least));
  for (std::size_t i = 0; i < v->items.size(); ++i) {
    Fields inner(v->items[i], item(path, i), *report_);
    if (!inner.good()) *good_ = false;
    inner.good_ = good_;
    out.push_back(std::move(inner));
  }
  return out;
}

std::vector<std::vector<int>> Fields::lists(std::string_view name, int least, int most) {
  const json::Value* v = get(name, Kind::Array, true);
  std::vector<std::vector<int>> out;
  if (!v) return out;
  const std::string path = fmt::format("{}.{}", path_, name);
  for (std::size_t i = 0; i < v->items.size(); ++i) {
    out.emplace_back();
    if (v->items[i].kind != Kind::Array) add(description_rules::field, item(path, i), "a list of indices is expected");
    for (std::size_t j = 0; j < v->items[i].items.size(); ++j) {
      const double n = as_number(v->items[i].items[j], item(item(path, i), j));
      if (!(n >= least && n <= most) || n != std::floor(n)) {
        add(description_rules::field, item(item(path, i), j), fmt::format("a whole number from {} to {} is expected", least, most), n,
            n < least ? least : most);
        continue;
      }
      out.back().push_back(static_cast<int>(n));
    }
  }
  return out;
}

}  // namespace trimloop::io::description
