// Times of impact of every two kinds against the oracle: never missed, never late, hardly early.
#include "carom/impacts/time_of_impact.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/impacts.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

// How many motions to test for a pair of kinds in a family. CAROM_MOTIONS asks for more.
size_t motion_count(const KindPair& kinds, uint32_t usual) {
  const char* asked = std::getenv("CAROM_MOTIONS");
  const size_t count = asked ? std::strtoull(asked, nullptr, 10) : rounds(usual);
  return std::max<size_t>(is_slow(kinds) ? count / 2 : count, 1);
}

// Counts of the results.
struct Tally {
  size_t pairs = 0;
  size_t impacts = 0;
  size_t out_of_budget = 0;
  size_t undecided = 0;  // pairs that the oracle cannot decide

  double hit_rate() const { return static_cast<double>(impacts) / static_cast<double>(pairs); }
};

testing::AssertionResult is_right(const MovedPair& pair, const ImpactRow& row, Tally& tally) {
  ++tally.pairs;
  if (row.is_impact()) ++tally.impacts;
  if (row.is_invalid()) return testing::AssertionFailure() << show(pair) << "\nis valid";
  const bool is_bound = row.status == static_cast<uint32_t>(Status::budget);
  if (is_bound) ++tally.out_of_budget;
  const Judgement found = is_bound ? judge_bound(pair, row.toi) : judge(pair, row.toi);
  if (found.fault == Fault::unknown) ++tally.undecided;
  if (found.fault == Fault::none || found.fault == Fault::unknown) {
    return testing::AssertionSuccess();
  }
  return testing::AssertionFailure() << show(pair) << "\n"
                                     << show(row) << "\nis " << name(found.fault) << ": "
                                     << found.separation << " apart at " << found.time;
}

// Tests in portions, so that a million motions fit into memory. Stops at the first wrong one.
void check_motions(const MotionFamily& family, const KindPair& kinds, size_t count, uint64_t seed,
                   Tally& tally) {
  constexpr size_t kPiece = 4096;
  MotionMaker maker(family, kinds, seed);
  for (size_t done = 0; done < count; done += kPiece) {
    std::vector<MovedPair> pairs;
    while (pairs.size() < std::min(kPiece, count - done)) pairs.push_back(maker.next());
    const std::vector<ImpactRow> rows = run_impacts(pairs, impact_call(family.positions));
    for (size_t i = 0; i < pairs.size(); ++i) {
      ASSERT_TRUE(is_right(pairs[i], rows[i], tally)) << family.name << " " << name(kinds);
    }
  }
}

// A body that rolls about its contact keeps its separation near zero, which no conservative step
// can prove for long.
void expect_decided(const MotionFamily& family, const Tally& tally) {
  EXPECT_LE(tally.out_of_budget, tally.pairs / (family.through_contact ? 4 : 100));
  EXPECT_LE(tally.undecided, tally.pairs / (family.through_contact ? 4 : 200));
}

std::string motion_name(const testing::TestParamInfo<MotionFamily>& info) {
  std::string text = info.param.name;
  std::replace(text.begin(), text.end(), ' ', '_');
  return text;
}

class PlainMotions : public testing::TestWithParam<MotionFamily> {};

// For every pair of kinds some motions hit and some miss.
TEST_P(PlainMotions, AreNeitherMissedNorLateNorEarly) {
  uint64_t seed = 1;
  for (const KindPair& kinds : convex_kind_pairs()) {
    Tally tally;
    check_motions(GetParam(), kinds, motion_count(kinds, 200), ++seed, tally);
    if (HasFatalFailure()) return;
    expect_decided(GetParam(), tally);
    EXPECT_GE(tally.hit_rate(), 0.3) << name(kinds);
    EXPECT_LE(tally.hit_rate(), 0.7) << name(kinds);
  }
}

INSTANTIATE_TEST_SUITE_P(Families, PlainMotions, testing::ValuesIn(plain_motions()), motion_name);

class HardMotions : public testing::TestWithParam<MotionFamily> {};

TEST_P(HardMotions, AreNeitherMissedNorLateNorEarly) {
  uint64_t seed = 1;
  Tally tally;
  for (const KindPair& kinds : convex_kind_pairs()) {
    check_motions(GetParam(), kinds, motion_count(kinds, 24), ++seed, tally);
    if (HasFatalFailure()) return;
  }
  expect_decided(GetParam(), tally);
}

INSTANTIATE_TEST_SUITE_P(Families, HardMotions, testing::ValuesIn(hard_motions()), motion_name);

// (B, A) has the same impacts as (A, B), up to rounding.
TEST(Motions, AreTheSameBothWaysRound) {
  for (const MotionFamily& family : plain_motions()) {
    for (const KindPair& kinds : convex_kind_pairs()) {
      const auto pairs = make_motions(family, kinds, 20);
      std::vector<MovedPair> others;
      for (const MovedPair& pair : pairs) others.push_back(swapped(pair));
      const auto rows = run_impacts(pairs, impact_call(family.positions));
      const auto other_rows = run_impacts(others, impact_call(family.positions));
      for (size_t i = 0; i < pairs.size(); ++i) {
        const float toi = rows[i].toi, other = other_rows[i].toi;
        EXPECT_EQ(rows[i].is_impact(), other_rows[i].is_impact()) << show(pairs[i]);
        if (rows[i].is_impact() && other_rows[i].is_impact()) {
          EXPECT_NEAR(toi, other, 1e-6f * toi + 1e-9f) << show(pairs[i]);
        }
        EXPECT_EQ(rows[i].status, other_rows[i].status) << show(pairs[i]);
      }
    }
  }
}

// Bodies that move apart along the normal never meet.
TEST(Motions, ThatPartNeverMeet) {
  const MotionFamily parting{
      .name = "", .plan = MotionPlan::parting, .positions = PositionType::float64};
  for (const KindPair& kinds : convex_kind_pairs()) {
    const std::vector<MovedPair> pairs = make_motions(parting, kinds, 20);
    const std::vector<ImpactRow> rows = run_impacts(pairs, impact_call(PositionType::float64));
    for (size_t i = 0; i < pairs.size(); ++i) {
      EXPECT_EQ(rows[i].toi, kNever) << show(pairs[i]);
    }
  }
}

}  // namespace
}  // namespace carom::test
