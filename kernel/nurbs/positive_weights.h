#pragma once
// The same shape with weights above zero, as exchange formats want them (IGES 5.3 4.23: weights > 0).

#include "kernel/nurbs/surface.h"

namespace trimloop {

// Knots are inserted where a weight is not positive until none is left: that happens when the denominator is positive
// over the range (Bernstein coefficients converge to it). All weights negative: the sign is taken out. Returns the
// shape itself when there is nothing to do. Unsupported, with the parameter, when the denominator falls to zero: the
// shape runs to infinity there.
Result<NurbsCurve> with_positive_weights(const NurbsCurve&);
Result<NurbsSurface> with_positive_weights(const NurbsSurface&);

}  // namespace trimloop
