// What is found of hulls in float32: distances by GJK, depths by separating axes, against the
// searches in double precision.
#include <gtest/gtest.h>

#include <cstring>

#include "narrowphase/core_separation_ref.h"
#include "narrowphase/gjk_ref.h"
#include "narrowphase/hull_steps.h"
#include "narrowphase/hull_steps_ref.h"
#include "tests/support/hulls.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using oracle::Random;
using reference::HullShape;
using reference::PairPose;
using reference::Separation;

struct HullPair {
  Hull a, b;
  PairPose<float> pose;
};

reference::Quaternion<float> random_turn(Random& random) {
  const Vector3f v = random.direction().cast<float>() * static_cast<float>(random.uniform(-1, 1));
  return {v, static_cast<float>(random.uniform(0.1, 1))};
}

// In scaled units, half of them overlapping.
HullPair random_pair(Random& random, size_t count) {
  const auto hull = [&] {
    const auto side = [&] { return static_cast<float>(random.uniform(0.3, 1)); };
    return oracle::hull_of(round_points(count, {side(), side(), side()}, random));
  };
  HullPair pair{hull(), hull(), {}};
  pair.pose.d = (random.direction() * random.uniform(0, 1.9)).cast<float>();
  pair.pose.a = random_turn(random);
  pair.pose.b = random_turn(random);
  return pair;
}

HullShape<float> float_hull(const Hull& hull) { return {hull.geometry.get(), 1}; }

reference::SeparationAs<double> in_double(const HullPair& pair) {
  const auto turn = [](const reference::Quaternion<float>& q) -> reference::Quaternion<double> {
    return {q.v.cast<double>(), q.w};
  };
  return core_separation(
      HullShape<double>{pair.a.geometry.get(), 1}, HullShape<double>{pair.b.geometry.get(), 1},
      PairPose<double>{pair.pose.d.cast<double>(), turn(pair.pose.a), turn(pair.pose.b)},
      reference::CoreTest());
}

void expect_close(const Separation& found, const reference::SeparationAs<double>& exact) {
  EXPECT_NEAR(found.separation, exact.separation, 2e-6);
  EXPECT_NEAR(found.normal.norm(), 1, 1e-6);
  // Ways out may be as short as each other; the way between separate hulls is one.
  if (exact.separation < 1e-3) return;
  EXPECT_NEAR((found.normal.cast<double>() - exact.normal).norm(), 0, 1e-3);
  EXPECT_NEAR((found.arm_a.cast<double>() - exact.arm_a).norm(), 0, 1e-3);
}

TEST(FloatGjk, IsSureOfMostDistancesAndRightWhereItIs) {
  Random random(1);
  const uint32_t count = rounds(1200);
  uint32_t separate = 0, sure = 0, deep = 0;
  for (uint32_t round = 0; round < count; ++round) {
    const HullPair pair = random_pair(random, 4 + random.below(60));
    const auto exact = in_double(pair);
    const reference::FloatTest test = reference::nearest_separation(
        float_core(float_hull(pair.a), pair.pose.a, Vector3f::Zero()),
        float_core(float_hull(pair.b), pair.pose.b, pair.pose.d), pair.pose.d, 1);
    separate += exact.separation > 0;
    sure += !test.separation.is_unsure;
    deep += test.is_deep;
    if (test.is_deep) {
      EXPECT_LT(exact.separation, 0);
      EXPECT_TRUE(test.separation.is_unsure);
    }
    if (!test.separation.is_unsure) expect_close(test.separation, exact);
  }
  EXPECT_GT(separate, count * 3 / 10);
  EXPECT_LT(separate, count * 7 / 10);
  EXPECT_GT(sure, separate * 95 / 100);
  EXPECT_GT(deep, (count - separate) * 95 / 100);
}

TEST(FloatGjk, LeavesHullsWithManyPoints) {
  Random random(2);
  for (const size_t count : {kMostLanePoints - 1, kMostLanePoints, kMostLanePoints + 1}) {
    const Hull hull = oracle::hull_of(round_points(count, {1, 1, 1}, random));
    ASSERT_EQ(hull.geometry->points().size(), count);
    const auto core = float_core(float_hull(hull), {Vector3f::Zero(), 1}, Vector3f::Zero());
    EXPECT_EQ(core.has_space, count <= kMostLanePoints);
  }
}

