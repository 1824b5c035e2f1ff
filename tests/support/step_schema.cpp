#include "tests/support/step_schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "formats/step/file.h"
#include "formats/step/tape.h"

namespace trimloop::test {

namespace {

using step::Token;

// Attribute kinds: S text, R real, I integer, B .T. or .F., L also .U., E enumeration, * derived, T typed value, M a trim (a
// list of points and parameters), # NAME a reference to that entity or one below it (alternatives by |), ( kind ) a list of
// at least one, [ kind ] a list that may be empty; ? before a kind: may be unset.
struct Row {
  const char* entity;
  const char* supertypes;  // separated by blanks
  const char* attributes;  // own ones, separated by commas
};
constexpr Row table[] = {
    {"REPRESENTATION_ITEM", "", "S"},
    {"GEOMETRIC_REPRESENTATION_ITEM", "REPRESENTATION_ITEM", ""},
    {"TOPOLOGICAL_REPRESENTATION_ITEM", "REPRESENTATION_ITEM", ""},
    {"POINT", "GEOMETRIC_REPRESENTATION_ITEM", ""},
    {"CARTESIAN_POINT", "POINT", "(R)"},
    {"DIRECTION", "GEOMETRIC_REPRESENTATION_ITEM", "(R)"},
    {"VECTOR", "GEOMETRIC_REPRESENTATION_ITEM", "#DIRECTION,R"},
    {"PLACEMENT", "GEOMETRIC_REPRESENTATION_ITEM", "#CARTESIAN_POINT"},
    {"AXIS1_PLACEMENT", "PLACEMENT", "?#DIRECTION"},
    {"AXIS2_PLACEMENT_3D", "PLACEMENT", "?#DIRECTION,?#DIRECTION"},
    {"CURVE", "GEOMETRIC_REPRESENTATION_ITEM", ""},
    {"LINE", "CURVE", "#CARTESIAN_POINT,#VECTOR"},
    {"CONIC", "CURVE", "#AXIS2_PLACEMENT_3D"},
    {"CIRCLE", "CONIC", "R"},
    {"ELLIPSE", "CONIC", "R,R"},
    {"HYPERBOLA", "CONIC", "R,R"},
    {"PARABOLA", "CONIC", "R"},
    {"BOUNDED_CURVE", "CURVE", ""},
    {"POLYLINE", "BOUNDED_CURVE", "(#CARTESIAN_POINT)"},
    {"B_SPLINE_CURVE", "BOUNDED_CURVE", "I,(#CARTESIAN_POINT),E,L,L"},
    {"B_SPLINE_CURVE_WITH_KNOTS", "B_SPLINE_CURVE", "(I),(R),E"},
    {"RATIONAL_B_SPLINE_CURVE", "B_SPLINE_CURVE", "(R)"},
    {"TRIMMED_CURVE", "BOUNDED_CURVE", "#CURVE,M,M,B,E"},
    {"COMPOSITE_CURVE", "BOUNDED_CURVE", "(#COMPOSITE_CURVE_SEGMENT),L"},
    {"COMPOSITE_CURVE_SEGMENT", "", "E,B,#CURVE"},
    {"OFFSET_CURVE_3D", "CURVE", "#CURVE,R,L,#DIRECTION"},
    {"PCURVE", "CURVE", "#SURFACE,#DEFINITIONAL_REPRESENTATION"},
    {"SURFACE_CURVE", "CURVE", "#CURVE,(#PCURVE|SURFACE),E"},
    {"SEAM_CURVE", "SURFACE_CURVE", ""},
    {"SURFACE", "GEOMETRIC_REPRESENTATION_ITEM", ""},
    {"ELEMENTARY_SURFACE", "SURFACE", "#AXIS2_PLACEMENT_3D"},
    {"PLANE", "ELEMENTARY_SURFACE", ""},
    {"CYLINDRICAL_SURFACE", "ELEMENTARY_SURFACE", "R"},
    {"CONICAL_SURFACE", "ELEMENTARY_SURFACE", "R,R"},
    {"SPHERICAL_SURFACE", "ELEMENTARY_SURFACE", "R"},
    {"TOROIDAL_SURFACE", "ELEMENTARY_SURFACE", "R,R"},
    {"DEGENERATE_TOROIDAL_SURFACE", "TOROIDAL_SURFACE", "B"},
    {"SWEPT_SURFACE", "SURFACE", "#CURVE"},
    {"SURFACE_OF_LINEAR_EXTRUSION", "SWEPT_SURFACE", "#VECTOR"},
    {"SURFACE_OF_REVOLUTION", "SWEPT_SURFACE", "#AXIS1_PLACEMENT"},
    {"OFFSET_SURFACE", "SURFACE", "#SURFACE,R,L"},
    {"BOUNDED_SURFACE", "SURFACE", ""},
    {"B_SPLINE_SURFACE", "BOUNDED_SURFACE", "I,I,((#CARTESIAN_POINT)),E,L,L,L"},
    {"B_SPLINE_SURFACE_WITH_KNOTS", "B_SPLINE_SURFACE", "(I),(I),(R),(R),E"},
    {"RATIONAL_B_SPLINE_SURFACE", "B_SPLINE_SURFACE", "((R))"},
    {"VERTEX", "TOPOLOGICAL_REPRESENTATION_ITEM", ""},
    {"VERTEX_POINT", "VERTEX GEOMETRIC_REPRESENTATION_ITEM", "#POINT"},
    {"EDGE", "TOPOLOGICAL_REPRESENTATION_ITEM", "#VERTEX,#VERTEX"},
    {"EDGE_CURVE", "EDGE GEOMETRIC_REPRESENTATION_ITEM", "#CURVE,B"},
    {"ORIENTED_EDGE", "", "S,*,*,#EDGE,B"},
    {"LOOP", "TOPOLOGICAL_REPRESENTATION_ITEM", ""},
    {"EDGE_LOOP", "LOOP", "(#ORIENTED_EDGE)"},
    {"VERTEX_LOOP", "LOOP", "#VERTEX"},
    {"FACE_BOUND", "TOPOLOGICAL_REPRESENTATION_ITEM", "#LOOP,B"},
    {"FACE_OUTER_BOUND", "FACE_BOUND", ""},
    {"FACE", "TOPOLOGICAL_REPRESENTATION_ITEM", "(#FACE_BOUND)"},
    {"FACE_SURFACE", "FACE GEOMETRIC_REPRESENTATION_ITEM", "#SURFACE,B"},
    {"ADVANCED_FACE", "FACE_SURFACE", ""},
    {"CONNECTED_FACE_SET", "TOPOLOGICAL_REPRESENTATION_ITEM", "(#FACE)"},
    {"OPEN_SHELL", "CONNECTED_FACE_SET", ""},
    {"CLOSED_SHELL", "CONNECTED_FACE_SET", ""},
    {"ORIENTED_CLOSED_SHELL", "", "S,*,#CLOSED_SHELL,B"},
    {"SOLID_MODEL", "GEOMETRIC_REPRESENTATION_ITEM", ""},
    {"MANIFOLD_SOLID_BREP", "SOLID_MODEL", "#CLOSED_SHELL"},
    {"BREP_WITH_VOIDS", "MANIFOLD_SOLID_BREP", "(#ORIENTED_CLOSED_SHELL)"},
    {"SHELL_BASED_SURFACE_MODEL", "GEOMETRIC_REPRESENTATION_ITEM", "(#OPEN_SHELL|CLOSED_SHELL)"},
    {"GEOMETRIC_SET", "GEOMETRIC_REPRESENTATION_ITEM", "(#POINT|CURVE|SURFACE)"},
    {"GEOMETRIC_CURVE_SET", "GEOMETRIC_SET", ""},
    {"TESSELLATED_ITEM", "GEOMETRIC_REPRESENTATION_ITEM", ""},
    {"TESSELLATED_STRUCTURED_ITEM", "TESSELLATED_ITEM", ""},
    {"COORDINATES_LIST", "TESSELLATED_ITEM", "I,((R))"},
    {"TESSELLATED_FACE", "TESSELLATED_STRUCTURED_ITEM", "#COORDINATES_LIST,I,[(R)],?#FACE|SURFACE"},
    {"TRIANGULATED_FACE", "TESSELLATED_FACE", "[I],((I))"},
    {"TESSELLATED_EDGE", "TESSELLATED_STRUCTURED_ITEM", "#COORDINATES_LIST,?#EDGE_CURVE,(I)"},
    {"TESSELLATED_SHELL", "TESSELLATED_ITEM", "(#TESSELLATED_STRUCTURED_ITEM),?#CONNECTED_FACE_SET"},
    {"TESSELLATED_SOLID", "TESSELLATED_ITEM", "(#TESSELLATED_STRUCTURED_ITEM),?#MANIFOLD_SOLID_BREP"},
    {"TESSELLATED_WIRE", "TESSELLATED_ITEM", "(#TESSELLATED_EDGE),?#EDGE_LOOP"},
    {"REPRESENTATION", "", "S,(#REPRESENTATION_ITEM),#REPRESENTATION_CONTEXT"},
    {"DEFINITIONAL_REPRESENTATION", "REPRESENTATION", ""},
    {"SHAPE_REPRESENTATION", "REPRESENTATION", ""},
    {"ADVANCED_BREP_SHAPE_REPRESENTATION", "SHAPE_REPRESENTATION", ""},
    {"MANIFOLD_SURFACE_SHAPE_REPRESENTATION", "SHAPE_REPRESENTATION", ""},
    {"GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION", "SHAPE_REPRESENTATION", ""},
    {"TESSELLATED_SHAPE_REPRESENTATION", "SHAPE_REPRESENTATION", ""},
    {"PRESENTATION_REPRESENTATION", "REPRESENTATION", ""},
    {"MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION", "REPRESENTATION", ""},
    {"REPRESENTATION_RELATIONSHIP", "", "S,?S,#REPRESENTATION,#REPRESENTATION"},
    {"SHAPE_REPRESENTATION_RELATIONSHIP", "REPRESENTATION_RELATIONSHIP", ""},
    {"REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION", "REPRESENTATION_RELATIONSHIP", "#ITEM_DEFINED_TRANSFORMATION"},
    {"ITEM_DEFINED_TRANSFORMATION", "", "S,?S,#REPRESENTATION_ITEM,#REPRESENTATION_ITEM"},
    {"REPRESENTATION_CONTEXT", "", "S,S"},
    {"GEOMETRIC_REPRESENTATION_CONTEXT", "REPRESENTATION_CONTEXT", "I"},
    {"PARAMETRIC_REPRESENTATION_CONTEXT", "REPRESENTATION_CONTEXT", ""},
    {"GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT", "REPRESENTATION_CONTEXT", "(#UNCERTAINTY_MEASURE_WITH_UNIT)"},
    {"GLOBAL_UNIT_ASSIGNED_CONTEXT", "REPRESENTATION_CONTEXT", "(#NAMED_UNIT)"},
    {"NAMED_UNIT", "", "*|#DIMENSIONAL_EXPONENTS"},
    {"LENGTH_UNIT", "NAMED_UNIT", ""},
    {"PLANE_ANGLE_UNIT", "NAMED_UNIT", ""},
    {"SOLID_ANGLE_UNIT", "NAMED_UNIT", ""},
    {"SI_UNIT", "NAMED_UNIT", "?E,E"},
    {"CONVERSION_BASED_UNIT", "NAMED_UNIT", "S,#MEASURE_WITH_UNIT"},
    {"DIMENSIONAL_EXPONENTS", "", "R,R,R,R,R,R,R"},
    {"DERIVED_UNIT", "", "(#DERIVED_UNIT_ELEMENT)"},
    {"DERIVED_UNIT_ELEMENT", "", "#NAMED_UNIT,R"},
    {"MEASURE_WITH_UNIT", "", "T,#NAMED_UNIT|DERIVED_UNIT"},
    {"LENGTH_MEASURE_WITH_UNIT", "MEASURE_WITH_UNIT", ""},
    {"UNCERTAINTY_MEASURE_WITH_UNIT", "MEASURE_WITH_UNIT", "S,?S"},
    {"MEASURE_REPRESENTATION_ITEM", "REPRESENTATION_ITEM MEASURE_WITH_UNIT", ""},
    {"APPLICATION_CONTEXT", "", "S"},
    {"APPLICATION_PROTOCOL_DEFINITION", "", "S,S,I,#APPLICATION_CONTEXT"},
    {"APPLICATION_CONTEXT_ELEMENT", "", "S,#APPLICATION_CONTEXT"},
    {"PRODUCT_CONTEXT", "APPLICATION_CONTEXT_ELEMENT", "S"},
    {"PRODUCT_DEFINITION_CONTEXT", "APPLICATION_CONTEXT_ELEMENT", "S"},
    {"PRODUCT", "", "S,S,?S,(#PRODUCT_CONTEXT)"},
    {"PRODUCT_DEFINITION_FORMATION", "", "S,?S,#PRODUCT"},
    {"PRODUCT_DEFINITION", "", "S,?S,#PRODUCT_DEFINITION_FORMATION,#PRODUCT_DEFINITION_CONTEXT"},
    {"PROPERTY_DEFINITION", "", "S,?S,#PRODUCT_DEFINITION|PRODUCT_DEFINITION_RELATIONSHIP|PROPERTY_DEFINITION"},
    {"PRODUCT_DEFINITION_SHAPE", "PROPERTY_DEFINITION", ""},
    {"PROPERTY_DEFINITION_REPRESENTATION", "", "#PROPERTY_DEFINITION,#REPRESENTATION"},
    {"SHAPE_DEFINITION_REPRESENTATION", "PROPERTY_DEFINITION_REPRESENTATION", ""},
    {"PRODUCT_CATEGORY", "", "S,?S"},
    {"PRODUCT_RELATED_PRODUCT_CATEGORY", "PRODUCT_CATEGORY", "(#PRODUCT)"},
    {"PRODUCT_DEFINITION_RELATIONSHIP", "", "S,S,?S,#PRODUCT_DEFINITION,#PRODUCT_DEFINITION"},
    {"NEXT_ASSEMBLY_USAGE_OCCURRENCE", "PRODUCT_DEFINITION_RELATIONSHIP", "?S"},
    {"CONTEXT_DEPENDENT_SHAPE_REPRESENTATION", "", "#SHAPE_REPRESENTATION_RELATIONSHIP,#PRODUCT_DEFINITION_SHAPE"},
    {"COLOUR_RGB", "", "S,R,R,R"},
    {"FILL_AREA_STYLE_COLOUR", "", "S,#COLOUR_RGB"},
    {"FILL_AREA_STYLE", "", "S,(#FILL_AREA_STYLE_COLOUR)"},
    {"SURFACE_STYLE_FILL_AREA", "", "#FILL_AREA_STYLE"},
    {"SURFACE_SIDE_STYLE", "", "S,(#SURFACE_STYLE_FILL_AREA)"},
    {"SURFACE_STYLE_USAGE", "", "E,#SURFACE_SIDE_STYLE"},
    {"DRAUGHTING_PRE_DEFINED_CURVE_FONT", "", "S"},
    {"CURVE_STYLE", "", "S,#DRAUGHTING_PRE_DEFINED_CURVE_FONT,T,#COLOUR_RGB"},
    {"POINT_STYLE", "", "S,T,T,#COLOUR_RGB"},
    {"PRESENTATION_STYLE_ASSIGNMENT", "", "(T|#SURFACE_STYLE_USAGE|CURVE_STYLE|POINT_STYLE)"},
    {"STYLED_ITEM", "REPRESENTATION_ITEM", "(#PRESENTATION_STYLE_ASSIGNMENT),#REPRESENTATION_ITEM"},
    {"OVER_RIDING_STYLED_ITEM", "STYLED_ITEM", "#STYLED_ITEM"},
    {"CONTEXT_DEPENDENT_OVER_RIDING_STYLED_ITEM", "OVER_RIDING_STYLED_ITEM", "(#SHAPE_REPRESENTATION_RELATIONSHIP)"},
    {"INVISIBILITY", "", "(#STYLED_ITEM)"},
    {"PRESENTATION_LAYER_ASSIGNMENT", "", "S,S,(#REPRESENTATION_ITEM)"},
};

std::vector<std::string> split(std::string_view text, char at) {
  std::vector<std::string> out;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find(at, from), text.size());
    out.emplace_back(text.substr(from, to - from));
    from = to + 1;
  }
  return out;
}

