// Tests the eight boxes of a node against a moving box in lanes: C. Ericson, Real-Time Collision
// Detection, 2005, section 5.3.3.
#if defined(CAROM_TREES_BOX_PATH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_TREES_BOX_PATH_INL_H_
#undef CAROM_TREES_BOX_PATH_INL_H_
#else
#define CAROM_TREES_BOX_PATH_INL_H_
#endif

#include <hwy/cache_control.h>

#include "simd/lanes-inl.h"
#include "trees/box_path.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

using ChildTag = hn::CappedTag<float, BoxTree::kChildren>;
using Children = hn::Vec<ChildTag>;
using ChildMask = hn::Mask<ChildTag>;
inline constexpr size_t kChildLanes = hn::MaxLanes(ChildTag());

HWY_INLINE Children child_splat(float value) { return hn::Set(ChildTag(), value); }

HWY_INLINE uint32_t child_bits(ChildMask mask) {
  return static_cast<uint32_t>(bits_of(ChildTag(), mask));
}

HWY_INLINE const float* ends_of(const BoxTree::Node& node) {
  return reinterpret_cast<const float*>(&node);
}

HWY_INLINE void prefetch_node(const BoxTree::Node& node) {
  constexpr size_t kLine = 64;
  const char* const bytes = reinterpret_cast<const char*>(&node);
  for (size_t i = 0; i < sizeof node; i += kLine) hwy::Prefetch(bytes + i);
}

// Whether the moving box meets the children from `first` on by the limit, and lower bounds of the
// times. Every step is a function that never decreases, so a node passes whenever one of its
// children does. A child without a box passes if its ends are NaN.
HWY_INLINE ChildMask meets(const BoxPath& path, const BoxTree::Node& node, size_t first,
                           float limit, Children& entry) {
  const ChildTag tag;
  const float* const ends = ends_of(node) + first;
  Children exit = child_splat(limit);
  entry = hn::Zero(tag);
  for (size_t axis = 0; axis < 3; ++axis) {
    const Children near_end = hn::Load(tag, ends + path.near_end[axis]);
    const Children far_end = hn::Load(tag, ends + path.far_end[axis]);
    // Zero times infinity is NaN, and keeps the other value.
    entry = max(hn::Mul(hn::Sub(near_end, child_splat(path.from_near[axis])),
                        child_splat(path.inverse_near[axis])),
                entry);
    exit = min(hn::Mul(hn::Sub(far_end, child_splat(path.from_far[axis])),
                       child_splat(path.inverse_far[axis])),
               exit);
  }
  return hn::Le(entry, hn::Add(exit, child_splat(BoxPath::kTinyTime)));
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_TREES_BOX_PATH_INL_H_
