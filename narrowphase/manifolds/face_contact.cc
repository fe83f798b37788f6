#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/manifolds/face_contact.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/manifolds/face_contact-inl.h"
#include "narrowphase/manifolds/hull_side-inl.h"
#include "narrowphase/manifolds/rectangles-inl.h"
#include "narrowphase/manifolds/round_side-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

HWY_INLINE void swap_where(Mask mask, F& a, F& b) {
  const F kept = a;
  a = hn::IfThenElse(mask, b, a);
  b = hn::IfThenElse(mask, kept, b);
}
HWY_INLINE void swap_where(Mask mask, F3& a, F3& b) {
  swap_where(mask, a.x, b.x);
  swap_where(mask, a.y, b.y);
  swap_where(mask, a.z, b.z);
}

HWY_INLINE void swap_rest(Mask, TriangleFace&, TriangleFace&) {}
template <size_t kMost>
HWY_INLINE void swap_rest(Mask mask, PolygonFace<kMost>& a, PolygonFace<kMost>& b) {
  swap_where(mask, a.count, b.count);
  swap_where(mask, a.lower_x, b.lower_x);
  swap_where(mask, a.lower_y, b.lower_y);
  swap_where(mask, a.upper_x, b.upper_x);
  swap_where(mask, a.upper_y, b.upper_y);
}

// Heights of the frames need no swap, because both are zero.
template <class Face>
HWY_INLINE void swap_where(Mask mask, FaceSide<Face>& a, FaceSide<Face>& b) {
  swap_where(mask, a.face.frame.origin, b.face.frame.origin);
  swap_where(mask, a.face.frame.u, b.face.frame.u);
  swap_where(mask, a.face.frame.v, b.face.frame.v);
  swap_where(mask, a.face.frame.n, b.face.frame.n);
  for (size_t k = 0; k < Face::kCorners; ++k) {
    swap_where(mask, a.face.x[k], b.face.x[k]);
    swap_where(mask, a.face.y[k], b.face.y[k]);
    swap_where(mask, a.corners[k], b.corners[k]);
  }
  swap_rest(mask, a.face, b.face);
}

}  // namespace

void touch_boxes(const Rectangle& face, const Rectangle& other, const ContactLanes& contact,
                 PointLanes& out) {
  ClipPoints<8> all;
  clip(face, other, contact.normal, contact.touching(), all);
  put_on_frame(face.frame, all, splat(kSamePoint), out);
}

template <class Face>
void touch_box(const Rectangle& face, const FaceSide<Face>& other, const ContactLanes& contact,
               PointLanes& out) {
  ClipPoints<4 + 2 * Face::kCorners> all;
  clip(face, other, contact.normal, contact.touching(), all);
  put_on_frame(face.frame, all, splat(kSamePoint), out);
}

template <class Face>
void touch_faces(FaceSide<Face>& a, FaceSide<Face>& b, const ContactLanes& contact,
                 PointLanes& out) {
  const F3& n = contact.normal;
  const Mask on_b = hn::Gt(hn::Abs(dot(b.face.frame.n, n)), hn::Abs(dot(a.face.frame.n, n)));
  swap_where(on_b, a, b);
  const F3 m = negate_if(on_b, n);
  ClipPoints<3 * Face::kCorners> all;
  clip(a.face, b, m, contact.touching(), all);
  put_on_frame(a.face.frame, all, splat(kSamePoint), out);
  for (size_t k = 0; k < 4; ++k) {
    out.point[k] = select(on_b, out.point[k] + m * out.s[k], out.point[k]);
  }
}

template void touch_box(const Rectangle&, const FaceSide<TriangleFace>&, const ContactLanes&,
                        PointLanes&);
template void touch_box(const Rectangle&, const FaceSide<PolygonFace<3>>&, const ContactLanes&,
                        PointLanes&);
template void touch_box(const Rectangle&, const FaceSide<PolygonFace<4>>&, const ContactLanes&,
                        PointLanes&);
template void touch_box(const Rectangle&, const FaceSide<PolygonFace<kMostSideCorners>>&,
                        const ContactLanes&, PointLanes&);

template void touch_faces(FaceSide<TriangleFace>&, FaceSide<TriangleFace>&, const ContactLanes&,
                          PointLanes&);
template void touch_faces(FaceSide<PolygonFace<3>>&, FaceSide<PolygonFace<3>>&, const ContactLanes&,
                          PointLanes&);
template void touch_faces(FaceSide<PolygonFace<4>>&, FaceSide<PolygonFace<4>>&, const ContactLanes&,
                          PointLanes&);
template void touch_faces(FaceSide<PolygonFace<kMostSideCorners>>&,
                          FaceSide<PolygonFace<kMostSideCorners>>&, const ContactLanes&,
                          PointLanes&);
template void touch_faces(RimSide&, RimSide&, const ContactLanes&, PointLanes&);

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
