// How many rounds random tests run.
#pragma once

#include <algorithm>
#include <cstdint>

namespace carom::test {

// Sanitizers make a round ten times slower and check memory accesses, which hardly differ between
// rounds: a sixteenth of the rounds, at least `least`.
constexpr uint32_t rounds(uint32_t count, uint32_t least = 1) {
#ifdef CAROM_TEST_SANITIZED
  return std::min(count, std::max(count / 16, least));
#else
  static_cast<void>(least);
  return count;
#endif
}

// Pairs of one call: enough for a vector of eight and a tail.
constexpr uint32_t rounds_of_pairs(uint32_t count) { return rounds(count, 9); }

}  // namespace carom::test