const Row* row_of(std::string_view entity) {
  const auto at = std::find_if(std::begin(table), std::end(table), [&](const Row& r) { return entity == r.entity; });
  return at == std::end(table) ? nullptr : at;
}

// Itself and all above it, the topmost first: the order of a simple instance's attributes.
void lineage(const std::string& entity, std::vector<std::string>& out) {
  const Row* row = row_of(entity);
  if (!row) return;
  for (const std::string& above : split(row->supertypes, ' ')) lineage(above, out);
  if (std::find(out.begin(), out.end(), entity) == out.end()) out.push_back(entity);
}

struct Checked {  // one instance
  std::string name;                  // #12=CIRCLE
  std::vector<std::string> parts;    // keywords
  std::set<std::string> is;
  step::Tape tape;
};

class Checker {
 public:
  explicit Checker(const step::File& file) : file_(file) {
    for (const step::Instance& i : file.instances()) read(i);
  }

  std::vector<std::string> run() {
    for (auto& [id, c] : instances_) {
      if (faults_.size() >= 100) break;
      const bool simple = c.parts.size() == 1;
      for (std::size_t p = 0; p < c.parts.size(); ++p) check_part(c, p, simple);
    }
    if (!faults_.empty()) return faults_;  // the rules read attributes
    for (auto& [id, c] : instances_) {
      if (faults_.size() >= 100) break;
      rules(c);
    }
    return faults_;
  }

