#include "world/motion/fat_bounds.h"

#include <limits>

#include "base/grown.h"
#include "base/parallel.h"
#include "world/store/columns.h"
#include "world/store/row_blocks.h"

namespace carom {
namespace {

// The fat bounds of a body that only moved exceed the true ones by at most two margins, up to
// rounding. Beyond this many margins the body has shrunk.
constexpr float kMostSlackMargins = 3;

// Whether lower[i] .. upper[i] lies inside the fat bounds, but not far inside. False for NaN.
struct Fit {
  const float* lower;
  const float* upper;
  const float* fat_lower;
  const float* fat_upper;
  float slack;

  uint32_t operator()(size_t i) const {
    const float low = lower[i] - fat_lower[i];
    const float high = fat_upper[i] - upper[i];
    return (low >= 0) & (high >= 0) & (low <= slack) & (high <= slack) & (lower[i] <= upper[i]);
  }
};

}  // namespace

void FatBounds::update(const BoundsView& bounds, float margin, Parallelism parallelism) {
  for (LargeVector<float>& column : columns_) {
    column.resize(bounds.count, std::numeric_limits<float>::quiet_NaN());
  }
  for_each_block(bounds.count, kRowsPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    const size_t count = end - begin;
    std::array<Fit, 3> fit;
    for (size_t axis = 0; axis < 3; ++axis) {
      fit[axis] = {bounds.lower[axis] + begin, bounds.upper[axis] + begin, &columns_[axis][begin],
                   &columns_[3 + axis][begin], kMostSlackMargins * margin};
    }
    uint32_t kept[kRowsPerBlock];
    uint32_t all = 1;
    for (size_t i = 0; i < count; ++i) {
      kept[i] = fit[0](i) & fit[1](i) & fit[2](i);
      all &= kept[i];
    }
    if (all) return;
    for (size_t axis = 0; axis < 3; ++axis) {
      float* lower = &columns_[axis][begin];
      float* upper = &columns_[3 + axis][begin];
      const Fit& old = fit[axis];
      for (size_t i = 0; i < count; ++i) {
        const bool valid = old.lower[i] <= old.upper[i];
        const float new_lower = valid ? below(old.lower[i], margin) : old.lower[i];
        const float new_upper = valid ? above(old.upper[i], margin) : old.upper[i];
        lower[i] = kept[i] ? lower[i] : new_lower;
        upper[i] = kept[i] ? upper[i] : new_upper;
      }
    }
  });
}

BoundsView FatBounds::view() const {
  const auto& c = columns_;
  return {{c[0].data(), c[1].data(), c[2].data()},
          {c[3].data(), c[4].data(), c[5].data()},
          c[0].size()};
}

size_t FatBounds::bytes() const {
  size_t sum = 0;
  for (const LargeVector<float>& column : columns_) sum += bytes_of(column);
  return sum;
}

}  // namespace carom
