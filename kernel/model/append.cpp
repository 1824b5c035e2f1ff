#include "kernel/model/append.h"

#include <iterator>

namespace trimloop {
namespace {

// Handles of the attributes of one model as those of another.
class AttributeMap {
 public:
  AttributeMap(Model& into, const Model& other) {
    for (Attributes a : other.attributes) {
      const auto layer = static_cast<std::size_t>(a.layer);
      if (a.layer >= 1 && layer <= other.layer_names.size() && !other.layer_names[layer - 1].empty())
        a.layer = into.layer_number(other.layer_names[layer - 1]);
      ids_.push_back(into.add(a));
    }
  }
  void change(AttributesId& id) const {
    if (id.index < ids_.size()) id = ids_[id.index];
  }

 private:
  std::vector<AttributesId> ids_;
};

void change(Part& part, const AttributeMap& map, std::uint32_t first_part) {
  for (Body& body : part.bodies) {
    map.change(body.attributes);
    for (Face& face : body.faces) map.change(face.attributes);
  }
  for (PolygonMesh& mesh : part.meshes) {
    map.change(mesh.attributes);
    for (MeshFace& face : mesh.faces) map.change(face.attributes);
    for (MeshLine& line : mesh.lines) map.change(line.attributes);
  }
  for (FreeCurve& c : part.curves) map.change(c.attributes);
  for (FreePoint& p : part.points) map.change(p.attributes);
  for (Annotation& a : part.annotation) map.change(a.attributes);
  for (Instance& i : part.instances) {
    map.change(i.attributes);
    i.part += first_part;
  }
}

}  // namespace

std::uint32_t append(Model& into, Model other) {
  const AttributeMap map(into, other);
  const auto first_part = static_cast<std::uint32_t>(into.parts.size());
  const auto first_view = static_cast<std::uint32_t>(into.views.size());
  for (Part& part : other.parts) change(part, map, first_part);
  for (Drawing& drawing : other.drawings) {
    for (Annotation& a : drawing.annotation) map.change(a.attributes);
    for (Drawing::Placed& v : drawing.views) v.view += first_view;
  }
  std::move(other.parts.begin(), other.parts.end(), std::back_inserter(into.parts));
  std::move(other.views.begin(), other.views.end(), std::back_inserter(into.views));
  std::move(other.drawings.begin(), other.drawings.end(), std::back_inserter(into.drawings));
  return first_part;
}

}  // namespace trimloop
