// Builds a tree bottom up: puts eight neighbours in the order of packed_order() into a node, and
// eight nodes into a node above. Refitting keeps who is whose neighbour.
#include <algorithm>
#include <limits>
#include <numeric>

#include "trees/fit_nodes.h"
#include "trees/packed_order.h"
#include "trees/refitted_tree.h"
#include "trees/tree.h"

namespace carom {
namespace {

constexpr size_t kNodesPerBlock = 512;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr TreeBox kNoChild = {{kNan, kNan, kNan}, {kNan, kNan, kNan}};

void set_box(size_t i, const TreeBox& box, BoxTree::Node& node) {
  for (size_t axis = 0; axis < 3; ++axis) {
    node.lower[axis][i] = box.lower[axis];
    node.upper[axis][i] = box.upper[axis];
  }
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
  node_boxes_.resize(end_);
  area_ = 0;
  for (size_t l = 0; l < levels_.size(); ++l) {
    const Level& level = levels_[l];
    const TreeBox* const of_children = l == 0 ? boxes.data() : node_boxes_.data();
    BlockSum areas(block_count(level.count, kNodesPerBlock));
    for_each_block(level.count, kNodesPerBlock, parallelism,
                   [&](size_t block, size_t begin, size_t end) {
                     const size_t first = level.first + begin;
                     areas.of(block) = fit_nodes(std::span(nodes).subspan(first, end - begin),
                                                 level.children - begin * BoxTree::kChildren,
                                                 of_children, &node_boxes_[first]);
                   });
    area_ += areas.total();
  }
}

BoxTree BoxTree::packed(std::span<const TreeBox> boxes, Parallelism parallelism) {
  BoxTree tree;
  PackedLevels().build(boxes, packed_order(boxes, {}, parallelism), 0, parallelism, tree.nodes_);
  return tree;
}

void RefittedTree::build(size_t first_part, std::span<const TreeBox> boxes,
                         std::span<const uint8_t> parts, Parallelism parallelism) {
  std::vector<BoxTree::Node>& nodes = tree_.nodes_;
  nodes.resize(first_part == 0 ? 1 : levels_[first_part - 1].end());
  for (size_t part = 0; part < kParts; ++part) {
    if (part >= first_part) {
      const std::vector<uint64_t> items = packed_order(boxes, {parts, part}, parallelism);
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
    set_box(i, has_nodes ? levels_[i].box() : kNoChild, root);
  }
}

}  // namespace carom
