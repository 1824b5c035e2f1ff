#include "io/weights.h"

#include <fmt/format.h>

#include <algorithm>

#include "kernel/nurbs/positive_weights.h"

namespace trimloop::io {

namespace {

bool sound(const std::vector<Hpoint>& poles) {
  return std::all_of(poles.begin(), poles.end(), [](const Hpoint& h) { return h.w > 0; });
}
bool sound(const Curve& c) {
  const auto* n = std::get_if<NurbsCurve>(&c.shape);
  return !n || sound(n->poles());
}
bool sound(const Surface& s) {
  const auto* n = std::get_if<NurbsSurface>(&s.shape);
  return !n || sound(n->poles());
}

bool sound(const Model& model) {
  for (const Part& part : model.parts) {
    for (const FreeCurve& c : part.curves)
      if (!sound(c.curve)) return false;
    for (const Body& body : part.bodies) {
      for (const Edge& e : body.edges)
        if (e.curve && !sound(*e.curve)) return false;
      for (const Face& f : body.faces)
        if (f.surface && !sound(*f.surface)) return false;
    }
  }
  return true;
}

// The shape with positive weights, or the reason why there is none.
template <class Shape, class Nurbs>
Result<Shape> mended(const Shape& shape) {
  auto made = trimloop::with_positive_weights(std::get<Nurbs>(shape.shape));
  if (!made) return tl::unexpected(made.error());
  return Shape{std::move(*made)};
}

}  // namespace

std::optional<Model> with_positive_weights(const Model& model, std::vector<std::string>& losses) {
  if (sound(model)) return std::nullopt;
  Model out = model;
  for (Part& part : out.parts) {
    std::vector<FreeCurve> kept;
    for (FreeCurve& c : part.curves) {
      if (!sound(c.curve)) {
        auto curve = mended<Curve, NurbsCurve>(c.curve);
        if (!curve) {
          losses.push_back(fmt::format("a free curve with weights of zero or less: {}", curve.error().text));
          continue;
        }
        c.curve = std::move(*curve);
      }
      kept.push_back(std::move(c));
    }
    part.curves = std::move(kept);
    for (Body& body : part.bodies) {
      for (Edge& e : body.edges) {
        if (!e.curve || sound(*e.curve)) continue;
        if (auto curve = mended<Curve, NurbsCurve>(*e.curve)) e.curve = std::make_shared<const Curve>(std::move(*curve));
        else losses.push_back(fmt::format("positive weights of an edge: {}", curve.error().text));
      }
      for (Face& f : body.faces) {
        if (!f.surface || sound(*f.surface)) continue;
        if (auto surface = mended<Surface, NurbsSurface>(*f.surface)) f.surface = std::make_shared<const Surface>(std::move(*surface));
        else losses.push_back(fmt::format("positive weights of a face's surface: {}", surface.error().text));
      }
    }
  }
  return out;
}

}  // namespace trimloop::io
