// Up to four contact points of an overlap: the corners of the region that the facing faces of two
// shapes both cover, seen along the contact's normal. This is the scalar form.
#pragma once

#include <type_traits>
#include <variant>

#include "carom/results/contact.h"
#include "narrowphase/manifolds/hull_face.h"
#include "narrowphase/manifolds/line_contact_scalar.h"
#include "narrowphase/manifolds/rectangles_scalar.h"
#include "narrowphase/manifolds/reduce_scalar.h"
#include "narrowphase/scalar/scaled.h"

namespace carom::scalar {

// Both bodies in scaled units, relative to the position of A.
struct PlacedPair {
  Placed a, b;
};

inline ContactPoints witness_only(const ScaledContact& contact) {
  return {{contact.arm_a, contact.separation}};
}

// Moves clip points to space. The frame lies on A's surface.
inline ContactPoints on_frame(const FaceFrame& frame, const ClipPoints& clipped) {
  ContactPoints points;
  for (const ClipPoint& c : clipped) points.push_back({frame.point(c.x, c.y), c.s});
  return points;
}

// A single point is replaced by the witness point.
inline ContactPoints or_witness(const ContactPoints& points, const ScaledContact& contact) {
  return points.size() < 2 ? witness_only(contact) : points;
}

template <AnyBox A, AnyBox B>
requires(std::is_same_v<A, AabbShape<float>> || std::is_same_v<A, B>)  // as in pair_list.inc
    ContactPoints
    manifold(const A& a, const B& b, const PlacedPair& placed, const ScaledContact& contact) {
  const Rectangle face = face_towards(contact.normal, a, placed.a);
  const Rectangle other = face_towards(-contact.normal, b, placed.b);
  const ClipPoints points =
      reduce(clip(face, other, contact.normal, contact.touching()), kSamePoint);
  return or_witness(on_frame(face.frame, points), contact);
}

template <AnyBox A>
ContactPoints manifold(const A& a, const TriangleShape<float>& b, const PlacedPair& placed,
                       const ScaledContact& contact) {
  const std::array<Vector3f, 3> corners = corners_of(b, placed.b);
  const Vector3f normal = triangle_face(corners).frame.n;
  if (!shows_face(b, normal, -contact.normal)) return witness_only(contact);
  const Rectangle face = face_towards(contact.normal, a, placed.a);
  const ClipPoints points =
      reduce(clip(face, corners, normal, contact.normal, contact.touching()), kSamePoint);
  return or_witness(on_frame(face.frame, points), contact);
}

// Points on A where two polygons cover one another. They are clipped on the face that is more
// nearly perpendicular to the normal, or A's if both are equal.
template <class FaceA, class CornersA, class FaceB, class CornersB>
ContactPoints touch_faces(const FaceA& face_a, const CornersA& corners_a, const FaceB& face_b,
                          const CornersB& corners_b, const ScaledContact& contact) {
  const Vector3f& n = contact.normal;
  if (std::fabs(dot(face_b.frame.n, n)) > std::fabs(dot(face_a.frame.n, n))) {
    const Vector3f m = -n;
    const ClipPoints few =
        reduce(clip(face_b, corners_a, face_a.frame.n, m, contact.touching()), kSamePoint);
    ContactPoints points = on_frame(face_b.frame, few);
    for (ContactPoint& p : points) p.point += m * p.s;
    return or_witness(points, contact);
  }
  const ClipPoints few =
      reduce(clip(face_a, corners_b, face_b.frame.n, n, contact.touching()), kSamePoint);
  return or_witness(on_frame(face_a.frame, few), contact);
}

inline ContactPoints manifold(const TriangleShape<float>& a, const TriangleShape<float>& b,
                              const PlacedPair& placed, const ScaledContact& contact) {
  const std::array<Vector3f, 3> corners_a = corners_of(a, placed.a);
  const std::array<Vector3f, 3> corners_b = corners_of(b, placed.b);
  const TriangleFace face_a = triangle_face(corners_a);
  const TriangleFace face_b = triangle_face(corners_b);
  const Vector3f& n = contact.normal;
  if (!shows_face(a, face_a.frame.n, n) || !shows_face(b, face_b.frame.n, -n)) {
    return witness_only(contact);
  }
  return touch_faces(face_a, corners_a, face_b, corners_b, contact);
}

inline ContactPoints manifold(const HullShape<float>& a, const HullShape<float>& b,
                              const PlacedPair& placed, const ScaledContact& contact) {
  const FacingSide side_a = side_towards(contact.normal, -contact.separation, a, placed.a);
  const FacingSide side_b = side_towards(-contact.normal, -contact.separation, b, placed.b);
  return touch_faces(side_a.face, side_a.corners, side_b.face, side_b.corners, contact);
}

inline ContactPoints manifold(const HullShape<float>& a, const TriangleShape<float>& b,
                              const PlacedPair& placed, const ScaledContact& contact) {
  const std::array<Vector3f, 3> corners_b = corners_of(b, placed.b);
  const TriangleFace face_b = triangle_face(corners_b);
  if (!shows_face(b, face_b.frame.n, -contact.normal)) return witness_only(contact);
  const FacingSide side_a = side_towards(contact.normal, -contact.separation, a, placed.a);
  return touch_faces(side_a.face, side_a.corners, face_b, corners_b, contact);
}

template <AnyBox A>
ContactPoints manifold(const A& a, const HullShape<float>& b, const PlacedPair& placed,
                       const ScaledContact& contact) {
  const Rectangle face = face_towards(contact.normal, a, placed.a);
  const FacingSide side = side_towards(-contact.normal, -contact.separation, b, placed.b);
  const ClipPoints points = reduce(
      clip(face, side.corners, side.face.frame.n, contact.normal, contact.touching()), kSamePoint);
  return or_witness(on_frame(face.frame, points), contact);
}

inline ContactPoints manifold(const CapsuleShape<float>& a, const HullShape<float>& b,
                              const PlacedPair& placed, const ScaledContact& contact) {
  const FacingSide side = side_towards(-contact.normal, -contact.separation, b, placed.b);
  return touch_face(line_towards(contact.normal, a, placed.a), side.face, contact);
}

template <AnyBox B>
ContactPoints manifold(const CapsuleShape<float>& a, const B& b, const PlacedPair& placed,
                       const ScaledContact& contact) {
  const SurfaceLine line = line_towards(contact.normal, a, placed.a);
  return touch_face(line, face_towards(-contact.normal, b, placed.b), contact);
}

inline ContactPoints manifold(const CapsuleShape<float>& a, const TriangleShape<float>& b,
                              const PlacedPair& placed, const ScaledContact& contact) {
  const TriangleFace face = triangle_face(corners_of(b, placed.b));
  if (!shows_face(b, face.frame.n, -contact.normal)) return witness_only(contact);
  return touch_face(line_towards(contact.normal, a, placed.a), face, contact);
}

inline ContactPoints manifold(const CapsuleShape<float>& a, const CapsuleShape<float>& b,
                              const PlacedPair& placed, const ScaledContact& contact) {
  return touch_capsule(a, placed.a, b, placed.b, contact);
}

inline ContactPoints manifold(const CapsuleShape<float>& a, const HalfspaceShape<float>&,
                              const PlacedPair& placed, const ScaledContact& contact) {
  return touch_plane(a, placed.a, contact);
}

// The corners of a box face over a plane. Their depths are measured from the lowest corner, so that
// the distance to the plane's body adds no rounding.
template <AnyBox A>
ContactPoints manifold(const A& a, const HalfspaceShape<float>&, const PlacedPair& placed,
                       const ScaledContact& contact) {
  const Vector3f& m = contact.normal;
  const Rectangle face = face_towards(m, a, placed.a);
  const float along_x = dot(face.frame.u, m), along_y = dot(face.frame.v, m);
  const auto depth = [&](Point2 p) { return p.x * along_x + p.y * along_y; };
  const std::array<Point2, 4> corners = face.corners();
  float lowest = depth(corners[0]);
  for (const Point2& p : corners) lowest = max(lowest, depth(p));
  const float size = a.size();
  ClipPoints all;
  for (const Point2& p : corners) {
    keep({p.x, p.y, contact.separation + (lowest - depth(p))}, contact.touching(size), all);
  }
  return or_witness(on_frame(face.frame, reduce(all, kSamePoint * (size * size))), contact);
}

// The frame of a plane through a point. Source of the axes: T. Duff et al., "Building an
// Orthonormal Basis, Revisited", JCGT 6(1), 2017.
inline FaceFrame plane_frame(const Vector3f& point, const Vector3f& n) {
  const float sign = std::copysign(1.0f, n.z());
  const float share = -1 / (sign + n.z());
  const float xy = n.x() * n.y() * share;
  const Vector3f u(1 + sign * (n.x() * n.x() * share), sign * xy, -sign * n.x());
  const Vector3f v(xy, sign + n.y() * n.y() * share, -n.y());
  return {point, u, v, n, 0};
}

// A is the half-space; the points are the projections of the triangle's corners on its plane.
inline ContactPoints manifold(const HalfspaceShape<float>&, const TriangleShape<float>& b,
                              const PlacedPair& placed, const ScaledContact& contact) {
  const std::array<Vector3f, 3> corners = corners_of(b, placed.b);
  const Vector3f front = triangle_face(corners).frame.n;
  if (!shows_face(b, front, -contact.normal)) return witness_only(contact);
  const FaceFrame frame = plane_frame(contact.arm_a, contact.normal);
  std::array<float, 3> heights;
  for (size_t i = 0; i < 3; ++i) {
    heights[i] = dot(contact.normal, rotate(placed.b.turn, b.corners[i]));
  }
  const float lowest = min(min(heights[0], heights[1]), heights[2]);
  const float size = b.size();
  ClipPoints all;
  for (size_t i = 0; i < 3; ++i) {
    const Vector3f r = corners[i] - frame.origin;
    keep({dot(frame.u, r), dot(frame.v, r), contact.separation + (heights[i] - lowest)},
         contact.touching(size), all);
  }
  return or_witness(on_frame(frame, reduce(all, kSamePoint * (size * size))), contact);
}

// The corners of a face over a plane, as for boxes. The contact is at the lowest corner.
inline ContactPoints manifold(const HullShape<float>& a, const HalfspaceShape<float>&,
                              const PlacedPair& placed, const ScaledContact& contact) {
  const Vector3f& m = contact.normal;
  const FacingSide side = side_towards(m, -contact.separation, a, placed.a);
  const FaceFrame frame = plane_frame(contact.arm_a, m);
  const float size = a.size();
  ClipPoints all;
  for (const Vector3f& p : side.corners) {
    const Vector3f r = p - frame.origin;
    keep({dot(frame.u, r), dot(frame.v, r), contact.separation - dot(m, r)}, contact.touching(size),
         all);
  }
  ContactPoints points = on_frame(frame, reduce(all, kSamePoint * (size * size)));
  for (ContactPoint& p : points) p.point -= m * (p.s - contact.separation);
  return or_witness(points, contact);
}

template <class A, class B>
concept HasFaces = requires(A a, B b, PlacedPair placed, ScaledContact contact) {
  manifold(a, b, placed, contact);
};

inline Rotation<float> not_turned() { return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}; }

