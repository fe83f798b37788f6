// Impacts and speculative contacts of the bodies of a frame.
#pragma once

#include <vector>

#include "carom/reference/reference.h"
#include "reference/motion.h"

namespace carom::reference {

// Two bodies, the lower index first, whose bounds over the interval overlap.
struct MovingPair {
  const Body& a;
  const Body& b;
  const BodyMotion& motion_a;
  const BodyMotion& motion_b;
};

// Adds an impact or a speculative contact of the pair to the frame, if it has one. `now` is the
// result of its test. `overlap` says whether the bodies overlap now; it is false if their present
// bounds are separate, whatever `now` says. `near`: they are separate and have a contact.
void look_ahead(const MovingPair& pair, const PairResult& now, bool overlap, bool near,
                PositionType positions, Detail detail, double dt, Frame& frame);

// Sorts the impacts, and keeps those that the setting asks for.
void settle(Impacts impacts, std::vector<carom::Impact>& all);

}  // namespace carom::reference
