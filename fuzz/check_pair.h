// Checks that hold for the result of any two bodies, with the comparisons of the tests.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "tests/support/composites.h"
#include "tests/support/textbook.h"

namespace carom::fuzz {

using test::TestPair;

// GoogleTest has printed the failure; a fuzzer only notices that the program ends.
inline void abort_on_failure() {
  if (testing::Test::HasFailure()) std::abort();
}

// Expects the bits of the reference on every instruction set at every detail.
inline void expect_everywhere(const TestPair& pair, PositionType positions,
                              const reference::PairResult& result) {
  test::Call call = test::call_with(positions);
  call.frame = WitnessFrame::body;
  test::for_each_isa([&] {
    for (const Detail detail : {Detail::overlap, Detail::contact, Detail::manifold}) {
      call.detail = detail;
      const test::Row row = test::row_of(result, pair, positions, detail, call.frame);
      EXPECT_TRUE(test::same_rows({&row, 1}, test::run_rows({&pair, 1}, call), {&pair, 1}));
    }
    const std::vector<test::SubShapes> sub_shapes = {{result.sub_a, result.sub_b}};
    EXPECT_EQ(sub_shapes, test::run_sub_shapes({&pair, 1}, call));
  });
}

inline bool has_nan(const Eigen::Vector3f& v) { return v.array().isNaN().any(); }

// Expects numbers in all fields, except for bodies that cannot meet: their separation is infinite.
inline void expect_numbers(const TestPair& pair, const reference::PairResult& result) {
  EXPECT_EQ(result.overlap, result.separation <= 0);
  EXPECT_EQ(result.overlap, result.manifold_count > 0);
  EXPECT_LE(result.manifold_count, 4);
  if (result.separation == std::numeric_limits<float>::infinity()) return;
  EXPECT_FALSE(std::isnan(result.separation));
  EXPECT_NEAR(result.normal.cast<double>().norm(), 1, 4 * 0x1p-23);
  EXPECT_FALSE(has_nan(result.arm_a) || has_nan(result.arm_b));
  const double size = test::bounding_radius(pair.a.shape) + test::bounding_radius(pair.b.shape);
  for (size_t i = 0; i < result.manifold_count; ++i) {
    EXPECT_FALSE(has_nan(Eigen::Vector3f(result.manifold.point[i].data())));
    EXPECT_GE(result.manifold.separation[i], result.separation - 2e-6 * size);
  }
}

}  // namespace carom::fuzz
