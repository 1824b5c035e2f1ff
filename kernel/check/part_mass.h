#pragma once
// Area, volume and centre of a part with everything that is placed in it, each part measured once.

#include <vector>

#include "kernel/model/model.h"

namespace trimloop {

struct PartMass {
  double area_mm2 = 0;        // of all faces
  double volume_mm3 = 0;      // of the solids, voids negative
  Vector moment_mm4;          // of the volume about the part's origin: volume times centre
  Box box;                    // encloses the faces, by the corners of the boxes of what is placed in it
  bool has_solid = false;
  bool complete = true;       // no face failed, every shell of a solid is closed
};
// Of a body by itself.
PartMass mass_of(const Body&);

// Of the parts of a model whose instances are acyclic and nested no deeper than limit_instances allows: the depth of the
// nesting is the depth of the recursion. The model must outlive it and stay as it is.
class PartMasses {
 public:
  explicit PartMasses(const Model& model) : model_(model), known_(model.parts.size()), done_(model.parts.size()) {}
  const PartMass& of(std::uint32_t part);

 private:
  const Model& model_;
  std::vector<PartMass> known_;
  std::vector<bool> done_;
};

}  // namespace trimloop
