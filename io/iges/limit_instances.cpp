#include "formats/iges/records/structure.h"
#include "formats/iges/rules.h"
#include "io/iges/structure.h"
#include "io/rules.h"

namespace trimloop::io::iges_import {
namespace {

// What one occurrence of a part unfolds to.
struct Unfolded {
  std::size_t occurrences = 1, depth = 0;
  enum class Visit : std::uint8_t { New, Open, Done } visit = Visit::New;
};

const DirectoryEntry* entry_of(const Context& context, const Instance& instance) {
  return instance.source.empty() ? nullptr : context.file.find(Ref{static_cast<std::int32_t>(instance.source[0].id)});
}

// Adds one instance to its owner's sum, or says why it cannot stay.
bool admit(Context& context, const Instance& instance, const Unfolded& child, Unfolded& owner) {
  const Limits& limits = context.execution.limits;
  const DirectoryEntry& entry = *entry_of(context, instance);
  if (child.visit == Unfolded::Visit::Open) {
    context.add(entry, iges::rules::subfigure_self, "the definition contains this instance of itself; it is left out");
    return false;
  }
  if (child.depth + 1 >= limits.nesting_depth) {
    context.add(entry, rules::depth, "subfigures are nested too deep below this instance; it is left out",
                static_cast<double>(child.depth + 1), static_cast<double>(limits.nesting_depth));
    return false;
  }
  const auto sum = checked_add(owner.occurrences, child.occurrences);
  if (!sum || *sum > limits.instances) {
    const double asked = static_cast<double>(owner.occurrences) + static_cast<double>(child.occurrences);
    context.add(entry, iges::rules::expansion_bomb, "unfolding this instance passes the limit; it is left out", asked,
                static_cast<double>(limits.instances));
    return false;
  }
  owner.occurrences = *sum;
  owner.depth = std::max(owner.depth, child.depth + 1);
  return true;
}

}  // namespace

void limit_instances(Context& context, Model& model, const std::vector<const DirectoryEntry*>& definitions) {
  // 1. Depth first over the parts with an explicit stack: a part is summed up when all its instances are.
  struct Frame {
    std::uint32_t part;
    std::size_t next = 0, kept = 0;
  };
  std::vector<Unfolded> unfolded(model.parts.size());
  for (std::uint32_t root = 0; root < model.parts.size(); ++root) {
    if (unfolded[root].visit != Unfolded::Visit::New) continue;
    std::vector<Frame> stack{{root}};
    unfolded[root].visit = Unfolded::Visit::Open;
    while (!stack.empty()) {
      Frame& top = stack.back();
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
      if (admit(context, instances[top.next], unfolded[child], unfolded[top.part])) {
        if (top.kept != top.next) instances[top.kept] = std::move(instances[top.next]);
        ++top.kept;
      }
      ++top.next;
    }
  }
  // 2. The declared nesting depth of a definition (308, DEPTH) against the real one.
  for (std::size_t part = 1; part < model.parts.size() && part < definitions.size(); ++part) {
    const auto* record = context.record<iges::SubfigureDefinition>(*definitions[part]);
    if (record && record->depth != static_cast<std::int64_t>(unfolded[part].depth))
      context.add(*definitions[part], iges::rules::subfigure_depth, "the stated nesting depth is not the real one",
                  static_cast<double>(record->depth), static_cast<double>(unfolded[part].depth));
  }
}

}  // namespace trimloop::io::iges_import
