// Finds the boxes of a tree that a moving box meets, or that are near a box, nearest first.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "trees/tree.h"

namespace carom {

// A box that moves along a line for t from 0 to 1. The box, and the box that holds its path, may be
// infinite.
struct MovingBox {
  TreeBox box;
  TreeBox swept;
  // On an axis along which the box hardly moves, inverse_displacement is 0 and `still` infinite.
  std::array<float, 3> inverse_displacement{};
  std::array<float, 3> still{};

  MovingBox(const TreeBox& at_start, const std::array<float, 3>& displacement);
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
    steps_.clear();
    if (!tree.is_empty()) steps_.push_back({0, 0});
  }

  bool is_done() const { return steps_.empty(); }
  std::vector<Step>& steps() { return steps_; }

 private:
  std::vector<Step> steps_;
};

// Appends items that the box meets to `items`, until it has added `most` or none are left. All
// calls together give the items that pass one test of their boxes, which errs on the side of a hit
// by a millionth. Items whose key is above the limit need not be found. The items and their order
// are the same on every ISA.
void walk_met(const BoxTree& tree, const MovingBox& box, float limit, size_t most, TreeWalk& walk,
              std::vector<uint32_t>& items);

// The same for items whose distance from the box is at most the limit.
void walk_near(const BoxTree& tree, const TreeBox& box, float limit, size_t most, TreeWalk& walk,
               std::vector<uint32_t>& items);

}  // namespace carom
