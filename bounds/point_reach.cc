// Each lane keeps the ends of its points; then the ends of all lanes are those of the shape.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bounds/point_reach.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "bounds/point_reach.h"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// Columns of hulls are padded to a multiple of 16.
static_assert(16 % kDoubleLanes == 0 && DopPolytope::kPadding % kDoubleLanes == 0);

HWY_INLINE D wide(const float* column) {
  return hn::PromoteTo(DoubleTag(), hn::LoadU(hn::Rebind<float, DoubleTag>(), column));
}
HWY_INLINE D wide(const double* column) { return hn::LoadU(DoubleTag(), column); }

// axis . point of the points from i on.
template <class Shape>
HWY_INLINE D heights(const Double3& axis, const Shape& shape, size_t i) {
  const D x = hn::Mul(splat_double(axis[0]), wide(shape.column(0) + i));
  const D y = hn::Mul(splat_double(axis[1]), wide(shape.column(1) + i));
  const D z = hn::Mul(splat_double(axis[2]), wide(shape.column(2) + i));
  return hn::Add(hn::Add(x, y), z);
}

template <class Shape>
HWY_INLINE Intervals reach(const std::array<Double3, 3>& axes, const Shape& shape, size_t count) {
  const DoubleTag tag;
  Intervals result;
  for (size_t axis = 0; axis < 3; ++axis) {
    D least = heights(axes[axis], shape, 0), most = least;
    for (size_t i = kDoubleLanes; i < count; i += kDoubleLanes) {
      const D height = heights(axes[axis], shape, i);
      least = min(least, height);
      most = max(most, height);
    }
    result[axis] = {hn::GetLane(hn::MinOfLanes(tag, least)) + 0.0,
                    hn::GetLane(hn::MaxOfLanes(tag, most)) + 0.0};
  }
  return result;
}

Intervals reach_of_hull(const std::array<Double3, 3>& axes, const HullGeometry& hull) {
  return reach(axes, hull, hull.points().size());
}
Intervals reach_of_dop(const std::array<Double3, 3>& axes, const DopPolytope& polytope) {
  return reach(axes, polytope, polytope.point_count());
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
