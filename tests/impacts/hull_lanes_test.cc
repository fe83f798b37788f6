// Hulls of different numbers of points, some too many for lanes, that share vectors: in lanes their
// times are those of the reference and of the oracle.
#include <gtest/gtest.h>

#include "tests/support/impacts.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

enum class Turning { none, one, both, far };

Hull draw_hull(Random& random, size_t points) {
  std::vector<Eigen::Vector3f> corners(points);
  for (Eigen::Vector3f& corner : corners) corner = random.direction().cast<float>();
  return {*make_hull(corners, {})};
}

Eigen::Vector3f draw_turn(Random& random, double least, double most) {
  return (random.direction() * random.uniform(least, most)).cast<float>();
}

std::vector<MovedPair> draw_pairs(Turning turning, size_t count) {
  constexpr size_t kPoints[] = {1, 2, 3, 4, 8, 16, 17, 64, 65, 100};
  Random random(static_cast<uint64_t>(turning) + 1);
  std::vector<MovedPair> pairs;
  while (pairs.size() < count) {
    MovedPair pair;
    pair.bodies.a.shape = draw_hull(random, kPoints[random.below(std::size(kPoints))]);
    pair.bodies.b.shape = draw_hull(random, kPoints[random.below(std::size(kPoints))]);
    pair.bodies.a.orientation = Eigen::AngleAxisf(2, draw_turn(random, 1, 1));
    const Eigen::Vector3d way = random.direction() * random.uniform(3, 6);
    const Eigen::Vector3d aside = random.direction() * random.uniform(0, 1.5);
    pair.bodies.b.position = way;
    pair.sweep_b.displacement = ((aside - way) * random.uniform(0.3, 2)).cast<float>();
    if (turning != Turning::none) pair.sweep_b.rotation = draw_turn(random, 0, 3);
    if (turning == Turning::both) pair.sweep_a.rotation = draw_turn(random, 0, 3);
    if (turning == Turning::far) pair.sweep_a.rotation = draw_turn(random, 12, 13);
    pairs.push_back(pair);
  }
  return pairs;
}

class HullsInLanes : public testing::TestWithParam<Turning> {};

TEST_P(HullsInLanes, HaveTheTimesOfTheReferenceAndTheOracle) {
  const auto pairs = draw_pairs(GetParam(), rounds(600, 100));
  const ImpactCall call = impact_call(PositionType::float64);
  const auto expected = expected_impacts(pairs, call);
  size_t hits = 0;
  for (size_t i = 0; i < pairs.size(); ++i) {
    hits += expected[i].is_impact();
    ASSERT_EQ(expected[i].status, static_cast<uint32_t>(Status::ok)) << i;
    const Judgement found = judge(pairs[i], expected[i].toi);
    ASSERT_EQ(found.fault, Fault::none) << i << ": " << name(found.fault);
  }
  EXPECT_GT(hits, pairs.size() / 5);
  EXPECT_LT(hits, pairs.size() * 4 / 5);
  for_each_isa([&] {
    for (const size_t count : {size_t{1}, size_t{7}, size_t{9}, pairs.size()}) {
      const std::span first(pairs.data(), count);
      EXPECT_TRUE(same_impacts(std::span(expected.data(), count), run_impacts(first, call), first));
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Turning, HullsInLanes,
                         testing::Values(Turning::none, Turning::one, Turning::both, Turning::far));

}  // namespace
}  // namespace carom::test
