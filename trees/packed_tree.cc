// Builds a tree bottom up: it sorts the boxes along a Morton curve, puts eight neighbours into a
// node, and eight nodes into a node above.
#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>

#include "base/radix_sort.h"
#include "trees/tree.h"

namespace carom {
namespace {

constexpr size_t kItemsPerBlock = 4096;
constexpr size_t kNodesPerBlock = 512;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

float middle_of(const TreeBox& box, size_t axis) {
  return 0.5f * box.lower[axis] + 0.5f * box.upper[axis];
}

// NaN gives 0.
uint32_t floor_between(float x, float most) {
  return static_cast<uint32_t>(x > 0 ? std::min(x, most) : 0);
}

// Keys by which the boxes are sorted: first by size class, the large boxes first, since they would
// spoil the nodes of small ones; then along the curve. The grid covers most of a sample of the
// boxes. A few boxes far away do not matter: they belong to its outermost cells.
class PlaceKeys {
 public:
  static constexpr uint32_t kEmpty = ~0u;  // greater than all keys

  explicit PlaceKeys(std::span<const TreeBox> boxes) {
    std::array<float, 3> width{};
    for (size_t axis = 0; axis < 3; ++axis) width[axis] = lay_out(boxes, axis);
    widest_ = *std::max_element(width.begin(), width.end());
    share_bits(width);
    for (size_t axis = 0; axis < 3; ++axis) {
      const float cells = std::ldexp(1.0f, static_cast<int>(cell_bits_[axis]));
      most_[axis] = std::nextafter(cells, 0.0f);
      scale_[axis] = width[axis] > 0 ? std::min(cells / width[axis], FLT_MAX) : 0;
    }
  }

  uint32_t key(const TreeBox& box) const {
    if (is_empty(box)) return kEmpty;
    std::array<uint32_t, 3> cell;
    float extent = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      cell[axis] = floor_between((middle_of(box, axis) - low_[axis]) * scale_[axis], most_[axis]);
      extent = std::max(extent, box.upper[axis] - box.lower[axis]);
    }
    return size_class(extent) << kBits | interleaved(cell);
  }

 private:
  static constexpr size_t kBits = 30;
  static constexpr size_t kSamples = 1024;

  // Sets where the grid begins on this axis, and returns how wide it is.
  float lay_out(std::span<const TreeBox> boxes, size_t axis) {
    const size_t step = std::max<size_t>(1, boxes.size() / kSamples);
    std::vector<float> sample;
    for (size_t i = 0; i < boxes.size(); i += step) {
      const float at = middle_of(boxes[i], axis);
      if (!is_empty(boxes[i]) && std::isfinite(at)) sample.push_back(at);
    }
    if (sample.empty()) return 0;
    std::sort(sample.begin(), sample.end());
    const size_t left_out = sample.size() / 32;
    const float first = sample[left_out];
    const float width = sample[sample.size() - 1 - left_out] - first;
    low_[axis] = first - width / 16;
    return width + width / 8;
  }

  // Gives each bit of the key to the axis on which cells are longest at that point.
  void share_bits(std::array<float, 3> cell) {
    for (size_t bit = kBits; bit-- > 0;) {
      const size_t axis =
          static_cast<size_t>(std::max_element(cell.begin(), cell.end()) - cell.begin());
      cell[axis] /= 2;
      place_of_bit_[axis][cell_bits_[axis]++] = static_cast<uint8_t>(bit);
    }
  }

  uint32_t size_class(float extent) const {
    if (extent > widest_ / 4) return 0;
    return extent > widest_ / 32 ? 1 : 2;
  }

  uint32_t interleaved(const std::array<uint32_t, 3>& cell) const {
    uint32_t key = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      const size_t bits = cell_bits_[axis];
      for (size_t i = 0; i < bits; ++i) {
        key |= (cell[axis] >> (bits - 1 - i) & 1) << place_of_bit_[axis][i];
      }
    }
    return key;
  }

