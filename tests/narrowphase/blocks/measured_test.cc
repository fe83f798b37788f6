// Measured: pairs that are not measured get the same decision as ever, and measured pairs the same
// bits as in a call that measures all.
#include <gtest/gtest.h>

#include <cstring>

#include "tests/support/hulls.h"
#include "tests/support/isas.h"
#include "tests/support/kind_pairs.h"
#include "tests/support/rounds.h"
#include "tests/support/run.h"

namespace carom::test {
namespace {

// Measured rows have all bits of `all`. Other rows have the same decision and a valid status.
void expect_measured(std::span<const TestPair> pairs, std::span<const Row> all,
                     std::span<const Row> found, Measured measured) {
  ASSERT_EQ(all.size(), found.size());
  for (size_t i = 0; i < all.size(); ++i) {
    const bool is_valid = all[i].status != static_cast<uint8_t>(Status::invalid);
    const bool is_measured = (all[i].overlap == 1) == (measured == Measured::overlapping);
    if (!is_valid || is_measured) {
      EXPECT_TRUE(same_rows(all.subspan(i, 1), found.subspan(i, 1), pairs.subspan(i, 1)));
    } else {
      EXPECT_EQ(all[i].overlap, found[i].overlap) << "pair " << i;
      EXPECT_NE(found[i].status, static_cast<uint8_t>(Status::invalid)) << "pair " << i;
    }
  }
}

void expect_no_manifold(const Row& row) {
  const ManifoldPoints none{};
  EXPECT_EQ(row.manifold_count, 0);
  EXPECT_EQ(std::memcmp(&row.manifold, &none, sizeof none), 0);
}

class MeasuredPairs : public testing::TestWithParam<ConvexFamily> {};

TEST_P(MeasuredPairs, HaveTheBitsOfAll) {
  for (const KindPair& kinds : supported_kind_pairs()) {
    SCOPED_TRACE(name(kinds));
    std::vector<TestPair> pairs =
        make_kind_pairs(GetParam(), kinds, PositionType::float32, fewer_if_slow(kinds, 70));
    vary_triangles(pairs);
    const std::vector<TestPair> nonsense = make_kind_nonsense(kinds, 20);
    pairs.insert(pairs.end(), nonsense.begin(), nonsense.end());
    Call call = call_with(PositionType::float32);
    const std::vector<Row> all =
        expected_rows(pairs, PositionType::float32, call.detail, call.frame);
    const LaidOutRowPairs rows(pairs, call);
    const LaidOutListPairs list(pairs, call);
    for_each_isa([&] {
      for (const Measured measured : {Measured::overlapping, Measured::separate}) {
        call.measured = measured;
        expect_measured(pairs, all, rows.run(call), measured);
        expect_measured(pairs, all, list.run(call), measured);
      }
    });
  }
}

INSTANTIATE_TEST_SUITE_P(Families, MeasuredPairs, testing::ValuesIn(convex_families()),
                         family_name);

TEST(MeasuredPairs, HaveNoManifoldsWhereSeparateOnesAreAskedFor) {
  for (const KindPair& kinds : supported_kind_pairs()) {
    SCOPED_TRACE(name(kinds));
    const std::vector<TestPair> pairs =
        make_kind_pairs(convex_families()[0], kinds, PositionType::float32, rounds_of_pairs(40));
    Call call = call_with(PositionType::float32);
    call.detail = Detail::manifold;
    call.measured = Measured::separate;
    for (const Row& row : run_rows(pairs, call)) expect_no_manifold(row);
  }
}

// Manifolds of earlier calls must not show, even if results pass through reused memory.
TEST(MeasuredPairs, OfMixedKindsHaveNoManifoldsOfEarlierCalls) {
  std::vector<TestPair> pairs(4);
  const Shape cube = oracle::hull_of(cube_corners());
  for (TestPair& pair : pairs) pair.a.shape = pair.b.shape = cube;
  pairs[0].a.shape = pairs[0].b.shape = Sphere{1};
  Call call = call_with(PositionType::float32);
  call.detail = Detail::manifold;
  for (TestPair& pair : pairs) pair.b.position = {1.9, 0.3, 0.2};
  EXPECT_GT(run_rows(pairs, call)[1].manifold_count, 0);
  for (TestPair& pair : pairs) pair.b.position = {2.5, 0.3, 0.2};
  call.measured = Measured::separate;
  for (const Row& row : run_rows(pairs, call)) expect_no_manifold(row);
}

// A proof may find a pair separate that rounding made overlap; the pair is then measured, too.
TEST(MeasuredPairs, AreAllWhereDecisionsAreProven) {
  for (const KindPair& kinds : solved_kind_pairs()) {
    SCOPED_TRACE(name(kinds));
    const std::vector<TestPair> pairs =
        make_kind_pairs(convex_families()[0], kinds, PositionType::float32, 40);
    Call call = call_with(PositionType::float32);
    call.accuracy.tier = Tier::exact;
    const std::vector<Row> all = run_rows(pairs, call);
    call.measured = Measured::separate;
    EXPECT_TRUE(same_rows(all, run_rows(pairs, call), pairs));
  }
}

}  // namespace
}  // namespace carom::test
