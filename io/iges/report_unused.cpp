#include <map>

#include "formats/iges/names.h"
#include "formats/iges/records/any.h"
#include "formats/iges/rules.h"
#include "io/iges/structure.h"
#include "io/rules.h"

namespace trimloop::io::iges_import {
namespace {

enum class Meaning : std::uint8_t { Handled, Geometry, Other };

// What the import makes of an entity type, whether or not this one was used.
Meaning meaning(const DirectoryEntry& e) {
  switch (e.type) {
    case 0: case 100: case 102: case 104: case 108: case 110: case 112: case 114: case 116: case 118: case 120: case 122:
    case 123: case 124: case 125: case 126: case 128: case 130: case 132: case 134: case 140: case 141: case 142: case 143:
    case 144: case 150: case 152: case 154: case 156: case 158: case 160: case 162: case 164: case 168: case 180: case 182: case 184:
    case 186: case 190: case 192: case 194: case 196: case 198: case 202: case 204: case 206: case 208: case 210: case 212:
    case 213: case 214: case 216: case 218: case 220: case 222: case 228: case 230: case 304: case 308: case 314: case 320:
    case 404: case 408: case 410: case 412: case 414: case 420: case 430: case 502: case 504: case 508: case 510:
    case 514: return Meaning::Handled;
    case 106: case 306: case 416: return Meaning::Handled;
    case 161: return Meaning::Geometry;
    case 402:
      return e.form == 1 || e.form == 7 || e.form == 9 || e.form == 14 || e.form == 15 ? Meaning::Handled : Meaning::Other;
    case 406: return e.form == 1 || e.form == 3 || e.form == 15 || e.form == 16 || e.form == 17 ? Meaning::Handled : Meaning::Other;
    default: return Meaning::Other;
  }
}

}  // namespace

void report_unused(Context& context) {
  for (const DirectoryEntry& entry : context.file.directory()) {
    if (entry.type == 306) context.add(entry, iges::rules::e306::macro, "a macro is defined; it is kept and not run");
    Context::State& state = context.state(entry);
    if (state.decoded || !entry.usable || entry.type == 0) continue;
    state.decoded = true;
    read_any(context.file, entry, context.execution.limits, context.report);
  }
  struct Kind {
    const DirectoryEntry* first = nullptr;
    std::size_t count = 0;
    Meaning meaning = Meaning::Other;
  };
  std::map<std::pair<int, int>, Kind> kinds;
  for (const DirectoryEntry& entry : context.file.directory()) {
    const Meaning m = meaning(entry);
    if (m == Meaning::Handled) continue;
    Kind& kind = kinds[{entry.type, entry.form}];
    if (kind.count++ == 0) kind.first = &entry;
    kind.meaning = m;
  }
  for (const auto& [type, kind] : kinds) {
    const std::string name(iges::entity_name(type.first));
    const std::string what = std::to_string(kind.count) + (kind.count == 1 ? " entity" : " entities") + " of type " +
                             std::to_string(type.first) + ":" + std::to_string(type.second) +
                             (name.empty() ? "" : " (" + name + ")");
    if (kind.meaning == Meaning::Geometry)
      context.add(*kind.first, rules::unsupported, what + " cannot be turned into shapes yet; the model is without them",
                  static_cast<double>(kind.count));
    else
      context.add(*kind.first, rules::ignored, what + " have no place in the model", static_cast<double>(kind.count));
  }
}

}  // namespace trimloop::io::iges_import
