// Rows of results: what the reference says they are, what a call wrote, and how they differ.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "carom/narrowphase/collide.h"
#include "tests/support/guarded.h"
#include "tests/support/pairs.h"
#include "tests/support/show.h"

namespace carom::test {

// One row of ResultColumns; fields that are not written hold kUntouched in every byte.
struct Row {
  uint8_t overlap;
  uint8_t status;
  uint8_t unused[2];
  float separation;
  std::array<float, 3> normal;
  std::array<float, 3> point_a;
  std::array<float, 3> point_b;
};
static_assert(sizeof(Row) == 44);

inline constexpr int kUntouched = 0xa5;

inline bool same_bits(const Row& x, const Row& y) { return std::memcmp(&x, &y, sizeof x) == 0; }

inline std::string show(const Row& row) {
  return std::string("overlap ") + std::to_string(row.overlap) + " status " +
         std::to_string(row.status) + " separation " + hex(row.separation) + " normal " +
         hex3(row.normal) + " point_a " + hex3(row.point_a) + " point_b " + hex3(row.point_b);
}

// A witness point in world coordinates: the position as the sum of two floats, so that nothing is
// lost before the last addition.
inline float world_coordinate(double position, float arm, PositionType positions) {
  const float high = static_cast<float>(position);
  if (positions == PositionType::float32) return high + arm;
  const float low = static_cast<float>(position - high);
  return high + (low + arm);
}

inline std::array<float, 3> witness(const PlacedShape& body, const Eigen::Vector3f& arm,
                                    PositionType positions, WitnessFrame frame) {
  std::array<float, 3> point;
  for (int i = 0; i < 3; ++i) {
    point[i] = frame == WitnessFrame::body ? arm[i]
                                           : world_coordinate(body.position[i], arm[i], positions);
  }
  return point;
}

// What the reference says.
inline Row expected_row(const TestPair& pair, PositionType positions, Detail detail,
                        WitnessFrame frame) {
  Row row;
  std::memset(&row, kUntouched, sizeof row);
  std::memset(row.unused, 0, sizeof row.unused);
  if (detail == Detail::pairs) return row;
  const reference::PairResult result = reference_result(pair, positions);
  row.overlap = result.overlap ? 1 : 0;
  row.status = static_cast<uint8_t>(result.status);
  if (detail == Detail::overlap) return row;
  row.separation = result.separation;
  for (int i = 0; i < 3; ++i) row.normal[i] = result.normal[i];
  if (result.status == Status::invalid) {
    row.point_a = row.point_b = row.normal;
  } else {
    row.point_a = witness(pair.a, result.arm_a, positions, frame);
    row.point_b = witness(pair.b, result.arm_b, positions, frame);
  }
  return row;
}

// Guarded columns for `count` results; bit c of `missing` leaves column c out.
class Columns {
 public:
  explicit Columns(size_t count, unsigned missing = 0) : count_(count), missing_(missing) {
    for (int column = 0; column < kColumns; ++column) {
      const size_t element = column < 2 ? 1 : sizeof(float);
      columns_.emplace_back(count, element, element);
    }
  }

  static constexpr int kColumns = 12;

  ResultColumns out() {
    const auto floats = [&](int column) {
      return is_missing(column) ? nullptr : at<float>(column);
    };
    ResultColumns out;
    out.overlap = is_missing(0) ? nullptr : at<uint8_t>(0);
    out.status = is_missing(1) ? nullptr : at<uint8_t>(1);
    out.separation = floats(2);
    for (int i = 0; i < 3; ++i) {
      out.normal[i] = floats(3 + i);
      out.point_a[i] = floats(6 + i);
      out.point_b[i] = floats(9 + i);
    }
    return out;
  }

  Row row(size_t i) const {
    Row row{};
    row.overlap = columns_[0].get<uint8_t>(i);
    row.status = columns_[1].get<uint8_t>(i);
    row.separation = columns_[2].get<float>(i);
    for (int k = 0; k < 3; ++k) {
      row.normal[k] = columns_[3 + k].get<float>(i);
      row.point_a[k] = columns_[6 + k].get<float>(i);
      row.point_b[k] = columns_[9 + k].get<float>(i);
    }
    return row;
  }

  std::vector<Row> rows() const {
    std::vector<Row> rows;
    for (size_t i = 0; i < count_; ++i) rows.push_back(row(i));
    return rows;
  }

 private:
  bool is_missing(int column) const { return missing_ >> column & 1; }

  template <class T>
  T* at(int column) {
    return columns_[column].as<T>();
  }

  size_t count_;
  unsigned missing_;
  std::vector<GuardedArray> columns_;
};

// Fails at the first row that differs, with its inputs.
inline testing::AssertionResult same_rows(std::span<const Row> expected,
                                          std::span<const Row> actual,
                                          std::span<const TestPair> pairs) {
  if (expected.size() != actual.size()) {
    return testing::AssertionFailure() << expected.size() << " rows and " << actual.size();
  }
  for (size_t i = 0; i < expected.size(); ++i) {
    if (same_bits(expected[i], actual[i])) continue;
    return testing::AssertionFailure() << "row " << i << " of " << expected.size() << "\n"
                                       << show(pairs[i]) << "\nexpected " << show(expected[i])
                                       << "\nactual   " << show(actual[i]);
  }
  return testing::AssertionSuccess();
}

inline std::vector<Row> expected_rows(std::span<const TestPair> pairs, PositionType positions,
                                      Detail detail = Detail::contact,
                                      WitnessFrame frame = WitnessFrame::world) {
  std::vector<Row> rows;
  for (const TestPair& pair : pairs) rows.push_back(expected_row(pair, positions, detail, frame));
  return rows;
}

}  // namespace carom::test
