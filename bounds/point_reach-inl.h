// point_reach() of one target.
#if defined(CAROM_BOUNDS_POINT_REACH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_BOUNDS_POINT_REACH_INL_H_
#undef CAROM_BOUNDS_POINT_REACH_INL_H_
#else
#define CAROM_BOUNDS_POINT_REACH_INL_H_
#endif

#include "bounds/point_reach.h"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Columns of hulls are padded to a multiple of 16.
static_assert(16 % kDoubleLanes == 0 && DopPolytope::kPadding % kDoubleLanes == 0);

HWY_INLINE D wide_points(const float* column) {
  return hn::PromoteTo(DoubleTag(), hn::LoadU(hn::Rebind<float, DoubleTag>(), column));
}
HWY_INLINE D wide_points(const double* column) { return hn::LoadU(DoubleTag(), column); }

// axis . point of the points from i on.
template <class Shape>
HWY_INLINE D heights(const Double3& axis, const Shape& shape, size_t i) {
  const D x = hn::Mul(splat_double(axis[0]), wide_points(shape.column(0) + i));
  const D y = hn::Mul(splat_double(axis[1]), wide_points(shape.column(1) + i));
  const D z = hn::Mul(splat_double(axis[2]), wide_points(shape.column(2) + i));
  return hn::Add(hn::Add(x, y), z);
}

inline size_t point_count(const HullGeometry& hull) { return hull.points().size(); }
inline size_t point_count(const DopPolytope& polytope) { return polytope.point_count(); }

// Each lane keeps the ends of its points; then the ends of all lanes are those of the shape. Zero
// is positive.
template <class Shape>
HWY_INLINE Intervals reach(const std::array<Double3, 3>& axes, const Shape& shape) {
  const DoubleTag tag;
  Intervals result;
  for (size_t axis = 0; axis < 3; ++axis) {
    D least = heights(axes[axis], shape, 0), most = least;
    for (size_t i = kDoubleLanes; i < point_count(shape); i += kDoubleLanes) {
      const D height = heights(axes[axis], shape, i);
      least = min(least, height);
      most = max(most, height);
    }
    result[axis] = {hn::GetLane(hn::MinOfLanes(tag, least)) + 0.0,
                    hn::GetLane(hn::MaxOfLanes(tag, most)) + 0.0};
  }
  return result;
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_BOUNDS_POINT_REACH_INL_H_
