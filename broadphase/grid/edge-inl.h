// How long a box is, the same wherever boxes are told apart by it.
#if defined(CAROM_BROADPHASE_GRID_EDGE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_BROADPHASE_GRID_EDGE_INL_H_
#undef CAROM_BROADPHASE_GRID_EDGE_INL_H_
#else
#define CAROM_BROADPHASE_GRID_EDGE_INL_H_
#endif

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// On one axis; never negative, and zero where both corners are the same infinity.
HWY_INLINE F edge_of(F lower, F upper) { return max(hn::Sub(upper, lower), splat(0)); }

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_BROADPHASE_GRID_EDGE_INL_H_
