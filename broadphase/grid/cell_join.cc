#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broadphase/grid/cell_join.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <algorithm>

#include "broadphase/grid/cell_join.h"
#include "simd/compress-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// Runs of boxes in a row of cells are short, so a wider vector would mostly be empty.
using RunTag = hn::CappedTag<float, 8>;
using RunIndexTag = hn::RebindToUnsigned<RunTag>;
using RunF = hn::Vec<RunTag>;
using RunMask = hn::Mask<RunTag>;
constexpr size_t kRunLanes = kLanesOf<RunTag>;

// The columns of the searched rows, at equal distances, so that their few pointers fit the
// registers.
struct Columns {
  const float* lower;
  size_t stride;
  const uint32_t* body;

  explicit HWY_INLINE Columns(const CellRows& rows)
      : lower(rows.lower(0)), stride(rows.column_stride()), body(rows.body.data()) {}
};

// One box in every lane.
struct BoxLanes {
  RunF lower[3], upper[3];
  hn::Vec<RunIndexTag> body;
};

HWY_INLINE void load_box(const Columns& columns, size_t row, BoxLanes& box) {
  const float* lower = columns.lower + row;
  const float* upper = lower + 3 * columns.stride;
  box.body = hn::Set(RunIndexTag(), columns.body[row]);
  for (size_t k = 0; k < 3; ++k) {
    box.lower[k] = hn::Set(RunTag(), lower[k * columns.stride]);
    box.upper[k] = hn::Set(RunTag(), upper[k * columns.stride]);
  }
}

HWY_INLINE RunMask overlaps(const Columns& columns, const BoxLanes& box, size_t row) {
  const RunTag tag;
  const float* lower = columns.lower + row;
  const float* upper = lower + 3 * columns.stride;
  RunMask all = hn::And(hn::Le(hn::LoadU(tag, lower), box.upper[0]),
                        hn::Ge(hn::LoadU(tag, upper), box.lower[0]));
  for (size_t k = 1; k < 3; ++k) {
    const size_t column = k * columns.stride;
    all = hn::And(all, hn::And(hn::Le(hn::LoadU(tag, lower + column), box.upper[k]),
                               hn::Ge(hn::LoadU(tag, upper + column), box.lower[k])));
  }
  return all;
}

HWY_INLINE void prefetch_boxes(const Columns& columns, size_t row) {
  for (size_t column = 0; column < 6; ++column) {
    __builtin_prefetch(columns.lower + row + column * columns.stride);
  }
  __builtin_prefetch(columns.body + row);
}

// Where the pairs of a search go: one behind the other, until a list has no room left. The caller
// keeps the place of the next pair, so that it stays in a register.
class PairOutput {
 public:
  PairOutput(const PairFilter& filter, PairList& list)
      : list_(list), filter_(filter), filters_(!lets_all_meet(filter)) {
    begin();
  }

  Pair* first() const { return first_; }
  // Whether a vector of pairs may no longer fit there.
  HWY_INLINE bool is_full(const Pair* next) const { return next > last_; }

  // Adds the pairs up to `next` to the list, and returns where the next one goes.
  HWY_NOINLINE Pair* add_up_to(const Pair* next) {
    end(next);
    begin();
    return first_;
  }

  // Adds the last pairs.
  void end(const Pair* next) {
    const auto count = static_cast<size_t>(next - first_);
    if (filters_) {
      list_.commit(count, filter_);
    } else {
      list_.commit(count);
    }
  }

 private:
  static constexpr size_t kLeastRoom = 64;

  void begin() {
    const std::span<Pair> room = list_.room(kLeastRoom);
    first_ = room.data();
    last_ = first_ + room.size() - kRunLanes;
  }

  PairList& list_;
  const PairFilter& filter_;
  const bool filters_;
  Pair* first_;
  Pair* last_;
};

