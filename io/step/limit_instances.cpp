#include "formats/step/rules.h"
#include "io/rules.h"
#include "io/step/structure.h"
#include "kernel/model/prune.h"

namespace trimloop::io::step_import {
namespace {

namespace sr = step::rules;

void add(Context& context, const Record* record, const Rule& rule, std::string text, double measured, double limit) {
  if (record) {
    context.add(*record, rule, std::move(text), measured, limit);
    return;
  }
  Diagnostic& d = context.report.add(rule, std::move(text));
  d.measured = measured;
  d.limit = limit;
}

void report(Context& context, const PrunedInstance& p) {
  const Record* record = p.instance.source.empty() ? nullptr : context.find(Ref{p.instance.source[0].id});
  const bool mapped = record && context.is(*record, Entity::MappedItem);
  switch (p.why) {
    case Excess::Cycle:
      add(context, record, mapped ? sr::mapped_cycle : sr::assembly_cycle, "this occurrence is inside what it contains; it is left out",
          not_measured, not_measured);
      break;
    case Excess::Depth:
      add(context, record, rules::depth, "occurrences are nested too deep below this one; it is left out", p.measured, p.limit);
      break;
    case Excess::Count:
      add(context, record, sr::expansion, "unfolding this occurrence passes the limit; it is left out", p.measured, p.limit);
      break;
  }
}

}  // namespace

void limit_instances(Context& context, Model& model) {
  for (const PrunedInstance& p : prune_instances(model, context.execution.limits).pruned) report(context, p);
}

}  // namespace trimloop::io::step_import
