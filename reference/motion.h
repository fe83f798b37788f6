// How a body moves in the interval ahead, and what it covers meanwhile.
#pragma once

#include "carom/reference/reference.h"
#include "carom/results/sweep.h"
#include "reference/pairs.h"

namespace carom::reference {

struct BodyMotion {
  Sweep sweep;                                // zero if it is not finite
  bool is_finite = true;                      // displacement and rotation are finite
  Detection detection = Detection::discrete;  // what applies in this frame; never automatic

  bool looks_ahead() const { return detection != Detection::discrete; }
  bool is_continuous() const { return detection == Detection::continuous; }
};

inline Pose pose_of(const BodyDesc& desc) { return {desc.position, desc.orientation}; }

// The body must be valid.
BodyMotion motion_of(const BodyDesc& body, const Ahead& ahead);

// A box that holds the body at all times; `now` holds it at the start.
Box box_over(const Box& now, const BodyDesc& body, const Sweep& sweep, PositionType positions);

// The half-space that holds everything the body covers during the interval; `now` is that of the
// start.
Plane plane_over(const Plane& now, const Sweep& sweep);

}  // namespace carom::reference
