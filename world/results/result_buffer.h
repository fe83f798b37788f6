// The results of the pairs of a range, from the narrow phase until they become contacts.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "carom/base/parallelism.h"
#include "carom/results/result_arrays.h"
#include "midphase/contact_of_row.h"
#include "midphase/extra_contacts.h"
#include "world/motion/present_bounds.h"
#include "world/results/contact_rows.h"

namespace carom {

// A range of a step's pairs, whose results are found together.
struct PairRange {
  size_t begin, end;       // of the pairs
  size_t first_row, rows;  // of those that are tested, among all that are tested
};

// The columns to which the narrow phase writes the results of a range. Rows are those of CarryPlan.
class ResultBuffer {
 public:
  // Makes room for the results of a range in the columns that the detail fills, and in those
  // optional ones that are wanted. An extra row after them does not overlap; it serves pairs that
  // need no test.
  const ResultColumns& prepare(const PairRange& range, Detail detail,
                               std::span<const ColumnRole> wanted);

  // The contact distance of each pair. Only for worlds that have some: it makes room for the marks
  // of find_near().
  const float* prepare_distances(std::span<const Pair> pairs, const ContactDistances& distances,
                                 Parallelism parallelism);
  // Where contacts beside the first one of a pair are collected; nullptr: nowhere.
  ExtraContacts* extra_of(Detail detail) { return detail == Detail::regions ? &extra_ : nullptr; }

  // Bounds are exact, tests round. So pairs with separate bounds do not overlap, even if the
  // rounded result of the test says that they touch. `pairs`: those of the range.
  void reject_apart(std::span<const Pair> pairs, const PresentBounds& bounds,
                    Parallelism parallelism);
  // Marks the separate pairs that are within their contact distance. Their grown bounds overlap.
  void find_near(std::span<const Pair> pairs, const PresentBounds& grown, Parallelism parallelism);

  uint8_t overlap(size_t row) const { return columns().overlap[place(row)]; }
  // The same of rows that follow one another, of pairs that are all tested.
  const uint8_t* overlaps_from(size_t row) const { return columns().overlap + place(row); }
  bool is_near(size_t row) const { return has_near() && near_[place(row)]; }
  bool has_near() const { return !near_.empty(); }
  // The rows of pairs that are all tested, from this one on.
  PairRows rows_of(std::span<const Pair> pairs, size_t row, std::span<uint32_t> contact) const {
    return {columns(), place(row), pairs, contact};
  }
  Contact contact(size_t row, Pair pair) const {
    return contact_of_row(columns(), place(row), pair);
  }
  // The contacts beside the first one, and how many more there are beyond the limit.
  std::span<const ContactWithPoints> extra(size_t row) const { return extra_.of(place(row)); }
  uint16_t left_out(size_t row) const { return extra_.left_out(place(row)); }
  const PointNames& names(size_t row) const { return columns().point_names[place(row)]; }
  const ManifoldPoints& manifold(size_t row) const { return columns().manifold[place(row)]; }

  size_t bytes() const;

 private:
  const ResultColumns& columns() const { return arrays_.columns(); }
  // Where a row is in the columns. Dropped pairs have the row after the last one of all ranges.
  size_t place(size_t row) const { return std::min(row - first_row_, rows_); }

  size_t first_row_ = 0;
  size_t rows_ = 0;
  size_t room_ = 0;  // rows of the columns: more than the most so far, as a few pairs come and go
  ResultArrays arrays_;
  std::vector<float> distances_;
  std::vector<uint8_t> near_;  // one a row; empty without contact distances
  ExtraContacts extra_;
};

}  // namespace carom
