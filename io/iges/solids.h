#pragma once
// Boundary representation: solids (186), shells (514), faces (510), loops (508), edge lists (504), vertex lists (502).

#include <functional>
#include <map>

#include "io/iges/context.h"
#include "kernel/heal/make_face.h"

namespace trimloop::io::iges_import {

// Fills one body. An edge is one wherever the file names the same entry of the same list, and so is a vertex.
class BrepReader {
 public:
  // Attributes of a face: how names and colours pass down to it is the caller's business.
  using FaceAttributes = std::function<AttributesId(const DirectoryEntry& face)>;

  BrepReader(Context& context, Body& body, FaceAttributes attributes)
      : context_(context), body_(body), attributes_(std::move(attributes)) {}

  void solid(const DirectoryEntry& entry);                                  // 186
  void shell(const DirectoryEntry& entry, bool turned, bool is_void);       // 514
  void shell(const DirectoryEntry& entry) { shell(entry, false, false); }
  FaceId face(const DirectoryEntry& entry);                                 // 510; always adds exactly one

 private:
  using Key = std::pair<std::int32_t, std::int64_t>;  // (list DE, index from 1)

  std::optional<heal::FaceInput> face_input(const DirectoryEntry& entry);
  std::optional<heal::TrimLoop> loop(const DirectoryEntry& entry, const PlacedSurface& surface);
  EdgeId edge(Ref list, std::int64_t index);
  EdgeId make_edge(Ref list, std::int64_t index);
  VertexId vertex(Ref list, std::int64_t index);

  Context& context_;
  Body& body_;
  heal::SharedEdges shared_;
  FaceAttributes attributes_;
  Transform outer_;                  // matrix of the solid or shell
  std::map<Key, EdgeId> edges_;      // none: cannot be used, said so
  std::map<Key, VertexId> vertices_;
  std::map<std::int32_t, FaceId> faces_;
};

// Primitives and swept solids (150-168) as bodies in model space; nothing after a finding.
bool is_primitive(const DirectoryEntry&);
std::optional<Body> primitive_body(Context& context, const DirectoryEntry& entry);

}  // namespace trimloop::io::iges_import
