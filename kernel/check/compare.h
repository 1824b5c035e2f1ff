#pragma once
// Two models side by side: faces, free curves and points matched by their geometry, with the distance that was measured
// between matched ones, whatever the order, the format and the parametrization they came in.

#include "base/limits.h"
#include "kernel/model/model.h"

namespace trimloop {

struct FacePlace {
  std::uint32_t occurrence = 0;  // into occurrences(model)
  std::uint32_t part = 0, body = 0;
  FaceId face;
};

enum class Difference : std::uint8_t {
  Same,     // within the tolerance
  Changed,  // nearest of its kind, but farther away than the tolerance
  Moved,    // same area, border and extent at another place
  OnlyFirst,
  OnlySecond
};
std::string_view to_string(Difference);  // "same" "changed" "moved" "only-first" "only-second"

struct FacePair {
  Difference difference = Difference::Same;
  std::optional<FacePlace> first, second;
  double deviation_mm = 0;  // of samples of each face and border from the other; Moved: the way of the centre
  double area_first_mm2 = 0, area_second_mm2 = 0;
  bool renamed = false, recoloured = false;
};

struct CompareOptions {
  double tolerance_mm = 1e-3;
  Execution execution;
};

struct Comparison {
  std::vector<FacePair> faces;       // in the order of the first model, then what only the second has
  bool reordered = false;            // faces that are the same come in another order
  double max_deviation_mm = 0;       // over Same and Changed
  std::size_t failed_first = 0, failed_second = 0;  // faces without a shape to compare
  // Free curves and points: matched within the tolerance, and left over on either side.
  std::size_t curves_same = 0, curves_first = 0, curves_second = 0;
  std::size_t points_same = 0, points_first = 0, points_second = 0;
  std::size_t count(Difference) const;
};
// About 40 samples a face. Names and colours are those of the face, or of its body where it has none.
Result<Comparison> compare(const Model& first, const Model& second, const CompareOptions&);

}  // namespace trimloop
