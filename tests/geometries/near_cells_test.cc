// Gaps of cells of height fields are lower bounds, and no triangle that is near is left out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "carom/reference/reference.h"
#include "geometries/near_cells.h"
#include "tests/support/height_fields.h"

namespace carom::test {
namespace {

using Gaps = std::map<uint32_t, float>;

// The same on every ISA.
Gaps gaps_on_every_isa(const HeightFieldGeometry& field, const CellRange& window,
                       const SeenSolid& solid, const GapsWanted& wanted) {
  Gaps first;
  bool is_first = true;
  for_each_isa([&] {
    Gaps gaps;
    find_near_cells(field, window, solid, wanted, [&](const NearPoints& near) {
      for (size_t i = 0; i < near.count; ++i) {
        EXPECT_TRUE(gaps.emplace(near.triangle[i], near.gap[i]).second);
      }
    });
    if (is_first) first = gaps;
    is_first = false;
    EXPECT_EQ(first, gaps);
  });
  return first;
}

struct Case {
  std::shared_ptr<HeightFieldGeometry> field;
  CellRange window;
  SeenSolid solid;
  Shape shape;
  Pose pose;
};

Case random_case(bool is_box, oracle::Random& random) {
  const auto nx = static_cast<uint32_t>(2 + random.below(40));
  const auto ny = static_cast<uint32_t>(2 + random.below(40));
  HeightTable table = random_heights(nx, ny, random.chance(0.5) ? 0.3 : 3, 0.05, random);
  table.dx = static_cast<float>(random.uniform(0.3, 3));
  Case result{.field = geometry_of(table), .window = {}, .solid = {}, .shape = {}, .pose = {}};
  const uint32_t cells_x = nx - 1, cells_y = ny - 1;
  const auto i = static_cast<uint32_t>(random.below(cells_x));
  const auto j = static_cast<uint32_t>(random.below(cells_y));
  result.window = {i, i + 1 + static_cast<uint32_t>(random.below(std::min(cells_x - i, 12u))), j,
                   j + 1 + static_cast<uint32_t>(random.below(std::min(cells_y - j, 5u)))};
  for (double& x : result.solid.middle) x = random.uniform(-8, 8);
  result.pose.position = {result.solid.middle[0], result.solid.middle[1], result.solid.middle[2]};
  result.shape = Sphere{0};
  if (!is_box) return result;
  Composites shapes(random.below(1u << 20));
  result.pose.orientation = shapes.orientation();
  const Eigen::Matrix3d turn =
      result.pose.orientation.cast<double>().normalized().toRotationMatrix();
  Box box;
  result.solid.is_box = true;
  for (int k = 0; k < 3; ++k) {
    box.half[k] = static_cast<float>(random.uniform(0.1, 2));
    const auto axis = static_cast<size_t>(k);
    result.solid.half[axis] = box.half[k];
    result.solid.axis[axis] = {turn(0, k), turn(1, k), turn(2, k)};
  }
  result.shape = box;
  return result;
}

double separation_from(const Case& one, uint32_t triangle) {
  return reference::collide(one.shape, one.pose, Triangle{one.field->corners(triangle)}, Pose{},
                            PositionType::float64)
      .separation;
}

void expect_lower_bounds(bool is_box, uint64_t seed) {
  oracle::Random random(seed);
  for (int round = 0; round < 300; ++round) {
    const Case one = random_case(is_box, random);
    const double most = random.uniform(-0.5, 6);
    const Gaps gaps = gaps_on_every_isa(*one.field, one.window, one.solid, {most});
    const Gaps nearest = gaps_on_every_isa(*one.field, one.window, one.solid, {most, 1e-4});
    double least = HUGE_VAL;
    for (uint32_t j = one.window.first_j; j < one.window.end_j; ++j) {
      for (uint32_t i = one.window.first_i; i < one.window.end_i; ++i) {
        if (one.field->is_hole(i, j)) continue;
        for (const uint32_t k : {0u, 1u}) {
          const uint32_t triangle = 2 * (j * one.field->cells_x() + i) + k;
          const double separation = separation_from(one, triangle);
          const auto found = gaps.find(triangle);
          if (found == gaps.end()) {
            EXPECT_GT(separation, most - 1e-4);
          } else {
            EXPECT_LE(found->second, separation + 1e-4);
          }
          if (separation > most - 1e-4) continue;
          least = std::min(least, separation);
        }
      }
    }
    if (least == HUGE_VAL) continue;
    // The nearest triangle is among those that are left.
    bool has_nearest = false;
    for (const auto& [triangle, gap] : nearest) {
      has_nearest |= separation_from(one, triangle) <= least + 1e-4;
    }
    EXPECT_TRUE(has_nearest);
  }
}

TEST(NearCells, OfBallsAreLowerBounds) { expect_lower_bounds(false, 1); }
TEST(NearCells, OfBoxesAreLowerBounds) { expect_lower_bounds(true, 2); }

TEST(NearCells, LeaveOutHoles) {
  oracle::Random random(3);
  const auto field = geometry_of(random_heights(20, 20, 0.1, 0.3, random));
  SeenSolid solid;
  solid.middle = {0, 0, 0};
  const Gaps gaps = gaps_on_every_isa(*field, {0, 19, 0, 19}, solid, {100});
  size_t expected = 0;
  for (uint32_t j = 0; j < 19; ++j) {
    for (uint32_t i = 0; i < 19; ++i) expected += field->is_hole(i, j) ? 0 : 2;
  }
  EXPECT_EQ(gaps.size(), expected);
}

}  // namespace
}  // namespace carom::test
