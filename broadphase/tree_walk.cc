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
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

using ChildTag = hn::CappedTag<float, BoxTree::kChildren>;
using Children = hn::Vec<ChildTag>;
using ChildMask = hn::Mask<ChildTag>;
inline constexpr size_t kChildLanes = hn::MaxLanes(ChildTag());

HWY_INLINE Children child_splat(float value) { return hn::Set(ChildTag(), value); }

// A bound on the rounding of the times of one axis: a difference, a reciprocal and a product, each
// by 2^-24, or 2^-22 if the reciprocal is subnormal.
inline constexpr float kTimeRounding = 0x1p-20f;
// A bound on what products lose by underflow.
inline constexpr float kTinyTime = 0x1p-100f;

// The keys are times. Every step of the test is a function that never decreases, so a node passes
// whenever one of its children does.
struct Meeting {
  const MovingBox& moving;

  HWY_INLINE ChildMask test(const BoxTree::Node& node, size_t i, Children& key) const {
    const ChildTag tag;
    ChildMask in_reach = hn::Eq(hn::Zero(tag), hn::Zero(tag));
    Children entry = child_splat(-INFINITY), exit = child_splat(INFINITY);
    for (size_t axis = 0; axis < 3; ++axis) {
      const Children lower = hn::Load(tag, node.lower[axis] + i);
      const Children upper = hn::Load(tag, node.upper[axis] + i);
      const auto starts = hn::Le(lower, child_splat(moving.swept.upper[axis]));
      const auto ends = hn::Ge(upper, child_splat(moving.swept.lower[axis]));
      in_reach = hn::And(in_reach, hn::And(hn::Le(lower, upper), hn::And(starts, ends)));

      const Children to_lower = hn::Sub(lower, child_splat(moving.box.upper[axis]));
      const Children to_upper = hn::Sub(upper, child_splat(moving.box.lower[axis]));
      const bool forwards = moving.inverse_displacement[axis] >= 0;
      const Children inverse = child_splat(moving.inverse_displacement[axis]);
      const Children still = child_splat(moving.still[axis]);
      const Children first = hn::Sub(hn::Mul(forwards ? to_lower : to_upper, inverse), still);
      const Children last = hn::Add(hn::Mul(forwards ? to_upper : to_lower, inverse), still);
      entry = max(first, entry);  // keeps the old one if the new one is NaN
      exit = min(last, exit);
    }
    const Children latest =
        hn::Add(hn::Mul(exit, child_splat(1 + kTimeRounding)), child_splat(kTinyTime));
    key = hn::Mul(max(entry, hn::Zero(tag)), child_splat(1 - kTimeRounding));
    return hn::And(in_reach, hn::Le(entry, latest));
  }
};

// A bound on the rounding of lengths.
inline constexpr float kGapRounding = 0x1p-20f;

// The keys are distances.
struct Nearness {
  const TreeBox& box;

  HWY_INLINE ChildMask test(const BoxTree::Node& node, size_t i, Children& key) const {
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
    return is_there;
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
HWY_INLINE void expand(const BoxTree::Node& node, const Test& test, float limit, TreeWalk& walk) {
  const ChildTag tag;
  TreeWalk::Step* const begin = walk.room(BoxTree::kChildren);
  TreeWalk::Step* end = begin;
  for (size_t i = 0; i < BoxTree::kChildren; i += kChildLanes) {
    Children key;
    const ChildMask met = test.test(node, i, key);
    const ChildMask passes = hn::And(met, hn::Le(key, child_splat(limit)));
    uint8_t mask[8] = {};
    hn::StoreMaskBits(tag, passes, mask);
    alignas(64) float keys[kChildLanes];
    hn::Store(key, tag, keys);
    for (uint32_t bits = mask[0] & ((1u << kChildLanes) - 1); bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<size_t>(std::countr_zero(bits));
      *end++ = {keys[lane], node.child[i + lane]};
    }
  }
  sort_steps(begin, end);
  walk.add(static_cast<size_t>(end - begin));
}

template <class Test>
HWY_INLINE void go_on(const BoxTree& tree, const Test& test, float limit, size_t most,
                      TreeWalk& walk, std::vector<uint32_t>& items) {
  const BoxTree::Node* const nodes = tree.nodes().data();
  const size_t enough = items.size() + most;
  while (!walk.is_done() && items.size() < enough) {
    const TreeWalk::Step step = walk.take();
    if (step.key > limit) continue;
    if (is_item(step.child)) {
      items.push_back(step.child - BoxTree::kItem);
    } else {
      expand(nodes[step.child], test, limit, walk);
    }
  }
}

void go_on_meeting(const BoxTree& tree, const MovingBox& box, float limit, size_t most,
                   TreeWalk& walk, std::vector<uint32_t>& items) {
  go_on(tree, Meeting{box}, limit, most, walk, items);
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
HWY_EXPORT(go_on_near);

// The reciprocal of a smaller displacement would be near the end of the range of float32, or
// beyond.
constexpr float kLeastDisplacement = 0x1p-120f;

}  // namespace

MovingBox::MovingBox(const TreeBox& at_start, const std::array<float, 3>& displacement)
    : box(at_start), swept(at_start) {
  for (size_t axis = 0; axis < 3; ++axis) {
    const float d = displacement[axis];
    if (d < 0) swept.lower[axis] = next_down(box.lower[axis] + d);
    if (d > 0) swept.upper[axis] = next_up(box.upper[axis] + d);
    const bool moves = std::abs(d) >= kLeastDisplacement;
    inverse_displacement[axis] = moves ? 1 / d : 0;
    still[axis] = moves ? 0 : INFINITY;
  }
}

void walk_met(const BoxTree& tree, const MovingBox& box, float limit, size_t most, TreeWalk& walk,
              std::vector<uint32_t>& items) {
  CAROM_DISPATCH(go_on_meeting)(tree, box, limit, most, walk, items);
}

void walk_near(const BoxTree& tree, const TreeBox& box, float limit, size_t most, TreeWalk& walk,
               std::vector<uint32_t>& items) {
  CAROM_DISPATCH(go_on_near)(tree, box, limit, most, walk, items);
}

}  // namespace carom
#endif  // HWY_ONCE
