// Corners on a circle, the same on every machine.
#pragma once

#include <array>
#include <cstddef>

namespace carom::scalar {

inline constexpr size_t kRimCorners = 16;

// The cosines of sixteenths of a turn.
inline constexpr std::array<double, kRimCorners> kRimCosines = [] {
  constexpr double kOnce = 0x1.d906bcf328d46p-1, kTwice = 0x1.6a09e667f3bcdp-1,
                   kThrice = 0x1.87de2a6aea963p-2;
  return std::array<double, kRimCorners>{1,       kOnce,   kTwice, kThrice, 0,       -kThrice,
                                         -kTwice, -kOnce,  -1,     -kOnce,  -kTwice, -kThrice,
                                         0,       kThrice, kTwice, kOnce};
}();

constexpr double rim_cosine(size_t corner) { return kRimCosines[corner % kRimCorners]; }
constexpr double rim_sine(size_t corner) { return rim_cosine(corner + kRimCorners * 3 / 4); }

}  // namespace carom::scalar
