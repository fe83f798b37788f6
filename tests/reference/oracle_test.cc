// The reference against exact arithmetic, with the bounds that the library states.
#include "tests/support/oracle.h"

#include <gtest/gtest.h>

#include "tests/support/families.h"
#include "tests/support/show.h"
#include "tests/support/special_floats.h"

namespace carom::test {
namespace {

// Half the spacing of floats near zero, for several roundings.
constexpr double kSubnormal = 4 * 0x1p-149;

// The error that no float32 result can avoid, for a pair of this size and gap.
Real rounding(const ExactPair& pair) { return kEps * (pair.scale + abs(pair.separation)); }

void check_decision(const ExactPair& exact, const reference::PairResult& result) {
  const bool overlap = exact.separation <= 0;
  if (result.overlap != overlap) {
    EXPECT_LT(abs(exact.separation), 4 * rounding(exact) + kSubnormal) << exact.separation;
    EXPECT_LE(-exact.separation, 1e-6 * exact.scale + kSubnormal);
  }
  EXPECT_EQ(result.overlap, result.separation <= 0);
}

void check_separation(const ExactPair& exact, const reference::PairResult& result) {
  const Real error = abs(Real(result.separation) - exact.separation);
  EXPECT_LE(error, 4 * rounding(exact) + kSubnormal) << exact.separation;
  if (abs(exact.separation) <= 2 * exact.scale) {
    EXPECT_LE(error, 2e-6 * exact.scale + kSubnormal);
  }
}

void check_normal(const ExactPair& exact, const reference::PairResult& result) {
  const Real3 normal = test::exact(result.normal);
  EXPECT_LE(abs(norm(normal) - 1), 4 * kEps);
  const Real regret = exact.separation - exact.gap_along(normal);
  EXPECT_LE(regret, 1e-5 * (exact.scale + abs(exact.separation)) + kSubnormal);
}

// Witness points lie on the surfaces, and the separating vector leads from one to the other.
void check_witnesses(const ExactPair& exact, const reference::PairResult& result) {
  const Real3 arm_a = test::exact(result.arm_a);
  const Real3 arm_b = test::exact(result.arm_b);
  const Real3 normal = test::exact(result.normal);
  const Real tolerance = 6 * rounding(exact) + kSubnormal;
  EXPECT_LE(abs(exact.a.distance(arm_a)), tolerance);
  EXPECT_LE(abs(exact.b.distance(arm_b)), tolerance);
  for (int i = 0; i < 3; ++i) {
    const Real between = exact.d[i] + arm_b[i] - arm_a[i];
    EXPECT_LE(abs(between - result.separation * normal[i]), tolerance) << "axis " << i;
  }
}

void check(const TestPair& pair, PositionType positions) {
  const ExactPair exact(pair, positions);
  const reference::PairResult result = reference_result(pair, positions);
  EXPECT_NE(result.status, Status::invalid);
  check_decision(exact, result);
  check_separation(exact, result);
  check_normal(exact, result);
  check_witnesses(exact, result);
}

class Oracle : public testing::TestWithParam<Family> {};

TEST_P(Oracle, AgreesWithin) {
  for (const Sides sides : kAllSides) {
    for (const PositionType positions : kPositionTypes) {
      SCOPED_TRACE(std::string(name(sides)) + ", " + name(positions));
      for (const TestPair& pair : make_pairs(GetParam(), sides, positions, 400)) {
        check(pair, positions);
        if (HasFailure()) {
          FAIL() << show(pair);
        }
      }
    }
  }
}

// Along an axis distances are exact. The decision then is exact, too, however the sum of the radii
// rounds.
TEST(ExactDecision, OfSpheresAlongAnAxis) {
  Random random(3);
  int hits = 0;
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    const float a = static_cast<float>(random.log_uniform(1e-3, 1e3));
    const float b = static_cast<float>(random.log_uniform(1e-3, 1e3));
    float x = a + b;
    if (random.chance(0.6)) x = std::nextafter(x, random.chance(0.5) ? 0.0f : 1e30f);
    const TestPair pair{sphere(0, 0, 0, a), sphere(0, x, 0, b)};
    const bool overlap = static_cast<double>(x) <= static_cast<double>(a) + b;
    EXPECT_EQ(reference_result(pair, PositionType::float32).overlap, overlap) << show(pair);
    hits += overlap;
  }
  EXPECT_GT(hits, kCount * 0.3);
  EXPECT_LT(hits, kCount * 0.7);
}

std::string test_name(const testing::TestParamInfo<Family>& info) {
  std::string text = info.param.name;
  std::replace(text.begin(), text.end(), ' ', '_');
  return text;
}

INSTANTIATE_TEST_SUITE_P(Families, Oracle, testing::ValuesIn(families()), test_name);

}  // namespace
}  // namespace carom::test
