// Box (A) against cylinder (B): the widest gap along the directions of two features, a feature a
// lane.
//
// Source: see narrowphase/hulls/solid_cylinder_scalar.h.
#pragma once

#include "narrowphase/pairs/round/solid_cylinder_scalar.h"

namespace carom::scalar {

inline Separation separation(const BoxShape<float>& box, const CylinderShape<float>& cylinder,
                             const PairPose<float>& pose) {
  return solid_cylinder_separation(box, cylinder, pose);
}

}  // namespace carom::scalar
