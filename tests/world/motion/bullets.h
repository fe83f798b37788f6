// Small fast bodies, and thin walls in their path.
#pragma once

#include <gtest/gtest.h>

#include <span>
#include <vector>

#include "carom/world/world.h"

namespace carom::test {

// The interval is one second, so that velocities equal displacements.
inline constexpr WorldSettings kSecond{.dt = 1};
inline constexpr WorldSettings kAll{.dt = 1, .impacts = Impacts::all};

// A thin wall at x, across the x axis.
BodyDesc wall(double x);

// A small ball that moves along the x axis from the origin.
BodyDesc bullet(float speed, Detection detection = Detection::continuous);

// The pairs of the impacts, in their order.
std::vector<Pair> pairs_of(std::span<const Impact> impacts);

std::vector<Pair> step(World& world);

}  // namespace carom::test
