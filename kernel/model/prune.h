#pragma once
// Instances that make a model endless or larger than its limits are taken out.

#include "base/limits.h"
#include "kernel/model/model.h"

namespace trimloop {

enum class Excess : std::uint8_t {
  Cycle,  // the part is placed inside itself
  Depth,  // nested deeper than limits.nesting_depth
  Count   // unfolding it passes limits.instances
};
struct PrunedInstance {
  Instance instance;
  Excess why = Excess::Cycle;
  double measured = 0, limit = 0;  // of Depth and Count
};
struct Pruning {
  std::vector<PrunedInstance> pruned;  // in the order of the walk
  std::vector<std::size_t> depth;      // of each part: levels of instances below it
};
// Linear in the number of instances; no recursion.
Pruning prune_instances(Model&, const Limits&);

}  // namespace trimloop
