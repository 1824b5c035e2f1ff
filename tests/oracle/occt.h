#pragma once
// OpenCASCADE's reading of an IGES file, in figures. It runs in a process of its own: it crashes on some legal files
// and must not take the tests along.

#include <filesystem>
#include <optional>

#include "kernel/math/vec.h"

namespace trimloop::test {

struct OcctReading {
  int faces = 0;
  double area = 0;        // mm^2, adaptive integration
  double area_plain = 0;  // a fixed number of Gauss points a span: off by up to 6e-3 on some faces, so a check of `area`
  double area_fine = 0;   // by our quadrature over its geometry (occt_flux.h), with the box; < 0: a face without an image
  double length = 0;      // of edges in no face, with the box
  Point lo, hi;           // tight box in mm; of nothing where has_box is false
  bool has_box = false;
};

// Nothing when OpenCASCADE refuses the file, crashes, or needs longer than `patience_s`. The box and what comes
// with it are asked for apart: they are slow on trimmed surfaces.
std::optional<OcctReading> read_with_occt(const std::filesystem::path& path, bool with_box, unsigned patience_s = 20);

}  // namespace trimloop::test
