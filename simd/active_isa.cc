// active_isa() calls a dispatched function that returns the target it was compiled for, so it
// reports what really runs.
#include "carom/simd/isa.h"
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/active_isa.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

Isa compiled_isa() {
  constexpr int64_t kTarget = HWY_TARGET;
  if constexpr (kTarget == HWY_SCALAR) return Isa::scalar;
  if constexpr (kTarget == HWY_AVX2) return Isa::avx2;
  if constexpr (kTarget == HWY_AVX3) return Isa::avx512;
  if constexpr (kTarget == HWY_NEON) return Isa::neon;
  return Isa::sse4;
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(compiled_isa);

Isa active_isa() { return CAROM_DISPATCH(compiled_isa)(); }

}  // namespace carom
#endif  // HWY_ONCE
