// Contact points of overlapping pairs in lanes, by the kinds of the shapes: the corners of the
// region that their facing faces both cover, seen along the contact's normal.
#if defined(CAROM_NARROWPHASE_MANIFOLDS_CONTACT_POINTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_MANIFOLDS_CONTACT_POINTS_INL_H_
#undef CAROM_NARROWPHASE_MANIFOLDS_CONTACT_POINTS_INL_H_
#else
#define CAROM_NARROWPHASE_MANIFOLDS_CONTACT_POINTS_INL_H_
#endif

#include <type_traits>

#include "narrowphase/manifolds/face_contact-inl.h"
#include "narrowphase/manifolds/rectangles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Both bodies in scaled units, relative to the position of A.
struct PlacedPair {
  Placed a, b;
};

HWY_INLINE void use_if(Mask mask, PointLanes& out) {
  for (Mask& used : out.used) used = hn::And(used, mask);
}

template <AnyBox A, AnyBox B>
HWY_INLINE void contact_points(const A& a, const B& b, const PlacedPair& placed,
                               const ContactLanes& contact, PointLanes& out) {
  Rectangle face, other;
  face_towards(contact.normal, a, placed.a, face);
  face_towards(-contact.normal, b, placed.b, other);
  if constexpr (std::is_same_v<A, AabbLanes> && std::is_same_v<B, AabbLanes>) {
    // The axes are constants here, with which the compiler drops a part of clipping.
    ClipPoints<8> all;
    clip(face, other, contact.normal, contact.touching(), all);
    put_on_frame(face.frame, all, splat(kSamePoint), out);
  } else {
    touch_boxes(face, other, contact, out);
  }
}

template <AnyBox A>
HWY_INLINE void contact_points(const A& a, const TriangleLanes& b, const PlacedPair& placed,
                               const ContactLanes& contact, PointLanes& out) {
  Rectangle face;
  FaceSide<TriangleFace> side;
  face_towards(contact.normal, a, placed.a, face);
  triangle_side(b, placed.b, side);
  touch_box(face, side, contact, out);
  use_if(shows_face(b, side.face.frame.n, -contact.normal), out);
}

HWY_INLINE void contact_points(const TriangleLanes& a, const TriangleLanes& b,
                               const PlacedPair& placed, const ContactLanes& contact,
                               PointLanes& out) {
  FaceSide<TriangleFace> side_a, side_b;
  triangle_side(a, placed.a, side_a);
  triangle_side(b, placed.b, side_b);
  const F3& n = contact.normal;
  const Mask shown =
      hn::And(shows_face(a, side_a.face.frame.n, n), shows_face(b, side_b.face.frame.n, -n));
  touch_faces(side_a, side_b, contact, out);
  use_if(shown, out);
}

template <AnyBox B>
HWY_INLINE void contact_points(const CapsuleLanes& a, const B& b, const PlacedPair& placed,
                               const ContactLanes& contact, PointLanes& out) {
  SurfaceLine line;
  Rectangle face;
  line_towards(contact.normal, a, placed.a, line);
  face_towards(-contact.normal, b, placed.b, face);
  touch_face(line, face, contact, out);
}

HWY_INLINE void contact_points(const CapsuleLanes& a, const TriangleLanes& b,
                               const PlacedPair& placed, const ContactLanes& contact,
                               PointLanes& out) {
  SurfaceLine line;
  F3 corners[3];
  TriangleFace face;
  line_towards(contact.normal, a, placed.a, line);
  corners_of(b, placed.b, corners);
  triangle_face(corners, face);
  touch_face(line, face, contact, out);
  use_if(shows_face(b, face.frame.n, -contact.normal), out);
}

HWY_INLINE void contact_points(const CapsuleLanes& a, const CapsuleLanes& b,
                               const PlacedPair& placed, const ContactLanes& contact,
                               PointLanes& out) {
  touch_capsule(a, placed.a, b, placed.b, contact, out);
}

