// Times of impact of pairs with a mesh or a compound.
#pragma once

#include <cstdint>
#include <span>

#include "impacts/impact.h"
#include "impacts/simple_times.h"

namespace carom {

// Two bodies at the start, B relative to A, with their parts if they have any.
struct PlacedBodies {
  Part part_a, part_b;
  PlacedPart a, b;

  PlacedBodies(const MovingSide& side_a, const MovingSide& side_b, Pair pair);
  PlacedBodies(const PlacedBodies&) = delete;
  PlacedBodies& operator=(const PlacedBodies&) = delete;
};

// Finds the first time of the pairs in `rows`; times[i] belongs to pairs[rows[i]].
void find_composite_times(const MovingSide& a, const MovingSide& b, const Pair* pairs,
                          std::span<const uint16_t> rows, const TimesWanted& wanted,
                          std::span<FirstTime> times);

}  // namespace carom
