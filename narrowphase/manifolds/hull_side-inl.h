// The faces that hulls turn towards other shapes, in lanes (hull_face.h is the scalar form).
#if defined(CAROM_NARROWPHASE_MANIFOLDS_HULL_SIDE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_MANIFOLDS_HULL_SIDE_INL_H_
#undef CAROM_NARROWPHASE_MANIFOLDS_HULL_SIDE_INL_H_
#else
#define CAROM_NARROWPHASE_MANIFOLDS_HULL_SIDE_INL_H_
#endif

#include <cmath>

#include "narrowphase/features/segment-inl.h"
#include "narrowphase/manifolds/facing_faces-inl.h"
#include "narrowphase/manifolds/polygon-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// `found` has at most kMost corners.
template <size_t kMost>
HWY_INLINE void hull_side(const Placed& placed, const FacingFaces& found,
                          FaceSide<PolygonFace<kMost>>& side) {
  const F3 n = found.normal(), u = any_perpendicular(n), v = cross(n, u);
  const F3 first = found.corner(0);
  PolygonFace<kMost>& face = side.face;
  for (size_t k = 0; k < kMost; ++k) {
    const F3 p = found.corner(k < found.most() ? k : 0), r = p - first;
    side.corners[k] = rotate(placed.turn, p) + placed.origin;
    face.x[k] = dot(u, r);
    face.y[k] = dot(v, r);
  }
  face.count = found.count();
  face.frame.origin = side.corners[0];
  face.frame.u = rotate(placed.turn, u);
  face.frame.v = rotate(placed.turn, v);
  face.frame.n = rotate(placed.turn, n);
  face.frame.height = splat(0);
  set_bounds(face);
}

// A triangle as a polygon. As in clip_to_extent(), only x has bounds.
template <size_t kMost>
HWY_INLINE void triangle_as_polygon(const FaceSide<TriangleFace>& triangle,
                                    FaceSide<PolygonFace<kMost>>& side) {
  PolygonFace<kMost>& face = side.face;
  face.frame = triangle.face.frame;
  for (size_t k = 0; k < kMost; ++k) {
    const size_t corner = k < 3 ? k : 0;
    side.corners[k] = triangle.corners[corner];
    face.x[k] = triangle.face.x[corner];
    face.y[k] = triangle.face.y[corner];
  }
  face.count = splat(3);
  face.lower_x = splat(0);
  face.upper_x = triangle.face.x[1];
  face.lower_y = splat(-HUGE_VALF);
  face.upper_y = splat(HUGE_VALF);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_MANIFOLDS_HULL_SIDE_INL_H_
