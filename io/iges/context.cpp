#include "io/iges/context.h"

#include "base/assert.h"
#include "formats/iges/rules.h"
#include "io/rules.h"

namespace trimloop::io::iges_import {
namespace {

// The stated resolution when it can be one: not above a hundredth of the model, which would swallow real gaps, and not
// below what double coordinates of that size can hold. 1e-3 mm when nothing is stated.
double resolution_of(const iges::Global& global, double scale) {
  constexpr double unstated_mm = 1e-3;
  const double stated = global.resolution * scale;
  if (!(stated > 0) || !std::isfinite(stated)) return unstated_mm;
  const double extent = std::abs(global.max_coordinate) * scale;
  const bool extent_known = extent > 0 && std::isfinite(extent);
  const double coarsest = extent_known ? std::max(1e-2 * extent, unstated_mm) : 1.0;
  const double finest = extent_known ? 1e-12 * extent : 1e-9;
  return std::min(std::max(stated, finest), coarsest);
}

std::string type_name(const DirectoryEntry& entry) {
  return std::to_string(entry.type) + ":" + std::to_string(entry.form);
}

}  // namespace

Context::Context(const iges::File& f, const Execution& e, std::optional<LengthUnit> assume_unit, Report& r)
    : file(f), execution(e), report(r), unit(file_unit(f.global(), assume_unit, r)), states_(f.directory().size()) {
  resolution_mm = resolution_of(f.global(), unit.scale);
}

const DirectoryEntry* Context::resolve(Ref ref, Admits admits, std::string_view wanted) {
  const DirectoryEntry* target = ref ? file.find(ref) : nullptr;
  if (!target || admits(*target)) return target;
  add(iges::rules::target_type, name_of(*target) + " is a " + type_name(*target) + " where " + std::string(wanted) +
                                    " is expected; it is left out");
  return nullptr;
}

const iges::TrailingGroups& Context::groups(const DirectoryEntry& entry) const {
  static const iges::TrailingGroups none;
  const State& s = state(entry);
  return s.groups ? *s.groups : none;
}

Diagnostic& Context::add(const Rule& rule, std::string text, double measured, double limit) {
  return add(rule, rule.severity, std::move(text), measured, limit);
}

Diagnostic& Context::add(const Rule& rule, Severity severity, std::string text, double measured, double limit) {
  TRIMLOOP_ASSERT(!path_.empty(), "a finding without an entity names one");
  return add(*path_.back(), rule, severity, std::move(text), measured, limit);
}

Diagnostic& Context::add(const DirectoryEntry& entry, const Rule& rule, std::string text, double measured,
                         double limit) {
  return add(entry, rule, rule.severity, std::move(text), measured, limit);
}

Diagnostic& Context::add(const DirectoryEntry& entry, const Rule& rule, Severity severity, std::string text,
                         double measured, double limit) {
  last_text_ = text;
  Diagnostic& d = report.add(rule, severity, std::move(text));
  d.location = file.locate(entry.offset);
  d.entity = name_of(entry);
  d.type = type_name(entry);
  for (auto owner = path_.rbegin(); owner != path_.rend(); ++owner)
    if (*owner != &entry) d.path.push_back(name_of(**owner));
  d.measured = measured;
  d.limit = limit;
  return d;
}

Visit::Visit(Context& context, const DirectoryEntry& entry) : context_(context), entry_(entry) {
  Context::State& state = context.state(entry);
  const std::size_t deepest = context.execution.limits.nesting_depth;
  if (state.busy) {
    context.add(iges::rules::cycle, name_of(entry) + " is part of itself; this reference is not followed");
  } else if (context.path_.size() >= deepest) {
    context.add(rules::depth, "entities are nested deeper than " + std::to_string(deepest) + "; the rest is left out",
                static_cast<double>(context.path_.size()), static_cast<double>(deepest));
  } else {
    entered_ = state.busy = state.visited = true;
    context.path_.push_back(&entry);
  }
}

Visit::~Visit() {
  if (!entered_) return;
  context_.state(entry_).busy = false;
  context_.path_.pop_back();
}

std::string name_of(const DirectoryEntry& entry) { return "D" + std::to_string(entry.de); }

bool is_curve(const DirectoryEntry& e) {
  switch (e.type) {
    case 100: case 102: case 104: case 110: case 112: case 126: case 130: return true;
    case 106: return (e.form >= 11 && e.form <= 13) || e.form == 63;
    default: return false;
  }
}

bool is_point(const DirectoryEntry& e) { return e.type == 116; }

bool is_surface(const DirectoryEntry& e) {
  switch (e.type) {
    case 108: case 114: case 118: case 120: case 122: case 128: case 140:
    case 190: case 192: case 194: case 196: case 198: return true;
    default: return false;
  }
}

bool is_direction(const DirectoryEntry& e) { return e.type == 123; }

}  // namespace trimloop::io::iges_import
