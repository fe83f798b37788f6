// Manifolds of pairs within a contact distance, of every two kinds: bits against the reference on
// every ISA, and what their points are.
#include <gtest/gtest.h>

#include "tests/support/isas.h"
#include "tests/support/kind_pairs.h"
#include "tests/support/rounds.h"
#include "tests/support/run.h"

namespace carom::test {
namespace {

using Eigen::Vector3d;

std::vector<reference::PairResult> results_of(std::span<const TestPair> pairs,
                                              PositionType positions, float distance) {
  std::vector<reference::PairResult> results;
  for (const TestPair& pair : pairs) {
    results.push_back(reference::collide(pair.a.shape, pair.a.pose(), pair.b.shape, pair.b.pose(),
                                         positions, distance));
  }
  return results;
}

bool is_near(const reference::PairResult& result, float distance) {
  return !result.overlap && result.separation <= distance;
}

class DistanceManifolds : public testing::TestWithParam<ConvexFamily> {};

TEST_P(DistanceManifolds, EqualTheReference) {
  for (const KindPair& kinds : supported_kind_pairs()) {
    for (const PositionType positions : kPositionTypes) {
      SCOPED_TRACE(name(kinds) + ", " + name(positions));
      std::vector<TestPair> pairs =
          make_kind_pairs(GetParam(), kinds, positions, rounds_of_pairs(40));
      vary_triangles(pairs);
      for (const float distance : {0.01f, 1.0f, 1e20f}) {
        const auto results = results_of(pairs, positions, distance);
        for (const Measured measured : {Measured::all, Measured::overlapping}) {
          Call call = call_with(positions);
          call.detail = Detail::manifold;
          call.frame = WitnessFrame::body;
          call.contact_distance = distance;
          call.measured = measured;
          const std::vector<Row> expected =
              rows_of(results, pairs, positions, call.detail, call.frame);
          for_each_isa([&] {
            std::vector<Row> rows = run_rows(pairs, call);
            // The points of pairs without contact may be anything if not all pairs are measured.
            for (Row& row : rows) {
              if (measured != Measured::all && row.manifold_count == 0) row.manifold = {};
            }
            EXPECT_TRUE(same_rows(expected, rows, pairs));
          });
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Families, DistanceManifolds, testing::ValuesIn(convex_families()),
                         family_name);

// Along the contact's normal, from a point on A to B: how far B is there, by definition at most the
// distance, and at least the separation.
TEST(DistanceManifolds, PointsAreWithinTheDistance) {
  size_t near = 0, wide = 0;
  const ConvexFamily family = convex_families()[0];
  for (const KindPair& kinds : supported_kind_pairs()) {
    const std::vector<TestPair> pairs =
        make_kind_pairs(family, kinds, PositionType::float64, rounds(200));
    for (const reference::PairResult& result : results_of(pairs, PositionType::float64, 0.25f)) {
      if (!is_near(result, 0.25f)) continue;
      ++near;
      ASSERT_GE(result.manifold_count, 1);
      wide += result.manifold_count > 1;
      for (size_t k = 0; k < result.manifold_count; ++k) {
        EXPECT_GE(result.manifold.separation[k], result.separation);
        EXPECT_LE(result.manifold.separation[k], 0.25f);
      }
    }
  }
  EXPECT_GT(near, rounds(500));
  EXPECT_GT(wide, rounds(50));
}

// Bodies that touch keep their manifold when they move apart along the normal, up to rounding: each
// point then is that much further from B.
TEST(DistanceManifolds, StayWhenBodiesMoveApart) {
  constexpr float kGap = 0x1p-8f;
  size_t compared = 0;
  for (const double yaw : {0.0, 0.1, 0.7}) {
    const Eigen::Quaternionf turn(
        Eigen::AngleAxisf(static_cast<float>(yaw), Eigen::Vector3f::UnitZ()));
    const auto manifold = [&](double height) {
      return reference::collide(Box{{1, 1, 0.5f}}, {}, Box{{1, 1, 0.5f}},
                                {{0.25, 0.125, height}, turn}, PositionType::float64, 0.5f);
    };
    const reference::PairResult low = manifold(1 - kGap), high = manifold(1 + kGap);
    ASSERT_TRUE(low.overlap);
    ASSERT_FALSE(high.overlap);
    ASSERT_EQ(low.manifold_count, high.manifold_count);
    for (size_t k = 0; k < low.manifold_count; ++k) {
      EXPECT_NEAR(high.manifold.separation[k] - low.manifold.separation[k], 2 * kGap, 1e-6);
      for (size_t axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(low.manifold.point[k][axis], high.manifold.point[k][axis], 1e-5);
      }
      ++compared;
    }
  }
  EXPECT_GE(compared, 12u);
}

TEST(DistanceManifolds, DistancesThatAreNoDistancesAreErrors) {
  const TestPair pair{sphere(0, 0, 0, 1), sphere(1, 0, 0, 1)};
  const LaidOut a(side_a({&pair, 1}), {}), b(side_b({&pair, 1}), {});
  uint8_t overlap = 77;
  for (const float distance : {-1.0f, NAN, INFINITY, -INFINITY}) {
    const Result<void> each = collide_rows(a.view(), b.view(), Detail::overlap,
                                           {.overlap = &overlap}, {.contact_distances = &distance});
    EXPECT_FALSE(each);
    const Result<void> all = collide_rows(a.view(), b.view(), Detail::overlap,
                                          {.overlap = &overlap}, {.contact_distance = distance});
    ASSERT_FALSE(all);
    EXPECT_EQ(all.error().message, "a contact distance is not a finite number >= 0");
    EXPECT_EQ(overlap, 77);
  }
}

}  // namespace
}  // namespace carom::test
