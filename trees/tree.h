// Trees of boxes with eight children a node. They find which of many boxes touch one box, or the
// boxes of another tree.
#pragma once

#include <array>
#include <cmath>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "shapes/turn.h"

namespace carom {

// A closed box. It is empty, and touches nothing, if a lower end is greater than the upper one or
// NaN.
struct TreeBox {
  std::array<float, 3> lower, upper;
};

inline bool is_empty(const TreeBox& box) {
  for (size_t axis = 0; axis < 3; ++axis) {
    if (!(box.lower[axis] <= box.upper[axis])) return true;
  }
  return false;
}

inline constexpr TreeBox kNothing = {{INFINITY, INFINITY, INFINITY},
                                     {-INFINITY, -INFINITY, -INFINITY}};

// Half of the area of the surface; zero for an empty box.
inline double half_area(const TreeBox& box) {
  if (is_empty(box)) return 0;
  const double x = double{box.upper[0]} - box.lower[0];
  const double y = double{box.upper[1]} - box.lower[1];
  const double z = double{box.upper[2]} - box.lower[2];
  return (x * y + y * z) + z * x;
}

// All points within a radius of a box; a ball if the box is a point.
struct RoundedBox {
  TreeBox box;
  float squared_radius = 0;
};

// A map from the frame of one tree to that of another: x -> turn x + offset.
struct FrameChange {
  std::array<Double3, 3> turn;  // rows of a rotation
  Double3 offset;

  FrameChange inverse() const;
  // The box, rounded outwards, of all points within `reach` of the turned box along every axis.
  // Ends beyond the range of float32 become its largest numbers.
  TreeBox around(const TreeBox& box, double reach) const;
};

// The box with this middle and half size, rounded outwards in the same way.
TreeBox rounded_outwards(const Double3& middle, const Double3& half);

// The same, rounded by `radius`, whose square is rounded up. If that square would leave the range
// of float32, the result is a box that has been grown by the radius instead.
RoundedBox rounded_outwards(const Double3& middle, const Double3& half, double radius);

// Receives some of the items of a tree.
using ItemsFound = FunctionRef<void(std::span<const uint32_t> items)>;

class BoxTree {
 public:
  static constexpr size_t kChildren = 8;
  static constexpr uint32_t kItem = 0x80000000u;
  static constexpr size_t kMostItems = kItem;
  static constexpr size_t kMostAtOnce = 128 + kChildren;  // items given to ItemsFound

  // A child is the index of a node, or kItem + the index of an item. A place without a child has an
  // empty box.
  struct alignas(32) Node {
    float lower[3][kChildren];
    float upper[3][kChildren];
    uint32_t child[kChildren];

    TreeBox box(size_t i) const {
      return {{lower[0][i], lower[1][i], lower[2][i]}, {upper[0][i], upper[1][i], upper[2][i]}};
    }
  };

  // Item i is boxes[i]. Empty boxes are left out. There are at most kMostItems.
  explicit BoxTree(std::span<const TreeBox> boxes);

  // Builds the tree by sorting, some ten times as fast; searches through it are a little slower.
  // For boxes that change all the time. The nodes are the same for any number of threads.
  static BoxTree packed(std::span<const TreeBox> boxes, Parallelism parallelism);

  bool is_empty() const { return nodes_.empty(); }
  std::span<const Node> nodes() const { return nodes_; }  // the first is the root
  size_t bytes() const { return nodes_.capacity() * sizeof(Node); }

  // Calls `found` with all items that touch the box, some at a time. The items and their order are
  // the same on every ISA.
  void find_touching(const RoundedBox& box, ItemsFound found) const;

  // Calls `found` with every item whose box has a corner with normal . x <= limit.
  void find_below(const Double3& normal, double limit,
                  FunctionRef<void(uint32_t item)> found) const;

  // Calls `found` with the items whose boxes `admits` takes, some at a time. It must take every box
  // that holds one that it takes.
  void find_admitted(FunctionRef<bool(const TreeBox& box)> admits, ItemsFound found) const;

  // An item that is about the nearest to a box. The tree must not be empty.
  uint32_t near_item(const TreeBox& box) const;

  // An item that is about the lowest along a direction. The tree must not be empty.
  uint32_t low_item(const Double3& normal) const;

 private:
  friend class RefittedTree;
  BoxTree() = default;

  std::vector<Node> nodes_;
};

// An item of each of two trees.
struct ItemPair {
  uint32_t a, b;

  friend auto operator<=>(const ItemPair&, const ItemPair&) = default;
};

// Items of two trees that are about the nearest to each other. The trees must not be empty.
ItemPair near_items(const BoxTree& a, const BoxTree& b, const FrameChange& b_to_a);

// So many pairs at most are handed on at once.
inline constexpr size_t kMostItemPairs = 512 + BoxTree::kChildren * BoxTree::kChildren;

// Receives some of the pairs of items of two trees, and may change them. Returns the reach of the
// search from now on, if that is less; it may be less than 0.
using ItemPairsFound = FunctionRef<double(std::span<ItemPair> pairs)>;

// Calls `found` with all pairs of items whose boxes touch when those of `b` are put into the frame
// of `a`, each with a box around it that is grown by `reach`, and when those of `a` are put into
// the frame of `b` likewise; some pairs at a time. The pairs and their order are the same on every
// ISA. `reach` may be infinite. It also finds pairs that are further apart by up to 2^-17 of all
// lengths, since it turns boxes in float32.
void find_touching_items(const BoxTree& a, const BoxTree& b, const FrameChange& b_to_a,
                         double reach, ItemPairsFound found);

}  // namespace carom
