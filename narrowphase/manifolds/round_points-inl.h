// Contact points of overlapping pairs with a round shape, in lanes (round_manifold_scalar.h is the
// scalar form): the corners of the region that their facing sides both cover.
//
// contact_points() returns the lanes whose points it knows. The scalar form finds the others: two
// lines, shapes with a rounding, hulls whose facing face is unknown, flat ellipsoids.
#if defined(CAROM_NARROWPHASE_MANIFOLDS_ROUND_POINTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_MANIFOLDS_ROUND_POINTS_INL_H_
#undef CAROM_NARROWPHASE_MANIFOLDS_ROUND_POINTS_INL_H_
#else
#define CAROM_NARROWPHASE_MANIFOLDS_ROUND_POINTS_INL_H_
#endif

#include "narrowphase/manifolds/hull_points-inl.h"
#include "narrowphase/manifolds/round_side-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

template <class Round>
HWY_INLINE Mask is_sharp(const Round& shape) {
  return hn::Eq(shape.rounding, splat(0));
}

template <AnyBox A>
HWY_INLINE Mask contact_points(const A& a, const CylinderLanes& b, const PlacedPair& placed,
                               const ContactLanes& contact, PointLanes& out) {
  Rectangle face;
  RimSide side_a, side_b;
  face_towards(contact.normal, a, placed.a, face);
  polygon_side(face, side_a);
  (void)rim_side(-contact.normal, b, placed.b, side_b);
  touch_faces(side_a, side_b, contact, out);
  return is_sharp(b);
}

HWY_INLINE Mask contact_points(const HullLanes& a, const CylinderLanes& b, const PlacedPair& placed,
                               const ContactLanes& contact, PointLanes& out) {
  const FacingFaces faces = faces_towards(contact.normal, a, placed.a, contact);
  RimSide side_a, side_b;
  hull_side(placed.a, faces, side_a);
  (void)rim_side(-contact.normal, b, placed.b, side_b);
  touch_faces(side_a, side_b, contact, out);
  return hn::And(faces.is_known(), is_sharp(b));
}

HWY_INLINE Mask contact_points(const CylinderLanes& a, const CylinderLanes& b,
                               const PlacedPair& placed, const ContactLanes& contact,
                               PointLanes& out) {
  RimSide side_a, side_b;
  const Mask is_disc_a = rim_side(contact.normal, a, placed.a, side_a);
  const Mask is_disc_b = rim_side(-contact.normal, b, placed.b, side_b);
  touch_faces(side_a, side_b, contact, out);
  return hn::And(hn::Or(is_disc_a, is_disc_b), hn::And(is_sharp(a), is_sharp(b)));
}

HWY_INLINE Mask contact_points(const CylinderLanes& a, const TriangleLanes& b,
                               const PlacedPair& placed, const ContactLanes& contact,
                               PointLanes& out) {
  F3 corners[3];
  TriangleFace face;
  RimSide side_a, side_b;
  corners_of(b, placed.b, corners);
  triangle_face(corners, face);
  polygon_side(face, side_b);
  (void)rim_side(contact.normal, a, placed.a, side_a);
  const Mask shown = shows_face(b, face.frame.n, -contact.normal);
  touch_faces(side_a, side_b, contact, out);
  use_if(shown, out);
  return is_sharp(a);
}

// The corners of the facing side over a plane. Depths are measured from the lowest corner, so that
// the distance of the plane's body adds no rounding.
template <ShapeKind kRound>
HWY_INLINE Mask contact_points(const HalfspaceLanes&, const RimLanes<kRound>& b,
                               const PlacedPair& placed, const ContactLanes& contact,
                               PointLanes& out) {
  const F3& n = contact.normal;
  RimSide side;
  const Mask is_disc = rim_side(-n, b, {placed.b.turn, splat3(0)}, side);
  FaceFrame plane;
  plane_frame(contact.arm_a, n, plane);
  F heights[kRimCorners], lowest = dot(n, side.corners[0]);
  for (size_t k = 0; k < kRimCorners; ++k) {
    heights[k] = dot(n, side.corners[k]);
    lowest = min(lowest, heights[k]);
  }
  const F size = b.extent();
  const F touching = contact.touching(size);
  ClipPoints<kRimCorners> all;
  for (size_t k = 0; k < kRimCorners; ++k) {
    const F3 r = (side.corners[k] + placed.b.origin) - plane.origin;
    const F s = hn::Add(contact.separation, hn::Sub(heights[k], lowest));
    all.put(k, k < 2 ? hn::Not(no_lanes()) : is_disc, dot(plane.u, r), dot(plane.v, r), s,
            touching);
  }
  put_on_frame(plane, all, same_point_limit(size), out);
  return is_sharp(b);
}

// An ellipsoid touches in one point, unless it is flat.
HWY_INLINE Mask contact_points(const HalfspaceLanes&, const EllipsoidLanes& b, const PlacedPair&,
                               const ContactLanes& contact, PointLanes& out) {
  for (size_t k = 0; k < 4; ++k) {
    out.point[k] = contact.arm_a;
    out.s[k] = contact.separation;
    out.used[k] = no_lanes();
  }
  const F3& axes = b.semi_axes;
  return hn::And(is_sharp(b), hn::Gt(min(min(axes.x, axes.y), axes.z), splat(0)));
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_MANIFOLDS_ROUND_POINTS_INL_H_
