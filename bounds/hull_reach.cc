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

HWY_INLINE D wide(const float* column) {
  return hn::PromoteTo(DoubleTag(), hn::LoadU(hn::Rebind<float, DoubleTag>(), column));
}

// axis . point of the points from i on.
HWY_INLINE D heights(const Double3& axis, const HullGeometry& hull, size_t i) {
  const D x = hn::Mul(splat_double(axis[0]), wide(hull.column(0) + i));
  const D y = hn::Mul(splat_double(axis[1]), wide(hull.column(1) + i));
  const D z = hn::Mul(splat_double(axis[2]), wide(hull.column(2) + i));
  return hn::Add(hn::Add(x, y), z);
}

Intervals hull_reach_in_lanes(const std::array<Double3, 3>& axes, const HullGeometry& hull) {
  const DoubleTag tag;
  Intervals result;
  for (size_t axis = 0; axis < 3; ++axis) {
    D least = heights(axes[axis], hull, 0), most = least;
    for (size_t i = kDoubleLanes; i < hull.points().size(); i += kDoubleLanes) {
      const D height = heights(axes[axis], hull, i);
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
