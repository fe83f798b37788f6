// Two oriented boxes by the separating axis theorem, in lanes. Sources and reasons:
// boxes_sat_scalar.h.
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
struct BoxPairLanes {
  F3 centre;      // of B
  Rotation turn;  // of B
  F3 half_a, half_b;
};

struct SeparatingAxisLanes {
  F gap;      // the greatest; the separation of overlapping boxes
  F3 normal;  // unit, from A to B
  // The normal is a cross product of these axes of A and B where `is_edge`.
  Mask is_edge;
  AxisMasks edge_a, edge_b;
};

template <int kAxis>
HWY_INLINE F component(const F3& v) {
  if constexpr (kAxis == 0) return v.x;
  if constexpr (kAxis == 1) return v.y;
  if constexpr (kAxis == 2) return v.z;
}

template <int kAxis>
HWY_INLINE const F3& column(const Rotation& r) {
  if constexpr (kAxis == 0) return r.x;
  if constexpr (kAxis == 1) return r.y;
  if constexpr (kAxis == 2) return r.z;
}

HWY_INLINE F3 abs(const F3& v) { return {hn::Abs(v.x), hn::Abs(v.y), hn::Abs(v.z)}; }

HWY_INLINE Rotation transposed(const Rotation& r) {
  return {{r.x.x, r.y.x, r.z.x}, {r.x.y, r.y.y, r.z.y}, {r.x.z, r.y.z, r.z.z}};
}

HWY_INLINE F3 select_axis(const AxisMasks& axis, const Rotation& r) {
  return select(axis.x, r.x, select(axis.y, r.y, r.z));
}

HWY_INLINE AxisMasks axis_number(F number) {
  return {hn::Eq(number, splat(0)), hn::Eq(number, splat(1)), hn::Eq(number, splat(2))};
}

// Unit vector of the axis, cross v.
HWY_INLINE F3 axis_cross(const AxisMasks& axis, const F3& v) {
  const F zero = splat(0);
  return select(axis.x, F3{zero, hn::Neg(v.z), v.y},
                select(axis.y, F3{v.z, zero, hn::Neg(v.x)}, F3{hn::Neg(v.y), v.x, zero}));
}

// The greatest gap along a face normal, and its number: 0 to 2 of A, 3 to 5 of B.
struct BestFace {
  F gap;
  F number;

  template <int kNumber>
  HWY_INLINE void offer(F other) {
    const Mask better = hn::Gt(other, gap);
    gap = hn::IfThenElse(better, other, gap);
    number = hn::IfThenElse(better, splat(kNumber), number);
  }
};

template <int kAxis>
HWY_INLINE F gap_on_a(const BoxPairLanes& p) {
  const F3 row = {hn::Abs(component<kAxis>(p.turn.x)), hn::Abs(component<kAxis>(p.turn.y)),
                  hn::Abs(component<kAxis>(p.turn.z))};
  return hn::Sub(hn::Abs(component<kAxis>(p.centre)),
                 hn::Add(component<kAxis>(p.half_a), dot(row, p.half_b)));
}

template <int kAxis>
HWY_INLINE F gap_on_b(const BoxPairLanes& p) {
  const F3& direction = column<kAxis>(p.turn);
  return hn::Sub(hn::Abs(dot(direction, p.centre)),
                 hn::Add(component<kAxis>(p.half_b), dot(abs(direction), p.half_a)));
}

HWY_INLINE BestFace best_face(const BoxPairLanes& p) {
  BestFace best{gap_on_a<0>(p), splat(0)};
  best.offer<1>(gap_on_a<1>(p));
  best.offer<2>(gap_on_a<2>(p));
  best.offer<3>(gap_on_b<0>(p));
  best.offer<4>(gap_on_b<1>(p));
  best.offer<5>(gap_on_b<2>(p));
  return best;
}

HWY_INLINE F3 face_normal(const BoxPairLanes& p, F number) {
  const F zero = splat(0);
  const F one = splat(1);
  const auto is = [&](float k) HWY_ATTR { return hn::Eq(number, splat(k)); };
  const F3 of_a = {hn::IfThenElse(is(0), one, zero), hn::IfThenElse(is(1), one, zero),
                   hn::IfThenElse(is(2), one, zero)};
  const F3 of_b = select(is(3), p.turn.x, select(is(4), p.turn.y, p.turn.z));
  return select(hn::Lt(number, splat(3)), of_a, of_b);
}

