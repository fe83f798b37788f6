#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bounds/point_reach.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "bounds/point_reach-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

Intervals reach_of_hull(const std::array<Double3, 3>& axes, const HullGeometry& hull) {
  return reach(axes, hull);
}
Intervals reach_of_dop(const std::array<Double3, 3>& axes, const DopPolytope& polytope) {
  return reach(axes, polytope);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(reach_of_hull);
HWY_EXPORT(reach_of_dop);

}  // namespace

Intervals point_reach(const std::array<Double3, 3>& axes, const HullGeometry& hull) {
  return CAROM_DISPATCH(reach_of_hull)(axes, hull);
}
Intervals point_reach(const std::array<Double3, 3>& axes, const DopPolytope& polytope) {
  return CAROM_DISPATCH(reach_of_dop)(axes, polytope);
}

}  // namespace carom
#endif  // HWY_ONCE
