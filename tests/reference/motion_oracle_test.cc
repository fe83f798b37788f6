// The oracle of moving shapes against itself: it accepts the times that it finds, and rejects late,
// early and missed ones.
#include <gtest/gtest.h>

#include <limits>

#include "tests/support/motions.h"
#include "tests/support/rounds.h"

namespace carom::test {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();

float rounded_down(double x) {
  const auto near = static_cast<float>(x);
  return near > x ? std::nextafter(near, -1.0f) : near;
}

Fault fault(const MovedPair& pair, float toi) { return judge(pair, toi).fault; }

// Whether the pair is clearly separate at `from` and clearly overlaps at `to`, by more than 1e-8 of
// size and travel.
bool is_plain(const MovingPair<double>& pair, double from, double to) {
  const MotionMoment<double> before(pair, from, 0), after(pair, to, 0);
  const double least = 1e-8 * (pair.size() + pair.travel());
  return before.lower() > least && after.upper() < 0 && -after.lower() > least;
}

void check_judgement(const MovedPair& moved, bool may_be_unknown) {
  const MovingPair<double> pair = moving_pair<double>(moved);
  const ImpactBracket<double> found = impact(moved);
  if (may_be_unknown && found.meeting == Meeting::unknown) return;
  ASSERT_NE(found.meeting, Meeting::unknown);
  if (found.meeting == Meeting::none) {
    EXPECT_EQ(fault(moved, kNever), Fault::none);
    return;
  }
  EXPECT_EQ(fault(moved, rounded_down(found.low)), Fault::none);
  if (found.low == 0 || found.low > 1 - 1e-4) return;
  const double sooner = found.low * 0.999, later = found.low + 1e-4;
  if (!is_plain(pair, sooner, later)) return;
  EXPECT_EQ(fault(moved, rounded_down(sooner)), Fault::early);
  EXPECT_EQ(fault(moved, rounded_down(later)), Fault::late);
  EXPECT_EQ(fault(moved, kNever), Fault::late);
}

TEST(MotionOracleTest, JudgesWhatItFinds) {
  std::vector<MotionFamily> families = plain_motions();
  for (const MotionFamily& family : hard_motions()) families.push_back(family);
  uint64_t seed = 1;
  for (const MotionFamily& family : families) {
    for (const KindPair& kinds : convex_kind_pairs()) {
      SCOPED_TRACE(std::string(family.name) + " " + name(kinds));
      for (const MovedPair& pair : make_motions(family, kinds, rounds(5), ++seed)) {
        const ShownIfFailed shown([&] { return show(pair); });
        check_judgement(pair, family.through_contact);
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

TEST(MotionOracleTest, NothingButTimesIsATime) {
  const MovedPair pair{{sphere(0, 0, 0, 1), sphere(1, 0, 0, 1)}, {}, {}};
  for (const float toi : {-kNever, -1.0f, 1.5f, std::nanf("")}) {
    EXPECT_EQ(fault(pair, toi), Fault::malformed) << toi;
  }
}

}  // namespace
}  // namespace carom::test
