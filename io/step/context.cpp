#include "io/step/context.h"

#include <fmt/format.h>

#include "formats/step/rules.h"
#include "io/rules.h"

namespace trimloop::io::step_import {

namespace sr = step::rules;

Context::Context(const step::File& f, const Execution& e, std::optional<LengthUnit> assume, Report& r)
    : file(f), execution(e), assume_unit(assume), report(r), consumed_(f.instances().size()), busy_(f.instances().size()) {}

const Record* Context::resolve(const Record& owner, Ref ref, Entity wanted) {
  const Record* target = find(ref);
  if (target && is(*target, wanted)) return target;
  if (!target) {
    if (ref) add(owner, sr::reference_unresolved, fmt::format("#{} is not in the file", ref.id));
    return nullptr;
  }
  const std::string_view keyword = step::info(wanted).keyword;
  add(owner, sr::attribute_type, fmt::format("#{} is a {} where a {} is expected", ref.id, file.keyword(*target).name, keyword));
  return nullptr;
}

std::vector<Ref> Context::references(const Record& instance) {
  std::vector<Ref> out;
  if (!tape_.read(file.value(instance), execution.limits)) return out;
  for (std::uint32_t i = 0; i < tape_.size(); ++i)
    if (tape_[i].kind == step::Token::Kind::Reference) out.push_back({tape_[i].id});
  return out;
}

const Units& Context::units_of(const Record* context) {
  if (!context || !is(*context, Entity::RepresentationContext)) return first_units();
  const auto [at, fresh] = units_.try_emplace(index(*context));
  if (fresh) {
    auto units = std::make_unique<Units>(read_units(*this, *context));
    units_[index(*context)] = std::move(units);  // reading may have moved the table
  }
  return *units_[index(*context)];
}

const Units& Context::first_units() {
  if (first_units_) return *first_units_;
  for (const Record& i : file.instances()) {
    if (!is(i, Entity::GlobalUnitAssignedContext)) continue;
    const Units& units = units_of(&i);
    if (!units.is_known) continue;
    first_units_ = std::make_unique<Units>(units);
    return *first_units_;
  }
  first_units_ = std::make_unique<Units>();
  if (assume_unit) {
    first_units_->unit = *assume_unit;
    first_units_->mm = millimetres_per(*assume_unit);
  }
  return *first_units_;
}

Diagnostic& Context::add(const Record& instance, const Rule& rule, std::string text, double measured, double limit) {
  return add(instance, rule, rule.severity, std::move(text), measured, limit);
}

Diagnostic& Context::add(const Record& instance, const Rule& rule, Severity severity, std::string text, double measured,
                         double limit) {
  last_text_ = text;
  Diagnostic& d = report.add(rule, severity, std::move(text));
  step::place(d, file, instance);
  d.measured = measured;
  d.limit = limit;
  return d;
}

Visit::Visit(Context& context, const Record& instance) : context_(context), instance_(instance) {
  const std::size_t deepest = context.execution.limits.nesting_depth;
  if (context.busy_[context.index(instance)]) {
    context.add(instance, sr::reference_self, fmt::format("#{} is part of itself; this reference is not followed", instance.id));
  } else if (context.depth_ >= deepest) {
    context.add(instance, rules::depth, fmt::format("instances are nested deeper than {}; the rest is left out", deepest),
                static_cast<double>(context.depth_), static_cast<double>(deepest));
  } else {
    entered_ = true;
    context.busy_[context.index(instance)] = true;
    ++context.depth_;
  }
}

Visit::~Visit() {
  if (!entered_) return;
  context_.busy_[context_.index(instance_)] = false;
  --context_.depth_;
}

}  // namespace trimloop::io::step_import
