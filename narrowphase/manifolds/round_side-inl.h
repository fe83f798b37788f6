// The sides that cylinders and cones turn towards another shape, in lanes (round_side_scalar.h is
// the scalar form), and those of boxes and triangles as polygons with as many corners.
#if defined(CAROM_NARROWPHASE_MANIFOLDS_ROUND_SIDE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_MANIFOLDS_ROUND_SIDE_INL_H_
#undef CAROM_NARROWPHASE_MANIFOLDS_ROUND_SIDE_INL_H_
#else
#define CAROM_NARROWPHASE_MANIFOLDS_ROUND_SIDE_INL_H_
#endif

#include "narrowphase/manifolds/polygon-inl.h"
#include "narrowphase/scalar/rim.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

using scalar::kRimCorners;
using RimSide = FaceSide<PolygonFace<kRimCorners>>;

// Writes a face as a polygon of which the corners after the last repeat the first. `Face`:
// Rectangle or TriangleFace.
template <class Face>
HWY_INLINE void polygon_side(const Face& of, RimSide& side) {
  FaceFrame& frame = side.face.frame;
  frame = of.frame;
  frame.origin = of.frame.origin + of.frame.n * of.frame.height;
  frame.height = splat(0);
  for (size_t k = 0; k < kRimCorners; ++k) {
    const size_t corner = k < Face::kCorners ? k : 0;
    side.face.x[k] = of.corner_x(corner);
    side.face.y[k] = of.corner_y(corner);
    side.corners[k] = frame.point(side.face.x[k], side.face.y[k]);
  }
  side.face.count = splat(Face::kCorners);
  set_bounds(side.face);
}

// A cylinder or a cone shows a disc across z, or a line.
struct RimView {
  Mask is_disc;
  F height;  // of the disc
  F side;    // the sign of the disc's normal
  F3 line[2];
};

// The unit vector across z towards `along`; x if there is none.
HWY_INLINE F3 across_z(const F3& along) {
  const F squared = hn::Add(hn::Mul(along.x, along.x), hn::Mul(along.y, along.y));
  const F inverse = hn::Div(splat(1), hn::Sqrt(squared));
  const F zero = splat(0);
  const F3 out = {hn::Mul(along.x, inverse), hn::Mul(along.y, inverse), zero};
  return select(hn::Gt(squared, zero), out, F3{splat(1), zero, zero});
}

HWY_INLINE RimView view_of(const CylinderLanes& cylinder, const F3& along) {
  const F zero = splat(0);
  const F square = hn::Mul(along.z, along.z);
  const F side = hn::IfThenElse(hn::Lt(along.z, zero), splat(-1), splat(1));
  const F3 out = across_z(along) * cylinder.radius, end = {zero, zero, cylinder.half_length};
  return {hn::Ge(hn::Add(square, square), dot(along, along)),
          hn::Mul(side, cylinder.half_length),
          side,
          {out - end, out + end}};
}

HWY_INLINE RimView view_of(const ConeLanes& cone, const F3& along) {
  const F zero = splat(0), half = cone.half_length, twice = hn::Add(half, half);
  const F3 out = across_z(along), tip = {zero, zero, half};
  const F slope =
      hn::Sqrt(hn::Add(hn::Mul(splat(4), hn::Mul(half, half)), hn::Mul(cone.radius, cone.radius)));
  const F to_side = hn::Add(hn::Mul(twice, dot(out, along)), hn::Mul(cone.radius, along.z));
  return {hn::Ge(hn::Mul(hn::Neg(along.z), slope), to_side),
          hn::Neg(half),
          splat(-1),
          {out * cone.radius - tip, tip}};
}

// The corners of a rim, of which the one nearest to the deepest point is moved onto it.
class RimCornersLanes {
 public:
  // The arguments lead to the deepest point, in the plane of the disc.
  HWY_INLINE RimCornersLanes(F deep_x, F deep_y) {
    const F squared = hn::Add(hn::Mul(deep_x, deep_x), hn::Mul(deep_y, deep_y));
    const F inverse = hn::Div(splat(1), hn::Sqrt(squared));
    deepest_x_ = hn::Mul(deep_x, inverse);
    deepest_y_ = hn::Mul(deep_y, inverse);
    const auto depth = [&](size_t k) HWY_ATTR {
      return hn::Add(hn::Mul(cosine(k), deep_x), hn::Mul(sine(k), deep_y));
    };
    F most = depth(0), place = splat(0);
    for (size_t k = 1; k < kRimCorners; ++k) {
      const F own = depth(k);
      const Mask is_deeper = hn::Gt(own, most);
      most = hn::IfThenElse(is_deeper, own, most);
      place = hn::IfThenElse(is_deeper, splat(static_cast<float>(k)), place);
    }
    place_ = hn::IfThenElse(hn::Gt(squared, splat(0)), place, splat(-1));
  }

  // On the unit circle.
  HWY_INLINE void corner(size_t k, F& x, F& y) const {
    const Mask is_deepest = hn::Eq(place_, splat(static_cast<float>(k)));
    x = hn::IfThenElse(is_deepest, deepest_x_, cosine(k));
    y = hn::IfThenElse(is_deepest, deepest_y_, sine(k));
  }

 private:
  static HWY_INLINE F cosine(size_t k) { return splat(static_cast<float>(scalar::rim_cosine(k))); }
  static HWY_INLINE F sine(size_t k) { return splat(static_cast<float>(scalar::rim_sine(k))); }

  F deepest_x_, deepest_y_, place_;
};

// Returns the lanes that show a disc. A line counts as three corners, of which the last is the
// first again; the axes of its frame are zero.
template <class Round>
HWY_INLINE Mask rim_side(const F3& m, const Round& shape, const Placed& placed, RimSide& out) {
  const F zero = splat(0);
  const F3 along = rotate_back(placed.turn, m);
  const RimView view = view_of(shape, along);
  const F3 line[2] = {rotate(placed.turn, view.line[0]) + placed.origin,
                      rotate(placed.turn, view.line[1]) + placed.origin};
  const RimCornersLanes rim(hn::Mul(along.x, shape.radius),
                            hn::Mul(view.side, hn::Mul(along.y, shape.radius)));
  for (size_t k = 0; k < kRimCorners; ++k) {
    F x, y;
    rim.corner(k, x, y);
    x = hn::Mul(x, shape.radius);
    y = hn::Mul(y, shape.radius);
    const F3 corner = {x, hn::Mul(view.side, y), view.height};
    out.corners[k] =
        select(view.is_disc, rotate(placed.turn, corner) + placed.origin, line[k == 1 ? 1 : 0]);
    out.face.x[k] = hn::IfThenElseZero(view.is_disc, x);
    out.face.y[k] = hn::IfThenElseZero(view.is_disc, y);
  }
  const Rotation& turn = placed.turn;
  FaceFrame& frame = out.face.frame;
  const F3 middle = rotate(turn, F3{zero, zero, view.height}) + placed.origin;
  frame.origin = select(view.is_disc, middle, line[0]);
  frame.u = zero_unless(view.is_disc, turn.x);
  frame.v = zero_unless(view.is_disc, turn.y * view.side);
  frame.n = zero_unless(view.is_disc, turn.z * view.side);
  frame.height = zero;
  out.face.count = hn::IfThenElse(view.is_disc, splat(kRimCorners), splat(3));
  set_bounds(out.face);
  return view.is_disc;
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_MANIFOLDS_ROUND_SIDE_INL_H_
