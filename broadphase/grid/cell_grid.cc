#include "broadphase/grid/cell_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "broadphase/grid/cell_keys.h"

namespace carom {
namespace {

// With more boxes a cell than this, on average, smaller boxes get a grid of their own.
constexpr double kFullCell = 12;
constexpr double kMostCellsPerBox = 2.25;
// For all grids together. With empty cells there are up to 4.5 times as many, and every one has a
// key.
constexpr double kMostCells = (1 << CellKey::kCellBits) / 5.0;
constexpr double kMostCellsPerAxis = 1 << 22;

struct Range {
  double low, high;
};

// The range of the lower corners on an axis. If a few lie far away from the rest, it leaves them
// out; their boxes belong to the outermost cells.
Range populated_range(const Survey& survey, const BoxSource& source, size_t axis) {
  constexpr size_t kSamples = 64;
  constexpr double kFar = 16;  // quartile distances
  const Range all = {survey.lowest[axis], survey.highest[axis]};
  std::array<float, kSamples> sample;
  size_t samples = 0;
  const size_t step = std::max<size_t>(1, source.count / kSamples);
  for (size_t i = 0; i < source.count && samples < kSamples; i += step) {
    const uint32_t body = source.body(i);
    if (!takes_part(source.bounds, body)) continue;
    sample[samples++] = value_at(source.bounds, source.bounds.lower[axis], body);
  }
  if (samples < 4) return all;
  std::sort(sample.begin(), sample.begin() + samples);
  double low = sample[samples / 4];
  double high = sample[samples * 3 / 4];
  if (low == high) {  // a flat world: the quartiles coincide, so use outer quantiles
    low = sample[samples / 16];
    high = sample[samples - 1 - samples / 16];
  }
  const double reach = kFar * (high - low);
  return {std::max(all.low, low - reach), std::min(all.high, high + reach)};
}

double cells_along(double length, double cell) {
  return std::clamp(std::floor(length / cell) + 1, 1.0, kMostCellsPerAxis);
}

struct Layout {
  std::array<Range, 3> range;  // by axis of the grids
  std::array<double, 3> longest_edge;
  std::array<float, 3> cell_scale;

  double length(size_t k) const { return range[k].high - range[k].low; }

  // The edge of cells for boxes with edges up to `box`, but at least `least`.
  double cell_edge(size_t k, double box, double least) const {
    // A little more than the boxes, so that rounding cannot make a box reach one cell too far; and
    // never so small that the inverse overflows.
    constexpr double kSpare = 1 + 1.0 / 256;
    return std::max({std::min(box, longest_edge[k]) * kSpare * cell_scale[k], least,
                     length(k) / kMostCellsPerAxis, 1e-37});
  }

  double cell_count(double box, double least) const {
    double cells = 1;
    for (size_t k = 0; k < 3; ++k) cells *= cells_along(length(k), cell_edge(k, box, least));
    return cells;
  }

  // The smallest edge, within a few percent, with which there are at most `most_cells` cells.
  double affordable_edge(double box, double most_cells) const {
    if (cell_count(box, 0) <= most_cells) return 0;
    double low = -90, high = 130;  // logarithms of edges
    while (high - low > 0.02) {
      const double middle = (low + high) / 2;
      (cell_count(box, std::exp(middle)) > most_cells ? low : high) = middle;
    }
    return std::exp(high);
  }
};

}  // namespace

CellGrid::RowsAhead CellGrid::rows_ahead() const {
  RowsAhead rows;
  const bool several_rows = cells[1] > 1;
  if (several_rows) rows.offset[rows.count++] = row_stride;
  rows.in_slab = rows.count;
  if (cells[2] == 1) return rows;
  if (several_rows) rows.offset[rows.count++] = slab_stride - row_stride;
  rows.offset[rows.count++] = slab_stride;
  if (several_rows) rows.offset[rows.count++] = slab_stride + row_stride;
  return rows;
}

void CellGrids::choose(const Survey& survey, const BoxSource& source,
                       const std::array<float, 3>& cell_scale) {
  std::array<Range, 3> range;
  for (size_t k = 0; k < 3; ++k) range[k] = populated_range(survey, source, k);
  // Slabs along the longest side keep neighbours close in memory. Rows along the shortest side
  // would have only a few cells.
  std::array<uint8_t, 3> by_length = {0, 1, 2};
  std::sort(by_length.begin(), by_length.end(), [&](uint8_t a, uint8_t b) {
    const double length_a = range[a].high - range[a].low;
    const double length_b = range[b].high - range[b].low;
    return length_a > length_b || (length_a == length_b && a < b);
  });
  axis = {by_length[1], by_length[2], by_length[0]};

  Layout layout;
  layout.cell_scale = cell_scale;
  for (size_t k = 0; k < 3; ++k) {
    layout.range[k] = range[axis[k]];
    layout.longest_edge[k] = survey.longest_edge[axis[k]];
  }

  // From the largest boxes down, smaller ones join a grid as long as its cells do not fill up.
  count = 0;
  std::array<size_t, kMost> boxes{};
  std::array<double, kMost> edges{};
  for (size_t size = kSizeClasses; size-- > 0;) {
    const size_t more = survey.boxes_of_class[size];
    if (more == 0) continue;
    const bool fits =
        count > 0 && (count == kMost || static_cast<double>(boxes[count - 1] + more) <=
                                            kFullCell * layout.cell_count(edges[count - 1], 0));
    if (!fits) edges[count++] = largest_of_class(size);
    boxes[count - 1] += more;
  }
  std::reverse(boxes.begin(), boxes.begin() + count);
  std::reverse(edges.begin(), edges.begin() + count);

  const double most_cells_per_box =
      std::min(kMostCellsPerBox, kMostCells / static_cast<double>(survey.count));
  cells = 0;
  for (size_t g = 0; g < count; ++g) {
    CellGrid& to = grid[g];
    const double most = std::max(1.0, most_cells_per_box * static_cast<double>(boxes[g]));
    const double least = layout.affordable_edge(edges[g], most);
    to.is_coarse = least > 4 * edges[g];
    for (size_t k = 0; k < 3; ++k) {
      const double cell = layout.cell_edge(k, edges[g], least);
      to.cells[k] = static_cast<uint32_t>(cells_along(layout.length(k), cell));
      to.origin[k] = static_cast<float>(layout.range[k].low);
      to.scale[k] = static_cast<float>(1 / cell);
    }
    to.largest_edge =
        g + 1 < count ? static_cast<float>(edges[g]) : std::numeric_limits<float>::infinity();
    // Where boxes are dense, cells of half the length leave fewer boxes to test.
    to.reach = {1, 1, 1};
    if (2.0 * to.cells[0] * to.cells[1] * to.cells[2] <= most && to.cells[0] > 1) {
      to.cells[0] *= 2;
      to.scale[0] *= 2;
      to.reach[0] = 2;
    }
    to.row_stride = to.cells[0] + to.reach[0];
    to.slab_stride = to.row_stride * (to.cells[1] + (to.cells[1] > 1));
    to.first_cell = cells + to.reach[0];
    cells = to.first_cell + to.slab_stride * (to.cells[2] + (to.cells[2] > 1)) + 1;
  }
}

}  // namespace carom
