#pragma once
// Colours, visibility and layers of what was written.

#include <map>
#include <vector>

#include "io/step/entity_writer.h"

namespace trimloop::io::step_export {

enum class Styled : std::uint8_t { Surface, Curve, Point };

class StyleWriter {
 public:
  explicit StyleWriter(EntityWriter& writer) : w_(writer) {}

  void add(InstanceId item, AttributesId attributes, Styled kind);
  // What the attributes say of `item` where `relation` places it, and there only.
  void add_at(InstanceId relation, InstanceId item, AttributesId attributes, Styled kind);
  // The presentation of all that was added.
  void finish(InstanceId geometric_context);

 private:
  InstanceId style(const Colour& colour, Styled kind);
  InstanceId style_of(const Attributes& attributes, Styled kind);

  EntityWriter& w_;
  std::map<std::uint64_t, InstanceId> base_;  // number of an item -> its STYLED_ITEM
  std::vector<InstanceId> styled_, overriding_, invisible_;
  std::map<int, std::vector<InstanceId>> layers_;
};

}  // namespace trimloop::io::step_export