template <class Shape>
Placed placed_at(const Vector3f& origin, const Quaternion<float>& q) {
  if constexpr (std::is_same_v<Shape, AabbShape<float>>) return {not_turned(), origin};
  return {rotation_of(q), origin};
}

// Converts to metres. No point is deeper than the contact, and none is further than the reach.
inline Manifold in_metres(const ContactPoints& points, const ScaledContact& contact, float up) {
  Manifold result;
  for (const ContactPoint& p : points) {
    Eigen::Map<Vector3f>(result.points.point[result.count].data()) = p.point * up;
    result.points.separation[result.count] = min(max(p.s, contact.separation), contact.reach) * up;
    ++result.count;
  }
  return result;
}

// A and B come in the order of pair_list.inc.
template <class A, class B>
requires HasFaces<A, B> Manifold manifold_in_order(const A& a, const B& b,
                                                   const PairPose<float>& pose,
                                                   const Separation& contact, float reach) {
  const Scale scale = scale_of(max(largest_component(pose.d), max(a.size(), b.size())));
  const ScaledContact scaled = {contact.separation * scale.down, contact.normal,
                                contact.arm_a * scale.down,
                                min(reach * scale.down, kGreatestReach)};
  // Adding 0 turns -0 into 0, because the sign of zero depends on which body is A.
  const Vector3f d = pose.d * scale.down + Vector3f::Zero();
  const PlacedPair placed = {placed_at<A>(Vector3f::Zero(), pose.a), placed_at<B>(d, pose.b)};
  return in_metres(manifold(a.scaled(scale.down), b.scaled(scale.down), placed, scaled), scaled,
                   scale.up);
}

// Spheres touch in one point.
template <class B>
Manifold manifold_in_order(const SphereShape<float>&, const B&, const PairPose<float>&,
                           const Separation& contact, float) {
  Manifold result;
  result.count = 1;
  Eigen::Map<Vector3f>(result.points.point[0].data()) = contact.arm_a;
  result.points.separation[0] = contact.separation;
  return result;
}

template <class A, class B>
concept HasManifold = requires(A a, B b, PairPose<float> pose, Separation contact) {
  manifold_in_order(a, b, pose, contact, 0.0f);
};

// Turns a manifold found with A and B exchanged into points on A.
inline Manifold flipped(Manifold manifold, const Vector3f& d, const Separation& contact) {
  for (size_t k = 0; k < manifold.count; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      float& x = manifold.points.point[k][axis];
      x = (x + contact.normal[axis] * manifold.points.separation[k]) + d[axis];
    }
  }
  return manifold;
}

}  // namespace carom::scalar
