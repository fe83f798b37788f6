// The edge of a box, computed in the same way by every file that sorts boxes by size.
#if defined(CAROM_BROADPHASE_GRID_EDGE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_BROADPHASE_GRID_EDGE_INL_H_
#undef CAROM_BROADPHASE_GRID_EDGE_INL_H_
#else
#define CAROM_BROADPHASE_GRID_EDGE_INL_H_
#endif

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// The edge on one axis. Never negative; zero if both corners are the same infinity.
HWY_INLINE F edge_of(F lower, F upper) { return max(hn::Sub(upper, lower), splat(0)); }

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_BROADPHASE_GRID_EDGE_INL_H_
