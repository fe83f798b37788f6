// The facing faces of boxes and triangles, in lanes.
#if defined(CAROM_NARROWPHASE_MANIFOLDS_POLYGON_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_MANIFOLDS_POLYGON_INL_H_
#undef CAROM_NARROWPHASE_MANIFOLDS_POLYGON_INL_H_
#else
#define CAROM_NARROWPHASE_MANIFOLDS_POLYGON_INL_H_
#endif

#include <type_traits>

#include "base/tolerances.h"
#include "narrowphase/batch/shape_lanes-inl.h"
#include "simd/axis-inl.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// The pose of a body, relative to the position of A.
struct Placed {
  Rotation turn;
  F3 origin;
};

// A plane with coordinates.
struct FaceFrame {
  F3 origin, u, v, n;  // u, v, n: unit vectors, perpendicular
  F height;            // of the plane along n

  HWY_INLINE F3 point(F x, F y) const { return ((origin + n * height) + u * x) + v * y; }
};

// The face of a box.
struct Rectangle {
  static constexpr size_t kCorners = 4;
  FaceFrame frame;
  F lower_x, lower_y, upper_x, upper_y;

  HWY_INLINE F corner_x(size_t i) const { return i == 1 || i == 2 ? upper_x : lower_x; }
  HWY_INLINE F corner_y(size_t i) const { return i >= 2 ? upper_y : lower_y; }
  static HWY_INLINE Mask where(size_t, Mask mask) { return mask; }
};

// A triangle with its longest edge along x. Without area all its numbers are zero.
struct TriangleFace {
  static constexpr size_t kCorners = 3;
  FaceFrame frame;
  F x[3], y[3];  // counter-clockwise

  HWY_INLINE F corner_x(size_t i) const { return x[i]; }
  HWY_INLINE F corner_y(size_t i) const { return y[i]; }
  static HWY_INLINE Mask where(size_t, Mask mask) { return mask; }
};

// A face with `count` corners, at least three. The places after the last corner repeat the first,
// so that it follows the last.
template <size_t kMost>
struct PolygonFace {
  static constexpr size_t kCorners = kMost;
  FaceFrame frame;
  F x[kMost], y[kMost];  // counter-clockwise
  F count;
  // Edges are clipped to these bounds too.
  F lower_x, lower_y, upper_x, upper_y;

  HWY_INLINE F corner_x(size_t i) const { return x[i]; }
  HWY_INLINE F corner_y(size_t i) const { return y[i]; }
  // The lanes of `mask` that have a corner i.
  HWY_INLINE Mask where(size_t i, Mask mask) const {
    if (i < 3) return mask;
    return hn::And(mask, hn::Gt(count, splat(static_cast<float>(i))));
  }
};

// The bounds of the corners.
template <size_t kMost>
HWY_INLINE void set_bounds(PolygonFace<kMost>& face) {
  face.lower_x = face.upper_x = face.x[0];
  face.lower_y = face.upper_y = face.y[0];
  for (size_t k = 1; k < kMost; ++k) {
    face.lower_x = min(face.lower_x, face.x[k]);
    face.lower_y = min(face.lower_y, face.y[k]);
    face.upper_x = max(face.upper_x, face.x[k]);
    face.upper_y = max(face.upper_y, face.y[k]);
  }
}

// A face, and its corners relative to the position of A.
template <class Face>
struct FaceSide {
  Face face;
  F3 corners[Face::kCorners];
};

template <class Shape>
concept AnyBox = std::is_same_v<Shape, AabbLanes> || std::is_same_v<Shape, BoxLanes>;

HWY_INLINE F3 pick(const AxisMasks& axis, const F3& x, const F3& y, const F3& z) {
  return select(axis.x, x, select(axis.y, y, z));
}

// The axis after `axis`, in cyclic order.
HWY_INLINE AxisMasks next(const AxisMasks& axis) { return {axis.z, axis.x, axis.y}; }

