// Trees of boxes, eight children a node: which of many boxes touch one box, or those of another
// tree.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "shapes/turn.h"

namespace carom {

// Closed. Empty (a lower end is greater than the upper one, or not a number): touches nothing.
struct TreeBox {
  std::array<float, 3> lower, upper;
};

// All that is within a radius of a box: a ball, if the box is a point.
struct RoundedBox {
  TreeBox box;
  float squared_radius = 0;
};

// From the frame of one tree to that of another: x -> turn x + offset.
struct FrameChange {
  std::array<Double3, 3> turn;  // rows of a rotation
  Double3 offset;

  FrameChange inverse() const;
  // The box that holds all points within `reach` of the turned box along every axis, rounded
  // outwards. Ends beyond the range of float32 become its largest numbers.
  TreeBox around(const TreeBox& box, double reach) const;
};

// The box of that middle and half size, rounded outwards as above.
TreeBox rounded_outwards(const Double3& middle, const Double3& half);

// The same within a radius, rounded up; where its square would leave the range of float32 a box
// that has been grown by it.
RoundedBox rounded_outwards(const Double3& middle, const Double3& half, double radius);

class BoxTree {
 public:
  static constexpr size_t kChildren = 8;
  static constexpr uint32_t kItem = 0x80000000u;
  static constexpr size_t kMostItems = kItem;

  // A child is a node, or an item + kItem; places without one have an empty box.
  struct alignas(32) Node {
    float lower[3][kChildren];
    float upper[3][kChildren];
    uint32_t child[kChildren];

    TreeBox box(size_t i) const {
      return {{lower[0][i], lower[1][i], lower[2][i]}, {upper[0][i], upper[1][i], upper[2][i]}};
    }
  };

  // Item i is boxes[i]; empty ones are left out. At most kMostItems.
  explicit BoxTree(std::span<const TreeBox> boxes);

  // The same by sorting: made some ten times as fast, and for searches not quite as good. For
  // boxes that change all the time. The same nodes for any number of threads.
  static BoxTree packed(std::span<const TreeBox> boxes, Parallelism parallelism);

  bool is_empty() const { return nodes_.empty(); }
  std::span<const Node> nodes() const { return nodes_; }  // the first is the root
  size_t bytes() const { return nodes_.capacity() * sizeof(Node); }

  // The set found is the same on every ISA, its order as well.
  void find_touching(const RoundedBox& box, FunctionRef<void(uint32_t item)> found) const;

  // Items of which a corner has normal . x <= limit.
  void find_below(const Double3& normal, double limit,
                  FunctionRef<void(uint32_t item)> found) const;

  // An item that is about the nearest to a box. The tree is not empty.
  uint32_t near_item(const TreeBox& box) const;

  // An item that is about the lowest along a direction. The tree is not empty.
  uint32_t low_item(const Double3& normal) const;

 private:
  BoxTree() = default;

  std::vector<Node> nodes_;
};

// Every pair of items of `a` and `b` whose boxes touch once those of b, brought to the frame of a,
// have been grown by `reach`; a few more, since turned boxes are boxed again.
void find_touching_items(const BoxTree& a, const BoxTree& b, const FrameChange& b_to_a,
                         double reach, FunctionRef<void(uint32_t item_a, uint32_t item_b)> found);

}  // namespace carom
