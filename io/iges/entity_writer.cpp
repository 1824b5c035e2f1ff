#include "io/iges/entity_writer.h"

#include <algorithm>
#include <cmath>

#include "formats/iges/records/structure.h"

namespace trimloop::io::iges_export {

int LineWeights::step_of(double mm) const {
  return mm > 0 ? std::max(1, static_cast<int>(std::lround(mm / widest_mm * steps))) : 0;
}

// The fewest steps that every width of the model is one of; widths that need more than a thousand are rounded to these.
LineWeights line_weights(const Model& model) {
  constexpr int most_steps = 1000;
  LineWeights out;
  double widest = 0;
  for (const Attributes& a : model.attributes) widest = std::max(widest, a.line_weight_mm);
  if (!(widest > 0) || !std::isfinite(widest)) return out;
  out.widest_mm = widest;
  const auto all_fit = [&](int steps) {
    return std::all_of(model.attributes.begin(), model.attributes.end(), [&](const Attributes& a) {
      const double at = a.line_weight_mm / widest * steps;
      return !(at > 0) || std::abs(at - std::round(at)) <= 1e-9 * steps;
    });
  };
  while (out.steps < most_steps && !all_fit(out.steps)) ++out.steps;
  return out;
}

iges::DirectoryEntry EntityWriter::entry(Role role, int form, AttributesId attributes) {
  iges::DirectoryEntry e;
  e.form = form;
  e.status.subordinate = role == Role::Child || role == Role::ParameterCurve || role == Role::AnnotationPart ? 1 : role == Role::Logical ? 2 : 0;
  e.status.use = role == Role::ParameterCurve                              ? 5
                 : role == Role::Definition                                ? 2
                 : role == Role::Annotation || role == Role::AnnotationPart ? 1
                                                                           : 0;
  const Attributes& a = model[attributes];
  e.level = a.layer;
  e.status.blank = a.visible ? 0 : 1;
  if (a.colour) e.colour = colour_of(*a.colour);
  e.line_font = a.line_font;
  e.line_weight = weights.step_of(a.line_weight_mm);
  return e;
}

iges::Ref EntityWriter::add_tokens(int type, const iges::TokenWriter& tokens, Role role, int form, const Transform* placement,
                                   AttributesId attributes, iges::TrailingGroups groups) {
  iges::DirectoryEntry e = entry(role, form, attributes);
  e.type = type;
  if (placement != nullptr) e.transform = matrix(*placement).de;
  for (const iges::Ref ref : groups_of(attributes).properties) groups.properties.push_back(ref);
  return writer_.add(std::move(e), tokens, groups);
}

iges::Ref EntityWriter::add_on_level(int type, const iges::TokenWriter& tokens, int form, int level) {
  iges::DirectoryEntry e;
  e.type = type;
  e.form = form;
  e.level = level;
  return writer_.add(std::move(e), tokens);
}

iges::TrailingGroups EntityWriter::groups_of(AttributesId attributes) { return attributes_of_name(model[attributes].name); }

iges::TrailingGroups EntityWriter::attributes_of_name(const std::string& name) {
  iges::TrailingGroups groups;
  if (name.empty()) return groups;
  iges::Ref& ref = names_[name];
  if (!ref) {
    iges::Property property;
    property.name = text(name);
    property.value_count = 1;
    iges::DirectoryEntry e;
    e.form = 15;
    e.status.subordinate = 2;
    ref = writer_.add(std::move(e), property);
  }
  groups.properties.push_back(ref);
  return groups;
}

std::string EntityWriter::text(const std::string& of) {
  if (options.iges_profile != IgesProfile::Conservative) return of;
  std::string out = of;
  for (char& c : out)
    if (static_cast<unsigned char>(c) >= 0x80) c = '?';
  if (out != of) losses.push_back("letters beyond ASCII in \"" + of + "\"");
  return out;
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
