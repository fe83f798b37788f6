// Whether two oriented boxes overlap, in lanes: the same fifteen axes as in boxes_sat-inl.h, but
// only the sign of their gaps. So no axis needs the square of its length, or has to be the best.
#if defined(CAROM_NARROWPHASE_FEATURES_BOXES_DECISION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_FEATURES_BOXES_DECISION_INL_H_
#undef CAROM_NARROWPHASE_FEATURES_BOXES_DECISION_INL_H_
#else
#define CAROM_NARROWPHASE_FEATURES_BOXES_DECISION_INL_H_
#endif

#include "base/tolerances.h"
#include "narrowphase/features/boxes_sat-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// The greatest of some gaps, less what rounding may have added to each, and plus that.
struct GapBounds {
  F least, most;

  HWY_INLINE void offer(F gap, F rounding) {
    least = max(hn::Sub(gap, rounding), least);
    most = max(hn::Add(gap, rounding), most);
  }
};

// The gap along the cross product of axis kA of A and axis kB of B, times the length of that
// vector. Rounding in here has that length as a factor, too, of which the sum of the two components
// is a bound; that of the turn moves points of B by as much as that of other axes. This ends where
// products vanish, far below kLeastEdgeGap.
template <int kA, int kB>
HWY_INLINE void offer_edges(const BoxPairLanes& p, const Rotation& sizes, const Rotation& crosses,
                            GapBounds& gaps) {
  constexpr int k = (kA + 1) % 3;
  constexpr int l = (kA + 2) % 3;
  constexpr int m = (kB + 1) % 3;
  constexpr int n = (kB + 2) % 3;
  const F3& v = column<kB>(p.turn);
  const F size_k = component<k>(column<kB>(sizes));
  const F size_l = component<l>(column<kB>(sizes));
  const F distance = hn::Abs(hn::Sub(hn::Mul(component<l>(p.centre), component<k>(v)),
                                     hn::Mul(component<k>(p.centre), component<l>(v))));
  const F reach_a =
      hn::Add(hn::Mul(component<k>(p.half_a), size_l), hn::Mul(component<l>(p.half_a), size_k));
  // Axis n of B is perpendicular to axes kB and m, and so on.
  const F reach_b = hn::Add(hn::Mul(component<m>(p.half_b), component<kA>(column<n>(crosses))),
                            hn::Mul(component<n>(p.half_b), component<kA>(column<m>(crosses))));
  gaps.offer(hn::Sub(distance, hn::Add(reach_a, reach_b)),
             hn::Mul(hn::Add(size_k, size_l), splat(kNearTouchScaled)));
}

// Reports the sign of the separation, as test_boxes() does, and no more.
template <class Report>
HWY_INLINE void decide_boxes(const BoxPairLanes& p, Report& report) {
  report.template fetch<0>();
  const F near = splat(kNearTouchScaled);
  F face = max(max(gap_on_a<0>(p), gap_on_a<1>(p)), gap_on_a<2>(p));
  face = max(face, max(max(gap_on_b<0>(p), gap_on_b<1>(p)), gap_on_b<2>(p)));
  report.template fetch<1>();

  const Rotation sizes = {abs(p.turn.x), abs(p.turn.y), abs(p.turn.z)};
  // The cross product of two axes of B is the third up to rounding, but not in proportion.
  const Rotation crosses = {abs(cross(p.turn.y, p.turn.z)), abs(cross(p.turn.z, p.turn.x)),
                            abs(cross(p.turn.x, p.turn.y))};
  GapBounds edges{hn::Neg(near), hn::Neg(near)};
  offer_edges<0, 0>(p, sizes, crosses, edges);
  offer_edges<0, 1>(p, sizes, crosses, edges);
  offer_edges<0, 2>(p, sizes, crosses, edges);
  report.template fetch<2>();
  offer_edges<1, 0>(p, sizes, crosses, edges);
  offer_edges<1, 1>(p, sizes, crosses, edges);
  offer_edges<1, 2>(p, sizes, crosses, edges);
  report.template fetch<3>();
  offer_edges<2, 0>(p, sizes, crosses, edges);
  offer_edges<2, 1>(p, sizes, crosses, edges);
  offer_edges<2, 2>(p, sizes, crosses, edges);

  const Mask is_separate = hn::Or(hn::Gt(face, near), hn::Gt(edges.least, splat(kLeastEdgeGap)));
  const Mask overlaps = hn::And(hn::Lt(face, hn::Neg(near)), hn::Le(edges.most, splat(0)));
  report(overlaps, hn::Not(hn::Or(is_separate, overlaps)), no_lanes(),
         hn::IfThenElse(is_separate, near, hn::Neg(near)), p.centre, p.centre, p.centre);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_BOXES_DECISION_INL_H_
