// Tests the eight boxes of a node against one box in lanes.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trees/tree_search.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <hwy/cache_control.h>

#include <algorithm>
#include <span>

#include "simd/compress-inl.h"
#include "trees/tree.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

using ChildTag = hn::CappedTag<float, BoxTree::kChildren>;
using ChildMask = hn::Mask<ChildTag>;
inline constexpr size_t kChildLanes = hn::MaxLanes(ChildTag());

// Which of the children from `first` on, a vector of them, touch the box.
HWY_INLINE ChildMask touching(const BoxTree::Node& node, size_t first, const TreeBox& box) {
  const ChildTag tag;
  const auto touches_along = [&](size_t axis) HWY_ATTR {
    return hn::And(hn::Le(hn::Load(tag, node.lower[axis] + first), hn::Set(tag, box.upper[axis])),
                   hn::Ge(hn::Load(tag, node.upper[axis] + first), hn::Set(tag, box.lower[axis])));
  };
  return hn::And(touches_along(0), hn::And(touches_along(1), touches_along(2)));
}

// Which of them are within the radius of the box.
HWY_INLINE ChildMask touching(const BoxTree::Node& node, size_t first, const RoundedBox& rounded) {
  const ChildTag tag;
  const auto& [box, squared_radius] = rounded;
  auto squared = hn::Zero(tag);
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto above =
        hn::Sub(hn::Load(tag, node.lower[axis] + first), hn::Set(tag, box.upper[axis]));
    const auto below =
        hn::Sub(hn::Set(tag, box.lower[axis]), hn::Load(tag, node.upper[axis] + first));
    const auto gap = hn::Max(hn::Max(above, below), hn::Zero(tag));
    squared = hn::Add(squared, hn::Mul(gap, gap));
  }
  return hn::Le(squared, hn::Set(tag, squared_radius));
}

// A bound for the depth. A child of a node is a part of a division of its items, which leaves at
// most 7/8 of them in one part, and 2^31 items are fewer than (8/7)^161.
inline constexpr size_t kMostLevels = 162;

// Without this, a search spends a third of its time waiting for nodes.
HWY_INLINE void prefetch(const BoxTree::Node& node) {
  constexpr size_t kCacheLine = 64;
  for (size_t i = 0; i < sizeof node; i += kCacheLine) {
    hwy::Prefetch(reinterpret_cast<const char*>(&node) + i);
  }
}

// A search visits so many waiting nodes one after the other. None of them depends on what another
// one finds, so that the processor works on several at a time.
inline constexpr size_t kVisits = 8;

// A bound for what waits. Deeper nodes lie on top and go first. So nodes of one level are visited
// only when fewer than kVisits of deeper levels wait, which go with them, and of each level no more
// wait than the children of kVisits nodes.
inline constexpr size_t kMostWaiting = kMostLevels * kVisits * BoxTree::kChildren;

// The items and nodes among the touching children are stored without branches: which they are is as
// random as what touches, and would be predicted badly.
template <class Box>
HWY_INLINE void find_items(const BoxTree& tree, const Box& box, ItemsFound found) {
  constexpr size_t kAtOnce = BoxTree::kMostAtOnce - BoxTree::kChildren;
  const hn::RebindToUnsigned<ChildTag> tag;
  const BoxTree::Node* const nodes = tree.nodes().data();
  uint32_t waiting[kMostWaiting + kChildLanes], items[BoxTree::kMostAtOnce];
  uint32_t visited[kVisits];
  size_t waiting_count = 1, item_count = 0;
  waiting[0] = 0;
  while (waiting_count > 0) {
    const size_t visits = std::min(waiting_count, kVisits);
    waiting_count -= visits;
    std::copy_n(waiting + waiting_count, kVisits, visited);  // always so many: no loop
    for (size_t k = 0; k < visits; ++k) prefetch(nodes[visited[k]]);
    for (size_t k = 0; k < visits; ++k) {
      const BoxTree::Node& node = nodes[visited[k]];
      for (size_t i = 0; i < BoxTree::kChildren; i += kChildLanes) {
        const auto touch = hn::RebindMask(tag, touching(node, i, box));
        const auto children = hn::Load(tag, node.child + i);
        const auto are_items = hn::TestBit(children, hn::Set(tag, BoxTree::kItem));
        const auto numbers = hn::AndNot(hn::Set(tag, BoxTree::kItem), children);
        item_count += compress_store(tag, numbers, hn::And(touch, are_items), items + item_count);
        waiting_count +=
            compress_store(tag, children, hn::AndNot(are_items, touch), waiting + waiting_count);
      }
      if (item_count >= kAtOnce) {
        found({items, item_count});
        item_count = 0;
      }
    }
  }
  if (item_count > 0) found({items, item_count});
}

void touching_items(const BoxTree& tree, const RoundedBox& box, ItemsFound found) {
  if (tree.is_empty()) return;
  if (box.squared_radius == 0) {  // the squares of small distances might underflow
    find_items(tree, box.box, found);
  } else {
    find_items(tree, box, found);
  }
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(touching_items);

void BoxTree::find_touching(const RoundedBox& box, ItemsFound found) const {
  CAROM_DISPATCH(touching_items)(*this, box, found);
}

}  // namespace carom
#endif  // HWY_ONCE
