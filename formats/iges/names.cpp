#include "formats/iges/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <iterator>

#include "base/number.h"

namespace trimloop::iges {
namespace {

struct TypeName {
  int type;
  std::string_view name;
};

// IGES 5.3, table 3 and chapter 4.
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

using Names = std::initializer_list<std::string_view>;

// Walks over the layout of a record until it comes to the parameter asked for. Each step covers one run of parameters.
class Walk {
 public:
  Walk(std::size_t index, const Parameters* parameters) : index_(index), parameters_(parameters) {}

  Walk& fields(Names names) {
    for (std::string_view name : names)
      if (here(1)) name_ = name;
    return *this;
  }
  // name(first), name(first + 1), ...: `count` groups of one parameter for each of the names.
  Walk& list(std::int64_t count, Names names, std::int64_t first = 1) {
    const auto width = static_cast<std::int64_t>(names.size());
    if (std::size_t offset = 0; count > 0 && here(static_cast<std::size_t>(count * width), &offset)) {
      const auto in_group = static_cast<std::ptrdiff_t>(offset % names.size());
      name_ =
          fmt::format("{}({})", *(names.begin() + in_group), static_cast<std::int64_t>(offset / names.size()) + first);
    }
    return *this;
  }
  // name(outer,1), ...: a list within group `outer` of another list.
  Walk& nested(std::int64_t outer, std::int64_t count, Names names) {
    std::size_t offset = 0;
    if (count > 0 && here(static_cast<std::size_t>(count) * names.size(), &offset))
      name_ = fmt::format("{}({},{})", *(names.begin() + static_cast<std::ptrdiff_t>(offset % names.size())), outer,
                          offset / names.size() + 1);
    return *this;
  }
  // name(0,0), name(1,0), ...: the first index runs fastest.
  Walk& grid(std::int64_t nu, std::int64_t nv, Names names) {
    const auto width = static_cast<std::int64_t>(names.size());
    std::size_t offset = 0;
    if (nu > 0 && nv > 0 && nu <= longest_list / nv && here(static_cast<std::size_t>(nu * nv * width), &offset)) {
      const auto pole = static_cast<std::int64_t>(offset / names.size());
      name_ = fmt::format("{}({},{})", *(names.begin() + static_cast<std::ptrdiff_t>(offset % names.size())), pole % nu,
                          pole / nu);
    }
    return *this;
  }
  // AX(1,1), BX(1,1), ... PZ(1,1), AX(1,2), ...: 48 coefficients for each of `rows` x `columns` patches (114).
  Walk& patches(std::int64_t rows, std::int64_t columns) {
    constexpr std::size_t per_axis = 16, per_patch = 48;
    std::size_t offset = 0;
    if (rows > longest_list / columns || !here(static_cast<std::size_t>(rows * columns) * per_patch, &offset))
      return *this;
    const auto patch = static_cast<std::int64_t>(offset / per_patch);
    const std::size_t coefficient = offset % per_patch;
    name_ = fmt::format("{}{}({},{})", static_cast<char>('A' + coefficient % per_axis), "XYZ"[coefficient / per_axis],
                        patch / columns + 1, patch % columns + 1);
    return *this;
  }
  // The integer in parameter `index`; 0 when it is none, is negative or counts more than the record has parameters.
  std::int64_t value(std::size_t index) const {
    if (!parameters_ || index >= parameters_->tokens.size()) return 0;
    const auto most = static_cast<std::int64_t>(parameters_->tokens.size());
    const NumberText<std::int64_t> number = read_integer(parameters_->tokens[index].text);
    return number && number.value > 0 && number.value <= most ? number.value : 0;
  }
  std::size_t next() const { return next_; }
  bool done() const { return !name_.empty() || next_ > index_; }
  std::string name() { return std::move(name_); }

 private:
  static constexpr std::int64_t longest_list = 1'000'000'000;

  bool here(std::size_t width, std::size_t* offset = nullptr) {
    const bool found = name_.empty() && index_ >= next_ && index_ < next_ + width;
    if (found && offset) *offset = index_ - next_;
    next_ += width;
    return found;
  }