HWY_INLINE void pick_bounds(const AxisMasks& axis, const AabbLanes& box, F& lower, F& upper) {
  lower = pick(axis, box.lower);
  upper = pick(axis, box.upper);
}
HWY_INLINE void pick_bounds(const AxisMasks& axis, const BoxLanes& box, F& lower, F& upper) {
  upper = pick(axis, box.half);
  lower = hn::Neg(upper);
}

// The face whose normal is nearest to m; on a tie the face of the first axis.
template <AnyBox Box>
HWY_INLINE void face_towards(const F3& m, const Box& box, const Placed& placed, Rectangle& face) {
  const Rotation& turn = placed.turn;
  const F3 along = rotate_back(turn, m);
  const AxisMasks n = greatest_axis(F3{hn::Abs(along.x), hn::Abs(along.y), hn::Abs(along.z)});
  const AxisMasks u = next(n);
  const AxisMasks v = next(u);
  face.frame.origin = placed.origin;
  face.frame.u = pick(u, turn.x, turn.y, turn.z);
  face.frame.v = pick(v, turn.x, turn.y, turn.z);
  face.frame.n = pick(n, turn.x, turn.y, turn.z);
  F lower, upper;
  pick_bounds(n, box, lower, upper);
  face.frame.height = hn::IfThenElse(hn::Gt(pick(n, along), splat(0)), upper, lower);
  pick_bounds(u, box, face.lower_x, face.upper_x);
  pick_bounds(v, box, face.lower_y, face.upper_y);
}

HWY_INLINE void corners_of(const TriangleLanes& triangle, const Placed& placed, F3 (&corners)[3]) {
  corners[0] = rotate(placed.turn, triangle.a) + placed.origin;
  corners[1] = rotate(placed.turn, triangle.b) + placed.origin;
  corners[2] = rotate(placed.turn, triangle.c) + placed.origin;
}

// The axes start from the longest edge. The normal of a sliver is uncertain only by a tilt about
// that edge, which moves no point far.
HWY_INLINE void triangle_face(const F3 (&corners)[3], TriangleFace& face) {
  const F3 edge_a = corners[1] - corners[0];
  const F3 edge_b = corners[2] - corners[1];
  const F3 edge_c = corners[0] - corners[2];
  const F3 squares = {dot(edge_a, edge_a), dot(edge_b, edge_b), dot(edge_c, edge_c)};
  const AxisMasks first = greatest_axis(squares);
  const F3 along = pick(first, edge_a, edge_b, edge_c);
  const F3 back = pick(first, edge_c, edge_a, edge_b);
  const F squared_length = pick(first, squares);
  const F3 raw = cross(back, along);
  // Any part along the longest edge is rounding.
  const F3 across = raw - along * hn::Div(dot(raw, along), squared_length);
  const F squared = dot(across, across);
  const Mask has_area =
      hn::Gt(squared, hn::Mul(splat(kSliver), hn::Mul(squared_length, squared_length)));
  const F one = splat(1);
  FaceFrame& frame = face.frame;
  frame.origin = pick(first, corners[0], corners[1], corners[2]);
  frame.height = splat(0);
  frame.n = zero_unless(has_area, across * hn::Div(one, hn::Sqrt(squared)));
  frame.u = zero_unless(has_area, along * hn::Div(one, hn::Sqrt(squared_length)));
  frame.v = cross(frame.n, frame.u);
  face.x[0] = face.y[0] = face.y[1] = splat(0);
  face.x[1] = dot(frame.u, along);
  face.x[2] = hn::Neg(dot(frame.u, back));
  face.y[2] = hn::Neg(dot(frame.v, back));
}

HWY_INLINE void triangle_side(const TriangleLanes& triangle, const Placed& placed,
                              FaceSide<TriangleFace>& side) {
  corners_of(triangle, placed, side.corners);
  triangle_face(side.corners, side.face);
}

// Special triangles have a face on their front side only. `toward` leads to the other shape.
HWY_INLINE Mask shows_face(const TriangleLanes& triangle, const F3& normal, const F3& toward) {
  return hn::Or(hn::Not(triangle.is_special), hn::Gt(dot(normal, toward), splat(kFront)));
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_MANIFOLDS_POLYGON_INL_H_
