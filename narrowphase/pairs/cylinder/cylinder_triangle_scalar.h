// Cylinder (A) against triangle (B): the widest gap along the directions of two features, a feature
// a lane.
//
// Source: see narrowphase/hulls/solid_cylinder_scalar.h.
#pragma once

#include "narrowphase/pairs/round/solid_cylinder_scalar.h"

namespace carom::scalar {

inline Separation separation(const CylinderShape<float>& cylinder,
                             const TriangleShape<float>& triangle, const PairPose<float>& pose) {
  return flipped(solid_cylinder_separation(triangle, cylinder, flipped(pose)));
}

}  // namespace carom::scalar
