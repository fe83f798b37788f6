// The cells that boxes are sorted into: the properties that searches through them rely on.
#include "broadphase/grid/cell_grid.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>

#include "broadphase/grid/cell_rows.h"
#include "carom/base/thread_arena.h"
#include "tests/support/boxes.h"
#include "tests/support/isas.h"

namespace carom::test {
namespace {

void build(CellRows& rows, const BoxSource& source, Parallelism parallelism = Parallelism::none) {
  Scratch scratch;
  rows.build(source, parallelism, scratch);
}

float longest_edge(const TestBox& box) {
  float longest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float edge = box.upper[axis] - box.lower[axis];
    longest = edge > longest ? edge : longest;
  }
  return longest;
}

// The key of a box in the grid for its size, computed step by step; `reach` grows.
uint32_t plain_key(const TestBox& box, const CellGrids& grids, CellReach& reach) {
  if (!overlap(box, box)) return grids.cells;
  for (size_t g = 0; g < grids.count; ++g) {
    const CellGrid& grid = grids.grid[g];
    if (!(longest_edge(box) <= grid.largest_edge)) continue;
    uint32_t lower[3], bits = 0;
    for (size_t k = 0; k < 3; ++k) {
      lower[k] = cell_along(grid, k, box.lower[grids.axis[k]]);
      const uint32_t further = cell_along(grid, k, box.upper[grids.axis[k]]) - lower[k];
      reach.cells[g][k] = std::max(reach.cells[g][k], static_cast<float>(further));
      bits |= further << CellKey::kReachShift[k];
    }
    return grid.cell_at(lower[0], lower[1], lower[2]) | bits;
  }
  return grids.cells;
}

testing::AssertionResult fails(const std::string& what, size_t where) {
  return testing::AssertionFailure() << what << ", at " << where;
}

// Every valid box has one row, in its own cell of the grid for its size.
testing::AssertionResult rows_hold(const CellRows& rows, const Boxes& boxes,
                                   const std::vector<uint32_t>& members) {
  const CellGrids& grids = rows.grids();
  std::vector<uint32_t> expected;
  for (const uint32_t body : members) {
    if (overlap(boxes[body], boxes[body])) expected.push_back(body);
  }
  std::vector<uint32_t> bodies(rows.body.begin(), rows.body.begin() + rows.count());
  std::sort(bodies.begin(), bodies.end());
  if (bodies != expected) return testing::AssertionFailure() << "not the boxes that take part";

  CellReach reach;
  size_t row = 0;
  for (size_t g = 0; g < grids.count; ++g) {
    const CellRows::Range range = rows.rows_of_grid(g);
    if (range.begin != row) return fails("grids do not follow each other", g);
    for (; row < range.end; ++row) {
      const TestBox& box = boxes[rows.body[row]];
      if (rows.key[row].bits != plain_key(box, grids, reach)) return fails("key", row);
      const uint32_t cell = rows.key[row].cell();
      if (row < rows.first_row()[cell] || row >= rows.first_row()[cell + 1]) {
        return fails("cell", row);
      }
      if (!(longest_edge(box) <= grids.grid[g].largest_edge)) return fails("grid", row);
      for (size_t k = 0; k < 3; ++k) {
        if (rows.lower(k)[row] != box.lower[grids.axis[k]]) return fails("lower corner", row);
        if (rows.upper(k)[row] != box.upper[grids.axis[k]]) return fails("upper corner", row);
        if (reach.cells[g][k] > static_cast<float>(grids.grid[g].reach[k])) {
          return fails("reaches too far", row);
        }
      }
    }
  }
  if (row != rows.count()) return fails("rows in no grid", row);
  return testing::AssertionSuccess();
}

testing::AssertionResult directory_is_sound(const CellRows& rows, size_t boxes) {
  const CellGrids& grids = rows.grids();
  if (grids.count > CellGrids::kMost) return fails("grids", grids.count);
  if (grids.cells > 11 * boxes + 11 * grids.count) return fails("cells", grids.cells);
  const uint32_t* first = rows.first_row();
  if (first[0] != 0 || first[grids.cells] != rows.count()) return fails("ends", rows.count());
  for (uint32_t cell = 0; cell < grids.cells; ++cell) {
    if (first[cell] > first[cell + 1]) return fails("a cell ends before it begins", cell);
  }
  uint32_t behind = 0;
  float smaller = -1;
  for (size_t g = 0; g < grids.count; ++g) {
    const CellGrid& grid = grids.grid[g];
    const auto& cells = grid.cells;
    if (std::min({cells[0], cells[1], cells[2]}) == 0) return fails("no cells", g);
    if (grid.reach[0] < 1 || grid.reach[0] > 2 || grid.reach[1] != 1 || grid.reach[2] != 1) {
      return fails("reach", g);
    }
    if (g > 0 && grid.first_cell - grid.reach[0] < behind) return fails("shared cells", g);
    if (!(grid.largest_edge > smaller)) return fails("order of sizes", g);
    smaller = grid.largest_edge;
    // A search from the last cell looks at most one row and one slab ahead, and one cell to either
    // side.
    const CellGrid::RowsAhead ahead = grid.rows_ahead();
    const uint32_t last = grid.cell_at(cells[0] - 1, cells[1] - 1, cells[2] - 1);
    behind = last + (ahead.count > 0 ? ahead.offset[ahead.count - 1] : 0) + 1;
    if (behind > grids.cells) return fails("the directory ends too early", g);
  }
  if (grids.count > 0 && smaller != kInfinity) return fails("boxes too large for all", 0);
  return testing::AssertionSuccess();
}

std::vector<uint32_t> all_of(const Boxes& boxes) {
  std::vector<uint32_t> members(boxes.size());
  for (uint32_t i = 0; i < members.size(); ++i) members[i] = i;
  return members;
}

bool same_rows(const CellRows& a, const CellRows& b) {
  const auto same = [&](const auto& x, const auto& y) {
    return a.count() == b.count() && std::equal(x.begin(), x.begin() + a.count(), y.begin());
  };
  return same(a.body, b.body) && a.grids().cells == b.grids().cells &&
         std::equal(a.key.begin(), a.key.begin() + a.count(), b.key.begin(),
                    [](CellKey x, CellKey y) { return x.bits == y.bits; });
}

void expect_sound(const Boxes& boxes, size_t record = 0) {
  const LaidOutBoxes memory(boxes, record);
  CellRows first;
  build(first, BoxSource(memory.view()), Parallelism::none);
  ASSERT_TRUE(rows_hold(first, boxes, all_of(boxes)));
  ASSERT_TRUE(directory_is_sound(first, boxes.size()));
  for_each_isa([&] {
    CellRows rows;
    build(rows, BoxSource(memory.view()), Parallelism::none);
    ASSERT_TRUE(same_rows(rows, first));
  });
}

TEST(CellRows, OfEveryFamilyAndCount) {
  std::vector<size_t> counts;
  for (size_t count = 0; count <= 35; ++count) counts.push_back(count);
  for (const size_t limit : {64, 256, 512, 16384}) {
    for (const size_t count : {limit - 1, limit, limit + 1}) counts.push_back(count);
  }
  for (int i = 0; i < kBoxFamilies; ++i) {
    const auto family = static_cast<BoxFamily>(i);
    for (const size_t count : counts) {
      SCOPED_TRACE(std::to_string(count) + " boxes, " + name(family));
      expect_sound(make_boxes(family, count, count + 1), count % 3 == 0 ? 32 : 0);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(CellRows, AreTheSameOnThreads) {
  for (const BoxFamily family :
       {BoxFamily::random, BoxFamily::decades, BoxFamily::spoilt, BoxFamily::any_bits}) {
    const Boxes boxes = make_boxes(family, 70000);
    const LaidOutBoxes memory(boxes);
    CellRows one;
    build(one, BoxSource(memory.view()), Parallelism::none);
    EXPECT_TRUE(rows_hold(one, boxes, all_of(boxes))) << name(family);
    EXPECT_TRUE(directory_is_sound(one, boxes.size())) << name(family);
    ThreadArena arena(4);
    arena.run([&] {
      CellRows four;
      build(four, BoxSource(memory.view()), arena.parallelism());
      EXPECT_TRUE(same_rows(one, four)) << name(family);
    });
  }
}

TEST(CellRows, OfSomeBoxesAndAgain) {
  Random random(5);
  CellRows rows;  // used again, so that rows of an earlier build would show
  for (int repeat = 0; repeat < 200; ++repeat) {
    const auto family = static_cast<BoxFamily>(random.below(kBoxFamilies));
    const Boxes boxes = make_boxes(family, random.below(900), random.bits());
    std::vector<uint32_t> members;
    const double share = random.uniform(0, 1);
    for (const uint32_t body : all_of(boxes)) {
      if (random.chance(share)) members.push_back(body);
    }
    const LaidOutBoxes memory(boxes, repeat % 2 == 0 ? 0 : 24);
    build(rows, BoxSource(memory.view(), members.data(), members.size()), Parallelism::none);
    ASSERT_TRUE(rows_hold(rows, boxes, members)) << name(family);
    ASSERT_TRUE(directory_is_sound(rows, members.size())) << name(family);
  }
}

// --- Grids ---

size_t grids_for(double smallest, double largest, size_t count) {
  Random random(3);
  BoxMaker maker(4);
  Boxes boxes(count);
  for (TestBox& box : boxes) {
    box = maker.in_cube(side_for(count) * smallest, 0);
    const auto edge = static_cast<float>(random.log_uniform(smallest, largest));
    for (int axis = 0; axis < 3; ++axis) box.upper[axis] = box.lower[axis] + edge;
  }
  CellRows rows;
  const LaidOutBoxes memory(boxes);
  build(rows, BoxSource(memory.view()), Parallelism::none);
  return rows.grids().count;
}

TEST(CellGrids, OneForOneSizeAndAFewForMany) {
  EXPECT_EQ(grids_for(1, 1, 5000), 1u);
  EXPECT_EQ(grids_for(1, 1.5, 5000), 1u);
  EXPECT_GT(grids_for(1, 1e3, 5000), 2u);
  EXPECT_GE(grids_for(1, 1e6, 20000), grids_for(1, 1e3, 20000));
  EXPECT_LE(grids_for(1e-6, 1e30, 20000), CellGrids::kMost);
}

// The grids of a world with more boxes than a test can hold, from a made-up survey.
CellGrids grids_of_world(uint32_t boxes, std::array<float, 3> size, float edge) {
  Survey survey;
  survey.clear();
  survey.lowest = {0, 0, 0};
  survey.highest = size;
  survey.longest_edge = {edge, edge, edge};
  survey.boxes_of_class[size_class(edge)] = boxes;
  survey.count = boxes;
  const Boxes none;
  const LaidOutBoxes memory(none);
  CellGrids grids;
  grids.choose(survey, BoxSource(memory.view()), {1, 1, 1});
  return grids;
}

TEST(CellGrids, HaveNoMoreCellsThanKeysCanName) {
  for (const uint32_t boxes : {1u << 20, 1u << 26, 1u << 28, 1u << 29}) {
    for (const std::array<float, 3> size : {std::array<float, 3>{1e5f, 1e5f, 1e5f},
                                            {1e6f, 1e6f, 1},
                                            {1e9f, 0, 0},
                                            {1e9f, 1.5f, 1.5f},
                                            {1e30f, 1e30f, 1e30f}}) {
      const CellGrids grids = grids_of_world(boxes, size, 1);
      EXPECT_LT(grids.cells, 1u << CellKey::kCellBits) << boxes << " boxes in " << size[0];
    }
  }
}

// In long worlds the grid uses all its cells and then makes them larger, instead of collecting the
// rest in the last cell.
TEST(CellGrids, ReachFromOneEndOfTheWorldToTheOther) {
  for (const uint32_t boxes : {1000u, 3000000u, 100000000u}) {
    for (const float length : {1e3f, 1e6f, 1e7f, 1e9f, 1e30f}) {
      const CellGrids grids = grids_of_world(boxes, {length, 3, 0}, 1);
      for (size_t g = 0; g < grids.count; ++g) {
        for (size_t k = 0; k < 3; ++k) {
          const CellGrid& grid = grids.grid[g];
          const float extent = grids.axis[k] == 0 ? length : grids.axis[k] == 1 ? 3 : 0;
          EXPECT_LE(extent * grid.scale[k], static_cast<float>(grid.cells[k]) * 1.0001f + 1)
              << boxes << " boxes along " << length;
        }
      }
    }
  }
}

// A few boxes far away must not widen the cells of all others, nor leave them nearly empty.
TEST(CellGrids, AreLaidOutForTheManyNotForTheFewFarAway) {
  for (const bool flat : {false, true}) {
    for (const float far : {1e4f, 1e6f, 1e9f}) {
      Random random(6);
      Boxes boxes = make_boxes(BoxFamily::random, 20000);
      for (TestBox& box : boxes) {
        if (flat) box.lower[2] = 0;
        if (flat) box.upper[2] = 1;
        if (!random.chance(0.002)) continue;
        box.lower[2] = -far * static_cast<float>(random.uniform(0.1, 1));
        box.upper[2] = std::nextafter(box.lower[2], 0.0f);
      }
      const LaidOutBoxes memory(boxes);
      CellRows rows;
      build(rows, BoxSource(memory.view()), Parallelism::none);
      uint32_t fullest = 0;
      for (uint32_t cell = 0; cell < rows.grids().cells; ++cell) {
        fullest = std::max(fullest, rows.first_row()[cell + 1] - rows.first_row()[cell]);
      }
      // The flat boxes overlap each other, 27 to a square metre on average.
      EXPECT_LT(fullest, flat ? 150u : 60u) << "as far as " << far;
    }
  }
}

// --- Keys ---

CellGrids any_grids(Random& random) {
  CellGrids grids;
  std::array<uint8_t, 3> axis = {0, 1, 2};
  for (size_t k = 3; k > 1; --k) std::swap(axis[k - 1], axis[random.below(k)]);
  grids.axis = axis;
  grids.count = random.below(CellGrids::kMost + 1);
  for (size_t g = 0; g < grids.count; ++g) {
    CellGrid& grid = grids.grid[g];
    for (size_t k = 0; k < 3; ++k) {
      grid.origin[k] = random.chance(0.5) ? 0 : static_cast<float>(random.uniform(-1e3, 1e3));
      grid.scale[k] = random.chance(0.1) ? 0 : static_cast<float>(random.log_uniform(1e-38, 1e37));
      grid.cells[k] = static_cast<uint32_t>(1 + random.below(random.chance(0.2) ? 1 : 100));
    }
    grid.largest_edge = g + 1 < grids.count
                            ? static_cast<float>(std::pow(10.0, 6.0 * static_cast<double>(g) - 36))
                            : kInfinity;
    grid.reach = {1, 1, 1};
    grid.row_stride = grid.cells[0] + 1;
    grid.slab_stride = grid.row_stride * (grid.cells[1] + 1);
    grid.first_cell = grids.cells + 1;
    grids.cells = grid.first_cell + grid.slab_stride * (grid.cells[2] + 1) + 1;
  }
  return grids;
}

RC_GTEST_PROP(CellKeys, AreThoseOfOneBoxAfterTheOther, (uint64_t seed)) {
  Random random(seed);
  const CellGrids grids = any_grids(random);
  const auto family = static_cast<BoxFamily>(random.below(kBoxFamilies));
  const Boxes boxes = make_boxes(family, random.below(BoxBlock::kBoxes + 1), seed);
  const LaidOutBoxes memory(boxes);
  CellReach expected_reach;
  std::vector<uint32_t> expected;
  for (const TestBox& box : boxes) expected.push_back(plain_key(box, grids, expected_reach));
  for (const Isa isa : usable_isas()) {
    const ForcedIsa forced(isa);
    BlockBuffer buffer;
    CellKey keys[BoxBlock::kBoxes + BoxBlock::kPadding];
    CellReach reach;
    find_cells(buffer.load(BoxSource(memory.view()), 0, boxes.size()), grids, keys, reach);
    for (size_t i = 0; i < boxes.size(); ++i) RC_ASSERT(keys[i].bits == expected[i]);
    RC_ASSERT(reach.cells == expected_reach.cells);
  }
}

RC_GTEST_PROP(CellAlong, NeverDecreases, (uint64_t seed)) {
  Random random(seed);
  CellGrid grid;
  grid.scale[0] = std::fabs(random.any_float());
  if (!(grid.scale[0] <= 1e37f)) grid.scale[0] = 1;
  grid.cells[0] = static_cast<uint32_t>(1 + random.below(1 << 22));
  std::vector<float> coordinates = {-kInfinity, -kLargest, -0.0f, 0.0f, kLargest, kInfinity};
  const float origin = random.any_float();
  grid.origin[0] = std::isfinite(origin) ? origin : 0;
  for (int i = 0; i < 200; ++i) {
    const float any = random.any_float();
    const auto near = static_cast<float>(grid.origin[0] + i / (2.0 * grid.scale[0] + 1e-38));
    for (const float c : {any, near, std::nextafter(near, kInfinity)}) {
      if (!std::isnan(c)) coordinates.push_back(c);
    }
  }
  std::sort(coordinates.begin(), coordinates.end());
  uint32_t last = 0;
  for (const float coordinate : coordinates) {
    const uint32_t cell = cell_along(grid, 0, coordinate);
    RC_ASSERT(cell >= last);
    RC_ASSERT(cell < grid.cells[0]);
    last = cell;
  }
}

}  // namespace
}  // namespace carom::test