 private:
  void fault(const Checked& c, const std::string& what) { faults_.push_back(c.name + ": " + what); }

  void read(const step::Instance& i) {
    Checked& c = instances_[i.id];
    c.name = fmt::format("#{}={}", i.id, file_.keyword(i).name);
    if (!c.tape.read(file_.value(i), Limits{}) || !c.tape.faults().empty()) fault(c, "cannot be read");
    for (const auto& part : c.tape.parts()) {
      c.parts.emplace_back(part.keyword);
      std::vector<std::string> all;
      lineage(c.parts.back(), all);
      if (all.empty()) fault(c, "is not in the table: " + c.parts.back());
      c.is.insert(all.begin(), all.end());
    }
    if (!std::is_sorted(c.parts.begin(), c.parts.end())) fault(c, "parts out of order");
    if (c.parts.size() > 1) {  // every supertype of a part is a part of its own
      for (const std::string& above : c.is) {
        if (std::find(c.parts.begin(), c.parts.end(), above) == c.parts.end()) fault(c, "lacks the part " + above);
      }
    }
  }

  void check_part(const Checked& c, std::size_t p, bool simple) {
    std::vector<std::string> kinds, line{c.parts[p]};
    if (simple) line.clear(), lineage(c.parts[p], line);
    for (const std::string& e : line) {
      for (const std::string& kind : split(row_of(e) ? row_of(e)->attributes : "", ',')) kinds.push_back(kind);
    }
    std::vector<std::uint32_t> at;
    const auto& part = c.tape.parts()[p];
    for (std::uint32_t t = part.first; t < part.end; t = c.tape[t].end) at.push_back(t);
    if (at.size() != kinds.size()) return fault(c, fmt::format("{} attributes, {} are due", at.size(), kinds.size()));
    for (std::size_t k = 0; k < at.size(); ++k) {
      if (!fits(c, at[k], kinds[k])) fault(c, fmt::format("attribute {} is not {}", k + 1, kinds[k]));
    }
  }

