// Two oriented boxes by the separating axis theorem, in lanes of floats or of doubles (V). Sources
// and reasons: boxes_sat_scalar.h.
#if defined(CAROM_NARROWPHASE_FEATURES_BOXES_SAT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_FEATURES_BOXES_SAT_INL_H_
#undef CAROM_NARROWPHASE_FEATURES_BOXES_SAT_INL_H_
#else
#define CAROM_NARROWPHASE_FEATURES_BOXES_SAT_INL_H_
#endif

#include "base/tolerances.h"
#include "simd/axis-inl.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Two boxes in the frame of A, with the origin at the centre of A.
template <class V>
struct BoxPairOf {
  Lanes3<V> centre;    // of B
  RotationOf<V> turn;  // of B
  Lanes3<V> half_a, half_b;
};
using BoxPairLanes = BoxPairOf<F>;

template <class V>
struct SeparatingAxisOf {
  V gap;             // the greatest; the separation of overlapping boxes
  Lanes3<V> normal;  // unit, from A to B
  // The normal is a cross product of these axes of A and B where `is_edge`.
  MaskOf<V> is_edge;
  AxisMasksOf<V> edge_a, edge_b;
};
using SeparatingAxisLanes = SeparatingAxisOf<F>;

template <int kAxis, class V>
HWY_INLINE V component(const Lanes3<V>& v) {
  if constexpr (kAxis == 0) return v.x;
  if constexpr (kAxis == 1) return v.y;
  if constexpr (kAxis == 2) return v.z;
}

template <int kAxis, class V>
HWY_INLINE const Lanes3<V>& column(const RotationOf<V>& r) {
  if constexpr (kAxis == 0) return r.x;
  if constexpr (kAxis == 1) return r.y;
  if constexpr (kAxis == 2) return r.z;
}

template <class V>
HWY_INLINE Lanes3<V> abs(const Lanes3<V>& v) {
  return {hn::Abs(v.x), hn::Abs(v.y), hn::Abs(v.z)};
}

template <class V>
HWY_INLINE RotationOf<V> transposed(const RotationOf<V>& r) {
  return {{r.x.x, r.y.x, r.z.x}, {r.x.y, r.y.y, r.z.y}, {r.x.z, r.y.z, r.z.z}};
}

template <class V>
HWY_INLINE Lanes3<V> select_axis(const AxisMasksOf<V>& axis, const RotationOf<V>& r) {
  return select(axis.x, r.x, select(axis.y, r.y, r.z));
}

template <class V>
HWY_INLINE AxisMasksOf<V> axis_number(V number) {
  return {hn::Eq(number, splat_as<V>(0)), hn::Eq(number, splat_as<V>(1)),
          hn::Eq(number, splat_as<V>(2))};
}

// Unit vector of the axis, cross v.
template <class V>
HWY_INLINE Lanes3<V> axis_cross(const AxisMasksOf<V>& axis, const Lanes3<V>& v) {
  const V zero = splat_as<V>(0);
  return select(
      axis.x, Lanes3<V>{zero, hn::Neg(v.z), v.y},
      select(axis.y, Lanes3<V>{v.z, zero, hn::Neg(v.x)}, Lanes3<V>{hn::Neg(v.y), v.x, zero}));
}

// The greatest gap along a face normal, and its number: 0 to 2 of A, 3 to 5 of B.
template <class V>
struct BestFaceOf {
  V gap;
  V number;

  template <int kNumber>
  HWY_INLINE void offer(V other) {
    const MaskOf<V> better = hn::Gt(other, gap);
    gap = hn::IfThenElse(better, other, gap);
    number = hn::IfThenElse(better, splat_as<V>(kNumber), number);
  }
};

