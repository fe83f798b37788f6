// The truth about pairs with round shapes, and their measurement.
#include "accuracy/pairs/round_pair.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "accuracy/pairs/samples.h"
#include "accuracy/tiers/judge.h"
#include "accuracy/tiers/tradeoff.h"

namespace carom::accuracy {
namespace {

using Json = nlohmann::ordered_json;

TEST(RoundPair, KnowsClosedForms) {
  const auto pair_at = [](const Shape& a, const Shape& b, const Eigen::Vector3d& at) {
    ConvexPair pair{a, {{100, 0, 0}, Eigen::Quaternionf::Identity()}, b, {}};
    pair.pose_b.position = pair.pose_a.position + at;
    return RoundPair(pair);
  };
  const auto gap = [&](const Shape& a, const Shape& b, const Eigen::Vector3d& at) {
    return static_cast<double>(pair_at(a, b, at).gap());
  };
  EXPECT_NEAR(gap(Cylinder{1, 2}, Sphere{0.5f}, {4, 0, 0}), 2.5, 1e-7);
  EXPECT_NEAR(gap(Cylinder{1, 2}, Sphere{0.5f}, {4, 0, 6}), 4.5, 1e-7);
  EXPECT_NEAR(gap(Cylinder{1, 2}, Cylinder{1, 2}, {0, 0, 3.5}), -0.5, 1e-7);
  EXPECT_NEAR(gap(Cone{3, 2}, Sphere{0.25f}, {0, 0, 4}), 1.75, 1e-7);
  EXPECT_NEAR(gap(Ellipsoid{{1, 2, 3}}, Sphere{1}, {0, 5, 0}), 2, 1e-7);
  EXPECT_NEAR(gap(Ellipsoid{{2, 2, 2}}, Ellipsoid{{1, 1, 1}}, {0, 3, 4}), 2, 1e-7);
  EXPECT_NEAR(gap(Halfspace{{0, 0, 2}, 2}, Cone{1, 2}, {0, 0, 5}), 2, 1e-12);
  EXPECT_NEAR(gap(Cone{1, 2}, Halfspace{{0, 0, 1}, 0}, {0, 0, 1}), -3, 1e-12);
  const RoundPair touching = pair_at(Cylinder{1, 2}, Sphere{0.5f}, {4, 0, 0});
  EXPECT_EQ(touching.truth(), Truth::apart);
  EXPECT_LT(touching.error_share(2.5f), 1e-7);
  EXPECT_NEAR(touching.error_share(2.75f), 0.1, 1e-6);  // of the gap, which is the scale
  EXPECT_LT(touching.regret_share({1, 0, 0}), 1e-7);
  EXPECT_GT(touching.regret_share({0.8f, 0.6f, 0}), 0.1);
  EXPECT_EQ(pair_at(Cylinder{1, 2}, Cylinder{1, 2}, {0, 0, 3.5}).truth(), Truth::overlap);
}

// Shapes that both oracles know.
TEST(RoundPair, IsTheExactPairOfOtherShapes) {
  for (const KindPair& kinds : {KindPair{ShapeKind::box, ShapeKind::box},
                                {ShapeKind::capsule, ShapeKind::hull},
                                {ShapeKind::sphere, ShapeKind::triangle},
                                {ShapeKind::halfspace, ShapeKind::capsule}}) {
    for (const ConvexPair& pair : random_pairs(kinds, 12, 5)) {
      const ExactPair exact(pair);
      const RoundPair round(pair);
      EXPECT_NEAR(static_cast<double>(round.gap()), static_cast<double>(exact.gap()), 2e-7);
      EXPECT_TRUE(round.truth() == exact.truth() || round.truth() == Truth::unknown);
    }
  }
}

TEST(RoundPair, ListsAllKindsOnce) {
  std::vector<std::string> names;
  for (const NamedKinds& kinds : round_kinds()) {
    EXPECT_TRUE(has_round(kinds.kinds)) << kinds.name;
    names.push_back(kinds.name);
  }
  EXPECT_EQ(names.size(), 55u);  // five with eight others, and among themselves
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

TEST(RoundPair, MeasuredKindsBreakNoPromise) {
  constexpr Effort kFewRound = {
      .stream = 12, .family = 0, .gap = 0, .distance = 0, .angle = 0, .scene = 0, .rounds = 1};
  Json tradeoff, matrix, atlas = Json::array();
  Failures failures;
  for (const NamedKinds& kinds : round_kinds()) {
    measure_round(kinds, kFewRound, 3, {tradeoff, matrix, atlas}, failures);
  }
  EXPECT_THAT(failures.texts(), testing::IsEmpty());
  EXPECT_EQ(matrix.size(), round_kinds().size());
  EXPECT_EQ(tradeoff.size(), 2 * round_kinds().size());  // the reference and the standard tier
  EXPECT_TRUE(atlas.empty());
  for (const Json& row : tradeoff) {
    EXPECT_GT(row["ns_per_pair"].get<double>(), 0) << row;
    EXPECT_EQ(row["judged"], kFewRound.stream) << row;
    EXPECT_LT(row["error_worst"].get<double>(), 1e-6) << row;
  }
}

}  // namespace
}  // namespace carom::accuracy
