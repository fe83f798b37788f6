// Helpers for columns, flat arrays that exist once they are needed and give memory back.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/block_lists.h"

namespace carom {

template <class T, class Allocator>
size_t bytes_of(const std::vector<T, Allocator>& column) {
  return column.capacity() * sizeof(T);
}

template <class T>
const T* data_or_null(const std::vector<T>& column) {
  return column.empty() ? nullptr : column.data();
}

// Gives memory back if the column holds more than four times the `needed` rows. It keeps twice as
// many, so that their number must halve again, or double, before the column moves again.
template <class T, class Allocator>
void give_back(std::vector<T, Allocator>& column, size_t needed) {
  constexpr size_t kAlwaysKept = 4096 / sizeof(T);
  const size_t kept = std::max(2 * needed, kAlwaysKept);
  if (column.capacity() <= 2 * kept) return;
  std::vector<T, Allocator> smaller;
  smaller.reserve(kept);
  smaller.insert(smaller.end(), column.begin(), column.end());
  column.swap(smaller);
}

// The same for working memory, whose contents are of no use any more.
template <class T>
void give_back_scratch(std::vector<T>& column, size_t needed) {
  if (column.size() > needed) column.resize(needed);
  give_back(column, needed);
}

// The same for lists that together seldom hold more than `needed` items.
template <class T>
void give_back(BlockLists<T>& lists, size_t needed) {
  constexpr size_t kAlwaysKept = 1 << 16;
  if (lists.bytes() > 8 * needed * sizeof(T) + kAlwaysKept) lists = {};
}

// Resizes the column, and gives memory back if the number of rows has fallen.
template <class T>
void resize_and_give_back(std::vector<T>& column, size_t rows) {
  const bool shrinks = rows < column.size();
  column.resize(rows);
  if (shrinks) give_back(column, rows);
}

}  // namespace carom
