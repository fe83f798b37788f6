// Where the corners of a shell are, a corner a lane (shell_corners_scalar.h is the scalar form).
#if defined(CAROM_NARROWPHASE_HULLS_SHELL_CORNERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_HULLS_SHELL_CORNERS_INL_H_
#undef CAROM_NARROWPHASE_HULLS_SHELL_CORNERS_INL_H_
#else
#define CAROM_NARROWPHASE_HULLS_SHELL_CORNERS_INL_H_
#endif

#include "narrowphase/hulls/shell_corners_scalar.h"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// The points with these numbers, looked up in registers. Places that are not in use may have
// numbers that no point has.
HWY_INLINE F3 points_at(const PointView& points, const uint8_t* numbers) {
  const FloatTag tag;
  const IntTag integers;
  const auto& [x, y, z] = points.column;
  const I index = hn::PromoteTo(integers, hn::LoadU(hn::Rebind<uint8_t, IntTag>(), numbers));
  const auto place =
      hn::IndicesFromVec(tag, hn::And(index, hn::Set(integers, static_cast<int32_t>(kLanes) - 1)));
  const auto from = [&](const float* column)
                        HWY_ATTR { return hn::TableLookupLanes(hn::LoadU(tag, column), place); };
  F3 found = {from(x), from(y), from(z)};
  for (size_t i = kLanes; i < points.count; i += kLanes) {
    const auto is_from_here =
        hn::RebindMask(tag, hn::Gt(index, hn::Set(integers, static_cast<int32_t>(i) - 1)));
    found.x = hn::IfThenElse(is_from_here, from(x + i), found.x);
    found.y = hn::IfThenElse(is_from_here, from(y + i), found.y);
    found.z = hn::IfThenElse(is_from_here, from(z + i), found.z);
  }
  return found;
}

// In narrow vectors too many look-ups find nothing.
inline void place_corners(const Shell& shell, const Solid& a, const PointView& b,
                          ShellSpace& space) {
  if constexpr (kLanes < 16) return scalar::place_corners(shell, a, b, space);
  const FloatTag tag;
  for (size_t i = 0; i < ShellSpace::kPlaces && shell.corners >> i != 0; i += kLanes) {
    const F3 corner = points_at(a.points(), shell.of_a.data() + i) * splat(a.scale) -
                      points_at(b, shell.of_b.data() + i);
    hn::Store(corner.x, tag, space.corner[0].data() + i);
    hn::Store(corner.y, tag, space.corner[1].data() + i);
    hn::Store(corner.z, tag, space.corner[2].data() + i);
  }
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_HULLS_SHELL_CORNERS_INL_H_
