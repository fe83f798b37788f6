// The sort of found pairs, against std::sort.
#include "broadphase/sort/sort_pairs.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>

#include "broadphase/sort/merge_pairs.h"
#include "carom/base/thread_arena.h"
#include "oracle/random.h"
#include "tests/support/isas.h"

namespace carom::test {

using namespace oracle;
namespace {

using Pairs = std::vector<Pair>;

// Spreads pairs over lists, some of which stay empty.
class Lists {
 public:
  Lists(const Pairs& pairs, size_t lists, Random& random) {
    found_.start(pairs.size());
    found_.add(lists);
    const size_t used = 1 + random.below(lists);
    size_t list = 0;
    for (const Pair& pair : pairs) {
      if (random.chance(0.3)) list = random.below(used);
      *found_[list].reserve(1) = pair;
      found_[list].commit(1);
    }
  }

  std::span<const PairList> view() const { return found_.lists(); }

 private:
  FoundPairs found_;
};

void shuffle(Pairs& pairs, Random& random) {
  for (size_t k = pairs.size(); k > 1; --k) std::swap(pairs[k - 1], pairs[random.below(k)]);
}

// Adds `count` partners with higher indices for body a, or as many as exist.
void add_partners(uint32_t a, size_t count, size_t bodies, Random& random, Pairs& pairs) {
  const size_t above = bodies - a - 1;
  if (count >= above / 2) {
    for (size_t i = 0; i < std::min(count, above); ++i) {
      pairs.push_back({a, static_cast<uint32_t>(bodies - 1 - i)});
    }
    return;
  }
  std::set<uint32_t> partners;
  while (partners.size() < count) {
    partners.insert(static_cast<uint32_t>(a + 1 + random.below(above)));
  }
  for (const uint32_t b : partners) pairs.push_back({a, b});
}

testing::AssertionResult sorts(PairSorter& sorter, Pairs pairs, size_t bodies, size_t lists,
                               Random& random, Parallelism parallelism = Parallelism::none) {
  shuffle(pairs, random);
  const Lists found(pairs, lists, random);
  Pairs got = {{1, 1}};
  Scratch scratch;
  sorter.sort(found.view(), bodies, parallelism, got, scratch);
  std::sort(pairs.begin(), pairs.end());
  if (got == pairs) return testing::AssertionSuccess();
  return testing::AssertionFailure()
         << pairs.size() << " pairs of " << bodies << " bodies in " << lists << " lists";
}

constexpr size_t kPartnerCounts[] = {0,  1,  2,  3,  4,  5,  7,  8,  9,  15,
                                     16, 17, 31, 33, 63, 64, 65, 66, 199};

TEST(PairSorter, OfBodiesWithAnyNumberOfPartners) {
  for_each_isa([] {
    Random random(1);
    PairSorter sorter;
    for (const size_t count : kPartnerCounts) {
      // all: every body has as many partners; few: few bodies have any; ends: only the first body
      // and the last that can.
      Pairs all, few, ends;
      for (uint32_t a = 0; a < 300; ++a) add_partners(a, count, 600, random, all);
      for (uint32_t a = 0; a < 600; a += 97) add_partners(a, count, 600, random, few);
      add_partners(0, count, 600, random, ends);
      add_partners(static_cast<uint32_t>(599 - count), count, 600, random, ends);
      for (const Pairs& pairs : {all, few, ends}) {
        for (const size_t lists : {1, 7}) ASSERT_TRUE(sorts(sorter, pairs, 600, lists, random));
      }
    }
  });
}

TEST(PairSorter, OfAnyNumberOfBodies) {
  for_each_isa([] {
    Random random(2);
    PairSorter sorter;
    for (const size_t bodies : {1, 2, 3, 16, 17, 4096, 16383, 16384, 16385, 32768, 40000}) {
      for (const size_t wanted : {0, 1, 100, 5000, 30000}) {
        Pairs pairs;
        while (pairs.size() < wanted && bodies > 1) {
          // Half of the bodies are near the end, in the last bucket.
          const size_t range = random.chance(0.5) ? std::min<size_t>(bodies, 300) : bodies;
          const auto a = static_cast<uint32_t>(bodies - 1 - random.below(range));
          if (a + 1 < bodies) {
            const size_t above = std::min<size_t>(30, bodies - a - 1);
            pairs.push_back({a, static_cast<uint32_t>(a + 1 + random.below(above))});
          }
          if (bodies < 10 && pairs.size() > 3) break;
        }
        std::sort(pairs.begin(), pairs.end());
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
        ASSERT_TRUE(sorts(sorter, pairs, bodies, 1 + random.below(40), random));
      }
    }
  });
}

TEST(PairSorter, OnThreads) {
  ThreadArena arena(4);
  arena.run([&] {
    Random random(3);
    PairSorter sorter;
    for (const size_t bodies : {1, 2, 100, 5000, 16384, 65536, 100000}) {
      for (const double mean : {0.01, 0.6, 4.0}) {
        Pairs pairs;
        for (uint32_t a = 0; a < bodies; ++a) {
          const double share = random.uniform(0, 1);
          add_partners(a, static_cast<size_t>(2 * mean * share + random.uniform(0, 1)), bodies,
                       random, pairs);
        }
        ASSERT_TRUE(sorts(sorter, pairs, bodies, 50, random, arena.parallelism()));
      }
    }
  });
}

TEST(PairSorter, OfNoListsAndOfBodiesBeyondTheLists) {
  Random random(4);
  PairSorter sorter;
  Pairs got = {{1, 2}};
  Scratch scratch;
  sorter.sort({}, 0, Parallelism::none, got, scratch);
  EXPECT_TRUE(got.empty());
  sorter.sort({}, 100000, Parallelism::none, got, scratch);
  EXPECT_TRUE(got.empty());
  // Many bodies with large indices.
  const uint32_t top = (1u << 22) - 1;
  EXPECT_TRUE(
      sorts(sorter, {{top - 1, top}, {0, top}, {0, 1}, {top - 2, top}}, top + 1, 3, random));
}

RC_GTEST_PROP(PairSorter, OfAnyPairs, (uint64_t seed)) {
  Random random(seed);
  PairSorter sorter;
  const size_t bodies = 1 + random.below(random.chance(0.1) ? 40000 : 300);
  Pairs pairs;
  const double dense = random.uniform(0, 1);
  for (uint32_t a = 0; a < bodies; ++a) {
    if (!random.chance(dense)) continue;
    const size_t most = random.chance(0.02) ? 200 : random.chance(0.1) ? 20 : 5;
    add_partners(a, random.below(most), bodies, random, pairs);
  }
  for (const Isa isa : usable_isas()) {
    const ForcedIsa forced(isa);
    RC_ASSERT(sorts(sorter, pairs, bodies, 1 + random.below(30), random));
  }
}

// --- Merging ---

TEST(MergePairs, OfListsOfAnyLength) {
  ThreadArena arena(4);
  arena.run([&] {
    Random random(5);
    for (const size_t total : {0, 1, 2, 15, 16, 17, 31, 33, 100, 32767, 32768, 32769, 200000}) {
      for (const double share : {0.0, 0.001, 0.1, 0.5, 0.85, 0.99, 1.0}) {
        for (const bool in_runs : {false, true}) {
          Pairs all, a, b;
          bool to_a = true;
          for (uint32_t i = 0; i < total; ++i) {
            all.push_back({i / 5, i % 5 + i / 5 + 1});
            if (!in_runs || random.chance(0.0001)) to_a = random.chance(share);
            (to_a ? a : b).push_back(all.back());
          }
          for (const Parallelism parallelism : {Parallelism::none, arena.parallelism()}) {
            Pairs merged = {{1, 2}};
            merge_pairs(a, b, parallelism, merged);
            ASSERT_TRUE(merged == all) << total << " pairs, " << share;
          }
        }
      }
    }
  });
}

// Bodies compare as unsigned numbers, and by a before b.
TEST(MergePairs, OfTheLargestBodies) {
  Pairs all, a, b;
  for (const uint32_t first : {0u, 1u, 0x7fffffffu, 0x80000000u, 0xfffffffdu}) {
    for (const uint32_t second : {2u, 5u, 0x7ffffffeu, 0x80000001u, 0xfffffffeu, 0xffffffffu}) {
      if (first < second) all.push_back({first, second});
    }
  }
  for (size_t i = 0; i < all.size(); ++i) (i % 3 == 1 ? a : b).push_back(all[i]);
  for (int swapped = 0; swapped < 2; ++swapped) {
    Pairs merged;
    merge_pairs(a, b, Parallelism::none, merged);
    EXPECT_TRUE(merged == all);
    a.swap(b);
  }
}

}  // namespace
}  // namespace carom::test
