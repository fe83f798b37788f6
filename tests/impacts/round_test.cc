// Times of impact of cylinders, cones, ellipsoids and rounded shapes: the bits of the reference,
// and separations before and at those times by an oracle that knows support points alone.
#include <gtest/gtest.h>

#include "oracle/support_pair.h"
#include "tests/support/impacts.h"
#include "tests/support/isas.h"
#include "tests/support/kind_pairs.h"
#include "tests/support/rounds.h"
#include "tests/support/show.h"

namespace carom::test {
namespace {

// B starts anywhere about A, and flies towards it or past it.
std::vector<MovedPair> make_round_motions(const KindPair& kinds, size_t count, uint64_t seed) {
  Random random(seed);
  const auto vector = [&random](double size) -> Eigen::Vector3f {
    return (random.direction() * random.uniform(0, size)).cast<float>();
  };
  std::vector<MovedPair> pairs;
  std::vector<TestPair> at_rest =
      make_kind_pairs({.name = "", .distance = 0}, kinds, PositionType::float64, count, seed);
  round_some(at_rest, seed);
  for (TestPair pair : at_rest) {
    const bool turns = random.chance(0.7);
    Sweep sweep_a{vector(1), turns ? vector(2) : Eigen::Vector3f::Zero()};
    Sweep sweep_b{vector(1), turns ? vector(2) : Eigen::Vector3f::Zero()};
    const Eigen::Vector3d way = random.direction() * 3;
    pair.b.position += way;
    sweep_b.displacement -= (way * random.uniform(0.5, 1.5)).cast<float>();
    pairs.push_back({pair, sweep_a, sweep_b});
  }
  return pairs;
}

Pose pose_at(const PlacedShape& body, const Sweep& sweep, double t) {
  Pose pose = body.pose();
  pose.position += sweep.displacement.cast<double>() * t;
  const Eigen::Vector3d turn = sweep.rotation.cast<double>() * t;
  const double angle = turn.norm();
  if (angle > 0) {
    const Eigen::Quaterniond by(Eigen::AngleAxisd(angle, turn / angle));
    pose.orientation = (by * pose.orientation.cast<double>().normalized()).cast<float>();
  }
  return pose;
}

double separation_at(const MovedPair& pair, double t) {
  const auto& [a, b] = pair.bodies;
  const SupportPair shapes(a.shape, pose_at(a, pair.sweep_a, t), b.shape,
                           pose_at(b, pair.sweep_b, t));
  return static_cast<double>(shapes.distance(1e-9L * shapes.scale()).high);
}

// Rounded orientations move points by some 1e-6.
constexpr double kSame = 1e-5;

void expect_first_contact(const MovedPair& pair, const ImpactRow& row) {
  ASSERT_EQ(row.status, static_cast<uint32_t>(Status::ok));
  const double end = row.is_impact() ? row.toi : 1;
  for (int i = 0; i < 32; ++i) {
    const double t = end * i / 32;
    if (row.toi > 0) {
      EXPECT_GT(separation_at(pair, t), -kSame) << "at " << t;
    }
  }
  if (row.is_impact()) {
    EXPECT_LT(separation_at(pair, row.toi), kSame);
  }
}

TEST(RoundImpacts, AreTheFirstContacts) {
  uint64_t seed = 0;
  size_t impacts = 0, all = 0;
  for (const KindPair& kinds : round_kind_pairs()) {
    SCOPED_TRACE(name(kinds));
    const auto pairs = make_round_motions(kinds, rounds(20, 2), ++seed);
    const ImpactCall call = impact_call(PositionType::float64);
    const std::vector<ImpactRow> rows = run_impacts(pairs, call);
    for (size_t i = 0; i < pairs.size(); ++i) {
      const ShownIfFailed shown([&] { return show(pairs[i]) + "\n" + show(rows[i]); });
      expect_first_contact(pairs[i], rows[i]);
      impacts += rows[i].is_impact();
      ++all;
      if (HasFailure()) return;
    }
    const auto expected = expected_impacts(pairs, call);
    for_each_isa([&] { EXPECT_TRUE(same_impacts(expected, run_impacts(pairs, call), pairs)); });
  }
  EXPECT_GT(impacts, all / 4);
  EXPECT_LT(impacts, all * 9 / 10);
}

}  // namespace
}  // namespace carom::test
