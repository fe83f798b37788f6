// Separations of hulls in float32 (distances by GJK, depths by separating axes) against the
// searches in double precision.
#include <gtest/gtest.h>

#include "narrowphase/doubles/core_separation.h"
#include "narrowphase/hulls/gjk_scalar.h"
#include "narrowphase/hulls/hull_steps.h"
#include "narrowphase/hulls/hull_steps_scalar.h"
#include "shapes/dop_geometry.h"
#include "tests/narrowphase/hulls/scaled_hulls.h"
#include "tests/support/hulls.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using oracle::Random;
using scalar::HullShape;
using scalar::PairPose;
using scalar::Separation;

// A pair in scaled units; about half of the pairs overlap. Without a need for B, it has no
// geometry: the faces of hulls took most of the time of these tests.
HullPair random_pair(Random& random, size_t count, bool needs_b = true) {
  const auto points = [&] {
    const auto side = [&] { return static_cast<float>(random.uniform(0.3, 1)); };
    return round_points(count, {side(), side(), side()}, random);
  };
  HullPair pair{oracle::hull_of(points()), {}, {}};
  const Points points_of_b = points();
  if (needs_b) pair.b = oracle::hull_of(points_of_b);
  pair.pose.d = (random.direction() * random.uniform(0, 1.9)).cast<float>();
  pair.pose.a = random_turn(random);
  pair.pose.b = random_turn(random);
  return pair;
}

HullShape<float> float_hull(const Hull& hull) { return {hull.geometry.get(), 1}; }

HullShape<double> in_double(const HullShape<float>& hull) { return {hull.geometry, hull.scale}; }
scalar::BoxShape<double> in_double(const scalar::BoxShape<float>& box) {
  return {box.half.cast<double>()};
}
scalar::AabbShape<double> in_double(const scalar::AabbShape<float>& box) {
  return {box.lower.cast<double>(), box.upper.cast<double>()};
}
scalar::TriangleShape<double> in_double(const scalar::TriangleShape<float>& t) {
  const auto corner = [&](size_t i) -> Vector3d { return t.corners[i].cast<double>(); };
  return {{corner(0), corner(1), corner(2)}, 0, false, 0, false};
}

// `b` replaces the pair's second hull.
template <class Shape>
scalar::SeparationAs<double> in_double(const HullPair& pair, const Shape& b) {
  const auto turn = [](const scalar::Quaternion<float>& q) -> scalar::Quaternion<double> {
    return {q.v.cast<double>(), q.w};
  };
  return core_separation(
      in_double(float_hull(pair.a)), in_double(b),
      PairPose<double>{pair.pose.d.cast<double>(), turn(pair.pose.a), turn(pair.pose.b)},
      scalar::CoreTest());
}