// The greatest gap along cross products of edges, as the square of the gap with its sign, over the
// squared length of the cross product. So no axis needs a division.
struct BestEdges {
  F signed_square;
  F squared;
  F number;  // 3 * axis of A + axis of B
};

// Cross products of the axes of B.
struct AxisCrosses {
  F3 xy, zx, yz;
};

template <int kA, int kB>
HWY_INLINE void offer_edges(const BoxPairLanes& p, const AxisCrosses& crosses, BestEdges& best) {
  constexpr int k = (kA + 1) % 3;
  constexpr int l = (kA + 2) % 3;
  const F3& v = column<kB>(p.turn);
  const F vk = component<k>(v);
  const F vl = component<l>(v);
  const F squared = hn::Add(hn::Mul(vk, vk), hn::Mul(vl, vl));

  // Projections of the other two axes of B.
  const F on_m = hn::Abs(component<kA>(kB == 2 ? crosses.zx : crosses.xy));
  const F on_n = hn::Abs(component<kA>(kB == 0 ? crosses.zx : crosses.yz));
  const F half_m = kB == 0 ? p.half_b.y : p.half_b.x;
  const F half_n = kB == 2 ? p.half_b.y : p.half_b.z;

  const F distance =
      hn::Abs(hn::Sub(hn::Mul(component<l>(p.centre), vk), hn::Mul(component<k>(p.centre), vl)));
  const F reach_a = hn::Add(hn::Mul(component<k>(p.half_a), hn::Abs(vl)),
                            hn::Mul(component<l>(p.half_a), hn::Abs(vk)));
  const F reach_b = hn::Add(hn::Mul(half_m, on_m), hn::Mul(half_n, on_n));
  const F gap = hn::Sub(distance, hn::Add(reach_a, reach_b));

  const F square = hn::Mul(gap, hn::Abs(gap));
  const Mask better =
      hn::And(hn::Ge(squared, splat(kLeastCross<float>)),
              hn::Gt(hn::Mul(square, best.squared), hn::Mul(best.signed_square, squared)));
  best.signed_square = hn::IfThenElse(better, square, best.signed_square);
  best.squared = hn::IfThenElse(better, squared, best.squared);
  best.number = hn::IfThenElse(better, splat(3 * kA + kB), best.number);
}

HWY_INLINE BestEdges no_edges() { return {splat(-1), splat(0), splat(0)}; }

HWY_INLINE BestEdges best_edges(const BoxPairLanes& p) {
  const AxisCrosses crosses = {cross(p.turn.x, p.turn.y), cross(p.turn.z, p.turn.x),
                               cross(p.turn.y, p.turn.z)};
  BestEdges best = no_edges();
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
HWY_INLINE F edge_gap(const BestEdges& edges) {
  const F magnitude = hn::Sqrt(hn::Div(hn::Abs(edges.signed_square), edges.squared));
  return hn::IfThenElse(hn::Gt(edges.signed_square, splat(0)), magnitude, hn::Neg(magnitude));
}

HWY_INLINE void choose_edges(F number, AxisMasks& a, AxisMasks& b) {
  const F first = hn::IfThenElse(hn::Ge(number, splat(6)), splat(2),
                                 hn::IfThenElse(hn::Ge(number, splat(3)), splat(1), splat(0)));
  a = axis_number(first);
  b = axis_number(hn::Sub(number, hn::Mul(first, splat(3))));
}

HWY_INLINE F3 edge_normal(const BoxPairLanes& p, const BestEdges& edges, const AxisMasks& a,
                          const AxisMasks& b) {
  return axis_cross(a, select_axis(b, p.turn)) * hn::Div(splat(1), hn::Sqrt(edges.squared));
}

HWY_INLINE F3 from_a_to_b(const BoxPairLanes& p, const F3& normal) {
  return negate_if(hn::Lt(dot(normal, p.centre), splat(0)), normal);
}

HWY_INLINE SeparatingAxisLanes best_axis(const BoxPairLanes& p, const BestEdges& edges) {
  const BestFace face = best_face(p);
  const F crossed = edge_gap(edges);
  SeparatingAxisLanes axis;
  axis.is_edge = hn::Gt(crossed, face.gap);
  axis.gap = hn::IfThenElse(axis.is_edge, crossed, face.gap);
  choose_edges(edges.number, axis.edge_a, axis.edge_b);
  const F3 normal = select(axis.is_edge, edge_normal(p, edges, axis.edge_a, axis.edge_b),
                           face_normal(p, face.number));
  axis.normal = from_a_to_b(p, normal);
  return axis;
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_BOXES_SAT_INL_H_
