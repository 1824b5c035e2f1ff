#pragma once
// Model -> STEP (AP242 or AP214): solids, sheets, wireframe and points, assemblies, names, colours, layers, visibility,
// units and validation properties. What has no home is named in `losses`; docs/losses.md lists the kinds.

#include "io/io.h"

namespace trimloop::io::step_export {

struct Exported {
  std::string bytes;
  std::vector<std::string> losses;
  NurbsStatement nurbs;
};
Result<Exported> write(const Model& model, const SourceInfo& source, const WriteOptions& options);

}  // namespace trimloop::io::step_export
