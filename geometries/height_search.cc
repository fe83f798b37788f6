#include "geometries/height_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace carom {
namespace {

using Level = HeightPyramid::Level;

CellRange cells_of_block(const HeightFieldGeometry& field, const Level& level, uint32_t i,
                         uint32_t j) {
  const uint32_t first_i = i * level.side, first_j = j * level.side;
  return {first_i, std::min(first_i + level.side, field.cells_x()), first_j,
          std::min(first_j + level.side, field.cells_y())};
}

TreeBox box_of_block(const HeightFieldGeometry& field, const Level& level, uint32_t i, uint32_t j) {
  const HeightRange& range = level.at(i, j);
  const CellRange cells = cells_of_block(field, level, i, j);
  return {{field.x(cells.first_i), field.y(cells.first_j), range.low},
          {field.x(cells.end_i), field.y(cells.end_j), range.high}};
}

// Collects triangles, and hands them on some at a time.
class Collector {
 public:
  explicit Collector(ItemsFound found) : found_(found) {}

  void add(uint32_t triangle, bool is_taken) {
    triangles_[count_] = triangle;
    count_ += is_taken ? 1 : 0;
  }
  // There is always room for those of one cell.
  void end_cell() {
    if (count_ + 2 >= BoxTree::kMostAtOnce) hand_on();
  }
  void hand_on() {
    if (count_ > 0) found_({triangles_.data(), count_});
    count_ = 0;
  }

 private:
  const ItemsFound found_;
  size_t count_ = 0;
  std::array<uint32_t, BoxTree::kMostAtOnce> triangles_;
};

// The heights of the two triangles of a cell.
struct CellHeights {
  HeightRange below, above;  // the diagonal

  // Corners in the order (i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1).
  explicit CellHeights(const std::array<float, 4>& h) {
    const float low = std::min(h[0], h[3]), high = std::max(h[0], h[3]);
    below = {std::min(low, h[1]), std::max(high, h[1])};
    above = {std::min(low, h[2]), std::max(high, h[2])};
  }
};

// Calls use(i, j, heights) for the cells that are no holes.
template <class Use>
void for_each_cell(const HeightFieldGeometry& field, const CellRange& cells, const Use& use) {
  for (uint32_t j = cells.first_j; j < cells.end_j; ++j) {
    float near = field.height(cells.first_i, j), far = field.height(cells.first_i, j + 1);
    for (uint32_t i = cells.first_i; i < cells.end_i; ++i) {
      const std::array<float, 4> h = {near, field.height(i + 1, j), far,
                                      field.height(i + 1, j + 1)};
      near = h[1];
      far = h[3];
      const bool are_heights = field.is_height(h[0]) && field.is_height(h[1]) &&
                               field.is_height(h[2]) && field.is_height(h[3]);
      if (are_heights) use(i, j, CellHeights(h));
    }
  }
}

// The two triangles of a cell whose boxes `admits` takes.
template <class Admits>
void collect_admitted(const HeightFieldGeometry& field, const CellRange& cells,
                      const Admits& admits, Collector& found) {
  for_each_cell(field, cells, [&](uint32_t i, uint32_t j, const CellHeights& heights) {
    TreeBox box = {{field.x(i), field.y(j), heights.below.low},
                   {field.x(i + 1), field.y(j + 1), heights.below.high}};
    const uint32_t triangle = 2 * (j * field.cells_x() + i);
    found.add(triangle, admits(box));
    box.lower[2] = heights.above.low;
    box.upper[2] = heights.above.high;
    found.add(triangle + 1, admits(box));
    found.end_cell();
  });
}

// Goes down from the whole field to the blocks of the lowest level whose boxes `admits` takes.
template <class Admits, class Use>
void for_each_block(const HeightFieldGeometry& field, const Admits& admits, const Use& use) {
  const std::span<const Level> levels = field.pyramid().levels();
  const auto visit = [&](const auto& self, size_t k, uint32_t i, uint32_t j) -> void {
    const Level& level = levels[k];
    if (level.at(i, j).is_empty() || !admits(box_of_block(field, level, i, j))) return;
    if (k == 0) return use(cells_of_block(field, level, i, j));
    const Level& below = levels[k - 1];
    constexpr uint32_t kSide = HeightPyramid::kBlocks;
    for (uint32_t y = j * kSide; y < std::min((j + 1) * kSide, below.ny); ++y) {
      for (uint32_t x = i * kSide; x < std::min((i + 1) * kSide, below.nx); ++x) {
        self(self, k - 1, x, y);
      }
    }
  };
  visit(visit, levels.size() - 1, 0, 0);
}

// The cells between two places along an axis, and some beside them: places of samples are rounded.
std::pair<uint32_t, uint32_t> cells_between(double lower, double upper, float step,
                                            uint32_t cells) {
  const double beside = 0x1p-10 + cells * 0x1p-23;
  const double middle = cells / 2.0, per_step = 1 / double{step};
  const auto clamped = [cells](double cell) {
    return static_cast<uint32_t>(std::min(std::max(cell, 0.0), 1.0 * cells));
  };
  return {clamped(lower * per_step + middle - beside),
          clamped(upper * per_step + middle + beside + 1)};
}

CellRange cells_at(const HeightFieldGeometry& field, const RoundedBox& rounded) {
  const auto& [box, squared_radius] = rounded;
  // Radii are rounded upwards.
  const double radius = squared_radius > 0 ? std::sqrt(double{squared_radius}) * (1 + 0x1p-20) : 0;
  return cells_at(field, {box.lower[0] - radius, box.lower[1] - radius, 0},
                  {box.upper[0] + radius, box.upper[1] + radius, 0});
}

CellRange common(const CellRange& a, const CellRange& b) {
  return {std::max(a.first_i, b.first_i), std::min(a.end_i, b.end_i),
          std::max(a.first_j, b.first_j), std::min(a.end_j, b.end_j)};
}

// The tests of the tree, number by number (trees/tree_search.cc).
struct TouchesBox {
  const TreeBox& box;

