// Contact points of overlapping pairs with a hull, in lanes: the corners of the region that their
// facing faces both cover.
#if defined(CAROM_NARROWPHASE_MANIFOLDS_HULL_POINTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_MANIFOLDS_HULL_POINTS_INL_H_
#undef CAROM_NARROWPHASE_MANIFOLDS_HULL_POINTS_INL_H_
#else
#define CAROM_NARROWPHASE_MANIFOLDS_HULL_POINTS_INL_H_
#endif

#include <type_traits>

#include "narrowphase/manifolds/contact_points-inl.h"
#include "narrowphase/manifolds/hull_side-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Calls use(n) with a constant n that is at least `most`. Triangles are the most frequent by far.
template <class Use>
HWY_INLINE void with_corners(size_t most, const Use& use) {
  if (most <= 3) return use(std::integral_constant<size_t, 3>());
  if (most <= 4) return use(std::integral_constant<size_t, 4>());
  use(std::integral_constant<size_t, kMostSideCorners>());
}

HWY_INLINE FacingFaces faces_towards(const F3& m, const HullLanes& hull, const Placed& placed,
                                     const ContactLanes& contact) {
  return FacingFaces(hull, rotate_back(placed.turn, m), hn::Neg(contact.separation));
}

// Each function returns the lanes whose points it knows. The scalar form finds the others.

HWY_INLINE Mask contact_points(const HullLanes& a, const HullLanes& b, const PlacedPair& placed,
                               const ContactLanes& contact, PointLanes& out) {
  const FacingFaces faces_a = faces_towards(contact.normal, a, placed.a, contact);
  const FacingFaces faces_b = faces_towards(-contact.normal, b, placed.b, contact);
  with_corners(std::max(faces_a.most(), faces_b.most()), [&](auto most) HWY_ATTR {
    FaceSide<PolygonFace<most()>> side_a, side_b;
    hull_side(placed.a, faces_a, side_a);
    hull_side(placed.b, faces_b, side_b);
    touch_faces(side_a, side_b, contact, out);
  });
  return hn::And(faces_a.is_known(), faces_b.is_known());
}

HWY_INLINE Mask contact_points(const CapsuleLanes& a, const HullLanes& b, const PlacedPair& placed,
                               const ContactLanes& contact, PointLanes& out) {
  const FacingFaces faces = faces_towards(-contact.normal, b, placed.b, contact);
  SurfaceLine line;
  line_towards(contact.normal, a, placed.a, line);
  with_corners(faces.most(), [&](auto most) HWY_ATTR {
    FaceSide<PolygonFace<most()>> side;
    hull_side(placed.b, faces, side);
    touch_face(line, side.face, contact, out);
  });
  return faces.is_known();
}

template <AnyBox A>
HWY_INLINE Mask contact_points(const A& a, const HullLanes& b, const PlacedPair& placed,
                               const ContactLanes& contact, PointLanes& out) {
  const FacingFaces faces = faces_towards(-contact.normal, b, placed.b, contact);
  Rectangle face;
  face_towards(contact.normal, a, placed.a, face);
  with_corners(faces.most(), [&](auto most) HWY_ATTR {
    FaceSide<PolygonFace<most()>> side;
    hull_side(placed.b, faces, side);
    touch_box(face, side, contact, out);
  });
  return faces.is_known();
}

HWY_INLINE Mask contact_points(const HullLanes& a, const TriangleLanes& b, const PlacedPair& placed,
                               const ContactLanes& contact, PointLanes& out) {
  const FacingFaces faces = faces_towards(contact.normal, a, placed.a, contact);
  FaceSide<TriangleFace> triangle;
  triangle_side(b, placed.b, triangle);
  const Mask shown = shows_face(b, triangle.face.frame.n, -contact.normal);
  with_corners(faces.most(), [&](auto most) HWY_ATTR {
    FaceSide<PolygonFace<most()>> side_a, side_b;
    hull_side(placed.a, faces, side_a);
    triangle_as_polygon(triangle, side_b);
    touch_faces(side_a, side_b, contact, out);
  });
  use_if(shown, out);
  return faces.is_known();
}

// The corners of the facing face over a plane. The contact is at the lowest.
HWY_INLINE Mask contact_points(const HullLanes& a, const HalfspaceLanes&, const PlacedPair& placed,
                               const ContactLanes& contact, PointLanes& out) {
  const F3& m = contact.normal;
  const FacingFaces faces = faces_towards(m, a, placed.a, contact);
  FaceFrame plane;
  plane_frame(contact.arm_a, m, plane);
  const F size = a.extent();
  const F touching = contact.touching(size);
  with_corners(faces.most(), [&](auto most) HWY_ATTR {
    FaceSide<PolygonFace<most()>> side;
    hull_side(placed.a, faces, side);
    ClipPoints<most()> all;
    for (size_t k = 0; k < most(); ++k) {
      const F3 r = side.corners[k] - plane.origin;
      const F s = hn::Sub(contact.separation, dot(m, r));
      all.put(k, side.face.where(k, hn::Not(no_lanes())), dot(plane.u, r), dot(plane.v, r), s,
              touching);
    }
    put_on_frame(plane, all, same_point_limit(size), out);
  });
  for (size_t k = 0; k < 4; ++k) {
    out.point[k] = out.point[k] - m * hn::Sub(out.s[k], contact.separation);
  }
  return faces.is_known();
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_MANIFOLDS_HULL_POINTS_INL_H_
