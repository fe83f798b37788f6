// The contact that comes with a time of impact.
#include <gtest/gtest.h>

#include "tests/support/impacts.h"
#include "tests/support/kind_checks.h"

namespace carom::test {
namespace {

using Wide = long double;
using WideVec = Vec3<Wide>;

reference::PairResult as_result(const ImpactRow& row) {
  const auto vector = [](const std::array<float, 3>& v) {
    return Eigen::Vector3f(v[0], v[1], v[2]);
  };
  return {.overlap = true,
          .status = static_cast<Status>(row.status),
          .separation = row.separation,
          .normal = vector(row.normal),
          .arm_a = vector(row.point_a),
          .arm_b = vector(row.point_b),
          .manifold_count = 0};
}

void expect_no_contact(const ImpactRow& row) {
  EXPECT_TRUE(std::isnan(row.separation));
  for (const auto* vector : {&row.normal, &row.point_a, &row.point_b}) {
    for (const float x : *vector) EXPECT_TRUE(std::isnan(x));
  }
}

// A pair that overlaps at the start has the contact of the bodies at rest.
void check_start(const MovedPair& pair, const ImpactRow& row) {
  const ExactKinds exact(pair.bodies, PositionType::float64);
  const reference::PairResult result = as_result(row);
  check_separation(exact, result);
  check_normal(exact, result);
  check_witnesses(exact, result);
}

// Both bodies in their poses at `time`, relative to the position of A.
ConvexOracle<Wide> placed(const MovedPair& pair, float time) {
  const auto& [a, b] = pair.bodies;
  ConvexOracle<Wide> at{a.shape, a.pose(), b.shape, b.pose()};
  at.a = MovingShape<Wide>(a.shape, a.pose(), pair.sweep_a).at(time);
  at.b = MovingShape<Wide>(b.shape, b.pose(), pair.sweep_b).at(time);
  return at;
}

WideVec between(const MovedPair& pair, float time) {
  const auto& [a, b] = pair.bodies;
  return vec3_as<Wide>(b.position) - vec3_as<Wide>(a.position) +
         (vec3_as<Wide>(pair.sweep_b.displacement) - vec3_as<Wide>(pair.sweep_a.displacement)) *
             Wide(time);
}

// The witness points lie next to each other on both surfaces, and the normal points from A to B, up
// to the effect of rounding the time.
void check_impact(const MovedPair& pair, const ImpactRow& row) {
  const MovingPair<double> moving = moving_pair<double>(pair);
  const Wide tolerance = 1e-5L * (moving.size() + moving.travel());
  ConvexOracle<Wide> at = placed(pair, row.toi);
  const WideVec origin_b = between(pair, row.toi);
  at.b.translate(origin_b);
  const auto normal = vec3_as<Wide>(row.normal);
  const auto point_a = vec3_as<Wide>(row.point_a);
  const auto point_b = vec3_as<Wide>(row.point_b) + origin_b;
  EXPECT_NEAR(static_cast<double>(length(normal)), 1, 4 * 0x1p-23);
  EXPECT_LE(std::fabs(row.separation), tolerance);
  EXPECT_GE(at.gap_along(normal), -tolerance) << "along the normal";
  EXPECT_LE(length(point_b - point_a), tolerance) << "from witness to witness";
  EXPECT_LE(std::fabs(signed_distance(at.a, point_a)), tolerance) << "witness of A";
  EXPECT_LE(std::fabs(signed_distance(at.b, point_b)), tolerance) << "witness of B";
}

void check_contact(const MovedPair& pair, const ImpactRow& row) {
  EXPECT_EQ(row.sub_a, 0u);
  EXPECT_EQ(row.sub_b, 0u);
  if (!row.is_impact()) {
    expect_no_contact(row);
  } else if (row.toi == 0) {
    check_start(pair, row);
  } else {
    check_impact(pair, row);
  }
}

void check_contacts(const MotionFamily& family, const KindPair& kinds, uint64_t seed) {
  const std::vector<MovedPair> pairs = make_motions(family, kinds, 12, seed);
  const std::vector<ImpactRow> rows = run_impacts(pairs, impact_call(PositionType::float64));
  for (size_t i = 0; i < pairs.size() && !testing::Test::HasFailure(); ++i) {
    const ShownIfFailed shown([&] { return show(pairs[i]) + "\n" + show(rows[i]); });
    check_contact(pairs[i], rows[i]);
  }
}

TEST(ImpactContact, IsThatOfTheTime) {
  uint64_t seed = 1;
  for (const MotionFamily& family : plain_motions()) {
    for (const KindPair& kinds : convex_kind_pairs()) {
      SCOPED_TRACE(name(kinds));
      check_contacts(family, kinds, ++seed);
    }
  }
}

// World-frame witness points are those of the poses at the time of impact.
TEST(ImpactContact, WorldPointsAreThoseOfTheTime) {
  MovedPair pair{{sphere(10, 0, 0, 1), sphere(16, 0, 0, 1)}, {}, {}};
  pair.sweep_a.displacement = {4, 0, 0};
  pair.sweep_b.displacement = {-4, 0, 0};
  ImpactCall call = impact_call(PositionType::float32);
  call.frame = WitnessFrame::world;
  const ImpactRow row = run_impacts({&pair, 1}, call)[0];
  EXPECT_NEAR(row.toi, 0.5, 1e-6);
  EXPECT_NEAR(row.point_a[0], 13, 1e-5);
  EXPECT_NEAR(row.point_b[0], 13, 1e-5);
  EXPECT_NEAR(row.normal[0], 1, 1e-6);
  EXPECT_NEAR(row.separation, 0, 1e-5);
}

}  // namespace
}  // namespace carom::test
