// Hull against hull: GJK in lanes, and the search over any two cores for the rows that it defers.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/hull/hull_hull.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/hulls/ball_kernel-inl.h"
#include "narrowphase/hulls/core_stages-inl.h"
#include "narrowphase/hulls/recall-inl.h"
#include "narrowphase/manifolds/hull_points-inl.h"
#include "narrowphase/manifolds/manifold-inl.h"
#include "narrowphase/pairs/direction-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

void hull_hull(const Batch& batch) {
  switch (batch.pass) {
    case Pass::balls:
      return run_batch<BallKernel>(batch);
    case Pass::direction:
      return run_direction<HullLanes, HullLanes>(batch);
    case Pass::recall:
      return recall_hulls(batch);
    case Pass::distance:
    case Pass::clearance:
      return run_core<HullLanes, HullLanes, false>(batch);
    case Pass::manifold:
      return run_manifold<HullLanes, HullLanes>(batch);
    default:
      return run_core<HullLanes, HullLanes, true>(batch);
  }
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "narrowphase/pairs/core_batch.h"
#include "simd/measured_kernels.h"

namespace carom {

HWY_EXPORT(hull_hull);

void run_hull_hull(const Batch& batch) {
  run_core_batch<Hull, Hull>(
      batch, {CAROM_DISPATCH_MEASURED(hull_hull_decision, hull_hull), CAROM_DISPATCH(hull_hull)});
}

}  // namespace carom
#endif  // HWY_ONCE
