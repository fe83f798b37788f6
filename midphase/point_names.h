// Names of contact points: which feature of each body a point lies on.
#pragma once

#include "carom/results/contact.h"
#include "geometries/surface_feature.h"
#include "midphase/placed_part.h"
#include "narrowphase/blocks/pair_block.h"

namespace carom {

// Two simple parts in one frame.
struct PartsInTouch {
  const PlacedPart& a;
  const PlacedPart& b;

  // The name of a point of A, relative to the position of A's body in the axes of the frame. It is
  // `separation` along the normal from B. `offset`: from the position of A's body to that of B's.
  uint64_t name_of(const Double3& point, const Double3& normal, double separation,
                   const Double3& offset) const;
};

// Fills the column of names for all rows whose bodies have no parts.
void name_simple_points(const PairBlock& block);

}  // namespace carom
