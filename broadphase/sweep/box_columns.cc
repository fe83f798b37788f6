#include "broadphase/sweep/box_columns.h"

#include <limits>

namespace carom {
namespace {

constexpr size_t kRowsPerBlock = 8192;

void fill_column(const float* from, size_t stride, const std::vector<uint32_t>& body, size_t begin,
                 size_t end, float* to) {
  const char* base = reinterpret_cast<const char*>(from);
  for (size_t i = begin; i < end; ++i) {
    to[i] = *reinterpret_cast<const float*>(base + body[i] * stride);
  }
}

}  // namespace

void BoxColumns::fill(const BoundsView& bounds, size_t first_axis, Parallelism parallelism) {
  count = body.size();
  for (size_t i = 0; i < 3; ++i) {
    for (std::vector<float>* column : {&lower[i], &upper[i]}) {
      column->resize(count + kPadding);
      std::fill_n(column->begin() + count, kPadding, std::numeric_limits<float>::quiet_NaN());
    }
  }
  for_each_block(count, kRowsPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    for (size_t i = 0; i < 3; ++i) {
      const size_t axis = (first_axis + i) % 3;
      fill_column(bounds.lower[axis], bounds.stride, body, begin, end, lower[i].data());
      fill_column(bounds.upper[axis], bounds.stride, body, begin, end, upper[i].data());
    }
  });
}

size_t BoxColumns::bytes() const {
  size_t sum = body.capacity() * sizeof(uint32_t);
  for (size_t i = 0; i < 3; ++i) sum += (lower[i].capacity() + upper[i].capacity()) * sizeof(float);
  return sum;
}

}  // namespace carom
