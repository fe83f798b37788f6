// The gap between the line of an edge and a cylinder along an arc of directions, an edge a lane.
// edge_arc_scalar.h is the scalar form and gives the same bits.
#if defined(CAROM_NARROWPHASE_FEATURES_EDGE_ARC_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_FEATURES_EDGE_ARC_INL_H_
#undef CAROM_NARROWPHASE_FEATURES_EDGE_ARC_INL_H_
#else
#define CAROM_NARROWPHASE_FEATURES_EDGE_ARC_INL_H_
#endif

#include <array>

#include "narrowphase/features/edge_arc_scalar.h"
#include "narrowphase/features/round_tolerances.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

HWY_INLINE F hypot_of(F a, F b) { return hn::Sqrt(hn::Add(hn::Mul(a, a), hn::Mul(b, b))); }

struct ArcPlaceLanes {
  F u, v;
};

HWY_INLINE ArcPlaceLanes select(Mask which, const ArcPlaceLanes& yes, const ArcPlaceLanes& no) {
  return {hn::IfThenElse(which, yes.u, no.u), hn::IfThenElse(which, yes.v, no.v)};
}
HWY_INLINE ArcPlaceLanes in_all_lanes(const scalar::ArcPlace& n) {
  return {splat(n.u), splat(n.v)};
}

HWY_INLINE ArcPlaceLanes unit(const ArcPlaceLanes& n) {
  const F squared = hn::Add(hn::Mul(n.u, n.u), hn::Mul(n.v, n.v));
  const F over = hn::Div(splat(1), hn::Sqrt(max(squared, splat(kLeastWay))));
  return {hn::Mul(n.u, over), hn::Mul(n.v, over)};
}

HWY_INLINE ArcPlaceLanes nearer_to_unit(const ArcPlaceLanes& n) {
  const F squared = hn::Add(hn::Mul(n.u, n.u), hn::Mul(n.v, n.v));
  const F by = hn::Sub(splat(1.5f), hn::Mul(splat(0.5f), squared));
  return {hn::Mul(n.u, by), hn::Mul(n.v, by)};
}

struct EdgeArcLanes {
  F u_way, v_way, along, u_axis, v_axis, half_length, rim;
  ArcPlaceLanes end;

  HWY_INLINE F along_axis(const ArcPlaceLanes& n) const {
    return hn::Add(hn::Mul(n.u, u_axis), hn::Mul(n.v, v_axis));
  }
  HWY_INLINE F aside(const ArcPlaceLanes& n) const {
    return hn::Sub(hn::Mul(n.u, v_axis), hn::Mul(n.v, u_axis));
  }
  HWY_INLINE F off_axis(const ArcPlaceLanes& n) const { return hypot_of(along, aside(n)); }
  HWY_INLINE F gap(const ArcPlaceLanes& n) const {
    const F height = hn::Add(hn::Mul(n.u, u_way), hn::Mul(n.v, v_way));
    const F reach =
        hn::Add(hn::Mul(half_length, hn::Abs(along_axis(n))), hn::Mul(rim, off_axis(n)));
    return hn::Sub(height, reach);
  }
  HWY_INLINE F before_end(const ArcPlaceLanes& n) const {
    return hn::Sub(hn::Mul(n.u, end.v), hn::Mul(n.v, end.u));
  }
  HWY_INLINE Mask holds(const ArcPlaceLanes& n) const {
    return hn::And(hn::Gt(n.v, splat(0)), hn::Gt(before_end(n), splat(0)));
  }
};

// Returns the most that the gap may be.
HWY_INLINE F bound_on_arc(const EdgeArcLanes& arc, const ArcPlaceLanes& middle, F& at_middle) {
  const F x = arc.along_axis(middle);
  const F bend = hn::Div(arc.rim, max(arc.off_axis(middle), splat(kLeastRim)));
  const F reach = hn::CopySign(arc.half_length, x);
  const F u = hn::Sub(hn::Sub(arc.u_way, hn::Mul(reach, arc.u_axis)),
                      hn::Mul(hn::Sub(middle.u, hn::Mul(x, arc.u_axis)), bend));
  const F v = hn::Sub(hn::Sub(arc.v_way, hn::Mul(reach, arc.v_axis)),
                      hn::Mul(hn::Sub(middle.v, hn::Mul(x, arc.v_axis)), bend));
  at_middle = hn::Add(hn::Mul(u, middle.u), hn::Mul(v, middle.v));
  const F at_end = hn::Add(hn::Mul(u, arc.end.u), hn::Mul(v, arc.end.v));
  const F behind_end = hn::Sub(hn::Mul(v, arc.end.u), hn::Mul(u, arc.end.v));
  const Mask has_peak = hn::And(hn::Gt(v, splat(0)), hn::Lt(behind_end, splat(0)));
  return hn::IfThenElse(has_peak, hypot_of(u, v), max(u, at_end));
}

struct ArcFoundLanes {
  F gap;
  ArcPlaceLanes n;
  Mask has_ended;

