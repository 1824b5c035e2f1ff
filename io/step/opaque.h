#pragma once
// What a STEP file holds and no model means - product manufacturing information, properties and materials of parts -
// goes into the file that is written from it as it stands: an opaque subgraph of its instances, whose references to
// shapes, products and representations lead to what was written of these.

#include <unordered_map>

#include "io/step/entity_writer.h"

namespace trimloop::io::step_export {

// The representations of one part that was written: the one that its product names, and those of each kind of geometry.
struct WrittenShape {
  InstanceId main, solids, surfaces, meshes, curves;
  InstanceId curve_set;  // the only item of `curves`
};

// What became of instances of the source, by their numbers there.
struct Targets {
  struct Product {
    InstanceId definition, shape;  // PRODUCT_DEFINITION or NEXT_ASSEMBLY_USAGE_OCCURRENCE; its PRODUCT_DEFINITION_SHAPE
  };
  std::unordered_map<std::uint64_t, InstanceId> items;             // faces, edges, shells, solids, curves, points
  std::unordered_map<std::uint64_t, InstanceId> held_by;           // number of a written item -> its representation
  std::unordered_map<std::uint64_t, WrittenShape> representations;
  std::unordered_map<std::uint64_t, Product> products;
  InstanceId context;                                              // of all representations written

  void add(const SourceRefs& source, InstanceId written);          // under its first identity of role 0
};

// Appends the subgraph. What cannot come along (it speaks of shapes only that were not written) is among the losses.
void write_opaque(EntityWriter&, const step::File& source, const Targets&, const Limits&);

}  // namespace trimloop::io::step_export
