// Statistics of the boxes of a frame, by which a search lays out its cells.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "broadphase/box_source.h"

namespace carom {

// Tasks that look at all boxes: sixteen, or as many as keep each between these sizes.
inline constexpr size_t kTasksOfFewBoxes = 16;
inline constexpr size_t kFewestBoxesPerTask = 1024, kMostBoxesPerTask = 16384;

// A multiple of a block, so that blocks are full.
inline size_t boxes_per_task(size_t boxes) {
  const size_t per_task =
      std::clamp(boxes / kTasksOfFewBoxes, kFewestBoxesPerTask, kMostBoxesPerTask);
  return block_count(per_task, BoxBlock::kBoxes) * BoxBlock::kBoxes;
}

// Size classes of the longest edge, two an octave, by the upper bits of the float.
inline constexpr int kSizeClassShift = 22;
inline constexpr size_t kSizeClasses = 512;

inline size_t size_class(float longest_edge) {
  return std::bit_cast<uint32_t>(longest_edge) >> kSizeClassShift;
}

// The largest float of a class; infinite if the class holds edges beyond the range of float32.
inline float largest_of_class(size_t index) {
  constexpr uint32_t kInfinite = 0x7f800000;
  const auto next = static_cast<uint32_t>((index + 1) << kSizeClassShift);
  return std::bit_cast<float>(std::min(next - 1, kInfinite));
}

// Covers the boxes that take part. Edges are rounded to nearest.
struct Survey {
  std::array<float, 3> lowest, highest;  // range of the lower corners
  std::array<float, 3> longest_edge;
  std::array<uint32_t, kSizeClasses> boxes_of_class;
  size_t count;  // boxes that take part

  void clear();
  void add(const Survey& other);
};

class Surveyor {
 public:
  const Survey& run(const BoxSource& source, Parallelism parallelism);
  size_t bytes() const { return blocks_.capacity() * sizeof(Survey); }

 private:
  Survey total_;
  std::vector<Survey> blocks_;
};

}  // namespace carom