  bool fits(const Checked& c, std::uint32_t at, std::string_view kind) {
    const Token& t = c.tape[at];
    if (kind.front() == '?') return t.kind == Token::Kind::Unset || fits(c, at, kind.substr(1));
    if (kind.front() == '(' || kind.front() == '[') {
      if (t.kind != Token::Kind::List || (kind.front() == '(' && t.end == at + 1)) return false;
      for (std::uint32_t m = at + 1; m < t.end; m = c.tape[m].end) {
        if (!fits(c, m, kind.substr(1, kind.size() - 2))) return false;
      }
      return true;
    }
    const std::string_view text = c.tape.text(t);
    const std::size_t bar = kind.find('|');
    if (kind.front() == 'T') return t.kind == Token::Kind::Typed || (bar != kind.npos && fits(c, at, kind.substr(bar + 1)));
    if (kind.front() == '*') return t.kind == Token::Kind::Derived || (bar != kind.npos && fits(c, at, kind.substr(bar + 1)));
    switch (kind.front()) {
      case 'S': return t.kind == Token::Kind::String;
      case 'R': return t.kind == Token::Kind::Real && std::isfinite(t.real);
      case 'I': return t.kind == Token::Kind::Integer;
      case 'B': return t.kind == Token::Kind::Enumeration && (text == "T" || text == "F");
      case 'L': return t.kind == Token::Kind::Enumeration && (text == "T" || text == "F" || text == "U");
      case 'E': return t.kind == Token::Kind::Enumeration && text.size() > 1;
      case 'M': return t.kind == Token::Kind::List && t.end > at + 1;
      default: break;
    }
    if (t.kind != Token::Kind::Reference) return false;
    const auto target = instances_.find(t.id);
    if (target == instances_.end()) return false;
    const auto allowed = split(kind.substr(1), '|');
    return std::any_of(allowed.begin(), allowed.end(), [&](const std::string& e) { return target->second.is.count(e) > 0; });
  }

