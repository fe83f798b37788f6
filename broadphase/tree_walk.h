// Finds the boxes of a tree that a moving box meets, or that are near a box, nearest first.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "trees/box_path.h"

namespace carom {

// A box that moves along a line for t from 0 to 1. The box, and the box that holds its path, may be
// infinite.
struct MovingBox {
  TreeBox box;
  std::array<float, 3> displacement;
  BoxPath path;

  void set(const TreeBox& at_start, const std::array<float, 3>& its_displacement);
  // The box that holds the path.
  TreeBox swept() const;
};

// The children of nodes that a search has still to visit; it visits the last one next. The key is a
// lower bound of the time at which the moving box meets the child, or of the distance. No key is
// NaN.
class TreeWalk {
 public:
  struct Step {
    float key;
    uint32_t child;
  };

  // Starts a search at the root.
  void start(const BoxTree& tree) {
    count_ = 0;
    if (tree.is_empty()) return;
    *room(1) = {0, 0};
    add(1);
  }

  bool is_done() const { return count_ == 0; }
  Step take() { return steps_[--count_]; }

  // The place behind the last step, with room for `most` steps; add() takes those that are there.
  Step* room(size_t most) {
    if (steps_.size() < count_ + most) steps_.resize(2 * (count_ + most));
    return steps_.data() + count_;
  }
  void add(size_t count) { count_ += count; }

 private:
  std::vector<Step> steps_;  // the first count_ are in use
  size_t count_ = 0;
};

// Appends items that the box meets to `items`, until it has added `most` or none are left. All
// calls together give the items that pass one test of their boxes, which errs on the side of a hit
// by a millionth. Items whose key is above the limit need not be found. The items and their order
// are the same on every ISA.
void walk_met(const BoxTree& tree, const MovingBox& box, float limit, size_t most, TreeWalk& walk,
              std::vector<uint32_t>& items);

// A search for boxes that a moving box meets, as the arguments of walk_met().
struct MetSearch {
  const BoxTree* tree;
  const MovingBox* box;
  float limit;
  TreeWalk* walk;
  uint32_t* items;   // room for `most`
  size_t count = 0;  // of items, which the search adds
};

// Goes on with many searches side by side, so that they wait for memory together. Each of them
// finds what it finds alone.
void walk_met(std::span<MetSearch> searches, size_t most);

// As the first, for items whose distance from the box is at most the limit.
void walk_near(const BoxTree& tree, const TreeBox& box, float limit, size_t most, TreeWalk& walk,
               std::vector<uint32_t>& items);

}  // namespace carom
