// The gap of two cylinders, or of a segment and a cylinder, in lanes. cylinders_scalar.h is the
// scalar form, says how the search goes, and gives the same bits.
#if defined(CAROM_NARROWPHASE_FEATURES_CYLINDERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_FEATURES_CYLINDERS_INL_H_
#undef CAROM_NARROWPHASE_FEATURES_CYLINDERS_INL_H_
#else
#define CAROM_NARROWPHASE_FEATURES_CYLINDERS_INL_H_
#endif

#include <array>

#include "base/tolerances.h"
#include "narrowphase/features/axial_core-inl.h"
#include "narrowphase/features/edge_arc-inl.h"
#include "narrowphase/features/round_tolerances.h"
#include "narrowphase/features/segment-inl.h"
#include "narrowphase/features/start_directions-inl.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

struct CylinderContactLanes {
  F separation;
  F3 normal, on_a;
  Mask is_sure;
  Mask is_proven;  // that cores overlap which do
};

HWY_INLINE F sign_of(F v) { return hn::CopySign(splat(1), v); }
HWY_INLINE F unit_factor(F squared) { return hn::Div(splat(1), hn::Sqrt(squared)); }

class CylinderPairLanes {
 public:
  HWY_INLINE CylinderPairLanes(const AxialCoreLanes& a, const AxialCoreLanes& b, const F3& t)
      : half_a_(a.half_length), rim_a_(a.rim), half_b_(b.half_length), rim_b_(b.rim), x_(a.axis) {
    const F zero = splat(0);
    const F along = dot(a.axis, b.axis);
    const F3 b_axis = select(hn::Lt(along, zero), -b.axis, b.axis);
    const F3 across = cross(a.axis, b_axis);
    cosine_ = hn::Abs(along);
    sine_ = hn::Sqrt(dot(across, across));
    const F3 up = across_axes(a.axis, across, t);
    y_ = cross(up, a.axis);
    const F height = dot(up, t);
    z_ = select(hn::Lt(height, zero), -up, up);
    t_ = {dot(a.axis, t), dot(y_, t), hn::Abs(height)};
  }

  struct Found {
    F gap;
    F3 n;
    Mask is_flat_a, is_flat_b, has_ended;
  };

  HWY_INLINE F sine() const { return sine_; }
  HWY_INLINE F3 in_world(const F3& n) const { return (x_ * n.x + y_ * n.y) + z_ * n.z; }
  HWY_INLINE F crossing() const { return hn::Sub(t_.x, hn::Mul(cosine_, hn::Div(t_.y, sine_))); }

  HWY_INLINE Found find() const {
    const Mask none = no_lanes(), all = hn::Not(none);
    const F zero = splat(0);
    Found best = {splat(-FLT_MAX), {zero, zero, splat(1)}, none, none, none};
    try_caps(best);
    keep_if_wider(hn::Sub(t_.z, hn::Add(rim_a_, rim_b_)), {zero, zero, splat(1)}, all, all, all,
                  best);
    try_sides(best);
    try_rims(best);
    return best;
  }

 private:
  HWY_INLINE F3 across_axes(const F3& axis, const F3& across, const F3& t) const {
    F3 way = across * hn::Div(splat(1), sine_);
    const Mask is_parallel = hn::Not(hn::Ge(sine_, splat(kParallelAxes)));
    if (HWY_UNLIKELY(!hn::AllFalse(FloatTag(), is_parallel))) {
      const F3 aside = part_across(t, axis, dot(t, axis));
      const F squared = dot(aside, aside);
      const F3 towards = select(hn::Gt(squared, splat(kLeastWay)), aside * unit_factor(squared),
                                any_perpendicular(axis));
      way = select(is_parallel, towards, way);
    }
    way = way - axis * dot(axis, way);
    return way * unit_factor(dot(way, way));
  }

  static HWY_INLINE F rank(F gap, Mask has_ended) {
    return hn::Sub(gap, hn::IfThenZeroElse(has_ended, splat(kNotEnded)));
  }
  static HWY_INLINE void keep_if_wider(F gap, const F3& n, Mask is_flat_a, Mask is_flat_b,
                                       Mask has_ended, Found& best) {
    const Mask wider = hn::Gt(rank(gap, has_ended), rank(best.gap, best.has_ended));
    best.gap = hn::IfThenElse(wider, gap, best.gap);
    best.n = select(wider, n, best.n);
    best.is_flat_a = hn::Or(hn::And(wider, is_flat_a), hn::AndNot(wider, best.is_flat_a));
    best.is_flat_b = hn::Or(hn::And(wider, is_flat_b), hn::AndNot(wider, best.is_flat_b));
    best.has_ended = hn::Or(hn::And(wider, has_ended), hn::AndNot(wider, best.has_ended));
  }

