// Long lists: memory at the rate at which they grow, and large pages.
#include "base/raw_vector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace carom::test {
namespace {

TEST(ReserveAtRate, ForeseesTheOtherParts) {
  RawVector<uint32_t> list(100);
  std::iota(list.begin(), list.end(), 0u);
  reserve_at_rate(list, 101, 1, 10);
  EXPECT_GE(list.capacity(), 1000u);
  EXPECT_LE(list.capacity(), 1200u);
  ASSERT_EQ(list.size(), 100u);
  for (uint32_t i = 0; i < 100; ++i) EXPECT_EQ(list[i], i);
}

TEST(ReserveAtRate, HasRoomForWhatIsAskedFor) {
  RawVector<uint32_t> list;
  reserve_at_rate(list, 80, 0, 10);  // nothing is known yet
  EXPECT_GE(list.capacity(), 90u);
  reserve_at_rate(list, 5000, 9, 10);  // the last part has more than the others
  EXPECT_GE(list.capacity(), 5000u);
}

TEST(ReserveAtRate, KeepsMemoryThatIsEnough) {
  RawVector<uint32_t> list;
  list.reserve(64);
  const uint32_t* const memory = list.data();
  list.resize(32);
  reserve_at_rate(list, 64, 1, 1000);
  EXPECT_EQ(list.data(), memory);
  EXPECT_EQ(list.capacity(), 64u);
}

// Ranges begin and end anywhere; the memory beside them is left alone.
TEST(FreshPages, HoldWhatIsWritten) {
  prepare_pages(nullptr, 0);
  for (const size_t count : {size_t{1}, size_t{1} << 21, (size_t{1} << 21) + 1, size_t{9} << 20}) {
    LargeVector<uint8_t> bytes(count, uint8_t{7});
    prepare_pages(bytes.data() + bytes.size() / 3, bytes.size() / 2);
    EXPECT_EQ(std::accumulate(bytes.begin(), bytes.end(), size_t{0}), 7 * count);
  }
}

// The list has the count that is asked for, keeps memory that is enough, and new memory has room.
template <class List>
void expect_growth() {
  List list(10, 3u);
  const auto* const memory = list.data();
  resize_for_overwriting(list, 4);
  EXPECT_EQ(list, List(4, 3u));
  EXPECT_EQ(list.data(), memory);
  for (const size_t count : {size_t{11}, size_t{3} << 20, size_t{0}, size_t{3} << 20}) {
    resize_for_overwriting(list, count);
    ASSERT_EQ(list.size(), count);
    EXPECT_GE(list.capacity(), count + count / 8);
    std::fill(list.begin(), list.end(), 7u);
  }
}

TEST(FreshPages, ListsGrowWithRoom) {
  expect_growth<std::vector<uint32_t>>();
  expect_growth<LargeVector<uint32_t>>();
}

}  // namespace
}  // namespace carom::test
