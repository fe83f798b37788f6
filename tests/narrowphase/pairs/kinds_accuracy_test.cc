// Every pair of kinds against the oracle, within the bounds that the library states.
#include <gtest/gtest.h>

#include "tests/support/kind_checks.h"
#include "tests/support/kind_pairs.h"

namespace carom::test {
namespace {

constexpr size_t kPairsEach = 100;

int failure_count() {
  return testing::UnitTest::GetInstance()->current_test_info()->result()->total_part_count();
}

class KindsAccuracy : public testing::TestWithParam<ConvexFamily> {};

TEST_P(KindsAccuracy, IsWithinBounds) {
  uint64_t seed = 1;
  for (const KindPair& kinds : solved_kind_pairs()) {
    for (const PositionType positions : kPositionTypes) {
      SCOPED_TRACE(name(kinds));
      const size_t count = fewer_if_slow(kinds, kPairsEach);
      for (const TestPair& pair : make_kind_pairs(GetParam(), kinds, positions, count, ++seed)) {
        const int failures_before = failure_count();
        checked_result(pair, positions);
        if (failure_count() > failures_before) break;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Families, KindsAccuracy, testing::ValuesIn(convex_families()),
                         family_name);

}  // namespace
}  // namespace carom::test
