#include "broadphase/space_order.h"

#include <algorithm>
#include <numeric>

#include "broadphase/box_source.h"

namespace carom {
namespace {

uint64_t key_of(uint32_t space, size_t box) { return uint64_t{space} << 32 | box; }
uint32_t space_of(uint64_t key) { return static_cast<uint32_t>(key >> 32); }

}  // namespace

bool SpaceOrder::update(const BoundsView& bounds, const uint32_t* space, size_t most) {
  keys_.clear();
  uint32_t greatest = 0;
  for (size_t i = 0; i < bounds.count; ++i) {
    if (!takes_part(bounds, i)) continue;
    keys_.push_back(key_of(space[i], i));
    greatest = std::max(greatest, space[i]);
  }
  if (!std::is_sorted(keys_.begin(), keys_.end()) && !sort_keys(greatest, most)) return false;
  boxes_.resize(keys_.size());
  spaces_.clear();
  first_.clear();
  for (size_t i = 0; i < keys_.size(); ++i) {
    boxes_[i] = static_cast<uint32_t>(keys_[i]);
    if (i == 0 || space_of(keys_[i]) != spaces_.back()) {
      spaces_.push_back(space_of(keys_[i]));
      first_.push_back(static_cast<uint32_t>(i));
    }
    if (i - first_.back() >= most) return false;
  }
  first_.push_back(static_cast<uint32_t>(keys_.size()));
  return true;
}

// Boxes ascend already, so sorting by space is enough. May return false, before it has sorted, if a
// space holds too many.
bool SpaceOrder::sort_keys(uint32_t greatest_space, size_t most) {
  constexpr size_t kCountersPerBox = 4;
  if (greatest_space / kCountersPerBox > keys_.size()) {
    std::sort(keys_.begin(), keys_.end());
    return true;
  }
  counts_.assign(size_t{greatest_space} + 1, 0);
  for (const uint64_t key : keys_) {
    if (++counts_[space_of(key)] > most) return false;
  }
  std::exclusive_scan(counts_.begin(), counts_.end(), counts_.begin(), 0u);
  sorted_.resize(keys_.size());
  for (const uint64_t key : keys_) sorted_[counts_[space_of(key)]++] = key;
  keys_.swap(sorted_);
  return true;
}

std::span<const uint32_t> SpaceOrder::boxes_of(uint32_t space) const {
  const auto found = std::lower_bound(spaces_.begin(), spaces_.end(), space);
  if (found == spaces_.end() || *found != space) return {};
  const auto i = static_cast<size_t>(found - spaces_.begin());
  return boxes().subspan(first(i), first(i + 1) - first(i));
}

size_t SpaceOrder::bytes() const {
  size_t sum = (keys_.capacity() + sorted_.capacity()) * sizeof(uint64_t);
  for (const auto* column : {&counts_, &boxes_, &spaces_, &first_}) {
    sum += column->capacity() * sizeof(uint32_t);
  }
  return sum;
}

}  // namespace carom
