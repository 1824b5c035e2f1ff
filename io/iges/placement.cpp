#include "io/iges/placement.h"

#include "formats/iges/records/curves.h"
#include "formats/iges/rules.h"

namespace trimloop::io::iges_import {
namespace {

Transform matrix_of(const iges::TransformationMatrix& record, double length_scale) {
  Transform t;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column) t.r[row][column] = record.m[4 * row + column];
  t.t = {record.m[3] * length_scale, record.m[7] * length_scale, record.m[11] * length_scale};
  return t;
}

}  // namespace

Transform placement(Context& context, const DirectoryEntry& entry, double length_scale) {
  Transform total;
  if (entry.transform == 0) return total;
  const std::size_t deepest = context.execution.limits.nesting_depth;
  const DirectoryEntry* at = &entry;
  for (std::size_t depth = 0; at->transform != 0; ++depth) {
    // A loop of matrices is as endless as a chain without one: both end here.
    if (depth >= deepest) {
      context.add(entry, iges::rules::transform_cycle,
                  "the chain of transformation matrices from D" + std::to_string(entry.transform) +
                      " has no end; the entity stays where its own coordinates put it",
                  static_cast<double>(depth), static_cast<double>(deepest));
      return {};
    }
    const DirectoryEntry* next = at->transform > 0 ? context.file.find(Ref{at->transform}) : nullptr;
    if (!next || next->type != iges::TransformationMatrix::type) {
      // A dangling pointer was found with the directory; a wrong type is seen here.
      if (next)
        context.add(entry, iges::rules::target_type,
                    name_of(*next) + " is no transformation matrix (124); it is not applied");
      return total;
    }
    const auto* record = context.record<iges::TransformationMatrix>(*next);
    if (!record) {
      context.add(entry, iges::rules::transform_cycle,
                  "matrix " + name_of(*next) + " cannot be used; it is not applied");
      return total;
    }
    total = matrix_of(*record, length_scale) * total;
    at = next;
  }
  return total;
}

Transform matrix_placement(Context& context, const DirectoryEntry& matrix) {
  const auto* record = context.record<iges::TransformationMatrix>(matrix);
  return record ? placement(context, matrix, context.unit.scale) * matrix_of(*record, context.unit.scale) : Transform{};
}

}  // namespace trimloop::io::iges_import
