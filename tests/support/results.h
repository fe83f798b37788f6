// Rows of results: the rows that the reference expects, the rows that a call wrote, and their
// differences.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "carom/narrowphase/collide.h"
#include "carom/results/result_row.h"
#include "tests/support/guarded.h"
#include "tests/support/pairs.h"
#include "tests/support/show.h"

namespace carom::test {

// A row whose columns were not written holds kUntouched in every byte of their fields.
using Row = ResultRow;

inline constexpr int kUntouched = 0xa5;

std::string show(const ManifoldPoints& manifold);

std::string show(const Row& row);

// A witness point in world coordinates. The position is a sum of two floats, so that only the last
// addition rounds.
float world_coordinate(double position, float arm, PositionType positions);

template <class Arm>
std::array<float, 3> witness(const PlacedShape& body, const Arm& arm, PositionType positions,
                             WitnessFrame frame) {
  std::array<float, 3> point;
  for (int i = 0; i < 3; ++i) {
    point[i] = frame == WitnessFrame::body ? arm[i]
                                           : world_coordinate(body.position[i], arm[i], positions);
  }
  return point;
}

// A result of the reference as a row.
Row row_of(const reference::PairResult& result, const TestPair& pair, PositionType positions,
           Detail detail, WitnessFrame frame);

// The row of the reference for this pair.
Row expected_row(const TestPair& pair, PositionType positions, Detail detail, WitnessFrame frame);

std::vector<reference::PairResult> reference_results(std::span<const TestPair> pairs,
                                                     PositionType positions);

// The rows of these results of the reference.
std::vector<Row> rows_of(std::span<const reference::PairResult> results,
                         std::span<const TestPair> pairs, PositionType positions, Detail detail,
                         WitnessFrame frame = WitnessFrame::world);

// Guarded columns for `count` results, those that every caller has to have; bit c of `missing`
// leaves column c out.
class Columns {
 public:
  explicit Columns(size_t count, unsigned missing = 0);

  static constexpr int kColumns = 14;

  ResultColumns out();

  Row row(size_t i) const;

  std::vector<Row> rows() const;

 private:
  size_t count_;
  unsigned missing_;
  std::vector<GuardedArray> columns_;
};

// Resets the columns in `missing` to their state before the call.
void forget_columns(Row& row, unsigned missing);

// Fails at the first row that differs, with its inputs.
testing::AssertionResult same_rows(std::span<const Row> expected, std::span<const Row> actual,
                                   std::span<const TestPair> pairs);

std::vector<Row> expected_rows(std::span<const TestPair> pairs, PositionType positions,
                               Detail detail = Detail::contact,
                               WitnessFrame frame = WitnessFrame::world);

}  // namespace carom::test
