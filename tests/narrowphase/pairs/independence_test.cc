// Results do not depend on a pair's place in the list, on threads, on the order of the two bodies,
// or on their place in the world.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <numeric>

#include "tests/support/families.h"
#include "tests/support/isas.h"
#include "tests/support/run.h"

namespace carom::test {
namespace {

// Every family and all kinds in one list.
std::vector<TestPair> all_pairs(size_t count_each, PositionType positions) {
  std::vector<TestPair> pairs;
  for (const Family& family : families()) {
    for (const Sides sides : kAllSides) {
      for (const TestPair& pair : make_pairs(family, sides, positions, count_each)) {
        pairs.push_back(pair);
      }
    }
  }
  return pairs;
}

template <class T>
std::vector<T> permuted(std::span<const T> values, std::span<const size_t> order) {
  std::vector<T> result;
  for (const size_t i : order) result.push_back(values[i]);
  return result;
}

TEST(Independence, OfThePlaceInTheList) {
  Random random(7);
  for (const PositionType positions : kPositionTypes) {
    const std::vector<TestPair> pairs = all_pairs(30, positions);
    std::vector<size_t> order(pairs.size());
    std::iota(order.begin(), order.end(), 0);
    for_each_isa([&] {
      const std::vector<Row> rows = run_list(pairs, call_with(positions));
      for (int round = 0; round < 5; ++round) {
        for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
        const std::vector<TestPair> shuffled = permuted<TestPair>(pairs, order);
        EXPECT_TRUE(same_rows(permuted<Row>(rows, order), run_list(shuffled, call_with(positions)),
                              shuffled));
      }
    });
  }
}

TEST(Independence, OfTheOtherLanes) {
  const std::vector<TestPair> pairs = all_pairs(5, PositionType::float32);
  for_each_isa([&] {
    const std::vector<Row> rows = run_list(pairs, {});
    for (size_t i = 0; i < pairs.size(); ++i) {
      const std::span<const TestPair> alone(&pairs[i], 1);
      EXPECT_TRUE(same_rows(std::span(&rows[i], 1), run_rows(alone, {}), alone));
    }
  });
}

TEST(Independence, OfThreads) {
  for (const PositionType positions : kPositionTypes) {
    const std::vector<TestPair> pairs = all_pairs(200, positions);
    for_each_isa([&] {
      Call call = call_with(positions);
      const std::vector<Row> rows = run_list(pairs, call);
      call.parallelism = Parallelism::arena;
      for (const int threads : {1, 2, 4}) {
        SCOPED_TRACE(threads);
        tbb::task_arena arena(threads);
        std::vector<Row> parallel;
        arena.execute([&] { parallel = run_list(pairs, call); });
        EXPECT_TRUE(same_rows(rows, parallel, pairs));
      }
    });
  }
}

// (A, B) and (B, A) have mirrored results.
void expect_mirrored(const Row& row, const Row& other) {
  EXPECT_EQ(row.overlap, other.overlap);
  EXPECT_EQ(row.status, other.status);
  EXPECT_EQ(row.separation, other.separation);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(row.normal[k], -other.normal[k]);
    EXPECT_EQ(row.point_a[k], other.point_b[k]);
    EXPECT_EQ(row.point_b[k], other.point_a[k]);
  }
}

// Boxes are compared in the frame of the first one, so the two orders round differently; concentric
// spheres and ties have a normal by convention.
void expect_close(const TestPair& pair, const Row& row, const Row& other) {
  const double size = bounding_radius(pair.a.shape) + bounding_radius(pair.b.shape);
  const double rounding = 0x1p-22 * (size + std::fabs(row.separation)) + 0x1p-146;
  EXPECT_EQ(row.status, other.status);
  EXPECT_NEAR(row.separation, other.separation, rounding);
  EXPECT_TRUE(row.overlap == other.overlap || std::fabs(row.separation) <= rounding);
}

TEST(Independence, OfTheOrderOfTheTwo) {
  for (const PositionType positions : kPositionTypes) {
    const std::vector<TestPair> pairs = all_pairs(100, positions);
    std::vector<TestPair> others;
    for (const TestPair& pair : pairs) others.push_back(swapped(pair));
    Call call = call_with(positions);
    call.frame = WitnessFrame::body;
    for_each_isa([&] {
      const std::vector<Row> rows = run_list(pairs, call);
      const std::vector<Row> other_rows = run_list(others, call);
      for (size_t i = 0; i < pairs.size() && !testing::Test::HasFailure(); ++i) {
        const ShownIfFailed shown([&] { return show(pairs[i]); });
        const bool boxes = pairs[i].a.shape.index() == 1 && pairs[i].b.shape.index() == 1;
        const bool is_degenerate = rows[i].status == static_cast<uint8_t>(Status::degenerate);
        if (boxes || is_degenerate) {
          expect_close(pairs[i], rows[i], other_rows[i]);
        } else {
          expect_mirrored(rows[i], other_rows[i]);
        }
      }
    });
  }
}

// Multiples of 2^-10 keep their difference exactly when both positions move by a power of two. The
// whole result then stays the same, except for the rounding of world points.
TEST(Independence, OfThePlaceInTheWorld) {
  std::vector<TestPair> pairs = all_pairs(50, PositionType::float32);
  std::erase_if(pairs, [](const TestPair& pair) {
    return pair.a.position.norm() > 100 || pair.b.position.norm() > 100;
  });
  const auto to_grid = [](double x) { return std::round(x * 0x1p10) * 0x1p-10 + 0.0; };  // not -0
  for (TestPair& pair : pairs) {
    pair.a.position = pair.a.position.unaryExpr(to_grid);
    pair.b.position = pair.b.position.unaryExpr(to_grid);
  }
  for_each_isa([&] {
    for (const PositionType positions : kPositionTypes) {
      Call call = call_with(positions);
      call.frame = WitnessFrame::body;
      const std::vector<Row> rows = run_list(pairs, call);
      const double largest = positions == PositionType::float32 ? 0x1p12 : 0x1p40;
      for (double offset = 1; offset <= largest; offset *= 2) {
        std::vector<TestPair> moved = pairs;
        for (TestPair& pair : moved) {
          pair.a.position += Eigen::Vector3d(offset, -offset, offset);
          pair.b.position += Eigen::Vector3d(offset, -offset, offset);
        }
        EXPECT_TRUE(same_rows(rows, run_list(moved, call), moved));
      }
    }
  });
}

}  // namespace
}  // namespace carom::test
