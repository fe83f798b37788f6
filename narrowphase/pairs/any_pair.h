// Runs the scalar test of any pair of shapes, chosen by their kinds.
#pragma once

#include "carom/shapes/shape.h"
#include "narrowphase/scalar/separation.h"
#include "narrowphase/scalar/vector.h"

namespace carom::scalar {

// In scaled units; nothing if there is no test for the kinds, as carom::supports() says. Real:
// float or double.
template <class Real>
SeparationAs<Real> separation_of(const Shape& a, const Shape& b, const PairPose<Real>& pose);

// The manifold of a contact, in metres, on A's surface, relative to A's position. Its points may be
// `reach` metres from B.
Manifold manifold_of(const Shape& shape_a, const Shape& shape_b, const PairPose<float>& pose,
                     const Separation& contact, float reach);

}  // namespace carom::scalar
