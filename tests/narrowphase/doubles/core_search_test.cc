// The searches over cores: support points in lanes, distances, and penetration directions.
#include <gtest/gtest.h>

#include <vector>

#include "narrowphase/doubles/core_separation.h"
#include "narrowphase/doubles/furthest.h"
#include "oracle/random.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using oracle::Random;
using scalar::CoreGap;

Core core_of(const std::vector<CoreVector>& points) {
  Core core;
  core.resize(points.size());
  for (size_t i = 0; i < points.size(); ++i) core.set(i, points[i]);
  core.pad();
  core.middle = points[0];
  return core;
}

// Small integers, which give many equally far points, or random numbers, which give none.
CoreVector random_vector(Random& random, bool is_integer) {
  const auto number = [&] {
    return is_integer ? static_cast<double>(random.below(5)) - 2 : random.uniform(-1, 1);
  };
  return {number(), number(), number()};
}

std::vector<CoreVector> random_points(Random& random, size_t count, bool are_integers) {
  std::vector<CoreVector> points;
  for (size_t i = 0; i < count; ++i) points.push_back(random_vector(random, are_integers));
  return points;
}

TEST(FurthestPoint, IsThatOfTheReferenceOnEveryIsa) {
  for_each_isa([] {
    const FurthestPoint in_lanes = furthest_point_in_lanes();
    Random random(1);
    for (size_t count = 1; count <= 35; ++count) {
      for (uint32_t round = 0; round < rounds(64); ++round) {
        const bool are_integers = round % 2 == 0;
        const Core core = core_of(random_points(random, count, are_integers));
        const CoreVector way = random_vector(random, are_integers);
        EXPECT_EQ(in_lanes(core, way), scalar::furthest_point(core, way)) << count;
      }
    }
  });
}

// A core must not show points of a larger core that was in the same memory.
TEST(FurthestPoint, ForgetsLargerCores) {
  Core core = core_of({{1, 0, 0}, {2, 0, 0}, {9, 0, 0}});
  core.resize(2);
  core.set(0, {1, 0, 0});
  core.set(1, {2, 0, 0});
  core.pad();
  for_each_isa([&] { EXPECT_EQ(furthest_point_in_lanes()(core, {1, 0, 0}), 1u); });
}

// The least height over zero of all planes through three points that have no point in front of
// them.
double least_height(const std::vector<CoreVector>& points) {
  double least = HUGE_VAL;
  for (size_t i = 0; i < points.size(); ++i) {
    for (size_t j = i + 1; j < points.size(); ++j) {
      for (size_t k = j + 1; k < points.size(); ++k) {
        const CoreVector n = cross(points[j] - points[i], points[k] - points[i]);
        const double length = std::sqrt(dot(n, n));
        if (length < 1e-9) continue;
        double most = -HUGE_VAL, lowest = HUGE_VAL;
        for (const CoreVector& p : points) {
          const double height = dot(n, p - points[i]) / length;
          most = std::max(most, height);
          lowest = std::min(lowest, height);
        }
        const double height = dot(n, points[i]) / length;
        if (most < 1e-12) least = std::min(least, height);
        if (lowest > -1e-12) least = std::min(least, -height);
      }
    }
  }
  return least;
}

std::vector<CoreVector> differences(const Core& a, const Core& b) {
  std::vector<CoreVector> all;
  for (size_t i = 0; i < a.size(); ++i) {
    for (size_t j = 0; j < b.size(); ++j) all.push_back(b.point(j) - a.point(i));
  }
  return all;
}

TEST(WayOut, IsTheNearestFaceOfTheDifference) {
  Random random(2);
  uint32_t overlapping = 0;
  const uint32_t count = rounds(160);
  for (uint32_t round = 0; round < count; ++round) {
    const bool are_integers = round % 4 == 0;
    const Core a = core_of(random_points(random, 4 + random.below(2), are_integers));
    const Core b = core_of(random_points(random, 4 + random.below(2), are_integers));
    const CoreGap gap = scalar::find_gap(a, b, {});
    ASSERT_TRUE(gap.has_ended);
    if (gap.size > 0 || gap.is_flat) continue;
    ++overlapping;
    EXPECT_NEAR(-gap.size, least_height(differences(a, b)), 1e-12) << round;
    EXPECT_NEAR(dot(gap.normal, gap.normal), 1, 1e-12);
  }
  EXPECT_GT(overlapping, count * 3 / 10);
  EXPECT_LT(overlapping, count * 9 / 10);
}

// The search ends from any corners that GJK may pass on: no face then has a corner twice.
TEST(WayOut, BeginsWithAnyCorners) {
  Random random(3);
  for (uint32_t round = 0; round < rounds(400); ++round) {
    const Core a = core_of(random_points(random, 1 + random.below(6), true));
    const Core b = core_of(random_points(random, 1 + random.below(6), true));
    const std::vector<CoreVector> all = differences(a, b);
    NearestPoint::Corners corners;
    for (size_t i = 0; i <= random.below(4); ++i) corners.push_back(all[random.below(all.size())]);
    const WayOut out = WayOutSearch(a, b, &scalar::furthest_point).run(corners);
    EXPECT_TRUE(out.has_ended);
    double gap = HUGE_VAL;
    for (const CoreVector& p : all) gap = std::min(gap, dot(out.normal, p));
    EXPECT_NEAR(out.gap, gap, 1e-12);
    EXPECT_NEAR(dot(out.normal, out.normal), 1, 1e-12);
  }
}

Core ball(Random& random, size_t count) {
  std::vector<CoreVector> points;
  for (size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d p = random.direction();
    points.push_back({p.x(), p.y(), p.z()});
  }
  return core_of(points);
}

