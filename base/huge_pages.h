// Memory of large arrays in large pages of the system, where it gives them.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace carom {

// Asks the system to back this memory, which nothing has touched yet, with pages of 2 MB, so far as
// it covers whole ones. Touching it for the first time then takes a fraction of the time.
void prefer_huge_pages(void* memory, size_t bytes);

// The standard allocator with large pages.
template <class T>
struct LargeAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = LargeAllocator<U>;
  };

  T* allocate(size_t count) {
    T* const memory = std::allocator<T>::allocate(count);
    prefer_huge_pages(memory, count * sizeof(T));
    return memory;
  }
};

// resize() for a long list with the standard allocator, which a caller handed in. New memory does
// not keep what the list held, and has room for an eighth more.
template <class T>
void resize_for_overwriting(std::vector<T>& list, size_t count) {
  if (list.capacity() < count) {
    list.clear();
    list.reserve(count + count / 8);
    prefer_huge_pages(list.data(), list.capacity() * sizeof(T));
  }
  list.resize(count);
}

}  // namespace carom
