// Memory for the geometries of k-DOPs.
#include "shapes/dop_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <set>
#include <thread>
#include <vector>

#include "oracle/random.h"
#include "shapes/dop_geometry.h"

namespace carom::test {
namespace {

uintptr_t block_of(const void* place) {
  return reinterpret_cast<uintptr_t>(place) / PlacesInBlocks::kBytesOfBlock;
}

TEST(PlacesInBlocks, LieSideBySide) {
  for (const size_t bytes : {1u, 64u, 65u, 1500u, 60'000u}) {
    SCOPED_TRACE(bytes);
    PlacesInBlocks places(bytes);
    const size_t of_block = places.places_of_block();
    const size_t padded = (bytes + 63) / 64 * 64;
    EXPECT_GE((of_block + 1) * padded + 64, PlacesInBlocks::kBytesOfBlock);
    std::vector<char*> taken;
    for (size_t i = 0; i < 2 * of_block + 1; ++i) {
      taken.push_back(static_cast<char*>(places.take()));
      std::memset(taken.back(), 1, bytes);
      EXPECT_EQ(reinterpret_cast<uintptr_t>(taken[i]) % PlacesInBlocks::kAlignment, 0u);
      if (i % of_block == 0) continue;
      EXPECT_EQ(taken[i], taken[i - 1] + padded);
      EXPECT_EQ(block_of(taken[i]), block_of(taken[i] + bytes - 1));
    }
    for (char* place : taken) places.give_back(place);
  }
}

// Places that are given back are taken again before a new block is.
TEST(PlacesInBlocks, AreTakenAgain) {
  PlacesInBlocks places(1000);
  const size_t count = 3 * places.places_of_block();
  oracle::Random random(91);
  std::vector<void*> taken;
  std::set<uintptr_t> blocks;
  for (size_t i = 0; i < count; ++i) {
    taken.push_back(places.take());
    blocks.insert(block_of(taken.back()));
  }
  EXPECT_EQ(blocks.size(), 3u);
  for (int round = 0; round < 1000; ++round) {
    std::vector<void*> given;
    const size_t some = 1 + random.below(places.places_of_block() / 2);
    for (size_t i = 0; i < some; ++i) {
      const size_t which = random.below(taken.size());
      std::swap(taken[which], taken.back());
      given.push_back(taken.back());
      places.give_back(taken.back());
      taken.pop_back();
    }
    for (size_t i = 0; i < some; ++i) taken.push_back(places.take());
    std::sort(given.begin(), given.end());
    std::vector<void*> found(taken.end() - static_cast<ptrdiff_t>(some), taken.end());
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, given);
  }
  EXPECT_EQ(std::set<void*>(taken.begin(), taken.end()).size(), count);
  for (void* place : taken) places.give_back(place);
}

// One empty block is kept, and taken from before another one is made.
TEST(PlacesInBlocks, AreTakenFromTheEmptyBlockThatIsKept) {
  PlacesInBlocks places(1000);
  void* const first = places.take();
  places.give_back(first);
  for (int round = 0; round < 100; ++round) {
    void* const place = places.take();
    EXPECT_EQ(place, first);
    places.give_back(place);
  }
  // Two blocks that become empty one after the other: one stays.
  std::vector<void*> taken;
  for (size_t i = 0; i < 2 * places.places_of_block(); ++i) taken.push_back(places.take());
  std::set<uintptr_t> blocks;
  for (void* place : taken) {
    blocks.insert(block_of(place));
    places.give_back(place);
  }
  EXPECT_EQ(blocks.size(), 2u);
  void* const place = places.take();
  EXPECT_EQ(block_of(place), block_of(taken.back()));
  places.give_back(place);
}

TEST(PlacesInBlocks, MayBeTakenByAnyThread) {
  PlacesInBlocks places(200);
  std::vector<std::vector<unsigned char*>> taken(4);
  std::atomic<size_t> shared = 0;  // places that two threads had at a time
  std::vector<std::thread> threads;
  for (size_t t = 0; t < taken.size(); ++t) {
    threads.emplace_back([&, t] {
      for (int round = 0; round < 100'000; ++round) {
        auto* const place = static_cast<unsigned char*>(places.take());
        std::memset(place, static_cast<int>(t), 200);
        taken[t].push_back(place);
        if (taken[t].size() < 300) continue;
        std::swap(taken[t].front(), taken[t].back());
        shared += taken[t].back()[0] == t && taken[t].back()[199] == t ? 0 : 1;
        places.give_back(taken[t].back());
        taken[t].pop_back();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(shared, 0u);
  for (size_t t = 0; t < taken.size(); ++t) {
    for (unsigned char* place : taken[t]) {
      EXPECT_TRUE(std::all_of(place, place + 200, [t](unsigned char c) { return c == t; }));
      places.give_back(place);
    }
  }
}

// All else that a k-DOP allocates does not lie between geometries.
TEST(DopGeometry, LiesBesideTheOneMadeBefore) {
  oracle::Random random(92);
  std::vector<std::shared_ptr<const DopGeometry>> geometries;
  size_t near = 0;
  for (size_t i = 0; i < 100; ++i) {
    Dop dop{.kind = DopKind::k26};
    for (size_t slab = 0; slab < kMostSlabs; ++slab) {
      dop.lower[slab] = -static_cast<float>(random.uniform(1, 2));
      dop.upper[slab] = static_cast<float>(random.uniform(1, 2));
    }
    geometries.push_back(dop_geometry(dop));
    ASSERT_TRUE(geometries.back());
    if (i == 0) continue;
    const auto apart = reinterpret_cast<const char*>(geometries[i].get()) -
                       reinterpret_cast<const char*>(geometries[i - 1].get());
    near += apart > 0 && apart < static_cast<ptrdiff_t>(sizeof(DopGeometry) + 128) ? 1 : 0;
  }
  EXPECT_GT(near, 90u);
}

}  // namespace
}  // namespace carom::test
