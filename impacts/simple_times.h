// Times of impact of pairs of simple shapes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "carom/results/contact.h"
#include "carom/results/pair.h"
#include "carom/results/sweep.h"
#include "carom/shapes/views.h"
#include "shapes/turn.h"

namespace carom {

// Bodies with their motions.
struct MovingSide {
  const Collidables& bodies;
  SweepView sweep;
  const Double3* arm = nullptr;        // per body: from its pivot to its position; nullptr: zero
  std::optional<bool> one_sided = {};  // of the triangles of meshes; without it, as they are made
};

// Times in double precision, before they are rounded to float.
struct TimeColumns {
  double* time;     // infinite: never; NaN: no answer
  uint8_t* status;  // Status
};

// Groups of rows, if the caller needs only the first time of each group.
struct GroupsOfRows {
  const uint16_t* group;  // of each row
  double* latest;         // of each group; a time after it may be never; lowered by times of rows
};

// Row i is the pair a[pairs[i].a], b[pairs[i].b]. No body may be composite.
void find_simple_times(const MovingSide& a, const MovingSide& b, const Pair* pairs, size_t count,
                       const TimeColumns& out, const GroupsOfRows* groups = nullptr);

}  // namespace carom
