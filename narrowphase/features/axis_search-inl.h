// Separating axes of a box and another convex shape, in lanes. The box is centred at the origin,
// along the coordinate axes. Sources and reasons: axis_search_scalar.h.
#if defined(CAROM_NARROWPHASE_FEATURES_AXIS_SEARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_FEATURES_AXIS_SEARCH_INL_H_
#undef CAROM_NARROWPHASE_FEATURES_AXIS_SEARCH_INL_H_
#else
#define CAROM_NARROWPHASE_FEATURES_AXIS_SEARCH_INL_H_
#endif

#include <type_traits>

#include "base/tolerances.h"
#include "simd/axis-inl.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// From the nearest coordinate of the box to x; zero if x is not beyond the box.
template <class V>
HWY_INLINE V beyond(V x, V half) {
  return hn::Sub(x, min(max(x, hn::Neg(half)), half));
}

template <class V>
HWY_INLINE Lanes3<V> beyond(const Lanes3<V>& x, const Lanes3<V>& half) {
  return {beyond(x.x, half.x), beyond(x.y, half.y), beyond(x.z, half.z)};
}

// How far the box reaches along n from its centre.
template <class V>
HWY_INLINE V reach(const Lanes3<V>& half, const Lanes3<V>& n) {
  return dot(half, Lanes3<V>{hn::Abs(n.x), hn::Abs(n.y), hn::Abs(n.z)});
}

// Keeps the axis with the greatest gap; ties go to the first axis.
template <class V>
class AxisSearchOf {
 public:
  // Starts with the face normals of the box. The other shape reaches from `low` to `high`.
  HWY_INLINE AxisSearchOf(const Lanes3<V>& half, const Lanes3<V>& low, const Lanes3<V>& high)
      : half_(half) {
    const Lanes3<V> above = low - half;
    const Lanes3<V> below = -half - high;
    const Lanes3<V> gap = max(above, below);
    const Mask3Of<V> negative = {hn::Lt(above.x, below.x), hn::Lt(above.y, below.y),
                                 hn::Lt(above.z, below.z)};
    const AxisMasksOf<V> axis = greatest_axis(gap);
    gap_ = pick(axis, gap);
    axis_ = signed_axis(axis, negative);
    squared_ = splat_as<V>(1);
    key_ = key(gap_);
  }

  HWY_INLINE void try_axis(const Lanes3<V>& n, V squared, V radius, V low, V high) {
    const V above = hn::Sub(low, radius);
    const V below = hn::Sub(hn::Neg(radius), high);
    const V gap = max(above, below);
    const V next_key = key(gap);
    const MaskOf<V> is_better =
        hn::And(hn::Gt(squared, splat_as<V>(kParallelSquared)),
                hn::Gt(hn::Mul(next_key, squared_), hn::Mul(key_, squared)));
    axis_ = select(is_better, negate_if(hn::Lt(above, below), n), axis_);
    gap_ = hn::IfThenElse(is_better, gap, gap_);
    squared_ = hn::IfThenElse(is_better, squared, squared_);
    key_ = hn::IfThenElse(is_better, next_key, key_);
  }

  // Tries the cross products of `edge` and the edges of the box. `u` and `v`: as in the scalar
  // form.
  HWY_INLINE void try_crosses(const Lanes3<V>& edge, const Lanes3<V>& u, const Lanes3<V>& v) {
    const Lanes3<V> along_u = cross(edge, u);
    const Lanes3<V> along_v = cross(edge, v);
    const Lanes3<V> low = min(along_u, along_v);
    const Lanes3<V> high = max(along_u, along_v);
    const Lanes3<V> squares = {hn::Mul(edge.x, edge.x), hn::Mul(edge.y, edge.y),
                               hn::Mul(edge.z, edge.z)};
    const Lanes3<V> size = {hn::Abs(edge.x), hn::Abs(edge.y), hn::Abs(edge.z)};
    const V zero = splat_as<V>(0);
    try_axis({zero, hn::Neg(edge.z), edge.y}, hn::Add(squares.z, squares.y),
             hn::Add(hn::Mul(half_.y, size.z), hn::Mul(half_.z, size.y)), low.x, high.x);
    try_axis({edge.z, zero, hn::Neg(edge.x)}, hn::Add(squares.z, squares.x),
             hn::Add(hn::Mul(half_.x, size.z), hn::Mul(half_.z, size.x)), low.y, high.y);
    try_axis({hn::Neg(edge.y), edge.x, zero}, hn::Add(squares.y, squares.x),
             hn::Add(hn::Mul(half_.x, size.y), hn::Mul(half_.y, size.x)), low.z, high.z);
  }

  // The gap along the best axis, and that axis: unit, from the box to the other shape.
  HWY_INLINE void best(V& gap, Lanes3<V>& normal) const {
    const V to_unit = hn::Div(splat_as<V>(1), hn::Sqrt(squared_));
    gap = hn::Mul(gap_, to_unit);
    normal = axis_ * to_unit;
  }

 private:
  static HWY_INLINE V key(V gap) { return hn::Mul(gap, hn::Abs(gap)); }

  Lanes3<V> half_;
  Lanes3<V> axis_;
  V squared_, gap_, key_;
};

using AxisSearch = AxisSearchOf<F>;

// Chooses between the best axis (`gap` and `normal`) and the direction of `way`, the vector between
// the nearest points. `certain` is the gap along that direction. Writes the separation and the
// normal, and returns the unsure lanes.
template <class V>
HWY_INLINE MaskOf<V> choose_normal(const Lanes3<V>& way, V certain, V gap, Lanes3<V>& normal,
                                   V& separation) {
  using T = hn::TFromV<V>;
  constexpr bool kIsFloat = std::is_same_v<T, float>;
  constexpr T kSame = kIsFloat ? T(kSameWay) : T(kSameWayDouble);
  constexpr T kLoss = kIsFloat ? T(kCertain) : T(kCertainDouble);
  const V distance = hn::Sqrt(dot(way, way));
  const MaskOf<V> overlap = hn::Le(gap, splat_as<V>(0));
  const MaskOf<V> agree = hn::Le(largest_component(way - normal * gap), splat_as<V>(kSame));
  const MaskOf<V> is_certain = hn::Ge(certain, hn::Sub(distance, splat_as<V>(kLoss)));
  const MaskOf<V> by_axis = hn::Or(overlap, agree);
  separation = hn::IfThenElse(overlap, gap, max(distance, gap));
  normal = select(hn::AndNot(by_axis, is_certain), way * hn::Div(splat_as<V>(1), distance), normal);
  return hn::Not(hn::Or(by_axis, is_certain));
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_AXIS_SEARCH_INL_H_