// Writes the pairs of the box and the rows of [begin, end) that overlap it, and returns where the
// next pair goes. It tests at least one vector even if there is no row: a loop that mostly runs
// once is predicted well.
HWY_INLINE Pair* scan(const Columns& columns, const BoxLanes& box, size_t begin, size_t end,
                      Pair* next, PairOutput& out) {
  size_t row = begin;
  do {
    const RunMask hit = overlaps(columns, box, row);
    const auto others = hn::LoadU(RunIndexTag(), columns.body + row);
    if (HWY_UNLIKELY(out.is_full(next))) next = out.add_up_to(next);
    next += store_pairs(RunIndexTag(), box.body, others, hit, end - row, &next->a);
    row += kRunLanes;
  } while (HWY_UNLIKELY(row < end));
  return next;
}

void join_grid(const CellRows& rows, size_t g, size_t begin, size_t end, const PairFilter& filter,
               PairList& list) {
  const Columns columns(rows);
  const CellGrid& grid = rows.grids().grid[g];
  const CellGrid::RowsAhead ahead = grid.rows_ahead();
  const ptrdiff_t behind = -static_cast<ptrdiff_t>(grid.reach[0]);
  PairOutput out(filter, list);
  Pair* next = out.first();
  for (size_t i = begin; i < end; ++i) {
    const CellKey key = rows.key[i];
    const uint32_t* first = rows.first_row() + key.cell();
    BoxLanes box;
    load_box(columns, i, box);
    // The rest of the box's own cell, and the cells of its row that it reaches into.
    const size_t to_cell = key.cells_along_row() + 1;
    next = scan(columns, box, i + 1, first[to_cell], next, out);
    // The rows ahead also count the cells before. Boxes much smaller than their cells reach few
    // rows.
    const size_t r_begin = key.reaches_next_row() ? 0 : ahead.in_slab;
    const size_t r_end = key.reaches_next_slab() ? ahead.count : ahead.in_slab;
    for (size_t r = r_begin; r < r_end; ++r) {
      const uint32_t* in_row = first + ahead.offset[r];
      next = scan(columns, box, in_row[behind], in_row[to_cell], next, out);
    }
  }
  out.end(next);
}

struct CellRange {
  uint32_t begin, end;
};

// The cells along axis k that hold the lower corners of all boxes that can overlap [lower, upper].
HWY_INLINE CellRange reachable_cells(const CellGrid& grid, size_t k, float lower, float upper) {
  const uint32_t first = cell_along(grid, k, lower);
  return {first - std::min(first, grid.reach[k]), cell_along(grid, k, upper) + 1};
}

// The boxes of a grid, as another search looks for those that its own boxes overlap.
struct Across {
  const CellRows& queries;
  const CellRows& rows;
  const CellGrid& grid;
  size_t axis[3];  // the place of axis k of `rows` among the axes of `queries`

  Across(const CellRows& from, const CellRows& to, size_t g)
      : queries(from), rows(to), grid(to.grids().grid[g]) {
    const auto& axes = queries.grids().axis;
    for (size_t k = 0; k < 3; ++k) {
      axis[k] = static_cast<size_t>(std::find(axes.begin(), axes.end(), rows.grids().axis[k]) -
                                    axes.begin());
    }
  }

  HWY_INLINE float lower(size_t i, size_t k) const { return queries.lower(axis[k])[i]; }
  HWY_INLINE float upper(size_t i, size_t k) const { return queries.upper(axis[k])[i]; }

  // Calls use(cell, cells) for each row of cells that box i reaches, with the place in first_row()
  // where the first of its cells begins and how many there are.
  template <class Use>
  HWY_INLINE void for_each_row(size_t i, const Use& use) const {
    CellRange cells[3];
    for (size_t k = 0; k < 3; ++k) cells[k] = reachable_cells(grid, k, lower(i, k), upper(i, k));
    for (uint32_t z = cells[2].begin; z < cells[2].end; ++z) {
      for (uint32_t y = cells[1].begin; y < cells[1].end; ++y) {
        use(rows.first_row() + grid.cell_at(cells[0].begin, y, z), cells[0].end - cells[0].begin);
      }
    }
  }
};

