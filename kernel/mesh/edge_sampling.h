#pragma once
// Sample parameters of curves and edges: as few as the bounds allow, and the same ones for all faces of an edge.
//
// The number of chords is the integral of a density, "chords per unit of parameter", measured by second differences on
// a first set of nodes; the chords share that integral evenly and are then verified, and halved where they fail.
// Bounds: distance of the curve from its chord; turn of the tangent; and for each face of the edge, distance of
// S(uv chord) from the chord and turn of the surface normal, so that faces may take the uv chord for the edge.

#include <array>
#include <span>

#include "kernel/mesh/stop_check.h"
#include "kernel/topology/body.h"

namespace trimloop::mesh {

struct SampleBounds {
  double chord_mm = 0.1;
  double angle_rad = 0.35;
  std::size_t max_chords = 100'000;
};

// One use of an edge by a face with a surface.
struct EdgeUse {
  const Surface* surface = nullptr;
  const Coedge* coedge = nullptr;
};

struct EdgeSamples {
  std::vector<double> t;      // ascending, from edge.range.lo to edge.range.hi
  std::vector<Point> points;  // a pole: its vertex at each t
  double deviation_mm = 0;    // largest distance from a chord that was seen
};

// Nothing but the ends when stopped.
EdgeSamples sample_edge(const Body&, const Edge&, std::span<const EdgeUse> uses, const SampleBounds&, StopCheck&);

// Point of the edge at `t` by its curve, its vertex (a pole), or S(pcurve) of the first use.
Point edge_point(const Body&, const Edge&, std::span<const EdgeUse> uses, double t);

}  // namespace trimloop::mesh
