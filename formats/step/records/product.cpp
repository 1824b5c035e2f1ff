#include "formats/step/records/product.h"

namespace trimloop::step {

RepresentationRecord RepresentationRecord::read(Reader& r) {
  RepresentationRecord rep;
  if (!r.at(Entity::Representation)) return rep;
  rep.name = r.text(0);
  rep.items = r.refs(1);
  rep.context = r.optional_ref(2);
  return rep;
}

ContextRecord ContextRecord::read(Reader& r) {
  ContextRecord c;
  if (r.is(Entity::GlobalUnitAssignedContext) && r.at(Entity::GlobalUnitAssignedContext)) c.units = r.refs(0);
  if (r.is(Entity::GlobalUncertaintyAssignedContext) && r.at(Entity::GlobalUncertaintyAssignedContext)) c.uncertainties = r.refs(0);
  return c;
}

UnitRecord UnitRecord::read(Reader& r) {
  UnitRecord u;
  u.is_length = r.is(Entity::LengthUnit);
  u.is_angle = r.is(Entity::PlaneAngleUnit);
  u.is_mass = r.is(Entity::MassUnit);
  u.is_si = r.is(Entity::SiUnit);
  if (u.is_si) {
    if (!r.at(Entity::SiUnit)) return u;
    u.prefix = r.word(0);
    u.name = r.word(1);
  } else if (r.is(Entity::ConversionBasedUnit)) {
    if (!r.at(Entity::ConversionBasedUnit)) return u;
    u.name = r.text(0);
    u.factor = r.ref(1);
  } else if (r.is(Entity::ContextDependentUnit)) {
    if (r.at(Entity::ContextDependentUnit)) u.name = r.text(0);
  }
  return u;
}

MeasureRecord MeasureRecord::read(Reader& r) {
  MeasureRecord m;
  if (r.at(Entity::RepresentationItem, true) && r.is(Entity::RepresentationItem)) m.name = r.text(0);
  if (r.is(Entity::MeasureRepresentationItem) && !r.is(Entity::MeasureWithUnit)) {
    if (!r.at(Entity::MeasureRepresentationItem)) return m;
  } else if (!r.at(Entity::MeasureWithUnit)) {
    return m;
  }
  m.value = r.select(0);
  m.unit = r.optional_ref(1);
  return m;
}

Relationship Relationship::read(Reader& r) {
  Relationship rel;
  if (!r.at(Entity::RepresentationRelationship)) return rel;
  rel.first = r.ref(2);
  rel.second = r.ref(3);
  if (r.is(Entity::RepresentationRelationshipWithTransformation) && r.at(Entity::RepresentationRelationshipWithTransformation))
    rel.transformation = r.optional_ref(0);
  return rel;
}

Pair Pair::read(Reader& r) {
  Pair p;
  int first = 0;
  if (r.is(Entity::MappedItem)) {
    if (!r.at(Entity::MappedItem)) return p;
  } else if (r.is(Entity::PropertyDefinitionRepresentation)) {
    if (!r.at(Entity::PropertyDefinitionRepresentation)) return p;
  } else if (r.is(Entity::ItemDefinedTransformation)) {
    if (!r.at(Entity::ItemDefinedTransformation)) return p;
    first = 2;
  } else if (r.is(Entity::RepresentationMap)) {
    if (!r.at(Entity::RepresentationMap)) return p;
  } else if (!r.at(Entity::ContextDependentShapeRepresentation)) {
    return p;
  }
  p.first = r.ref(first);
  p.second = r.ref(first + 1);
  return p;
}

ProductRecord ProductRecord::read(Reader& r) {
  ProductRecord p;
  if (!r.at(Entity::Product)) return p;
  p.id = r.text(0);
  p.name = r.text(1);
  return p;
}

DefinitionRecord DefinitionRecord::read(Reader& r) {
  DefinitionRecord d;
  if (r.at(r.is(Entity::ProductDefinitionFormation) ? Entity::ProductDefinitionFormation : Entity::ProductDefinition)) d.of = r.optional_ref(2);
  return d;
}

Usage Usage::read(Reader& r) {
  Usage u;
  if (!r.at(Entity::ProductDefinitionRelationship)) return u;
  u.id = r.text(0);
  u.name = r.text(1);
  u.parent = r.ref(3);
  u.child = r.ref(4);
  return u;
}

PropertyRecord PropertyRecord::read(Reader& r) {
  PropertyRecord p;
  if (!r.at(Entity::PropertyDefinition)) return p;
  p.name = r.text(0);
  p.description = r.text(1);
  p.definition = r.optional_ref(2);
  return p;
}

Styled Styled::read(Reader& r) {
  Styled s;
  if (!r.at(Entity::StyledItem)) return s;
  s.styles = r.refs(0);
  s.item = r.optional_ref(1);
  return s;
}

Layer Layer::read(Reader& r) {
  Layer l;
  if (!r.at(Entity::PresentationLayerAssignment)) return l;
  l.name = r.text(0);
  l.items = r.refs(2);
  return l;
}

Rgb Rgb::read(Reader& r) {
  Rgb c;
  if (!r.at(Entity::ColourRgb)) return c;
  c.r = r.real(0);
  c.g = r.real(1);
  c.b = r.real(2);
  return c;
}

}  // namespace trimloop::step