  std::array<float, 3> low_{}, scale_{}, most_{};
  float widest_ = 0;
  std::array<size_t, 3> cell_bits_{};
  std::array<std::array<uint8_t, kBits>, 3> place_of_bit_{};  // the highest bit of a cell first
};

// The boxes that are not empty, in the order of their keys: key << 32 | item.
std::vector<uint64_t> sorted_items(std::span<const TreeBox> boxes, Parallelism parallelism) {
  const PlaceKeys keys(boxes);
  std::vector<uint64_t> items(boxes.size()), scratch;
  for_each_block(boxes.size(), kItemsPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) items[i] = uint64_t{keys.key(boxes[i])} << 32 | i;
  });
  std::vector<uint32_t> histograms;
  radix_sort_by_key(items, scratch, histograms, parallelism);
  const auto empty =
      std::lower_bound(items.begin(), items.end(), uint64_t{PlaceKeys::kEmpty} << 32);
  items.erase(empty, items.end());
  return items;
}

void set_child(size_t i, uint32_t child, const TreeBox& box, BoxTree::Node& node) {
  node.child[i] = child;
  for (size_t axis = 0; axis < 3; ++axis) {
    node.lower[axis][i] = box.lower[axis];
    node.upper[axis][i] = box.upper[axis];
  }
}

TreeBox box_of(const BoxTree::Node& node) {
  TreeBox box = node.box(0);
  // comparisons with the NaN of an empty place are false
  for (size_t i = 1; i < BoxTree::kChildren; ++i) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const float lower = node.lower[axis][i], upper = node.upper[axis][i];
      if (lower < box.lower[axis]) box.lower[axis] = lower;
      if (upper > box.upper[axis]) box.upper[axis] = upper;
    }
  }
  return box;
}

// Fills nodes [first, first + count) with children 0, 1, ... of `children`: get(child, place, node)
// sets one.
template <class Get>
void fill_nodes(size_t first, size_t count, size_t children, Parallelism parallelism,
                std::vector<BoxTree::Node>& nodes, const Get& get) {
  constexpr TreeBox kNothing = {{kNan, kNan, kNan}, {kNan, kNan, kNan}};
  for_each_block(count, kNodesPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      BoxTree::Node& node = nodes[first + i];
      for (size_t k = 0; k < BoxTree::kChildren; ++k) {
        const size_t child = i * BoxTree::kChildren + k;
        if (child < children) {
          get(child, k, node);
        } else {
          set_child(k, BoxTree::kItem, kNothing, node);
        }
      }
    }
  });
}

}  // namespace

BoxTree BoxTree::packed(std::span<const TreeBox> boxes, Parallelism parallelism) {
  BoxTree tree;
  const std::vector<uint64_t> items = sorted_items(boxes, parallelism);
  if (items.empty()) return tree;
  // from the lowest level up
  std::vector<size_t> level_sizes = {block_count(items.size(), kChildren)};
  while (level_sizes.back() > 1) {
    level_sizes.push_back(block_count(level_sizes.back(), kChildren));
  }
  size_t first = 0;  // first node of the level; the levels are stored from the root down
  for (const size_t size : level_sizes) first += size;
  tree.nodes_.resize(first);
  std::vector<Node>& nodes = tree.nodes_;
  first -= level_sizes[0];
  fill_nodes(first, level_sizes[0], items.size(), parallelism, nodes,
             [&](size_t child, size_t place, Node& node) {
               const auto item = static_cast<uint32_t>(items[child]);
               set_child(place, item + kItem, boxes[item], node);
             });
  for (size_t level = 1; level < level_sizes.size(); ++level) {
    const size_t below = first;
    first -= level_sizes[level];
    fill_nodes(first, level_sizes[level], level_sizes[level - 1], parallelism, nodes,
               [&](size_t child, size_t place, Node& node) {
                 set_child(place, static_cast<uint32_t>(below + child),
                           box_of(nodes[below + child]), node);
               });
  }
  return tree;
}

}  // namespace carom
