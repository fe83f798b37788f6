// Boxes sorted by cell, which the searches of a grid run through.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/raw_vector.h"
#include "base/scratch.h"
#include "broadphase/grid/box_records.h"
#include "broadphase/grid/cell_grid.h"
#include "broadphase/grid/cell_keys.h"

namespace carom {

class CellRows {
 public:
  // This many rows after the last one can be read.
  static constexpr size_t kPadding = 32;

  // Replaces the contents by the boxes of `source` that take part.
  void build(const BoxSource& source, Parallelism parallelism, Scratch& scratch);

  // Makes the box of a row empty, so that nothing pairs with it any more.
  void clear_row(size_t row);

  const CellGrids& grids() const { return grids_; }
  size_t count() const { return count_; }

  // The columns of corners along axis k of grids().axis. Consecutive columns lie column_stride()
  // apart.
  const float* lower(size_t k) const { return corners_.data() + k * stride_; }
  const float* upper(size_t k) const { return lower(3 + k); }
  size_t column_stride() const { return stride_; }
  LargeVector<uint32_t> body;
  LargeVector<CellKey> key;

  // The first row of each cell. The first row of the next cell is where a cell ends.
  const uint32_t* first_row() const { return first_.data(); }

  struct Range {
    size_t begin, end;
  };
  Range rows_of_grid(size_t g) const;

  // The mean number of boxes in the cell of a box, over a sample of the boxes whose cells are much
  // larger than they. It is great if the boxes lie in a few dense places far apart.
  double crowding() const;

  size_t bytes() const;

 private:
  bool find_cells_of(const BoxSource& source, Parallelism parallelism,
                     std::array<float, 3>& cell_scale);
  void fill_buckets(const BoxSource& source, Parallelism parallelism);
  void sort_bucket(size_t bucket);

  CellGrids grids_;
  size_t count_ = 0;
  size_t stride_ = 0;
  LargeVector<float> corners_;
  LargeVector<uint32_t> first_;

  Surveyor surveyor_;
  std::vector<CellReach> reach_;
  std::vector<uint32_t> offsets_;  // of each task and bucket
  std::vector<uint32_t> bucket_begin_;
  // In scratch memory, only during build().
  std::span<CellKey> keys_;       // of each box of the source
  std::span<uint32_t> order_;     // sorts the records of a bucket
  std::span<BoxRecord> records_;  // by bucket
  int bucket_shift_ = 0;
  size_t buckets_ = 0;
};

}  // namespace carom
