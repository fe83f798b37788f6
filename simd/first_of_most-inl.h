// The greatest of many values, a vector at a time, and its index.
#if defined(CAROM_SIMD_FIRST_OF_MOST_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_SIMD_FIRST_OF_MOST_INL_H_
#undef CAROM_SIMD_FIRST_OF_MOST_INL_H_
#else
#define CAROM_SIMD_FIRST_OF_MOST_INL_H_
#endif

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

HWY_INLINE F lane_indices() { return hn::Iota(FloatTag(), 0); }

// Each lane keeps its greatest value so far and the index of that value.
struct FirstOfMost {
  F most, index;

  static HWY_INLINE FirstOfMost none() { return {splat(-FLT_MAX), splat(0)}; }
  HWY_INLINE void keep(Mask exists, F value, F at) {
    const Mask is_better = hn::And(exists, hn::Gt(value, most));
    most = hn::IfThenElse(is_better, value, most);
    index = hn::IfThenElse(is_better, at, index);
  }
  // For values that do not come in the order of their indices: keeps the least index among equals.
  HWY_INLINE void keep_first(Mask exists, F value, F at) {
    const Mask is_equal = hn::And(hn::Eq(value, most), hn::Lt(at, index));
    const Mask is_better = hn::And(exists, hn::Or(hn::Gt(value, most), is_equal));
    most = hn::IfThenElse(is_better, value, most);
    index = hn::IfThenElse(is_better, at, index);
  }
  HWY_INLINE float value() const { return hn::GetLane(hn::MaxOfLanes(FloatTag(), most)); }
  // first(), for values that came in the order of the indices 0 to count - 1: quicker if they fit
  // in one vector.
  HWY_INLINE size_t first_of(size_t count) const {
    if (count > kLanes) return first();
    const FloatTag tag;
    return hn::FindKnownFirstTrue(tag, hn::Eq(most, hn::MaxOfLanes(tag, most)));
  }
  // The least index of the greatest value in all lanes; 0 if no lane has kept a value.
  HWY_INLINE size_t first() const {
    const FloatTag tag;
    HWY_ALIGN float indices[kLanes];
    hn::Store(index, tag, indices);
    const Mask is_best = hn::Eq(most, hn::MaxOfLanes(tag, most));
    // The common case. Finding the least of several indices takes as long as everything before it.
    if (HWY_LIKELY(hn::CountTrue(tag, is_best) == 1)) {
      return static_cast<size_t>(indices[hn::FindKnownFirstTrue(tag, is_best)]);
    }
    const F candidates = hn::IfThenElse(is_best, index, splat(FLT_MAX));
    return static_cast<size_t>(hn::GetLane(hn::MinOfLanes(tag, candidates)));
  }
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_SIMD_FIRST_OF_MOST_INL_H_