TEST(FloatGjk, LeavesWhatIsTooLargeOrTooSmall) {
  const reference::FloatCore zero{{Vector3f::Zero()}}, one{{Vector3f::UnitX()}};
  const auto is_unsure = [&](float up) {
    return reference::nearest_separation(zero, one, Vector3f::UnitX(), up).separation.is_unsure;
  };
  EXPECT_FALSE(is_unsure(1));
  EXPECT_FALSE(is_unsure(kGreatestScale));
  EXPECT_FALSE(is_unsure(1 / kGreatestScale));
  EXPECT_TRUE(is_unsure(2 * kGreatestScale));
  EXPECT_TRUE(is_unsure(0.5f / kGreatestScale));
}

TEST(HullDepth, IsTheWayOut) {
  Random random(3);
  const uint32_t count = rounds(1200);
  uint32_t overlapping = 0, sure = 0;
  for (uint32_t round = 0; round < count; ++round) {
    const HullPair pair = random_pair(random, 4 + random.below(60));
    const auto exact = in_double(pair);
    if (exact.separation > -1e-3) continue;
    ++overlapping;
    const Separation found =
        hull_depth(float_hull(pair.a), float_hull(pair.b), pair.pose, reference::kHullSteps);
    if (found.is_unsure) continue;
    ++sure;
    expect_close(found, exact);
    // Moved apart by the depth along the normal they just touch.
    HullPair apart = pair;
    apart.pose.d -= found.normal * found.separation;
    EXPECT_NEAR(in_double(apart).separation, 0, 4e-6);
  }
  EXPECT_GT(overlapping, count * 3 / 10);
  EXPECT_LT(overlapping, count * 7 / 10);
  EXPECT_GT(sure, overlapping * 95 / 100);
}

// One through the other: the shortest way out is over two edges, over a face of A, or one of B.
TEST(HullDepth, KnownOnes) {
  const Hull cube = oracle::hull_of(cube_corners());
  const Hull tip = oracle::hull_of(pyramid(-1));
  const reference::Quaternion<float> unturned{Vector3f::Zero(), 1};
  const auto depth = [&](const Hull& a, const Hull& b, const PairPose<float>& pose) {
    return hull_depth(float_hull(a), float_hull(b), pose, reference::kHullSteps);
  };
  const Separation face_of_a = depth(cube, tip, {{0.25f, 0.5f, 1.75f}, unturned, unturned});
  ASSERT_FALSE(face_of_a.is_unsure);
  EXPECT_NEAR(face_of_a.separation, -0.25, 1e-6);
  EXPECT_EQ(face_of_a.normal, Vector3f(0, 0, 1));
  const Separation face_of_b = depth(tip, cube, {{-0.25f, -0.5f, -1.75f}, unturned, unturned});
  ASSERT_FALSE(face_of_b.is_unsure);
  EXPECT_NEAR(face_of_b.separation, -0.25, 1e-6);
  EXPECT_EQ(face_of_b.normal, Vector3f(0, 0, -1));
  // A cube on an edge over one on an edge across.
  const reference::Quaternion<float> on_x{{std::sin(0.3926991f), 0, 0}, std::cos(0.3926991f)};
  const reference::Quaternion<float> on_y{{0, std::sin(0.3926991f), 0}, std::cos(0.3926991f)};
  const float reach = std::sqrt(2.0f);
  const Separation edges = depth(cube, cube, {{0.1f, 0.2f, 2 * reach - 0.125f}, on_x, on_y});
  ASSERT_FALSE(edges.is_unsure);
  EXPECT_NEAR(edges.separation, -0.125, 2e-6);
  EXPECT_NEAR(edges.normal.z(), 1, 1e-6);
  EXPECT_NEAR(edges.arm_a.x(), 0.1, 1e-5);
  EXPECT_NEAR(edges.arm_a.y(), 0, 1e-5);
  EXPECT_NEAR(edges.arm_a.z(), reach, 1e-5);
}

// Faces that lie on each other have many points in common: which of them stands for all is not
// found here.
TEST(HullDepth, IsUnsureOfFacesOnFaces) {
  const Hull cube = oracle::hull_of(cube_corners());
  const reference::Quaternion<float> unturned{Vector3f::Zero(), 1};
  EXPECT_TRUE(hull_depth(float_hull(cube), float_hull(cube), {{0, 0, 1.5f}, unturned, unturned},
                         reference::kHullSteps)
                  .is_unsure);
}

// --- The steps in lanes ---

template <class T>
void expect_same_bits(const T& expected, const T& found) {
  EXPECT_EQ(std::memcmp(&expected, &found, sizeof expected), 0);
}

