#include "broadphase/grid/cell_search.h"

#include <algorithm>
#include <bit>

#include "broadphase/grid/cell_join.h"

namespace carom {
namespace {

// Tasks are few, so that tables with an entry a task stay small. All have as many rows, and their
// number seldom changes from one search to the next: else lists would grow again and again.
size_t rows_per_task(size_t rows) {
  const size_t most = std::clamp<size_t>(block_count(rows, 64), 256, 8192);
  return block_count(rows, std::bit_ceil(block_count(rows, most)));
}

// Calls body(list, begin, end) for tasks of the rows of a grid.
template <class Body>
void for_each_task(CellRows::Range rows, Parallelism parallelism, FoundPairs& found,
                   const Body& body) {
  const size_t count = rows.end - rows.begin;
  if (count == 0) return;
  const size_t per_task = rows_per_task(count);
  const size_t first_list = found.add(block_count(count, per_task));
  for_each_block(count, per_task, parallelism, [&](size_t task, size_t begin, size_t end) {
    body(found[first_list + task], rows.begin + begin, rows.begin + end);
  });
}

// Estimates how many rows of cells the boxes of grid `q` search in grid `g`.
double search_cost(const CellRows& queries, size_t q, const CellRows& rows, size_t g) {
  const CellRows::Range range = queries.rows_of_grid(q);
  double cost = static_cast<double>(range.end - range.begin);
  for (size_t k = 1; k < 3; ++k) {
    const double cells_searched =
        2 + static_cast<double>(rows.grids().grid[g].scale[k]) / queries.grids().grid[q].scale[k];
    cost *= std::min<double>(cells_searched, rows.grids().grid[g].cells[k]);
  }
  return cost;
}

}  // namespace

void find_pairs_within(const CellRows& rows, const PairFilter& filter, Parallelism parallelism,
                       FoundPairs& found) {
  const size_t grids = rows.grids().count;
  for (size_t g = 0; g < grids; ++g) {
    for_each_task(rows.rows_of_grid(g), parallelism, found,
                  [&](PairList& list, size_t begin, size_t end) {
                    join_grid(rows, g, begin, end, filter, list);
                  });
    for (size_t h = g + 1; h < grids; ++h) {
      const bool small_ones_search = search_cost(rows, g, rows, h) <= search_cost(rows, h, rows, g);
      const size_t query = small_ones_search ? g : h;
      const size_t target = small_ones_search ? h : g;
      for_each_task(rows.rows_of_grid(query), parallelism, found,
                    [&](PairList& list, size_t begin, size_t end) {
                      join_across(rows, begin, end, rows, target, filter, list);
                    });
    }
  }
}

void find_pairs_between(const CellRows& queries, const CellRows& rows, const PairFilter& filter,
                        Parallelism parallelism, FoundPairs& found) {
  for (size_t g = 0; g < rows.grids().count; ++g) {
    for_each_task({0, queries.count()}, parallelism, found,
                  [&](PairList& list, size_t begin, size_t end) {
                    join_across(queries, begin, end, rows, g, filter, list);
                  });
  }
}

}  // namespace carom
