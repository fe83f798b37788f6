// Comparing the boxes of two frames: every place, every column, any bits, on every instruction set.
#include "broadphase/resting/compare_boxes.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <utility>
#include <vector>

#include "oracle/random.h"
#include "tests/support/isas.h"
#include "tests/support/special_floats.h"

namespace carom::test {
namespace {

// Six columns with rows after the last one that may be read, and hold anything.
class BoxColumnsOf {
 public:
  explicit BoxColumnsOf(size_t count) : count_(count) {
    oracle::Random random(count);
    for (auto& column : columns) {
      for (size_t i = 0; i < count + BoxBlock::kPadding; ++i) {
        column.push_back(static_cast<float>(random.uniform(-1, 1)));
      }
    }
  }

  BoxBlock block() const {
    return {{columns[0].data(), columns[1].data(), columns[2].data()},
            {columns[3].data(), columns[4].data(), columns[5].data()},
            count_};
  }
  std::array<const float*, 6> last() const {
    std::array<const float*, 6> all;
    for (size_t column = 0; column < 6; ++column) all[column] = columns[column].data();
    return all;
  }

  std::array<std::vector<float>, 6> columns;

 private:
  size_t count_;
};

// The boxes that differ, as the kernel says.
std::vector<size_t> differing(const BoxColumnsOf& now, const BoxColumnsOf& last) {
  BoxFlags flags;
  const bool any = compare_boxes(now.block(), last.last(), flags);
  std::vector<size_t> boxes;
  for (size_t i = 0; i < now.block().count; ++i) {
    if (flags[i] != 0) boxes.push_back(i);
  }
  EXPECT_EQ(any, !boxes.empty());
  return boxes;
}

TEST(CompareBoxes, FindsOneDifferenceInAnyPlace) {
  for_each_isa([] {
    for (const size_t count : {0, 1, 3, 4, 5, 7, 8, 9, 15, 16, 17, 255, 256}) {
      const BoxColumnsOf last(count);
      BoxColumnsOf now(count);
      for (auto& column : now.columns) column[count] = 7;  // no box
      EXPECT_TRUE(differing(now, last).empty()) << count;
      for (size_t i = 0; i < count; ++i) {
        float& number = now.columns[i % 6][i];
        const float before = std::exchange(number, number + 1);
        EXPECT_EQ(differing(now, last), std::vector<size_t>{i}) << count;
        number = before;
      }
    }
  });
}

TEST(CompareBoxes, ComparesBits) {
  const float other_nan = std::bit_cast<float>(std::bit_cast<uint32_t>(kNan) + 1);
  for_each_isa([&] {
    for (size_t column = 0; column < 6; ++column) {
      BoxColumnsOf last(20), now(20);
      last.columns[column][17] = now.columns[column][17] = kNan;
      EXPECT_TRUE(differing(now, last).empty());
      now.columns[column][17] = other_nan;
      EXPECT_EQ(differing(now, last), std::vector<size_t>{17});
      last.columns[column][17] = 0.0f;
      now.columns[column][17] = -0.0f;
      now.columns[(column + 1) % 6][3] = kInfinity;
      EXPECT_EQ(differing(now, last), (std::vector<size_t>{3, 17}));
    }
  });
}

}  // namespace
}  // namespace carom::test
