// Vectors for long lists: in large pages, and without clearing what they grow by.
#pragma once

#include <algorithm>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/fresh_pages.h"

namespace carom {

// A vector whose long arrays lie in large pages.
template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

// An allocator that leaves new elements as their memory is. For elements that are written as a
// whole right after resize(): clearing them first costs as much again as writing them.
template <class T>
struct RawAllocator : LargeAllocator<T> {
  static_assert(std::is_trivially_destructible_v<T>);

  template <class U>
  struct rebind {
    using other = RawAllocator<U>;
  };

  template <class U>
  void construct(U*) noexcept {}
  template <class U, class... Args>
  void construct(U* place, Args&&... args) {
    std::construct_at(place, std::forward<Args>(args)...);
  }
};

template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

// Makes room for `count` elements in a list whose elements come from the first `done` of `total`
// parts. If that takes new memory, there is room for the other parts at the same rate, and in any
// case an eighth more.
template <class T, class Allocator>
void reserve_at_rate(std::vector<T, Allocator>& list, size_t count, size_t done, size_t total) {
  if (count <= list.capacity()) return;
  const double rate =
      static_cast<double>(list.size()) / static_cast<double>(std::max(done, size_t{1}));
  const double expected = rate * static_cast<double>(total) * 1.125;
  list.reserve(std::max(count + count / 8, static_cast<size_t>(expected)));
}

}  // namespace carom
