// Times of impact have the same bits however the call is made.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "tests/support/impacts.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

// Some motions of each family, with one type of positions.
std::vector<MovedPair> some_motions(const KindPair& kinds, PositionType positions, size_t count) {
  std::vector<MovedPair> pairs;
  uint64_t seed = 1;
  for (const auto& families : {plain_motions(), hard_motions()}) {
    for (const MotionFamily& family : families) {
      if (family.positions != positions) continue;
      for (const MovedPair& pair : make_motions(family, kinds, count, ++seed)) {
        pairs.push_back(pair);
      }
    }
  }
  return pairs;
}

// Pairs of all kinds in turn.
std::vector<MovedPair> mixed_motions(size_t count) {
  const std::vector<KindPair> kinds = convex_kind_pairs();
  Random random(1);
  std::vector<MovedPair> pairs;
  while (pairs.size() < count) {
    const KindPair& some = kinds[random.below(kinds.size())];
    pairs.push_back(make_motions(plain_motions()[1], some, 1, random.bits())[0]);
  }
  return pairs;
}

TEST(ImpactBits, AreTheSameOnAllInstructionSets) {
  for (const KindPair& kinds : convex_kind_pairs()) {
    for (const PositionType positions : kPositionTypes) {
      SCOPED_TRACE(name(kinds));
      const auto pairs = some_motions(kinds, positions, rounds(2));
      ImpactCall call = impact_call(positions);
      const auto expected = expected_impacts(pairs, call);
      for_each_isa([&] {
        call.backwards = false;
        EXPECT_TRUE(same_impacts(expected, run_impacts(pairs, call), pairs));
        call.backwards = true;
        EXPECT_TRUE(same_impacts(expected, run_impacts(pairs, call), pairs));
      });
      if (HasFailure()) return;
    }
  }
}

// Counts 0, 1, N - 1, N and N + 1 for vectors of every width.
TEST(ImpactBits, DoNotDependOnTheNumberOfPairs) {
  const MotionFamily turning = plain_motions()[1];
  for (const KindPair& kinds : convex_kind_pairs()) {
    SCOPED_TRACE(name(kinds));
    const auto pairs = make_motions(turning, kinds, 33);
    const ImpactCall call = impact_call(turning.positions);
    const auto expected = expected_impacts(pairs, call);
    for_each_isa([&] {
      for (const size_t count : {0, 1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 32, 33}) {
        const std::span first(pairs.data(), count);
        EXPECT_TRUE(
            same_impacts(std::span(expected.data(), count), run_impacts(first, call), first));
      }
    });
  }
}

TEST(ImpactBits, DoNotDependOnThreads) {
  const auto pairs = mixed_motions(rounds(6000));
  ImpactCall call = impact_call(PositionType::float64);
  const auto expected = run_impacts(pairs, call);
  call.parallelism = Parallelism::arena;
  for_each_isa([&] {
    for (const int threads : {1, 2, 4}) {
      tbb::task_arena arena(threads);
      arena.execute([&] { EXPECT_TRUE(same_impacts(expected, run_impacts(pairs, call), pairs)); });
    }
  });
}

TEST(ImpactBits, DoNotDependOnTheMixOfKinds) {
  const auto pairs = mixed_motions(400);
  for (const WitnessFrame frame : {WitnessFrame::body, WitnessFrame::world}) {
    ImpactCall call = impact_call(PositionType::float64);
    call.frame = frame;
    const auto expected = expected_impacts(pairs, call);
    for_each_isa([&] { EXPECT_TRUE(same_impacts(expected, run_impacts(pairs, call), pairs)); });
  }
}

TEST(ImpactBits, DoNotDependOnStrides) {
  const auto pairs = mixed_motions(100);
  ImpactCall call = impact_call(PositionType::float64);
  const auto expected = expected_impacts(pairs, call);
  for_each_isa([&] {
    for (const size_t stride : {size_t{16}, size_t{20}, size_t{64}}) {
      call.sweep_stride = stride;
      EXPECT_TRUE(same_impacts(expected, run_impacts(pairs, call), pairs));
    }
  });
}

