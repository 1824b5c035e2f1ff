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
  // The presentation of all that was added.
  void finish(InstanceId geometric_context);

 private:
  InstanceId style(const Colour& colour, Styled kind);

  EntityWriter& w_;
  std::vector<InstanceId> styled_, invisible_;
  std::map<int, std::vector<InstanceId>> layers_;
};

}  // namespace trimloop::io::step_export
