#pragma once
// What OpenCASCADE makes of a small IGES file, in one line of text; each question in a process of its own, as it may crash.

#include <filesystem>
#include <string>

#include "kernel/math/vec.h"

namespace trimloop::test {

// The figures of a summary, whoever found them.
struct Summary {
  int faces = 0, failed = 0, curves = 0;
  bool unbounded = false;          // some curve has no end; then length and box are those of the others
  double area = 0, length = 0;     // of faces, of curves that bound none
  Box box;
  bool has_middle = false;
  Point middle;                    // of the first face's surface, at the middle of its ranges
};
// "1 face, area 8, (0 1 0) to (4 3 0)", six digits; "1 face, middle (4 2 0)" where asked; "nothing".
std::string text_of(const Summary&, bool with_middle);

// The same of OpenCASCADE's reading; "refused", "crash", "no end" (20 s).
std::string occt_summary(const std::filesystem::path&, bool with_middle);
// The first coordinate of the point (116) that OpenCASCADE writes after reading the file, as its text.
std::string occt_rewritten_point(const std::filesystem::path&);

}  // namespace trimloop::test
