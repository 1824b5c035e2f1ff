#pragma once
// What every reader of the import shares: the file and its units, each record decoded once, references resolved and
// checked, and findings that know which entity is being read and who asked for it.

#include <memory>
#include <string_view>
#include <vector>

#include "base/limits.h"
#include "base/report.h"
#include "formats/iges/file.h"
#include "formats/iges/records/record.h"
#include "formats/iges/records/table_record.h"
#include "io/external.h"
#include "io/iges/units.h"
#include "kernel/geometry/surface.h"
#include "kernel/model/model.h"

namespace trimloop::io::iges_import {

using iges::DirectoryEntry;
using iges::Ref;

// A surface in model space (mm, transforms applied) and how the file's parameters map onto its own.
struct PlacedSurface {
  SurfacePtr surface;
  UvMap map;                         // parameters of the file -> parameters of `surface`
  std::optional<UvMap> second_map;   // where files differ (degrees or radians): the other reading
  bool has_parameters = true;        // false: 108, whose parametrization the standard does not fix
  // Our Su x Sv points against the one that the file's parameters give.
  bool flipped() const { return map.uu * map.vv - map.uv * map.vu < 0; }
};

// Who gives the bytes of files that entities name, how deep this one is among them, and how many were asked for.
struct External {
  const Resolver* resolve = nullptr;
  std::size_t depth = 0;
  std::shared_ptr<std::size_t> opened = std::make_shared<std::size_t>(0);
};

// Which roles an entity may play where it is pointed at: IG-R03 when it cannot.
using Admits = bool (*)(const DirectoryEntry&);

class Context {
 public:
  Context(const iges::File& file, const Execution& execution, std::optional<LengthUnit> assume_unit, Report& report);

  const iges::File& file;
  const Execution& execution;
  Report& report;
  FileUnit unit;
  double resolution_mm = 1e-3;   // closer points are one
  bool measure_healed = false;   // areas of healed faces before and after
  External external;

  // The entity at `ref`, or null when there is none or `admits` refuses it. The record's reader has reported dangling
  // pointers and wrong types; what is left is IG-R03 here. `wanted` says what belongs there: "a curve".
  const DirectoryEntry* resolve(Ref ref, Admits admits, std::string_view wanted);

  // The record of an entity of type Record::type, decoded once and kept; null when it cannot be used (findings say why).
  template <class Record>
  const Record* record(const DirectoryEntry& entry);
  // The same for bulky records that are needed once: not kept.
  template <class Record>
  std::optional<Record> decode(const DirectoryEntry& entry);
  // The record of an entity without a struct, by the layout table; decoded once and kept.
  const iges::TableRecord* table(const DirectoryEntry& entry);
  // Pointers behind the own parameters of a record decoded before.
  const iges::TrailingGroups& groups(const DirectoryEntry& entry) const;

  struct State {  // of one entity
    bool decoded = false, usable = false;
    bool busy = false;         // being read now: meeting it again is a cycle
    bool visited = false;      // has been read at least once
    bool consumed = false;     // has become part of the model
    bool curve_known = false, surface_known = false;
    std::shared_ptr<const void> record;
    std::unique_ptr<iges::TrailingGroups> groups;
    CurvePtr curve;
    std::unique_ptr<PlacedSurface> surface;
  };
  State& state(const DirectoryEntry& entry) { return states_[index(entry)]; }
  const State& state(const DirectoryEntry& entry) const { return states_[index(entry)]; }
  std::size_t index(const DirectoryEntry& entry) const {
    return static_cast<std::size_t>(&entry - file.directory().data());
  }

  // A finding about the entity being read (or `entry`), with its owners as path.
  Diagnostic& add(const Rule& rule, std::string text, double measured = not_measured, double limit = not_measured);
  Diagnostic& add(const Rule& rule, Severity severity, std::string text, double measured = not_measured,
                  double limit = not_measured);
  Diagnostic& add(const DirectoryEntry& entry, const Rule& rule, std::string text, double measured = not_measured,
                  double limit = not_measured);
  Diagnostic& add(const DirectoryEntry& entry, const Rule& rule, Severity severity, std::string text,
                  double measured = not_measured, double limit = not_measured);
  // Why a face could not be made: the last sentence given to `add`.
  const std::string& last_text() const { return last_text_; }

 private:
  friend class Visit;
  bool finish(const DirectoryEntry& entry, iges::TokenReader& reader);  // keeps the pointer groups; usable?
  std::vector<State> states_;
  std::vector<const DirectoryEntry*> path_;   // entities being read, outermost first
  std::string last_text_;
};

// An entity being read, from construction to destruction. False when it is already being read (IG-R04) or the nesting
// is too deep (LM-05); both are then in the report.
class Visit {
 public:
  Visit(Context& context, const DirectoryEntry& entry);
  ~Visit();
  Visit(const Visit&) = delete;
  Visit& operator=(const Visit&) = delete;
  explicit operator bool() const { return entered_; }

 private:
  Context& context_;
  const DirectoryEntry& entry_;
  bool entered_ = false;
};

std::string name_of(const DirectoryEntry& entry);          // "D171"
inline SourceRef source_of(const DirectoryEntry& entry, std::uint8_t role = 0) {
  return {static_cast<std::uint64_t>(entry.de), role};
}

// Roles.
bool is_curve(const DirectoryEntry&);      // bounded or not: 100 102 104 106 110 112 126 130
bool is_point(const DirectoryEntry&);      // 116
bool is_surface(const DirectoryEntry&);    // 108 114 118 120 122 128 140 190-198
bool is_direction(const DirectoryEntry&);  // 123

template <class Record>
std::optional<Record> Context::decode(const DirectoryEntry& entry) {
  const iges::Parameters parameters = file.parameters(entry, report);
  iges::TokenReader reader(file, entry, parameters, execution.limits, report);
  Record record = Record::read(reader);
  if (!finish(entry, reader)) return std::nullopt;
  return record;
}

template <class Record>
const Record* Context::record(const DirectoryEntry& entry) {
  if (entry.type != Record::type) return nullptr;
  State& s = state(entry);
  if (!s.decoded) {
    if (auto decoded = decode<Record>(entry)) s.record = std::make_shared<const Record>(std::move(*decoded));
  }
  return static_cast<const Record*>(s.record.get());
}

}  // namespace trimloop::io::iges_import
