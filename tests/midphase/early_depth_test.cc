// Depths that end early, within a tolerance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/composites.h"
#include "tests/support/fine_meshes.h"
#include "tests/support/hulls.h"
#include "tests/support/isas.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

constexpr float kTolerances[] = {1e-3f, 1e-2f, 0.1f, 10};
constexpr float kRounding = 1e-5f;  // of bodies of about 1 m

// Hulls, and all that has parts, so close that half of them overlap.
std::vector<TestPair> make_pairs(size_t count) {
  Composites composites(11);
  std::vector<TestPair> pairs;
  const std::array<ShapeKind, 2> kinds[] = {
      {ShapeKind::hull, ShapeKind::hull},     {ShapeKind::box, ShapeKind::hull},
      {ShapeKind::mesh, ShapeKind::mesh},     {ShapeKind::mesh, ShapeKind::hull},
      {ShapeKind::compound, ShapeKind::mesh}, {ShapeKind::compound, ShapeKind::compound}};
  for (size_t i = 0; i < count; ++i) {
    const auto& [a, b] = kinds[i % std::size(kinds)];
    pairs.push_back(composites.pair(a, b, PositionType::float64, 1, 2));
  }
  return pairs;
}

std::vector<Row> rows_within(float tolerance, const std::vector<TestPair>& pairs, Detail detail) {
  Call call = call_with(PositionType::float64);
  call.detail = detail;
  call.accuracy.tolerance = tolerance;
  return run_rows(pairs, call);
}

// Which pairs overlap, and all about separate ones, is as without a tolerance.
TEST(EarlyDepths, AreOffByTheToleranceAtMost) {
  const std::vector<TestPair> pairs = make_pairs(rounds(3000, 1500));
  for (const Detail detail : {Detail::contact, Detail::manifold}) {
    const std::vector<Row> exact = rows_within(0, pairs, detail);
    for (const float tolerance : kTolerances) {
      SCOPED_TRACE(tolerance);
      const std::vector<Row> early = rows_within(tolerance, pairs, detail);
      size_t others = 0;
      for (size_t i = 0; i < pairs.size(); ++i) {
        ASSERT_EQ(early[i].overlap, exact[i].overlap) << show(pairs[i]);
        if (exact[i].overlap != 1) {
          EXPECT_EQ(early[i].separation, exact[i].separation) << show(pairs[i]);
          continue;
        }
        others += early[i].separation != exact[i].separation;
        EXPECT_LE(early[i].separation, 0);
        EXPECT_NEAR(early[i].separation, exact[i].separation, tolerance + kRounding)
            << show(pairs[i]);
      }
      // The less a depth may be off, the fewer are.
      if (tolerance >= 0.1f) {
        EXPECT_GT(others, rounds(16));
      }
    }
  }
}

// Whether a contact came over an inner edge depends on its normal, and so does the contact that is
// reported.
TEST(EarlyDepths, OfHullsKeepTheirNormalsOnMeshes) {
  const float h = -0x1.a6778ep-3f;
  const Mesh mesh =
      mesh_of({{-1, -1, 0}, {1, -1, h}, {1, 1, 0}, {-1, 1, h}}, {{0, 1, 2}, {0, 2, 3}});
  const std::vector<Eigen::Vector3f> corners = {{-0x1.7d13dep-4f, 0x1.dc7fc8p-3f, 0x1.d79dd2p-1f},
                                                {-0x1.3738eep-6f, -0x1.28d0dp-2f, 0x1.3ca7d6p-4f},
                                                {-0x1.e70ec4p-5f, 0x1.87c6c8p-2f, -0x1.d718aep-1f},
                                                {0x1.88db3ep-1f, 0x1.d269d6p-4f, -0x1.e67838p-2f}};
  const TestPair pair = {
      {mesh, {0, 0, 0}},
      placed_hull(corners, {-0x1.08486ee996b91p-1, -0x1.74decfebf3daep-2, -0x1.259b61132338p-4})};
  const float exact = rows_within(0, {pair}, Detail::contact)[0].separation;
  EXPECT_NEAR(exact, -0x1.a4c308p-1, 1e-5);
  EXPECT_NEAR(rows_within(0.01f, {pair}, Detail::contact)[0].separation, exact, 0.01f);
}

