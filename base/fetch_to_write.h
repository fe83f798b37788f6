// Memory that is about to be written in order, in one array or in many at a time. Where it lies in
// no cache near the processor, stores would wait for each line in turn.
#pragma once

#include <cstddef>
#include <cstdint>

namespace carom {

// Asks for the memory `ahead` elements behind `place`. It may lie behind the end of the array.
template <class T>
inline void fetch_to_write(const T* place, size_t ahead) {
  const uintptr_t address = reinterpret_cast<uintptr_t>(place) + ahead * sizeof(T);
  __builtin_prefetch(reinterpret_cast<const void*>(address), 1);
}

}  // namespace carom
