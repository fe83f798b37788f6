// Vectors of doubles as the kernels of rays use them.
#if defined(CAROM_IMPACTS_RAYS_RAY_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_IMPACTS_RAYS_RAY_LANES_INL_H_
#undef CAROM_IMPACTS_RAYS_RAY_LANES_INL_H_
#else
#define CAROM_IMPACTS_RAYS_RAY_LANES_INL_H_
#endif

#include "shapes/turn.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

HWY_INLINE D3 splat3(const Double3& v) {
  return {splat_double(v[0]), splat_double(v[1]), splat_double(v[2])};
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_IMPACTS_RAYS_RAY_LANES_INL_H_
