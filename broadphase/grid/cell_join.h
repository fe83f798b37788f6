// Searches through boxes sorted by cell.
#pragma once

#include <cstddef>

#include "broadphase/grid/cell_rows.h"
#include "broadphase/sort/pair_list.h"

namespace carom {

// Pairs the boxes of rows [begin, end), all of grid g, with the boxes of the same grid that follow
// them.
void join_grid(const CellRows& rows, size_t g, size_t begin, size_t end, const PairFilter& filter,
               PairList& out);

// Pairs the boxes of rows [begin, end) of `queries` with all boxes of grid g of `rows`.
void join_across(const CellRows& queries, size_t begin, size_t end, const CellRows& rows, size_t g,
                 const PairFilter& filter, PairList& out);

}  // namespace carom
