#include "world/motion/wide_bounds.h"

#include "base/grown.h"
#include "base/parallel.h"
#include "world/store/columns.h"
#include "world/store/row_blocks.h"

namespace carom {

void WideBounds::update(const BoundsView& bounds, const ContactDistances& distances,
                        Parallelism parallelism) {
  for (LargeVector<float>& column : columns_) column.resize(bounds.count);
  for_each_block(bounds.count, kRowsPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const float growth = distances.growth(static_cast<uint32_t>(i));
      const bool grows = growth > 0 && bounds.lower[0][i] <= bounds.upper[0][i];
      for (size_t axis = 0; axis < 3; ++axis) {
        const float lower = bounds.lower[axis][i], upper = bounds.upper[axis][i];
        columns_[axis][i] = grows ? below(lower, growth) : lower;
        columns_[3 + axis][i] = grows ? above(upper, growth) : upper;
      }
    }
  });
}

BoundsView WideBounds::view() const {
  const auto& c = columns_;
  return {{c[0].data(), c[1].data(), c[2].data()},
          {c[3].data(), c[4].data(), c[5].data()},
          c[0].size()};
}

size_t WideBounds::bytes() const {
  size_t sum = 0;
  for (const LargeVector<float>& column : columns_) sum += bytes_of(column);
  return sum;
}

}  // namespace carom