  bool along(size_t axis, float lower, float upper) const {
    return lower <= box.upper[axis] && upper >= box.lower[axis];
  }
  bool operator()(const TreeBox& each) const {
    return along(0, each.lower[0], each.upper[0]) && along(1, each.lower[1], each.upper[1]) &&
           along(2, each.lower[2], each.upper[2]);
  }
};

struct TouchesRounded {
  const TreeBox& box;
  float squared_radius;

  float squared_gap(size_t axis, float lower, float upper) const {
    const float gap = std::max(std::max(lower - box.upper[axis], box.lower[axis] - upper), 0.0f);
    return gap * gap;
  }
  bool operator()(const TreeBox& each) const {
    float squared = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      squared += squared_gap(axis, each.lower[axis], each.upper[axis]);
    }
    return squared <= squared_radius;
  }
};

template <class Touches>
void find_touching_of(const HeightFieldGeometry& field, const CellRange& cells,
                      const Touches& touches, ItemsFound found) {
  constexpr uint64_t kFewCells = 4 * HeightPyramid::kCells * HeightPyramid::kCells;
  Collector collector(found);
  if (cells.count() <= kFewCells) {
    collect_admitted(field, cells, touches, collector);
  } else {
    for_each_block(field, touches, [&](const CellRange& block) {
      const CellRange both = common(block, cells);
      if (!both.is_empty()) collect_admitted(field, both, touches, collector);
    });
  }
  collector.hand_on();
}

double lowest(const TreeBox& box, const Double3& normal) {
  double sum = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    sum += std::min(normal[axis] * box.lower[axis], normal[axis] * box.upper[axis]);
  }
  return sum;
}

// The squared distance of two boxes, and that of their middles.
std::pair<double, double> distance(const TreeBox& a, const TreeBox& b) {
  std::pair<double, double> sum(0, 0);
  for (size_t axis = 0; axis < 3; ++axis) {
    const double above = double{a.lower[axis]} - b.upper[axis];
    const double below = double{b.lower[axis]} - a.upper[axis];
    const double gap = std::max({above, below, 0.0}), middles = (above - below) / 2;
    sum.first += gap * gap;
    sum.second += middles * middles;
  }
  return sum;
}

