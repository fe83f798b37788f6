// A shape with a model that a test knows.
#pragma once

#include <memory>
#include <vector>

#include "carom/hulls/build_hull.h"
#include "carom/shapes/rungs.h"

namespace carom::test {

// A cube from -1 to 1, with a ball as model.
inline Hull cube_with_ball(float radius = 1.25f, double error = 0.5) {
  Hull cube;
  std::vector<Eigen::Vector3f> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back(i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f);
  }
  cube.geometry = build_hull(corners)->geometry;
  const Capsule ball{{0, 0, 0}, {0, 0, 0}, radius};
  cube.ladder = std::make_shared<const Ladder>(Ladder{{{ball, error}}});
  return cube;
}

}  // namespace carom::test
