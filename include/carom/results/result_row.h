/// @file
/// One row of results as a struct.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "carom/results/result_columns.h"

namespace carom {

/// A row of ResultColumns: fields, signs and frames are those of the columns. A field whose column
/// does not exist is zero.
struct ResultRow {
  uint8_t overlap = 0;             ///< 1 overlap, 0 separate
  uint8_t status = 0;              ///< Status
  float separation = 0;            ///< metres
  std::array<float, 3> normal{};   ///< from A to B
  std::array<float, 3> point_a{};  ///< witness point of A
  std::array<float, 3> point_b{};  ///< witness point of B
  uint8_t manifold_count = 0;      ///< 0 to 4
  ManifoldPoints manifold{};       ///< on A
  float separation_bound = 0;      ///< metres
  uint32_t sub_a = 0;              ///< sub-shape of A
  uint32_t sub_b = 0;              ///< sub-shape of B
  PointNames point_names{};        ///< of the points
  uint64_t features = 0;           ///< what the caller hands in again
};

/// The row `i` of the columns.
inline ResultRow result_row(const ResultColumns& columns, size_t i) {
  ResultRow row;
  for_each_column(
      [i](const ColumnInfo&, auto& field, auto* column) {
        if (column) field = column[i];
      },
      row, columns);
  return row;
}

/// Whether two rows have the same bits in every field.
inline bool same_bits(const ResultRow& x, const ResultRow& y) {
  bool same = true;
  for_each_column([&same](const ColumnInfo&, const auto& a,
                          const auto& b) { same = same && std::memcmp(&a, &b, sizeof a) == 0; },
                  x, y);
  return same;
}

}  // namespace carom
