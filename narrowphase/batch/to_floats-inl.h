// Results of lanes of doubles, rounded to floats.
#if defined(CAROM_NARROWPHASE_BATCH_TO_FLOATS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_BATCH_TO_FLOATS_INL_H_
#undef CAROM_NARROWPHASE_BATCH_TO_FLOATS_INL_H_
#else
#define CAROM_NARROWPHASE_BATCH_TO_FLOATS_INL_H_
#endif

#include <cfloat>
#include <limits>

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// As scalar::round_separation(), of finite numbers.
HWY_INLINE D rounded_separation(D v) {
  constexpr double kLeast = std::numeric_limits<float>::denorm_min();
  const DoubleMask vanishes = hn::And(hn::Gt(v, splat_double(0)), hn::Lt(v, splat_double(kLeast)));
  const D kept = hn::IfThenElse(vanishes, splat_double(kLeast), v);
  return min(max(kept, splat_double(-FLT_MAX)), splat_double(FLT_MAX));
}

// To kDoubleLanes floats, aligned to their size.
HWY_INLINE void store_as_floats(D v, float* out) {
#if HWY_TARGET == HWY_SCALAR
  // DemoteTo() would make the greatest float of what is beyond floats; elsewhere it is infinite.
  *out = static_cast<float>(hn::GetLane(v));
#else
  const hn::Rebind<float, DoubleTag> half;
  hn::Store(hn::DemoteTo(half, v), half, out);
#endif
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_BATCH_TO_FLOATS_INL_H_
