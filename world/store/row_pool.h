// Hands out blocks of a few neighbouring rows of one array, the lowest free block of that size
// first. Free rows at the end are dropped.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "carom/shapes/views.h"
#include "world/store/columns.h"

namespace carom {

class RowPool {
 public:
  // Takes a block of 1 to kMostRows rows, and returns its first row.
  uint32_t take(uint32_t rows);
  void release(uint32_t first, uint32_t rows);

  size_t end() const { return state_.size(); }  // highest row in use + 1

  void give_back();
  size_t bytes() const;

 private:
  // The free blocks of one size.
  struct FreeBlocks {
    // A min-heap of first rows. It may also hold rows that do not begin a free block any more,
    // because the end of the array was dropped, and the same row twice.
    std::vector<uint32_t> heap;
    size_t count = 0;
  };

  FreeBlocks& free_blocks(size_t rows) { return free_[rows - 1]; }
  bool is_free(uint32_t first, size_t rows) const;
  void set_free(uint32_t first, size_t rows);
  void drop_free_at_end();
  void forget_dropped(size_t rows);

  // One byte a row: kUsed, or the size of its free block, with kInside in all rows but the first.
  static constexpr uint8_t kUsed = 0;
  static constexpr uint8_t kInside = 0x80;
  std::vector<uint8_t> state_;
  std::array<FreeBlocks, kMostRows> free_;
};

}  // namespace carom
