// The boxes of bodies in an index: their bounds, grown at least as grown() does.
#pragma once

#include <cstddef>
#include <cstdint>

#include "carom/bounds/bounds.h"
#include "carom/results/sweep.h"
#include "carom/shapes/views.h"
#include "trees/tree.h"

namespace carom {

// Bodies of a run as bits, the first one lowest.
struct ChangedBoxes {
  uint64_t are_there;  // take part: their bounds are not empty
  uint64_t changed;    // their box is another one now
};

inline constexpr size_t kBodiesAtOnce = 64;

// Gives boxes[i] that of body first + i, for at most kBodiesAtOnce bodies. A body that takes no
// part, or beyond the bounds, gets the box kNothing. With a sweep the boxes also grow for what the
// bodies travel; they are still those of the start. This runs for all bodies after every step, all
// in float32. The boxes are the same on every ISA.
ChangedBoxes update_grown_bounds(const Collidables& bodies, const BoundsView& bounds, size_t first,
                                 size_t count, TreeBox* boxes, const SweepView* sweep = nullptr);

}  // namespace carom
