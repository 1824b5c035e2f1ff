#pragma once
// Records of products, representations, assemblies, units, styles and layers (ISO 10303-41, -43, -44, -46).

#include "formats/step/records/reader.h"

namespace trimloop::step {

struct RepresentationRecord {
  static constexpr Entity type = Entity::Representation;
  std::string name;
  std::vector<Ref> items;
  Ref context;
  static RepresentationRecord read(Reader&);
};
struct ContextRecord {  // the parts of a representation context that mean units
  static constexpr Entity type = Entity::RepresentationContext;
  std::vector<Ref> units, uncertainties;
  static ContextRecord read(Reader&);
};
struct UnitRecord {  // SI_UNIT or CONVERSION_BASED_UNIT with what kind of unit it is
  static constexpr Entity type = Entity::NamedUnit;
  bool is_length = false, is_angle = false, is_mass = false, is_si = false;
  std::string prefix, name;
  Ref factor;          // a measure with unit
  static UnitRecord read(Reader&);
};
struct MeasureRecord {  // MEASURE_WITH_UNIT, and as a representation item
  static constexpr Entity type = Entity::MeasureWithUnit;
  std::string name;
  Select value;
  Ref unit;
  static MeasureRecord read(Reader&);
};
struct Relationship {  // REPRESENTATION_RELATIONSHIP, with its transformation where there is one
  static constexpr Entity type = Entity::RepresentationRelationship;
  Ref first, second, transformation;
  static Relationship read(Reader&);
};
struct Pair {  // two references: the meaning is the entity's
  Ref first, second;
  static Pair read(Reader&);
};
struct ProductRecord {
  static constexpr Entity type = Entity::Product;
  std::string id, name;
  static ProductRecord read(Reader&);
};
struct DefinitionRecord {  // PRODUCT_DEFINITION: its formation; PRODUCT_DEFINITION_FORMATION: its product
  static constexpr Entity type = Entity::ProductDefinition;
  Ref of;
  static DefinitionRecord read(Reader&);
};
struct Usage {  // NEXT_ASSEMBLY_USAGE_OCCURRENCE
  static constexpr Entity type = Entity::ProductDefinitionRelationship;
  std::string id, name;
  Ref parent, child;
  static Usage read(Reader&);
};
struct PropertyRecord {
  static constexpr Entity type = Entity::PropertyDefinition;
  std::string name, description;
  Ref definition;
  static PropertyRecord read(Reader&);
};
struct Styled {
  static constexpr Entity type = Entity::StyledItem;
  std::vector<Ref> styles;
  Ref item;
  static Styled read(Reader&);
};
struct Layer {
  static constexpr Entity type = Entity::PresentationLayerAssignment;
  std::string name;
  std::vector<Ref> items;
  static Layer read(Reader&);
};
struct Rgb {
  static constexpr Entity type = Entity::ColourRgb;
  double r = 0, g = 0, b = 0;
  static Rgb read(Reader&);
};

}  // namespace trimloop::step
