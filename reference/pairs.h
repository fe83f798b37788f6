// Boxes and half-spaces -> pairs by brute force.
#pragma once

#include <span>
#include <vector>

#include "carom/reference/reference.h"

namespace carom::reference {

// All pairs a < b of rows of `boxes` that overlap, sorted. No box may be empty.
std::vector<Pair> overlapping_pairs(std::span<const Box> boxes);

// A half-space in world coordinates: all x with normal . x <= limit. The limit is rounded upwards;
// |x| + |y| + |z| times `slack` is more than what normal . x may be off by.
struct Plane {
  Eigen::Vector3d normal;
  double limit;
  double slack;
};

// Both must be valid.
Plane world_plane(const Halfspace& halfspace, const Pose& pose, PositionType positions);

// False only if all of the box is certainly outside the half-space.
bool may_reach(const Box& box, const Plane& plane);

}  // namespace carom::reference