// Batches hold the parts of many pairs. What is left out depends on none but the pair's own.
TEST(EarlyDepths, DoNotDependOnOtherPairs) {
  std::vector<TestPair> pairs = make_pairs(rounds(600, 300));
  oracle::Random random(5);
  for (size_t i = 0; i < 12; ++i) {
    const double phase = random.uniform(0, 6);
    const Mesh rough = ball_mesh(60, [&](double x, double y, double z) {
      return 1 + 0.1 * std::sin(9 * x + phase) * std::sin(8 * y) + 0.05 * std::sin(13 * z);
    });
    TestPair pair = {{rough, Eigen::Vector3d::Zero()},
                     {rough, random.uniform(0.3, 1.2) * random.direction()}};
    pairs.insert(pairs.begin() + static_cast<ptrdiff_t>(random.below(pairs.size())), pair);
  }
  size_t others = 0;
  for (const float tolerance : {0.0f, 0.01f, 0.1f}) {
    SCOPED_TRACE(tolerance);
    const std::vector<Row> together = rows_within(tolerance, pairs, Detail::contact);
    std::vector<TestPair> backwards(pairs.rbegin(), pairs.rend());
    std::vector<Row> turned_round = rows_within(tolerance, backwards, Detail::contact);
    std::reverse(turned_round.begin(), turned_round.end());
    EXPECT_TRUE(same_rows(together, turned_round, pairs));
    for (size_t i = 0; i < pairs.size(); ++i) {
      const std::vector<Row> alone = rows_within(tolerance, {pairs[i]}, Detail::contact);
      EXPECT_TRUE(same_rows({&together[i], 1}, alone, {&pairs[i], 1}));
      others += tolerance > 0 &&
                alone[0].separation != rows_within(0, {pairs[i]}, Detail::contact)[0].separation;
    }
  }
  EXPECT_GT(others, rounds(8));
}

TEST(EarlyDepths, AreTheSameOnEveryIsa) {
  const std::vector<TestPair> pairs = make_pairs(rounds(300));
  std::vector<Row> first;
  for_each_isa([&] {
    const std::vector<Row> rows = rows_within(0.05f, pairs, Detail::contact);
    if (first.empty()) first = rows;
    EXPECT_TRUE(same_rows(first, rows, pairs));
  });
}

// A proof leaves nothing out.
TEST(EarlyDepths, AreNotOfProvenTiers) {
  const std::vector<TestPair> pairs = make_pairs(rounds(300));
  Call call = call_with(PositionType::float64);
  call.accuracy.tier = Tier::exact;
  const std::vector<Row> exact = run_rows(pairs, call);
  call.accuracy.tolerance = 0.1f;
  EXPECT_TRUE(same_rows(exact, run_rows(pairs, call), pairs));
}

TEST(EarlyDepths, NeedALength) {
  const std::vector<Eigen::Vector4f> spheres(2, Eigen::Vector4f(0, 0, 0, 1));
  Collidables view;
  view.count = spheres.size();
  view.position = {.data = spheres.data(), .stride = sizeof spheres[0]};
  const Pair pair{0, 1};
  uint8_t overlap, status;
  ResultColumns out;
  out.overlap = &overlap;
  out.status = &status;
  for (const float bad :
       {-1e-3f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    const Result<void> done = collide(view, view, {&pair, 1}, Detail::overlap, out,
                                      CollideOptions{.accuracy = {.tolerance = bad}});
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().message, "the tolerance is not a finite number >= 0");
  }
}

}  // namespace
}  // namespace carom::test
