#pragma once
// OpenCASCADE's reading of a STEP file through STEPCAFControl: tree, boxes, volumes, names and colours. In a process of
// its own: it crashes on some legal files and must not take the caller along.

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "kernel/math/vec.h"

namespace trimloop::test {

struct OcctFace {
  double area = 0;         // mm^2, by our quadrature over its geometry (occt_flux.h)
  double error = 0;        // change of it at the last refinement
  double area_plain = 0;   // BRepGProp, fixed Gauss points: coarse, a check of `area`
  std::string name;
  bool has_colour = false;
  std::array<double, 3> colour{};
};
struct OcctOccurrence {  // leaf or node of the tree, depth first
  std::string path;      // names from the root, separated by '/'
  Point lo, hi;          // box of its shape where it stands
  bool has_box = false;
};
struct OcctStep {
  std::vector<OcctFace> faces;      // once per occurrence
  std::vector<double> volumes;      // of solids, in order
  double length = 0;                // of edges in no face
  std::vector<OcctOccurrence> tree;
  // Product manufacturing information as XCAF holds it: dimensions, tolerances, datums, and shapes that these refer to.
  std::array<std::size_t, 4> pmi{};
  double area() const;
  double area_error() const;
  double area_plain() const;
  double volume() const;
};
// Nothing when OpenCASCADE refuses the file, crashes, or needs more processor time than `patience_s`. Boxes are slow and asked apart.
std::optional<OcctStep> read_step_with_occt(const std::filesystem::path& path, bool with_boxes, unsigned patience_s = 60);

}  // namespace trimloop::test
