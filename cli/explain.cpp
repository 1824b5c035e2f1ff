// trimloop explain: what a rule means.

#include <fmt/format.h>

#include <algorithm>

#include "cli/terminal.h"
#include "formats/iges/repair.h"

namespace trimloop::cli {

int explain(const Common& common, const ExplainOptions& options) {
  if (options.list) {
    std::string out;
    for (const Rule* rule : io::all_rules()) {
      out += fmt::format("{:<12} {:<26} {:<8} {}\n", rule->id, rule->slug, to_string(rule->severity), rule->checks);
    }
    return emit(common, out) ? Done : CannotReadOrWrite;
  }
  if (options.id.empty()) {
    complain(common, "explain needs a rule id or slug", "trimloop explain --list");
    return Usage;
  }
  const Rule* rule = io::find_rule(options.id);
  if (rule == nullptr) {
    complain(common, fmt::format("no rule is called '{}'", options.id), "trimloop explain --list");
    return Usage;
  }
  std::string out = fmt::format("{} {} ({})\n\n  What it checks   {}\n  Why it hurts     {}\n  What to do       {}\n",
                                rule->id, rule->slug, to_string(rule->severity), rule->checks, rule->why, rule->remedy);
  if (!rule->unit.empty()) out += fmt::format("  Measured in      {}\n", rule->unit);
  if (!rule->clause.empty()) out += fmt::format("  Source           {}\n", rule->clause);
  const auto repairable = iges::repairable_rules();
  if (std::find(repairable.begin(), repairable.end(), rule) != repairable.end())
    out += fmt::format("  Repair           trimloop fix --select {} IN OUT\n", rule->id);
  return emit(common, out) ? Done : CannotReadOrWrite;
}

}  // namespace trimloop::cli
