#include "io/description/builder.h"

namespace trimloop::io::description {

AttributesId Builder::attributes(const std::string& name) {
  if (name.empty()) return {};
  Attributes a;
  a.name = name;
  return model_.add(a);
}

void Builder::add(Curve curve, const std::string& name) {
  FreeCurve free;
  free.curve = std::move(curve);
  free.attributes = attributes(name);
  model_.parts[0].curves.push_back(std::move(free));
}

void Builder::add(Point point, const std::string& name) {
  FreePoint free;
  free.point = point;
  free.attributes = attributes(name);
  model_.parts[0].points.push_back(std::move(free));
}

void Builder::add(std::vector<NurbsSurface> surfaces, const std::string& name) {
  Body body;
  body.attributes = attributes(name);
  for (NurbsSurface& s : surfaces) {
    heal::FaceInput input;
    input.surface = std::make_shared<const Surface>(Surface{std::move(s)});
    input.attributes = body.attributes;
    heal::add_face(body, input);
  }
  model_.parts[0].bodies.push_back(std::move(body));
}

void Builder::add(Surface surface, const std::string& name) {
  Body body;
  body.attributes = attributes(name);
  heal::FaceInput input;
  input.surface = std::make_shared<const Surface>(std::move(surface));
  input.attributes = body.attributes;
  heal::add_face(body, input);
  model_.parts[0].bodies.push_back(std::move(body));
}

}  // namespace trimloop::io::description
