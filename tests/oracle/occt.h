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
  Point lo, hi;           // tight box in mm; of nothing where has_box is false
  bool has_box = false;
};

// Nothing when OpenCASCADE refuses the file, crashes, or needs longer than `patience_s`. The box is asked for apart, as
// it is slow on trimmed surfaces.
std::optional<OcctReading> read_with_occt(const std::filesystem::path& path, bool with_box, unsigned patience_s = 20);

}  // namespace trimloop::test
