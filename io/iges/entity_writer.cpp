#include "io/iges/entity_writer.h"

#include "formats/iges/records/structure.h"

namespace trimloop::io::iges_export {

iges::DirectoryEntry EntityWriter::entry(Role role, int form, AttributesId attributes) {
  iges::DirectoryEntry e;
  e.form = form;
  e.status.subordinate = role == Role::Child || role == Role::ParameterCurve ? 1 : 0;
  e.status.use = role == Role::ParameterCurve ? 5 : role == Role::Definition ? 2 : 0;
  const Attributes& a = model[attributes];
  e.level = a.layer;
  e.status.blank = a.visible ? 0 : 1;
  if (a.colour) e.colour = colour_of(*a.colour);
  return e;
}

iges::TrailingGroups EntityWriter::groups_of(AttributesId attributes) {
  iges::TrailingGroups groups;
  const std::string& name = model[attributes].name;
  if (name.empty()) return groups;
  iges::Ref& ref = names_[name];
  if (!ref) {
    iges::Property property;
    property.name = name;
    property.value_count = 1;
    iges::DirectoryEntry e;
    e.form = 15;
    e.status.subordinate = 2;
    ref = writer_.add(std::move(e), property);
  }
  groups.properties.push_back(ref);
  return groups;
}

iges::Ref EntityWriter::matrix(const Transform& t) {
  iges::TransformationMatrix record;
  const Vector move{units.length(t.t.x), units.length(t.t.y), units.length(t.t.z)};
  record.m = {t.r[0][0], t.r[0][1], t.r[0][2], move.x, t.r[1][0], t.r[1][1],
              t.r[1][2], move.y,    t.r[2][0], t.r[2][1], t.r[2][2], move.z};
  iges::DirectoryEntry e;
  e.form = determinant(t) < 0 ? 1 : 0;
  return writer_.add(std::move(e), record);
}

int EntityWriter::colour_of(const Colour& colour) {
  // DE numbers 1 to 8 (IGES 5.3 2.2.4.4.13).
  static constexpr std::array<std::array<double, 3>, 8> standard{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}};
  const std::array<double, 3> key{colour.r, colour.g, colour.b};
  for (std::size_t i = 0; i < standard.size(); ++i) {
    if (standard[i] == key) return static_cast<int>(i) + 1;
  }
  int& number = colours_[key];
  if (number == 0) {
    iges::ColourDefinition record;  // in percent
    record.red = percent_of(colour.r);
    record.green = percent_of(colour.g);
    record.blue = percent_of(colour.b);
    iges::DirectoryEntry e;
    e.status.use = 2;
    number = -writer_.add(std::move(e), record).de;
  }
  return number;
}

}  // namespace trimloop::io::iges_export
