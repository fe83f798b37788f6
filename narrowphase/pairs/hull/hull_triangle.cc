// Hull against triangle: GJK in lanes, and the search over any two cores for the rows that it
// defers.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/hull/hull_triangle.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/hulls/core_stages-inl.h"
#include "narrowphase/manifolds/hull_points-inl.h"
#include "narrowphase/manifolds/manifold-inl.h"
#include "narrowphase/pairs/direction-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

void hull_triangle(const Batch& batch) {
  switch (batch.pass) {
    case Pass::direction:
      return run_direction<HullLanes, TriangleLanes>(batch);
    case Pass::distance:
    case Pass::clearance:
      return run_core<HullLanes, TriangleLanes, false>(batch);
    case Pass::manifold:
      return run_manifold<HullLanes, TriangleLanes>(batch);
    default:
      return run_core<HullLanes, TriangleLanes, true>(batch);
  }
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "narrowphase/pairs/core_batch.h"
#include "simd/measured_kernels.h"

namespace carom {

HWY_EXPORT(hull_triangle);

void run_hull_triangle(const Batch& batch) {
  run_core_batch<Hull, Triangle>(batch,
                                 {CAROM_DISPATCH_MEASURED(hull_triangle_decision, hull_triangle),
                                  CAROM_DISPATCH(hull_triangle)});
}

}  // namespace carom
#endif  // HWY_ONCE
