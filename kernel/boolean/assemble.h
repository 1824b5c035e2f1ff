#pragma once
// Pieces of faces put together to bodies (not part of the public face).

#include "kernel/boolean/arrange.h"

namespace trimloop::boolean {

struct KeptPiece {
  int operand = 0;
  std::uint32_t face = 0, piece = 0;
  bool turned = false;  // its normal is against the source's
};

// What was prepared of both operands.
struct Prepared {
  std::array<const Operand*, 2> operands{};
  Network network;
  std::array<std::vector<FacePieces>, 2> faces;
};

enum class Cuts : std::uint8_t { Dissolved, Kept };

// One body with one shell for each set of faces that hang together; shells are finished (Shell::closed). Pieces of one
// face that nothing parts any more are one face again, unless cuts are kept (those along seams never are).
Result<Body> assemble(const Prepared&, const std::vector<KeptPiece>&, Cuts = Cuts::Dissolved);

}  // namespace trimloop::boolean
