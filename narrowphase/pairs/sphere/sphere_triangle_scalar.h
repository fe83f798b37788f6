// Sphere (A) against triangle (B): the nearest point of the triangle to the centre, in its frame.
#pragma once

#include "narrowphase/doubles/special_triangle.h"
#include "narrowphase/features/rounded_scalar.h"
#include "narrowphase/features/triangle_scalar.h"

namespace carom::scalar {

template <class Real>
SeparationAs<Real> separation(const SphereShape<Real>& sphere, const TriangleShape<Real>& triangle,
                              const PairPose<Real>& pose) {
  if (triangle.is_special()) return special_triangle(sphere, triangle, pose);
  using Vector = Vector3<Real>;
  const Rotation<Real> turn = rotation_of(pose.b);
  const TriangleCore<Real> core(triangle.corners);
  const ToTriangle<Real> nearest = nearest_on_triangle(rotate_back(turn, Vector(-pose.d)), core);

  // A centre on a triangle without a face may leave in any direction perpendicular to its edge.
  const bool coincide = !nearest.is_face && nearest.distance <= Real(kCoincident);
  const Vector way = rotate(turn, nearest.way);
  const Vector normal = coincide ? any_perpendicular(rotate(turn, core.edge[0]))
                                 : Vector(way * (1 / std::sqrt(dot(way, way))));
  SeparationAs<Real> result = grown<Real>(Vector::Zero(), normal * nearest.distance, normal,
                                          nearest.distance, sphere.radius, 0, pose);
  // So near to an edge, the vector to it is mostly rounding.
  const bool is_near_edge = !nearest.is_face && nearest.distance <= CoreTolerance<Real>::kNearEdges;
  result.is_unsure = result.is_unsure || is_near_edge;
  if (coincide) result.status = Status::degenerate;
  return result;
}

}  // namespace carom::scalar
