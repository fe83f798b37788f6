// A ball and a body that is round about its z axis, scalar form: a point and an outline in the
// plane through the axis and the point.
#pragma once

#include "base/tolerances.h"
#include "narrowphase/features/round_tolerances.h"
#include "narrowphase/features/rounded_scalar.h"
#include "narrowphase/scalar/vector.h"

namespace carom::scalar {

// The gap from a point to a shape, negative inside, and the unit vector `out` of the shape's frame
// along which the point leaves.
struct WayOut {
  float gap;
  Vector3<float> out;
  bool is_vague;  // rounding may have turned `out`
};

// The same in the plane through the axis and the point.
struct ProfileWay {
  float gap, radial, axial;
};

// Calls way_from(distance from the axis, height) with the point's place in that plane. Near the
// axis the direction away from it is rounding, which counts unless the way leads along the axis.
template <class WayFrom>
WayOut way_out_of_profile(const Vector3<float>& point, const WayFrom& way_from) {
  const float from_axis = std::sqrt(point.x() * point.x() + point.y() * point.y());
  const ProfileWay way = way_from(from_axis, point.z());
  const float share = way.radial / max(from_axis, kCoincident);
  const bool is_near_axis = from_axis <= kNearSegment<float>;
  const bool is_vague =
      (is_near_axis && std::fabs(way.radial) > kAlongAxis) || std::fabs(way.gap) <= kCoincident;
  return {way.gap, {point.x() * share, point.y() * share, way.axial}, is_vague};
}

// `centre`: of the ball, in the frame of B, which `turn` turns into the world's. `rounding`: of B.
inline Separation ball_separation(const Vector3<float>& centre, float radius, float rounding,
                                  const Rotation<float>& turn, const WayOut& way) {
  Separation result;
  result.separation = way.gap - (radius + rounding);
  result.normal = -rotate(turn, way.out);
  result.arm_a = result.normal * radius;
  result.arm_b = rotate<float>(turn, centre - way.out * (way.gap - rounding));
  result.is_unsure = is_near_touch(result.separation) || way.is_vague;
  return result;
}

}  // namespace carom::scalar
