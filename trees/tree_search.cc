// Tests the eight boxes of a node against one box in lanes.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trees/tree_search.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <hwy/cache_control.h>

#include <algorithm>
#include <bit>
#include <span>
#include <vector>

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

// Bit i is set if child i touches the box.
HWY_INLINE uint32_t touching(const BoxTree::Node& node, const TreeBox& box) {
  uint32_t bits = 0;
  for (size_t i = 0; i < BoxTree::kChildren; i += kChildLanes) {
    bits |= static_cast<uint32_t>(bits_of(ChildTag(), touching(node, i, box))) << i;
  }
  return bits;
}

template <class Use>
HWY_INLINE void for_each_bit(uint32_t bits, const Use& use) {
  for (; bits != 0; bits &= bits - 1) use(static_cast<size_t>(std::countr_zero(bits)));
}

constexpr bool is_item(uint32_t child) { return child >= BoxTree::kItem; }

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
  constexpr size_t kAtOnce = 128;
  const hn::RebindToUnsigned<ChildTag> tag;
  const BoxTree::Node* const nodes = tree.nodes().data();
  uint32_t waiting[kMostWaiting + kChildLanes], items[kAtOnce + BoxTree::kChildren];
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

// Two children, nodes or items, whose boxes touch. If one is an item, `box` is its box in the frame
// of the other's tree.
struct Meeting {
  uint32_t a, b;
  TreeBox box;
};

// `found` may start another search. Each search uses only the part of the stack above its own
// start.
class MeetingStack {
 public:
  explicit MeetingStack(std::vector<Meeting>& all) : all_(all), start_(all.size()) {}
  ~MeetingStack() { all_.resize(start_); }
  MeetingStack(const MeetingStack&) = delete;
  MeetingStack& operator=(const MeetingStack&) = delete;

  bool is_empty() const { return all_.size() == start_; }
  void push(const Meeting& meeting) { all_.push_back(meeting); }
  Meeting pop() {
    const Meeting last = all_.back();
    all_.pop_back();
    return last;
  }

 private:
  std::vector<Meeting>& all_;
  const size_t start_;
};

class TreePair {
 public:
  TreePair(const BoxTree& a, const BoxTree& b, const FrameChange& b_to_a, double reach,
           FunctionRef<void(uint32_t, uint32_t)> found)
      : nodes_a_(a.nodes().data()),
        nodes_b_(b.nodes().data()),
        b_to_a_(b_to_a),
        a_to_b_(b_to_a.inverse()),
        reach_(reach),
        found_(found) {}

  void run(MeetingStack& stack) const {
    stack.push({0, 0, {}});
    while (!stack.is_empty()) {
      const Meeting m = stack.pop();
      if (is_item(m.b)) {
        item_of_b(m, stack);
      } else if (is_item(m.a)) {
        item_of_a(m, stack);
      } else {
        two_nodes(m, stack);
      }
    }
  }

 private:
  void two_nodes(const Meeting& m, MeetingStack& stack) const {
    const BoxTree::Node& a = nodes_a_[m.a];
    const BoxTree::Node& b = nodes_b_[m.b];
    for (size_t j = 0; j < BoxTree::kChildren; ++j) {
      const TreeBox box = b.box(j);
      if (!(box.lower[0] <= box.upper[0])) continue;
      const TreeBox in_a = b_to_a_.around(box, reach_);
      for_each_bit(touching(a, in_a), [&](size_t i) {
        if (is_item(a.child[i]) && is_item(b.child[j])) {
          found_(a.child[i] - BoxTree::kItem, b.child[j] - BoxTree::kItem);
        } else if (is_item(b.child[j])) {
          stack.push({a.child[i], b.child[j], in_a});
        } else if (is_item(a.child[i])) {
          stack.push({a.child[i], b.child[j], a_to_b_.around(a.box(i), reach_)});
        } else {
          stack.push({a.child[i], b.child[j], {}});
        }
      });
    }
  }

  void item_of_b(const Meeting& m, MeetingStack& stack) const {
    const BoxTree::Node& a = nodes_a_[m.a];
    for_each_bit(touching(a, m.box), [&](size_t i) {
      if (is_item(a.child[i])) {
        found_(a.child[i] - BoxTree::kItem, m.b - BoxTree::kItem);
      } else {
        stack.push({a.child[i], m.b, m.box});
      }
    });
  }

  void item_of_a(const Meeting& m, MeetingStack& stack) const {
    const BoxTree::Node& b = nodes_b_[m.b];
    for_each_bit(touching(b, m.box), [&](size_t j) {
      if (is_item(b.child[j])) {
        found_(m.a - BoxTree::kItem, b.child[j] - BoxTree::kItem);
      } else {
        stack.push({m.a, b.child[j], m.box});
      }
    });
  }

  const BoxTree::Node* nodes_a_;
  const BoxTree::Node* nodes_b_;
  const FrameChange& b_to_a_;
  const FrameChange a_to_b_;
  const double reach_;
  FunctionRef<void(uint32_t, uint32_t)> found_;
};

void touching_pairs(const BoxTree& a, const BoxTree& b, const FrameChange& b_to_a, double reach,
                    FunctionRef<void(uint32_t, uint32_t)> found) {
  if (a.is_empty() || b.is_empty()) return;
  static thread_local std::vector<Meeting> meetings;
  MeetingStack stack(meetings);
  TreePair(a, b, b_to_a, reach, found).run(stack);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(touching_items);
HWY_EXPORT(touching_pairs);

void BoxTree::find_touching(const RoundedBox& box, ItemsFound found) const {
  CAROM_DISPATCH(touching_items)(*this, box, found);
}

void find_touching_items(const BoxTree& a, const BoxTree& b, const FrameChange& b_to_a,
                         double reach, FunctionRef<void(uint32_t, uint32_t)> found) {
  CAROM_DISPATCH(touching_pairs)(a, b, b_to_a, reach, found);
}

}  // namespace carom
#endif  // HWY_ONCE
