#include "broadphase/grid/cell_rows.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "base/bucket_offsets.h"
#include "base/fetch_ahead.h"
#include "base/fresh_pages.h"

namespace carom {
namespace {

constexpr size_t kBoxesPerBucket = 8192;  // their records fit the second-level cache
constexpr size_t kMostBuckets = 512;
constexpr size_t kRecordsAhead = 6;  // from where a bucket is written to where it is asked for

// The stride of a column of at least `count` floats. Caches repeat their sets every 4 KiB; the
// stride keeps the same row of different columns out of one set.
size_t spread_stride(size_t count) {
  constexpr size_t kLine = 16, kSetPeriod = 1024, kOffset = 9 * kLine;
  const size_t lines = (count + kLine - 1) / kLine * kLine;
  return lines < kSetPeriod ? lines : lines + (kOffset - lines) % kSetPeriod;
}

// Threads share out the buckets: of few boxes each gets several.
size_t boxes_per_bucket(size_t boxes, Parallelism parallelism) {
  if (!uses_threads(parallelism)) return kBoxesPerBucket;
  return std::clamp<size_t>(boxes / kTasksOfFewBoxes, kFewestBoxesPerTask, kBoxesPerBucket);
}

}  // namespace

// A counting sort in two steps: first into buckets of neighbouring cells, each written in order as
// a stream; then by cell within a bucket, in cache.
void CellRows::build(const BoxSource& source, Parallelism parallelism, Scratch& scratch) {
  constexpr size_t kBytesPerBox = sizeof(CellKey) + sizeof(uint32_t) + sizeof(BoxRecord);
  scratch.start(source.count * kBytesPerBox, 3);
  keys_ = scratch.take<CellKey>(source.count);
  order_ = scratch.take<uint32_t>(source.count);
  records_ = scratch.take<BoxRecord>(source.count);

  const Survey& survey = surveyor_.run(source, parallelism);
  count_ = survey.count;
  std::array<float, 3> cell_scale = {1, 1, 1};
  do {
    grids_.choose(survey, source, cell_scale);
  } while (!find_cells_of(source, parallelism, cell_scale));
  stride_ = spread_stride(source.count + kPadding);
  resize_for_overwriting(corners_, 6 * stride_);
  resize_for_overwriting(body, source.count + kPadding);
  resize_for_overwriting(key, source.count + kPadding);
  resize_for_overwriting(first_, grids_.cells + 2);
  first_[0] = 0;
  fill_buckets(source, parallelism);
  for_each_block(buckets_, 1, parallelism,
                 [&](size_t bucket, size_t, size_t) { sort_bucket(bucket); });
}

// Finds the cells of all boxes. If a box reaches further than its grid allows, enlarges
// `cell_scale` and returns false.
bool CellRows::find_cells_of(const BoxSource& source, Parallelism parallelism,
                             std::array<float, 3>& cell_scale) {
  const size_t per_task = boxes_per_task(source.count);
  const size_t tasks = block_count(source.count, per_task);
  const size_t per_bucket = boxes_per_bucket(source.count, parallelism);
  const size_t wanted = std::clamp<size_t>(source.count / per_bucket, 1, kMostBuckets);
  bucket_shift_ = 0;
  while ((grids_.cells >> bucket_shift_) >= wanted) ++bucket_shift_;
  buckets_ = (grids_.cells >> bucket_shift_) + 1;
  if (reach_.size() < tasks) reach_.resize(tasks);
  offsets_.assign(tasks * buckets_, 0);
  for_each_block(source.count, per_task, parallelism, [&](size_t task, size_t begin, size_t end) {
    BlockBuffer buffer;
    CellKey keys[BoxBlock::kBoxes + BoxBlock::kPadding];
    uint32_t* counts = offsets_.data() + task * buckets_;
    reach_[task] = {};
    for (size_t i = begin; i < end; i += BoxBlock::kBoxes) {
      const size_t last = std::min(end, i + BoxBlock::kBoxes);
      find_cells(buffer.load(source, i, last), grids_, keys, reach_[task]);
      std::copy_n(keys, last - i, keys_.data() + i);
      if (buckets_ == 1) {
        counts[0] += static_cast<uint32_t>(last - i);
        continue;
      }
      for (size_t k = 0; k < last - i; ++k) {
        ++counts[keys[k].cell() >> bucket_shift_];
      }
    }
  });
  CellReach reach;
  for (size_t task = 0; task < tasks; ++task) reach.add(reach_[task]);
  bool is_short = true;
  for (size_t k = 0; k < 3; ++k) {
    bool too_far = false;
    for (size_t g = 0; g < grids_.count; ++g) {
      too_far |= reach.cells[g][k] > static_cast<float>(grids_.grid[g].reach[k]);
    }
    if (!too_far) continue;
    is_short = false;
    cell_scale[k] *= 2;
  }
  return is_short;
}

void CellRows::fill_buckets(const BoxSource& source, Parallelism parallelism) {
  const size_t per_task = boxes_per_task(source.count);
  counts_to_offsets(block_count(source.count, per_task), buckets_, offsets_, bucket_begin_);
  const std::array<uint8_t, 3>& axis = grids_.axis;
  for_each_block(source.count, per_task, parallelism, [&](size_t task, size_t begin, size_t end) {
    BlockBuffer buffer;
    uint32_t* offsets = offsets_.data() + task * buckets_;
    for (size_t i = begin; i < end; i += BoxBlock::kBoxes) {
      const BoxBlock block = buffer.load(source, i, std::min(end, i + BoxBlock::kBoxes));
      for (size_t k = 0; k < block.count; ++k) {
        const CellKey box_key = keys_[i + k];
        BoxRecord* const place = &records_[offsets[box_key.cell() >> bucket_shift_]++];
        fetch_to_write(place, kRecordsAhead);
        *place = {{block.lower[axis[0]][k], block.lower[axis[1]][k], block.lower[axis[2]][k]},
                  {block.upper[axis[0]][k], block.upper[axis[1]][k], block.upper[axis[2]][k]},
                  source.body(i + k),
                  box_key};
      }
    }
  });
}

void CellRows::sort_bucket(size_t bucket) {
  const size_t begin = bucket_begin_[bucket];
  const size_t count = bucket_begin_[bucket + 1] - begin;
  const BoxRecord* records = records_.data() + begin;
  const size_t first_cell = bucket << bucket_shift_;
  const size_t last_cell = std::min<size_t>((bucket + 1) << bucket_shift_, grids_.cells + 1);
  // Here each cell begins. The sort moves each entry to where the cell ends, which is where the
  // next one begins.
  uint32_t* next = first_.data() + 1;
  std::fill(next + first_cell, next + last_cell, 0u);
  for (size_t i = 0; i < count; ++i) ++next[records[i].key.cell()];
  auto row = static_cast<uint32_t>(begin);
  for (size_t cell = first_cell; cell < last_cell; ++cell) row += std::exchange(next[cell], row);
  for (size_t i = 0; i < count; ++i) {
    order_[next[records[i].key.cell()]++] = static_cast<uint32_t>(i);
  }
  write_columns(records, order_.data() + begin, count,
                {corners_.data() + begin, stride_, body.data() + begin, key.data() + begin});
}

void CellRows::clear_row(size_t row) {
  float* corner = corners_.data() + row;
  for (size_t k = 0; k < 3; ++k) {
    corner[k * stride_] = std::numeric_limits<float>::quiet_NaN();
    corner[(3 + k) * stride_] = std::numeric_limits<float>::quiet_NaN();
  }
}

CellRows::Range CellRows::rows_of_grid(size_t g) const {
  const size_t begin = first_[grids_.grid[g].first_cell];
  const size_t end = g + 1 < grids_.count ? first_[grids_.grid[g + 1].first_cell] : count_;
  return {begin, end};
}

double CellRows::crowding() const {
  constexpr size_t kSamples = 256;
  const size_t step = count_ / kSamples + 1;
  size_t sum = 0, samples = 0;
  for (size_t g = 0; g < grids_.count; ++g) {
    if (!grids_.grid[g].is_coarse) continue;
    const Range rows = rows_of_grid(g);
    for (size_t row = rows.begin; row < rows.end; row += step, ++samples) {
      const uint32_t* first = first_.data() + key[row].cell();
      sum += first[1] - first[0];
    }
  }
  return samples == 0 ? 0 : static_cast<double>(sum) / static_cast<double>(samples);
}

size_t CellRows::bytes() const {
  size_t sum = surveyor_.bytes() + reach_.capacity() * sizeof(CellReach);
  sum += corners_.capacity() * sizeof(float);
  sum += key.capacity() * sizeof(CellKey);
  for (const size_t numbers :
       {body.capacity(), first_.capacity(), offsets_.capacity(), bucket_begin_.capacity()}) {
    sum += numbers * sizeof(uint32_t);
  }
  return sum;
}

}  // namespace carom
