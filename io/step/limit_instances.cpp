#include "formats/step/rules.h"
#include "io/rules.h"
#include "io/step/structure.h"

namespace trimloop::io::step_import {
namespace {

namespace sr = step::rules;

// What one occurrence of a part unfolds to.
struct Unfolded {
  std::size_t occurrences = 1, depth = 0;
  enum class Visit : std::uint8_t { New, Open, Done } visit = Visit::New;
};

void add(Context& context, const Instance& instance, const Rule& rule, std::string text, double measured = not_measured,
         double limit = not_measured) {
  const Record* record = instance.source.empty() ? nullptr : context.find(Ref{instance.source[0].id});
  if (record) {
    context.add(*record, rule, std::move(text), measured, limit);
    return;
  }
  Diagnostic& d = context.report.add(rule, std::move(text));
  d.measured = measured;
  d.limit = limit;
}

// Adds one instance to its owner's sum, or says why it cannot stay.
bool admit(Context& context, const Instance& instance, const Unfolded& child, Unfolded& owner) {
  const Limits& limits = context.execution.limits;
  if (child.visit == Unfolded::Visit::Open) {
    const Record* record = instance.source.empty() ? nullptr : context.find(Ref{instance.source[0].id});
    const bool mapped = record && context.is(*record, Entity::MappedItem);
    add(context, instance, mapped ? sr::mapped_cycle : sr::assembly_cycle, "this occurrence is inside what it contains; it is left out");
    return false;
  }
  if (child.depth + 1 >= limits.nesting_depth) {
    add(context, instance, rules::depth, "occurrences are nested too deep below this one; it is left out",
        static_cast<double>(child.depth + 1), static_cast<double>(limits.nesting_depth));
    return false;
  }
  const auto sum = checked_add(owner.occurrences, child.occurrences);
  if (!sum || *sum > limits.instances) {
    const double asked = static_cast<double>(owner.occurrences) + static_cast<double>(child.occurrences);
    add(context, instance, sr::expansion, "unfolding this occurrence passes the limit; it is left out", asked,
        static_cast<double>(limits.instances));
    return false;
  }
  owner.occurrences = *sum;
  owner.depth = std::max(owner.depth, child.depth + 1);
  return true;
}

}  // namespace

void limit_instances(Context& context, Model& model) {
  // Depth first over the parts with an explicit stack: a part is summed up when all its instances are.
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
}

}  // namespace trimloop::io::step_import
