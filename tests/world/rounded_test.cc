// Bodies of a world with a rounding.
#include <gtest/gtest.h>

#include "carom/world/world.h"
#include "oracle/hull_faces.h"

namespace carom::test {
namespace {

Box box(float half, float rounding) { return {Eigen::Vector3f::Constant(half), rounding}; }

Hull cube(float half, float rounding) {
  std::vector<Eigen::Vector3f> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half);
  }
  Hull hull = oracle::hull_of(corners);
  hull.rounding = rounding;
  return hull;
}

TEST(RoundedBodies, KeepTheirRounding) {
  World world;
  const BodyId a = world.add({.shape = box(1, 0.25f)});
  const BodyId b = world.add({.shape = cube(1, 0.25f), .position = {2.375, 0, 0}});
  EXPECT_EQ(std::get<Box>(world.shape(a)).rounding, 0.25f);
  EXPECT_EQ(std::get<Hull>(world.shape(b)).rounding, 0.25f);
  world.step();
  ASSERT_EQ(world.contacts().size(), 1u);
  EXPECT_NEAR(world.contacts()[0].separation, -0.125, 1e-6);
  world.set_shape(b, cube(1, 0));
  world.step();
  ASSERT_EQ(world.contacts().size(), 0u);
  world.set_shape(b, cube(1, 0.5f));
  world.step();
  ASSERT_EQ(world.contacts().size(), 1u);
  EXPECT_NEAR(world.contacts()[0].separation, -0.375, 1e-6);
  world.set_shape(a, box(1, -1));
  world.step();
  EXPECT_EQ(world.contacts().size(), 0u) << "a body that is not valid";
}

}  // namespace
}  // namespace carom::test
