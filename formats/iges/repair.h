#pragma once
// Repairs that cannot change what a file means: counters, pointers back, columns, status digits, flags that contradict the
// numbers beside them. Docs: docs/formats-iges.md, "Repairs".

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/limits.h"
#include "formats/iges/file.h"

namespace trimloop::iges {

struct Change {
  const Rule* rule = nullptr;
  std::string entity;         // "D171", or empty
  std::size_t line = 0;       // of the file as it was before the repairs of this rule, from 1; 0: behind its end
  std::string before, after;  // the bytes replaced
};

struct Repaired {
  std::string bytes;
  std::vector<Change> changes;
  // Rules whose findings stayed, with the reason: the repair would have made another finding, or could not be made.
  std::vector<std::pair<const Rule*, std::string>> refused;
};

// Rules that can be repaired, in the order in which they are.
std::span<const Rule* const> repairable_rules();

// Repairs the findings of the rules for which `wanted(rule)` holds and whose severity is at least `least`. Each rule's
// changes are kept only when the file, read again with all its records, has fewer findings of that rule, no more of any
// other, and the same entities; else they are taken back and the rule is among `refused`. A second run changes nothing.
// Cost: about three readings for each rule that has findings.
Repaired repair(std::string bytes, const std::function<bool(const Rule&)>& wanted, Severity least, const Limits& limits);

}  // namespace trimloop::iges
