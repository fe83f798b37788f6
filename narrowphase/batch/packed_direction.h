// Unit vectors in 32 bits, ten a component: precise enough to test whether two shapes are still
// separate along them.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace carom {

inline constexpr float kDirectionSteps = 486;  // from 0 to 1; components up to 1.05 still fit
inline constexpr float kDirectionZero = 512;
inline constexpr uint32_t kNoDirection = 0;

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
