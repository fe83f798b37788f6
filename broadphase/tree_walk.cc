// Tests the eight boxes of a node in lanes: against one moving box, or for their distance from a
// box.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broadphase/tree_walk.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <bit>
#include <utility>

#include "broadphase/tree_walk.h"
#include "trees/box_path-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// The keys are times.
struct Meeting {
  const MovingBox& moving;

  HWY_INLINE ChildMask test(const BoxTree::Node& node, size_t i, float limit, Children& key) const {
    const ChildTag tag;
    const auto is_there =
        hn::Le(hn::Load(tag, node.lower[0] + i), hn::Load(tag, node.upper[0] + i));
    return hn::And(is_there, meets(moving.path, node, i, limit, key));
  }
};

// A bound on the rounding of lengths.
inline constexpr float kGapRounding = 0x1p-20f;

// The keys are distances.
struct Nearness {
  const TreeBox& box;

  HWY_INLINE ChildMask test(const BoxTree::Node& node, size_t i, float limit, Children& key) const {
    const ChildTag tag;
    ChildMask is_there = hn::Eq(hn::Zero(tag), hn::Zero(tag));
    Children squared = hn::Zero(tag), greatest = hn::Zero(tag);
    for (size_t axis = 0; axis < 3; ++axis) {
      const Children lower = hn::Load(tag, node.lower[axis] + i);
      const Children upper = hn::Load(tag, node.upper[axis] + i);
      is_there = hn::And(is_there, hn::Le(lower, upper));
      const Children gap = max(hn::Sub(lower, child_splat(box.upper[axis])),
                               hn::Sub(child_splat(box.lower[axis]), upper));
      greatest = max(gap, greatest);
      const Children apart = max(gap, hn::Zero(tag));
      squared = hn::Add(squared, hn::Mul(apart, apart));
    }
    // The squares underflow or overflow before the lengths do.
    const Children length = hn::Sqrt(squared);
    const auto in_range = hn::Le(length, child_splat(FLT_MAX));
    const Children distance = hn::IfThenElse(in_range, max(length, greatest), greatest);
    key = hn::Mul(distance, child_splat(1 - kGapRounding));
    return hn::And(is_there, hn::Le(key, child_splat(limit)));
  }
};

constexpr bool is_item(uint32_t child) { return child >= BoxTree::kItem; }

// Sorts by falling keys, since the last step is taken next.
HWY_INLINE void sort_steps(TreeWalk::Step* begin, TreeWalk::Step* end) {
  for (TreeWalk::Step* i = begin + 1; i < end; ++i) {
    const TreeWalk::Step step = *i;
    TreeWalk::Step* hole = i;
    for (; hole > begin && hole[-1].key < step.key; --hole) *hole = hole[-1];
    *hole = step;
  }
}

// Adds the children of a node that pass the test, the nearest last.
template <class Test>
HWY_INLINE void expand(const BoxTree::Node* nodes, uint32_t index, const Test& test, float limit,
                       TreeWalk& walk) {
  const BoxTree::Node& node = nodes[index];
  TreeWalk::Step* const begin = walk.room(BoxTree::kChildren);
  TreeWalk::Step* end = begin;
  for (size_t i = 0; i < BoxTree::kChildren; i += kChildLanes) {
    Children key;
    uint32_t bits = child_bits(test.test(node, i, limit, key));
    alignas(64) float keys[kChildLanes];
    hn::Store(key, ChildTag(), keys);
    for (; bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<size_t>(std::countr_zero(bits));
      const uint32_t child = node.child[i + lane];
      if (!is_item(child)) prefetch_node(nodes[child]);
      *end++ = {keys[lane], child};
    }
  }
  sort_steps(begin, end);
  walk.add(static_cast<size_t>(end - begin));
}

// Goes on until an inner node has been expanded. Calls found(item), which returns whether more
// items are wanted. False at the end of the search, or if no more are wanted.
template <class Test, class Found>
HWY_INLINE bool expand_next(const BoxTree::Node* nodes, const Test& test, float limit,
                            TreeWalk& walk, const Found& found) {
  while (!walk.is_done()) {
    const TreeWalk::Step step = walk.take();
    if (step.key > limit) continue;
    if (!is_item(step.child)) {
      expand(nodes, step.child, test, limit, walk);
      return true;
    }
    if (!found(step.child - BoxTree::kItem)) return false;
  }
  return false;
}

