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
inline BodyDesc wall(double x) {
  return {.shape = Box{{0.001f, 5, 5}}, .position = {x, 0, 0}, .motion = Motion::fixed};
}

// A small ball that moves along the x axis from the origin.
inline BodyDesc bullet(float speed, Detection detection = Detection::continuous) {
  return {.shape = Sphere{0.01f}, .linear_velocity = {speed, 0, 0}, .detection = detection};
}

// The pairs of the impacts, in their order.
inline std::vector<Pair> pairs_of(std::span<const Impact> impacts) {
  std::vector<Pair> pairs;
  for (const Impact& impact : impacts) pairs.push_back({impact.a, impact.b});
  return pairs;
}

inline std::vector<Pair> step(World& world) {
  world.step();
  EXPECT_EQ(world.report().impacts, world.impacts().size());
  return pairs_of(world.impacts());
}

}  // namespace carom::test
