// The quality of the random pairs in other tests: hits and misses are balanced, and every case that
// a kernel distinguishes occurs.
#include <gtest/gtest.h>

#include <map>

#include "tests/support/families.h"

namespace carom::test {
namespace {

TEST(Coverage, HitsAndMissesAreBalanced) {
  for (const Family& family : families()) {
    const bool coincide = family.placement == Placement::coincident;
    if (coincide || family.degenerate || family.placement == Placement::lattice) continue;
    if (std::string(family.name) == "at 1e9") continue;  // float32 steps are 64 m there
    const bool touch = family.placement == Placement::near_touch;
    for (const Sides sides : kAllSides) {
      for (const PositionType positions : kPositionTypes) {
        int hits = 0;
        constexpr int kPairs = 2000;
        for (const TestPair& pair : make_pairs(family, sides, positions, kPairs)) {
          hits += reference_result(pair, positions).overlap;
        }
        SCOPED_TRACE(std::string(family.name) + ", " + name(sides) + ", " + name(positions));
        EXPECT_GT(hits, kPairs * (touch ? 0.2 : 0.3));
        EXPECT_LT(hits, kPairs * (touch ? 0.8 : 0.7));
      }
    }
  }
}

// In which of the 27 regions between a box's planes a point lies: -1, 0 or 1 for each axis.
std::array<int, 3> region(const Eigen::Vector3d& point, const Aabb& box) {
  std::array<int, 3> sides;
  for (int i = 0; i < 3; ++i)
    sides[i] = point[i] > box.upper[i] ? 1 : point[i] < box.lower[i] ? -1 : 0;
  return sides;
}

TEST(Coverage, AllRegionsOfASphereAndABox) {
  std::map<std::array<int, 3>, int> regions;
  std::map<std::array<float, 3>, int> ways_out;
  for (const TestPair& pair :
       make_pairs({.name = ""}, Sides::sphere_aabb, PositionType::float32, 3000)) {
    const auto where = region(pair.a.position - pair.b.position, std::get<Aabb>(pair.b.shape));
    ++regions[where];
    if (where == std::array{0, 0, 0}) {
      const Eigen::Vector3f n = reference_result(pair, PositionType::float32).normal;
      ++ways_out[{n[0], n[1], n[2]}];
    }
  }
  EXPECT_EQ(regions.size(), 27u);  // inside, 6 faces, 12 edges, 8 corners
  EXPECT_EQ(ways_out.size(), 6u);
  for (const auto& [where, count] : regions) EXPECT_GE(count, 20);
  for (const auto& [normal, count] : ways_out) EXPECT_GE(count, 20);
}

TEST(Coverage, AllRegionsOfTwoBoxes) {
  std::map<std::array<int, 3>, int> separate;
  std::map<std::array<float, 3>, int> overlapping;
  for (const TestPair& pair :
       make_pairs({.name = ""}, Sides::aabb_aabb, PositionType::float32, 6000)) {
    const reference::PairResult result = reference_result(pair, PositionType::float32);
    const Eigen::Vector3f n = result.normal;
    if (result.overlap) {
      ++overlapping[{n[0], n[1], n[2]}];
    } else {
      const auto sign = [](float x) { return (x > 0) - (x < 0); };
      ++separate[{sign(n[0]), sign(n[1]), sign(n[2])}];
    }
  }
  EXPECT_EQ(separate.size(), 26u);
  EXPECT_EQ(overlapping.size(), 6u);
  for (const auto& [where, count] : separate) EXPECT_GE(count, 10);
  for (const auto& [normal, count] : overlapping) EXPECT_GE(count, 20);
}

TEST(Coverage, CoincidentAndExactlyTouching) {
  int degenerate = 0;
  int touching = 0;
  int centre_on_surface = 0;
  for (const Sides sides : kAllSides) {
    for (const TestPair& pair :
         make_pairs({.name = "", .smallest = 1, .placement = Placement::lattice}, sides,
                    PositionType::float32, 3000)) {
      const reference::PairResult result = reference_result(pair, PositionType::float32);
      degenerate += result.status == Status::degenerate;
      touching += result.separation == 0;
      const auto* sphere = std::get_if<Sphere>(&pair.a.shape);
      centre_on_surface += sphere && sphere->radius > 0 && result.separation == -sphere->radius;
    }
  }
  EXPECT_GE(degenerate, 10);
  EXPECT_GE(touching, 100);
  EXPECT_GE(centre_on_surface, 50);
}

}  // namespace
}  // namespace carom::test
