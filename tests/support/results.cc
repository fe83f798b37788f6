#include "tests/support/results.h"

namespace carom::test {

namespace {

// Visits the columns that every caller has to have, with their numbers.
template <class Visit, class... Columns>
void for_each_needed(const Visit& visit, Columns&&... columns) {
  int number = 0;
  for_each_column(
      [&](const ColumnInfo& info, auto&... column) {
        if (!is_optional(info.role)) visit(number++, column...);
      },
      columns...);
}

// A row of which nothing is written.
Row untouched_row() {
  Row row;
  for_each_needed(
      [](int, auto& field) { std::memset(static_cast<void*>(&field), kUntouched, sizeof field); },
      row);
  return row;
}

}  // namespace

std::string show(const ManifoldPoints& manifold) {
  std::string text;
  for (size_t i = 0; i < manifold.point.size(); ++i) {
    text += " (" + hex3(manifold.point[i]) + ": " + hex(manifold.separation[i]) + ")";
  }
  return text;
}

std::string show(const Row& row) {
  return std::string("overlap ") + std::to_string(row.overlap) + " status " +
         std::to_string(row.status) + " separation " + hex(row.separation) + " normal " +
         hex3(row.normal) + " point_a " + hex3(row.point_a) + " point_b " + hex3(row.point_b) +
         " manifold " + std::to_string(row.manifold_count) + show(row.manifold);
}

float world_coordinate(double position, float arm, PositionType positions) {
  const float high = static_cast<float>(position);
  if (positions == PositionType::float32) return high + arm;
  const float low = static_cast<float>(position - high);
  return high + (low + arm);
}

Row row_of(const reference::PairResult& result, const TestPair& pair, PositionType positions,
           Detail detail, WitnessFrame frame) {
  Row row = untouched_row();
  if (detail == Detail::pairs) return row;
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
  if (detail == Detail::contact) return row;
  row.manifold_count = result.manifold_count;
  row.manifold = result.manifold;
  for (size_t i = 0; i < result.manifold_count; ++i) {
    row.manifold.point[i] = witness(pair.a, result.manifold.point[i], positions, frame);
  }
  return row;
}

Row expected_row(const TestPair& pair, PositionType positions, Detail detail, WitnessFrame frame) {
  return row_of(reference_result(pair, positions), pair, positions, detail, frame);
}

std::vector<reference::PairResult> reference_results(std::span<const TestPair> pairs,
                                                     PositionType positions) {
  std::vector<reference::PairResult> results;
  results.reserve(pairs.size());
  for (const TestPair& pair : pairs) results.push_back(reference_result(pair, positions));
  return results;
}

std::vector<Row> rows_of(std::span<const reference::PairResult> results,
                         std::span<const TestPair> pairs, PositionType positions, Detail detail,
                         WitnessFrame frame) {
  std::vector<Row> rows;
  rows.reserve(pairs.size());
  for (size_t i = 0; i < pairs.size(); ++i) {
    rows.push_back(row_of(results[i], pairs[i], positions, detail, frame));
  }
  return rows;
}

Columns::Columns(size_t count, unsigned missing) : count_(count), missing_(missing) {
  for_each_needed([&]<class T>(int, T*) { columns_.emplace_back(count, sizeof(T), sizeof(T)); },
                  ResultColumns());
}

ResultColumns Columns::out() {
  ResultColumns out;
  for_each_needed(
      [&]<class T>(int number, T*& column) {
        if ((missing_ >> number & 1) == 0) column = columns_[number].as<T>();
      },
      out);
  return out;
}

Row Columns::row(size_t i) const {
  Row row;
  for_each_needed(
      [&](int number, auto& field) { columns_[number].copy(i, reinterpret_cast<char*>(&field)); },
      row);
  return row;
}

std::vector<Row> Columns::rows() const {
  std::vector<Row> rows;
  rows.reserve(count_);
  for (size_t i = 0; i < count_; ++i) rows.push_back(row(i));
  return rows;
}

void forget_columns(Row& row, unsigned missing) {
  for_each_needed(
      [missing](int number, auto& field) {
        if (missing >> number & 1)
          std::memset(static_cast<void*>(&field), kUntouched, sizeof field);
      },
      row);
}

testing::AssertionResult same_rows(std::span<const Row> expected, std::span<const Row> actual,
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

std::vector<Row> expected_rows(std::span<const TestPair> pairs, PositionType positions,
                               Detail detail, WitnessFrame frame) {
  return rows_of(reference_results(pairs, positions), pairs, positions, detail, frame);
}

}  // namespace carom::test
