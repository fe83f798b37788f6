#include "world/store/index_pool.h"

#include <algorithm>
#include <functional>

namespace carom {

uint32_t IndexPool::take() {
  ++size_;
  if (size_ > end()) {
    free_.clear();  // it held only dropped indices
    used_.push_back(1);
    return static_cast<uint32_t>(end() - 1);
  }
  std::pop_heap(free_.begin(), free_.end(), std::greater<>());
  const uint32_t index = free_.back();
  free_.pop_back();
  used_[index] = 1;
  return index;
}

void IndexPool::release(uint32_t index) {
  --size_;
  used_[index] = 0;
  if (index + 1 == end()) {
    drop_free_at_end();
  } else {
    free_.push_back(index);
    std::push_heap(free_.begin(), free_.end(), std::greater<>());
  }
}

void IndexPool::drop_free_at_end() {
  while (!used_.empty() && !used_.back()) used_.pop_back();
  // More than half of the entries are dropped ones, so going through all of them pays.
  const size_t free_count = end() - size_;
  if (free_.size() > 2 * free_count) forget_dropped();
}

void IndexPool::forget_dropped() {
  std::erase_if(free_, [&](uint32_t index) { return index >= end(); });
  std::make_heap(free_.begin(), free_.end(), std::greater<>());
}

void IndexPool::give_back() {
  forget_dropped();
  carom::give_back(used_, free_);
}

const std::vector<uint32_t>& IndexPool::free_indices() {
  if (free_.size() != end() - size_) forget_dropped();
  return free_;
}

}  // namespace carom
