// The boxes that a search takes, and how kernels read them: block by block, in dense columns.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "carom/shapes/views.h"

namespace carom {

// Entry i of one of the six columns.
inline float value_at(const BoundsView& bounds, const float* column, size_t i) {
  return *reinterpret_cast<const float*>(reinterpret_cast<const char*>(column) + i * bounds.stride);
}

// True if lower <= upper on every axis; false for empty boxes and NaN.
inline bool takes_part(const BoundsView& bounds, size_t i) {
  for (size_t axis = 0; axis < 3; ++axis) {
    const float lower = value_at(bounds, bounds.lower[axis], i);
    if (!(lower <= value_at(bounds, bounds.upper[axis], i))) return false;
  }
  return true;
}

// All boxes of a view, or those listed in `members`; nullptr: all.
struct BoxSource {
  const BoundsView& bounds;
  const uint32_t* members = nullptr;
  size_t count = 0;

  explicit BoxSource(const BoundsView& all) : bounds(all), count(all.count) {}
  BoxSource(const BoundsView& all, const uint32_t* which, size_t how_many)
      : bounds(all), members(which), count(how_many) {}

  uint32_t body(size_t i) const { return members ? members[i] : static_cast<uint32_t>(i); }
};

// Up to kBoxes boxes in six columns. Up to kPadding rows after `count` can be read; they are NaN.
struct BoxBlock {
  static constexpr size_t kBoxes = 256;
  static constexpr size_t kPadding = 16;

  std::array<const float*, 3> lower;
  std::array<const float*, 3> upper;
  size_t count;
};

// Reads dense columns in place, and copies all other layouts into its buffer.
class BlockBuffer {
 public:
  // Loads boxes [begin, end) of `source`, at most kBoxes; valid until the next call.
  BoxBlock load(const BoxSource& source, size_t begin, size_t end);

 private:
  alignas(64) std::array<std::array<float, BoxBlock::kBoxes + BoxBlock::kPadding>, 6> columns_;
};

}  // namespace carom
