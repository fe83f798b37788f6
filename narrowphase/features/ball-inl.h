// The gap between balls and points, in lanes of doubles. Source and reasons:
// narrowphase/scalar/near_touch.h.
#if defined(CAROM_NARROWPHASE_FEATURES_BALL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_FEATURES_BALL_INL_H_
#undef CAROM_NARROWPHASE_FEATURES_BALL_INL_H_
#else
#define CAROM_NARROWPHASE_FEATURES_BALL_INL_H_
#endif

#include <cfloat>

#include "base/tolerances.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// The gap between a ball of radius `reach` and a point at the given squared distance; 0 only if
// they touch exactly in double. Not rounded to float yet.
HWY_INLINE D gap_to_ball(D squared_distance, D reach) {
  const D zero = splat_double(0);
  const D difference = hn::Sub(squared_distance, hn::Mul(reach, reach));
  const D gap = hn::Div(difference, hn::Add(hn::Sqrt(squared_distance), reach));
  const D far = splat_double(4.0 * FLT_MAX * FLT_MAX);  // the squares may have overflowed
  return hn::IfThenElse(hn::Gt(squared_distance, far), splat_double(FLT_MAX),
                        hn::IfThenElse(hn::Eq(difference, zero), zero, gap));
}

// Whether the sign of that gap is proven. The sizes are those of numbers that neither vanish nor
// overflow when they are squared.
HWY_INLINE DoubleMask is_proven_gap(D squared_distance, D reach) {
  const D squared_reach = hn::Mul(reach, reach);
  const D sizes = hn::Add(squared_distance, squared_reach);
  const D apart = hn::Abs(hn::Sub(squared_distance, squared_reach));
  const DoubleMask is_usual =
      hn::And(hn::Gt(sizes, splat_double(0x1p-900)), hn::Lt(sizes, splat_double(0x1p900)));
  return hn::And(is_usual, hn::Gt(apart, hn::Mul(sizes, splat_double(kSureOfSquares))));
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_BALL_INL_H_
