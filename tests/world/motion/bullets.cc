#include "tests/world/motion/bullets.h"

namespace carom::test {

BodyDesc wall(double x) {
  return {.shape = Box{{0.001f, 5, 5}}, .position = {x, 0, 0}, .motion = Motion::fixed};
}

BodyDesc bullet(float speed, Detection detection) {
  return {.shape = Sphere{0.01f}, .linear_velocity = {speed, 0, 0}, .detection = detection};
}

std::vector<Pair> pairs_of(std::span<const Impact> impacts) {
  std::vector<Pair> pairs;
  for (const Impact& impact : impacts) pairs.push_back({impact.a, impact.b});
  return pairs;
}

std::vector<Pair> step(World& world) {
  world.step();
  EXPECT_EQ(world.report().impacts, world.impacts().size());
  return pairs_of(world.impacts());
}

}  // namespace carom::test
