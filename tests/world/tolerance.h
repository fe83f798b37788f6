// Tests of Accuracy::tolerance share this.
#pragma once

#include "carom/world/world.h"

namespace carom::test {

inline WorldSettings within(float metres, WorldSettings settings = {}) {
  settings.accuracy.tolerance = metres;
  return settings;
}

// The separation of two bodies at their present poses.
double true_separation(const World& world, Pair pair);

}  // namespace carom::test
