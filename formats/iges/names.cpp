#include "formats/iges/names.h"

#include <algorithm>
#include <iterator>

#include "base/number.h"
#include "formats/iges/records/layout.h"

namespace trimloop::iges {
namespace {

struct TypeName {
  int type;
  std::string_view name;
};

// IGES 5.3, table 3 and chapter 4. Forms have names of their own in the layout table.
constexpr TypeName type_names[] = {
    {0, "Null"},
    {100, "Circular Arc"},
    {102, "Composite Curve"},
    {104, "Conic Arc"},
    {106, "Copious Data"},
    {108, "Plane"},
    {110, "Line"},
    {112, "Parametric Spline Curve"},
    {114, "Parametric Spline Surface"},
    {116, "Point"},
    {118, "Ruled Surface"},
    {120, "Surface of Revolution"},
    {122, "Tabulated Cylinder"},
    {123, "Direction"},
    {124, "Transformation Matrix"},
    {125, "Flash"},
    {126, "Rational B-Spline Curve"},
    {128, "Rational B-Spline Surface"},
    {130, "Offset Curve"},
    {132, "Connect Point"},
    {134, "Node"},
    {136, "Finite Element"},
    {138, "Nodal Displacement and Rotation"},
    {140, "Offset Surface"},
    {141, "Boundary"},
    {142, "Curve on a Parametric Surface"},
    {143, "Bounded Surface"},
    {144, "Trimmed Parametric Surface"},
    {146, "Nodal Results"},
    {148, "Element Results"},
    {150, "Block"},
    {152, "Right Angular Wedge"},
    {154, "Right Circular Cylinder"},
    {156, "Right Circular Cone Frustum"},
    {158, "Sphere"},
    {160, "Torus"},
    {162, "Solid of Revolution"},
    {164, "Solid of Linear Extrusion"},
    {168, "Ellipsoid"},
    {180, "Boolean Tree"},
    {182, "Selected Component"},
    {184, "Solid Assembly"},
    {186, "Manifold Solid B-Rep Object"},
    {190, "Plane Surface"},
    {192, "Right Circular Cylindrical Surface"},
    {194, "Right Circular Conical Surface"},
    {196, "Spherical Surface"},
    {198, "Toroidal Surface"},
    {202, "Angular Dimension"},
    {204, "Curve Dimension"},
    {206, "Diameter Dimension"},
    {208, "Flag Note"},
    {210, "General Label"},
    {212, "General Note"},
    {213, "New General Note"},
    {214, "Leader (Arrow)"},
    {216, "Linear Dimension"},
    {218, "Ordinate Dimension"},
    {220, "Point Dimension"},
    {222, "Radius Dimension"},
    {228, "General Symbol"},
    {230, "Sectioned Area"},
    {302, "Associativity Definition"},
    {304, "Line Font Definition"},
    {306, "Macro Definition"},
    {308, "Subfigure Definition"},
    {310, "Text Font Definition"},
    {312, "Text Display Template"},
    {314, "Color Definition"},
    {316, "Units Data"},
    {320, "Network Subfigure Definition"},
    {322, "Attribute Table Definition"},
    {402, "Associativity Instance"},
    {404, "Drawing"},
    {406, "Property"},
    {408, "Singular Subfigure Instance"},
    {410, "View"},
    {412, "Rectangular Array Subfigure Instance"},
    {414, "Circular Array Subfigure Instance"},
    {416, "External Reference"},
    {418, "Nodal Load/Constraint"},
    {420, "Network Subfigure Instance"},
    {422, "Attribute Table Instance"},
    {430, "Solid Instance"},
    {502, "Vertex List"},
    {504, "Edge List"},
    {508, "Loop"},
    {510, "Face"},
    {514, "Shell"},
};

LayoutWalk::IntegerAt integers_of(const Parameters* parameters) {
  return [parameters](std::size_t i) -> std::optional<std::int64_t> {
    if (!parameters || i >= parameters->tokens.size() || parameters->tokens[i].kind != Token::Kind::Text) return {};
    const NumberText<std::int64_t> number = read_integer(parameters->tokens[i].text);
    return number ? std::optional(number.value) : std::nullopt;
  };
}

std::string name_of(int type, int form, std::size_t index, const Parameters* parameters) {
  const Layout* layout = find_layout(type, form);
  if (!layout) return {};
  return LayoutWalk(*layout, parameters ? parameters->tokens.size() : 0, integers_of(parameters)).name(index);
}

}  // namespace

std::string_view entity_name(int type) {
  const auto found = std::lower_bound(std::begin(type_names), std::end(type_names), type,
                                      [](const TypeName& row, int wanted) { return row.type < wanted; });
  return found != std::end(type_names) && found->type == type ? found->name : std::string_view();
}

std::string parameter_name(int type, int form, std::size_t index) { return name_of(type, form, index, nullptr); }

std::string parameter_name(int type, int form, std::size_t index, const Parameters& parameters) {
  return name_of(type, form, index, &parameters);
}

std::vector<std::string> parameter_names(int type, int form, const Parameters& parameters) {
  const Layout* layout = find_layout(type, form);
  if (!layout || parameters.tokens.empty()) return {};
  return LayoutWalk(*layout, parameters.tokens.size() - 1, integers_of(&parameters)).names();
}

std::string_view form_name(int type, int form) {
  const Layout* layout = find_layout(type, form);
  return layout && form >= layout->first_form && form <= layout->last_form ? layout->name : std::string_view();
}

}  // namespace trimloop::iges