  // Attribute `k` (from 0) of a simple instance.
  std::uint32_t attribute(const Checked& c, std::size_t k) const {
    std::uint32_t t = c.tape.parts()[0].first;
    while (k-- > 0) t = c.tape[t].end;
    return t;
  }
  const Checked* target(const Checked& c, std::size_t k) const {
    const auto at = instances_.find(c.tape[attribute(c, k)].id);
    return at == instances_.end() ? nullptr : &at->second;
  }
  std::vector<double> reals(const Checked& c, std::size_t k) const {
    std::vector<double> out;
    const std::uint32_t at = attribute(c, k);
    for (std::uint32_t t = at; t < c.tape[at].end; ++t) {
      if (c.tape[t].kind == Token::Kind::Real) out.push_back(c.tape[t].real);
      if (c.tape[t].kind == Token::Kind::Integer) out.push_back(static_cast<double>(c.tape[t].integer));
    }
    return out;
  }
  bool is_true(const Checked& c, std::size_t k) const { return c.tape.text(c.tape[attribute(c, k)]) == "T"; }
  std::size_t members(const Checked& c, std::size_t k) const { return c.tape.count(attribute(c, k)); }

  void rules(const Checked& c) {
    if (c.parts.size() != 1) return;
    const std::string& e = c.parts[0];
    const auto positive = [&](std::size_t k) {
      if (!(reals(c, k).at(0) > 0)) fault(c, fmt::format("attribute {} is not positive", k + 1));
    };
    if (e == "DIRECTION") {
      double sum = 0;
      for (const double x : reals(c, 1)) sum += x * x;
      if (std::abs(std::sqrt(sum) - 1) > 1e-9) fault(c, "not of length 1");
    } else if (e == "AXIS2_PLACEMENT_3D") {
      const auto z = reals(*target(c, 2), 1), x = reals(*target(c, 3), 1);
      if (std::abs(z[0] * x[0] + z[1] * x[1] + z[2] * x[2]) > 1e-9) fault(c, "axes are not at right angles");
    } else if (e == "CIRCLE" || e == "PARABOLA" || e == "CYLINDRICAL_SURFACE" || e == "SPHERICAL_SURFACE" || e == "VECTOR") {
      positive(2);
    } else if (e == "ELLIPSE" || e == "HYPERBOLA" || e == "TOROIDAL_SURFACE") {
      positive(2), positive(3);
      if (e == "TOROIDAL_SURFACE" && !(reals(c, 2)[0] >= reals(c, 3)[0])) fault(c, "major radius below the minor one");
    } else if (e == "CONICAL_SURFACE") {
      const double angle = reals(c, 3)[0];
      if (reals(c, 2)[0] < 0 || !(angle > 0 && angle < 1.5707963267948966)) fault(c, "radius or angle out of range");
    } else if (e == "B_SPLINE_CURVE_WITH_KNOTS") {
      const double degree = reals(c, 1)[0];
      knots(c, degree, members(c, 2), reals(c, 6), reals(c, 7));
    } else if (e == "B_SPLINE_SURFACE_WITH_KNOTS") {
      const std::uint32_t rows = attribute(c, 3);
      knots(c, reals(c, 1)[0], c.tape.count(rows), reals(c, 8), reals(c, 10));
      for (std::uint32_t r = rows + 1; r < c.tape[rows].end; r = c.tape[r].end) {
        knots(c, reals(c, 2)[0], c.tape.count(r), reals(c, 9), reals(c, 11));
      }
    } else if (e == "EDGE_LOOP") {
      closed(c);
    } else if (e == "SEAM_CURVE" || e == "SURFACE_CURVE") {
      const std::size_t n = members(c, 2);
      if (e == "SEAM_CURVE" ? n != 2 : n > 2) fault(c, "number of pcurves");
    } else if (e == "COLOUR_RGB") {
      for (std::size_t k = 1; k < 4; ++k) {
        if (!(reals(c, k)[0] >= 0 && reals(c, k)[0] <= 1)) fault(c, "a colour outside 0 to 1");
      }
    } else if (e == "GEOMETRIC_CURVE_SET" && c.tape.parts()[0].first > 0) {
      for (std::uint32_t t = attribute(c, 1) + 1; t < c.tape[attribute(c, 1)].end; ++t) {
        if (instances_.at(c.tape[t].id).is.count("SURFACE")) fault(c, "holds a surface");
      }
    } else if (e == "ADVANCED_FACE") {
      std::size_t outer = 0;
      for (std::uint32_t t = attribute(c, 1) + 1; t < c.tape[attribute(c, 1)].end; ++t) {
        outer += instances_.at(c.tape[t].id).is.count("FACE_OUTER_BOUND");
      }
      if (outer > 1) fault(c, "more than one outer bound");
    } else if (e == "TRIANGULATED_FACE") {
      const double used = reals(c, 2)[0];
      for (const double i : reals(c, 6)) {
        if (i < 1 || i > used) return fault(c, "a triangle outside its points");
      }
      if (members(c, 5) != static_cast<std::size_t>(used)) fault(c, "pnmax is not the number of points");
      if (members(c, 3) > 1 && members(c, 3) != static_cast<std::size_t>(used)) fault(c, "number of normals");
    } else if (e == "COORDINATES_LIST") {
      if (members(c, 2) != static_cast<std::size_t>(reals(c, 1)[0])) fault(c, "npoints");
    }
  }

