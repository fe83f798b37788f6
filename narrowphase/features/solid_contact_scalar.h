// The contact of a shape with faces (A) and a cylinder (B), in the frame of the former, scalar
// form.
#pragma once

#include "base/tolerances.h"
#include "narrowphase/features/cylinders_scalar.h"
#include "narrowphase/features/round_tolerances.h"
#include "narrowphase/scalar/separation.h"
#include "narrowphase/scalar/vector.h"

namespace carom::scalar {

inline Vector3f unit(const Vector3f& v) { return v * (1 / std::sqrt(max(dot(v, v), kLeastWay))); }

// From a corner of the solid towards the cylinder, whose middle is given.
inline Vector3f way_from_corner(const Vector3f& corner, const Vector3f& middle,
                                const AxialCore& core) {
  const Vector3f p = corner - middle;
  const float along = dot(p, core.axis);
  const Vector3f across = p - core.axis * along;
  const float from_axis = std::sqrt(dot(across, across));
  const float above = std::fabs(along) - core.half_length;
  const float beside = from_axis - core.rim;
  const bool is_at_rim = min(above, beside) > 0;
  const float share = is_at_rim ? beside / max(from_axis, kLeastRim) : 1.0f;
  const float rise = is_at_rim ? std::copysign(above, along) : 0.0f;
  return -unit(across * share + core.axis * rise);
}

struct SolidContact {
  float separation;
  Vector3f normal;  // out of the solid
  Vector3f on_solid;
  bool is_sure;
};

// The way from a corner that lies on the axis has no direction. What stands for it is too short,
// and so is the gap along it.
inline constexpr float kUnitSquared = 0x1p-12f;
inline bool is_unit(const Vector3f& n) { return std::fabs(dot(n, n) - 1) <= kUnitSquared; }

// `turn`: of the solid; `offset`: from A's position to the middle of its frame; `d`: from A to B.
inline Separation separation_of(const SolidContact& contact, const Rotation<float>& turn,
                                const Vector3f& offset, float rounding, const Vector3f& d) {
  Separation s;
  s.separation = contact.separation - rounding;
  s.normal = unit(rotate(turn, contact.normal));
  s.arm_a = rotate(turn, contact.on_solid) + offset;
  s.arm_b = (s.arm_a + s.normal * s.separation) - d;
  s.is_unsure = !(contact.is_sure && is_unit(contact.normal) && std::fabs(s.separation) > kSureGap);
  return s;
}

}  // namespace carom::scalar