  HWY_INLINE F along_b(const F3& n) const {
    return hn::Add(hn::Mul(cosine_, n.x), hn::Mul(sine_, n.y));
  }
  HWY_INLINE F across_b(const F3& n) const {
    return hn::Sub(hn::Mul(cosine_, n.y), hn::Mul(sine_, n.x));
  }

  HWY_INLINE F gap(const F3& n) const {
    const F along = along_b(n), across = across_b(n);
    const F square = hn::Mul(n.z, n.z);
    const F off_a = hn::Sqrt(hn::Add(hn::Mul(n.y, n.y), square));
    const F off_b = hn::Sqrt(hn::Add(hn::Mul(across, across), square));
    const F reach_a = hn::Add(hn::Mul(half_a_, hn::Abs(n.x)), hn::Mul(rim_a_, off_a));
    const F reach_b = hn::Add(hn::Mul(half_b_, hn::Abs(along)), hn::Mul(rim_b_, off_b));
    return hn::Sub(dot(n, t_), hn::Add(reach_a, reach_b));
  }

  HWY_INLINE void try_caps(Found& best) const {
    const Mask none = no_lanes(), all = hn::Not(none);
    const F zero = splat(0);
    const F3 cap_a = {sign_of(t_.x), zero, zero};
    keep_if_wider(gap(cap_a), cap_a, all, none, all, best);
    const F sign_b = sign_of(along_b(t_));
    const F3 cap_b = {hn::Mul(sign_b, cosine_), hn::Mul(sign_b, sine_), zero};
    keep_if_wider(gap(cap_b), cap_b, none, all, all, best);
  }

  struct Arc {
    F c, s;
    Mask has_ended;
  };

  HWY_INLINE Arc best_of_arc(F a, F b, F rim, size_t first, size_t last) const {
    const F zero = splat(0), one = splat(1);
    const F flat = hn::Mul(cosine_, cosine_), rise = hn::Mul(rim, hn::Mul(sine_, sine_));
    Arc arc = {one, zero, no_lanes()};
    F most = splat(-FLT_MAX);
    for (size_t i = first; i < last; ++i) {
      const F c = splat(kArcCosines[i]), s = splat(kArcCosines[kArcSamples - 1 - i]);
      const F w = hn::Sqrt(hn::Add(hn::Mul(s, s), hn::Mul(flat, hn::Mul(c, c))));
      const F gap = hn::Sub(hn::Add(hn::Mul(a, c), hn::Mul(b, s)), hn::Mul(rim, w));
      const Mask wider = hn::Gt(gap, most);
      most = hn::IfThenElse(wider, gap, most);
      arc.c = hn::IfThenElse(wider, c, arc.c);
      arc.s = hn::IfThenElse(wider, s, arc.s);
    }
    for (size_t i = 0; i < kArcSteps; ++i) {
      const F c = arc.c, s = arc.s;
      const F cc = hn::Mul(c, c), ss = hn::Mul(s, s), sc = hn::Mul(s, c);
      const F w = hn::Sqrt(hn::Add(ss, hn::Mul(flat, cc)));
      const F over_w = hn::Div(one, max(w, splat(kLeastRim)));
      const F bend = hn::Mul(rise, over_w);
      const F slope = hn::Sub(hn::Sub(hn::Mul(b, c), hn::Mul(a, s)), hn::Mul(bend, sc));
      const F tilt = hn::Mul(sc, hn::Mul(sine_, over_w));
      const F curve = hn::Sub(hn::Neg(hn::Add(hn::Mul(a, c), hn::Mul(b, s))),
                              hn::Mul(bend, hn::Sub(hn::Sub(cc, ss), hn::Mul(tilt, tilt))));
      const F step = hn::IfThenElse(hn::Lt(curve, zero), hn::Div(hn::Neg(slope), curve),
                                    hn::CopySign(splat(kShortArc), slope));
      const F turn = clamp(step, splat(-kLongArc), splat(kLongArc));
      const F c2 = max(hn::Sub(c, hn::Mul(turn, s)), zero);
      const F s2 = max(hn::Add(s, hn::Mul(turn, c)), zero);
      const F to_unit = unit_factor(hn::Add(hn::Mul(c2, c2), hn::Mul(s2, s2)));
      arc.c = hn::Mul(c2, to_unit);
      arc.s = hn::Mul(s2, to_unit);
      const F moved = hn::Sub(hn::Mul(c, arc.s), hn::Mul(s, arc.c));
      arc.has_ended = hn::Le(hn::Abs(moved), splat(kLastArc));
    }
    return arc;
  }

