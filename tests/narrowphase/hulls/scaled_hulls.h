// Pairs of hulls in scaled units, and exact answers about them.
#pragma once

#include "carom/shapes/shape.h"
#include "narrowphase/scalar/separation.h"
#include "narrowphase/scalar/shapes.h"
#include "oracle/random.h"

namespace carom::test {

struct HullPair {
  Hull a, b;
  scalar::PairPose<float> pose;
};

// Not a unit quaternion.
scalar::Quaternion<float> random_turn(oracle::Random& random);

// The separation of the hulls in double precision.
scalar::SeparationAs<double> exact_separation(const HullPair& pair);

// Whether a point, relative to the hull and in world axes, is in the hull up to rounding.
bool holds(const Hull& hull, const scalar::Quaternion<float>& turn, const Eigen::Vector3f& arm);

}  // namespace carom::test
