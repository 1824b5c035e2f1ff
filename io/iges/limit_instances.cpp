#include "formats/iges/records/structure.h"
#include "formats/iges/rules.h"
#include "io/iges/structure.h"
#include "io/rules.h"
#include "kernel/model/prune.h"

namespace trimloop::io::iges_import {
namespace {

void report(Context& context, const PrunedInstance& p) {
  if (p.instance.source.empty()) return;
  const DirectoryEntry* entry = context.file.find(Ref{static_cast<std::int32_t>(p.instance.source[0].id)});
  if (!entry) return;
  switch (p.why) {
    case Excess::Cycle:
      context.add(*entry, iges::rules::subfigure_self, "the definition contains this instance of itself; it is left out");
      break;
    case Excess::Depth:
      context.add(*entry, rules::depth, "subfigures are nested too deep below this instance; it is left out", p.measured, p.limit);
      break;
    case Excess::Count:
      context.add(*entry, iges::rules::expansion_bomb, "unfolding this instance passes the limit; it is left out", p.measured, p.limit);
      break;
  }
}

}  // namespace

void limit_instances(Context& context, Model& model, const std::vector<const DirectoryEntry*>& definitions) {
  const Pruning pruning = prune_instances(model, context.execution.limits);
  for (const PrunedInstance& p : pruning.pruned) report(context, p);
  // The declared nesting depth of a definition (308, DEPTH) against the real one.
  for (std::size_t part = 1; part < model.parts.size() && part < definitions.size(); ++part) {
    if (!definitions[part]) continue;
    const auto* record = context.record<iges::SubfigureDefinition>(*definitions[part]);
    if (record && record->depth != static_cast<std::int64_t>(pruning.depth[part]))
      context.add(*definitions[part], iges::rules::subfigure_depth, "the stated nesting depth is not the real one",
                  static_cast<double>(record->depth), static_cast<double>(pruning.depth[part]));
  }
}

}  // namespace trimloop::io::iges_import
