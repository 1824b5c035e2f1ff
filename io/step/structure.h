#pragma once
// From instances to a model: representations, products, assemblies by both mechanisms, bodies, free curves and points.

#include <set>

#include "io/step/solids.h"
#include "io/step/read_styles.h"

namespace trimloop::io::step_import {

class StructureReader {
 public:
  StructureReader(Context& context, Model& model);
  void read();
  // The part of each PRODUCT_DEFINITION, by its place in the index.
  std::unordered_map<std::size_t, std::uint32_t> parts_of_definitions() const;

 private:
  // Shape representations that are one shape: joined by relationships without transformation. One part of the model.
  struct Shape {
    std::vector<const Record*> representations;
    const Record* definition = nullptr;   // PRODUCT_DEFINITION
    bool is_child = false;
    std::uint32_t part = 0;
  };
  struct Use {  // an occurrence by product structure or by relationship
    const Record* source = nullptr;
    std::size_t parent = 0, child = 0;
    Transform transform;
    std::string name;
    const Record* relation = nullptr;  // what places it, where that is another instance
  };

  void collect();
  std::size_t shape_of(const Record& representation);
  std::size_t joined(std::size_t shape) const;
  void join(std::size_t a, std::size_t b);
  std::size_t shape_of_definition(const Record& definition);
  void read_usages();
  void add_usage(const Record& usage, const Record* relationship_instance);
  std::optional<Transform> mapping(const Record& item, Geometry& geometry, const Record*& mapped);
  const Record* mapping_of(std::size_t parent, std::size_t child, Geometry*& geometry);
  std::optional<Transform> placement(const Record& relationship, std::size_t parent, std::size_t child);
  const Units& units_of_shape(const Record& representation);
  bool lists(std::size_t shape, Ref item);

  void make_parts();
  void fill(std::uint32_t part, const Record& representation, bool only_new);  // only_new: items met before are passed over
  void add(std::uint32_t part, const Record& item, Geometry& geometry);
  void add_body(std::uint32_t part, const Record& item, Geometry& geometry);
  void add_set(std::uint32_t part, const Record& item, Geometry& geometry);
  void add_element(std::uint32_t part, const Record& item, Geometry& geometry, const Attributes& owner, Body& sheet);
  void add_construction(std::uint32_t part, const Record& item, Geometry& geometry);
  void add_tessellated(std::uint32_t part, const Record& item, Geometry& geometry);
  void add_wires(std::uint32_t part, const Record& item, Geometry& geometry);
  void add_mapped(std::uint32_t part, const Record& item, Geometry& geometry);
  void add_left_over();
  void name_parts();
  Geometry& geometry_for(const Record& representation);
  std::string product_name(const Record& definition);

  Context& context_;
  Model& model_;
  Styles styles_;
  std::vector<Shape> shapes_;
  std::vector<std::size_t> parent_;                         // union-find over shapes_
  std::unordered_map<std::size_t, std::size_t> by_representation_, by_definition_;
  std::unordered_map<std::size_t, std::vector<Ref>> items_;  // of representations
  std::unordered_map<std::size_t, const Record*> contexts_;
  std::unordered_map<std::size_t, std::unique_ptr<Geometry>> geometries_;  // by representation context
  std::vector<Use> uses_;
  std::unordered_map<std::size_t, std::uint32_t> parts_;    // shape -> part
  std::set<std::size_t> placing_;                           // mapped items that place an occurrence of the product structure
  std::set<std::pair<std::uint32_t, std::size_t>> listed_;  // (part, item) read already
};

// Takes out instances that make a part contain itself (SP-A02, SP-A05), nest too deep (LM-05) or unfold to more
// occurrences than allowed (SP-A06). Linear in parts and instances: nothing is unfolded.
void limit_instances(Context& context, Model& model);

}  // namespace trimloop::io::step_import
