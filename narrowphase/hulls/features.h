// The corners by which two hulls are nearest, or overlap, packed into 64 bits per pair.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/tolerances.h"

namespace carom {

inline constexpr uint64_t kNoFeatures = 0;
inline constexpr size_t kMostFeatures = 4;
inline constexpr size_t kFeatureBits = 7;  // per point index
static_assert(kMostLanePoints <= size_t{1} << kFeatureBits);

// Point of_a[i] of A and point of_b[i] of B make corner i of B - A. One to three corners span the
// point nearest to zero; four corners have zero inside.
struct Features {
  size_t count = 0;
  std::array<uint8_t, kMostFeatures> of_a{}, of_b{};
};

// The indices fill the word from the lowest bit; the highest byte is the count.
inline uint64_t pack_features(const Features& features) {
  uint64_t packed = uint64_t{features.count} << 56;
  for (size_t i = 0; i < features.count; ++i) {
    packed |= uint64_t{features.of_a[i]} << (2 * i * kFeatureBits);
    packed |= uint64_t{features.of_b[i]} << ((2 * i + 1) * kFeatureBits);
  }
  return packed;
}

inline size_t feature_count(uint64_t packed) { return static_cast<size_t>(packed >> 56); }

// Accepts any word; the count is not checked.
inline Features unpack_features(uint64_t packed) {
  constexpr uint64_t kMask = (1 << kFeatureBits) - 1;
  Features features{feature_count(packed)};
  for (size_t i = 0; i < kMostFeatures; ++i) {
    features.of_a[i] = static_cast<uint8_t>(packed >> (2 * i * kFeatureBits) & kMask);
    features.of_b[i] = static_cast<uint8_t>(packed >> ((2 * i + 1) * kFeatureBits) & kMask);
  }
  return features;
}

}  // namespace carom
