#include "world/results/result_buffer.h"

#include <limits>

#include "base/parallel.h"
#include "world/pairs/pair_history.h"
#include "world/store/columns.h"

namespace carom {

const ResultColumns& ResultBuffer::prepare(const PairRange& range, Detail detail,
                                           std::span<const ColumnRole> wanted) {
  first_row_ = range.first_row;
  rows_ = range.rows;
  if (room_ <= rows_) room_ = rows_ + rows_ / 8 + 1;
  arrays_.resize(room_, detail, wanted);
  columns().overlap[rows_] = 0;
  near_.clear();
  extra_.clear();
  return columns();
}

const float* ResultBuffer::prepare_distances(std::span<const Pair> pairs,
                                             const ContactDistances& distances,
                                             Parallelism parallelism) {
  distances_.resize(pairs.size());
  near_.assign(pairs.size() + 1, 0);
  for_each_block(pairs.size(), kPairsPerMergeBlock, parallelism,
                 [&](size_t, size_t begin, size_t end) {
                   for (size_t i = begin; i < end; ++i) distances_[i] = distances.of(pairs[i]);
                 });
  return distances_.data();
}

void ResultBuffer::reject_apart(std::span<const Pair> pairs, const PresentBounds& bounds,
                                Parallelism parallelism) {
  uint8_t* const overlap = columns().overlap;
  for_each_block(rows_, kPairsPerMergeBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      if (overlap[i] && !bounds.meet(pairs[i])) overlap[i] = 0;
    }
  });
}

void ResultBuffer::find_near(std::span<const Pair> pairs, const PresentBounds& grown,
                             Parallelism parallelism) {
  for_each_block(rows_, kPairsPerMergeBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      float& separation = columns().separation[i];
      near_[i] = columns().overlap[i] == 0 && separation <= distances_[i] && grown.meet(pairs[i]);
      // A test may have rounded the gap of separate bounds to zero.
      if (near_[i]) separation = std::max(separation, std::numeric_limits<float>::min());
    }
  });
}

size_t ResultBuffer::bytes() const {
  return arrays_.bytes() + bytes_of(distances_) + bytes_of(near_) + extra_.bytes();
}

}  // namespace carom
