// Rays cut in lanes are those cut one at a time, to the bit: C. Ericson, Real-Time Collision
// Detection, 2005, section 5.3.3.
#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>
#include <memory>

#include "impacts/rays/ray_in_mesh.h"
#include "impacts/slack.h"
#include "oracle/random.h"
#include "tests/support/composites.h"
#include "tests/support/isas.h"
#include "trees/box_path.h"

namespace carom::test {
namespace {

std::optional<RayInMesh> plain_cut(const RayTarget& target, const Turn& turn, const Double3& from,
                                   const Double3& way, double limit) {
  RayInMesh ray;
  ray.mesh = target.mesh;
  ray.one_sided = target.one_sided;
  ray.start = turned_back(turn, {-from[0], -from[1], -from[2]});
  ray.way = turned_back(turn, {-way[0], -way[1], -way[2]});
  ray.travel = greatest(ray.way);
  ray.lengths = greatest(ray.start) + ray.travel + target.greatest;
  ray.first = 0;
  ray.last = limit;
  const double slack = kPathSlack * ray.lengths + FLT_TRUE_MIN;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double to_lower = (target.lower[axis] - slack) - ray.start[axis];
    const double to_upper = (target.upper[axis] + slack) - ray.start[axis];
    if (ray.way[axis] == 0) {
      if (to_lower > 0 || to_upper < 0) return std::nullopt;
      continue;
    }
    const double inverse = 1 / ray.way[axis];
    ray.first = std::max(ray.first, std::min(to_lower * inverse, to_upper * inverse));
    ray.last = std::min(ray.last, std::max(to_lower * inverse, to_upper * inverse));
  }
  if (!(ray.first <= ray.last)) return std::nullopt;

  Double3 at_first, path;
  for (size_t axis = 0; axis < 3; ++axis) {
    at_first[axis] = ray.start[axis] + ray.way[axis] * ray.first;
    path[axis] = ray.way[axis] * (ray.last - ray.first);
  }
  const double margin = slack + kFloatSlack * (greatest(at_first) + greatest(path));
  for (size_t axis = 0; axis < 3; ++axis) {
    const bool moves = std::fabs(ray.way[axis]) >= BoxPath::kLeastDisplacement;
    const double along = moves ? 0 : path[axis];
    ray.lower[axis] = static_cast<float>(at_first[axis] + std::min(along, 0.0) - margin);
    ray.upper[axis] = static_cast<float>(at_first[axis] + std::max(along, 0.0) + margin);
    ray.inverse[axis] = moves ? static_cast<float>(1 / ray.way[axis]) : INFINITY;
  }
  return ray;
}

void expect_same(const RayInMesh& a, const RayInMesh& b) {
  EXPECT_EQ(a.mesh, b.mesh);
  EXPECT_EQ(a.one_sided, b.one_sided);
  EXPECT_EQ(a.start, b.start);
  EXPECT_EQ(a.way, b.way);
  EXPECT_EQ(std::tie(a.travel, a.lengths, a.first, a.last),
            std::tie(b.travel, b.lengths, b.first, b.last));
  EXPECT_EQ(a.lower, b.lower);
  EXPECT_EQ(a.upper, b.upper);
  EXPECT_EQ(a.inverse, b.inverse);
}

// Rays of all lengths: towards the mesh, past it, along axes, short ones and such that stand still.
void put_ray(oracle::Random& random, double size, RayColumns& rays, size_t row) {
  const double distance = size * random.log_uniform(0.1, 100);
  const Eigen::Vector3d from = random.direction() * distance;
  const Eigen::Vector3d aim = from + random.direction() * size * random.uniform(0, 8);
  const double share = random.chance(0.2) ? random.log_uniform(1e-50, 1e10) : 2;
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<int>(axis);
    const bool stands = random.chance(0.1);
    rays.from[axis][row] = stands && random.chance(0.7) ? from[i] * 1e-3 : from[i];
    rays.way[axis][row] = stands ? 0 : -aim[i] * share;
  }
  rays.limit[row] = random.chance(0.8) ? 1 : random.uniform(0, 1);
}

TEST(RayCuts, AreThoseOfOneRayAtATime) {
  oracle::Random random(41);
  size_t cut_count = 0, ray_count = 0, still_count = 0;
  for (int round = 0; round < 60; ++round) {
    const auto size = static_cast<float>(random.log_uniform(1e-20, 1e20));
    const Mesh mesh = grid_mesh(4, size, [&](float x, float y) { return 0.2f * (x - y); },
                                {.one_sided = round % 2 == 1});
    const RayTarget target(*mesh.geometry, round % 2 == 1);
    const Turn turn = round % 4 == 0
                          ? kNotTurned
                          : rotation_of({static_cast<float>(random.uniform(-1, 1)), 0.3f, -0.2f,
                                         static_cast<float>(random.uniform(0, 1))});
    const auto rays = std::make_unique<RayColumns>();
    for (size_t i = 0; i < RayColumns::kMost; ++i) put_ray(random, size, *rays, i);
    for_each_isa([&] {
      for (const size_t end : {0, 1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 63, 64}) {
        const size_t begin = end / 3;
        std::array<RaySearch, RayColumns::kMost> found;
        const size_t count = cut_rays(target, turn, *rays, begin, end, found.data());
        size_t expected = 0;
        for (size_t row = begin; row < end; ++row) {
          const auto column = [row](const std::array<RayColumns::Column, 3>& c) -> Double3 {
            return {c[0][row], c[1][row], c[2][row]};
          };
          const auto ray =
              plain_cut(target, turn, column(rays->from), column(rays->way), rays->limit[row]);
          ++ray_count;
          if (!ray) continue;
          ASSERT_LT(expected, count);
          EXPECT_EQ(found[expected].row, row);
          EXPECT_EQ(found[expected].limit, rays->limit[row]);
          expect_same(found[expected].ray, *ray);
          for (const float inverse : ray->inverse) still_count += std::isinf(inverse);
          ++expected;
        }
        EXPECT_EQ(expected, count);
        cut_count += count;
      }
    });
  }
  EXPECT_GT(cut_count, ray_count / 5);
  EXPECT_LT(cut_count, ray_count * 4 / 5);
  EXPECT_GT(still_count, ray_count / 50);
}

TEST(RayCuts, AreMadeOfRaysWithinTheRangeOfFloat32) {
  const Mesh mesh = grid_mesh(2, 1, [](float, float) { return 0.0f; });
  const RayTarget target(*mesh.geometry, false);
  EXPECT_TRUE(is_in_range(target, {1e28, 0, 0}, {0, -1e28, 0}));
  EXPECT_FALSE(is_in_range(target, {1e30, 0, 0}, {0, 1, 0}));
  EXPECT_FALSE(is_in_range(target, {0, 0, 0}, {0, 0, -1e30}));
}

}  // namespace
}  // namespace carom::test
