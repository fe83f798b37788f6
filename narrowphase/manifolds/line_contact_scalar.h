// Manifolds of capsules: at most two points.
#pragma once

#include "narrowphase/manifolds/clip_scalar.h"

namespace carom::scalar {

// The contact in scaled units.
struct ScaledContact {
  float separation;
  Vector3f normal;  // from A to B
  Vector3f arm_a;
  float reach;  // the contact distance, at most kGreatestReach

  // The greatest s of a point, for shapes of a size.
  float touching(float size = 1) const { return max(kTouchingPoint * size, reach); }
};

struct ContactPoint {
  Vector3f point;  // on A
  float s;         // gap from there to B along the normal
};

using ContactPoints = FewOf<ContactPoint, 4>;

// A line on the surface of a capsule, parallel to its axis.
struct SurfaceLine {
  Vector3f a, b;
  bool exists;
};

// The line that faces `m`, a unit vector. A capsule seen along its axis has none.
inline SurfaceLine line_towards(const Vector3f& m, const CapsuleShape<float>& capsule,
                                const Placed& placed) {
  const Vector3f a = rotate(placed.turn, capsule.a) + placed.origin;
  const Vector3f b = rotate(placed.turn, capsule.b) + placed.origin;
  const Vector3f axis = b - a;
  const Vector3f across = m - axis * (dot(m, axis) / dot(axis, axis));
  const float squared = dot(across, across);
  const Vector3f way = across * (capsule.radius / std::sqrt(squared));
  return {a + way, b + way, squared > kEndOn};
}

// Takes the deeper of the two points if it is as deep as the witness point, for shapes of a size,
// else the witness point; then the point farthest from that. A single point is always the witness
// point. Points with an s beyond contact.touching() do not count.
inline ContactPoints reduce_line(const ScaledContact& contact, const ContactPoints& two,
                                 float size = 1) {
  const float touching = contact.touching(size), limit = kSamePoint * (size * size);
  ContactPoint first = {contact.arm_a, contact.separation};
  const ContactPoint* deepest = nullptr;
  for (const ContactPoint& p : two) {
    if (p.s <= touching && (!deepest || p.s < deepest->s)) deepest = &p;
  }
  if (deepest && deepest->s <= contact.separation + kTouchingPoint * size) first = *deepest;
  ContactPoint second = first;
  float farthest = 0;
  for (const ContactPoint& p : two) {
    const Vector3f way = p.point - first.point;
    const float squared = dot(way, way);
    if (p.s <= touching && squared > farthest) {
      farthest = squared;
      second = p;
    }
  }
  if (farthest > limit) return {first, second};
  return {{contact.arm_a, contact.separation}};
}

// A capsule (A) on a face of B.
template <class Face>
ContactPoints touch_face(const SurfaceLine& line, const Face& face, const ScaledContact& contact) {
  const Vector3f m = -contact.normal;
  const FaceView view(face.frame, m);
  ContactPoints two;
  if (line.exists && !view.is_edge_on()) {
    ClipPoints ends;
    add_edge(face, edge_between(view.project(line.a), view.project(line.b)), contact.touching(),
             ends);
    for (const ClipPoint& c : ends) two.push_back({face.frame.point(c.x, c.y) + m * c.s, c.s});
  }
  return reduce_line(contact, two);
}

// A capsule (A) on a plane. Tolerances follow the capsule's own size, not the distance of the
// plane's body.
inline ContactPoints touch_plane(const CapsuleShape<float>& capsule, const Placed& placed,
                                 const ScaledContact& contact) {
  const Vector3f& m = contact.normal;
  const SurfaceLine line = line_towards(m, capsule, placed);
  const float size = capsule.size();
  ContactPoints two;
  if (line.exists) {
    const float end_a = dot(m, rotate(placed.turn, capsule.a));
    const float end_b = dot(m, rotate(placed.turn, capsule.b));
    const float lowest = max(end_a, end_b) + capsule.radius;
    two = {{line.a, contact.separation + (lowest - dot(m, line.a))},
           {line.b, contact.separation + (lowest - dot(m, line.b))}};
  }
  return reduce_line(contact, two, size);
}

// The length along n from a point to the cylinder around an axis; kNoPoint if it misses, or hits
// beyond the ends.
inline ContactPoint enter_cylinder(const Vector3f& point, const Vector3f& n, const Vector3f& start,
                                   const Vector3f& axis, float radius) {
  const float squared = dot(axis, axis);
  const Vector3f r = point - start;
  const Vector3f n_across = n - axis * (dot(n, axis) / squared);
  const Vector3f r_across = r - axis * (dot(r, axis) / squared);
  const float nn = dot(n_across, n_across);
  const float k = dot(r_across, n_across) / nn;
  const Vector3f aside = r_across - n_across * k;
  const float left = radius * radius - dot(aside, aside);
  const float s = -k - std::sqrt(max(left, 0.0f) / nn);
  const float t = dot(r + n * s, axis) / squared;
  const float over = max(max(-t, t - 1), 0.0f);
  const float reach = kOverhang * radius + kClipSlack;
  const bool hit = left >= 0 && (over * over) * squared <= reach * reach;
  return {point, hit ? s : kNoPoint};
}

// Two capsules. They have two points if their axes are nearly parallel.
inline ContactPoints touch_capsule(const CapsuleShape<float>& capsule_a, const Placed& placed_a,
                                   const CapsuleShape<float>& capsule_b, const Placed& placed_b,
                                   const ScaledContact& contact) {
  const Vector3f& n = contact.normal;
  const SurfaceLine line = line_towards(n, capsule_a, placed_a);
  const Vector3f along = line.b - line.a;
  const Vector3f start = rotate(placed_b.turn, capsule_b.a) + placed_b.origin;
  const Vector3f end = rotate(placed_b.turn, capsule_b.b) + placed_b.origin;
  const Vector3f axis = end - start;
  const Vector3f turn = cross<float>(along, axis);
  const float squares = dot(along, along) * dot(axis, axis);
  ContactPoints two;
  if (line.exists && squares > 0 && dot(turn, turn) <= kSameDirection * squares) {
    const float rate = dot(along, axis);
    const Vector3f shift = line.a + n * contact.separation;
    for (const Vector3f& b : {start, end}) {
      const float t = clamp(dot(Vector3f(b - shift), axis) / rate, 0.0f, 1.0f);
      two.push_back(enter_cylinder(line.a + along * t, n, start, axis, capsule_b.radius));
    }
  }
  return reduce_line(contact, two);
}

}  // namespace carom::scalar
