// A packed tree that follows boxes which move a little from call to call.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "trees/tree.h"

namespace carom {

// Where the levels of a packed tree are among the nodes: one after another, from the root down.
class PackedLevels {
 public:
  struct Level {
    size_t first;     // node
    size_t count;     // of nodes
    size_t children;  // of all nodes
  };

  // Builds the tree of these items, whose order is that of the list (key << 32 | item), in
  // nodes[first_node] and those behind.
  void build(std::span<const TreeBox> boxes, std::span<const uint64_t> items, size_t first_node,
             Parallelism parallelism, std::vector<BoxTree::Node>& nodes);
  // Gives the nodes the boxes of now, which may be empty.
  void refit(std::span<const TreeBox> boxes, Parallelism parallelism,
             std::vector<BoxTree::Node>& nodes);

  bool has_nodes() const { return end_ > first_; }
  size_t first() const { return first_; }  // the root
  size_t end() const { return end_; }
  const TreeBox& box() const { return node_boxes_[first_]; }  // of the root
  // The sum of the areas of all nodes, and that when the tree was built.
  double area() const { return area_; }
  double area_when_built() const { return area_when_built_; }

 private:
  void lay_out(size_t first_node, size_t items);

  std::vector<Level> levels_;        // from the items up
  std::vector<TreeBox> node_boxes_;  // by node; those of other parts are not set
  size_t first_ = 0, end_ = 0;
  double area_ = 0, area_when_built_ = 0;
};

// Two packed trees under one root, which are refitted and rebuilt apart: things that seldom move do
// not pay for those that do. What a search finds does not depend on when the tree was built, only
// its cost does.
class RefittedTree {
 public:
  static constexpr size_t kParts = 2;
  // A search visits a node about as often as its area is large. A part is worn if the areas of its
  // nodes sum to more than this, relative to when it was built.
  static constexpr double kWorn = 2;

  // Builds the given part and those behind it. Item i, boxes[i], is in part parts[i], or in none if
  // there is no such part or its box is empty.
  void build(size_t first_part, std::span<const TreeBox> boxes, std::span<const uint8_t> parts,
             Parallelism parallelism);
  // Gives a part the boxes of now. Boxes may become empty, but an item that was in no part when the
  // part was built stays out of it.
  void refit(size_t part, std::span<const TreeBox> boxes, Parallelism parallelism);

  bool is_built() const { return !tree_.is_empty(); }
  bool is_worn(size_t part) const {
    return levels_[part].area() > kWorn * levels_[part].area_when_built();
  }
  const BoxTree& tree() const { return tree_; }

 private:
  void fit_root();

  BoxTree tree_;
  std::array<PackedLevels, kParts> levels_;
};

}  // namespace carom
