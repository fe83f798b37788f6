// One list a block of a parallel loop, put together in block order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/parallel.h"

namespace carom {

// Lists keep their memory from use to use.
template <class T>
class BlockLists {
 public:
  // `blocks` empty lists.
  void reset(size_t blocks) {
    if (lists_.size() < blocks) lists_.resize(blocks);
    for (size_t i = 0; i < blocks; ++i) lists_[i].items.clear();
    blocks_ = blocks;
  }

  size_t blocks() const { return blocks_; }
  std::vector<T>& operator[](size_t block) { return lists_[block].items; }
  const std::vector<T>& operator[](size_t block) const { return lists_[block].items; }

  size_t total() const {
    size_t sum = 0;
    for (size_t i = 0; i < blocks_; ++i) sum += lists_[i].items.size();
    return sum;
  }

  // All items in block order.
  void concatenate(std::vector<T>& out, Parallelism parallelism) {
    size_t first = 0;
    for (size_t i = 0; i < blocks_; ++i) {
      lists_[i].first = first;
      first += lists_[i].items.size();
    }
    out.resize(first);
    for_each_block(blocks_, 1, parallelism, [&](size_t i, size_t, size_t) {
      std::copy(lists_[i].items.begin(), lists_[i].items.end(), out.begin() + lists_[i].first);
    });
  }

  size_t bytes() const {
    size_t sum = lists_.capacity() * sizeof(List);
    for (const List& list : lists_) sum += list.items.capacity() * sizeof(T);
    return sum;
  }

 private:
  // A cache line each: two threads that append do not share one.
  struct alignas(64) List {
    std::vector<T> items;
    size_t first = 0;
  };

  std::vector<List> lists_;
  size_t blocks_ = 0;
};

}  // namespace carom
