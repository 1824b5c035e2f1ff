#pragma once
// Tight boxes: sampled, then driven to the extremes in each coordinate, after an optional transform.

#include "kernel/check/measure.h"

namespace trimloop::detail {

// `at` may be null for the identity.
void add_curve(Box& box, const Curve& curve, Interval range, const Transform* at);
void add_face(Box& box, const Body& body, const Face& face, const Transform* at);

}  // namespace trimloop::detail
