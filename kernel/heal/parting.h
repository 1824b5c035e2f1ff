#pragma once
// Rings taken apart where strands cross, and strung together anew so that none cross.

#include "kernel/heal/crossings.h"

namespace trimloop::heal {

// Rings in pieces. `next` says which piece follows.
struct Strands {
  std::vector<Piece> pieces;
  std::vector<std::size_t> next;
  std::vector<std::size_t> ring;  // that each piece came from
  std::vector<int> crossed;       // nodes where strands cross
};

// The rings cut at the crossings, whose pieces are counted through all rings. One node at each crossing; a crossing at a
// joint of pieces has that joint's.
Strands cut_at(Draft&, std::vector<Ring> rings, const std::vector<Crossing>&);
// Nodes that are one: the pieces and `crossed` take the smaller one.
void join_nodes(Strands&, const std::vector<std::pair<int, int>>& same);
// Cycles of pieces: at each crossing every strand goes on where the next one that passes there does, so that no direction
// turns.
std::vector<std::vector<std::size_t>> strung(const Strands&);

}  // namespace trimloop::heal
