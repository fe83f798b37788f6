// Turns the points of a hull, as many at a time as there are lanes.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometries/seen_points.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <cfloat>

#include "geometries/seen_points.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

float finite_float(double x) {
  return static_cast<float>(std::clamp(x, -double{FLT_MAX}, double{FLT_MAX}));
}

HWY_INLINE F3 splat_floats(const Double3& v) {
  return {splat(finite_float(v[0])), splat(finite_float(v[1])), splat(finite_float(v[2]))};
}

HWY_INLINE Double3 least_of_lanes(const F3& v) {
  const auto least = [](F x) HWY_ATTR {
    return static_cast<double>(hn::GetLane(hn::MinOfLanes(FloatTag(), x)));
  };
  return {least(v.x), least(v.y), least(v.z)};
}

PartBox turned_hull(const HullGeometry& hull, const FrameChange& change, SeenPoints& seen) {
  const FloatTag tag;
  seen.set_unit(hull.size());
  seen.count = hull.points().size();
  const std::array<float, 4>& mean = hull.records()[seen.count];
  const Double3 between = plus(turned(change.turn, {mean[0], mean[1], mean[2]}), change.offset);
  Double3 rest;  // of the middle in units, which float32 does not hold
  for (size_t axis = 0; axis < 3; ++axis) {
    seen.middle[axis] = finite_float(between[axis]);
    rest[axis] = (between[axis] - seen.middle[axis]) * seen.down;
  }
  const Turn& r = change.turn;
  const Rotation turn = {splat_floats({r[0][0], r[1][0], r[2][0]}),
                         splat_floats({r[0][1], r[1][1], r[2][1]}),
                         splat_floats({r[0][2], r[1][2], r[2][2]})};
  const F down = splat(static_cast<float>(seen.down));
  const F3 start = F3{splat(mean[0]), splat(mean[1]), splat(mean[2])} * down;
  const F3 move = splat_floats(rest);
  F3 low = splat3(HUGE_VALF), minus_high = low;
  F furthest = splat(0);
  for (size_t i = 0; i < seen.count; i += kLanes) {
    const F3 own = {hn::LoadU(tag, hull.column(0) + i), hn::LoadU(tag, hull.column(1) + i),
                    hn::LoadU(tag, hull.column(2) + i)};
    const F3 p = rotate(turn, own * down - start);
    low = min(low, p);
    minus_high = min(minus_high, -p);
    const F3 moved = p + move;
    furthest = max(furthest, max(max(hn::Abs(moved.x), hn::Abs(moved.y)), hn::Abs(moved.z)));
    hn::Store(moved.x, tag, seen.column[0].data() + i);
    hn::Store(moved.y, tag, seen.column[1].data() + i);
    hn::Store(moved.z, tag, seen.column[2].data() + i);
  }
  seen.size = hn::GetLane(hn::MaxOfLanes(tag, furthest));
  const Double3 lower = least_of_lanes(low), minus_upper = least_of_lanes(minus_high);
  PartBox box;
  for (size_t axis = 0; axis < 3; ++axis) {
    box.middle[axis] = between[axis] + (lower[axis] - minus_upper[axis]) / 2 * seen.up;
    box.half[axis] = -(lower[axis] + minus_upper[axis]) / 2 * seen.up;
  }
  return box;
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(turned_hull);

PartBox see_hull(const HullGeometry& hull, const FrameChange& change, SeenPoints& seen) {
  return CAROM_DISPATCH(turned_hull)(hull, change, seen);
}

}  // namespace carom
#endif  // HWY_ONCE
