// Two moving bodies, at least one of which is made of parts -> the pairs of their parts that may
// meet during the interval.
#pragma once

#include "base/parallel.h"
#include "midphase/placed_part.h"

namespace carom {

// How a whole body moves; its parts move with it.
struct BodySweep {
  Double3 displacement{}, rotation{};

  bool is_turning() const { return rotation != Double3{}; }
};

// Parts that have no parts themselves.
using PartPairMet = FunctionRef<void(const PlacedPart& a, const PlacedPart& b)>;

// All pairs of parts that come within rounding of each other, and some that do not. Both bodies are
// placed as they are at the start, in one frame.
void find_swept_part_pairs(const PlacedPart& a, const BodySweep& sweep_a, const PlacedPart& b,
                           const BodySweep& sweep_b, PartPairMet met);

}  // namespace carom
