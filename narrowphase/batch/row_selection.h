// Selects rows of a batch as a batch of their own, which kernels may read in whole vectors.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "narrowphase/batch/batch.h"
#include "narrowphase/batch/column_memory.h"
#include "narrowphase/batch/pack_rows.h"

namespace carom {

class RowSelection {
 public:
  explicit RowSelection(const Batch& batch) : batch_(batch) {}

  template <class Wanted>
  void select(const Wanted& wanted) {
    count_ = 0;
    for (size_t row = 0; row < batch_.count; ++row) {
      rows_[count_] = static_cast<uint16_t>(row);
      pairs_[count_] = batch_.pairs[row];
      count_ += wanted(row);
    }
    pad();
  }

  // Selects the rows whose byte in `wanted` is 1, packs these columns of theirs, and repeats the
  // last row to fill whole vectors. Columns have room for kPairsPerBlock rows.
  void pack(const uint8_t* wanted, std::span<const PackedColumn> columns) {
    count_ = pack_rows(wanted, batch_.count, {batch_.pairs, pairs_.data(), rows_.data()}, columns);
    if (count_ == 0) return;
    pad();
    for (const PackedColumn& column : columns) {
      std::fill(column.to + count_, column.to + padded_count(), column.to[count_ - 1]);
    }
  }

  // Selects the rows of a list.
  void select(const uint32_t* rows, size_t count) {
    count_ = count;
    for (size_t i = 0; i < count; ++i) {
      rows_[i] = static_cast<uint16_t>(rows[i]);
      pairs_[i] = batch_.pairs[rows[i]];
    }
    pad();
  }

  size_t count() const { return count_; }
  // count(), rounded up to whole vectors; the last row is repeated to fill them.
  size_t padded_count() const { return (count_ + kMostLanes - 1) / kMostLanes * kMostLanes; }

  // The selected rows as a batch for `pass`. `unsure`, `features` and `shells` are nullptr.
  Batch batch(Pass pass) const {
    Batch selected = batch_;
    selected.pass = pass;
    selected.unsure = nullptr;
    selected.features = nullptr;
    selected.shells = nullptr;
    selected.pairs = pairs_.data();
    selected.pairs_are_rows = false;
    selected.count = count_;
    return selected;
  }

  const uint16_t* rows() const { return rows_.data(); }

  template <class T>
  void gather(const T* from, T* to) const {
    for (size_t i = 0; i < padded_count(); ++i) to[i] = from[rows_[i]];
  }
  template <class T>
  void scatter(const T* from, T* to) const {
    for (size_t i = 0; i < count_; ++i) to[rows_[i]] = from[i];
  }
  // Copies the columns that both have and the detail fills.
  void scatter(const ResultColumns& from, const ResultColumns& to, Detail detail) const {
    copy_rows(from, to, detail, count_, [rows = rows()](size_t i) { return rows[i]; });
  }

 private:
  void pad() {
    for (size_t i = count_; i < padded_count(); ++i) {
      rows_[i] = rows_[count_ - 1];
      pairs_[i] = pairs_[count_ - 1];
    }
  }

  const Batch& batch_;
  size_t count_ = 0;
  std::array<uint16_t, kPairsPerBlock + 1> rows_;
  std::array<Pair, kPairsPerBlock + 1> pairs_;
};
static_assert(kPairsPerBlock % kMostLanes == 0);

}  // namespace carom
