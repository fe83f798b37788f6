// Finds all overlapping pairs of boxes sorted by cell, with joins of grids as parallel tasks.
#pragma once

#include "broadphase/grid/cell_rows.h"
#include "broadphase/sort/pair_list.h"

namespace carom {

// Adds the pairs among the boxes of `rows`.
void find_pairs_within(const CellRows& rows, const PairFilter& filter, Parallelism parallelism,
                       FoundPairs& found);

// Adds the pairs of a box of `queries` and one of `rows`. Fastest if `queries` are the fewer.
void find_pairs_between(const CellRows& queries, const CellRows& rows, const PairFilter& filter,
                        Parallelism parallelism, FoundPairs& found);

}  // namespace carom