  HWY_INLINE void try_sides(Found& best) const {
    const Mask none = no_lanes(), all = hn::Not(none);
    const F across = across_b(t_);
    const F beside_a = hn::Sub(hn::Abs(t_.y), hn::Mul(half_b_, sine_));
    const F beside_b = hn::Sub(hn::Abs(across), hn::Mul(half_a_, sine_));
    for (const size_t first : {size_t{0}, kArcSamples / 2}) {
      const size_t last = first + kArcSamples / 2 + 1;
      const Arc of_a = best_of_arc(beside_a, t_.z, rim_b_, first, last);
      const F3 n = {splat(0), hn::CopySign(of_a.c, t_.y), of_a.s};
      keep_if_wider(gap(n), n, all, none, of_a.has_ended, best);
      const Arc of_b = best_of_arc(beside_b, t_.z, rim_a_, first, last);
      const F c = hn::CopySign(of_b.c, across);
      const F3 m = {hn::Neg(hn::Mul(sine_, c)), hn::Mul(cosine_, c), of_b.s};
      keep_if_wider(gap(m), m, none, all, of_b.has_ended, best);
    }
  }

  HWY_INLINE F3 between_caps(F sign_a, F sign_b) const {
    const F b = hn::Mul(sign_b, half_b_);
    return {hn::Sub(hn::Sub(t_.x, hn::Mul(sign_a, half_a_)), hn::Mul(b, cosine_)),
            hn::Sub(t_.y, hn::Mul(b, sine_)), t_.z};
  }

  class Starts : public StartDirections<19> {
   public:
    HWY_INLINE explicit Starts(const CylinderPairLanes& pair) {
      for (const float sign_a : {1.0f, -1.0f}) {
        for (const float sign_b : {1.0f, -1.0f}) add_between(splat(sign_a), splat(sign_b), pair);
      }
      add_cap_of_a(pair);
      add_cap_of_b(pair);
      add_crossing_rims(pair);
    }

   private:
    HWY_INLINE void add(const F3& way, Mask may, const CylinderPairLanes& pair) {
      StartDirections::add(way, splat(1), may, [&](const F3& n) HWY_ATTR { return pair.gap(n); });
    }

    HWY_INLINE void add_between(F sign_a, F sign_b, const CylinderPairLanes& pair) {
      const F zero = splat(0);
      const Mask may = hn::Not(no_lanes());
      const F3 way = pair.between_caps(sign_a, sign_b);
      const F3 q = way * unit_factor(max(dot(way, way), splat(kLeastWay)));
      const F3 a = {sign_a, zero, zero};
      const F3 b = {hn::Mul(sign_b, pair.cosine_), hn::Mul(sign_b, pair.sine_), zero};
      const F3 all = (q + a) + b;
      add(q, may, pair);
      add(all, may, pair);
      add(all + a, may, pair);
      add(all + b, may, pair);
    }

    HWY_INLINE void add_cap_of_a(const CylinderPairLanes& pair) {
      const F cosine = pair.cosine_, sine = pair.sine_;
      const F3& t = pair.t_;
      const F sign = sign_of(t.x);
      const F half = hn::Mul(sign, pair.half_b_), rim = hn::Mul(sign, pair.rim_b_);
      const F3 p = {hn::Sub(hn::Sub(t.x, hn::Mul(half, cosine)), hn::Mul(rim, sine)),
                    hn::Add(hn::Sub(t.y, hn::Mul(half, sine)), hn::Mul(rim, cosine)), t.z};
      const F above = hn::Sub(hn::Mul(sign, p.x), pair.half_a_);
      const F from_axis = hypot_of(p.y, p.z);
      const F share = hn::Div(hn::Sub(from_axis, pair.rim_a_), max(from_axis, splat(kLeastRim)));
      add({hn::Mul(sign, above), hn::Mul(p.y, share), hn::Mul(p.z, share)},
          hn::Gt(min(above, share), splat(0)), pair);
    }

