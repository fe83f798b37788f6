// Helpers for columns, flat arrays that exist once they are needed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/block_lists.h"

namespace carom {

template <class T, class Allocator>
size_t bytes_of(const std::vector<T, Allocator>& column) {
  return column.capacity() * sizeof(T);  // NOLINT(bugprone-sizeof-expression): T may be a pointer
}

template <class T, class Allocator>
const T* data_or_null(const std::vector<T, Allocator>& column) {
  return column.empty() ? nullptr : column.data();
}

// Gives back memory that the columns do not need for what they hold.
template <class... Columns>
void give_back(Columns&... columns) {
  (columns.shrink_to_fit(), ...);
}

// Gives back all memory of working lists, whose contents are of no use any more.
template <class... Lists>
void give_back_scratch(Lists&... lists) {
  ((lists = Lists()), ...);
}

}  // namespace carom
