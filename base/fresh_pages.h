// Memory of long arrays: in large pages of the system, where it gives them, and touched before the
// array grows into it.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

namespace carom {

// Prepares memory that nothing has touched yet. Asks the system to back it with pages of 2 MB, so
// far as it covers whole ones: touching it for the first time then takes a fraction of the time.
// All pages of an array of up to 16 MB are touched now: a list that has room for more than it
// holds, and holds most in a later frame, would otherwise wait for the system in that frame.
void prepare_pages(void* memory, size_t bytes);

// The standard allocator with such memory.
template <class T>
struct LargeAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = LargeAllocator<U>;
  };

  T* allocate(size_t count) {
    T* const memory = std::allocator<T>::allocate(count);
    prepare_pages(memory, count * sizeof(T));
    return memory;
  }
};

// resize() for a list that is written as a whole afterwards. New memory does not keep what the list
// held, and has room for an eighth more.
template <class T, class Allocator>
void resize_for_overwriting(std::vector<T, Allocator>& list, size_t count) {
  if (list.capacity() < count) {
    list.clear();
    list.reserve(count + count / 8);
    // Allocators of our own have prepared the pages.
    if constexpr (std::is_same_v<Allocator, std::allocator<T>>) {
      prepare_pages(list.data(), list.capacity() * sizeof(T));
    }
  }
  list.resize(count);
}

}  // namespace carom
