#include "kernel/model/prune.h"

namespace trimloop {

namespace {

// What one occurrence of a part unfolds to.
struct Unfolded {
  std::size_t occurrences = 1, depth = 0;
  enum class Visit : std::uint8_t { New, Open, Done } visit = Visit::New;
};

// Adds one instance to its owner's sum, or says why it cannot stay.
std::optional<PrunedInstance> admit(const Limits& limits, const Unfolded& child, Unfolded& owner) {
  if (child.visit == Unfolded::Visit::Open) return PrunedInstance{{}, Excess::Cycle};
  if (child.depth + 1 >= limits.nesting_depth)
    return PrunedInstance{{}, Excess::Depth, static_cast<double>(child.depth + 1), static_cast<double>(limits.nesting_depth)};
  const auto sum = checked_add(owner.occurrences, child.occurrences);
  if (!sum || *sum > limits.instances)
    return PrunedInstance{{}, Excess::Count, static_cast<double>(owner.occurrences) + static_cast<double>(child.occurrences),
                          static_cast<double>(limits.instances)};
  owner.occurrences = *sum;
  owner.depth = std::max(owner.depth, child.depth + 1);
  return std::nullopt;
}

}  // namespace

Pruning prune_instances(Model& model, const Limits& limits) {
  // Depth first over the parts with an explicit stack: a part is summed up when all its instances are.
  struct Level {
    std::uint32_t part;
    std::size_t next = 0, kept = 0;
  };
  Pruning out;
  std::vector<Unfolded> unfolded(model.parts.size());
  for (std::uint32_t root = 0; root < model.parts.size(); ++root) {
    if (unfolded[root].visit != Unfolded::Visit::New) continue;
    std::vector<Level> stack{{root}};
    unfolded[root].visit = Unfolded::Visit::Open;
    while (!stack.empty()) {
      Level& top = stack.back();
      auto& instances = model.parts[top.part].instances;
      if (top.next == instances.size()) {
        instances.resize(top.kept);
        unfolded[top.part].visit = Unfolded::Visit::Done;
        stack.pop_back();
        continue;
      }
      const std::uint32_t child = instances[top.next].part;
      if (unfolded[child].visit == Unfolded::Visit::New) {
        unfolded[child].visit = Unfolded::Visit::Open;
        stack.push_back({child});  // comes back to the same instance when the child is done
        continue;
      }
      if (auto excess = admit(limits, unfolded[child], unfolded[top.part])) {
        excess->instance = std::move(instances[top.next]);
        out.pruned.push_back(std::move(*excess));
      } else {
        if (top.kept != top.next) instances[top.kept] = std::move(instances[top.next]);
        ++top.kept;
      }
      ++top.next;
    }
  }
  for (const Unfolded& u : unfolded) out.depth.push_back(u.depth);
  return out;
}

}  // namespace trimloop
