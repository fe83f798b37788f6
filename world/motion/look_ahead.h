// The inputs of the stages that look ahead.
#pragma once

#include "carom/world/world.h"
#include "world/motion/present_bounds.h"
#include "world/motion/sweeps.h"
#include "world/pairs/pair_history.h"
#include "world/store/body_store.h"

namespace carom {

struct LookAhead {
  const WorldSettings& settings;
  const BodyStore& bodies;
  const Collidables& shapes;  // the shapes of the bodies, as tests read them
  const Sweeps& sweeps;
  const BoundsView& swept_bounds;
  const PairHistory& now;

  // False for a pair that is in the step only because of a margin.
  bool may_meet(Pair pair) const {
    if (!sweeps.is_finite(pair.a) || !sweeps.is_finite(pair.b)) return false;
    const bool are_boxes = has_box(swept_bounds, pair.a) && has_box(swept_bounds, pair.b);
    return !are_boxes || boxes_meet(swept_bounds, pair);
  }

  bool is_continuous(Pair pair) const {
    return sweeps.is_continuous(pair.a) || sweeps.is_continuous(pair.b);
  }

  bool has_sensor(Pair pair) const { return bodies.is_sensor(pair.a) || bodies.is_sensor(pair.b); }

  bool has_parts() const { return bodies.has_composites(); }
};

}  // namespace carom
