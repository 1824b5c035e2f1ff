#include "io/face_report.h"

#include "kernel/check/measure.h"

namespace trimloop::io {

FaceReport face_report(const SourceInfo& source, const Body& body, FaceId face_id, std::uint32_t id) {
  const Face& face = body[face_id];
  FaceReport row;
  row.id = id;
  if (!face.source.empty()) row.source = source_name(source.format, face.source.front());
  row.status = face.status;
  row.reason = face.reason;
  if (face.status == FaceStatus::Healed) {
    row.area_before_mm2 = face.area_before_mm2;
    row.area_mm2 = area(body, face_id, 1e-6).value;
  }
  return row;
}

}  // namespace trimloop::io
