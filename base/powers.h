// Powers of two, by the bits of doubles: the functions of the standard library are calls.
#pragma once

#include <bit>
#include <cstdint>

namespace carom {

// 2 to this power, from -1022 to 1023.
inline double power_of_two(int exponent) {
  return std::bit_cast<double>(static_cast<uint64_t>(exponent + 1023) << 52);
}

// The exponent of the greatest power of two that is not above |x|. For a number that is not normal
// it is below -1022, for an infinite one or NaN 1024.
inline int exponent_of(double x) {
  return static_cast<int>(std::bit_cast<uint64_t>(x) >> 52 & 0x7ff) - 1023;
}

}  // namespace carom
