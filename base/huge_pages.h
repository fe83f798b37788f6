// Memory of large arrays in large pages of the system, where it gives them.
#pragma once

#include <cstddef>
#include <memory>

namespace carom {

// Asks the system to back this memory, which nothing has touched yet, with large pages. First
// touching a million bodies' results then takes a fraction of the time, and later steps miss fewer
// entries of the page table. Short ranges stay as they are.
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

}  // namespace carom
