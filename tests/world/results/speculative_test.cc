// Speculative contacts of swept bodies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/composites.h"
#include "tests/world/crowds.h"

namespace carom::test {
namespace {

using Eigen::Vector3f;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr WorldSettings kSecond{.dt = 1};

struct Two {
  explicit Two(const BodyDesc& a, const BodyDesc& b, const WorldSettings& settings = kSecond)
      : world(settings) {
    world.add(a);
    world.add(b);
    world.step();
  }
  std::span<const Contact> speculative() const { return world.speculative_contacts(); }

  World world;
};

BodyDesc ball(double x, float speed, Detection detection = Detection::swept) {
  return {.shape = Sphere{0.5f},
          .position = {x, 0, 0},
          .linear_velocity = {speed, 0, 0},
          .detection = detection};
}

TEST(Speculative, ContactsThatCloseInTime) {
  const Two two(ball(0, 3), ball(3, -1, Detection::discrete));
  ASSERT_THAT(two.speculative(), SizeIs(1));
  const Contact& contact = two.speculative()[0];
  EXPECT_EQ(contact.a, 0u);
  EXPECT_EQ(contact.b, 1u);
  EXPECT_EQ(contact.separation, 2);
  EXPECT_EQ(contact.normal, Vector3f(1, 0, 0));
  EXPECT_EQ(contact.normal_velocity, -4);
  EXPECT_EQ(contact.arm_a, Vector3f(0.5f, 0, 0));
  EXPECT_EQ(contact.arm_b, Vector3f(-0.5f, 0, 0));
  EXPECT_EQ(contact.manifold_count, 0);
  EXPECT_EQ(two.world.report().speculative, 1u);
  EXPECT_THAT(two.world.contacts(), IsEmpty());
  EXPECT_THAT(two.world.events(), IsEmpty());
  EXPECT_THAT(two.world.impacts(), IsEmpty());
  EXPECT_EQ(two.world.report().overlaps, 0u);
}

TEST(Speculative, OnlyThose) {
  const auto there = [](const BodyDesc& a, const BodyDesc& b,
                        const WorldSettings& settings = kSecond) {
    return Two(a, b, settings).speculative().size();
  };
  EXPECT_EQ(there(ball(0, 2), ball(3, 0)), 1u) << "just";
  EXPECT_EQ(there(ball(0, 1.9f), ball(3, 0)), 0u) << "too slow";
  EXPECT_EQ(there(ball(0, 2), ball(3, 0), {.dt = 0.9}), 0u);
  EXPECT_EQ(there(ball(0, 2), ball(3, 0), {.dt = 0}), 0u);
  EXPECT_EQ(there(ball(0, 5), ball(3, 5)), 0u) << "side by side";
  EXPECT_EQ(there(ball(0, 5), ball(0.5, 0)), 0u) << "a contact already";
  EXPECT_EQ(there(ball(0, 5), ball(3, 0, Detection::continuous)), 0u) << "an impact";
  EXPECT_EQ(there(ball(0, 5, Detection::discrete), ball(3, 0, Detection::discrete)), 0u);
  BodyDesc sensor = ball(3, 0);
  sensor.sensor = true;
  EXPECT_EQ(there(ball(0, 5), sensor), 0u);
  EXPECT_EQ(there(ball(0, NAN), ball(3, 0)), 0u);
  EXPECT_EQ(there(ball(0, 5), ball(3, 0), {.detail = Detail::overlap, .dt = 1}), 0u);
  EXPECT_EQ(there(ball(0, 5), ball(3, 0), {.detail = Detail::manifold, .dt = 1}), 1u);
}

// A rod above the floor tips over.
TEST(Speculative, WhatTurnsClosesGapsToo) {
  const BodyDesc floor = {.shape = Halfspace{{0, 0, 1}, 0}, .motion = Motion::fixed};
  BodyDesc rod = {.shape = Capsule{{-2, 0, 0}, {2, 0, -0.25f}, 0.25f},
                  .position = {0, 0, 1},
                  .detection = Detection::swept};
  EXPECT_THAT(Two(floor, rod).speculative(), IsEmpty());
  rod.angular_velocity = {0, 0.3f, 0};
  const Two tips(floor, rod);
  ASSERT_THAT(tips.speculative(), SizeIs(1));
  EXPECT_NEAR(tips.speculative()[0].separation, 0.5, 1e-6);
  EXPECT_NEAR(tips.speculative()[0].normal_velocity, -0.6, 1e-6);
  rod.angular_velocity = {0, -0.3f, 0};
  EXPECT_THAT(Two(floor, rod).speculative(), IsEmpty()) << "the other end, which is higher";
}

TEST(Speculative, NamesThePartsThatAreNearest) {
  const Two two({.shape = flat_grid(8, 1), .motion = Motion::fixed},
                {.shape = Sphere{0.5f},
                 .position = {2.2, 1.1, 1},
                 .linear_velocity = {0, 0, -3},
                 .detection = Detection::swept});
  ASSERT_THAT(two.speculative(), SizeIs(1));
  EXPECT_GT(two.speculative()[0].sub_a, 0u);
  EXPECT_NEAR(two.speculative()[0].separation, 0.5, 1e-6);
}

}  // namespace
}  // namespace carom::test