// Goes down to the cell with the least `cost`, always to the block that has the least one.
template <class Cost>
uint32_t best_triangle(const HeightFieldGeometry& field, const Cost& cost) {
  const std::span<const Level> levels = field.pyramid().levels();
  uint32_t i = 0, j = 0;
  for (size_t k = levels.size() - 1; k > 0; --k) {
    const Level& below = levels[k - 1];
    constexpr uint32_t kSide = HeightPyramid::kBlocks;
    const uint32_t first_i = i * kSide, first_j = j * kSide;
    bool is_first = true;
    decltype(cost(TreeBox{})) least{};
    for (uint32_t y = first_j; y < std::min(first_j + kSide, below.ny); ++y) {
      for (uint32_t x = first_i; x < std::min(first_i + kSide, below.nx); ++x) {
        if (below.at(x, y).is_empty()) continue;
        const auto its_cost = cost(box_of_block(field, below, x, y));
        if (!is_first && !(its_cost < least)) continue;
        is_first = false;
        least = its_cost;
        i = x;
        j = y;
      }
    }
  }
  bool is_first = true;
  decltype(cost(TreeBox{})) least{};
  uint32_t best = 0;
  const auto offer = [&](uint32_t triangle, const TreeBox& box) {
    const auto its_cost = cost(box);
    if (!is_first && !(its_cost < least)) return;
    is_first = false;
    least = its_cost;
    best = triangle;
  };
  const CellRange cells = cells_of_block(field, levels[0], i, j);
  for_each_cell(field, cells, [&](uint32_t x, uint32_t y, const CellHeights& heights) {
    const uint32_t triangle = 2 * (y * field.cells_x() + x);
    for (const uint32_t k : {0u, 1u}) {
      const HeightRange& range = k == 0 ? heights.below : heights.above;
      offer(triangle + k,
            {{field.x(x), field.y(y), range.low}, {field.x(x + 1), field.y(y + 1), range.high}});
    }
  });
  return best;
}

}  // namespace

CellRange cells_at(const HeightFieldGeometry& field, const Double3& lower, const Double3& upper) {
  const auto [first_i, end_i] = cells_between(lower[0], upper[0], field.dx(), field.cells_x());
  const auto [first_j, end_j] = cells_between(lower[1], upper[1], field.dy(), field.cells_y());
  return {first_i, end_i, first_j, end_j};
}

void find_touching(const HeightFieldGeometry& field, const RoundedBox& box, ItemsFound found) {
  const CellRange cells = cells_at(field, box);
  if (cells.is_empty()) return;
  if (box.squared_radius == 0) {
    find_touching_of(field, cells, TouchesBox{box.box}, found);
  } else {
    find_touching_of(field, cells, TouchesRounded{box.box, box.squared_radius}, found);
  }
}

bool may_touch(const HeightFieldGeometry& field, const TreeBox& box) {
  bool touches = false;
  for_each_block(
      field, [&](const TreeBox& each) { return !touches && TouchesBox{box}(each); },
      [&](const CellRange& /*cells*/) { touches = true; });
  return touches;
}

void find_below(const HeightFieldGeometry& field, const Double3& normal, double limit,
                FunctionRef<void(uint32_t triangle)> found) {
  find_admitted(
      field, [&](const TreeBox& box) { return lowest(box, normal) <= limit; },
      [&](std::span<const uint32_t> triangles) {
        for (const uint32_t triangle : triangles) found(triangle);
      });
}

void find_admitted(const HeightFieldGeometry& field, FunctionRef<bool(const TreeBox& box)> admits,
                   ItemsFound found) {
  Collector collector(found);
  for_each_block(field, admits, [&](const CellRange& cells) {
    collect_admitted(field, cells, admits, collector);
  });
  collector.hand_on();
}

uint32_t near_triangle(const HeightFieldGeometry& field, const TreeBox& box) {
  return best_triangle(field, [&](const TreeBox& each) { return distance(each, box); });
}

uint32_t low_triangle(const HeightFieldGeometry& field, const Double3& normal) {
  return best_triangle(field, [&](const TreeBox& each) { return lowest(each, normal); });
}

}  // namespace carom
