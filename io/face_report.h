#pragma once
// One row of a conversion report.

#include "io/io.h"

namespace trimloop::io {

// What a report says of a face whatever the output format; the areas are measured for healed faces only.
FaceReport face_report(const SourceInfo& source, const Body& body, FaceId face, std::uint32_t id);

}  // namespace trimloop::io