TEST(WayOut, OfManyPoints) {
  Random random(4);
  const Core a = ball(random, 500), b = ball(random, 500);
  const CoreGap gap = scalar::find_gap(a, b, {});
  EXPECT_LT(gap.size, -1.8);
  EXPECT_GT(gap.size, -2);
}

// The difference is nearly a ball about zero: a polytope of a few hundred corners cannot tell where
// it is nearest.
TEST(WayOut, BeyondItsBudgetIsTheBestThatWasFoundAndSaysSo) {
  Random random(11);
  const Core a = ball(random, 3000), b = ball(random, 3000);
  const FurthestPoint furthest = &scalar::furthest_point;
  const NearestWay nearest = nearest_way(a, b, furthest);
  const WayOut out = WayOutSearch(a, b, furthest).run(nearest.corners);
  EXPECT_FALSE(out.has_ended);
  EXPECT_NEAR(dot(out.normal, out.normal), 1, 1e-12);
  // The result is still a valid penetration direction: its gap is that of the support points along
  // it.
  const double projected = dot(out.normal, b.point(furthest(b, -out.normal))) -
                           dot(out.normal, a.point(furthest(a, out.normal)));
  EXPECT_NEAR(out.gap, projected, 1e-12);
  EXPECT_GT(out.gap, -2);
  EXPECT_LT(out.gap, -1.9);
  const CoreGap gap = scalar::find_gap(a, b, {});
  EXPECT_FALSE(gap.has_ended);
  const auto separation =
      scalar::core_separation(a, b, gap, Eigen::Vector3d::Zero(), scalar::CoreTest());
  EXPECT_EQ(separation.status, Status::budget);
  EXPECT_EQ(separation.separation, out.gap);
}

TEST(NearestWay, DecidesWhatDepthsDecide) {
  Random random(5);
  for (uint32_t round = 0; round < rounds(2000); ++round) {
    const bool are_integers = round % 4 == 0;
    const Core a = core_of(random_points(random, 1 + random.below(6), are_integers));
    const Core b = core_of(random_points(random, 1 + random.below(6), are_integers));
    const CoreGap gap = scalar::find_gap(a, b, {});
    const CoreGap decision = scalar::find_gap(a, b, {.decides_only = true});
    EXPECT_EQ(gap.size <= 0, decision.size <= 0);
  }
}

// A flat difference beside zero: rounding may turn it into a tetrahedron around zero.
TEST(NearestWay, FlatDifferencesAreBesideZero) {
  Random random(6);
  for (uint32_t round = 0; round < rounds(2000); ++round) {
    const CoreVector u = random_vector(random, false), v = random_vector(random, false);
    const CoreVector base = random_vector(random, false);
    std::vector<CoreVector> points;
    for (size_t i = 0; i < 6; ++i) {
      points.push_back(base + u * random.uniform(-1, 1) + v * random.uniform(-1, 1));
    }
    const CoreVector n = cross(u, v);
    const double height = std::fabs(dot(n, base)) / std::sqrt(dot(n, n));
    const Core zero = core_of({{0, 0, 0}});
    const CoreGap gap = scalar::find_gap(zero, core_of(points), {.decides_only = true});
    EXPECT_GE(gap.size, height - 1e-9);
  }
}

// A hull whose thickness is only rounding, with zero inside: GJK stops beside it.
TEST(NearestWay, NeedleAroundZero) {
  const Core needle =
      core_of({{-0.037270426832785364, -0.073177986330249079, -0.00481753879288703},
               {1.079212152950789, 2.1189613292399989, 0.13949832198213467},
               {-0.30435995919987791, -0.59759053856125677, -0.03934135177019521},
               {-0.50983973962634521, -1.0010364889013124, -0.065901534360979119},
               {-0.2343129108349471, -0.46005777680035131, -0.030287126194537994},
               {0.67520424666383083, 1.3257186705734481, 0.087276433176532359},
               {-0.092948534303696373, -0.18249831071400591, -0.012014469289048479},
               {0.84825123363883859, 1.6654848846650094, 0.10964435624871999},
               {0.88294373680103577, 1.7336013911361678, 0.11412870430699906},
               {-0.46097807370732458, -0.90509990577901256, -0.059585731349974025}});
  const Core zero = core_of({{0, 0, 0}});
  const CoreGap gap = scalar::find_gap(zero, needle, {});
  EXPECT_LT(gap.size, 0);
  EXPECT_GT(gap.size, -1e-8);
  EXPECT_TRUE(gap.has_ended);
  EXPECT_LE(scalar::find_gap(zero, needle, {.decides_only = true}).size, 0);
}

// Parallel edges above one another do not cross, whatever rounding says. The contact location is
// the middle of their common part.
TEST(Meeting, OfParallelEdges) {
  using scalar::Vector3d;
  const Vector3d a0(-0.331117314175, 0.282886261923, 0.412349905338);
  const Vector3d a1(0.644368258308, 0.524042068562, 0.403171575772);
  const Vector3d b0(0.0128835405375, 0.133989513938, 0.197599656721);
  const Vector3d b1(-1.30747166042, -0.192423641232, 0.210022859606);
  const Vector3d u = (a1 - a0).normalized();
  const Vector3d n = (b0 - a0 - u * u.dot(b0 - a0)).normalized();
  const Vector3d point = scalar::Meeting({a0, a1}, {b0, b1}, n).point();
  const double first = std::max(0.0, u.dot(b1 - a0)), last = u.dot(b0 - a0);
  EXPECT_NEAR(u.dot(point - a0), (first + last) / 2, 1e-9);
}

}  // namespace
}  // namespace carom::test