  std::size_t index_;
  const Parameters* parameters_;
  std::size_t next_ = 1;
  std::string name_;
};

void spline_curve(Walk& walk) {  // 112
  const std::int64_t segments = walk.value(4);
  walk.fields({"CTYPE", "H", "NDIM", "N"}).list(segments > 0 ? segments + 1 : 0, {"T"});
  walk.list(segments, {"AX", "BX", "CX", "DX", "AY", "BY", "CY", "DY", "AZ", "BZ", "CZ", "DZ"});
  if (segments > 0)
    walk.fields({"TPX0", "TPX1", "TPX2", "TPX3", "TPY0", "TPY1", "TPY2", "TPY3", "TPZ0", "TPZ1", "TPZ2", "TPZ3"});
}

void rational_curve(Walk& walk) {  // 126
  const std::int64_t k = walk.value(1), m = walk.value(2);
  walk.fields({"K", "M", "PROP1", "PROP2", "PROP3", "PROP4"});
  if (k < 1 || m < 1) return;
  walk.list(k + m + 2, {"T"}, -m).list(k + 1, {"W"}, 0).list(k + 1, {"X", "Y", "Z"}, 0);
  walk.fields({"V(0)", "V(1)", "XNORM", "YNORM", "ZNORM"});
}

void rational_surface(Walk& walk) {  // 128
  const std::int64_t k1 = walk.value(1), k2 = walk.value(2), m1 = walk.value(3), m2 = walk.value(4);
  walk.fields({"K1", "K2", "M1", "M2", "PROP1", "PROP2", "PROP3", "PROP4", "PROP5"});
  if (k1 < 1 || k2 < 1 || m1 < 1 || m2 < 1) return;
  walk.list(k1 + m1 + 2, {"S"}, -m1).list(k2 + m2 + 2, {"T"}, -m2);
  walk.grid(k1 + 1, k2 + 1, {"W"}).grid(k1 + 1, k2 + 1, {"X", "Y", "Z"});
  walk.fields({"U(0)", "U(1)", "V(0)", "V(1)"});
}

void boundary(Walk& walk) {  // 141
  walk.fields({"TYPE", "PREF", "SPTR", "N"});
  for (std::int64_t i = 1, n = walk.value(4); i <= n && !walk.done(); ++i) {
    const std::int64_t pcurves = walk.value(walk.next() + 2);
    walk.list(1, {"CRVPT", "SENSE", "K"}, i).nested(i, pcurves, {"PSCPT"});
  }
}

void loop_508(Walk& walk) {
  walk.fields({"N"});
  for (std::int64_t i = 1, n = walk.value(1); i <= n && !walk.done(); ++i) {
    const std::int64_t pcurves = walk.value(walk.next() + 4);
    walk.list(1, {"TYPE", "EDGE", "NDX", "OF", "K"}, i).nested(i, pcurves, {"ISOP", "CURV"});
  }
}

void copious(Walk& walk) {  // 106
  const std::int64_t interpretation = walk.value(1), n = walk.value(2);
  walk.fields({"IP", "N"});
  if (interpretation == 1) walk.fields({"ZT"}).list(n, {"X", "Y"});
  if (interpretation == 2) walk.list(n, {"X", "Y", "Z"});
  if (interpretation == 3) walk.list(n, {"X", "Y", "Z", "I", "J", "K"});
}

void spline_surface(Walk& walk) {  // 114
  const std::int64_t m = walk.value(3), n = walk.value(4);
  walk.fields({"CTYPE", "PTYPE", "M", "N"});
  if (m < 1 || n < 1) return;
  walk.list(m + 1, {"TU"}).list(n + 1, {"TV"});
  if (walk.done()) return;
  walk.patches(m + 1, n + 1);
}

void associativity(Walk& walk, int form) {  // 402
  if (form == 9)
    walk.fields({"NP", "NC", "DEP"}).list(walk.value(2), {"DE"});
  else if (form == 1 || form == 7 || form == 14 || form == 15)
    walk.fields({"N"}).list(walk.value(1), {"DE"});
}

// clang-format off (one type a line)
void lay_out(Walk& walk, int type, int form) {
  switch (type) {
    case 100:
      walk.fields({"ZT", "X1", "Y1", "X2", "Y2", "X3", "Y3"});
      break;
    case 102:
      walk.fields({"N"}).list(walk.value(1), {"DE"});
      break;
    case 104:
      walk.fields({"A", "B", "C", "D", "E", "F", "ZT", "X1", "Y1", "X2", "Y2"});
      break;
    case 106:
      copious(walk);
      break;
    case 108:
      walk.fields({"A", "B", "C", "D", "PTR", "X", "Y", "Z", "SIZE"});
      break;
    case 110:
      walk.fields({"X1", "Y1", "Z1", "X2", "Y2", "Z2"});
      break;
    case 112:
      spline_curve(walk);
      break;
    case 114:
      spline_surface(walk);
      break;
    case 116:
      walk.fields({"X", "Y", "Z", "PTR"});
      break;
    case 118:
      walk.fields({"DE1", "DE2", "DIRFLG", "DEVFLG"});
      break;
    case 120:
      walk.fields({"L", "C", "SA", "TA"});
      break;
    case 122:
      walk.fields({"DE", "LX", "LY", "LZ"});
      break;
    case 123:
      walk.fields({"X", "Y", "Z"});
      break;
    case 124:
      walk.fields({"R11", "R12", "R13", "T1", "R21", "R22", "R23", "T2", "R31", "R32", "R33", "T3"});
      break;
    case 126:
      rational_curve(walk);
      break;
    case 128:
      rational_surface(walk);
      break;
    case 130:
      walk.fields({"DE1", "FLAG", "DE2", "NDIM", "PTYPE", "D1", "TD1", "D2", "TD2", "VX", "VY", "VZ", "TT1", "TT2"});
      break;
    case 140:
      walk.fields({"NX", "NY", "NZ", "D", "DE"});
      break;
    case 141:
      boundary(walk);
      break;
    case 142:
      walk.fields({"CRTN", "SPTR", "BPTR", "CPTR", "PREF"});
      break;
    case 143:
      walk.fields({"TYPE", "SPTR", "N"}).list(walk.value(3), {"BDPT"});
      break;
    case 144:
      walk.fields({"PTS", "N1", "N2", "PTO"}).list(walk.value(3), {"PTI"});
      break;
    case 186:
      walk.fields({"SHELL", "SOF", "N"}).list(walk.value(3), {"VOID", "VOF"});
      break;
    case 190:
      walk.fields({"DELOC", "DENRML"});
      break;
    case 192:
      walk.fields({"DELOC", "DEAXIS", "RADIUS"});
      break;
    case 194:
      walk.fields({"DELOC", "DEAXIS", "RADIUS", "SANGLE"});
      break;
    case 196:
      walk.fields({"DELOC", "RADIUS"});
      break;
    case 198:
      walk.fields({"DELOC", "DEAXIS", "MAJRAD", "MINRAD"});
      break;
    case 308:
      walk.fields({"DEPTH", "NAME", "N"}).list(walk.value(3), {"DE"});
      break;
    case 314:
      walk.fields({"CC1", "CC2", "CC3", "CNAME"});
      break;
    case 402:
      associativity(walk, form);
      break;
    case 406:
      walk.fields({"NP"}).list(walk.value(1), {"V"});
      break;
    case 408:
      walk.fields({"DE", "X", "Y", "Z", "S"});
      break;
    case 502:
      walk.fields({"N"}).list(walk.value(1), {"X", "Y", "Z"});
      break;
    case 504:
      walk.fields({"N"}).list(walk.value(1), {"CURV", "SVP", "SV", "TVP", "TV"});
      break;
    case 508:
      loop_508(walk);
      break;
    case 510:
      walk.fields({"SURF", "N", "OF"}).list(walk.value(2), {"LOOP"});
      break;
    case 514:
      walk.fields({"N"}).list(walk.value(1), {"FACE", "OF"});
      break;
    default:
      break;
  }
  if (form == 1 && type == 196) walk.fields({"DEAXIS"});
  if (form == 1 && type >= 190 && type <= 198) walk.fields({"DEREFD"});
}
// clang-format on

std::string name_of(int type, int form, std::size_t index, const Parameters* parameters) {
  Walk walk(index, parameters);
  lay_out(walk, type, form);
  return walk.name();
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

}  // namespace trimloop::iges
