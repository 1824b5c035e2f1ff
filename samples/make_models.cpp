// Builds the sample models with the library and writes each as IGES: make_models FOLDER

#include <trimloop/trimloop.h>

#include <cstdio>
#include <filesystem>

#include "samples/hull.h"
#include "samples/teapot.h"

using namespace trimloop;

namespace {

SurfacePtr shared(Surface surface) { return std::make_shared<const Surface>(std::move(surface)); }

Frame frame_at(Point origin, Vector axis, Vector x = {}) { return make_frame(origin, axis, x); }

heal::FaceInput face(Surface surface) {
  heal::FaceInput input;
  input.surface = shared(std::move(surface));
  return input;
}

// A loop in the plane of a `Plane` surface: straight from corner to corner.
heal::TrimLoop polygon(const std::vector<Uv>& corners) {
  heal::TrimLoop loop;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    heal::TrimSegment segment;
    segment.pcurve = make_line2(corners[i], corners[(i + 1) % corners.size()]);
    loop.segments.push_back(segment);
  }
  return loop;
}

heal::TrimLoop circle(Uv centre, double radius) {
  Circle shape;
  shape.frame = frame_at({centre.u, centre.v, 0}, {0, 0, 1}, {1, 0, 0});
  shape.radius = radius;
  heal::TrimLoop loop;
  heal::TrimSegment segment;
  segment.pcurve = Curve2{Curve{shape}};
  loop.segments.push_back(segment);
  return loop;
}

Model model_of(std::string name, std::vector<heal::FaceInput> faces, Colour colour) {
  Model model;
  model.name = name;
  model.parts.emplace_back();
  Attributes attributes;
  attributes.name = std::move(name);
  attributes.colour = colour;
  Body body;
  body.attributes = model.add(attributes);
  for (const heal::FaceInput& input : faces) heal::add_face(body, input);
  model.parts[0].bodies.push_back(std::move(body));
  return model;
}

// One plane face of a box: corner, and the two edge vectors whose cross product points outward.
heal::FaceInput side(Point corner, Vector a, Vector b) {
  heal::FaceInput input = face({Plane{frame_at(corner, cross(a, b), a)}});
  input.loops.push_back(polygon({{0, 0}, {norm(a), 0}, {norm(a), norm(b)}, {0, norm(b)}}));
  return input;
}

Model box() {
  const Vector x{80, 0, 0}, y{0, 50, 0}, z{0, 0, 30};
  const Point o{};
  return model_of("box", {side(o, y, x), side(o + z, x, y), side(o, x, z), side(o + y, z, x), side(o, z, y), side(o + x, y, z)},
                  {0.3, 0.55, 0.85});
}

// A plate 120 x 80 x 8 with three round holes and a slot: planes with holes in them, and cylinders seen from inside.
Model plate() {
  constexpr double width = 120, depth = 80, height = 8;
  const std::vector<Uv> outline{{0, 0}, {width, 0}, {width, depth}, {0, depth}};
  const std::vector<Uv> slot{{20, 60}, {38, 60}, {38, 70}, {20, 70}};
  const std::vector<std::pair<Uv, double>> holes{{{25, 25}, 10.0}, {{95, 25}, 10.0}, {{60, 52}, 16.0}};
  std::vector<heal::FaceInput> faces;
  for (const double z : {height, 0.0}) {
    heal::FaceInput plane = face({Plane{frame_at({0, 0, z}, {0, 0, 1}, {1, 0, 0})}});
    plane.loops = {polygon(outline), polygon(slot)};
    for (const auto& [centre, radius] : holes) plane.loops.push_back(circle(centre, radius));
    plane.reversed = z == 0;
    faces.push_back(plane);
  }
  // Walls along an outline: outward for the border, inward for the slot.
  const auto walls = [&](const std::vector<Uv>& corners, bool inward) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Uv a = corners[i], b = corners[(i + 1) % corners.size()];
      heal::FaceInput wall = side({a.u, a.v, 0}, {b.u - a.u, b.v - a.v, 0}, {0, 0, height});
      wall.reversed = inward;
      faces.push_back(wall);
    }
  };
  walls(outline, false);
  walls(slot, true);
  for (const auto& [centre, radius] : holes) {
    heal::FaceInput wall = face({Cylinder{frame_at({centre.u, centre.v, 0}, {0, 0, 1}, {1, 0, 0}), radius}});
    wall.range_v = Interval{0, height};
    wall.reversed = true;
    faces.push_back(wall);
  }
  return model_of("plate", faces, {0.85, 0.6, 0.25});
}

Model cylinder() {
  heal::FaceInput wall = face({Cylinder{frame_at({}, {0, 0, 1}, {1, 0, 0}), 20}});
  wall.range_v = Interval{0, 60};
  heal::FaceInput top = face({Plane{frame_at({0, 0, 60}, {0, 0, 1}, {1, 0, 0})}});
  top.loops.push_back(circle({}, 20));
  heal::FaceInput bottom = face({Plane{frame_at({}, {0, 0, -1}, {1, 0, 0})}});
  bottom.loops.push_back(circle({}, 20));
  return model_of("cylinder", {wall, top, bottom}, {0.45, 0.7, 0.45});
}

Model sphere() { return model_of("sphere", {face({Sphere{frame_at({}, {0, 0, 1}, {1, 0, 0}), 25}})}, {0.8, 0.35, 0.35}); }

Model torus() { return model_of("torus", {face({Torus{frame_at({}, {0, 0, 1}, {1, 0, 0}), 40, 12}})}, {0.6, 0.45, 0.8}); }

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_models FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  for (const Model& model : {box(), plate(), cylinder(), sphere(), torus(), samples::hull(), samples::utah_teapot()}) {
    io::WriteOptions options;
    options.format = io::Format::Iges;
    const auto written = io::encode(model, {}, options);
    const auto saved = written ? io::save(folder / (model.name + ".igs"), written->bytes, true)
                               : Result<void>(tl::unexpected(written.error()));
    if (!saved || !written->losses.empty()) {
      std::fprintf(stderr, "%s: %s\n", model.name.c_str(), !saved ? saved.error().text.c_str() : written->losses[0].c_str());
      return 1;
    }
  }
  return 0;
}
