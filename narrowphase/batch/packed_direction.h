// A pair remembers its last test in 32 bits: a unit vector, ten bits a component, precise enough to
// test whether two shapes are still separate along it; or that they overlapped, and where their
// shell is.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace carom {

inline constexpr float kDirectionSteps = 486;  // from 0 to 1; components up to 1.05 still fit
inline constexpr float kDirectionZero = 512;
inline constexpr uint32_t kNoDirection = 0;
// Any other word from here on is no direction: the pair overlapped, and has no shell. A number of
// steps follows this bit: so long it is not to get one.
inline constexpr uint32_t kOverlapped = uint32_t{1} << 30;
// Or it has one, whose place follows this bit.
inline constexpr uint32_t kHasShell = uint32_t{1} << 31;

inline bool is_direction(uint32_t word) { return word != kNoDirection && word < kOverlapped; }

// kNoDirection if n is not a unit vector.
inline uint32_t pack_direction(const std::array<float, 3>& n) {
  const float squared = (n[0] * n[0] + n[1] * n[1]) + n[2] * n[2];
  const bool is_unit = squared > 0.9f && squared < 1.1f;
  const auto steps = [is_unit](float x) {
    const float value = kDirectionZero + 0.5f + x * kDirectionSteps;
    return static_cast<uint32_t>(static_cast<int32_t>(is_unit ? value : 0));
  };
  return steps(n[0]) | steps(n[1]) << 10 | steps(n[2]) << 20;
}

}  // namespace carom