template <int kAxis, class V>
HWY_INLINE V gap_on_a(const BoxPairOf<V>& p) {
  const Lanes3<V> row = {hn::Abs(component<kAxis>(p.turn.x)), hn::Abs(component<kAxis>(p.turn.y)),
                         hn::Abs(component<kAxis>(p.turn.z))};
  return hn::Sub(hn::Abs(component<kAxis>(p.centre)),
                 hn::Add(component<kAxis>(p.half_a), dot(row, p.half_b)));
}

template <int kAxis, class V>
HWY_INLINE V gap_on_b(const BoxPairOf<V>& p) {
  const Lanes3<V>& direction = column<kAxis>(p.turn);
  return hn::Sub(hn::Abs(dot(direction, p.centre)),
                 hn::Add(component<kAxis>(p.half_b), dot(abs(direction), p.half_a)));
}

template <class V>
HWY_INLINE BestFaceOf<V> best_face(const BoxPairOf<V>& p) {
  BestFaceOf<V> best{gap_on_a<0>(p), splat_as<V>(0)};
  best.template offer<1>(gap_on_a<1>(p));
  best.template offer<2>(gap_on_a<2>(p));
  best.template offer<3>(gap_on_b<0>(p));
  best.template offer<4>(gap_on_b<1>(p));
  best.template offer<5>(gap_on_b<2>(p));
  return best;
}

template <class V>
HWY_INLINE Lanes3<V> face_normal(const BoxPairOf<V>& p, V number) {
  const V zero = splat_as<V>(0);
  const V one = splat_as<V>(1);
  const auto is = [&](int k) HWY_ATTR {
    return hn::Eq(number, splat_as<V>(static_cast<hn::TFromV<V>>(k)));
  };
  const Lanes3<V> of_a = {hn::IfThenElse(is(0), one, zero), hn::IfThenElse(is(1), one, zero),
                          hn::IfThenElse(is(2), one, zero)};
  const Lanes3<V> of_b = select(is(3), p.turn.x, select(is(4), p.turn.y, p.turn.z));
  return select(hn::Lt(number, splat_as<V>(3)), of_a, of_b);
}

// The greatest gap along cross products of edges, as the square of the gap with its sign, over the
// squared length of the cross product. So no axis needs a division.
template <class V>
struct BestEdgesOf {
  V signed_square;
  V squared;
  V number;  // 3 * axis of A + axis of B
};
using BestEdges = BestEdgesOf<F>;

// Cross products of the axes of B.
template <class V>
struct AxisCrosses {
  Lanes3<V> xy, zx, yz;
};

template <int kA, int kB, class V>
HWY_INLINE void offer_edges(const BoxPairOf<V>& p, const AxisCrosses<V>& crosses,
                            BestEdgesOf<V>& best) {
  constexpr int k = (kA + 1) % 3;
  constexpr int l = (kA + 2) % 3;
  const Lanes3<V>& v = column<kB>(p.turn);
  const V vk = component<k>(v);
  const V vl = component<l>(v);
  const V squared = hn::Add(hn::Mul(vk, vk), hn::Mul(vl, vl));

  // Projections of the other two axes of B.
  const V on_m = hn::Abs(component<kA>(kB == 2 ? crosses.zx : crosses.xy));
  const V on_n = hn::Abs(component<kA>(kB == 0 ? crosses.zx : crosses.yz));
  const V half_m = kB == 0 ? p.half_b.y : p.half_b.x;
  const V half_n = kB == 2 ? p.half_b.y : p.half_b.z;

  const V distance =
      hn::Abs(hn::Sub(hn::Mul(component<l>(p.centre), vk), hn::Mul(component<k>(p.centre), vl)));
  const V reach_a = hn::Add(hn::Mul(component<k>(p.half_a), hn::Abs(vl)),
                            hn::Mul(component<l>(p.half_a), hn::Abs(vk)));
  const V reach_b = hn::Add(hn::Mul(half_m, on_m), hn::Mul(half_n, on_n));
  const V gap = hn::Sub(distance, hn::Add(reach_a, reach_b));

  const V square = hn::Mul(gap, hn::Abs(gap));
  const MaskOf<V> better =
      hn::And(hn::Ge(squared, splat_as<V>(kLeastCross<hn::TFromV<V>>)),
              hn::Gt(hn::Mul(square, best.squared), hn::Mul(best.signed_square, squared)));
  best.signed_square = hn::IfThenElse(better, square, best.signed_square);
  best.squared = hn::IfThenElse(better, squared, best.squared);
  best.number = hn::IfThenElse(better, splat_as<V>(3 * kA + kB), best.number);
}

