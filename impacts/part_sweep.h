// Finds the pairs of parts of two moving bodies that may meet during the interval. At least one of
// the bodies is composite.
#pragma once

#include "base/parallel.h"
#include "midphase/placed_part.h"

namespace carom {

// The motion of a whole body; its parts move with it.
struct BodySweep {
  Double3 displacement{}, rotation{};

  bool is_turning() const { return rotation != Double3{}; }
};

// Receives two parts that have no parts themselves.
using PartPairMet = FunctionRef<void(const PlacedPart& a, const PlacedPart& b)>;

// Reports all pairs of parts that come within rounding of each other, and some that do not. Both
// bodies are given at the start, in one frame.
void find_swept_part_pairs(const PlacedPart& a, const BodySweep& sweep_a, const PlacedPart& b,
                           const BodySweep& sweep_b, PartPairMet met);

}  // namespace carom
