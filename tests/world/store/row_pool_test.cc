// The pool of row blocks against plain bookkeeping.
#include "world/store/row_pool.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "oracle/random.h"

namespace carom::test {

using namespace oracle;
namespace {

// Blocks of rows as a map: free blocks stay where they are until the end of the array is free.
class PlainRows {
 public:
  uint32_t take(uint32_t rows) {
    std::set<uint32_t>& free = free_[rows - 1];
    const uint32_t first = free.empty() ? end() : *free.begin();
    free.erase(first);
    blocks_[first] = {rows, true};
    return first;
  }

  void release(uint32_t first) {
    Block& block = blocks_.at(first);
    block.used = false;
    free_[block.rows - 1].insert(first);
    while (!blocks_.empty() && !blocks_.rbegin()->second.used) {
      const auto last = std::prev(blocks_.end());
      free_[last->second.rows - 1].erase(last->first);
      blocks_.erase(last);
    }
  }

  uint32_t end() const {
    return blocks_.empty() ? 0 : blocks_.rbegin()->first + blocks_.rbegin()->second.rows;
  }

 private:
  struct Block {
    uint32_t rows;
    bool used;
  };

  std::map<uint32_t, Block> blocks_;
  std::array<std::set<uint32_t>, kMostRows> free_;
};

struct Taken {
  uint32_t first;
  uint32_t rows;
};

TEST(RowPool, HandsOutTheLowestFreeBlockOfThatSize) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    RowPool pool;
    PlainRows plain;
    std::vector<Taken> taken;
    for (int i = 0; i < 6000; ++i) {
      // The number of blocks grows and shrinks in turns.
      const double growth = (i / 700) % 2 ? 0.25 : 0.65;
      if (taken.empty() || random.chance(growth)) {
        const auto rows = static_cast<uint32_t>(1 + random.below(kMostRows));
        const uint32_t first = pool.take(rows);
        ASSERT_EQ(first, plain.take(rows)) << "seed " << seed << ", action " << i;
        taken.push_back({first, rows});
      } else {
        // Often the block at the end.
        if (random.chance(0.5)) std::swap(taken[random.below(taken.size())], taken.back());
        pool.release(taken.back().first, taken.back().rows);
        plain.release(taken.back().first);
        taken.pop_back();
      }
      ASSERT_EQ(pool.end(), plain.end()) << "seed " << seed << ", action " << i;
    }
    for (const Taken& block : taken) pool.release(block.first, block.rows);
    EXPECT_EQ(pool.end(), 0u);
  }
}

TEST(RowPool, BlocksDoNotOverlap) {
  Random random(7);
  RowPool pool;
  std::vector<Taken> taken;
  std::vector<uint8_t> used;
  const auto mark = [&](const Taken& block, uint8_t value) {
    used.resize(std::max<size_t>(used.size(), block.first + block.rows), 0);
    for (uint32_t k = 0; k < block.rows; ++k) {
      ASSERT_NE(used[block.first + k], value);
      used[block.first + k] = value;
    }
  };
  for (int i = 0; i < 20000; ++i) {
    if (taken.empty() || random.chance((i / 3000) % 2 ? 0.3 : 0.7)) {
      const auto rows = static_cast<uint32_t>(1 + random.below(kMostRows));
      taken.push_back({pool.take(rows), rows});
      mark(taken.back(), 1);
    } else {
      std::swap(taken[random.below(taken.size())], taken.back());
      mark(taken.back(), 0);
      pool.release(taken.back().first, taken.back().rows);
      taken.pop_back();
    }
  }
}

TEST(RowPool, GivesMemoryBackWhenAsked) {
  RowPool pool;
  constexpr uint32_t kBlocks = 60000;
  std::vector<Taken> taken;
  const auto fill = [&] {
    for (uint32_t i = 0; i < kBlocks; ++i) taken.push_back({pool.take(1 + i % 3), 1 + i % 3});
  };
  fill();
  // Released from the front: every block stays free for a while, then the array shrinks at once.
  for (const Taken& block : taken) pool.release(block.first, block.rows);
  taken.clear();
  pool.give_back();
  EXPECT_LT(pool.bytes(), 32u << 10);
  fill();
  while (!taken.empty()) {
    pool.release(taken.back().first, taken.back().rows);
    taken.pop_back();
  }
  pool.give_back();
  EXPECT_LT(pool.bytes(), 32u << 10);
}

}  // namespace
}  // namespace carom::test
