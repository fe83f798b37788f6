// Capsule against hull: GJK in lanes, and the search over any two cores for the rows that it
// defers.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/capsule/capsule_hull.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/hulls/core_kernel-inl.h"
#include "narrowphase/manifolds/hull_points-inl.h"
#include "narrowphase/manifolds/manifold-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

void capsule_hull(const Batch& batch) {
  if (batch.pass == Pass::manifold) return run_manifold<CapsuleLanes, HullLanes>(batch);
  // The test measures contacts: these kinds have no other pass that does.
  if (has_contacts(batch.detail))
    return run_batch<CoreKernel<CapsuleLanes, HullLanes, false>>(batch);
  run_batch<CoreKernel<CapsuleLanes, HullLanes, true>>(batch);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "narrowphase/pairs/core_batch.h"
#include "simd/measured_kernels.h"

namespace carom {

HWY_EXPORT(capsule_hull);

void run_capsule_hull(const Batch& batch) {
  run_core_batch<Capsule, Hull>(
      batch,
      {CAROM_DISPATCH_MEASURED(capsule_hull_decision, capsule_hull), CAROM_DISPATCH(capsule_hull)});
}

}  // namespace carom
#endif  // HWY_ONCE
