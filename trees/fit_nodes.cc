// Puts the boxes of eight children into the columns of a node, and finds the box of all in lanes.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trees/fit_nodes.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <hwy/cache_control.h>
#include <algorithm>

#include "trees/box_rows-inl.h"
#include "trees/fit_nodes.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

constexpr size_t kNodesAhead = 4;  // whose children are fetched

using EndTag = hn::CappedTag<float, BoxTree::kChildren>;
constexpr size_t kEndLanes = hn::MaxLanes(EndTag());

// The child's index among the items or among the nodes.
HWY_INLINE size_t index_of(uint32_t child) { return child & ~BoxTree::kItem; }

// NaN, in an empty place, keeps the other value.
HWY_INLINE float least(const float (&ends)[BoxTree::kChildren]) {
  const EndTag tag;
  auto all = hn::Set(tag, INFINITY);
  for (size_t i = 0; i < BoxTree::kChildren; i += kEndLanes) {
    all = min(hn::Load(tag, ends + i), all);
  }
  return hn::GetLane(hn::MinOfLanes(tag, all));
}
HWY_INLINE float greatest(const float (&ends)[BoxTree::kChildren]) {
  const EndTag tag;
  auto all = hn::Set(tag, -INFINITY);
  for (size_t i = 0; i < BoxTree::kChildren; i += kEndLanes) {
    all = max(hn::Load(tag, ends + i), all);
  }
  return hn::GetLane(hn::MaxOfLanes(tag, all));
}

HWY_INLINE void put(const TreeBox& box, BoxTree::Node& node, size_t place) {
  for (size_t axis = 0; axis < 3; ++axis) {
    node.lower[axis][place] = box.lower[axis];
    node.upper[axis][place] = box.upper[axis];
  }
}

TreeBox box_of_children(const BoxTree::Node& node) {
  TreeBox box;
  for (size_t axis = 0; axis < 3; ++axis) {
    box.lower[axis] = least(node.lower[axis]);
    box.upper[axis] = greatest(node.upper[axis]);
  }
  return box;
}

// Puts the boxes of a node's first `count` children, and returns the box around them.
TreeBox put_some(const TreeBox* boxes, size_t count, BoxTree::Node& node) {
  for (size_t k = 0; k < count; ++k) put(boxes[index_of(node.child[k])], node, k);
  return box_of_children(node);
}

#if HWY_TARGET == HWY_SCALAR
TreeBox put_all(const TreeBox* boxes, BoxTree::Node& node) {
  return put_some(boxes, BoxTree::kChildren, node);
}
#else
HWY_INLINE TreeBox put_all(const TreeBox* boxes, BoxTree::Node& node) {
  const Quad tag;
  BoxRow all = load_row(boxes[index_of(node.child[0])]);
  for (size_t half = 0; half < BoxTree::kChildren; half += 4) {
    RowOfFour first[4], second[4];
    for (size_t k = 0; k < 4; ++k) {
      const BoxRow row = load_row(boxes[index_of(node.child[half + k])]);
      all = {min(row.first, all.first), max(row.second, all.second)};
      first[k] = row.first;
      second[k] = row.second;
    }
    transpose(first);
    transpose(second);
    for (size_t axis = 0; axis < 3; ++axis) {
      hn::Store(first[axis], tag, node.lower[axis] + half);
      hn::Store(second[axis + 1], tag, node.upper[axis] + half);
    }
  }
  alignas(16) float lower[4], upper[4];
  hn::Store(all.first, tag, lower);
  hn::Store(all.second, tag, upper);
  return {{lower[0], lower[1], lower[2]}, {upper[1], upper[2], upper[3]}};
}
#endif  // HWY_TARGET

double fit(std::span<BoxTree::Node> nodes, size_t children, const TreeBox* boxes,
           TreeBox* node_boxes) {
  double area = 0;
  for (size_t i = 0; i < nodes.size(); ++i) {
    BoxTree::Node& node = nodes[i];
    if (i + kNodesAhead < nodes.size()) {
      for (const uint32_t child : nodes[i + kNodesAhead].child) {
        hwy::Prefetch(boxes + index_of(child));
      }
    }
    const size_t count = std::min(BoxTree::kChildren, children - i * BoxTree::kChildren);
    node_boxes[i] =
        count == BoxTree::kChildren ? put_all(boxes, node) : put_some(boxes, count, node);
    area += half_area(node_boxes[i]);
  }
  return area;
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(fit);

}  // namespace

double fit_nodes(std::span<BoxTree::Node> nodes, size_t children, const TreeBox* boxes,
                 TreeBox* node_boxes) {
  return CAROM_DISPATCH(fit)(nodes, children, boxes, node_boxes);
}

}  // namespace carom
#endif  // HWY_ONCE