HWY_INLINE void contact_points(const CapsuleLanes& a, const HalfspaceLanes&,
                               const PlacedPair& placed, const ContactLanes& contact,
                               PointLanes& out) {
  touch_plane(a, placed.a, contact, out);
}

HWY_INLINE F same_point_limit(F size) { return hn::Mul(splat(kSamePoint), hn::Mul(size, size)); }

// The corners of a box face over a plane. Their depths are measured from the lowest corner, so that
// the distance to the plane's body adds no rounding.
template <AnyBox A>
HWY_INLINE void contact_points(const A& a, const HalfspaceLanes&, const PlacedPair& placed,
                               const ContactLanes& contact, PointLanes& out) {
  const F3& m = contact.normal;
  Rectangle face;
  face_towards(m, a, placed.a, face);
  const F along_x = dot(face.frame.u, m);
  const F along_y = dot(face.frame.v, m);
  F depth[4];
  for (size_t k = 0; k < 4; ++k) {
    depth[k] = hn::Add(hn::Mul(face.corner_x(k), along_x), hn::Mul(face.corner_y(k), along_y));
  }
  const F lowest = max(max(max(depth[0], depth[1]), depth[2]), depth[3]);
  const F size = a.extent();
  const F touching = contact.touching(size);
  const Mask every = hn::Not(no_lanes());
  ClipPoints<4> all;
  for (size_t k = 0; k < 4; ++k) {
    const F s = hn::Add(contact.separation, hn::Sub(lowest, depth[k]));
    all.put(k, every, face.corner_x(k), face.corner_y(k), s, touching);
  }
  put_on_frame(face.frame, all, same_point_limit(size), out);
}

// The frame of a plane through a point (Duff et al. 2017).
HWY_INLINE void plane_frame(const F3& point, const F3& n, FaceFrame& frame) {
  const F one = splat(1);
  const F sign = hn::CopySign(one, n.z);
  const F share = hn::Div(splat(-1), hn::Add(sign, n.z));
  const F xy = hn::Mul(hn::Mul(n.x, n.y), share);
  frame.origin = point;
  frame.u = {hn::Add(one, hn::Mul(sign, hn::Mul(hn::Mul(n.x, n.x), share))), hn::Mul(sign, xy),
             hn::Mul(hn::Neg(sign), n.x)};
  frame.v = {xy, hn::Add(sign, hn::Mul(hn::Mul(n.y, n.y), share)), hn::Neg(n.y)};
  frame.n = n;
  frame.height = splat(0);
}

// A is the half-space; the points are the projections of the triangle's corners on its plane.
HWY_INLINE void contact_points(const HalfspaceLanes&, const TriangleLanes& b,
                               const PlacedPair& placed, const ContactLanes& contact,
                               PointLanes& out) {
  F3 corners[3];
  TriangleFace face;
  FaceFrame plane;
  corners_of(b, placed.b, corners);
  triangle_face(corners, face);
  plane_frame(contact.arm_a, contact.normal, plane);
  const F heights[3] = {dot(contact.normal, rotate(placed.b.turn, b.a)),
                        dot(contact.normal, rotate(placed.b.turn, b.b)),
                        dot(contact.normal, rotate(placed.b.turn, b.c))};
  const F lowest = min(min(heights[0], heights[1]), heights[2]);
  const F size = b.extent();
  const F touching = contact.touching(size);
  const Mask shown = shows_face(b, face.frame.n, -contact.normal);
  ClipPoints<3> all;
  for (size_t k = 0; k < 3; ++k) {
    const F3 r = corners[k] - plane.origin;
    const F s = hn::Add(contact.separation, hn::Sub(heights[k], lowest));
    all.put(k, shown, dot(plane.u, r), dot(plane.v, r), s, touching);
  }
  put_on_frame(plane, all, same_point_limit(size), out);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_MANIFOLDS_CONTACT_POINTS_INL_H_
