// Decides two hulls by a ball that holds each, and one that lies in it (HullGeometry::balls()). The
// kernel in lanes does the same, operation for operation.
//
// The hulls lie in their outer balls: they are separate if those are. They overlap if their inner
// balls do. Both radii are rounded to the safe side. In scaled units, where no coordinate is
// greater than 2, middles and their distance are off by less than a quarter of kSureGap.
#pragma once

#include "narrowphase/hulls/gjk_scalar.h"

namespace carom::scalar {

struct BallDecision {
  bool is_sure, overlap;
};

struct PlacedBalls {
  Vector3f middle;
  float outer, inner;

  PlacedBalls(const HullShape<float>& hull, const Quaternion<float>& q, const Vector3f& offset) {
    const HullGeometry::Balls& balls = hull.geometry->balls();
    const auto& [x, y, z, radius] = balls.outer;
    middle = rotate(placing_turn(hull, q), Vector3f(x, y, z)) + offset;
    outer = radius * static_cast<float>(hull.scale);
    inner = balls.inner * static_cast<float>(hull.scale);
  }
};

// Shapes and pose are in scaled units. `up`: metres per unit.
inline BallDecision decide_by_balls(const HullShape<float>& a, const HullShape<float>& b,
                                    const PairPose<float>& pose, double up) {
  const PlacedBalls of_a(a, pose.a, Vector3f::Zero()), of_b(b, pose.b, pose.d);
  const Vector3f way = of_b.middle - of_a.middle;
  const float squared = dot(way, way);
  const float outer = (of_a.outer + of_b.outer) + kSureGap;
  const float inner = (of_a.inner + of_b.inner) - kSureGap;
  const bool is_apart = squared > outer * outer;
  const bool overlap = inner > 0 && squared < inner * inner;
  return {is_usual_scale(up) && (is_apart || overlap), overlap};
}

}  // namespace carom::scalar
