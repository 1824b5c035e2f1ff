#include "base/report.h"

#include <algorithm>
#include <utility>

namespace trimloop {

std::string_view to_string(Severity severity) {
  switch (severity) {
    case Severity::Hint:
      return "hint";
    case Severity::Info:
      return "info";
    case Severity::Warning:
      return "warning";
    case Severity::Error:
      return "error";
    case Severity::Fatal:
      return "fatal";
  }
  return "unknown";
}

Diagnostic& Report::add(const Rule& rule, std::string text) { return add(rule, rule.severity, std::move(text)); }

Diagnostic& Report::add(const Rule& rule, Severity severity, std::string text) {
  ++by_severity_[static_cast<std::size_t>(severity)];
  const bool keep = ++by_rule_[rule.id] <= stored_per_rule;
  Diagnostic& place = keep ? items_.emplace_back() : discarded_ = Diagnostic{};
  place.rule = &rule;
  place.severity = severity;
  place.text = std::move(text);
  return place;
}

void Report::add(Diagnostic diagnostic) {
  Diagnostic& place = add(*diagnostic.rule, diagnostic.severity, {});
  place = std::move(diagnostic);
}

void Report::append(Report other) {
  std::unordered_map<std::string_view, std::size_t> stored;
  for (const Diagnostic& item : items_) ++stored[item.rule->id];
  for (Diagnostic& item : other.items_)
    if (++stored[item.rule->id] <= stored_per_rule) items_.push_back(std::move(item));
  for (std::size_t i = 0; i < by_severity_.size(); ++i) by_severity_[i] += other.by_severity_[i];
  for (const auto& [id, count] : other.by_rule_) by_rule_[id] += count;
}

std::size_t Report::count(std::string_view rule_id) const {
  const auto found = by_rule_.find(rule_id);
  return found == by_rule_.end() ? 0 : found->second;
}

void Report::sort() {
  std::stable_sort(items_.begin(), items_.end(), [](const Diagnostic& a, const Diagnostic& b) {
    if (a.location.offset != b.location.offset) return a.location.offset < b.location.offset;
    return a.rule->id < b.rule->id;
  });
}

}  // namespace trimloop
