// Vectors that do not clear what they grow by.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace carom {

// An allocator that leaves new elements as their memory is. For elements that are written as a
// whole right after resize(): clearing them first costs as much again as writing them.
template <class T>
struct RawAllocator : std::allocator<T> {
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

}  // namespace carom
