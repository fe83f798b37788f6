// The caller's floating-point mode, as engines set it.
#pragma once

#include <cfenv>
#include <vector>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace carom::test {

struct FloatMode {
  const char* name;
  unsigned mxcsr;  // bits added to the default
};

inline constexpr FloatMode kDefaultMode{"default", 0};

std::vector<FloatMode> float_modes();

// Sets a mode for its lifetime. On machines without MXCSR it does nothing.
class ScopedFloatMode {
 public:
#if defined(__SSE2__)
  explicit ScopedFloatMode(const FloatMode& mode);
  ~ScopedFloatMode() { _mm_setcsr(saved_); }

 private:
  unsigned saved_;

 public:
#else
  explicit ScopedFloatMode(const FloatMode&) {}
#endif
  ScopedFloatMode(const ScopedFloatMode&) = delete;
  ScopedFloatMode& operator=(const ScopedFloatMode&) = delete;
};

}  // namespace carom::test