template <class Test>
HWY_INLINE void go_on(const BoxTree& tree, const Test& test, float limit, size_t most,
                      TreeWalk& walk, std::vector<uint32_t>& items) {
  const BoxTree::Node* const nodes = tree.nodes().data();
  const size_t enough = items.size() + most;
  const auto found = [&](uint32_t item) {
    items.push_back(item);
    return items.size() < enough;
  };
  while (expand_next(nodes, test, limit, walk, found)) {
  }
}

void go_on_meeting(const BoxTree& tree, const MovingBox& box, float limit, size_t most,
                   TreeWalk& walk, std::vector<uint32_t>& items) {
  go_on(tree, Meeting{box}, limit, most, walk, items);
}

void go_on_meeting_side_by_side(std::span<MetSearch> searches, size_t most) {
  constexpr size_t kSideBySide = 16;
  std::array<MetSearch*, kSideBySide> active;
  size_t started = 0, count = 0;
  const auto start = [&](size_t i) {
    if (started == searches.size()) return false;
    active[i] = &searches[started++];
    return true;
  };
  while (count < kSideBySide && start(count)) ++count;
  for (size_t i = 0; count > 0; i = i + 1 < count ? i + 1 : 0) {
    MetSearch& search = *active[i];
    const auto found = [&](uint32_t item) {
      search.items[search.count++] = item;
      return search.count < most;
    };
    if (expand_next(search.tree->nodes().data(), Meeting{*search.box}, search.limit, *search.walk,
                    found)) {
      continue;
    }
    if (!start(i)) active[i] = active[--count];
  }
}

void go_on_near(const BoxTree& tree, const TreeBox& box, float limit, size_t most, TreeWalk& walk,
                std::vector<uint32_t>& items) {
  go_on(tree, Nearness{box}, limit, most, walk, items);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <cmath>

#include "base/outward.h"
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(go_on_meeting);
HWY_EXPORT(go_on_meeting_side_by_side);
HWY_EXPORT(go_on_near);

}  // namespace

namespace {

bool moves_along(float displacement) {
  return std::abs(displacement) >= BoxPath::kLeastDisplacement;
}

// Makes [lower, upper] hold the way, too.
void sweep(float& lower, float& upper, float d) {
  // A unit in the last place may be longer than a way along which nothing moves.
  const bool moves = moves_along(d);
  if (d < 0) lower = moves ? next_down(lower + d) : sum_downwards(lower, d);
  if (d > 0) upper = moves ? next_up(upper + d) : sum_upwards(upper, d);
}

}  // namespace

void MovingBox::set(const TreeBox& at_start, const std::array<float, 3>& its_displacement) {
  box = at_start;
  for (size_t axis = 0; axis < 3; ++axis) {
    const float d = its_displacement[axis];
    displacement[axis] = d;
    float lower = box.lower[axis], upper = box.upper[axis];
    if (!moves_along(d)) sweep(lower, upper, d);
    path.set(axis, lower, upper, moves_along(d) ? 1 / d : INFINITY);
  }
}

TreeBox MovingBox::swept() const {
  TreeBox swept = box;
  for (size_t axis = 0; axis < 3; ++axis) {
    sweep(swept.lower[axis], swept.upper[axis], displacement[axis]);
  }
  return swept;
}

void walk_met(const BoxTree& tree, const MovingBox& box, float limit, size_t most, TreeWalk& walk,
              std::vector<uint32_t>& items) {
  CAROM_DISPATCH(go_on_meeting)(tree, box, limit, most, walk, items);
}

void walk_met(std::span<MetSearch> searches, size_t most) {
  CAROM_DISPATCH(go_on_meeting_side_by_side)(searches, most);
}

void walk_near(const BoxTree& tree, const TreeBox& box, float limit, size_t most, TreeWalk& walk,
               std::vector<uint32_t>& items) {
  CAROM_DISPATCH(go_on_near)(tree, box, limit, most, walk, items);
}

}  // namespace carom
#endif  // HWY_ONCE
