#pragma once
// Annotation of two models side by side: strokes and runs of text matched by where they are.

#include "kernel/model/model.h"

namespace trimloop {

struct DraftingComparison {
  // Matched within the tolerance (texts letter by letter), and left over on either side. In parts, once per occurrence, and
  // on drawings.
  std::size_t strokes_same = 0, strokes_first = 0, strokes_second = 0;
  std::size_t texts_same = 0, texts_first = 0, texts_second = 0;
  bool same() const { return strokes_first + strokes_second + texts_first + texts_second == 0; }
};
// Limit where there are more than `max_instances` occurrences, nested deeper than `max_depth`. Cost: n log n while few
// strokes begin at one x.
Result<DraftingComparison> compare_drafting(const Model& first, const Model& second, double tolerance_mm, std::size_t max_instances,
                                            std::size_t max_depth);

}  // namespace trimloop
