// By which corners two hulls are nearest, in 64 bits a pair.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace carom {

inline constexpr uint64_t kNoFeatures = 0;
inline constexpr size_t kMostFeatures = 3;

// Point of_a[i] of A and point of_b[i] of B, i < count: corners of B - A. A byte each, from the
// second on; the first is the count.
struct Features {
  size_t count = 0;
  std::array<uint8_t, kMostFeatures> of_a{}, of_b{};
};

inline uint64_t pack_features(const Features& features) {
  uint64_t packed = features.count;
  for (size_t i = 0; i < features.count; ++i) {
    packed |= uint64_t{features.of_a[i]} << (8 + 16 * i);
    packed |= uint64_t{features.of_b[i]} << (16 + 16 * i);
  }
  return packed;
}

// Of any number; the count may be anything, too.
inline Features unpack_features(uint64_t packed) {
  Features features{static_cast<size_t>(packed & 0xff)};
  for (size_t i = 0; i < kMostFeatures; ++i) {
    features.of_a[i] = static_cast<uint8_t>(packed >> (8 + 16 * i));
    features.of_b[i] = static_cast<uint8_t>(packed >> (16 + 16 * i));
  }
  return features;
}

}  // namespace carom
