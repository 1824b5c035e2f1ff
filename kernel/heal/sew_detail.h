#pragma once
// The stages of sewing, in the order in which sew.cpp runs them.

#include <memory>

#include "kernel/heal/border.h"
#include "kernel/heal/sew.h"
#include "kernel/pcurve/sheet.h"

namespace trimloop::heal {

using pcurve::Sheet;

// Sets of indices that grow together; the smallest index names the set.
class Sets {
 public:
  explicit Sets(std::size_t n = 0) : parent_(n) {
    for (std::size_t i = 0; i < n; ++i) parent_[i] = static_cast<std::uint32_t>(i);
  }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  std::uint32_t add() {
    parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
    return parent_.back();
  }

 private:
  std::vector<std::uint32_t> parent_;
};

// Where an edge is used.
struct Place {
  FaceId face;
  LoopId loop;
  std::uint32_t coedge = 0;  // in the loop
};

struct Sewing {
  Body body{};
  double tolerance_mm = 0;
  bool measure_gaps = true;
  std::vector<Body> origins{};            // the bodies that were given, without their contents
  std::vector<std::uint32_t> origin{};    // of each face
  SewReport report{};
  Sets vertices{};                      // that are one
  std::vector<bool> inward{};           // of each shell: closed, and as given its faces looked into it
  std::stop_token stop{};
  std::vector<Track> tracks{};          // of the border edges, in an order that depends on geometry alone
  std::vector<std::vector<Place>> uses{};

  void find_uses();
  Coedge& coedge(const Place& p) { return body[p.loop].coedges[p.coedge]; }
  bool is_border(EdgeId e) const {
    return uses[e.index].size() == 1 && !body[e].is_pole && body[e].curve;
  }
  void make_tracks();
};

void append(Body& to, Body&& from);  // sew.cpp: all but its shells
void lift_edges(Sewing&);        // sew_split.cpp: border edges without a curve get one
void collapse_short(Sewing&);    // sew_split.cpp: edges below the tolerance become poles
void cluster_vertices(Sewing&);  // sew_split.cpp
void split_edges(Sewing&);       // sew_split.cpp: where another edge ends in their middle
void join_edges(Sewing&);        // sew_join.cpp
void settle_vertices(Sewing&);   // sew_join.cpp: one vertex for each set
void make_shells(Sewing&);       // sew_shells.cpp: connected faces, turned alike
void list_open(Sewing&);         // sew_shells.cpp
// nest_shells.cpp: voids move into the solid around them; what has moved, ascending. `inward` as in Sewing.
std::vector<std::size_t> nest_shells(std::vector<Body>& solids, const std::vector<bool>& inward);
SewResult separated(Sewing&&);   // sew_shells.cpp: into solids and the rest, without what is no longer used

}  // namespace trimloop::heal
