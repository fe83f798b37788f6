// Boxes sorted by cell: the structure that searches run through.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "broadphase/cell_grid.h"
#include "broadphase/cell_keys.h"

namespace carom {

class CellRows {
 public:
  // Rows behind the last can be read, up to this number.
  static constexpr size_t kPadding = 16;

  // Replaces the contents by the boxes of `source` that take part.
  void build(const BoxSource& source, Parallelism parallelism);

  // Empties the box of a row: nothing meets it any more.
  void clear_row(size_t row);

  const CellGrids& grids() const { return grids_; }
  size_t count() const { return count_; }

  // Columns in the order of grids().axis.
  std::array<std::vector<float>, 3> lower, upper;
  std::vector<uint32_t> body;
  std::vector<CellKey> key;

  // The first row of a cell; of the next one: where the cell ends.
  const uint32_t* first_row() const { return first_.data(); }

  struct Range {
    size_t begin, end;
  };
  Range rows_of_grid(size_t g) const;

  size_t bytes() const;

 private:
  struct alignas(32) Record {
    float lower[3], upper[3];
    uint32_t body;
    CellKey key;
  };

  bool find_cells_of(const BoxSource& source, Parallelism parallelism,
                     std::array<float, 3>& cell_scale);
  template <class Visit>
  void for_each_record(const BoxSource& source, size_t begin, size_t end, const Visit& visit) const;
  template <class Items, class KeyOf>
  void start_cells(size_t first, size_t last, size_t first_row, const Items& items,
                   const KeyOf& key_of);
  void sort_at_once(const BoxSource& source);
  void fill_buckets(const BoxSource& source, Parallelism parallelism);
  void sort_bucket(size_t bucket);
  void place(const Record& record);

  CellGrids grids_;
  size_t count_ = 0;
  std::vector<uint32_t> first_;

  Surveyor surveyor_;
  std::vector<CellKey> keys_;  // a box of the source
  std::vector<CellReach> reach_;
  std::vector<uint32_t> offsets_;  // a task and bucket
  std::vector<uint32_t> bucket_begin_;
  std::vector<Record> records_;
  int bucket_shift_ = 0;
  size_t buckets_ = 0;
};

}  // namespace carom
