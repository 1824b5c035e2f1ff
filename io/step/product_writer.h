#pragma once
// Products, their shapes and their places in the assembly, in one geometric context.

#include <map>

#include "io/step/entity_writer.h"
#include "io/step/opaque.h"
#include "io/step/styles.h"

namespace trimloop::io::step_export {

// Units, uncertainty and what every product refers to.
struct SharedContext {
  InstanceId geometric;                           // context of all shape representations
  InstanceId length_unit;
  InstanceId product_context, definition_context;
  bool is_ap242 = true;
};
SharedContext write_context(EntityWriter&, LengthUnit unit, bool is_ap242);

// A part at one signed scale: mirrored and scaled occurrences are definitions of their own, whose geometry is scaled
// (and turned through the origin where the sign is negative), since an occurrence in STEP is rigid.
struct Definition {
  std::uint32_t part = 0;
  double scale = 1;
};
struct Place {  // one occurrence inside a definition
  std::uint32_t definition = 0;
  Frame frame;
  const Instance* instance = nullptr;
};
struct Structure {
  std::vector<Definition> definitions;    // [0] is the root
  std::vector<std::vector<Place>> places;  // of each definition
  std::vector<std::uint32_t> leaves_first;
};
// Limit when the scales ask for more definitions than `max_definitions`.
Result<Structure> structure_of(const Model&, std::size_t max_definitions, std::vector<std::string>& losses);

// Everything: definitions leaves first, then styles and layers. What became of what was read is kept in `targets`.
void write_products(EntityWriter&, const Structure&, const SharedContext&, Targets& targets);

}  // namespace trimloop::io::step_export
