#pragma once
// A composed IGES text, imported: what the tests of this folder start from.

#include <boost/test/unit_test.hpp>

#include "formats/iges/file.h"
#include "io/iges/import.h"
#include "kernel/check/measure.h"
#include "tests/support/iges_text.h"

namespace trimloop::test {

struct Imported {
  Report report;
  Model model;

  const Part& root() const { return model.parts.front(); }
  const Curve& curve(std::size_t i = 0) const {
    BOOST_REQUIRE_GT(root().curves.size(), i);
    return root().curves[i].curve;
  }
  // Faces of all bodies of the root part, in order.
  std::vector<const Face*> faces() const {
    std::vector<const Face*> out;
    for (const Body& b : root().bodies)
      for (const Face& f : b.faces) out.push_back(&f);
    return out;
  }
  const Face& face(std::size_t i = 0) const {
    const auto all = faces();
    BOOST_REQUIRE_GT(all.size(), i);
    return *all[i];
  }
  const Surface& surface(std::size_t i = 0) const {
    BOOST_REQUIRE(face(i).surface != nullptr);
    return *face(i).surface;
  }
  double area() const {  // of the root part
    double sum = 0;
    for (const Body& b : root().bodies)
      for (std::uint32_t f = 0; f < b.faces.size(); ++f) sum += trimloop::area(b, FaceId{f}).value;
    return sum;
  }
  // Nothing failed and every structural promise of the bodies holds.
  void check_sound() const {
    for (const Part& part : model.parts) {
      for (const Body& b : part.bodies) {
        for (const Face& f : b.faces) BOOST_TEST((f.status != FaceStatus::Failed), f.reason);
        for (const std::string& broken : broken_promises(b, 10 * std::max(model.resolution_mm, 1e-6))) BOOST_ERROR(broken);
      }
    }
  }
  bool has(std::string_view rule) const { return report.count(rule) > 0; }
  const Diagnostic& finding(std::string_view rule) const {
    for (const Diagnostic& d : report.items())
      if (d.rule->id == rule) return d;
    BOOST_REQUIRE_MESSAGE(false, "no finding " << rule);
    return report.items().front();
  }
};

inline Imported imported(const IgesText& text, const Limits& limits = {},
                         std::optional<LengthUnit> assume_unit = {}) {
  Imported out;
  const auto file = iges::File::parse(text.text(), limits, out.report);
  Execution execution;
  execution.limits = limits;
  out.model = io::iges_import::import(file, execution, assume_unit, out.report);
  BOOST_REQUIRE(!out.model.parts.empty());
  return out;
}

inline void check_point(Point is, Point wanted, double tolerance = 1e-12) {
  BOOST_TEST(distance(is, wanted) <= tolerance, "(" << is.x << " " << is.y << " " << is.z << ") is not (" << wanted.x
                                                    << " " << wanted.y << " " << wanted.z << ")");
}

constexpr const char* dependent = "00010000";        // physically dependent
constexpr const char* parametric = "00010500";       // dependent, in parameter space

}  // namespace trimloop::test