TEST(HullSteps, OfPointsAreThoseOfTheReferenceOnEveryIsa) {
  for_each_isa([] {
    const HullSteps& lanes = hull_steps_in_lanes();
    const HullSteps& scalar = reference::kHullSteps;
    Random random(4);
    for (size_t count = 1; count <= 35; ++count) {
      SCOPED_TRACE(count);
      Points points = round_points(count, {1, 1, 1}, random);
      // Some reach as far as each other.
      for (size_t i = 0; i < count; i += 3) points[i].z() = 1;
      const Hull hull{*make_hull(points, {})};
      const auto turn = reference::rotation_of(random_turn(random));
      const Vector3f offset = random.direction().cast<float>();
      HullPoints expected, found;
      scalar.place(*hull.geometry, 0.5f, turn, offset, expected);
      lanes.place(*hull.geometry, 0.5f, turn, offset, found);
      ASSERT_EQ(expected.count, found.count);
      for (size_t i = 0; i < count; ++i) EXPECT_EQ(expected[i], found[i]) << i;
      for (const Vector3f& way : {turn.z, Vector3f(-turn.z), offset}) {
        const FurthestOfHull far = scalar.furthest(expected, way);
        const FurthestOfHull far_in_lanes = lanes.furthest(found, way);
        EXPECT_EQ(far.index, far_in_lanes.index);
        expect_same_bits(far.height, far_in_lanes.height);
        EXPECT_EQ(scalar.count_as_far(expected, way, far.height),
                  lanes.count_as_far(found, way, far.height));
      }
    }
  });
}

TEST(HullSteps, OfFacesAreThoseOfTheReferenceOnEveryIsa) {
  for_each_isa([] {
    Random random(5);
    for (size_t count = 4; count <= 30; ++count) {
      SCOPED_TRACE(count);
      const Hull hull = oracle::hull_of(round_points(count, {1, 0.5f, 1}, random));
      const HullFeatures* const features = hull.geometry->features();
      ASSERT_TRUE(features);
      FaceBounds expected, found;
      for (size_t ball = 0; ball < 4; ++ball) {
        const Vector3f middle = random.direction().cast<float>();
        const float radius = ball == 0 ? 0.25f : 0;
        for (FaceBounds* bounds : {&expected, &found}) bounds->balls.push_back({middle, radius});
        const BestFace best = reference::bound_faces(*features, 0.5f, expected);
        const BestFace best_in_lanes = hull_steps_in_lanes().bound(*features, 0.5f, found);
        ASSERT_EQ(best.face, best_in_lanes.face);
        expect_same_bits(best.gap, best_in_lanes.gap);
        for (size_t f = 0; f < features->face_count(); ++f) {
          expect_same_bits(expected.gap[f], found.gap[f]);
          expect_same_bits(expected.between[ball][f], found.between[ball][f]);
        }
        expected.closed[best.face] = found.closed[best.face] = reference::kLargest;
      }
    }
  });
}

TEST(HullSteps, OfEdgesAreThoseOfTheReferenceOnEveryIsa) {
  for_each_isa([] {
    Random random(6);
    uint32_t crossed = 0, doubtful = 0;
    for (uint32_t round = 0; round < rounds(400); ++round) {
      const auto vector = [&]() -> Vector3f { return random.direction().cast<float>(); };
      const EdgeOfHull edge{vector(), vector(), vector(), vector()};
      EdgeColumns others;
      others.count = random.below(EdgeColumns::kMost + 1);
      for (size_t i = 0; i < others.count; ++i) {
        // Some along the edge itself, and some twice.
        const bool is_along = random.chance(0.02);
        for (size_t c = 0; c < EdgeColumns::kColumns; c += 3) {
          Vector3f v = vector();
          if (c == 0 && is_along) v = edge.direction + 1e-3f * v;
          for (size_t axis = 0; axis < 3; ++axis) {
            others.column[c + axis][i] =
                i % 5 == 4 ? others.column[c + axis][i - 1] : v[static_cast<int>(axis)];
          }
        }
      }
      const BestCrossing expected = reference::cross_edge(edge, others);
      const BestCrossing found = hull_steps_in_lanes().cross(edge, others);
      expect_same_bits(expected.gap, found.gap);
      EXPECT_EQ(expected.other, found.other);
      EXPECT_EQ(expected.is_doubtful, found.is_doubtful);
      crossed += expected.gap > -1;
      doubtful += expected.is_doubtful;
    }
    EXPECT_GT(crossed, rounds(400) / 2);
    EXPECT_GT(doubtful, 0u);
  });
}

}  // namespace
}  // namespace carom::test
