#include "formats/step/records/reader.h"

#include <fmt/format.h>

#include <cmath>

#include "base/bytes.h"
#include "formats/step/rules.h"
#include "formats/step/strings.h"

namespace trimloop::step {
namespace {

using Kind = Token::Kind;

const Rule& rule_of(Fault::Kind kind) {
  switch (kind) {
    case Fault::Kind::Separator: return rules::separators;
    case Fault::Kind::Unterminated: return rules::instance_malformed;
    case Fault::Kind::OpenString: return rules::string_open;
    case Fault::Kind::RealForm: return rules::real_form;
    case Fault::Kind::RealOverflow:
    case Fault::Kind::Underflow: return rules::real_overflow;
    case Fault::Kind::IntegerOverflow: return rules::integer_overflow;
    case Fault::Kind::EnumForm: return rules::enum_form;
    case Fault::Kind::BinaryForm: return rules::binary_form;
    case Fault::Kind::Depth: return rules::depth;
    case Fault::Kind::TooMany: return rules::aggregate_bounds;
    case Fault::Kind::InstanceForm: return rules::instance_malformed;
    case Fault::Kind::PartTwice: return rules::complex_order;
    case Fault::Kind::Garbage: break;
  }
  return rules::instance_malformed;
}

std::string_view words(Fault::Kind kind) {
  switch (kind) {
    case Fault::Kind::Separator: return "a comma is missing or too many";
    case Fault::Kind::Unterminated: return "the record does not end with ')'";
    case Fault::Kind::OpenString: return "a string does not end";
    case Fault::Kind::RealForm: return "this is not how a real is written";
    case Fault::Kind::RealOverflow: return "the real does not fit a double";
    case Fault::Kind::Underflow: return "the real is too small for a double and becomes zero or loses digits";
    case Fault::Kind::IntegerOverflow: return "the integer does not fit 64 bits";
    case Fault::Kind::EnumForm: return "this is not how an enumeration is written";
    case Fault::Kind::BinaryForm: return "this is not how a binary is written";
    case Fault::Kind::Depth: return "lists are nested too deep; the record is left out";
    case Fault::Kind::TooMany: return "the record has more values than the ceiling allows; it is left out";
    case Fault::Kind::InstanceForm: return "this is not how an instance is named";
    case Fault::Kind::PartTwice: return "a part comes twice";
    case Fault::Kind::Garbage: break;
  }
  return "this is no parameter";
}

}  // namespace

void place(Diagnostic& d, const File& file, const Instance& instance) {
  d.entity = fmt::format("#{}", instance.id);
  d.type = file.keyword(instance).name.substr(0, 200);
  if (d.location.offset == Location::nowhere) {
    d.location.offset = instance.offset;
    d.location.length = std::min<std::size_t>(instance.length, 60);
  }
}

void report_faults(const File& file, const Instance& instance, const Tape& tape, Report& report) {
  const std::size_t base = instance.offset + instance.value;
  for (const Fault& f : tape.faults()) {
    const Rule& rule = rule_of(f.kind);
    const Severity severity = f.kind == Fault::Kind::Underflow ? Severity::Warning : rule.severity;
    const std::string_view here = file.bytes().substr(std::min(base + f.offset, file.bytes().size()), f.length);
    Diagnostic& d = report.add(rule, severity, fmt::format("{}: {}", words(f.kind), printable(here, 40)));
    d.location.offset = base + f.offset;
    d.location.length = f.length;
    place(d, file, instance);
  }
}

Reader::Reader(const File& file, const Instance& instance, const Limits& limits, Tape& tape, Report& report)
    : file_(file), instance_(instance), tape_(tape), report_(report) {
  ok_ = tape_.read(file.value(instance), limits);
  if (!tape_.faults().empty()) report_faults(file, instance, tape_, report);
}

Diagnostic& Reader::add(const Rule& rule, std::string text, int attribute) {
  Diagnostic& d = report_.add(rule, std::move(text));
  place(d, file_, instance_);
  if (attribute >= 0) d.parameter = first_ + attribute + 1;
  return d;
}

bool Reader::at(Entity e, bool optional) {
  const auto& parts = tape_.parts();
  const EntityInfo& wanted = info(e);
  starts_.clear();
  first_ = 0;
  if (parts.empty()) {
    ok_ = false;
    return false;
  }
  std::size_t found = parts.size();
  if (!file_.keyword(instance_).is_complex) {
    found = 0;
    first_ = wanted.first;
  } else {
    for (std::size_t i = 0; i < parts.size() && found == parts.size(); ++i)
      if (parts[i].keyword == wanted.keyword) found = i;
  }
  if (found == parts.size()) {
    if (!optional) {
      add(rules::attribute_count, fmt::format("the part {} is missing", wanted.keyword));
      ok_ = false;
    }
    return false;
  }
  for (std::uint32_t i = parts[found].first; i < parts[found].end; i = tape_[i].end) starts_.push_back(i);
  return true;
}

std::uint32_t Reader::opened(std::uint32_t i) const {
  while (i < tape_.size() && tape_[i].kind == Kind::Typed) {
    if (tape_[i].end == i + 1) return tape_.size();
    ++i;
  }
  return i;
}

std::uint32_t Reader::token(int i) const {
  const int at = first_ + i;
  if (at < 0 || at >= static_cast<int>(starts_.size())) return tape_.size();
  return opened(starts_[static_cast<std::size_t>(at)]);
}

bool Reader::is_set(int i) const {
  const std::uint32_t t = token(i);
  return t < tape_.size() && tape_[t].kind != Kind::Unset && tape_[t].kind != Kind::Derived && tape_[t].kind != Kind::Bad;
}

bool Reader::wrong(int i, std::string_view wanted) {
  const std::uint32_t t = token(i);
  ok_ = false;
  const std::string_view name = attribute_name(file_.keyword(instance_).entity, first_ + i);
  const std::string called = name.empty() ? fmt::format("attribute {}", first_ + i + 1) : fmt::format("{}", name);
  if (t >= tape_.size())
    add(rules::attribute_count, fmt::format("{} is missing: there are {} attributes", called, starts_.size()), i);
  else if (tape_[t].kind == Kind::Unset || tape_[t].kind == Kind::Derived)
    add(rules::required_null, fmt::format("{} has no value; {} is expected", called, wanted), i);
  else
    add(rules::attribute_type, fmt::format("{} is {}; {} is expected", called, printable(tape_.text(tape_[t]), 40), wanted), i);
  return false;
}

Ref Reader::ref(int i) {
  const std::uint32_t t = token(i);
  if (t < tape_.size() && tape_[t].kind == Kind::Reference) return {tape_[t].id};
  wrong(i, "an instance");
  return {};
}

Ref Reader::optional_ref(int i) { return is_set(i) ? ref(i) : Ref{}; }

std::vector<Ref> Reader::refs(int i) {
  std::vector<Ref> out;
  const std::uint32_t t = token(i);
  if (t >= tape_.size() || tape_[t].kind != Kind::List) {
    wrong(i, "a list of instances");
    return out;
  }
  out.reserve((tape_[t].end - t) - 1);
  bool other = false;
  for (std::uint32_t k = t + 1; k < tape_[t].end; k = tape_[k].end) {
    const std::uint32_t m = opened(k);
    if (m < tape_.size() && tape_[m].kind == Kind::Reference) out.push_back({tape_[m].id});
    else other = true;
  }
  if (other) add(rules::attribute_type, "a member of a list of instances is none; it is left out", i);
  return out;
}

bool Reader::number_at(std::uint32_t t, double& out) const {
  if (t >= tape_.size()) return false;
  if (tape_[t].kind == Kind::Real) out = tape_[t].real;
  else if (tape_[t].kind == Kind::Integer) out = static_cast<double>(tape_[t].integer);
  else return false;
  return std::isfinite(out);
}

double Reader::real(int i) {
  double value = 0;
  if (!number_at(token(i), value)) wrong(i, "a number");
  return value;
}

std::optional<double> Reader::optional_real(int i) {
  if (!is_set(i)) return std::nullopt;
  return real(i);
}

std::int64_t Reader::integer(int i) {
  const std::uint32_t t = token(i);
  if (t < tape_.size() && tape_[t].kind == Kind::Integer) return tape_[t].integer;
  double value = 0;
  if (number_at(t, value) && value == std::floor(value) && std::abs(value) < 9e15) return static_cast<std::int64_t>(value);
  wrong(i, "an integer");
  return 0;
}

std::vector<double> Reader::reals(int i) {
  std::vector<double> out;
  const std::uint32_t t = token(i);
  if (t >= tape_.size() || tape_[t].kind != Kind::List) {
    wrong(i, "a list of numbers");
    return out;
  }
  out.reserve((tape_[t].end - t) - 1);
  for (std::uint32_t k = t + 1; k < tape_[t].end; k = tape_[k].end) {
    double value = 0;
    if (!number_at(opened(k), value)) {
      wrong(i, "a list of numbers");
      return out;
    }
    out.push_back(value);
  }
  return out;
}

std::vector<int> Reader::integers(int i) {
  std::vector<int> out;
  const std::uint32_t t = token(i);
  if (t >= tape_.size() || tape_[t].kind != Kind::List) {
    wrong(i, "a list of integers");
    return out;
  }
  out.reserve((tape_[t].end - t) - 1);
  for (std::uint32_t k = t + 1; k < tape_[t].end; k = tape_[k].end) {
    if (tape_[k].kind != Kind::Integer || std::abs(tape_[k].integer) > 2'000'000'000) {
      wrong(i, "a list of integers");
      return out;
    }
    out.push_back(static_cast<int>(tape_[k].integer));
  }
  return out;
}

std::string Reader::string_at(std::uint32_t t) {
  StringFaults faults;
  std::string out = decode_string(tape_.text(tape_[t]), &faults);
  if (faults.none()) return out;
  const std::size_t base = instance_.offset + instance_.value + tape_[t].offset;
  if (faults.escape != StringFaults::nowhere || faults.surrogate != StringFaults::nowhere) {
    Diagnostic& d = add(rules::string_escape, fmt::format("an escape is malformed or incomplete: {}", printable(tape_.text(tape_[t]), 60)));
    d.location.offset = base;
  }
  const bool edition3 = !file_.header().implementation_level.empty() && file_.header().implementation_level[0] >= '3';
  if (faults.raw_byte != StringFaults::nowhere && !edition3) {
    Diagnostic& d = add(rules::string_raw_byte, fmt::format("a byte outside the basic alphabet: {}", printable(tape_.text(tape_[t]), 60)));
    d.location.offset = base;
  }
  return out;
}

std::string Reader::text(int i) {
  const std::uint32_t t = token(i);
  if (t < tape_.size() && tape_[t].kind == Kind::String) return string_at(t);
  return {};
}

bool Reader::boolean(int i, bool otherwise) {
  const std::uint32_t t = token(i);
  if (t < tape_.size() && tape_[t].kind == Kind::Enumeration) {
    const std::string_view word = tape_.text(tape_[t]);
    if (word == "T" || word == "t" || word == "TRUE") return true;
    if (word == "F" || word == "f" || word == "FALSE") return false;
    if (word == "U") return otherwise;
    add(rules::enum_value, fmt::format(".{}. is neither true nor false", printable(word, 20)), i);
    return otherwise;
  }
  if (t < tape_.size() && tape_[t].kind == Kind::Unset) return otherwise;
  add(t < tape_.size() ? rules::attribute_type : rules::attribute_count, ".T. or .F. is expected", i);
  return otherwise;
}

std::string Reader::word(int i) {
  const std::uint32_t t = token(i);
  return t < tape_.size() && tape_[t].kind == Kind::Enumeration ? std::string(tape_.text(tape_[t])) : std::string();
}

Select Reader::select_at(std::uint32_t t) {
  Select out;
  if (t < tape_.size() && tape_[t].kind == Kind::Typed) out.type = tape_.text(tape_[t]);
  t = opened(t);
  if (t >= tape_.size()) return out;
  const Token& token = tape_[t];
  if (token.kind == Kind::Reference) {
    out.kind = Select::Kind::Reference;
    out.ref = {token.id};
  } else if (number_at(t, out.number)) {
    out.kind = Select::Kind::Number;
  } else if (token.kind == Kind::String) {
    out.kind = Select::Kind::Text;
    out.text = string_at(t);
  } else if (token.kind == Kind::Enumeration) {
    out.kind = Select::Kind::Word;
    out.text = tape_.text(token);
  }
  return out;
}

Select Reader::select(int i) {
  const int at = first_ + i;
  if (at >= static_cast<int>(starts_.size())) {
    wrong(i, "a value");
    return {};
  }
  return select_at(starts_[static_cast<std::size_t>(at)]);
}

std::vector<Select> Reader::selects(int i) {
  std::vector<Select> out;
  const std::uint32_t t = token(i);
  if (t >= tape_.size() || tape_[t].kind != Kind::List) {
    wrong(i, "a list");
    return out;
  }
  for (std::uint32_t k = t + 1; k < tape_[t].end; k = tape_[k].end) out.push_back(select_at(k));
  return out;
}

std::vector<std::vector<Ref>> Reader::ref_rows(int i) {
  std::vector<std::vector<Ref>> out;
  const std::uint32_t t = token(i);
  bool good = t < tape_.size() && tape_[t].kind == Kind::List;
  for (std::uint32_t k = t + 1; good && k < tape_[t].end; k = tape_[k].end) {
    good = tape_[k].kind == Kind::List;
    std::vector<Ref>& row = out.emplace_back();
    row.reserve(tape_[k].end - k);
    for (std::uint32_t m = k + 1; good && m < tape_[k].end; m = tape_[m].end) {
      good = tape_[m].kind == Kind::Reference;
      row.push_back({tape_[m].id});
    }
  }
  if (!good) wrong(i, "rows of instances");
  return out;
}

std::vector<std::vector<double>> Reader::real_rows(int i) {
  std::vector<std::vector<double>> out;
  const std::uint32_t t = token(i);
  bool good = t < tape_.size() && tape_[t].kind == Kind::List;
  for (std::uint32_t k = t + 1; good && k < tape_[t].end; k = tape_[k].end) {
    good = tape_[k].kind == Kind::List;
    std::vector<double>& row = out.emplace_back();
    row.reserve(tape_[k].end - k);
    for (std::uint32_t m = k + 1; good && m < tape_[k].end; m = tape_[m].end) {
      double value = 0;
      good = number_at(opened(m), value);
      row.push_back(value);
    }
  }
  if (!good) wrong(i, "rows of numbers");
  return out;
}

std::vector<std::vector<int>> Reader::integer_rows(int i) {
  std::vector<std::vector<int>> out;
  const std::uint32_t t = token(i);
  bool good = t < tape_.size() && tape_[t].kind == Kind::List;
  for (std::uint32_t k = t + 1; good && k < tape_[t].end; k = tape_[k].end) {
    good = tape_[k].kind == Kind::List;
    std::vector<int>& row = out.emplace_back();
    row.reserve(tape_[k].end - k);
    for (std::uint32_t m = k + 1; good && m < tape_[k].end; m = tape_[m].end) {
      good = tape_[m].kind == Kind::Integer && std::abs(tape_[m].integer) <= 2'000'000'000;
      row.push_back(static_cast<int>(tape_[m].integer));
    }
  }
  if (!good) wrong(i, "rows of integers");
  return out;
}

}  // namespace trimloop::step
