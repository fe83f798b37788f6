// Memory that is about to be written or read in order, in one array or in many at a time. Where it
// lies in no cache near the processor, stores and loads would wait for each line in turn.
#pragma once

#include <cstddef>
#include <cstdint>

namespace carom {

// The memory `ahead` elements behind `place`. It may lie behind the end of the array.
template <class T>
inline const void* memory_ahead(const T* place, size_t ahead) {
  return reinterpret_cast<const void*>(reinterpret_cast<uintptr_t>(place) + ahead * sizeof(T));
}

// Asks for that memory.
template <class T>
inline void fetch_to_write(const T* place, size_t ahead) {
  __builtin_prefetch(memory_ahead(place, ahead), 1);
}
template <class T>
inline void fetch_to_read(const T* place, size_t ahead) {
  __builtin_prefetch(memory_ahead(place, ahead));
}

// Asks for a run of bytes, as far as L2: processors wait for far fewer lines at a time in L1, and
// do nothing else once they are many. Inlined, as every function that does nothing but ask for
// memory has to be: g++ leaves out calls of them.
[[gnu::always_inline]] inline void fetch_lines(const void* first, size_t bytes) {
  constexpr size_t kLine = 64;
  constexpr int kRead = 0, kIntoL2 = 2;
  for (size_t i = 0; i < bytes; i += kLine) {
    __builtin_prefetch(static_cast<const char*>(first) + i, kRead, kIntoL2);
  }
}

}  // namespace carom
