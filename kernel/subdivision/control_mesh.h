#pragma once
// Control mesh of a subdivision surface: points and faces, the faces' corners counter-clockwise seen from outside.
// Borders are data; an edge with more than two faces, or with two that run the same way, is refused.

#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"
#include "kernel/math/vec.h"

namespace trimloop::subdivision {

struct Crease {
  std::uint32_t a = 0, b = 0;  // ends of an edge, in any order
  double sharpness = infinity; // rounds for which the crease is kept; infinite: always (DeRose, Kass and Truong 1998)
};

struct ControlMesh {
  std::vector<Point> points;
  std::vector<std::uint32_t> corners;         // of all faces, one after the other
  std::vector<std::uint32_t> face_start{0};   // face f has corners[face_start[f]] .. corners[face_start[f + 1]]
  std::vector<Crease> creases;
  std::vector<std::uint32_t> fixed;           // points that stay where they are (corners), under schemes with creases
  std::vector<std::uint32_t> rounded;         // border points of one face that follow the border's curve; others are kept

  std::size_t face_count() const { return face_start.size() - 1; }
  std::span<const std::uint32_t> face(std::size_t f) const {
    return {corners.data() + face_start[f], face_start[f + 1] - face_start[f]};
  }
  void add_face(std::span<const std::uint32_t> of) {
    corners.insert(corners.end(), of.begin(), of.end());
    face_start.push_back(static_cast<std::uint32_t>(corners.size()));
  }
};

// What refers to what. Half-edge h runs from corners[h] to the next corner of its face.
struct Adjacency {
  static constexpr std::uint32_t none = 0xffffffff;
  std::vector<std::uint32_t> face;          // of half-edge h
  std::vector<std::uint32_t> next, before;  // within the face
  std::vector<std::uint32_t> twin;          // the other half of the edge; none on a border
  std::vector<std::uint32_t> edge;          // of half-edge h
  std::vector<std::uint32_t> edge_half;     // of edge e: the half-edge that comes first
  std::vector<double> edge_sharpness;       // 0: smooth
  std::vector<std::uint32_t> out;           // of vertex v: a half-edge that leaves it, the border one if there is one; none: unused
  std::vector<std::uint32_t> border_in;     // of vertex v: on a border, the half-edge that enters it along the border; else none
  std::vector<std::uint32_t> valence;       // edges at vertex v
  std::vector<bool> fixed;                  // vertex v stays: listed, or a border point of one face that is not rounded
};

// Refuses, with the place: fewer than 3 corners, a corner out of range or repeated in its face, points that are not
// finite, edges of more than two faces or of two that run the same way, vertices where faces only touch, creases that
// are no edge.
Result<Adjacency> adjacency(const ControlMesh&);

// Half-edges that leave `vertex`, counter-clockwise; on a border from the border half-edge on.
std::vector<std::uint32_t> outgoing(const Adjacency&, std::uint32_t vertex);

}  // namespace trimloop::subdivision