template <class V>
HWY_INLINE BestEdgesOf<V> no_edges() {
  return {splat_as<V>(-1), splat_as<V>(0), splat_as<V>(0)};
}

template <class V>
HWY_INLINE BestEdgesOf<V> best_edges(const BoxPairOf<V>& p) {
  const AxisCrosses<V> crosses = {cross(p.turn.x, p.turn.y), cross(p.turn.z, p.turn.x),
                                  cross(p.turn.y, p.turn.z)};
  BestEdgesOf<V> best = no_edges<V>();
  offer_edges<0, 0>(p, crosses, best);
  offer_edges<0, 1>(p, crosses, best);
  offer_edges<0, 2>(p, crosses, best);
  offer_edges<1, 0>(p, crosses, best);
  offer_edges<1, 1>(p, crosses, best);
  offer_edges<1, 2>(p, crosses, best);
  offer_edges<2, 0>(p, crosses, best);
  offer_edges<2, 1>(p, crosses, best);
  offer_edges<2, 2>(p, crosses, best);
  return best;
}

// Minus infinity if no two edges have a common normal.
template <class V>
HWY_INLINE V edge_gap(const BestEdgesOf<V>& edges) {
  const V magnitude = hn::Sqrt(hn::Div(hn::Abs(edges.signed_square), edges.squared));
  return hn::IfThenElse(hn::Gt(edges.signed_square, splat_as<V>(0)), magnitude, hn::Neg(magnitude));
}

template <class V>
HWY_INLINE void choose_edges(V number, AxisMasksOf<V>& a, AxisMasksOf<V>& b) {
  const V three = splat_as<V>(3);
  const V first =
      hn::IfThenElse(hn::Ge(number, splat_as<V>(6)), splat_as<V>(2),
                     hn::IfThenElse(hn::Ge(number, three), splat_as<V>(1), splat_as<V>(0)));
  a = axis_number(first);
  b = axis_number(hn::Sub(number, hn::Mul(first, three)));
}

template <class V>
HWY_INLINE Lanes3<V> edge_normal(const BoxPairOf<V>& p, const BestEdgesOf<V>& edges,
                                 const AxisMasksOf<V>& a, const AxisMasksOf<V>& b) {
  return axis_cross(a, select_axis(b, p.turn)) * hn::Div(splat_as<V>(1), hn::Sqrt(edges.squared));
}

template <class V>
HWY_INLINE Lanes3<V> from_a_to_b(const BoxPairOf<V>& p, const Lanes3<V>& normal) {
  return negate_if(hn::Lt(dot(normal, p.centre), splat_as<V>(0)), normal);
}

template <class V>
HWY_INLINE SeparatingAxisOf<V> best_axis(const BoxPairOf<V>& p, const BestEdgesOf<V>& edges) {
  const BestFaceOf<V> face = best_face(p);
  const V crossed = edge_gap(edges);
  SeparatingAxisOf<V> axis;
  axis.is_edge = hn::Gt(crossed, face.gap);
  axis.gap = hn::IfThenElse(axis.is_edge, crossed, face.gap);
  choose_edges(edges.number, axis.edge_a, axis.edge_b);
  const Lanes3<V> normal = select(axis.is_edge, edge_normal(p, edges, axis.edge_a, axis.edge_b),
                                  face_normal(p, face.number));
  axis.normal = from_a_to_b(p, normal);
  return axis;
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_BOXES_SAT_INL_H_
