// Sphere against hull: GJK in lanes, and the search over any two cores for the rows that it defers.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/sphere/sphere_hull.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/hulls/core_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

void sphere_hull(const Batch& batch) {
  // Contacts are measured in every pass: these kinds have no other.
  if (has_contacts(batch.detail))
    return run_batch<CoreKernel<SphereLanes, HullLanes, false>>(batch);
  run_batch<CoreKernel<SphereLanes, HullLanes, true>>(batch);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "narrowphase/pairs/core_batch.h"
#include "simd/measured_kernels.h"

namespace carom {

HWY_EXPORT(sphere_hull);

void run_sphere_hull(const Batch& batch) {
  run_core_batch<Sphere, Hull>(batch, {CAROM_DISPATCH_MEASURED(sphere_hull_decision, sphere_hull),
                                       CAROM_DISPATCH(sphere_hull)});
}

}  // namespace carom
#endif  // HWY_ONCE
