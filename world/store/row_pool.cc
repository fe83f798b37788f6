#include "world/store/row_pool.h"

#include <algorithm>
#include <functional>

namespace carom {

uint32_t RowPool::take(uint32_t rows) {
  FreeBlocks& free = free_blocks(rows);
  if (free.count == 0) {
    free.heap.clear();
    const auto first = static_cast<uint32_t>(end());
    state_.resize(end() + rows, kUsed);
    return first;
  }
  uint32_t first;
  do {
    std::pop_heap(free.heap.begin(), free.heap.end(), std::greater<>());
    first = free.heap.back();
    free.heap.pop_back();
  } while (!is_free(first, rows));
  --free.count;
  std::fill_n(state_.begin() + first, rows, kUsed);
  return first;
}

void RowPool::release(uint32_t first, uint32_t rows) {
  FreeBlocks& free = free_blocks(rows);
  set_free(first, rows);
  ++free.count;
  if (first + rows == end()) {
    drop_free_at_end();
  } else {
    free.heap.push_back(first);
    std::push_heap(free.heap.begin(), free.heap.end(), std::greater<>());
  }
}

bool RowPool::is_free(uint32_t first, size_t rows) const {
  return first < end() && state_[first] == rows;
}

void RowPool::set_free(uint32_t first, size_t rows) {
  const auto size = static_cast<uint8_t>(rows);
  state_[first] = size;
  std::fill_n(state_.begin() + first + 1, rows - 1, static_cast<uint8_t>(size | kInside));
}

void RowPool::drop_free_at_end() {
  while (!state_.empty() && state_.back() != kUsed) {
    const size_t rows = state_.back() & ~kInside;
    state_.erase(state_.end() - static_cast<ptrdiff_t>(rows), state_.end());
    --free_blocks(rows).count;
  }
  // Where more than half of the entries are dropped ones, going through all of them pays.
  for (size_t rows = 1; rows <= kMostRows; ++rows) {
    if (free_blocks(rows).heap.size() > 2 * free_blocks(rows).count) forget_dropped(rows);
  }
}

void RowPool::forget_dropped(size_t rows) {
  std::vector<uint32_t>& heap = free_blocks(rows).heap;
  std::erase_if(heap, [&](uint32_t first) { return !is_free(first, rows); });
  std::sort(heap.begin(), heap.end());
  heap.erase(std::unique(heap.begin(), heap.end()), heap.end());
}

void RowPool::give_back() {
  carom::give_back(state_);
  for (size_t rows = 1; rows <= kMostRows; ++rows) {
    forget_dropped(rows);
    carom::give_back(free_blocks(rows).heap);
  }
}

size_t RowPool::bytes() const {
  size_t sum = bytes_of(state_);
  for (const FreeBlocks& free : free_) sum += bytes_of(free.heap);
  return sum;
}

}  // namespace carom
