// Manifolds of pairs with a cylinder, a cone or an ellipsoid: the scalar form.
#pragma once

#include "narrowphase/manifolds/manifold_scalar.h"
#include "narrowphase/manifolds/round_side_scalar.h"

namespace carom::scalar {

// The radius of a shape's edge that faces another, seen along the edge.
inline float edge_radius(const auto& shape) {
  if constexpr (requires { shape.radius; }) return shape.radius;
  return 0;
}

// Sides of the other shapes, with frames that lie on them.
inline FacingSide side_of_polygon(const FaceFrame& frame, std::span<const Point2> points) {
  FacingSide side;
  side.face.frame = {frame.origin + frame.n * frame.height, frame.u, frame.v, frame.n, 0};
  for (const Point2& p : points) {
    side.corners.push_back(side.face.frame.point(p.x, p.y));
    side.face.points.push_back(p);
  }
  return side;
}
template <AnyBox S>
FacingSide side_towards(const Vector3f& m, float, const S& box, const Placed& placed) {
  const Rectangle face = face_towards(m, box, placed);
  return side_of_polygon(face.frame, face.corners());
}
inline FacingSide side_towards(const Vector3f&, float, const TriangleShape<float>& triangle,
                               const Placed& placed) {
  const TriangleFace face = triangle_face(corners_of(triangle, placed));
  return side_of_polygon(face.frame, face.points);
}
inline FacingSide side_towards(const Vector3f& m, float, const CapsuleShape<float>& capsule,
                               const Placed& placed) {
  const SurfaceLine line = line_towards(m, capsule, placed);
  const Vector3f zero = Vector3f::Zero();
  FacingSide side;
  side.corners = {line.a, line.b};
  if (!line.exists) side.corners = {placed.origin};
  side.face.frame = {side.corners[0], zero, zero, zero, 0};
  return side;
}

// Two edges, seen along the normal. They have two points if they are nearly parallel. Of edges with
// a radius, a point beside the other edge is above it by half the square of the distance, divided
// by the radius.
inline ContactPoints touch_edges(const FaceCorners& edge_a, const FaceCorners& edge_b, float radius,
                                 const ScaledContact& contact) {
  const Vector3f along = edge_a[1] - edge_a[0], other = edge_b[1] - edge_b[0];
  const Vector3f turn = cross<float>(along, other);
  const float squares = dot(along, along) * dot(other, other);
  ContactPoints two;
  if (squares > 0 && dot(turn, turn) <= kSameDirection * squares) {
    const float rate = dot(along, other);
    for (const Vector3f& end : edge_b) {
      // The place on A's edge over this end, kept on the edge, and the place on B's below it.
      const float t = clamp(dot(Vector3f(end - edge_a[0]), along) / dot(along, along), 0.0f, 1.0f);
      const Vector3f on_a = edge_a[0] + along * t;
      const float u = clamp(dot(Vector3f(on_a - edge_b[0]), along) / rate, 0.0f, 1.0f);
      const Vector3f way = (edge_b[0] + other * u) - on_a;
      const float s = dot(way, contact.normal);
      const Vector3f aside = way - contact.normal * s;
      const float beyond = dot(aside, along), squared = dot(aside, aside);
      const bool is_over = squared <= kTouchingPoint * radius + kSamePoint &&
                           beyond * beyond <= kSamePoint * dot(along, along);
      two.push_back({on_a, is_over ? s : kNoPoint});
    }
  }
  return reduce_line(contact, two);
}

// `radius`: the least of their edges.
inline ContactPoints touch_sides(const FacingSide& a, const FacingSide& b, float radius,
                                 const ScaledContact& contact) {
  if (a.corners.size() < 2 || b.corners.size() < 2) return witness_only(contact);
  if (a.corners.size() == 2 && b.corners.size() == 2) {
    return touch_edges(a.corners, b.corners, radius, contact);
  }
  return touch_faces(a.face, a.corners, b.face, b.corners, contact);
}

template <class S>
concept HasSide = requires(Vector3f m, S shape, Placed placed) {
  side_towards(m, 0.0f, shape, placed);
};

template <HasSide A, HasSide B>
requires(RoundShape<A> || RoundShape<B>) ContactPoints
    manifold(const A& a, const B& b, const PlacedPair& placed, const ScaledContact& contact) {
  const float depth = -contact.separation;
  return touch_sides(side_towards(contact.normal, depth, a, placed.a),
                     side_towards(-contact.normal, depth, b, placed.b),
                     min(edge_radius(a), edge_radius(b)), contact);
}

template <RoundShape A>
ContactPoints manifold(const A& a, const TriangleShape<float>& b, const PlacedPair& placed,
                       const ScaledContact& contact) {
  const FacingSide side_b = side_towards(-contact.normal, 0, b, placed.b);
  if (!shows_face(b, side_b.face.frame.n, -contact.normal)) return witness_only(contact);
  return touch_sides(side_towards(contact.normal, 0, a, placed.a), side_b, 0, contact);
}

// A is the half-space; the points are the projections of the side's corners on its plane. Depths
// are measured from the lowest corner, so that the distance of the plane's body adds no rounding.
template <RoundShape B>
ContactPoints manifold(const HalfspaceShape<float>&, const B& b, const PlacedPair& placed,
                       const ScaledContact& contact) {
  const Vector3f& n = contact.normal;
  const FacingSide side = side_towards(-n, 0, b, {placed.b.turn, Vector3f::Zero()});
  if (side.corners.size() < 2) return witness_only(contact);
  const FaceFrame frame = plane_frame(contact.arm_a, n);
  float lowest = dot(n, side.corners[0]);
  for (const Vector3f& p : side.corners) lowest = min(lowest, dot(n, p));
  const float size = b.size();
  ClipPoints all;
  for (const Vector3f& p : side.corners) {
    const Vector3f r = (p + placed.b.origin) - frame.origin;
    keep({dot(frame.u, r), dot(frame.v, r), contact.separation + (dot(n, p) - lowest)},
         contact.touching(size), all);
  }
  return or_witness(on_frame(frame, reduce(all, kSamePoint * (size * size))), contact);
}

}  // namespace carom::scalar
