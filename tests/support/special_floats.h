// Floats that tests use by name.
#pragma once

#include <limits>

namespace carom::test {

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kLargest = std::numeric_limits<float>::max();
inline constexpr double kEps = 0x1p-23;  // between 1 and the next float

}  // namespace carom::test
