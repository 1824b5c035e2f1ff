#pragma once
// Control meshes for tests.

#include <array>
#include <random>

#include "kernel/subdivision/control_mesh.h"

namespace trimloop::subdivision::test {

inline ControlMesh cube() {
  ControlMesh m;
  for (int i = 0; i < 8; ++i) m.points.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
  for (const auto& f : std::vector<std::array<std::uint32_t, 4>>{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    m.add_face(f);
  return m;
}

inline ControlMesh tetrahedron() {
  ControlMesh m;
  m.points = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
  for (const auto& f : std::vector<std::array<std::uint32_t, 3>>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) m.add_face(f);
  return m;
}

inline ControlMesh octahedron() {
  ControlMesh m;
  m.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (const auto& f : std::vector<std::array<std::uint32_t, 3>>{
           {0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}})
    m.add_face(f);
  return m;
}

inline double bump(std::size_t i, std::size_t j) { return std::sin(1.3 * static_cast<double>(i)) + std::cos(2.1 * static_cast<double>(j)); }

// rows x columns points, quadrilaterals between them, a height field.
inline ControlMesh grid(std::size_t rows, std::size_t columns) {
  ControlMesh m;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j) m.points.push_back({static_cast<double>(i), static_cast<double>(j), bump(i, j)});
  const auto at = [columns](std::size_t i, std::size_t j) { return static_cast<std::uint32_t>(i * columns + j); };
  for (std::size_t i = 0; i + 1 < rows; ++i)
    for (std::size_t j = 0; j + 1 < columns; ++j) m.add_face(std::array{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  return m;
}

inline ControlMesh triangle_grid(std::size_t rows, std::size_t columns) {
  ControlMesh m = grid(rows, columns), out;
  out.points = m.points;
  for (std::size_t f = 0; f < m.face_count(); ++f) {
    const auto c = m.face(f);
    out.add_face(std::array{c[0], c[1], c[2]});
    out.add_face(std::array{c[0], c[2], c[3]});
  }
  return out;
}

// A closed ring of quadrilaterals in both directions.
inline ControlMesh torus(std::size_t rows, std::size_t columns) {
  ControlMesh m;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j) {
      const double a = two_pi * static_cast<double>(i) / static_cast<double>(rows), b = two_pi * static_cast<double>(j) / static_cast<double>(columns);
      m.points.push_back({(3 + std::cos(b)) * std::cos(a), (3 + std::cos(b)) * std::sin(a), std::sin(b)});
    }
  const auto at = [&](std::size_t i, std::size_t j) { return static_cast<std::uint32_t>((i % rows) * columns + j % columns); };
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j) m.add_face(std::array{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  return m;
}

}  // namespace trimloop::subdivision::test
