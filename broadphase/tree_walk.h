// Which boxes of a tree one box meets on its way, or has near it; the first ones first.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "trees/tree.h"

namespace carom {

// A box that moves along a line for t from 0 to 1. The box and what it sweeps may be infinite.
struct MovingBox {
  TreeBox box;
  TreeBox swept;
  // Where it hardly moves along an axis, 1 / displacement is 0 there, and `still` infinite.
  std::array<float, 3> inverse_displacement{};
  std::array<float, 3> still{};

  MovingBox(const TreeBox& at_start, const std::array<float, 3>& displacement);
};

// What is left to look at: children of nodes, the next one last. The key is a lower bound of the
// time at which the moving box meets it, or of its distance. No key is NaN.
class TreeWalk {
 public:
  struct Step {
    float key;
    uint32_t child;
  };

  // From the root.
  void start(const BoxTree& tree) {
    steps_.clear();
    if (!tree.is_empty()) steps_.push_back({0, 0});
  }

  bool is_done() const { return steps_.empty(); }
  std::vector<Step>& steps() { return steps_; }

 private:
  std::vector<Step> steps_;
};

// Appends items that the box meets to `items`, until there are `most` more or none are left. The
// items of all calls together are those that pass one test of their boxes, which errs on the side
// of a hit by a millionth; of items whose key is above the limit none need be found. What is found,
// and in which order, is the same on every ISA.
void walk_met(const BoxTree& tree, const MovingBox& box, float limit, size_t most, TreeWalk& walk,
              std::vector<uint32_t>& items);

// The same for items whose distance from the box is not above the limit.
void walk_near(const BoxTree& tree, const TreeBox& box, float limit, size_t most, TreeWalk& walk,
               std::vector<uint32_t>& items);

}  // namespace carom
