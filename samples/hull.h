#pragma once
// A ship's hull of sheets that lie flat before they are bent: two strips a side, each a part of a cone, with a plane
// transom and deck (seed 002 §1).

#include <trimloop/trimloop.h>

namespace samples {

trimloop::Model hull();

}  // namespace samples
