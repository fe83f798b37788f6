// Box against hull: GJK in lanes, and the search over any two cores for the rows that it defers.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/box/box_hull.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/hulls/core_kernel-inl.h"
#include "narrowphase/manifolds/hull_points-inl.h"
#include "narrowphase/manifolds/manifold-inl.h"
#include "narrowphase/pairs/direction-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

void box_hull(const Batch& batch) {
  switch (batch.pass) {
    case Pass::direction:
      return run_direction<BoxLanes, HullLanes>(batch);
    case Pass::distance:
    case Pass::clearance:
      return run_batch<CoreKernel<BoxLanes, HullLanes, false>>(batch);
    case Pass::manifold:
      return run_manifold<BoxLanes, HullLanes>(batch);
    default:
      return run_batch<CoreKernel<BoxLanes, HullLanes, true>>(batch);
  }
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "narrowphase/pairs/core_batch.h"
#include "simd/measured_kernels.h"

namespace carom {

HWY_EXPORT(box_hull);

void run_box_hull(const Batch& batch) {
  run_core_batch<Box, Hull>(
      batch, {CAROM_DISPATCH_MEASURED(box_hull_decision, box_hull), CAROM_DISPATCH(box_hull)});
}

}  // namespace carom
#endif  // HWY_ONCE
