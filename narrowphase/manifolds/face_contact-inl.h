// Points where two faces cover one another, in lanes. Clipping is long, so it is compiled once an
// instruction set, in face_contact.cc, and not once a pair of kinds.
#if defined(CAROM_NARROWPHASE_MANIFOLDS_FACE_CONTACT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_MANIFOLDS_FACE_CONTACT_INL_H_
#undef CAROM_NARROWPHASE_MANIFOLDS_FACE_CONTACT_INL_H_
#else
#define CAROM_NARROWPHASE_MANIFOLDS_FACE_CONTACT_INL_H_
#endif

#include "narrowphase/manifolds/line_contact-inl.h"
#include "narrowphase/manifolds/reduce-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Reduces clip points to four and moves them to space. The frame lies on A's surface.
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

// A's face is that of a box; so is the other one.
void touch_boxes(const Rectangle& face, const Rectangle& other, const ContactLanes& contact,
                 PointLanes& out);

// A's face is that of a box. `Face`: TriangleFace, or PolygonFace of 3, 4 or kMostSideCorners.
template <class Face>
void touch_box(const Rectangle& face, const FaceSide<Face>& other, const ContactLanes& contact,
               PointLanes& out);

// Two faces of one type. They are clipped on the face that is more nearly perpendicular to the
// normal, or A's if both are equal. Lanes that use B's face swap `a` and `b`.
template <class Face>
void touch_faces(FaceSide<Face>& a, FaceSide<Face>& b, const ContactLanes& contact,
                 PointLanes& out);

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_MANIFOLDS_FACE_CONTACT_INL_H_
