// Convex shapes against a half-space: the lowest point over its plane decides.
//
// Source: C. Ericson, Real-Time Collision Detection, 2005, section 5.2.2 and 5.2.3 (the least
// height of a shape over a plane).
#pragma once

#include <cstddef>

#include "base/tolerances.h"
#include "narrowphase/scalar/separation.h"
#include "narrowphase/scalar/shapes.h"

namespace carom::scalar {

// The plane of a half-space as another body sees it.
template <class Real>
struct Plane {
  Vector3<Real> normal;  // unit, world axes, out of the half-space
  Real height;           // over the other body's position, along the normal
  Real size;             // of the numbers that were rounded
};

// The half-space is turned by q, with its position at `d` from the other body.
template <class Real>
Plane<Real> plane_of(const HalfspaceShape<Real>& halfspace, const Quaternion<Real>& q,
                     const Vector3<Real>& d) {
  const Vector3<Real> normal = rotate(rotation_of(q), halfspace.normal);
  const Vector3<Real> along = normal.cwiseProduct(d);
  const Real height = ((along.x() + along.y()) + along.z()) + halfspace.offset;
  // If no rotation has rounded the normal, the sideways distance of the position adds no error.
  const Vector3<Real> rounded = q.v.isZero(0) ? along : d;
  const Real size = ((std::fabs(rounded.x()) + std::fabs(rounded.y())) + std::fabs(rounded.z())) +
                    std::fabs(halfspace.offset);
  return {normal, height, size};
}

// The separation of a shape (A) from the half-space (B) at `d` from it. `lowest`: its lowest point,
// relative to its own position. `size`: of the shape.
template <class Real>
SeparationAs<Real> over_plane(const Plane<Real>& plane, Real separation,
                              const Vector3<Real>& lowest, Real size, const Vector3<Real>& d) {
  SeparationAs<Real> result;
  result.separation = separation;
  result.normal = -plane.normal;
  result.arm_a = lowest;
  result.arm_b = (lowest - plane.normal * separation) - d;
  const Real apart = std::fabs(separation);
  result.is_unsure = apart <= Real(kNearTouchScaled) * (plane.size + size) ||
                     Real(kFarPlane) * (apart + size) < plane.size;
  return result;
}

// The same for the convex hull of some points. Its witness point is the mean of all points that are
// as low as the lowest.
template <class Real, class Points>
SeparationAs<Real> points_over_plane(const Plane<Real>& plane, const Points& points, Real size,
                                     const Vector3<Real>& d) {
  Real least = dot(plane.normal, points[0]);
  for (const Vector3<Real>& p : points) least = min(dot(plane.normal, p), least);
  const Real low = least + Real(kLyingFlat) * size;
  const auto weight_of = [&](const Vector3<Real>& p) -> Real {
    return dot(plane.normal, p) <= low ? 1 : 0;
  };
  Real weight = weight_of(points[0]);
  Vector3<Real> sum = points[0] * weight;
  for (size_t i = 1; i < points.size(); ++i) {
    weight += weight_of(points[i]);
    sum += points[i] * weight_of(points[i]);
  }
  return over_plane<Real>(plane, least - plane.height, sum * (1 / weight), size, d);
}

}  // namespace carom::scalar
