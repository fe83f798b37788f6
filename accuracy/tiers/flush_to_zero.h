// Sets flush-to-zero and denormals-are-zero, as game engines do.
#pragma once

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace carom::accuracy {

// Sets both modes for the lifetime of the object if `wanted` and the machine has MXCSR.
class FlushToZero {
 public:
#if defined(__SSE2__)
  explicit FlushToZero(bool wanted) : saved_(_mm_getcsr()) {
    if (wanted) _mm_setcsr(saved_ | 0x8040);
  }
  ~FlushToZero() { _mm_setcsr(saved_); }
#else
  explicit FlushToZero(bool) {}
#endif
  FlushToZero(const FlushToZero&) = delete;
  FlushToZero& operator=(const FlushToZero&) = delete;

#if defined(__SSE2__)
 private:
  unsigned saved_;
#endif
};

}  // namespace carom::accuracy
