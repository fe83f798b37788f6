// When a world looks for the directions of its pairs, and when it does not.
#include "world/pairs/direction_memory.h"

#include <gtest/gtest.h>

#include "narrowphase/batch/packed_direction.h"

namespace carom::test {
namespace {

constexpr uint32_t kSomeDirection = 0x12345;

// Steps with the pairs (0, 1), (2, 3), ... of `count` bodies from `first` on. All are separate.
class DirectionSteps {
 public:
  // Whether the step used directions, and how many it knew.
  struct Used {
    bool used;
    size_t known;

    bool operator==(const Used&) const = default;
  };

  Used step(uint32_t first, size_t count) {
    std::swap(last_, now_);
    now_.pairs.clear();
    for (uint32_t i = 0; i < count; ++i) now_.pairs.push_back({first + 2 * i, first + 2 * i + 1});
    plan_.test_all(count);
    if (!memory_.starts_step()) {
      now_.direction.clear();
      return {false, 0};
    }
    uint32_t* const direction = memory_.prepare(plan_, last_, Parallelism::none, now_);
    Used used{true, 0};
    for (size_t i = 0; i < count; ++i) {
      used.known += direction[i] == kSomeDirection;
      direction[i] = kSomeDirection;
    }
    memory_.keep(plan_, Parallelism::none, now_);
    return used;
  }

 private:
  DirectionMemory memory_;
  CarryPlan plan_;
  PairHistory last_, now_;
};

TEST(DirectionMemory, KeepsDirectionsOfPairsThatStay) {
  DirectionSteps steps;
  EXPECT_EQ(steps.step(0, 100), (DirectionSteps::Used{true, 0}));
  for (int i = 0; i < 20; ++i) EXPECT_EQ(steps.step(0, 100), (DirectionSteps::Used{true, 100}));
}

TEST(DirectionMemory, AQuarterOfThePairsIsEnough) {
  DirectionSteps steps;
  steps.step(0, 100);
  for (uint32_t i = 1; i < 20; ++i) {
    EXPECT_EQ(steps.step(150 * i, 100), (DirectionSteps::Used{true, 25})) << i;
  }
}

// Each pause is twice as long as the last one. After it one step keeps directions, and the next
// one looks for them.
TEST(DirectionMemory, PausesWherePairsAreNew) {
  DirectionSteps steps;
  uint32_t first = 0;
  const auto with_new_pairs = [&] { return steps.step(first += 1000, 100); };
  for (const int pause : {4, 8, 16, 32, 64, 64}) {
    for (int i = 0; i < 2; ++i) EXPECT_EQ(with_new_pairs(), (DirectionSteps::Used{true, 0}));
    for (int i = 0; i < pause; ++i) EXPECT_FALSE(with_new_pairs().used) << pause << ", " << i;
  }
  EXPECT_TRUE(with_new_pairs().used);
  EXPECT_EQ(steps.step(first, 100), (DirectionSteps::Used{true, 100})) << "the pairs stay";
  EXPECT_EQ(with_new_pairs(), (DirectionSteps::Used{true, 0}));
  for (int i = 0; i < 4; ++i) EXPECT_FALSE(with_new_pairs().used) << "as after the first one";
  EXPECT_TRUE(with_new_pairs().used);
}

TEST(DirectionMemory, OfNoPairsIsNoReasonToPause) {
  DirectionSteps steps;
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(steps.step(0, 0).used);
}

}  // namespace
}  // namespace carom::test
