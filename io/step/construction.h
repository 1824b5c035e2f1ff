#pragma once
// Solids given by how they are made: CSG primitives and trees, swept areas and faces, replicas -> boundary
// representations. ISO 10303-42 6, -515, -511.

#include "io/step/geometry.h"

namespace trimloop::io::step_import {

// True for the entities that bodies() makes something of.
bool is_construction(const Context& context, const Record& instance);

class ConstructionReader {
 public:
  ConstructionReader(Context& context, Geometry& geometry) : context_(context), geometry_(geometry) {}
  // The solids of one item, each face with the item as its source. None after a finding.
  std::vector<Body> bodies(const Record& instance);

 private:
  Result<Body> primitive(const Record& instance);
  Result<Body> swept(const Record& instance);
  std::vector<Body> boolean(const Record& instance);
  std::vector<Body> half_space(const Record& instance, const std::vector<Body>& around);
  std::vector<Body> replica(const Record& instance);
  std::optional<Body> planar_face(const Record& instance);
  std::vector<Body> failed(const Record& instance, const Error& error);

  Context& context_;
  Geometry& geometry_;
};

}  // namespace trimloop::io::step_import
