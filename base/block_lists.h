// Lists that the blocks of a parallel loop fill, one each, and their concatenation in block order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/parallel.h"

namespace carom {

// The lists keep their memory between uses.
template <class T>
class BlockLists {
 public:
  // Starts again with `blocks` empty lists.
  void reset(size_t blocks) {
    if (lists_.size() < blocks) lists_.resize(blocks);
    for (size_t i = 0; i < blocks; ++i) lists_[i].items.clear();
    blocks_ = blocks;
  }

  size_t blocks() const { return blocks_; }
  std::vector<T>& operator[](size_t block) { return lists_[block].items; }
  const std::vector<T>& operator[](size_t block) const { return lists_[block].items; }

  // Finds the places of all lists in one that has all items in block order, and returns its length.
  size_t place() {
    size_t first = 0;
    for (size_t i = 0; i < blocks_; ++i) {
      lists_[i].first = first;
      first += lists_[i].items.size();
    }
    return first;
  }
  size_t first(size_t block) const { return lists_[block].first; }  // after place()

  // Replaces `out` by all items, in block order.
  void concatenate(std::vector<T>& out, Parallelism parallelism) {
    out.resize(place());
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
  // Each list has a cache line of its own, so that two threads that append never share one.
  struct alignas(64) List {
    std::vector<T> items;
    size_t first = 0;
  };

  std::vector<List> lists_;
  size_t blocks_ = 0;
};

}  // namespace carom
