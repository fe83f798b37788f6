#include "broadphase/cell_rows.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <span>
#include <utility>

namespace carom {
namespace {

constexpr size_t kBoxesPerTask = 16384;
constexpr size_t kBoxesPerBucket = 8192;  // their records fit the second-level cache
constexpr size_t kMostBuckets = 512;

}  // namespace

// A counting sort; of many boxes in two steps: into buckets of neighbouring cells, streams that are
// written in order; then by cell within a bucket, in cache.
void CellRows::build(const BoxSource& source, Parallelism parallelism) {
  const Survey& survey = surveyor_.run(source, parallelism);
  count_ = survey.count;
  std::array<float, 3> cell_scale = {1, 1, 1};
  do {
    grids_.choose(survey, source, cell_scale);
  } while (!find_cells_of(source, parallelism, cell_scale));
  for (size_t k = 0; k < 3; ++k) {
    lower[k].resize(source.count + kPadding);
    upper[k].resize(source.count + kPadding);
  }
  body.resize(source.count + kPadding);
  key.resize(source.count + kPadding);
  first_.resize(grids_.cells + 2);
  first_[0] = 0;
  if (buckets_ == 1) {
    sort_at_once(source);
    return;
  }
  fill_buckets(source, parallelism);
  for_each_block(buckets_, 1, parallelism,
                 [&](size_t bucket, size_t, size_t) { sort_bucket(bucket); });
}

// False if a box reaches further than into the next cell: then `cell_scale` is larger.
bool CellRows::find_cells_of(const BoxSource& source, Parallelism parallelism,
                             std::array<float, 3>& cell_scale) {
  const size_t tasks = block_count(source.count, kBoxesPerTask);
  const size_t wanted = std::clamp<size_t>(source.count / kBoxesPerBucket, 1, kMostBuckets);
  bucket_shift_ = 0;
  while ((grids_.cells >> bucket_shift_) >= wanted) ++bucket_shift_;
  buckets_ = (grids_.cells >> bucket_shift_) + 1;
  keys_.resize(source.count + BoxBlock::kPadding);
  if (reach_.size() < tasks) reach_.resize(tasks);
  offsets_.assign(tasks * buckets_, 0);
  for_each_block(source.count, kBoxesPerTask, parallelism,
                 [&](size_t task, size_t begin, size_t end) {
                   BlockBuffer buffer;
                   CellKey keys[BoxBlock::kBoxes + BoxBlock::kPadding];
                   uint32_t* counts = offsets_.data() + task * buckets_;
                   reach_[task] = {};
                   for (size_t i = begin; i < end; i += BoxBlock::kBoxes) {
                     const size_t last = std::min(end, i + BoxBlock::kBoxes);
                     find_cells(buffer.load(source, i, last), grids_, keys, reach_[task]);
                     std::copy_n(keys, last - i, keys_.data() + i);
                     if (buckets_ == 1) continue;
                     for (size_t k = 0; k < last - i; ++k) {
                       ++counts[keys[k].cell() >> bucket_shift_];
                     }
                   }
                 });
  CellReach reach;
  for (size_t task = 0; task < tasks; ++task) reach.add(reach_[task]);
  bool is_short = true;
  for (size_t k = 0; k < 3; ++k) {
    float farthest = 0;
    for (size_t g = 0; g < grids_.count; ++g) farthest = std::max(farthest, reach.cells[g][k]);
    if (farthest <= 1) continue;
    is_short = false;
    cell_scale[k] *= 2;
  }
  return is_short;
}

void CellRows::fill_buckets(const BoxSource& source, Parallelism parallelism) {
  const size_t tasks = block_count(source.count, kBoxesPerTask);
  bucket_begin_.resize(buckets_ + 1);
  uint32_t offset = 0;
  for (size_t bucket = 0; bucket < buckets_; ++bucket) {
    bucket_begin_[bucket] = offset;
    for (size_t task = 0; task < tasks; ++task) {
      offset += std::exchange(offsets_[task * buckets_ + bucket], offset);
    }
  }
  bucket_begin_[buckets_] = offset;

  records_.resize(source.count);
  for_each_block(source.count, kBoxesPerTask, parallelism,
                 [&](size_t task, size_t begin, size_t end) {
                   uint32_t* offsets = offsets_.data() + task * buckets_;
                   for_each_record(source, begin, end, [&](const Record& record) {
                     records_[offsets[record.key.cell() >> bucket_shift_]++] = record;
                   });
                 });
}

// visit(record) for boxes [begin, end) of the source.
template <class Visit>
void CellRows::for_each_record(const BoxSource& source, size_t begin, size_t end,
                               const Visit& visit) const {
  const std::array<uint8_t, 3>& axis = grids_.axis;
  BlockBuffer buffer;
  for (size_t i = begin; i < end; i += BoxBlock::kBoxes) {
    const BoxBlock block = buffer.load(source, i, std::min(end, i + BoxBlock::kBoxes));
    for (size_t k = 0; k < block.count; ++k) {
      visit(Record{{block.lower[axis[0]][k], block.lower[axis[1]][k], block.lower[axis[2]][k]},
                   {block.upper[axis[0]][k], block.upper[axis[1]][k], block.upper[axis[2]][k]},
                   source.body(i + k),
                   keys_[i + k]});
    }
  }
}

void CellRows::sort_at_once(const BoxSource& source) {
  start_cells(0, grids_.cells + 1, 0, std::span<const CellKey>(keys_.data(), source.count),
              [](CellKey of_box) { return of_box; });
  for_each_record(source, 0, source.count, [&](const Record& record) { place(record); });
}

void CellRows::sort_bucket(size_t bucket) {
  const size_t begin = bucket_begin_[bucket];
  const std::span<const Record> records(records_.data() + begin, bucket_begin_[bucket + 1] - begin);
  const size_t last_cell = std::min<size_t>((bucket + 1) << bucket_shift_, grids_.cells + 1);
  start_cells(bucket << bucket_shift_, last_cell, begin, records,
              [](const Record& record) { return record.key; });
  for (const Record& record : records) place(record);
}

// Notes where cells [first, last) begin, from the boxes in them. Every box that is placed moves its
// cell's mark on; in the end the marks are where the next cells begin.
template <class Items, class KeyOf>
void CellRows::start_cells(size_t first, size_t last, size_t first_row, const Items& items,
                           const KeyOf& key_of) {
  uint32_t* next = first_.data() + 1;
  std::fill(next + first, next + last, 0u);
  for (const auto& item : items) ++next[key_of(item).cell()];
  auto row = static_cast<uint32_t>(first_row);
  for (size_t cell = first; cell < last; ++cell) row += std::exchange(next[cell], row);
}

void CellRows::place(const Record& record) {
  const uint32_t row = first_[record.key.cell() + 1]++;
  for (size_t k = 0; k < 3; ++k) {
    lower[k][row] = record.lower[k];
    upper[k][row] = record.upper[k];
  }
  body[row] = record.body;
  key[row] = record.key;
}

void CellRows::clear_row(size_t row) {
  for (size_t k = 0; k < 3; ++k) {
    lower[k][row] = std::numeric_limits<float>::infinity();
    upper[k][row] = -std::numeric_limits<float>::infinity();
  }
}

CellRows::Range CellRows::rows_of_grid(size_t g) const {
  const size_t begin = first_[grids_.grid[g].first_cell];
  const size_t end = g + 1 < grids_.count ? first_[grids_.grid[g + 1].first_cell] : count_;
  return {begin, end};
}

size_t CellRows::bytes() const {
  size_t sum = surveyor_.bytes() + records_.capacity() * sizeof(Record) +
               reach_.capacity() * sizeof(CellReach);
  for (size_t k = 0; k < 3; ++k) {
    sum += (lower[k].capacity() + upper[k].capacity()) * sizeof(float);
  }
  sum += (key.capacity() + keys_.capacity()) * sizeof(CellKey);
  for (const std::vector<uint32_t>* column : {&body, &first_, &offsets_, &bucket_begin_}) {
    sum += column->capacity() * sizeof(uint32_t);
  }
  return sum;
}

}  // namespace carom
