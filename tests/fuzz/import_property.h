#pragma once
// What must hold for a model read from any bytes whatever. Returns the first broken promise, or nullptr.

#include <string>

#include "io/io.h"

namespace trimloop::test {

inline const char* broken_import(std::string bytes, const char* name) {
  io::ReadOptions options;
  options.execution.limits.instances = 10'000;
  const io::ReadResult r = io::read_bytes(std::move(bytes), name, options);
  if (!r.usable && r.report.items().empty()) return "what cannot be used has a finding";
  for (const Part& part : r.model.parts) {
    for (const Instance& i : part.instances)
      if (i.part >= r.model.parts.size()) return "an occurrence is of a part of the model";
    for (const Body& body : part.bodies)
      for (const Face& face : body.faces) {
        if (face.status != FaceStatus::Failed && face.loops.empty()) return "only a failed face has no loop";
        if (face.status != FaceStatus::Ok && face.reason.empty()) return "a face that was changed or failed says why";
      }
  }
  if (!count(r.model, options.execution.limits.instances)) return "occurrences stay within the limit";
  return nullptr;
}

}  // namespace trimloop::test
