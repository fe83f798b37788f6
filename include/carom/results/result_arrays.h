/// @file
/// Memory for the results of stateless calls.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "carom/results/result_columns.h"

namespace carom {

/// Owns the columns that a call fills at a detail. Columns keep their places until the next
/// resize(). Their contents after resize() are not those of before.
class ResultArrays {
 public:
  ResultArrays() = default;  ///< no columns
  /// As resize().
  explicit ResultArrays(size_t count, Detail detail,
                        std::initializer_list<ColumnRole> wanted = {}) {
    resize(count, detail, wanted);
  }
  /// Takes the memory over; the other one may only be resized, assigned to or destroyed.
  ResultArrays(ResultArrays&&) = default;
  /// Likewise.
  ResultArrays& operator=(ResultArrays&&) = default;
  ResultArrays(const ResultArrays&) = delete;
  ResultArrays& operator=(const ResultArrays&) = delete;

  /// Makes room for `count` results in the columns that `detail` fills. Of the columns that a
  /// caller need not have, those with a role in `wanted` exist.
  void resize(size_t count, Detail detail, std::initializer_list<ColumnRole> wanted = {}) {
    resize(count, detail, std::span(wanted.begin(), wanted.size()));
  }
  /// The same, with a list that is made at run time.
  void resize(size_t count, Detail detail, std::span<const ColumnRole> wanted) {
    constexpr size_t kNone = SIZE_MAX;
    std::array<size_t, kColumnCount> first_line;
    size_t column = 0, lines = 0;
    for_each_column(
        [&]<class T>(const ColumnInfo& info, T*) {
          const bool exists = info.detail <= detail && is_among(info.role, wanted);
          first_line[column++] = exists ? lines : kNone;
          if (exists) lines += count * sizeof(T) / sizeof(Line) + 2;
        },
        columns_);
    memory_.resize(lines);
    column = 0;
    for_each_column(
        [&]<class T>(const ColumnInfo&, T*& place) {
          const size_t first = first_line[column++];
          place = first == kNone ? nullptr : reinterpret_cast<T*>(memory_.data() + first);
        },
        columns_);
    count_ = count;
  }

  size_t count() const { return count_; }  ///< results that there is room for
  /// The columns; nullptr for those that do not exist.
  const ResultColumns& columns() const { return columns_; }
  /// Bytes of memory that are held.
  size_t bytes() const { return memory_.capacity() * sizeof(Line); }

 private:
  // Columns begin at lines of the cache. An unused line between two of them keeps long ones from
  // falling into the same sets.
  struct alignas(64) Line {
    std::byte bytes[64];
  };

  static bool is_among(ColumnRole role, std::span<const ColumnRole> wanted) {
    if (!is_optional(role)) return true;
    for (const ColumnRole each : wanted) {
      if (each == role) return true;
    }
    return false;
  }

  size_t count_ = 0;
  ResultColumns columns_;
  std::vector<Line> memory_;
};

}  // namespace carom