  HWY_INLINE F rank() const {
    return hn::Sub(gap, hn::IfThenZeroElse(has_ended, splat(kNotEnded)));
  }
};

class ArcStartsLanes {
 public:
  template <size_t kPlaces>
  HWY_INLINE ArcStartsLanes(const EdgeArcLanes& arc,
                            const std::array<ArcPlaceLanes, kPlaces>& places) {
    const F none = splat(-FLT_MAX), zero = splat(0), one = splat(1);
    const Mask all = hn::Not(no_lanes());
    front = back = {none, {one, zero}, no_lanes()};
    for (const ArcPlaceLanes& n : places) try_place(arc, n, all, all);
    const F sign = hn::CopySign(one, arc.v_axis);
    const ArcPlaceLanes nearest =
        unit(ArcPlaceLanes{hn::Mul(arc.u_axis, sign), hn::Mul(arc.v_axis, sign)});
    const Mask is_inside = arc.holds(nearest);
    try_place(arc, nearest, is_inside, is_inside);
    const Mask has_no_front = hn::Eq(front.gap, none), has_no_back = hn::Eq(back.gap, none);
    try_place(arc, {one, zero}, has_no_front, has_no_back);
    try_place(arc, arc.end, has_no_front, has_no_back);
  }

  ArcFoundLanes front, back;

 private:
  HWY_INLINE void try_place(const EdgeArcLanes& arc, const ArcPlaceLanes& n, Mask may_front,
                            Mask may_back) {
    const F x = arc.along_axis(n), wide = arc.gap(n), zero = splat(0);
    keep(hn::And(may_front, hn::Ge(x, zero)), wide, n, front);
    keep(hn::And(may_back, hn::Le(x, zero)), wide, n, back);
  }
  static HWY_INLINE void keep(Mask may, F wide, const ArcPlaceLanes& n, ArcFoundLanes& start) {
    const Mask wider = hn::And(may, hn::Gt(wide, start.gap));
    start.gap = hn::IfThenElse(wider, wide, start.gap);
    start.n = select(wider, n, start.n);
  }
};

HWY_INLINE Mask step_on_arc(const EdgeArcLanes& arc, F sign, ArcPlaceLanes& n) {
  const F zero = splat(0), one = splat(1);
  const F reach = hn::Mul(sign, arc.half_length);
  const F u_way = hn::Sub(arc.u_way, hn::Mul(reach, arc.u_axis));
  const F v_way = hn::Sub(arc.v_way, hn::Mul(reach, arc.v_axis));
  const F x = arc.along_axis(n), y = arc.aside(n);
  const F off = max(arc.off_axis(n), splat(kLeastRim));
  const F over = hn::Div(one, off);
  const F bend = hn::Mul(arc.rim, over), tilt = hn::Mul(hn::Mul(x, y), over);
  const F slope =
      hn::Add(hn::Sub(hn::Mul(n.u, v_way), hn::Mul(n.v, u_way)), hn::Mul(arc.rim, tilt));
  const F turned = hn::Add(hn::Sub(hn::Mul(y, y), hn::Mul(x, x)), hn::Mul(tilt, tilt));
  const F height = hn::Add(hn::Mul(n.u, u_way), hn::Mul(n.v, v_way));
  const F curve = hn::Sub(hn::Mul(bend, turned), height);
  const F step = hn::IfThenElse(hn::Lt(curve, zero), hn::Div(hn::Neg(slope), curve),
                                hn::CopySign(splat(kShortArc), slope));
  const F most = min(splat(kLongTurn), hn::Mul(splat(kRimStep), off));
  const F turn = clamp(step, hn::Neg(most), most);
  ArcPlaceLanes next =
      nearer_to_unit({hn::Sub(n.u, hn::Mul(n.v, turn)), hn::Add(n.v, hn::Mul(n.u, turn))});
  next = select(hn::Lt(next.v, zero), {one, zero}, next);
  next = select(hn::Lt(arc.before_end(next), zero), arc.end, next);
  const F moved = hn::Sub(hn::Mul(n.u, next.v), hn::Mul(n.v, next.u));
  n = next;
  return hn::Le(hn::Abs(moved), splat(kLastArc));
}

// A search on the side of one cap; `sign`: that of each lane.
struct ArcClimb {
  const EdgeArcLanes& arc;
  F sign;
  ArcFoundLanes& best;

  HWY_INLINE void step() const { best.has_ended = step_on_arc(arc, sign, best.n); }
  HWY_INLINE void end() const {
    best.n = nearer_to_unit(best.n);
    const F none = splat(-FLT_MAX);
    const Mask is_there = hn::And(hn::Gt(best.gap, none), arc.holds(best.n));
    best.gap = hn::IfThenElse(is_there, arc.gap(best.n), none);
  }
};

// Two searches at once: one alone would wait for its own roots and quotients.
HWY_INLINE void climb_arcs(const ArcClimb& one, const ArcClimb& other) {
  for (size_t i = 0; i < kSolidArcSteps; ++i) {
    one.step();
    other.step();
  }
  one.end();
  other.end();
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_EDGE_ARC_INL_H_
