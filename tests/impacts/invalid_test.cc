// Invalid bodies and sweeps that are not finite spoil their own pair and no other.
#include <gtest/gtest.h>

#include "tests/support/impacts.h"
#include "tests/support/spoilt_bodies.h"

namespace carom::test {
namespace {

void expect_no_answer(const ImpactRow& row) {
  EXPECT_TRUE(row.is_invalid()) << row.status;
  EXPECT_TRUE(std::isnan(row.toi));
  EXPECT_TRUE(std::isnan(row.separation));
  for (const auto* vector : {&row.normal, &row.point_a, &row.point_b}) {
    for (const float x : *vector) EXPECT_TRUE(std::isnan(x));
  }
  EXPECT_EQ(row.sub_a, 0u);
  EXPECT_EQ(row.sub_b, 0u);
}

// Every way to spoil a pair: its bodies, or their motion.
std::vector<MovedPair> all_spoilt(const MovedPair& pair) {
  std::vector<MovedPair> all;
  for (const TestPair& bodies : spoilt(pair.bodies)) {
    all.push_back({bodies, pair.sweep_a, pair.sweep_b});
  }
  for (const float bad : kBad) {
    for (int axis = 0; axis < 3; ++axis) {
      for (Sweep MovedPair::*sweep : {&MovedPair::sweep_a, &MovedPair::sweep_b}) {
        all.push_back(pair);
        (all.back().*sweep).displacement[axis] = bad;
        all.push_back(pair);
        (all.back().*sweep).rotation[axis] = bad;
      }
    }
  }
  return all;
}

TEST(InvalidMotions, HaveNoAnswer) {
  for (const KindPair& kinds : convex_kind_pairs()) {
    SCOPED_TRACE(name(kinds));
    const auto pairs = all_spoilt(make_motions(plain_motions()[1], kinds, 1)[0]);
    const ImpactCall call = impact_call(PositionType::float32);
    for_each_isa([&] {
      const auto rows = run_impacts(pairs, call);
      for (size_t i = 0; i < pairs.size() && !testing::Test::HasFailure(); ++i) {
        const ShownIfFailed shown([&] { return show(pairs[i]); });
        expect_no_answer(rows[i]);
      }
    });
  }
}

// Every third pair of a list is spoilt; the others keep their bits.
TEST(InvalidMotions, SpoilTheirOwnPairAlone) {
  const MotionFamily turning = plain_motions()[1];
  for (const KindPair& kinds : convex_kind_pairs()) {
    SCOPED_TRACE(name(kinds));
    const auto pairs = make_motions(turning, kinds, 70);
    const auto bad = all_spoilt(pairs[0]);
    const ImpactCall call = impact_call(turning.positions);
    for_each_isa([&] {
      auto expected = run_impacts(pairs, call);
      auto with_bad = pairs;
      for (size_t i = 0; i < pairs.size(); i += 3) with_bad[i] = bad[i % bad.size()];
      const auto rows = run_impacts(with_bad, call);
      for (size_t i = 0; i < pairs.size(); i += 3) {
        expect_no_answer(rows[i]);
        expected[i] = rows[i];
      }
      EXPECT_TRUE(same_impacts(expected, rows, with_bad));
    });
  }
}

// Spheres and aabbs do not turn: a finite rotation is ignored.
TEST(InvalidMotions, RotationsOfWhatDoesNotTurnAreIgnored) {
  for (const KindPair& kinds : convex_kind_pairs()) {
    const auto pairs = make_motions(plain_motions()[1], kinds, 20);
    auto turned = pairs;
    for (MovedPair& pair : turned) {
      if (!has_rows(pair.bodies.a.shape)) pair.sweep_a.rotation = {30, -20, 10};
      if (!has_rows(pair.bodies.b.shape)) pair.sweep_b.rotation = {-1e30f, 20, 1e-40f};
    }
    const ImpactCall call = impact_call(PositionType::float64);
    EXPECT_TRUE(same_impacts(run_impacts(pairs, call), run_impacts(turned, call), turned));
  }
}

TEST(InvalidMotions, TwoHalfspacesAreAnError) {
  const PlacedShape plane = halfspace({0, 0, 0}, {0, 0, 1}, 0);
  const MovedPair good{{sphere(0, 0, 5, 1), plane}, {}, {}};
  const MovedPair pairs[] = {good, {{plane, plane}, {}, {}}};
  std::vector<ImpactRow> rows;
  EXPECT_FALSE(try_impacts(pairs, impact_call(PositionType::float32), rows));
  ImpactRow untouched;
  std::memset(static_cast<void*>(&untouched), kNotWritten, sizeof untouched);
  untouched.status = kNotWritten;
  for (const ImpactRow& row : rows) EXPECT_TRUE(same_bits(row, untouched));
}

}  // namespace
}  // namespace carom::test
