// Special triangles (thick, one-sided or inside a mesh) against any convex shape, in double
// precision. Such pairs are rare and are tested one at a time.
//
//   thickness    The shape is the prism between the triangle and its copy moved by the thickness
//                against the unit normal of the front.
//   one_sided    A shape that comes from behind does not collide. It comes from behind if its
//   middle
//                (of its segment, box or corners) lies behind the triangle's back. Its separation
//                is then infinite, and its normal and points are NaN. A half-space has no middle:
//                it comes from behind if its normal points to the front's side. All other shapes
//                are pushed towards the front's side.
//   inner_edges  No shape is pushed over an inner edge, or over a corner between two of them.
//                Contacts there have the normal of the face, and the separation is measured along
//                it.
//
// Except for shapes from behind, the last two rules change neither the decision nor the distance of
// separate shapes: they only choose the penetration direction. If they leave no direction, they are
// ignored. A triangle without area has no front, and none of the three properties.
#pragma once

#include "narrowphase/doubles/convex.h"

namespace carom::scalar {
namespace convex {

// All numbers of a triangle, and the position of the other one.
inline std::array<double, 19> numbers_of(const TriangleShape<double>& t,
                                         const Quaternion<double>& q, const Vector3d& d) {
  const auto& [a, b, c] = t.corners;
  return {a.x(),
          a.y(),
          a.z(),
          b.x(),
          b.y(),
          b.z(),
          c.x(),
          c.y(),
          c.z(),
          t.thickness,
          static_cast<double>(t.one_sided),
          static_cast<double>(t.inner_edges),
          q.v.x(),
          q.v.y(),
          q.v.z(),
          q.w,
          d.x(),
          d.y(),
          d.z()};
}

// Tests both orders of a pair in the same order, because the rules may turn a rounding difference
// into another penetration direction.
inline SeparationAs<double> separation_of(const TriangleShape<double>& a,
                                          const TriangleShape<double>& b,
                                          const PairPose<double>& pose) {
  const bool in_order = numbers_of(a, pose.a, pose.d) <= numbers_of(b, pose.b, -pose.d);
  const Polytope core_a = polytope_of(a, pose.a), core_b = polytope_of(b, pose.b);
  return in_order ? separation_of(core_a, core_b, pose.d)
                  : flipped(separation_of(core_b, core_a, -pose.d));
}

inline SeparationAs<double> separation_of(const HalfspaceShape<double>& halfspace,
                                          const TriangleShape<double>& triangle,
                                          const PairPose<double>& pose) {
  const Polytope shape = polytope_of(triangle, pose.b);
  const Plane<double> plane = plane_of<double>(halfspace, pose.a, -pose.d);
  const bool from_behind = dot(shape.rules.front, plane.normal) > kInPlane;
  if (shape.rules.one_sided && from_behind) return never();
  return flipped(points_over_plane<double>(plane, shape.points, triangle.size(), -pose.d));
}

}  // namespace convex

// Any shape against a special triangle, or a special triangle against a plain one. In float it only
// reports that it is unsure.
template <class Real, class A>
SeparationAs<Real> special_triangle(const A& a, const TriangleShape<Real>& b,
                                    const PairPose<Real>& pose) {
  if constexpr (std::is_same_v<Real, float>) {
    return not_in_float<float>();
  } else {
    return convex::separation_of(a, b, pose);
  }
}

}  // namespace carom::scalar