void expect_close(const Separation& found, const scalar::SeparationAs<double>& exact) {
  EXPECT_NEAR(found.separation, exact.separation, 2e-6);
  EXPECT_NEAR(found.normal.norm(), 1, 1e-6);
  // Several penetration directions may be equally short; the direction between separate hulls is
  // unique.
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
    const auto exact = exact_separation(pair);
    const scalar::FloatTest test = scalar::nearest_separation(
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
  const scalar::FloatCore zero{{Vector3f::Zero()}}, one{{Vector3f::UnitX()}};
  const auto is_unsure = [&](float up) {
    return scalar::nearest_separation(zero, one, Vector3f::UnitX(), up).separation.is_unsure;
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
    const auto exact = exact_separation(pair);
    if (exact.separation > -1e-3) continue;
    ++overlapping;
    const Separation found =
        shape_depth(float_hull(pair.a), float_hull(pair.b), pair.pose, scalar::kHullSteps);
    if (found.is_unsure) continue;
    ++sure;
    expect_close(found, exact);
    // Moved by the depth along the normal, the hulls just touch.
    HullPair apart = pair;
    apart.pose.d -= found.normal * found.separation;
    EXPECT_NEAR(exact_separation(apart).separation, 0, 4e-6);
  }
  EXPECT_GT(overlapping, count * 3 / 10);
  EXPECT_LT(overlapping, count * 7 / 10);
  EXPECT_GT(sure, overlapping * 95 / 100);
}

// Many corners of a k-DOP lie so near to each other that float32 cannot tell them apart.
Hull random_hull_of_dop(Random& random) {
  Points points(24);
  for (Vector3f& p : points) {
    p = (random.direction() * random.uniform(0.3, 1)).cast<float>();
  }
  return hull_of(Dop::of_points(points, DopKind::k26));
}

TEST(HullDepth, OfKDopsIsSeldomUnsure) {
  Random random(8);
  const uint32_t count = rounds(1200);
  uint32_t overlapping = 0, sure = 0;
  for (uint32_t round = 0; round < count; ++round) {
    const Hull a = random_hull_of_dop(random), b = random_hull_of_dop(random);
    const Vector3f d = (random.direction() * random.uniform(0, 1.9)).cast<float>();
    const scalar::Quaternion<float> turn_a = random_turn(random), turn_b = random_turn(random);
    const HullPair pair{a, b, {d, turn_a, turn_b}};
    const auto exact = exact_separation(pair);
    if (exact.separation > -1e-3) continue;
    ++overlapping;
    const Separation found =
        shape_depth(float_hull(pair.a), float_hull(pair.b), pair.pose, scalar::kHullSteps);
    sure += !found.is_unsure;
    if (!found.is_unsure) expect_close(found, exact);
  }
  EXPECT_GT(overlapping, count * 3 / 10);
  EXPECT_GT(sure, overlapping * 97 / 100);
}

// Hulls through each other: the penetration direction is across two edges, a face of A, or a face
// of B.
TEST(HullDepth, KnownOnes) {
  const Hull cube = oracle::hull_of(cube_corners());
  const Hull tip = oracle::hull_of(pyramid(-1));
  const scalar::Quaternion<float> unturned{Vector3f::Zero(), 1};
  const auto depth = [&](const Hull& a, const Hull& b, const PairPose<float>& pose) {
    return shape_depth(float_hull(a), float_hull(b), pose, scalar::kHullSteps);
  };
  const Separation face_of_a = depth(cube, tip, {{0.25f, 0.5f, 1.75f}, unturned, unturned});
  ASSERT_FALSE(face_of_a.is_unsure);
  EXPECT_NEAR(face_of_a.separation, -0.25, 1e-6);
  EXPECT_EQ(face_of_a.normal, Vector3f(0, 0, 1));
  const Separation face_of_b = depth(tip, cube, {{-0.25f, -0.5f, -1.75f}, unturned, unturned});
  ASSERT_FALSE(face_of_b.is_unsure);
  EXPECT_NEAR(face_of_b.separation, -0.25, 1e-6);
  EXPECT_EQ(face_of_b.normal, Vector3f(0, 0, -1));
  // A cube on an edge, above a cube on an edge across the first.
  const scalar::Quaternion<float> on_x{{std::sin(0.3926991f), 0, 0}, std::cos(0.3926991f)};
  const scalar::Quaternion<float> on_y{{0, std::sin(0.3926991f), 0}, std::cos(0.3926991f)};
  const float reach = std::sqrt(2.0f);
  const Separation edges = depth(cube, cube, {{0.1f, 0.2f, 2 * reach - 0.125f}, on_x, on_y});
  ASSERT_FALSE(edges.is_unsure);
  EXPECT_NEAR(edges.separation, -0.125, 2e-6);
  EXPECT_NEAR(edges.normal.z(), 1, 1e-6);
  EXPECT_NEAR(edges.arm_a.x(), 0.1, 1e-5);
  EXPECT_NEAR(edges.arm_a.y(), 0, 1e-5);
  EXPECT_NEAR(edges.arm_a.z(), reach, 1e-5);
}

Separation early_depth(const HullPair& pair, float slack) {
  const SolidHull a(float_hull(pair.a)), b(float_hull(pair.b));
  const DeepPair deep{&a.view(), &b.view(), pair.pose.d, pair.pose.a, pair.pose.b, slack};
  Separation found;
  solid_depths({&deep, 1}, hull_steps_in_lanes(), &found);
  return found;
}

// An axis that is nearly as good as the best one may belong to a face beside which the other hull's
// corner lies: one point was once 1.1 outside of the second hull.
TEST(HullDepth, ThatIsFoundEarlyHasItsPointsInBothHulls) {
  const auto box = [](float x, float y, float z) {
    return oracle::hull_of(box_corners({x, y, z}));
  };
  const HullPair known = {box(0.346772522f, 0.953612685f, 0.501050532f),
                          box(0.611381114f, 0.129429638f, 0.126802683f),
                          {{0.0976213142f, -0.839280427f, 0.164785638f},
                           {Vector3f::Zero(), 1},
                           {{0.00295916782f, -0.345688373f, 0.938344717f}, 0.866795659f}}};
  Random random(15);
  const uint32_t count = rounds(3000, 40);
  uint32_t found_depths = 0, early = 0;
  for (uint32_t round = 0; round < count; ++round) {
    const auto side = [&] { return static_cast<float>(random.uniform(0.1, 1)); };
    HullPair pair = round % 2 ? random_pair(random, 6 + random.below(20)) : known;
    if (round > 0 && round % 2 == 0) {
      pair.a = box(side(), side(), side());
      pair.b = box(side(), side(), side());
      pair.pose = {(random.direction() * random.uniform(0, 1)).cast<float>(), random_turn(random),
                   random_turn(random)};
    }
    constexpr float kSlack = 0.02f;
    const Separation found = early_depth(pair, kSlack);
    if (found.is_unsure) continue;
    ++found_depths;
    const auto exact = exact_separation(pair);
    early += exact.separation - found.separation > 1e-4;
    EXPECT_GE(found.separation, exact.separation - kSlack - 4e-6);
    EXPECT_LE(found.separation, exact.separation + 4e-6);
    EXPECT_TRUE(holds(pair.a, pair.pose.a, found.arm_a)) << round;
    EXPECT_TRUE(holds(pair.b, pair.pose.b, found.arm_b)) << round;
  }
  EXPECT_GT(found_depths, count / 4);
  EXPECT_GT(early, found_depths / 20);
}

// Two faces on each other have many common points, and this search cannot choose one: the result is
// unsure.
TEST(HullDepth, IsUnsureOfFacesOnFaces) {
  const Hull cube = oracle::hull_of(cube_corners());
  const scalar::Quaternion<float> unturned{Vector3f::Zero(), 1};
  EXPECT_TRUE(shape_depth(float_hull(cube), float_hull(cube), {{0, 0, 1.5f}, unturned, unturned},
                          scalar::kHullSteps)
                  .is_unsure);
}

// --- Boxes and triangles ---

// Boxes and triangles against hulls: features that were made differently must give the same depth
// as double precision.
template <class MakeShape>
void expect_ways_out(uint64_t seed, float nearer, const MakeShape& make_shape) {
  Random random(seed);
  const uint32_t count = rounds(1200);
  uint32_t overlapping = 0, sure = 0;
  for (uint32_t round = 0; round < count; ++round) {
    HullPair pair = random_pair(random, 4 + random.below(60), false);
    pair.pose.d *= nearer;
    const auto shape = make_shape(random);
    const auto exact = in_double(pair, shape);
    if (exact.separation > -1e-3) continue;
    ++overlapping;
    const Separation found = shape_depth(float_hull(pair.a), shape, pair.pose, scalar::kHullSteps);
    if (found.is_unsure) continue;
    ++sure;
    expect_close(found, exact);
    EXPECT_NEAR((found.arm_b + pair.pose.d - found.arm_a - found.normal * found.separation).norm(),
                0, 1e-6);
  }
  EXPECT_GT(overlapping, count * 3 / 10);
  EXPECT_LT(overlapping, count * 7 / 10);
  EXPECT_GT(sure, overlapping * 95 / 100);
}

Vector3f random_half(Random& random) {
  const auto side = [&] { return static_cast<float>(random.uniform(0.1, 0.8)); };
  return {side(), side(), side()};
}

TEST(SolidDepth, OfBoxes) {
  expect_ways_out(7, 1,
                  [](Random& random) -> scalar::BoxShape<float> { return {random_half(random)}; });
}

TEST(SolidDepth, OfUprightBoxesWhateverTheirPoseSays) {
  expect_ways_out(8, 1, [](Random& random) -> scalar::AabbShape<float> {
    const Vector3f middle = 0.3f * random.direction().cast<float>(), half = random_half(random);
    return {middle - half, middle + half};
  });
}

TEST(SolidDepth, OfTriangles) {
  expect_ways_out(9, 0.6f, [](Random& random) -> scalar::TriangleShape<float> {
    const auto corner = [&]() -> Vector3f { return random.direction().cast<float>(); };
    return {{corner(), corner(), corner()}, 0, false, 0, false};
  });
}

TEST(SolidDepth, IsUnsureOfTrianglesWithRulesAndOfFlatOnes) {
  const Hull cube = oracle::hull_of(cube_corners());
  const scalar::Quaternion<float> on_x{{0.3f, 0.1f, 0}, 1};
  const auto is_unsure = [&](const scalar::TriangleShape<float>& triangle) {
    return shape_depth(float_hull(cube), triangle, {{0, 0, 0.9f}, {Vector3f::Zero(), 1}, on_x},
                       scalar::kHullSteps)
        .is_unsure;
  };
  const Vector3f a(0, 0, 0), b(3, 0, 0), c(0, 3, 0);
  EXPECT_FALSE(is_unsure({{a, b, c}, 0, false, 0, false}));
  EXPECT_TRUE(is_unsure({{a, b, c}, 0, true, 0, true}));
  EXPECT_TRUE(is_unsure({{a, b, a}, 0, false, 0, false}));
  EXPECT_TRUE(is_unsure({{a, b, Vector3f(1, 1e-5f, 0)}, 0, false, 0, false}));
}

// Counts around the lanes of all targets.
constexpr size_t kPairCounts[] = {0, 1, 3, 4, 5, 7, 8, 9, 15, kMostDeepPairs};

// Pairs searched together, some of which have no features, are as each by itself.
TEST(SolidDepth, OfManyPairsIsThatOfEachOnEveryIsa) {
  for_each_isa([] {
    Random random(12);
    size_t sure = 0, all = 0;
    for (const size_t count : kPairCounts) {
      SCOPED_TRACE(count);
      std::vector<HullPair> pairs;
      std::vector<SolidHull> a, b;
      for (size_t i = 0; i < count; ++i) {
        HullPair pair = random_pair(random, 4 + random.below(30));
        pair.pose.d *= 0.3f;
        if (i % 5 == 3) pair.b = Hull{*make_hull(round_points(9, {1, 1, 1}, random), {})};
        a.emplace_back(float_hull(pair.a));
        b.emplace_back(float_hull(pair.b));
        pairs.push_back(pair);
      }
      std::vector<DeepPair> deep;
      for (size_t i = 0; i < count; ++i) {
        const PairPose<float>& pose = pairs[i].pose;
        deep.push_back({&a[i].view(), &b[i].view(), pose.d, pose.a, pose.b});
      }
      std::vector<Separation> found(count);
      solid_depths(deep, hull_steps_in_lanes(), found.data());
      for (size_t i = 0; i < count; ++i) {
        const Separation expected = shape_depth(float_hull(pairs[i].a), float_hull(pairs[i].b),
                                                pairs[i].pose, scalar::kHullSteps);
        ASSERT_EQ(expected.is_unsure, found[i].is_unsure);
        ++all;
        if (expected.is_unsure) continue;
        ++sure;
        EXPECT_EQ(expected.separation, found[i].separation);
        EXPECT_EQ(expected.normal, found[i].normal);
        EXPECT_EQ(expected.arm_a, found[i].arm_a);
        EXPECT_EQ(expected.arm_b, found[i].arm_b);
      }
    }
    EXPECT_GT(sure, all / 2);
    EXPECT_LT(sure, all);
  });
}

}  // namespace
}  // namespace carom::test
