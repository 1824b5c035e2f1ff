#pragma once
// What healing did to a face, as findings under the rules of the entities concerned.

#include "io/iges/context.h"
#include "kernel/heal/make_face.h"

namespace trimloop::io::iges_import {

// One finding for each kind of step in each loop, with the largest measure and the number of places; for a
// healed face also its area after (measured) and before (limit).
void report_healing(Context& context, const DirectoryEntry& face, const heal::FaceInput& input,
                    const heal::FaceOutcome& outcome, const Face& made);

}  // namespace trimloop::io::iges_import
