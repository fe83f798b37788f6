// The present bounds of bodies, to check pairs that were found with larger bounds.
#pragma once

#include "carom/results/pair.h"
#include "carom/shapes/views.h"
#include "world/pairs/halfspace_stage.h"

namespace carom {

// Whether two closed boxes overlap. Empty boxes overlap nothing.
inline bool boxes_meet(const BoundsView& bounds, Pair pair) {
  for (size_t axis = 0; axis < 3; ++axis) {
    const float* lower = bounds.lower[axis];
    const float* upper = bounds.upper[axis];
    if (!(lower[pair.a] <= upper[pair.b] && lower[pair.b] <= upper[pair.a])) return false;
  }
  return true;
}

inline bool has_box(const BoundsView& bounds, uint32_t body) {
  return bounds.lower[0][body] <= bounds.upper[0][body];
}

// Checks the pairs of a step: a body without a box is a half-space.
struct PresentBounds {
  BoundsView boxes;  // grown by the distances, if there are any
  const HalfspaceStage& halfspaces;
  ContactDistances distances = {};

  bool meet(Pair pair) const {
    if (!has_box(boxes, pair.a)) return reaches(pair.a, pair.b);
    if (!has_box(boxes, pair.b)) return reaches(pair.b, pair.a);
    return boxes_meet(boxes, pair);
  }

 private:
  bool reaches(uint32_t halfspace, uint32_t other) const {
    const float growth = distances.any() ? distances.growth(halfspace) : 0;
    return halfspaces.reaches(halfspace, boxes, other, growth);
  }
};

}  // namespace carom
