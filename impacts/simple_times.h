// Times of impact of pairs of simple shapes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "carom/results/contact.h"
#include "carom/results/pair.h"
#include "carom/results/sweep.h"
#include "carom/shapes/views.h"
#include "shapes/turn.h"

namespace carom {

// Bodies and how they move.
struct MovingSide {
  const Collidables& bodies;
  SweepView sweep;
  const Double3* arm = nullptr;  // one a body: from where it turns to its position; nullptr: zero
};

// In doubles, before the rounding of the answer.
struct TimeColumns {
  double* time;     // infinite: never; NaN: no answer
  uint8_t* status;  // Status
};

// Row i is the pair a[pairs[i].a], b[pairs[i].b], none of which has parts.
void find_simple_times(const MovingSide& a, const MovingSide& b, const Pair* pairs, size_t count,
                       const TimeColumns& out);

}  // namespace carom
