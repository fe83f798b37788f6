// How often random tests try.
#pragma once

#include <cstdint>

namespace carom::test {

// Sanitizers make a round ten times slower and look at memory, which differs little from one to the
// next.
constexpr uint32_t rounds(uint32_t count) {
#ifdef CAROM_TEST_SANITIZED
  return count / 8;
#else
  return count;
#endif
}

}  // namespace carom::test
