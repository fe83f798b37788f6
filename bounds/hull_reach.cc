// Each lane keeps the ends of its points; then the ends of all lanes are those of the hull.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bounds/hull_reach.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "bounds/hull_reach.h"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// Columns of hulls are padded to a multiple of this.
static_assert(16 % kDoubleLanes == 0);

Intervals hull_reach_in_lanes(const std::array<Double3, 3>& axes, const HullGeometry& hull) {
  const DoubleTag tag;
  const hn::Rebind<float, DoubleTag> floats;
  const float* const x = hull.column(0);
  const float* const y = hull.column(1);
  const float* const z = hull.column(2);
  Intervals result;
  for (size_t axis = 0; axis < 3; ++axis) {
    const D ax = splat_double(axes[axis][0]), ay = splat_double(axes[axis][1]),
            az = splat_double(axes[axis][2]);
    const auto along = [&](size_t i) HWY_ATTR {
      const auto wide = [&](const float* column)
                            HWY_ATTR { return hn::PromoteTo(tag, hn::LoadU(floats, column + i)); };
      return hn::Add(hn::Add(hn::Mul(ax, wide(x)), hn::Mul(ay, wide(y))), hn::Mul(az, wide(z)));
    };
    D least = along(0), most = least;
    for (size_t i = kDoubleLanes; i < hull.points().size(); i += kDoubleLanes) {
      const D height = along(i);
      least = min(least, height);
      most = max(most, height);
    }
    result[axis] = {hn::GetLane(hn::MinOfLanes(tag, least)) + 0.0,
                    hn::GetLane(hn::MaxOfLanes(tag, most)) + 0.0};
  }
  return result;
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(hull_reach_in_lanes);

}  // namespace

Intervals hull_reach(const std::array<Double3, 3>& axes, const HullGeometry& hull) {
  return CAROM_DISPATCH(hull_reach_in_lanes)(axes, hull);
}

}  // namespace carom
#endif  // HWY_ONCE
