#include "broadphase/box_source.h"

#include <algorithm>
#include <limits>

namespace carom {

BoxBlock BlockBuffer::load(const BoxSource& source, size_t begin, size_t end) {
  const BoundsView& bounds = source.bounds;
  BoxBlock block{{}, {}, end - begin};
  const bool dense = !source.members && bounds.stride == sizeof(float);
  for (size_t column = 0; column < 6; ++column) {
    const float* from = column < 3 ? bounds.lower[column] : bounds.upper[column - 3];
    const float*& to = column < 3 ? block.lower[column] : block.upper[column - 3];
    if (dense && block.count % BoxBlock::kPadding == 0) {
      to = from + begin;
      continue;
    }
    float* copy = columns_[column].data();
    for (size_t i = begin; i < end; ++i) copy[i - begin] = value_at(bounds, from, source.body(i));
    std::fill_n(copy + block.count, BoxBlock::kPadding, std::numeric_limits<float>::quiet_NaN());
    to = copy;
  }
  return block;
}

}  // namespace carom
