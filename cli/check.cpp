// trimloop check: every finding of reader, importer and healing.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "base/bytes.h"
#include "cli/terminal.h"

namespace trimloop::cli {

namespace {

using nlohmann::ordered_json;

ordered_json number_or_null(double value) { return value == value ? ordered_json(value) : ordered_json(nullptr); }

ordered_json to_json(const Diagnostic& d) {
  ordered_json out;
  out["id"] = d.rule->id;
  out["slug"] = d.rule->slug;
  out["severity"] = to_string(d.severity);
  out["text"] = printable(d.text, 1000);
  ordered_json place;
  const bool known = d.location.offset != Location::nowhere;
  place["line"] = known ? ordered_json(d.location.line) : ordered_json(nullptr);
  place["column"] = known ? ordered_json(d.location.column) : ordered_json(nullptr);
  place["offset"] = known ? ordered_json(d.location.offset) : ordered_json(nullptr);
  place["section"] = d.location.section ? ordered_json(std::string(1, d.location.section)) : ordered_json(nullptr);
  out["location"] = place;
  out["entity"] = d.entity.empty() ? ordered_json(nullptr) : ordered_json(d.entity);
  out["type"] = d.type.empty() ? ordered_json(nullptr) : ordered_json(d.type);
  out["parameter"] = d.parameter > 0 ? ordered_json(d.parameter) : ordered_json(nullptr);
  out["path"] = d.path;
  out["measured"] = number_or_null(d.measured);
  out["limit"] = number_or_null(d.limit);
  const std::string unit = d.unit.empty() ? std::string(d.rule->unit) : d.unit;
  out["unit"] = unit.empty() ? ordered_json(nullptr) : ordered_json(unit);
  out["at"] = d.at ? ordered_json(*d.at) : ordered_json(nullptr);
  return out;
}

// failed: it found something; skipped: nothing could be read, so it had no chance; else it ran and passed, or there was
// nothing of its kind in the file (rules about an entity type that does not occur).
std::string_view status_of(const Rule& rule, const io::ReadResult& in) {
  if (in.report.count(rule.id) > 0) return "failed";
  if (!in.usable) return "skipped";
  if (rule.id.substr(0, 4) == "IG-E") {
    const std::string type(rule.id.substr(4, 3));
    const bool occurs = std::any_of(in.source.entities.begin(), in.source.entities.end(),
                                    [&](const auto& e) { return e.first.compare(0, 4, type + ":") == 0; });
    return occurs ? "passed" : "not-applicable";
  }
  return "passed";
}

ordered_json report_json(const std::string& file, const io::ReadResult& in) {
  ordered_json out;
  out["file"] = printable(file, 1000);
  ordered_json counts;
  for (const Severity s : {Severity::Fatal, Severity::Error, Severity::Warning, Severity::Info, Severity::Hint}) {
    counts[std::string(to_string(s))] = in.report.count(s);
  }
  out["summary"] = counts;
  out["rules"] = ordered_json::array();
  for (const Rule* rule : io::all_rules()) out["rules"].push_back({{"id", rule->id}, {"status", status_of(*rule, in)}});
  out["findings"] = ordered_json::array();
  for (const Diagnostic& d : in.report.items()) out["findings"].push_back(to_json(d));
  return out;
}

Severity severity_from(const std::string& word) {
  for (const Severity s : {Severity::Hint, Severity::Info, Severity::Warning, Severity::Error}) {
    if (word == to_string(s)) return s;
  }
  return Severity::Fatal;
}

}  // namespace

int check(const Common& common, const CheckOptions& options) {
  const Severity fail_on = severity_from(options.fail_on);
  int worst = Done;
  std::string out;
  for (const std::string& file : options.files) {
    io::ReadOptions read;
    read.measure_findings = true;
    read.sew = true;
    io::ReadResult in = read_input(common, file, read);
    in.report.sort();
    if (in.io_failed) {
      complain_unusable(common, file, in);
      worst = std::max<int>(worst, CannotReadOrWrite);
      continue;
    }
    for (int s = static_cast<int>(fail_on); s <= static_cast<int>(Severity::Fatal); ++s) {
      if (in.report.count(static_cast<Severity>(s))) worst = std::max<int>(worst, Findings);
    }
    if (in.limit_reached) worst = std::max<int>(worst, LimitReached);
    if (common.json) {
      out += report_json(file, in).dump() + "\n";
    } else {
      for (const Diagnostic& d : in.report.items()) out += describe(common, in, d);
      out += fmt::format("{}: {}\n", printable(file, 200), summary(in.report));
    }
  }
  if (!out.empty() && !emit(common, out)) return CannotReadOrWrite;
  return worst;
}

}  // namespace trimloop::cli
