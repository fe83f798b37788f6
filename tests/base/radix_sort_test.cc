#include "base/radix_sort.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "carom/base/thread_arena.h"
#include "oracle/random.h"

namespace carom::test {

using namespace oracle;
namespace {

using Items = std::vector<uint64_t>;

bool key_less(uint64_t x, uint64_t y) { return x >> 32 < y >> 32; }

// Keys of `bits` random bits, at the top or at the bottom. The order of the input tells items
// apart.
Items make_items(size_t count, int bits, bool at_top, uint64_t seed) {
  Random random(seed);
  Items items(count);
  for (size_t i = 0; i < count; ++i) {
    const uint64_t key = bits == 0 ? 0 : (random.bits() & 0xffffffffu) >> (32 - bits);
    // The bits below the key descend, so a sort by all 64 bits would fail the test.
    items[i] = (at_top && bits > 0 ? key << (32 - bits) : key) << 32 | (0xffffffffu - i);
  }
  return items;
}

void expect_sorted(const Items& items, Parallelism parallelism) {
  Items expected = items;
  std::stable_sort(expected.begin(), expected.end(), key_less);
  Items sorted = items;
  Items scratch(7, 42);  // contents of an earlier call
  std::vector<uint32_t> histograms(3, 42);
  radix_sort_by_key(sorted, scratch, histograms, parallelism);
  EXPECT_TRUE(sorted == expected) << items.size() << " items";
}

TEST(RadixSort, IsStable) {
  for (const size_t count : {0, 1, 2, 3, 100, 65535, 65536, 65537, 200000}) {
    for (const int bits : {0, 1, 11, 20, 32}) {
      for (const bool at_top : {false, true}) {
        expect_sorted(make_items(count, bits, at_top, count), Parallelism::none);
      }
    }
  }
}

TEST(RadixSort, OfSortedAndReversedKeys) {
  Items items = make_items(70000, 32, true, 1);
  std::stable_sort(items.begin(), items.end(), key_less);
  expect_sorted(items, Parallelism::none);
  std::reverse(items.begin(), items.end());
  expect_sorted(items, Parallelism::none);
}

TEST(RadixSort, IsTheSameOnThreads) {
  for (const int threads : {2, 4}) {
    ThreadArena arena(threads);
    arena.run([&] {
      for (const int bits : {1, 20, 32}) {
        expect_sorted(make_items(300000, bits, true, 5), arena.parallelism());
      }
    });
  }
}

}  // namespace
}  // namespace carom::test
