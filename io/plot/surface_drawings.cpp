#include <fmt/format.h>

#include <algorithm>

#include "io/plot/drawings.h"
#include "kernel/geometry/differential.h"
#include "kernel/mesh/tessellate.h"

namespace trimloop::io::plot {

namespace {

constexpr double wide = 900, high = 640;
constexpr int lines = 10, steps = 48;

std::vector<Point> isoline(const Surface& s, bool constant_u, double value, Interval range) {
  std::vector<Point> out;
  for (int i = 0; i <= steps; ++i) {
    const double t = range.at(static_cast<double>(i) / steps);
    out.push_back(evaluate(s, constant_u ? Uv{value, t} : Uv{t, value}));
  }
  return out;
}

// Isocurves in both directions, points for the view, and the lines on the page.
void add_isocurves(Canvas& canvas, const View& view, const Surface& s, Interval u, Interval v) {
  for (const bool constant_u : {true, false}) {
    const Interval across = constant_u ? u : v, along = constant_u ? v : u;
    for (int i = 0; i <= lines; ++i) {
      std::vector<Point> page;
      for (const Point& p : isoline(s, constant_u, across.at(static_cast<double>(i) / lines), along)) page.push_back(view(p));
      const bool border = i == 0 || i == lines;
      canvas.polyline(page, {constant_u ? blue : green, border ? 2.0 : 1.0});
    }
  }
}

std::vector<Point> surface_points(const Surface& s, Interval u, Interval v) {
  std::vector<Point> out;
  for (int i = 0; i <= lines; ++i)
    for (const Point& p : isoline(s, true, u.at(static_cast<double>(i) / lines), v)) out.push_back(p);
  return out;
}

Box box_of(const std::vector<Point>& points) {
  Box box;
  for (const Point& p : points) box.add(p);
  return box;
}

int channel(double x) { return static_cast<int>(std::lround(255 * std::clamp(x, 0.0, 1.0))); }

// `facing`: cosine between the normal and the light; a sheet is lit on both sides.
std::string lit(const Colour& c, double facing) {
  const double light = 0.4 + 0.6 * std::abs(facing);
  return fmt::format("#{:02x}{:02x}{:02x}", channel(light * c.r), channel(light * c.g), channel(light * c.b));
}

// Blue below, white at zero, red above.
std::string signed_colour(double share) {
  const double s = std::clamp(share, -1.0, 1.0);
  return s < 0 ? fmt::format("#{:02x}{:02x}{:02x}", channel(1 + 0.85 * s), channel(1 + 0.6 * s), 255)
               : fmt::format("#{:02x}{:02x}{:02x}", 255, channel(1 - 0.7 * s), channel(1 - 0.9 * s));
}

}  // namespace

std::vector<Canvas> draw_isocurves(const std::string& title, const Surface& s, Interval u, Interval v) {
  const std::vector<Point> points = surface_points(s, u, v);
  const View view = view_of(box_of(points));
  Canvas canvas(title + ": isoparametric curves", page_box(view, points), wide, high);
  canvas.note("blue: u constant; green: v constant");
  add_isocurves(canvas, view, s, u, v);
  return {canvas};
}

std::vector<Canvas> draw_net(const std::string& title, const Surface& s, Interval u, Interval v) {
  const auto converted = to_nurbs(s, u, v);
  if (!converted) return {};
  const NurbsSurface& n = converted->surface;
  std::vector<Point> points = surface_points(s, u, v);
  std::vector<std::vector<Point>> rows(n.poles_u());
  for (std::size_t i = 0; i < n.poles_u(); ++i)
    for (std::size_t j = 0; j < n.poles_v(); ++j)
      if (n.pole(i, j).w != 0) rows[i].push_back(project(n.pole(i, j)));
  for (const auto& row : rows) points.insert(points.end(), row.begin(), row.end());
  const View view = view_of(box_of(points));
  Canvas canvas(title + ": control net", page_box(view, points), wide, high);
  canvas.note(fmt::format("degrees {} x {}, {} x {} poles, {}", n.degree_u(), n.degree_v(), n.poles_u(), n.poles_v(),
                          n.is_rational() ? "rational" : "polynomial"));
  add_isocurves(canvas, view, s, u, v);
  const Pen net{red, 1, "none", "", 0.75};
  for (const auto& row : rows) {
    std::vector<Point> page;
    for (const Point& p : row) page.push_back(view(p));
    canvas.polyline(page, net);
    for (const Point& p : page) canvas.dot(p, 2.5, red);
  }
  for (std::size_t j = 0; j < n.poles_v(); ++j) {
    std::vector<Point> page;
    for (const auto& row : rows)
      if (j < row.size()) page.push_back(view(row[j]));
    canvas.polyline(page, net);
  }
  return {canvas};
}

Result<Canvas> draw_shaded(const std::string& title, const Body& body, What what, const Colour& own,
                           const Execution& execution) {
  Box box;
  for (const Edge& e : body.edges)
    if (e.curve)
      for (int i = 0; i <= 8; ++i) box.add(evaluate(*e.curve, e.range.at(i / 8.0)));
  for (const Vertex& v : body.vertices) box.add(v.point);
  mesh::TessellationOptions options;
  const double coarse = what == What::Shaded ? 4 : 1;  // stripes and colours need smaller tiles than light and shade
  options.deflection_mm = std::max(1e-9, box.diagonal() * coarse * 5e-4);
  options.angle_rad = coarse * 6 * pi / 180;
  const auto mesh = mesh::tessellate(body, options, execution);
  if (!mesh) return tl::unexpected(mesh.error());
  struct Tile {
    std::array<Point, 3> corner;
    double depth, value;
  };
  std::vector<Tile> tiles;
  const View view{false};
  std::vector<Point> all;
  double largest = 0;
  for (const mesh::FaceMesh& f : mesh->faces) {
    const Surface* surface = body.faces[f.face.index].surface.get();
    for (const auto& t : f.triangles) {
      Tile tile{};
      Vector normal{};
      Uv uv{};
      for (std::size_t k = 0; k < 3; ++k) {
        const mesh::FaceVertex& v = f.vertices[t[k]];
        tile.corner[k] = mesh->points[v.point];
        all.push_back(tile.corner[k]);
        tile.depth += view.depth(tile.corner[k]) / 3;
        normal += v.normal / 3;
        uv = uv + (1.0 / 3) * v.uv;
      }
      if (what == What::Gaussian) {
        const auto k = curvature(*surface, uv);
        tile.value = k ? k->gaussian : 0;
        largest = std::max(largest, std::abs(tile.value));
      } else {
        tile.value = dot(normalized(normal), normalized(Vector{0.3, -0.4, 0.85}));
      }
      tiles.push_back(tile);
    }
  }
  std::stable_sort(tiles.begin(), tiles.end(), [](const Tile& a, const Tile& b) { return a.depth < b.depth; });
  Canvas canvas(title + (what == What::Gaussian ? ": Gaussian curvature" : what == What::Zebra ? ": zebra" : ""), page_box(view, all), wide, high);
  if (what == What::Gaussian) canvas.note(fmt::format("red positive, blue negative, full colour at {:.4g} / mm2", largest));
  if (what == What::Zebra) canvas.note("stripes bend with the normal: a kink in a stripe is a joint of order 0, a corner one of order 1");
  for (const Tile& t : tiles) {
    const std::string colour = what == What::Gaussian ? signed_colour(largest > 0 ? std::cbrt(t.value / largest) : 0)
                               : what == What::Shaded ? lit(own, t.value)
                               : std::sin(30 * t.value) > 0 ? "#f5f7fa" : "#323f4b";
    canvas.tile({view(t.corner[0]), view(t.corner[1]), view(t.corner[2])}, colour);
  }
  return canvas;
}

}  // namespace trimloop::io::plot