    HWY_INLINE void add_cap_of_b(const CylinderPairLanes& pair) {
      const F cosine = pair.cosine_, sine = pair.sine_;
      const F3& t = pair.t_;
      const F sign = sign_of(pair.along_b(t));
      const F3 w = {hn::Sub(t.x, hn::Mul(sign, pair.half_a_)),
                    hn::Sub(t.y, hn::Mul(sign, pair.rim_a_)), t.z};
      const F above = hn::Sub(hn::Mul(sign, pair.along_b(w)), pair.half_b_);
      const F across = pair.across_b(w);
      const F from_axis = hypot_of(across, w.z);
      const F share = hn::Div(hn::Sub(from_axis, pair.rim_b_), max(from_axis, splat(kLeastRim)));
      const F along = hn::Mul(sign, above), beside = hn::Mul(across, share);
      add({hn::Sub(hn::Mul(cosine, along), hn::Mul(sine, beside)),
           hn::Add(hn::Mul(sine, along), hn::Mul(cosine, beside)), hn::Mul(w.z, share)},
          hn::Gt(min(above, share), splat(0)), pair);
    }

    HWY_INLINE void add_crossing_rims(const CylinderPairLanes& pair) {
      const F zero = splat(0), one = splat(1);
      const F sign = sign_of(pair.t_.x);
      const F tilt = hn::Mul(sign, pair.sine_);
      const F c_y = hn::Sub(pair.t_.y, hn::Mul(pair.half_b_, tilt)), c_z = pair.t_.z;
      const F squared = max(hn::Add(hn::Mul(c_y, c_y), hn::Mul(c_z, c_z)), splat(kLeastWay));
      const F between =
          hn::Mul(hn::Sub(pair.rim_a_, pair.rim_b_), hn::Add(pair.rim_a_, pair.rim_b_));
      const F share = hn::Mul(splat(0.5f), hn::Add(one, hn::Div(between, squared)));
      const F aside =
          hn::Sub(hn::Div(hn::Mul(pair.rim_a_, pair.rim_a_), squared), hn::Mul(share, share));
      const F half = hn::Sqrt(max(aside, splat(kLeastWay)));
      const F p_y = hn::Add(hn::Mul(share, c_y), hn::Mul(sign, hn::Mul(half, c_z)));
      const F p_z = hn::Sub(hn::Mul(share, c_z), hn::Mul(sign, hn::Mul(half, c_y)));
      const F length = hn::Div(hn::Mul(pair.sine_, hn::Sub(c_z, p_z)), hn::Mul(half, squared));
      const Mask may = hn::And(hn::And(hn::Lt(pair.sine_, splat(kNearAxes)), hn::Gt(aside, zero)),
                               hn::And(hn::Gt(p_z, zero), hn::Lt(p_z, c_z)));
      add({sign, hn::Mul(length, p_y), hn::Mul(length, p_z)}, may, pair);
    }
  };

  HWY_INLINE void try_rims(Found& best) const {
    Starts starts(*this);
    F most = splat(-FLT_MAX);
    F3 n_of_best = {splat(0), splat(0), splat(1)}, q_of_best = splat3(0);
    std::array<F3, kRimStarts> n, q;
    for (size_t i = 0; i < kRimStarts; ++i) {
      n[i] = starts.take_best(kRimApart);
      q[i] = between_caps(sign_of(n[i].x), sign_of(along_b(n[i])));
    }
    // All together: one step waits for its own roots and quotients.
    for (size_t k = 0; k < kRimFirstSteps; ++k) {
      for (size_t i = 0; i < kRimStarts; ++i) step(q[i], n[i]);
    }
    for (size_t i = 0; i < kRimStarts; ++i) {
      const F wide = gap(n[i]);
      const Mask wider = hn::Gt(wide, most);
      most = hn::IfThenElse(wider, wide, most);
      n_of_best = select(wider, n[i], n_of_best);
      q_of_best = select(wider, q[i], q_of_best);
    }
    Mask has_ended = no_lanes();
    for (size_t k = 0; k < kRimLastSteps; ++k) has_ended = step(q_of_best, n_of_best);
    keep_if_wider(gap(n_of_best), n_of_best, no_lanes(), no_lanes(), has_ended, best);
  }

