// Properties of every pair, for inputs that RapidCheck chooses and shrinks.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>

#include "tests/support/families.h"
#include "tests/support/isas.h"
#include "tests/support/run.h"

namespace carom::test {
namespace {

// A body from six numbers.
PlacedShape body_of(bool is_box, const std::array<float, 6>& numbers) {
  const Eigen::Vector3d position(numbers[0], numbers[1], numbers[2]);
  if (!is_box) return {Sphere{std::fabs(numbers[3])}, position};
  const Eigen::Vector3f half(std::fabs(numbers[3]), std::fabs(numbers[4]), std::fabs(numbers[5]));
  return {Aabb::from_half_extents(half), position};
}

using Numbers = std::array<int16_t, 12>;

// Numbers are multiples of 1/16, so that touching, flush and concentric shapes are common.
TestPair pair_of(bool box_a, bool box_b, const Numbers& numbers) {
  std::array<float, 6> a;
  std::array<float, 6> b;
  for (int i = 0; i < 6; ++i) {
    a[i] = static_cast<float>(numbers[i] % 128) / 16;
    b[i] = static_cast<float>(numbers[6 + i] % 128) / 16;
  }
  return {body_of(box_a, a), body_of(box_b, b)};
}

RC_GTEST_PROP(Properties, AnyBitsGiveTheBitsOfTheReference,
              (bool box_a, bool box_b, const std::array<uint32_t, 12>& bits)) {
  std::array<float, 6> a;
  std::array<float, 6> b;
  for (int i = 0; i < 6; ++i) {
    a[i] = std::bit_cast<float>(bits[i]);
    b[i] = std::bit_cast<float>(bits[6 + i]);
  }
  const TestPair pair{body_of(box_a, a), body_of(box_b, b)};
  for (const PositionType positions : kPositionTypes) {
    const std::vector<Row> expected = expected_rows({&pair, 1}, positions);
    for (const Isa isa : usable_isas()) {
      const ForcedIsa forced(isa);
      RC_ASSERT(same_rows(expected, run_rows({&pair, 1}, call_with(positions)), {&pair, 1}));
    }
  }
}

// The convention of contacts: moving B by -separation * normal makes the two touch.
RC_GTEST_PROP(Properties, MovingBMakesThemTouch, (bool box_a, bool box_b, const Numbers& numbers)) {
  TestPair pair = pair_of(box_a, box_b, numbers);
  const auto before = reference_result(pair, PositionType::float64);
  pair.b.position -= static_cast<double>(before.separation) * before.normal.cast<double>();
  const auto after = reference_result(pair, PositionType::float64);
  RC_ASSERT(std::fabs(after.separation) <= 1e-5);
}

// (position_b + arm_b) - (position_a + arm_a) = separation * normal.
RC_GTEST_PROP(Properties, SeparationAlongTheNormalLeadsFromWitnessToWitness,
              (bool box_a, bool box_b, const Numbers& numbers)) {
  const TestPair pair = pair_of(box_a, box_b, numbers);
  const auto result = reference_result(pair, PositionType::float32);
  const Eigen::Vector3d way =
      pair.b.position + result.arm_b.cast<double>() - pair.a.position - result.arm_a.cast<double>();
  const Eigen::Vector3d expected = result.separation * result.normal.cast<double>();
  RC_ASSERT((way - expected).norm() <= 1e-5);
}

// Scaling by a power of two is exact, so the result scales exactly.
RC_GTEST_PROP(Properties, ScalingByAPowerOfTwoScalesTheResult,
              (bool box_a, bool box_b, const Numbers& numbers, uint8_t power)) {
  const float scale = std::ldexp(1.0f, power % 128 - 64);
  const TestPair pair = pair_of(box_a, box_b, numbers);
  TestPair scaled = pair;
  for (PlacedShape* body : {&scaled.a, &scaled.b}) {
    body->position *= scale;
    if (auto* sphere = std::get_if<Sphere>(&body->shape)) {
      sphere->radius *= scale;
    } else {
      std::get<Aabb>(body->shape).lower *= scale;
      std::get<Aabb>(body->shape).upper *= scale;
    }
  }
  const auto result = reference_result(pair, PositionType::float32);
  const auto other = reference_result(scaled, PositionType::float32);
  RC_ASSERT(other.overlap == result.overlap);
  RC_ASSERT(other.separation == result.separation * scale);
  RC_ASSERT(other.normal == result.normal);
  RC_ASSERT(other.arm_a == Eigen::Vector3f(result.arm_a * scale));
  RC_ASSERT(other.arm_b == Eigen::Vector3f(result.arm_b * scale));
}

// Growing a sphere lowers the separation by the growth.
RC_GTEST_PROP(Properties, GrowingASphereLowersTheSeparation, (bool box_b, const Numbers& numbers)) {
  TestPair pair = pair_of(false, box_b, numbers);
  const float before = reference_result(pair, PositionType::float32).separation;
  std::get<Sphere>(pair.a.shape).radius += 0.5f;
  const float after = reference_result(pair, PositionType::float32).separation;
  RC_ASSERT(after < before);
  RC_ASSERT(std::fabs(before - after - 0.5f) <= 1e-5f);
}

}  // namespace
}  // namespace carom::test
