#include "world/pairs/watched_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "bounds/travel.h"
#include "carom/base/thread_arena.h"
#include "oracle/random.h"
#include "tests/support/isas.h"
#include "world/pairs/due_pairs.h"

namespace carom::test {
namespace {

using oracle::Random;

std::vector<Pair> some_pairs(size_t count, uint32_t bodies, Random& random) {
  std::vector<Pair> pairs;
  for (size_t i = 0; i < count; ++i) {
    pairs.push_back(
        {static_cast<uint32_t>(random.below(bodies)), static_cast<uint32_t>(random.below(bodies))});
  }
  return pairs;
}

bool is_due(Pair pair, uint32_t until, const std::vector<uint32_t>& odometers, uint32_t ahead) {
  const uint32_t sum = odometers[pair.a] + odometers[pair.b] + ahead;
  return static_cast<int32_t>(until - sum) < 0;
}

std::vector<uint32_t> due_of(const PairHistory& pairs, const std::vector<uint32_t>& odometers,
                             uint32_t ahead = 0) {
  std::vector<uint32_t> due;
  for (uint32_t i = 0; i < pairs.pairs.size(); ++i) {
    if (is_due(pairs.pairs[i], pairs.holds_until[i], odometers, ahead)) due.push_back(i);
  }
  return due;
}

TEST(DuePairs, OfAnyNumberAndOfAList) {
  Random random(1);
  std::vector<uint32_t> odometers(50);
  for (uint32_t& odometer : odometers) odometer = static_cast<uint32_t>(random.below(1000)) - 500;
  for (size_t count = 0; count < 70; ++count) {
    PairHistory all;
    all.pairs = some_pairs(count, 50, random);
    std::vector<uint32_t> number;
    std::vector<Pair> listed;
    for (uint32_t i = 0; i < count; ++i) {
      const auto left = static_cast<uint32_t>(random.below(3)) - 1;  // just past, at and before
      const Pair pair = all.pairs[i];
      all.holds_until.push_back(odometers[pair.a] + odometers[pair.b] + 7 + left);
      if (random.below(2) == 0) continue;
      number.push_back(i);
      listed.push_back(pair);
    }
    const uint32_t* const until = all.holds_until.data();
    for_each_isa([&] {
      std::vector<uint32_t> due(count + kDuePadding);
      due.resize(
          find_due_pairs(all.pairs.data(), until, odometers.data(), 7, 0, count, due.data()));
      EXPECT_EQ(due, due_of(all, odometers, 7)) << count;
      std::vector<uint32_t> of_list(number.size() + kDuePadding);
      of_list.resize(find_due_of_list(listed.data(), number.data(), until, odometers.data(), 0,
                                      number.size(), of_list.data()));
      std::vector<uint32_t> expected;
      std::ranges::set_intersection(number, due_of(all, odometers), std::back_inserter(expected));
      EXPECT_EQ(of_list, expected) << count;
    });
  }
}

// Odometers of bodies that creep, some of which tremble, or jump, or fly for a while.
class Crowd {
 public:
  Crowd(uint32_t bodies, Random& random) : random_(random), odometers_(bodies), pace_(bodies) {
    for (uint32_t& pace : pace_) pace = static_cast<uint32_t>(random.below(200));
  }

  const std::vector<uint32_t>& odometers() const { return odometers_; }

  // Returns what no odometer has gained more than.
  uint32_t step() {
    uint32_t most = 0;
    for (size_t i = 0; i < odometers_.size(); ++i) {
      const size_t what = random_.below(20'000);
      uint32_t gained = pace_[i];
      if (what == 0) {
        gained = kJump;
      } else if (what == 1) {
        pace_[i] = 1000 - pace_[i];
      } else if (what < 4000) {
        gained = 0u - std::min(gained, 20u);
      }
      odometers_[i] += gained;
      most = std::max(most, static_cast<uint32_t>(std::max(static_cast<int32_t>(gained), 0)));
    }
    return most;
  }

 private:
  Random& random_;
  std::vector<uint32_t> odometers_, pace_;
};

TEST(WatchedPairs, FindWhatIsDue) {
  constexpr uint32_t kBodies = 300;
  ThreadArena arena(2);
  for (const bool threads : {false, true}) {
    arena.run([&] {
      Random random(2);
      Crowd crowd(kBodies, random);
      WatchedPairs watched;
      PairHistory last;
      size_t short_steps = 0, due_pairs = 0;
      std::vector<uint32_t> due;
      const auto limit = [&](Pair pair) {
        const size_t ticks = random.below(3) == 0 ? random.below(1000) : random.below(200'000);
        return crowd.odometers()[pair.a] + crowd.odometers()[pair.b] + static_cast<uint32_t>(ticks);
      };
      for (int step = 0; step < 400; ++step) {
        const uint32_t gained = crowd.step();
        if (step % 60 == 0) {
          last.pairs = some_pairs(3000, kBodies, random);
          last.holds_until.clear();
          for (const Pair pair : last.pairs) last.holds_until.push_back(limit(pair));
          watched.forget();
        }
        watched.find_due(last, crowd.odometers(), gained,
                         threads ? arena.parallelism() : Parallelism::none, due);
        ASSERT_EQ(due, due_of(last, crowd.odometers())) << step;
        for (const uint32_t i : due) last.holds_until[i] = limit(last.pairs[i]);
        short_steps += watched.is_short();
        due_pairs += due.size();
        if (step == 333) watched.give_back();
      }
      EXPECT_GT(short_steps, 200u);
      EXPECT_LT(short_steps, 399u);
      EXPECT_GT(due_pairs, 10'000u);
    });
  }
}

}  // namespace
}  // namespace carom::test
