// Tests one box against a run of boxes: the inner loop of the sweep and of brute force.
#pragma once

#include <cstddef>
#include <cstdint>

#include "broadphase/sweep/box_columns.h"

namespace carom {

struct SearchBox {
  float lower[3];
  float upper[3];
};

// Receives the rows that overlap one box, in ascending order; at most kMaxHits at a time.
class HitSink {
 public:
  static constexpr size_t kMaxHits = 512;
  virtual void add(size_t box_row, const uint32_t* rows, size_t count) = 0;

 protected:
  ~HitSink() = default;
};

// Tests rows [begin, end) of `columns` against every later row. Rows ascend by lower[0], so a row
// stops at the first one that begins after its upper[0].
void sweep_rows(const BoxColumns& columns, size_t begin, size_t end, HitSink& sink);

// The same for rows in any order: each against all later ones before row `last`, and perhaps some
// behind it.
void test_rows(const BoxColumns& columns, size_t begin, size_t end, size_t last, HitSink& sink);

// Tests `box` against the rows from `first_row` on, which ascend by lower[0].
void sweep_box(const BoxColumns& columns, const SearchBox& box, size_t box_row, size_t first_row,
               HitSink& sink);

}  // namespace carom
