// The poses of pairs whose depths are searched together: in lanes the same bits as one by one.
#include <gtest/gtest.h>

#include <cstring>

#include "narrowphase/hulls/deep_frames_scalar.h"
#include "narrowphase/hulls/hull_steps.h"
#include "oracle/random.h"
#include "tests/support/isas.h"

namespace carom::test {
namespace {

using oracle::Random;

// Counts around the lanes of all targets.
constexpr size_t kFrameCounts[] = {0, 1, 3, 4, 5, 7, 8, 9, 15, kMostDeepPairs};

TEST(DeepFrames, AreThoseOfTheReferenceOnEveryIsa) {
  for_each_isa([] {
    Random random(6);
    const auto draw = [&](auto& columns) {
      for (auto& column : columns) {
        for (float& x : column) x = static_cast<float>(random.uniform(-1, 1));
      }
    };
    for (const size_t count : kFrameCounts) {
      SCOPED_TRACE(count);
      DeepFrames expected{};
      expected.count = count;
      for (auto* vectors : {&expected.d, &expected.middle_a, &expected.middle_b, &expected.normal,
                            &expected.arm_a}) {
        draw(*vectors);
      }
      draw(expected.turn_a);
      draw(expected.turn_b);
      DeepFrames found = expected;
      const auto expect_same = [&](const auto& columns, const auto& columns_in_lanes) {
        for (size_t axis = 0; axis < 3; ++axis) {
          const auto &column = columns[axis], &in_lanes = columns_in_lanes[axis];
          EXPECT_EQ(std::memcmp(column.data(), in_lanes.data(), count * sizeof(float)), 0);
        }
      };
      scalar::set_up_frames(expected);
      hull_steps_in_lanes().set_up(found);
      for (size_t axis = 0; axis < 3; ++axis) {
        expect_same(expected.to_world[axis], found.to_world[axis]);
        expect_same(expected.b_to_a[axis], found.b_to_a[axis]);
      }
      expect_same(expected.b_from_a, found.b_from_a);
      expect_same(expected.a_from_b, found.a_from_b);
      expect_same(expected.middle_a_in_b, found.middle_a_in_b);
      expect_same(expected.middle_b_in_a, found.middle_b_in_a);
      scalar::finish_frames(expected);
      hull_steps_in_lanes().finish(found);
      expect_same(expected.normal, found.normal);
      expect_same(expected.arm_a, found.arm_a);
      expect_same(expected.arm_b, found.arm_b);
    }
  });
}

}  // namespace
}  // namespace carom::test
