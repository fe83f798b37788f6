// Working memory for the results of a few rows, and copies of rows from columns to columns.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "carom/results/result_columns.h"

namespace carom {

// Memory for the columns with one of the roles, `kRows` rows each.
template <size_t kRows, ColumnRole... kRoles>
class ColumnMemory {
 public:
  ResultColumns columns() {
    ResultColumns columns;
    std::byte* next = bytes_;
    for_each_column(
        [&]<class T>(const ColumnInfo& info, T*& column) {
          if (!has(info)) return;
          column = reinterpret_cast<T*>(next);
          next += size_of<T>();
        },
        columns);
    return columns;
  }

 private:
  static constexpr bool has(const ColumnInfo& info) { return ((info.role == kRoles) || ...); }

  // Whole lines of the cache and one more, so that columns do not fall into the same sets.
  template <class T>
  static constexpr size_t size_of() {
    constexpr size_t kLine = 64;
    return (kRows * sizeof(T) / kLine + 2) * kLine;
  }

  static constexpr size_t kBytes = [] {
    size_t bytes = 0;
    for_each_column(
        [&]<class T>(const ColumnInfo& info, T*) {
          if (has(info)) bytes += size_of<T>();
        },
        ResultColumns());
    return bytes;
  }();

  alignas(64) std::byte bytes_[kBytes];
};

// Small enough for the scratch of a block to stay in L2, large enough to amortise a task.
inline constexpr size_t kPairsPerBlock = 1024;

// The columns that tests write.
using TestColumns = ColumnMemory<kPairsPerBlock, ColumnRole::test>;
// The columns that run_passes() writes.
using BlockColumns = ColumnMemory<kPairsPerBlock, ColumnRole::test, ColumnRole::manifold,
                                  ColumnRole::bound, ColumnRole::memory>;

// Whether the columns have all that `detail` fills, but for those that are optional.
inline bool is_complete(const ResultColumns& columns, Detail detail) {
  bool complete = true;
  for_each_column(
      [&](const ColumnInfo& info, const auto* column) {
        if (!is_optional(info.role) && info.detail <= detail) complete = complete && column;
      },
      columns);
  return complete;
}

// `columns` without the optional ones that `asked` lacks.
inline ResultColumns as_asked(ResultColumns columns, const ResultColumns& asked) {
  for_each_column(
      [](const ColumnInfo& info, auto*& column, auto* wanted) {
        if (is_optional(info.role) && !wanted) column = nullptr;
      },
      columns, asked);
  return columns;
}

// The columns from row `row` on.
inline ResultColumns from_row(ResultColumns columns, size_t row) {
  for_each_column(
      [row](const ColumnInfo&, auto*& column) {
        if (column) column += row;
      },
      columns);
  return columns;
}

// Copies rows 0 to count - 1 of `from` to the rows place(0), place(1), ... of `to`, in the columns
// that both have and the detail fills.
template <class Place>
void copy_rows(const ResultColumns& from, const ResultColumns& to, Detail detail, size_t count,
               const Place& place) {
  for_each_column(
      [&](const ColumnInfo& info, const auto* source, auto* target) {
        if (!source || !target || info.detail > detail) return;
        for (size_t i = 0; i < count; ++i) target[place(i)] = source[i];
      },
      from, to);
}

}  // namespace carom
