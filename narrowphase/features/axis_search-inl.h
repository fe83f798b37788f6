// Separating axes of a box and another convex shape, in lanes. The box is centred at the origin,
// along the coordinate axes. Sources and reasons: axis_search_scalar.h.
#if defined(CAROM_NARROWPHASE_FEATURES_AXIS_SEARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_FEATURES_AXIS_SEARCH_INL_H_
#undef CAROM_NARROWPHASE_FEATURES_AXIS_SEARCH_INL_H_
#else
#define CAROM_NARROWPHASE_FEATURES_AXIS_SEARCH_INL_H_
#endif

#include "base/tolerances.h"
#include "simd/axis-inl.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// From the nearest coordinate of the box to x; zero if x is not beyond the box.
HWY_INLINE F beyond(F x, F half) { return hn::Sub(x, min(max(x, hn::Neg(half)), half)); }

HWY_INLINE F3 beyond(const F3& x, const F3& half) {
  return {beyond(x.x, half.x), beyond(x.y, half.y), beyond(x.z, half.z)};
}

// How far the box reaches along n from its centre.
HWY_INLINE F reach(const F3& half, const F3& n) {
  return dot(half, {hn::Abs(n.x), hn::Abs(n.y), hn::Abs(n.z)});
}

// Keeps the axis with the greatest gap; ties go to the first axis.
class AxisSearch {
 public:
  // Starts with the face normals of the box. The other shape reaches from `low` to `high`.
  HWY_INLINE AxisSearch(const F3& half, const F3& low, const F3& high) : half_(half) {
    const F3 above = low - half;
    const F3 below = -half - high;
    const F3 gap = max(above, below);
    const Mask3 negative = {hn::Lt(above.x, below.x), hn::Lt(above.y, below.y),
                            hn::Lt(above.z, below.z)};
    const AxisMasks axis = greatest_axis(gap);
    gap_ = pick(axis, gap);
    axis_ = signed_axis(axis, negative);
    squared_ = splat(1);
    key_ = key(gap_);
  }

  HWY_INLINE void try_axis(const F3& n, F squared, F radius, F low, F high) {
    const F above = hn::Sub(low, radius);
    const F below = hn::Sub(hn::Neg(radius), high);
    const F gap = max(above, below);
    const F next_key = key(gap);
    const Mask is_better = hn::And(hn::Gt(squared, splat(kParallelSquared)),
                                   hn::Gt(hn::Mul(next_key, squared_), hn::Mul(key_, squared)));
    axis_ = select(is_better, negate_if(hn::Lt(above, below), n), axis_);
    gap_ = hn::IfThenElse(is_better, gap, gap_);
    squared_ = hn::IfThenElse(is_better, squared, squared_);
    key_ = hn::IfThenElse(is_better, next_key, key_);
  }

  // Tries the cross products of `edge` and the edges of the box. `u` and `v`: as in the scalar
  // form.
  HWY_INLINE void try_crosses(const F3& edge, const F3& u, const F3& v) {
    const F3 along_u = cross(edge, u);
    const F3 along_v = cross(edge, v);
    const F3 low = min(along_u, along_v);
    const F3 high = max(along_u, along_v);
    const F3 squares = {hn::Mul(edge.x, edge.x), hn::Mul(edge.y, edge.y), hn::Mul(edge.z, edge.z)};
    const F3 size = {hn::Abs(edge.x), hn::Abs(edge.y), hn::Abs(edge.z)};
    const F zero = splat(0);
    try_axis({zero, hn::Neg(edge.z), edge.y}, hn::Add(squares.z, squares.y),
             hn::Add(hn::Mul(half_.y, size.z), hn::Mul(half_.z, size.y)), low.x, high.x);
    try_axis({edge.z, zero, hn::Neg(edge.x)}, hn::Add(squares.z, squares.x),
             hn::Add(hn::Mul(half_.x, size.z), hn::Mul(half_.z, size.x)), low.y, high.y);
    try_axis({hn::Neg(edge.y), edge.x, zero}, hn::Add(squares.y, squares.x),
             hn::Add(hn::Mul(half_.x, size.y), hn::Mul(half_.y, size.x)), low.z, high.z);
  }

  // The gap along the best axis, and that axis: unit, from the box to the other shape.
  HWY_INLINE void best(F& gap, F3& normal) const {
    const F to_unit = hn::Div(splat(1), hn::Sqrt(squared_));
    gap = hn::Mul(gap_, to_unit);
    normal = axis_ * to_unit;
  }

 private:
  static HWY_INLINE F key(F gap) { return hn::Mul(gap, hn::Abs(gap)); }

  F3 half_;
  F3 axis_;
  F squared_, gap_, key_;
};

// Chooses between the best axis (`gap` and `normal`) and the direction of `way`, the vector between
// the nearest points. `certain` is the gap along that direction. Writes the separation and the
// normal, and returns the unsure lanes.
HWY_INLINE Mask choose_normal(const F3& way, F certain, F gap, F3& normal, F& separation) {
  const F distance = hn::Sqrt(dot(way, way));
  const Mask overlap = hn::Le(gap, splat(0));
  const Mask agree = hn::Le(largest_component(way - normal * gap), splat(kSameWay));
  const Mask is_certain = hn::Ge(certain, hn::Sub(distance, splat(kCertain)));
  const Mask by_axis = hn::Or(overlap, agree);
  separation = hn::IfThenElse(overlap, gap, max(distance, gap));
  normal = select(hn::AndNot(by_axis, is_certain), way * hn::Div(splat(1), distance), normal);
  return hn::Not(hn::Or(by_axis, is_certain));
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_AXIS_SEARCH_INL_H_
