// How many rounds random tests run.
#pragma once

#include <cstdint>

namespace carom::test {

// Sanitizers make a round ten times slower and check memory accesses, which hardly differ between
// rounds.
constexpr uint32_t rounds(uint32_t count) {
#ifdef CAROM_TEST_SANITIZED
  return count / 8;
#else
  return count;
#endif
}

}  // namespace carom::test
