// Builds a tree bottom up: it sorts the boxes along a Morton curve, puts eight neighbours into a
// node, and eight nodes into a node above. Refitting keeps who is whose neighbour.
#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/radix_sort.h"
#include "trees/refitted_tree.h"
#include "trees/tree.h"

namespace carom {
namespace {

constexpr size_t kItemsPerBlock = 4096;
constexpr size_t kNodesPerBlock = 512;
constexpr size_t kNodesAhead = 4;  // whose items are fetched
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr TreeBox kNoChild = {{kNan, kNan, kNan}, {kNan, kNan, kNan}};

// Which items belong to a part of a tree. Without a list, all do.
struct PartOfItem {
  std::span<const uint8_t> parts = {};
  size_t part = 0;

  bool has(size_t item) const { return parts.empty() || parts[item] == part; }
};

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

  PlaceKeys(std::span<const TreeBox> boxes, const PartOfItem& part) {
    std::array<float, 3> width{};
    for (size_t axis = 0; axis < 3; ++axis) width[axis] = lay_out(boxes, part, axis);
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
  float lay_out(std::span<const TreeBox> boxes, const PartOfItem& part, size_t axis) {
    const size_t step = std::max<size_t>(1, boxes.size() / kSamples);
    std::vector<float> sample;
    for (size_t i = 0; i < boxes.size(); i += step) {
      const float at = middle_of(boxes[i], axis);
      if (part.has(i) && !is_empty(boxes[i]) && std::isfinite(at)) sample.push_back(at);
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

// The boxes of a part that are not empty, in the order of their keys: key << 32 | item.
std::vector<uint64_t> sorted_items(std::span<const TreeBox> boxes, const PartOfItem& part,
                                   Parallelism parallelism) {
  const PlaceKeys keys(boxes, part);
  std::vector<uint64_t> items(boxes.size()), scratch;
  for_each_block(boxes.size(), kItemsPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const uint32_t key = part.has(i) ? keys.key(boxes[i]) : PlaceKeys::kEmpty;
      items[i] = uint64_t{key} << 32 | i;
    }
  });
  std::vector<uint32_t> histograms;
  radix_sort_by_key(items, scratch, histograms, parallelism);
  const auto empty =
      std::lower_bound(items.begin(), items.end(), uint64_t{PlaceKeys::kEmpty} << 32);
  items.erase(empty, items.end());
  return items;
}

void set_box(size_t i, const TreeBox& box, BoxTree::Node& node) {
  for (size_t axis = 0; axis < 3; ++axis) {
    node.lower[axis][i] = box.lower[axis];
    node.upper[axis][i] = box.upper[axis];
  }
}

// The box of all children. It is empty if all of them are.
TreeBox box_of(const BoxTree::Node& node) {
  TreeBox box = kNothing;
  for (size_t axis = 0; axis < 3; ++axis) {
    // comparisons with the NaN of an empty place are false
    for (size_t i = 0; i < BoxTree::kChildren; ++i) {
      const float lower = node.lower[axis][i], upper = node.upper[axis][i];
      box.lower[axis] = lower < box.lower[axis] ? lower : box.lower[axis];
      box.upper[axis] = upper > box.upper[axis] ? upper : box.upper[axis];
    }
  }
  return box;
}

// A sum of terms that threads add block by block, in an order that does not depend on them.
class BlockSum {
 public:
  explicit BlockSum(size_t blocks) : terms_(blocks) {}
  double& of(size_t block) { return terms_[block]; }
  double total() const { return std::accumulate(terms_.begin(), terms_.end(), 0.0); }

 private:
  std::vector<double> terms_;
};

// The nodes of one level get the boxes of their children, and keep which children they are. Returns
// the sum of the areas of the boxes of the level.
template <class BoxOf, class Fetch>
double fit_level(const PackedLevels::Level& level, Parallelism parallelism,
                 std::vector<BoxTree::Node>& nodes, const BoxOf& box_of_child,
                 const Fetch& fetch_child) {
  BlockSum areas(block_count(level.count, kNodesPerBlock));
  for_each_block(level.count, kNodesPerBlock, parallelism,
                 [&](size_t block, size_t begin, size_t end) {
                   double sum = 0;
                   for (size_t i = begin; i < end; ++i) {
                     BoxTree::Node& node = nodes[level.first + i];
                     if (i + kNodesAhead < end) {
                       const BoxTree::Node& later = nodes[level.first + i + kNodesAhead];
                       for (const uint32_t child : later.child) fetch_child(child);
                     }
                     for (size_t k = 0; k < BoxTree::kChildren; ++k) {
                       const size_t child = i * BoxTree::kChildren + k;
                       if (child < level.children) set_box(k, box_of_child(node.child[k]), node);
                     }
                     sum += half_area(box_of(node));
                   }
                   areas.of(block) = sum;
                 });
  return areas.total();
}

}  // namespace

// Lays out the levels of a tree of `items` items from the root down, from this node on.
void PackedLevels::lay_out(size_t first_node, size_t items) {
  levels_.clear();
  first_ = end_ = first_node;
  if (items == 0) return;
  size_t children = items;
  do {
    const size_t count = block_count(children, BoxTree::kChildren);
    levels_.push_back({0, count, children});
    children = count;
    end_ += count;
  } while (children > 1);
  size_t next = end_;
  for (Level& level : levels_) level.first = next -= level.count;
}

void PackedLevels::build(std::span<const TreeBox> boxes, std::span<const uint64_t> items,
                         size_t first_node, Parallelism parallelism,
                         std::vector<BoxTree::Node>& nodes) {
  lay_out(first_node, items.size());
  nodes.resize(end_);
  size_t below = 0;  // first node of the level below
  for (size_t l = 0; l < levels_.size(); ++l) {
    const Level& level = levels_[l];
    for_each_block(level.count, kNodesPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
      for (size_t i = begin * BoxTree::kChildren; i < end * BoxTree::kChildren; ++i) {
        BoxTree::Node& node = nodes[level.first + i / BoxTree::kChildren];
        uint32_t child = BoxTree::kItem;
        if (i < level.children) {
          child = l == 0 ? static_cast<uint32_t>(items[i]) + BoxTree::kItem
                         : static_cast<uint32_t>(below + i);
        }
        node.child[i % BoxTree::kChildren] = child;
        set_box(i % BoxTree::kChildren, kNoChild, node);
      }
    });
    below = level.first;
  }
  refit(boxes, parallelism, nodes);
  area_when_built_ = area_;
}

void PackedLevels::refit(std::span<const TreeBox> boxes, Parallelism parallelism,
                         std::vector<BoxTree::Node>& nodes) {
  area_ = 0;
  for (size_t l = 0; l < levels_.size(); ++l) {
    area_ += l == 0 ? fit_level(
                          levels_[l], parallelism, nodes,
                          [&](uint32_t child) { return boxes[child - BoxTree::kItem]; },
                          // the items of neighbours are anywhere in memory
                          [&](uint32_t child) {
                            __builtin_prefetch(boxes.data() + (child - BoxTree::kItem));
                          })
                    : fit_level(
                          levels_[l], parallelism, nodes,
                          [&](uint32_t child) { return box_of(nodes[child]); }, [](uint32_t) {});
  }
}

BoxTree BoxTree::packed(std::span<const TreeBox> boxes, Parallelism parallelism) {
  BoxTree tree;
  PackedLevels().build(boxes, sorted_items(boxes, {}, parallelism), 0, parallelism, tree.nodes_);
  return tree;
}

void RefittedTree::build(size_t first_part, std::span<const TreeBox> boxes,
                         std::span<const uint8_t> parts, Parallelism parallelism) {
  std::vector<BoxTree::Node>& nodes = tree_.nodes_;
  nodes.resize(first_part == 0 ? 1 : levels_[first_part - 1].end());
  for (size_t part = 0; part < kParts; ++part) {
    if (part >= first_part) {
      const std::vector<uint64_t> items = sorted_items(boxes, {parts, part}, parallelism);
      levels_[part].build(boxes, items, part == 0 ? 1 : levels_[part - 1].end(), parallelism,
                          nodes);
    }
  }
  fit_root();
}

void RefittedTree::refit(size_t part, std::span<const TreeBox> boxes, Parallelism parallelism) {
  levels_[part].refit(boxes, parallelism, tree_.nodes_);
  fit_root();
}

void RefittedTree::fit_root() {
  BoxTree::Node& root = tree_.nodes_[0];
  for (size_t i = 0; i < BoxTree::kChildren; ++i) {
    const bool has_nodes = i < kParts && levels_[i].has_nodes();
    root.child[i] = has_nodes ? static_cast<uint32_t>(levels_[i].first()) : BoxTree::kItem;
    set_box(i, has_nodes ? box_of(tree_.nodes_[levels_[i].first()]) : kNoChild, root);
  }
}

}  // namespace carom
