// Decisions about boxes along the world axes, against those in exact numbers.
#include "narrowphase/proof/upright_boxes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "narrowphase/proof/exact_overlap.h"
#include "oracle/random.h"
#include "tests/support/rounds.h"
#include "tests/support/stated.h"

namespace carom::test {
namespace {

// All orientations whose components are zero or equal but for signs.
std::vector<Eigen::Quaternionf> even_orientations(float size) {
  std::vector<Eigen::Quaternionf> all;
  for (int k = 0; k < 81; ++k) {
    const auto digit = [k](int place) { return static_cast<float>(k / place % 3 - 1); };
    all.emplace_back(size * digit(1), size * digit(3), size * digit(9), size * digit(27));
  }
  return all;
}

size_t nonzero_count(const Eigen::Quaternionf& q) {
  return static_cast<size_t>((q.coeffs().array() != 0).count());
}

StatedBody body_at(const Shape& shape, const Eigen::Vector3d& position,
                   const Eigen::Quaternionf& q) {
  return test::stated_body(shape, Pose{position, q});
}

// A box with different half axes in units of `unit`.
Box box_of(oracle::Random& random, float unit) {
  const auto half = [&] { return unit * static_cast<float>(random.below(4)); };
  return Box{{half(), half(), half()}};
}

double nudged(double x, oracle::Random& random) {
  if (random.chance(0.7)) return x;
  return std::nextafter(x, random.chance(0.5) ? HUGE_VAL : -HUGE_VAL);
}

TEST(UprightBoxes, AreThoseOfQuarterTurns) {
  const StatedBody other = body_at(Box{{1, 1, 1}}, {0, 0, 0}, Eigen::Quaternionf::Identity());
  for (const float size : {1.0f, 0.70710677f, 0x1p-100f, 3e30f}) {
    size_t upright = 0;
    for (const Eigen::Quaternionf& q : even_orientations(size)) {
      if (nonzero_count(q) == 0) continue;
      const bool is_upright =
          upright_boxes_overlap(body_at(Box{{1, 2, 3}}, {0, 0, 0}, q), other).has_value();
      EXPECT_EQ(is_upright, nonzero_count(q) != 3) << q.coeffs().transpose();
      upright += is_upright;
    }
    EXPECT_EQ(upright, 48u);  // 24 rotations, each by two quaternions
  }
  const Eigen::Quaternionf hardly(1, 0x1p-20f, 0, 0);
  const Eigen::Quaternionf nearly(0.70710677f, 0.7071067f, 0, 0);
  for (const Eigen::Quaternionf& q : {hardly, nearly}) {
    EXPECT_FALSE(upright_boxes_overlap(body_at(Box{{1, 2, 3}}, {0, 0, 0}, q), other));
    EXPECT_FALSE(upright_boxes_overlap(other, body_at(Box{{1, 2, 3}}, {0, 0, 0}, q)));
  }
  EXPECT_FALSE(
      upright_boxes_overlap(body_at(Sphere{1}, {0, 0, 0}, Eigen::Quaternionf::Identity()), other));
}

TEST(UprightBoxes, AreDecidedAsInExactNumbers) {
  oracle::Random random(11);
  size_t overlaps = 0, count = 0;
  for (const double unit : {1.0, 0.1, 0x1p-100, 1e30}) {
    const auto size = static_cast<float>(unit);
    std::vector<Eigen::Quaternionf> turns;
    for (const Eigen::Quaternionf& q : even_orientations(0.5f)) {
      if (nonzero_count(q) != 0 && nonzero_count(q) != 3) turns.push_back(q);
    }
    for (const double origin : {0.0, 1.0, 1e9, 1e300}) {
      for (size_t i = 0; i < rounds(400); ++i) {
        Eigen::Vector3d at_a, at_b;
        for (int axis = 0; axis < 3; ++axis) {
          at_a[axis] = origin * unit + double{size} * static_cast<double>(random.below(4));
          at_b[axis] =
              nudged(at_a[axis] + double{size} * static_cast<double>(random.below(5)), random);
        }
        const StatedBody a = body_at(box_of(random, size), at_a, turns[random.below(turns.size())]);
        Box extent = box_of(random, size);
        const bool is_aabb = random.chance(0.3);
        const Shape shape = is_aabb ? Shape(Aabb{-extent.half, extent.half}) : Shape(extent);
        const Eigen::Quaternionf q =
            is_aabb ? Eigen::Quaternionf::Identity() : turns[random.below(turns.size())];
        const StatedBody b = body_at(shape, at_b, q);
        const bool expected = exact_overlap(a, b);
        ASSERT_EQ(upright_boxes_overlap(a, b), expected);
        ASSERT_EQ(upright_boxes_overlap(b, a), expected);
        overlaps += expected;
        ++count;
      }
    }
  }
  EXPECT_GT(overlaps, count / 5);
  EXPECT_LT(overlaps, count * 4 / 5);
}

// The sum of position and half axis rounds to where the other box begins.
TEST(UprightBoxes, SeeGapsBelowRounding) {
  const Eigen::Quaternionf none = Eigen::Quaternionf::Identity();
  const StatedBody a = body_at(Box{{1, 1, 1}}, {0x1p60, 0, 0}, none);
  const StatedBody near = body_at(Box{{1, 1, 1}}, {std::nextafter(0x1p60, HUGE_VAL), 0, 0}, none);
  EXPECT_EQ(upright_boxes_overlap(a, near), false);
  const StatedBody origin = body_at(Box{{1, 1, 1}}, {0, 0, 0}, none);
  EXPECT_EQ(upright_boxes_overlap(origin, body_at(Box{{1, 1, 1}}, {2, 2, 2}, none)), true);
  const double beyond = std::nextafter(2.0, 3.0);
  EXPECT_EQ(upright_boxes_overlap(origin, body_at(Box{{1, 1, 1}}, {2, beyond, 2}, none)), false);
  const StatedBody tiny = body_at(Box{{0x1p-149f, 1, 1}}, {2, 0, 0}, none);
  EXPECT_EQ(upright_boxes_overlap(body_at(Box{{1, 1, 1}}, {0, 0, 0}, none), tiny), false);
}

}  // namespace
}  // namespace carom::test
