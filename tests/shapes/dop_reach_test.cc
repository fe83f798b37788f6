// How far k-DOPs reach, against their corners.
#include "shapes/dop_reach.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "oracle/random.h"

namespace carom::test {

using namespace oracle;
namespace {

constexpr DopKind kReachKinds[] = {DopKind::k6, DopKind::k14, DopKind::k18, DopKind::k26};

// How the slabs of a k-DOP are chosen.
enum class Slabs { around_points, around_few_points, flat, loose, of_all_widths, integers };
constexpr Slabs kSlabs[] = {Slabs::around_points, Slabs::around_few_points, Slabs::flat,
                            Slabs::loose,         Slabs::of_all_widths,     Slabs::integers};

Dop around_points(Random& random, DopKind kind, size_t count, double height) {
  std::vector<Eigen::Vector3f> points;
  for (size_t i = 0; i < count; ++i) {
    points.push_back({static_cast<float>(random.uniform(-1, 1)),
                      static_cast<float>(random.uniform(-1, 1)),
                      static_cast<float>(height * random.uniform(-1, 1))});
  }
  return Dop::of_points(points, kind);
}

// Slabs that need not touch what they have in common, and may have nothing in common.
Dop any_dop(Random& random, DopKind kind, Slabs slabs) {
  Dop dop{.kind = kind};
  for (size_t i = 0; i < slab_count(kind); ++i) {
    double middle = random.uniform(-0.3, 0.3), half = random.uniform(0, 1.5);
    if (slabs == Slabs::of_all_widths) half = std::pow(10, random.uniform(-3, 18));
    if (slabs == Slabs::integers) {
      middle = static_cast<double>(random.below(5)) - 2;
      half = static_cast<double>(random.below(5));
    }
    dop.lower[i] = static_cast<float>(middle - half);
    dop.upper[i] = static_cast<float>(middle + half);
  }
  return dop;
}

Dop draw(Random& random, DopKind kind, Slabs slabs) {
  if (slabs == Slabs::around_points) return around_points(random, kind, 30, 1);
  if (slabs == Slabs::around_few_points) return around_points(random, kind, 1 + random.below(4), 1);
  if (slabs == Slabs::flat) return around_points(random, kind, 6, 1e-6 * random.below(2));
  for (;;) {
    const Dop dop = any_dop(random, kind, slabs);
    if (is_valid_dop(dop)) return dop;
  }
}

// Along axes and diagonals planes are reached that do not count; elsewhere three do.
Double3 draw_direction(Random& random) {
  Double3 d;
  do {
    const bool even = random.chance(0.3);
    for (double& x : d) {
      x = even ? static_cast<double>(random.below(3)) - 1 : random.uniform(-1, 1);
    }
  } while (greatest(d) == 0);
  return d;
}

double reach_of_corners(const DopPolytope& polytope, const Double3& d) {
  double most = -HUGE_VAL;
  for (const Double3& x : polytope.points()) most = std::max(most, dot(d, x));
  return most;
}

TEST(DopReach, IsThatOfTheCorners) {
  Random random(31);
  size_t found = 0, all = 0;
  for (const DopKind kind : kReachKinds) {
    for (const Slabs slabs : kSlabs) {
      SCOPED_TRACE(testing::Message()
                   << static_cast<int>(kind) << ", slabs " << static_cast<int>(slabs));
      for (int i = 0; i < 150; ++i) {
        const Dop dop = draw(random, kind, slabs);
        const DopSlabs tight = DopSlabs(dop).with_tight_axes();
        const DopPolytope polytope{DopSlabs(dop)};
        for (int k = 0; k < 12; ++k) {
          const Double3 d = draw_direction(random);
          const auto reach = dop_reach(tight, d);
          ++all;
          // Slabs of a single point, rounded to floats, may have no point left.
          if (!reach && slabs == Slabs::around_few_points) continue;
          ASSERT_TRUE(reach);
          ++found;
          ASSERT_NEAR(*reach, reach_of_corners(polytope, d), kDopRounding * tight.size());
        }
      }
    }
  }
  EXPECT_GT(found, all / 10 * 9);
}

TEST(DopReach, OfASinglePoint) {
  for (const DopKind kind : kReachKinds) {
    const DopSlabs slabs(Dop::of_points(std::vector<Eigen::Vector3f>{{1, -2, 4}}, kind));
    EXPECT_EQ(dop_reach(slabs.with_tight_axes(), {1, 0, 0}), 1);
    EXPECT_EQ(dop_reach(slabs.with_tight_axes(), {0, 1, 0}), -2);
    EXPECT_EQ(dop_reach(slabs.with_tight_axes(), {-1, 1, 0.5}), -1);
  }
}

}  // namespace
}  // namespace carom::test