// Tests many boxes in three passes: the rows of cells that they reach, the boxes in these rows, the
// tests. Each pass asks for the memory that the next one reads, since the boxes of a few bodies lie
// far apart among those of many.
class AcrossSearch {
 public:
  AcrossSearch(const Across& across, const PairFilter& filter, PairList& list)
      : across_(across), columns_(across.rows), out_(filter, list), next_(out_.first()) {}

  HWY_INLINE void add(size_t i) {
    Box& box = boxes_[box_count_++];
    for (size_t k = 0; k < 3; ++k) {
      box.lower[k] = across_.lower(i, k);
      box.upper[k] = across_.upper(i, k);
    }
    box.body = across_.queries.body[i];
    across_.for_each_row(i, [&](const uint32_t* cell, uint32_t cells) HWY_ATTR {
      if (HWY_UNLIKELY(row_count_ == kRows)) test_all();
      __builtin_prefetch(cell);
      rows_[row_count_++] = {cell, cells, static_cast<uint32_t>(box_count_ - 1)};
    });
  }

  // Tests the boxes that were added. The last one may have more rows to come.
  void test_all() {
    find_runs();
    Pair* next = next_;
    for (size_t r = 0; r < run_count_; ++r) {
      const Run& run = runs_[r];
      next = scan(columns_, lanes_of(boxes_[run.box]), run.begin, run.end, next, out_);
    }
    next_ = next;
    row_count_ = 0;
    boxes_[0] = boxes_[box_count_ - 1];
    box_count_ = 1;
  }

  void finish() {
    test_all();
    out_.end(next_);
  }

 private:
  struct Box {
    float lower[3], upper[3];
    uint32_t body;
  };
  // A row of cells: where the first cell begins, in first_row(), and how many there are.
  struct ReachedRow {
    const uint32_t* cell;
    uint32_t cells;
    uint32_t box;
  };
  // The rows of the boxes in a row of cells.
  struct Run {
    uint32_t begin, end;
    uint32_t box;
  };

  // Leaves out rows of cells without boxes.
  HWY_INLINE void find_runs() {
    run_count_ = 0;
    for (size_t r = 0; r < row_count_; ++r) {
      const ReachedRow& row = rows_[r];
      const Run run = {row.cell[0], row.cell[row.cells], row.box};
      prefetch_boxes(columns_, run.begin);
      runs_[run_count_] = run;
      run_count_ += run.begin < run.end;
    }
  }

  static HWY_INLINE BoxLanes lanes_of(const Box& box) {
    BoxLanes lanes;
    lanes.body = hn::Set(RunIndexTag(), box.body);
    for (size_t k = 0; k < 3; ++k) {
      lanes.lower[k] = hn::Set(RunTag(), box.lower[k]);
      lanes.upper[k] = hn::Set(RunTag(), box.upper[k]);
    }
    return lanes;
  }

  static constexpr size_t kRows = 128;

  const Across& across_;
  const Columns columns_;
  PairOutput out_;
  Pair* next_;
  // A box reaches at least one row, and one box may be left of the last test.
  Box boxes_[kRows + 2];
  ReachedRow rows_[kRows];
  Run runs_[kRows];
  size_t box_count_ = 0, row_count_ = 0, run_count_ = 0;
};

void join_across(const CellRows& queries, size_t begin, size_t end, const CellRows& rows, size_t g,
                 const PairFilter& filter, PairList& list) {
  if (begin == end) return;
  const Across across(queries, rows, g);
  AcrossSearch search(across, filter, list);
  for (size_t i = begin; i < end; ++i) search.add(i);
  search.finish();
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(join_grid);
HWY_EXPORT(join_across);

}  // namespace

void join_grid(const CellRows& rows, size_t g, size_t begin, size_t end, const PairFilter& filter,
               PairList& out) {
  CAROM_DISPATCH(join_grid)(rows, g, begin, end, filter, out);
}

void join_across(const CellRows& queries, size_t begin, size_t end, const CellRows& rows, size_t g,
                 const PairFilter& filter, PairList& out) {
  CAROM_DISPATCH(join_across)(queries, begin, end, rows, g, filter, out);
}

}  // namespace carom
#endif  // HWY_ONCE
