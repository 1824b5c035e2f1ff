#pragma once
// The area of a healed face before it was healed.

#include "kernel/heal/make_face.h"

namespace trimloop::heal {

// Area in mm^2 of the face with each choice between contradicting copies undone: where healing used the model curve, by
// the parameter curve as the file gives it, and the other way round. Loops are in the file's order and direction as far
// as they close; over a gap the shortest step in parameter space counts. Fails, with the reason, where the other copies
// bound no face. Cost: the face is made once more.
Result<double> area_before(const Body& body, const FaceInput& input, const std::vector<StepRecord>& steps);

}  // namespace trimloop::heal
