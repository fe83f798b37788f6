// The gap between two cores.
#pragma once

#include "narrowphase/doubles/core.h"

namespace carom::scalar {

// The gap between the cores along a unit vector from A to B, without radii.
struct CoreGap {
  double size;
  CoreVector normal;
  bool is_flat = false;
  bool is_proven = false;  // separate, or overlapping by more than rounding
  bool has_ended = true;
  bool is_at_corners = false;  // the witness points face each other within far less than kFacing
  bool has_point = false;      // the contact location on A is known
  CoreVector of_a{};           // it, without A's radius
};

}  // namespace carom::scalar
