#include "io/iges/ownership.h"

#include "formats/iges/records/curves.h"
#include "formats/iges/records/structure.h"
#include "formats/iges/records/surfaces.h"
#include "formats/iges/records/trimming.h"
#include "formats/iges/rules.h"

namespace trimloop::io::iges_import {
namespace {

using Refs = std::vector<Ref>;

template <class Record, class Collect>
Refs from(Context& context, const DirectoryEntry& entry, Collect collect) {
  Refs out;
  if (const Record* record = context.record<Record>(entry)) collect(*record, out);
  return out;
}

void append(Refs& out, const Refs& more) { out.insert(out.end(), more.begin(), more.end()); }

// Pointers of the elementary surfaces 190-198 to their points and directions.
Refs elementary_parts(Context& c, const DirectoryEntry& e) {
  switch (e.type) {
    case 190:
      return from<iges::PlaneSurface>(c, e, [](const auto& r, Refs& o) { o = {r.location, r.normal, r.reference}; });
    case 192:
      return from<iges::CylindricalSurface>(c, e, [](const auto& r, Refs& o) { o = {r.location, r.axis, r.reference}; });
    case 194:
      return from<iges::ConicalSurface>(c, e, [](const auto& r, Refs& o) { o = {r.location, r.axis, r.reference}; });
    case 196:
      return from<iges::SphericalSurface>(c, e, [](const auto& r, Refs& o) { o = {r.centre, r.axis, r.reference}; });
    default:
      return from<iges::ToroidalSurface>(c, e, [](const auto& r, Refs& o) { o = {r.centre, r.axis, r.reference}; });
  }
}

Refs boundary_parts(Context& c, const DirectoryEntry& e) {
  return from<iges::Boundary>(c, e, [](const auto& r, Refs& o) {
    o.push_back(r.surface);
    for (const auto& item : r.items) {
      o.push_back(item.curve);
      append(o, item.pcurves);
    }
  });
}

Refs brep_parts(Context& c, const DirectoryEntry& e) {
  switch (e.type) {
    case 186:
      return from<iges::ManifoldSolid>(c, e, [](const auto& r, Refs& o) {
        o.push_back(r.shell);
        for (const auto& v : r.voids) o.push_back(v.shell);
      });
    case 514:
      return from<iges::ShellRecord>(c, e, [](const auto& r, Refs& o) {
        for (const auto& item : r.faces) o.push_back(item.face);
      });
    case 510:
      return from<iges::FaceRecord>(c, e, [](const auto& r, Refs& o) {
        o = r.loops;
        o.push_back(r.surface);
      });
    case 508:
      return from<iges::LoopRecord>(c, e, [](const auto& r, Refs& o) {
        for (const auto& item : r.items) {
          o.push_back(item.list);
          for (const auto& p : item.pcurves) o.push_back(p.curve);
        }
      });
    default:
      return from<iges::EdgeList>(c, e, [](const auto& r, Refs& o) {
        for (const auto& item : r.edges) {
          o.push_back(item.curve);
          o.push_back(item.start_list);
          o.push_back(item.end_list);
        }
      });
  }
}

bool is_drafting(const DirectoryEntry& e) {
  return (e.type >= 202 && e.type <= 230) || (e.type == 106 && e.form >= 20 && e.form <= 40);
}

// Parts of types read by the layout table. Of the pointers of an annotation, all drafting entities are parts of it, other
// curves where they are marked as dependent; the base of an array and the outline of a flash likewise.
Refs table_parts(Context& context, const DirectoryEntry& entry) {
  const iges::TableRecord* record = context.table(entry);
  if (!record) return {};
  Refs out;
  const auto dependent = [](const DirectoryEntry& e) { return e.status.subordinate == 1 || e.status.subordinate == 3; };
  switch (entry.type) {
    case 162: case 164: case 180: case 410: return pointers(*record);
    case 182:
      if (const DirectoryEntry* e = context.file.find(record->ref("BTREE")); e && e->type == 180) return pointers(*record);
      return {};
    case 184: case 430:
      for (const Ref ref : pointers(*record))
        if (const DirectoryEntry* e = context.file.find(ref); e && e->type != iges::TransformationMatrix::type) out.push_back(ref);
      return out;
    case 320: {
      for (std::size_t i = 1, n = record->count("N"); i <= n; ++i) out.push_back(record->ref("DE", {i}));
      return out;
    }
    case 404:
      for (std::size_t i = 1, n = record->count("M"); i <= n; ++i) out.push_back(record->ref("DPTR", {i}));
      return out;
    default:
      for (const Ref ref : pointers(*record)) {
        const DirectoryEntry* e = context.file.find(ref);
        if (e && ((is_drafting(entry) && is_drafting(*e)) || dependent(*e))) out.push_back(ref);
      }
      return out;
  }
}

// Parts of an entity that becomes a shape or holds shapes.
Refs parts_of(Context& c, const DirectoryEntry& e) {
  switch (e.type) {
    case 102: return from<iges::CompositeCurve>(c, e, [](const auto& r, Refs& o) { o = r.members; });
    case 108: return from<iges::PlaneRecord>(c, e, [](const auto& r, Refs& o) { o = {r.boundary}; });
    case 118: return from<iges::RuledSurface>(c, e, [](const auto& r, Refs& o) { o = {r.first, r.second}; });
    case 120: return from<iges::SurfaceOfRevolution>(c, e, [](const auto& r, Refs& o) { o = {r.axis, r.generatrix}; });
    case 122: return from<iges::TabulatedCylinder>(c, e, [](const auto& r, Refs& o) { o = {r.directrix}; });
    case 130: return from<iges::OffsetCurve>(c, e, [](const auto& r, Refs& o) { o = {r.basis, r.function}; });
    case 140: return from<iges::OffsetSurface>(c, e, [](const auto& r, Refs& o) { o = {r.basis}; });
    case 141: return boundary_parts(c, e);
    case 142: return from<iges::CurveOnSurface>(c, e, [](const auto& r, Refs& o) { o = {r.surface, r.pcurve, r.curve}; });
    case 143:
      return from<iges::BoundedSurface>(c, e, [](const auto& r, Refs& o) {
        o = r.boundaries;
        o.push_back(r.surface);
      });
    case 144:
      return from<iges::TrimmedSurface>(c, e, [](const auto& r, Refs& o) {
        o = r.inner;
        o.push_back(r.outer);
        o.push_back(r.surface);
      });
    case 186: case 504: case 508: case 510: case 514: return brep_parts(c, e);
    case 190: case 192: case 194: case 196: case 198: return elementary_parts(c, e);
    case 308: return from<iges::SubfigureDefinition>(c, e, [](const auto& r, Refs& o) { o = r.members; });
    case 408:  // a definition stands for itself in no case; a file that is placed does not stand for itself as well
      return from<iges::SubfigureInstance>(c, e, [&](const auto& r, Refs& o) {
        if (const DirectoryEntry* target = c.file.find(r.definition); target && target->type == 416) o = {r.definition};
      });
    case 402:
      if (e.form != 9) return {};
      return from<iges::Associativity>(c, e, [](const auto& r, Refs& o) { o = r.members; });
    case 125: case 162: case 164: case 180: case 182: case 184: case 202: case 204: case 206: case 208: case 210: case 216:
    case 218: case 220: case 222: case 228: case 230: case 320: case 404: case 410: case 412: case 414: case 430:
      return table_parts(c, e);
    default: return {};
  }
}

// Groups that are members of themselves, straight or through other groups. Each group is entered once.
void report_group_cycles(Context& context) {
  const auto members = [&](const DirectoryEntry& e) -> const Refs* {
    if (e.type != iges::Associativity::type || !iges::Associativity::has_members(e.form)) return nullptr;
    const auto* group = context.record<iges::Associativity>(e);
    return group ? &group->members : nullptr;
  };
  enum class Mark : std::uint8_t { New, Open, Done };
  const auto& directory = context.file.directory();
  std::vector<Mark> marks(directory.size(), Mark::New);
  struct Level {
    const DirectoryEntry* group;
    const Refs* members;
    std::size_t next = 0;
  };
  std::vector<Level> path;
  const auto enter = [&](const DirectoryEntry& e) {
    if (const Refs* of = members(e)) marks[context.index(e)] = Mark::Open, path.push_back({&e, of});
  };
  for (const DirectoryEntry& entry : directory) {
    if (marks[context.index(entry)] == Mark::New) enter(entry);
    while (!path.empty()) {
      Level& top = path.back();
      if (top.next == top.members->size()) {
        marks[context.index(*top.group)] = Mark::Done;
        path.pop_back();
        continue;
      }
      const DirectoryEntry* member = context.file.find((*top.members)[top.next++]);
      if (!member) continue;
      const Mark mark = marks[context.index(*member)];
      if (mark == Mark::Open)
        context.add(*top.group, iges::rules::cycle, name_of(*member) + " is part of itself; this reference is not followed");
      if (mark == Mark::New) enter(*member);
    }
  }
}

}  // namespace

Ownership ownership(Context& context) {
  const auto& directory = context.file.directory();
  Ownership out;
  out.owned.assign(directory.size(), false);
  out.group.assign(directory.size(), nullptr);
  report_group_cycles(context);
  for (const DirectoryEntry& entry : directory) {
    for (const Ref ref : parts_of(context, entry))
      if (const DirectoryEntry* part = ref ? context.file.find(ref) : nullptr; part && part != &entry)
        out.owned[context.index(*part)] = true;
    if (entry.type != iges::Associativity::type || !iges::Associativity::has_members(entry.form)) continue;
    const auto* group = context.record<iges::Associativity>(entry);
    if (!group) continue;
    if (entry.form == 9) {
      const DirectoryEntry* plane = context.file.find(group->parent);
      for (const Ref ref : group->members)
        if (const DirectoryEntry* hole = context.file.find(ref); plane && hole && hole->type == 108)
          out.holes[context.index(*plane)].push_back(hole);
    } else {
      for (const Ref ref : group->members)
        if (const DirectoryEntry* member = context.file.find(ref); member && member != &entry)
          if (auto& first = out.group[context.index(*member)]; !first) first = &entry;
    }
  }
  return out;
}

}  // namespace trimloop::io::iges_import
