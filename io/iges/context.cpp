#include "io/iges/context.h"

#include <fmt/format.h>

#include "base/assert.h"
#include "formats/iges/rules.h"
#include "io/rules.h"

namespace trimloop::io::iges_import {
namespace {

std::string type_name(const DirectoryEntry& entry) {
  return std::to_string(entry.type) + ":" + std::to_string(entry.form);
}

}  // namespace

Context::Context(const iges::File& f, const Execution& e, std::optional<LengthUnit> assume_unit, Report& r)
    : file(f), execution(e), report(r), unit(file_unit(f.global(), assume_unit)),
      resolution_mm(iges::resolution_in_mm(f.global())), states_(f.directory().size()) {}

const DirectoryEntry* Context::resolve(Ref ref, Admits admits, std::string_view wanted) {
  const DirectoryEntry* target = ref ? file.find(ref) : nullptr;
  if (target && admits(*target)) return target;
  if (!target) {
    if (ref) last_text_ = fmt::format("D{} is not in the directory", ref.de);
    return nullptr;
  }
  last_text_ = name_of(*target) + " is of type " + type_name(*target) + " where " + std::string(wanted) + " is expected";
  // The record's reader has compared the types; what it lets pass and is refused here differs in more than that.
  const bool by_form = target->type == 106 || target->type == 108 || target->type == 143 || target->type == 144;
  if (by_form) add(iges::rules::target_type, last_text_ + "; it is left out");
  return nullptr;
}

bool Context::finish(const DirectoryEntry& entry, iges::TokenReader& reader) {
  State& s = state(entry);
  s.decoded = true;
  s.usable = reader.ok() && entry.usable;
  if (!s.usable) return false;
  iges::TrailingGroups groups = reader.trailing_groups();
  if (!groups.associativities.empty() || !groups.properties.empty())
    s.groups = std::make_unique<iges::TrailingGroups>(std::move(groups));
  return true;
}

const iges::TableRecord* Context::table(const DirectoryEntry& entry) {
  State& s = state(entry);
  if (!s.decoded) {
    s.decoded = true;
    const iges::Layout* layout = iges::find_layout(entry.type, entry.form);
    if (!layout) return nullptr;
    const iges::Parameters parameters = file.parameters(entry, report);
    iges::TokenReader reader(file, entry, parameters, execution.limits, report);
    iges::TableRecord record = iges::TableRecord::read(reader, *layout);
    if (finish(entry, reader)) s.record = std::make_shared<const iges::TableRecord>(std::move(record));
  }
  return static_cast<const iges::TableRecord*>(s.record.get());
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

std::string name_of(const DirectoryEntry& entry) { return fmt::format("D{}", entry.de); }

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
