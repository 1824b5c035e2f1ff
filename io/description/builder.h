#pragma once
// A model of free curves and untrimmed faces, as descriptions make them.

#include "kernel/heal/make_face.h"
#include "kernel/model/model.h"
#include "kernel/subdivision/limit_surface.h"

namespace trimloop::io::description {

class Builder {
 public:
  Builder() { model_.parts.emplace_back(); }

  void add(Curve curve, const std::string& name);
  void add(Point point, const std::string& name);
  void add(std::vector<NurbsSurface> surfaces, const std::string& name);  // one body
  void add(Surface surface, const std::string& name);

  Model finish(std::string name) {
    model_.name = std::move(name);
    return std::move(model_);
  }

 private:
  AttributesId attributes(const std::string& name);
  Model model_;
};

}  // namespace trimloop::io::description
