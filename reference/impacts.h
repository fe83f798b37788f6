// What the bodies of a frame will meet.
#pragma once

#include <vector>

#include "carom/reference/reference.h"
#include "reference/motion.h"

namespace carom::reference {

// Two bodies, the lower index first, of which the bounds over the interval meet.
struct MovingPair {
  const Body& a;
  const Body& b;
  const BodyMotion& motion_a;
  const BodyMotion& motion_b;
};

// Adds what is ahead of a pair to the frame: an impact, or a speculative contact. `now` is the
// result of its test; `overlap` says whether they overlap now, which bounds may deny.
void look_ahead(const MovingPair& pair, const PairResult& now, bool overlap, PositionType positions,
                Detail detail, double dt, Frame& frame);

// Sorts the impacts, and leaves those that the setting asks for.
void settle(Impacts impacts, std::vector<carom::Impact>& all);

}  // namespace carom::reference
