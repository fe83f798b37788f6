#include "tests/support/kind_checks.h"

namespace carom::test {

ExactKinds::ExactKinds(const TestPair& pair, PositionType positions)
    : oracle(oracle_of(pair, positions)), answer(oracle.separation()) {
  origin_b = vec3_as<Number>(stored(pair.b.position, positions)) -
             vec3_as<Number>(stored(pair.a.position, positions));
  gap = std::fabs(answer.value);
  least = 32 * Number(0x1p-149);
  arms = 0;
  scale = (bounding_radius(pair.a.shape) + bounding_radius(pair.b.shape)) / 2;
  if (oracle.a.is_halfspace || oracle.b.is_halfspace) measure_halfspace();
}

void ExactKinds::measure_halfspace() {
  const auto& plane = oracle.a.is_halfspace ? oracle.a : oracle.b;
  const Number reach = length(origin_b) + plane.bounding_radius;
  scale = 2 * scale + reach * 0x1p-24L;
  arms = (reach + gap) * 0x1p-22L;
}

ConvexOracle<long double> ExactKinds::oracle_of(const TestPair& pair, PositionType positions) {
  Pose a = pair.a.pose();
  Pose b = pair.b.pose();
  a.position = stored(a.position, positions);
  b.position = stored(b.position, positions);
  return {pair.a.shape, a, pair.b.shape, b};
}

void check_decision(const ExactKinds& exact, const reference::PairResult& result) {
  EXPECT_EQ(result.overlap, result.separation <= 0);
  if (result.overlap != (exact.answer.value <= 0)) {
    EXPECT_LE(exact.gap, exact.tolerance_with_gap(4 * 0x1p-23L));
  }
}

void check_separation(const ExactKinds& exact, const reference::PairResult& result) {
  EXPECT_LE(std::fabs(result.separation - exact.answer.value), exact.tolerance_with_gap(2e-6L))
      << "instead of " << exact.answer.value;
}

void check_normal(const ExactKinds& exact, const reference::PairResult& result) {
  const auto normal = vec3_as<long double>(result.normal);
  EXPECT_NEAR(static_cast<double>(length(normal)), 1, 4 * 0x1p-23);
  EXPECT_GE(exact.oracle.gap_along(normal), exact.answer.value - exact.tolerance_with_gap(1e-5L))
      << "separation " << exact.answer.value << " along " << hex3(result.normal);
}

void check_witnesses(const ExactKinds& exact, const reference::PairResult& result) {
  const auto normal = vec3_as<long double>(result.normal);
  const auto point_a = vec3_as<long double>(result.arm_a);
  const auto point_b = vec3_as<long double>(result.arm_b) + exact.origin_b;
  const long double tolerance = exact.tolerance_with_gap(4e-6L) + exact.arms;
  const auto way = point_b - point_a - normal * static_cast<long double>(result.separation);
  EXPECT_LE(length(way), tolerance) << "from witness to witness";
  EXPECT_LE(std::fabs(signed_distance(exact.oracle.a, point_a)), tolerance) << "witness of A";
  EXPECT_LE(std::fabs(signed_distance(exact.oracle.b, point_b)), tolerance) << "witness of B";
}

void check_manifold(const ExactKinds& exact, const reference::PairResult& result) {
  const size_t count = result.manifold_count;
  EXPECT_LE(count, 4u);
  EXPECT_EQ(count > 0, result.overlap);
  const auto normal = vec3_as<long double>(result.normal);
  const long double tolerance = exact.tolerance(1e-5L) + exact.arms;
  const long double deepest = exact.answer.value - exact.tolerance(2e-6L) - exact.gap * 0x1p-22L;
  for (size_t i = 0; i < 4; ++i) {
    SCOPED_TRACE("manifold point " + std::to_string(i));
    const long double separation = result.manifold.separation[i];
    const auto point = vec3_as<long double>(result.manifold.point[i]);
    if (i >= count) {
      EXPECT_TRUE(separation == 0 && length(point) == 0) << "unused";
      continue;
    }
    EXPECT_GE(separation, deepest);
    EXPECT_LE(std::fabs(signed_distance(exact.oracle.a, point)), tolerance) << "on A";
    const auto other = point + normal * separation;
    EXPECT_LE(std::fabs(signed_distance(exact.oracle.b, other)), tolerance) << "on B";
  }
}

void check_result(const ExactKinds& exact, const reference::PairResult& result) {
  EXPECT_NE(result.status, Status::invalid);
  check_decision(exact, result);
  check_separation(exact, result);
  check_normal(exact, result);
  check_witnesses(exact, result);
  check_manifold(exact, result);
}

reference::PairResult checked_result(const TestPair& pair, PositionType positions) {
  const ShownIfFailed shown([&] { return show(pair) + "\n" + name(positions); });
  const ExactKinds exact(pair, positions);
  const reference::PairResult result = reference_result(pair, positions);
  check_result(exact, result);
  return result;
}

}  // namespace carom::test