// Bodies of one kind that do not turn, in all layouts of views. Arrays end at guard pages.
TEST(ImpactBits, DoNotDependOnLayouts) {
  using enum RadiusLayout;
  const Layout layouts[] = {
      {},
      {.stride = 40, .box_stride = 24, .box_slots = true, .always_kinds = true},
      {.radius = column, .stride = 12, .radius_stride = 8, .rows = RowOrder::backwards},
      {.radius = column, .stride = 44, .orientation_stride = 20, .rows = RowOrder::shared}};
  for (const PositionType positions : kPositionTypes) {
    MotionFamily family = plain_motions()[0];
    family.positions = positions;
    for (const KindPair& kinds : convex_kind_pairs()) {
      const auto pairs = make_motions(family, kinds, 19);
      const auto expected = expected_impacts(pairs, impact_call(positions));
      for (Layout layout : layouts) {
        layout.positions = positions;
        if (layout.stride != 0) layout.stride *= layout.component() / sizeof(float);
        const ImpactCall call{.layout = layout, .sweep_stride = 0};
        SCOPED_TRACE(name(kinds) + ", " + show(layout));
        for_each_isa([&] { EXPECT_TRUE(same_impacts(expected, run_impacts(pairs, call), pairs)); });
      }
    }
  }
}

// Points are spheres without a radius.
TEST(ImpactBits, PointsHaveNoRadius) {
  MovedPair pair{{sphere(1, 2, 3, 0), sphere(1, 4, 3, 0)}, {}, {}};
  pair.sweep_a.displacement = {0, 4, 0};
  const std::vector<MovedPair> pairs(33, pair);
  for (const PositionType positions : kPositionTypes) {
    ImpactCall call = impact_call(positions);
    const auto expected = expected_impacts(pairs, call);
    EXPECT_TRUE(expected[0].is_impact());
    call.layout.radius = RadiusLayout::none;
    for_each_isa([&] { EXPECT_TRUE(same_impacts(expected, run_impacts(pairs, call), pairs)); });
  }
}

// Absent sweeps equal sweeps of zero.
TEST(ImpactBits, AbsentSweepsAreZero) {
  auto pairs = mixed_motions(100);
  for (MovedPair& pair : pairs) pair.sweep_a = pair.sweep_b = {};
  ImpactCall call = impact_call(PositionType::float64);
  const auto expected = expected_impacts(pairs, call);
  call.sweep_stride = 0;
  for_each_isa([&] { EXPECT_TRUE(same_impacts(expected, run_impacts(pairs, call), pairs)); });
}

TEST(ImpactBits, ColumnsThatAreLeftOutChangeNothing) {
  const auto pairs = mixed_motions(100);
  ImpactCall call = impact_call(PositionType::float64);
  const auto all = expected_impacts(pairs, call);
  for_each_isa([&] {
    for (const unsigned missing : {0x1u, 0x2u, 0x1cu, 0x7ffeu, 0x3ffeu, 0x1ffeu, 0x3fffu}) {
      call.missing = missing;
      auto expected = all;
      for (ImpactRow& row : expected) forget_columns(row, missing);
      EXPECT_TRUE(same_impacts(expected, run_impacts(pairs, call), pairs));
    }
  });
}

TEST(ImpactBits, DoNotDependOnTheFloatModeOfTheCaller) {
  for (const KindPair& kinds : convex_kind_pairs()) {
    SCOPED_TRACE(name(kinds));
    const auto pairs = some_motions(kinds, PositionType::float32, 1);
    ImpactCall call = impact_call(PositionType::float32);
    const auto expected = expected_impacts(pairs, call);
    for_each_isa([&] {
      for (const FloatMode& mode : float_modes()) {
        SCOPED_TRACE(mode.name);
        call.mode = mode;
        EXPECT_TRUE(same_impacts(expected, run_impacts(pairs, call), pairs));
      }
    });
    if (HasFailure()) return;
  }
}

// If positions lie on a grid, a common shift keeps their difference exactly, and only the
// difference matters.
TEST(ImpactBits, DoNotDependOnWhereBothAre) {
  const auto on_grid = [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d((p * 0x1p20).array().round() * 0x1p-20);
  };
  for (const KindPair& kinds : convex_kind_pairs()) {
    SCOPED_TRACE(name(kinds));
    auto pairs = make_motions(plain_motions()[1], kinds, 20);
    for (MovedPair& pair : pairs) {
      pair.bodies.a.position = on_grid(pair.bodies.a.position);
      pair.bodies.b.position = on_grid(pair.bodies.b.position);
    }
    auto far_pairs = pairs;
    const Eigen::Vector3d far(0x1p29, -0x1p27, 0x1p30);
    for (MovedPair& pair : far_pairs) {
      pair.bodies.a.position += far;
      pair.bodies.b.position += far;
    }
    const ImpactCall call = impact_call(PositionType::float64);
    EXPECT_TRUE(same_impacts(run_impacts(pairs, call), run_impacts(far_pairs, call), pairs));
  }
}

}  // namespace
}  // namespace carom::test
