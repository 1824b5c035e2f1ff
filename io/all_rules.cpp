#include "formats/iges/rules.h"
#include "formats/step/rules.h"
#include "io/description/rules.h"
#include "io/file_rules.h"
#include "io/io.h"
#include "io/names.h"
#include "io/rules.h"

namespace trimloop::io {

std::vector<const Rule*> all_rules() {
  std::vector<const Rule*> found;
  for (const auto table : {iges::rules::all(), step::rules::all(), rules::all()}) found.insert(found.end(), table.begin(), table.end());
  found.insert(found.end(), file_rules::all.begin(), file_rules::all.end());
  found.insert(found.end(), name_rules::all.begin(), name_rules::all.end());
  found.insert(found.end(), description_rules::all.begin(), description_rules::all.end());
  return found;
}

const Rule* find_rule(std::string_view id_or_slug) {
  for (const Rule* rule : all_rules()) {
    if (rule->id == id_or_slug || rule->slug == id_or_slug) return rule;
  }
  return nullptr;
}

}  // namespace trimloop::io
