// Hands out indices from 0, the lowest free one first. Free indices at the end are dropped.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "world/store/columns.h"

namespace carom {

class IndexPool {
 public:
  uint32_t take();
  void release(uint32_t index);

  size_t end() const { return used_.size(); }  // highest index in use + 1
  size_t size() const { return size_; }        // indices in use
  bool is_used(uint32_t index) const { return used_[index]; }

  // The free indices below end(), in no order.
  const std::vector<uint32_t>& free_indices();

  void give_back();
  size_t bytes() const { return bytes_of(used_) + bytes_of(free_); }

 private:
  void drop_free_at_end();
  void forget_dropped();

  std::vector<uint8_t> used_;
  size_t size_ = 0;
  // A min-heap of the free indices. It may also hold dropped ones, which are all above the others,
  // until forget_dropped().
  std::vector<uint32_t> free_;
};

}  // namespace carom
