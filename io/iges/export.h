#pragma once
// Model -> IGES: faces as 144/142 over 128/126 and analytic records where the shape is one; names, colours, levels, units.

#include "io/io.h"

namespace trimloop::io::iges_export {

struct Exported {
  std::string bytes;
  std::vector<std::string> losses;
  NurbsStatement nurbs;
};
Result<Exported> write(const Model& model, const SourceInfo& source, const WriteOptions& options);

}  // namespace trimloop::io::iges_export