  HWY_INLINE Mask step(const F3& q, F3& n) const {
    const F zero = splat(0), one_lane = splat(1);
    const F along = along_b(n), across = across_b(n);
    const F square = hn::Mul(n.z, n.z);
    const F off_a = max(hn::Sqrt(hn::Add(hn::Mul(n.y, n.y), square)), splat(kLeastRim));
    const F off_b = max(hn::Sqrt(hn::Add(hn::Mul(across, across), square)), splat(kLeastRim));
    const F over_a = hn::Div(one_lane, off_a), over_b = hn::Div(one_lane, off_b);
    const F3 b_axis = {cosine_, sine_, zero};
    const F3 first = {zero, hn::Neg(hn::Mul(n.z, over_a)), hn::Mul(n.y, over_a)};
    const F3 second = cross(n, first);
    const F3 side = cross(b_axis, n) * over_b;
    const F c = dot(side, first), s = dot(side, second);
    const F3 out_a = {zero, hn::Mul(n.y, over_a), hn::Mul(n.z, over_a)};
    const F3 out_b = (n - b_axis * along) * over_b;
    const F3 way = (q - out_a * rim_a_) - out_b * rim_b_;
    const F height = dot(way, n), slope_one = dot(way, first), slope_two = dot(way, second);
    const F bend_a = hn::Mul(rim_a_, over_a), bend_b = hn::Mul(rim_b_, over_b);
    const F one = hn::Sub(hn::Neg(hn::Add(bend_a, hn::Mul(bend_b, hn::Mul(c, c)))), height);
    const F two = hn::Sub(hn::Neg(hn::Mul(bend_b, hn::Mul(s, s))), height);
    const F both = hn::Neg(hn::Mul(bend_b, hn::Mul(c, s)));
    const F half = hn::Mul(hn::Sub(one, two), splat(0.5f));
    const F mean = hn::Mul(hn::Add(one, two), splat(0.5f));
    const F spread = hypot_of(half, both);
    const F greater = hn::Add(mean, spread);
    const F lower = hn::IfThenZeroElse(
        hn::Lt(greater, zero),
        hn::Add(hn::Add(greater, hn::Mul(splat(kSaddleShare), spread)), splat(kSaddle)));
    const F one_one = hn::Sub(one, lower), two_two = hn::Sub(two, lower);
    const F over = hn::Div(one_lane, hn::Sub(hn::Mul(one_one, two_two), hn::Mul(both, both)));
    const F by_one = hn::Mul(hn::Sub(hn::Mul(both, slope_two), hn::Mul(two_two, slope_one)), over);
    const F by_two = hn::Mul(hn::Sub(hn::Mul(both, slope_one), hn::Mul(one_one, slope_two)), over);
    const F length = hypot_of(by_one, by_two);
    const F most = hn::Mul(splat(kRimStep), min(off_a, off_b));
    const F share = hn::IfThenElse(hn::Gt(length, most), hn::Div(most, length), one_lane);
    F3 next = n + (first * hn::Mul(by_one, share) + second * hn::Mul(by_two, share));
    next.z = max(next.z, zero);
    n = next * unit_factor(dot(next, next));
    return hn::Le(length, splat(kLastArc));
  }

  F half_a_, rim_a_, half_b_, rim_b_;
  F3 x_, y_, z_, t_;
  F cosine_, sine_;
};

// Not inlined: two kinds of pairs call it, and it is long.
inline HWY_NOINLINE CylinderContactLanes cylinder_contact(const AxialCoreLanes& a,
                                                          const AxialCoreLanes& b, const F3& t) {
  const CylinderPairLanes pair(a, b, t);
  const CylinderPairLanes::Found found = pair.find();
  const F3 way = pair.in_world(found.n);
  const F3 n = way * unit_factor(dot(way, way));
  const F3 from_a = furthest_point(a, n), from_b = t - furthest_point(b, n);
  const F separation = hn::Sub(dot(n, t), hn::Add(reach(a, n), reach(b, n)));
  const F3 crossing = a.axis * pair.crossing() + n * a.rim;
  const F3 flat = select(found.is_flat_b, crossing, from_b - n * separation);
  F3 on_a = select(found.is_flat_a, flat, from_a);
  const Mask are_parallel = hn::Lt(pair.sine(), splat(kCrossingLines));
  if (!hn::AllFalse(FloatTag(), are_parallel)) {
    const SpreadLanes spread_a(a, n), spread_b(b, n);
    const F middle = middle_of_both(a.half_length, dot(a.axis, t), b.half_length);
    on_a = select(hn::And(are_parallel, hn::And(spread_a.is_line, spread_b.is_line)),
                  a.axis * middle + n * a.rim, on_a);
    on_a = select(hn::And(are_parallel, hn::And(spread_a.is_disc, spread_b.is_disc)),
                  between_discs(a, b, n, t), on_a);
  }
  const F3 on_b = (on_a + n * separation) - t;
  const Mask is_sure = hn::And(found.has_ended, hn::And(holds(a, on_a), holds(b, on_b)));
  const F3 common = on_a + n * hn::Mul(separation, splat(0.5f));
  const Mask is_common = hn::And(holds(a, common, -kSureGap), holds(b, common - t, -kSureGap));
  return {separation, n, on_a, is_sure, hn::Or(is_common, hn::Gt(separation, splat(0)))};
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_CYLINDERS_INL_H_