  void knots(const Checked& c, double degree, std::size_t poles, const std::vector<double>& multiplicities,
             const std::vector<double>& values) {
    double sum = 0;
    for (std::size_t i = 0; i < multiplicities.size(); ++i) {
      sum += multiplicities[i];
      const bool end = i == 0 || i + 1 == multiplicities.size();
      if (multiplicities[i] < 1 || multiplicities[i] > degree + (end ? 1 : 0)) fault(c, "a knot's multiplicity");
    }
    if (degree < 1 || sum != static_cast<double>(poles) + degree + 1) fault(c, "multiplicities are not poles + degree + 1");
    if (multiplicities.size() != values.size()) fault(c, "knots and multiplicities");
    if (std::adjacent_find(values.begin(), values.end(), [](double a, double b) { return !(a < b); }) != values.end()) {
      fault(c, "knots do not ascend");
    }
  }

  // Each edge begins at the vertex where the one before ends.
  void closed(const Checked& c) {
    std::vector<std::pair<std::uint64_t, std::uint64_t>> ends;
    for (std::uint32_t t = attribute(c, 1) + 1; t < c.tape[attribute(c, 1)].end; ++t) {
      const Checked& use = instances_.at(c.tape[t].id);
      const Checked& edge = *target(use, 3);
      std::uint64_t from = edge.tape[attribute(edge, 1)].id, to = edge.tape[attribute(edge, 2)].id;
      if (!is_true(use, 4)) std::swap(from, to);
      ends.emplace_back(from, to);
    }
    for (std::size_t k = 0; k < ends.size(); ++k) {
      if (ends[k].second != ends[(k + 1) % ends.size()].first) return fault(c, "the loop is not closed");
    }
  }

  const step::File& file_;
  std::map<std::uint64_t, Checked> instances_;
  std::vector<std::string> faults_;
};

}  // namespace

std::vector<std::string> schema_faults(std::string_view part21) {
  Report report;
  const step::File file = step::File::parse(std::string(part21), Limits{}, report);
  std::vector<std::string> faults = Checker(file).run();
  for (const Diagnostic& d : report.items()) {
    if (d.severity >= Severity::Warning) faults.push_back(d.text);
  }
  if (file.instances().empty()) faults.push_back("no instances");
  return faults;
}

}  // namespace trimloop::test
