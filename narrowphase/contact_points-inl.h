// Points of an overlap by the kinds of the two shapes, in lanes: where the faces that they turn
// towards each other along the contact's normal cover one another.
#if defined(CAROM_NARROWPHASE_CONTACT_POINTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_CONTACT_POINTS_INL_H_
#undef CAROM_NARROWPHASE_CONTACT_POINTS_INL_H_
#else
#define CAROM_NARROWPHASE_CONTACT_POINTS_INL_H_
#endif

#include "narrowphase/line_contact-inl.h"
#include "narrowphase/reduce-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Both bodies in scaled units, seen from A.
struct PlacedPair {
  Placed a, b;
};

// ClipPoints of a frame that is at A's surface.
template <size_t kCount>
HWY_INLINE void put_on_frame(const FaceFrame& frame, const ClipPoints<kCount>& all, F limit,
                             PointLanes& out) {
  ClipPoints<4> few;
  reduce(all, limit, few, out.used);
  for (size_t k = 0; k < 4; ++k) {
    out.point[k] = frame.point(few.x[k], few.y[k]);
    out.s[k] = few.s[k];
  }
}

HWY_INLINE void use_if(Mask mask, PointLanes& out) {
  for (Mask& used : out.used) used = hn::And(used, mask);
}

template <AnyBox A, AnyBox B>
HWY_INLINE void contact_points(const A& a, const B& b, const PlacedPair& placed,
                               const ContactLanes& contact, PointLanes& out) {
  Rectangle face, other;
  ClipPoints<12> all;
  face_towards(contact.normal, a, placed.a, face);
  face_towards(-contact.normal, b, placed.b, other);
  clip(face, other, contact.normal, all);
  put_on_frame(face.frame, all, splat(kSamePoint), out);
}

template <AnyBox A>
HWY_INLINE void contact_points(const A& a, const TriangleLanes& b, const PlacedPair& placed,
                               const ContactLanes& contact, PointLanes& out) {
  F3 corners[3];
  TriangleFace other;
  corners_of(b, placed.b, corners);
  triangle_face(corners, other);
  Rectangle face;
  ClipPoints<10> all;
  face_towards(contact.normal, a, placed.a, face);
  clip(face, corners, other.frame.n, contact.normal, all);
  put_on_frame(face.frame, all, splat(kSamePoint), out);
  use_if(shows_face(b, other.frame.n, -contact.normal), out);
}

HWY_INLINE void put_where(Mask mask, const FaceFrame& from, FaceFrame& to) {
  to.origin = select(mask, from.origin, to.origin);
  to.u = select(mask, from.u, to.u);
  to.v = select(mask, from.v, to.v);
  to.n = select(mask, from.n, to.n);
}

// The face is that of the triangle which the normal meets more squarely; of equals that of A.
HWY_INLINE void contact_points(const TriangleLanes& a, const TriangleLanes& b,
                               const PlacedPair& placed, const ContactLanes& contact,
                               PointLanes& out) {
  const F3& n = contact.normal;
  F3 corners_a[3], other[3];
  TriangleFace face, face_b;
  corners_of(a, placed.a, corners_a);
  corners_of(b, placed.b, other);
  triangle_face(corners_a, face);
  triangle_face(other, face_b);
  const Mask shown = hn::And(shows_face(a, face.frame.n, n), shows_face(b, face_b.frame.n, -n));
  const Mask on_b = hn::Gt(hn::Abs(dot(face_b.frame.n, n)), hn::Abs(dot(face.frame.n, n)));

  const F3 normal = select(on_b, face.frame.n, face_b.frame.n);
  put_where(on_b, face_b.frame, face.frame);
  for (size_t k = 0; k < 3; ++k) {
    other[k] = select(on_b, corners_a[k], other[k]);
    face.x[k] = hn::IfThenElse(on_b, face_b.x[k], face.x[k]);
    face.y[k] = hn::IfThenElse(on_b, face_b.y[k], face.y[k]);
  }
  const F3 m = negate_if(on_b, n);
  ClipPoints<9> all;
  clip(face, other, normal, m, all);
  put_on_frame(face.frame, all, splat(kSamePoint), out);
  for (size_t k = 0; k < 4; ++k) {
    out.point[k] = select(on_b, out.point[k] + m * out.s[k], out.point[k]);
  }
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

// The corners of a face over a plane, measured from the lowest of them: however far the plane's
// body is, that rounds no more than the shape itself.
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
  const F touching = hn::Mul(splat(kTouchingPoint), size);
  const Mask every = hn::Not(no_lanes());
  ClipPoints<4> all;
  for (size_t k = 0; k < 4; ++k) {
    const F s = hn::Add(contact.separation, hn::Sub(lowest, depth[k]));
    all.put(k, every, face.corner_x(k), face.corner_y(k), s, touching);
  }
  put_on_frame(face.frame, all, same_point_limit(size), out);
}

// A plane through a point (Duff et al. 2017).
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

// The plane is A: points are the feet of the corners.
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
  const F touching = hn::Mul(splat(kTouchingPoint), size);
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

#endif  // CAROM_NARROWPHASE_CONTACT_POINTS_INL_H_
