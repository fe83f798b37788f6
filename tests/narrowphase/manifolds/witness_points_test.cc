// Manifolds of one point, against one row at a time.
#include "narrowphase/manifolds/witness_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <initializer_list>
#include <vector>

#include "carom/results/result_arrays.h"
#include "oracle/random.h"
#include "tests/support/isas.h"
#include "tests/support/results.h"

namespace carom::test {
namespace {

ManifoldPoints expected_points(const ResultColumns& rows, size_t row, bool touches) {
  ManifoldPoints points{};
  if (!touches) return points;
  for (size_t axis = 0; axis < 3; ++axis) points.point[0][axis] = rows.point_a[axis][row];
  points.separation[0] = rows.separation[row];
  return points;
}

float pick(oracle::Random& random, std::initializer_list<float> special) {
  return random.chance(0.7) ? static_cast<float>(random.uniform(-1, 1))
                            : special.begin()[random.below(special.size())];
}

void fill_rows(oracle::Random& random, const ResultColumns& rows, size_t count) {
  for (size_t row = 0; row < count; ++row) {
    rows.overlap[row] = static_cast<uint8_t>(random.below(3));  // 2: undecided
    rows.separation[row] = pick(random, {0, -0.0f, 0.5f, INFINITY, -INFINITY, NAN});
    for (float* axis : rows.point_a) axis[row] = pick(random, {0, -0.0f, INFINITY, NAN});
  }
}

TEST(WitnessPoints, AreTheManifoldsOfRowsThatTouch) {
  oracle::Random random(63);
  size_t near = 0, overlapping = 0, apart = 0;
  for (const bool has_reach : {false, true}) {
    for (const size_t count : {0, 1, 2, 3, 4, 5, 7, 8, 9, 31, 4000}) {
      ResultArrays arrays(count + 1, Detail::manifold);
      const ResultColumns& rows = arrays.columns();
      fill_rows(random, rows, count);
      std::vector<float> reach(count);
      for (float& r : reach) r = pick(random, {0, -0.0f, 0.5f, INFINITY, NAN});
      Batch batch;
      batch.count = count;
      batch.out = rows;
      if (has_reach) batch.reach = reach.data();
      for_each_isa([&] {
        for (size_t row = 0; row <= count; ++row) {
          std::memset(static_cast<void*>(&rows.manifold[row]), kUntouched, sizeof(ManifoldPoints));
          rows.manifold_count[row] = kUntouched;
        }
        copy_witnesses(batch);
        for (size_t row = 0; row < count; ++row) {
          const bool is_near =
              has_reach && rows.overlap[row] == 0 && rows.separation[row] <= reach[row];
          const bool touches = rows.overlap[row] == 1 || is_near;
          const ManifoldPoints expected = expected_points(rows, row, touches);
          ASSERT_EQ(std::memcmp(&rows.manifold[row], &expected, sizeof(expected)), 0) << row;
          ASSERT_EQ(rows.manifold_count[row], touches) << row;
          near += is_near;
          overlapping += rows.overlap[row] == 1;
          apart += !touches;
        }
        // The row behind the last one.
        EXPECT_EQ(rows.manifold_count[count], kUntouched);
        for (size_t byte = 0; byte < sizeof(ManifoldPoints); ++byte) {
          EXPECT_EQ(reinterpret_cast<const uint8_t*>(&rows.manifold[count])[byte], kUntouched);
        }
      });
      ASSERT_FALSE(HasFatalFailure());
    }
  }
  EXPECT_GT(near, 200u);
  EXPECT_GT(overlapping, 500u);
  EXPECT_GT(apart, 500u);
}

}  // namespace
}  // namespace carom::test
