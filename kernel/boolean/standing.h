#pragma once
// Where the pieces of one operand stand towards the other (not part of the public face).

#include <functional>

#include "kernel/boolean/assemble.h"
#include "kernel/boolean/classify.h"

namespace trimloop::boolean {

enum class Standing : std::uint8_t { Outside, Inside, Same, Opposed };  // the last two: on it, normals alike or against

// The side of a point; nothing where it is not clear.
using SideOf = std::function<std::optional<Side>(Point)>;
// The side of a piece that can be told from its border; nothing otherwise.
using SideOfPiece = std::function<std::optional<Side>(std::uint32_t face, std::uint32_t piece)>;

// Of each piece of operand k, by face. Pieces that hang together along edges which the other body does not meet stand alike;
// `from_border` (may be empty) is asked first. Degenerate when it is not decided.
Result<std::vector<std::vector<Standing>>> standings(const Prepared&, std::size_t k, const SideOf&,
                                                     const SideOfPiece& from_border = {});

}  // namespace trimloop::boolean
