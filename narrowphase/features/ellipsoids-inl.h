// The gap of two ellipsoids, in lanes, in the frame of A. ellipsoids_scalar.h is the scalar form,
// says how the search goes, and gives the same bits.
#if defined(CAROM_NARROWPHASE_FEATURES_ELLIPSOIDS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_FEATURES_ELLIPSOIDS_INL_H_
#undef CAROM_NARROWPHASE_FEATURES_ELLIPSOIDS_INL_H_
#else
#define CAROM_NARROWPHASE_FEATURES_ELLIPSOIDS_INL_H_
#endif

#include <array>

#include "narrowphase/features/ellipsoids_scalar.h"
#include "narrowphase/features/round_tolerances.h"
#include "narrowphase/features/start_directions-inl.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

struct EllipsoidContactLanes {
  F separation;
  F3 normal, on_a;
  Mask is_sure;
};

HWY_INLINE F3 componentwise(const F3& a, const F3& b) {
  return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)};
}

// As scalar::has_width().
HWY_INLINE Mask has_width(const F3& semi_axes) {
  const F least = min(min(semi_axes.x, semi_axes.y), semi_axes.z);
  const F most = max(max(semi_axes.x, semi_axes.y), semi_axes.z);
  return hn::Ge(least, hn::Mul(splat(scalar::kLeastWidth), most));
}

class EllipsoidPairLanes {
 public:
  // `rows_b`: x, y, z are rows.
  HWY_INLINE EllipsoidPairLanes(const F3& semi_axes_a, const std::array<F3, 3>& rows_b, const F3& t)
      : a_(semi_axes_a), b_(rows_b), t_(t) {}

  HWY_INLINE EllipsoidContactLanes find() const {
    Starts starts(*this);
    std::array<F3, kEllipsoidStarts> n;
    for (F3& start : n) start = starts.take_best(kEllipsoidsApart);
    // All together: one step waits for its own roots and quotients.
    for (size_t k = 0; k < kEllipsoidFirstSteps; ++k) {
      for (F3& way : n) step(way);
    }
    F3 best = {splat(0), splat(0), splat(1)};
    F most = splat(-FLT_MAX);
    for (const F3& way : n) {
      const F wide = gap(way);
      const Mask wider = hn::Gt(wide, most);
      most = hn::IfThenElse(wider, wide, most);
      best = select(wider, way, best);
    }
    Mask has_ended = no_lanes();
    for (size_t k = 0; k < kEllipsoidLastSteps; ++k) has_ended = step(best);
    const Reach reach(*this, best);
    const F separation = hn::Sub(dot(best, t_), hn::Add(reach.height_a, reach.height_b));
    const F3 aside = ((t_ - reach.on_a) - reach.on_b) - best * separation;
    const Mask is_facing = hn::Le(dot(aside, aside), splat(kBesideCore * kBesideCore));
    return {separation, best, reach.on_a, hn::And(has_ended, is_facing)};
  }

 private:
  HWY_INLINE F3 on_rows(const F3& n) const { return {dot(b_[0], n), dot(b_[1], n), dot(b_[2], n)}; }
  HWY_INLINE F3 on_axes(const F3& n) const { return componentwise(a_, n); }
  HWY_INLINE F gap(const F3& n) const {
    const F3 of_a = on_axes(n), of_b = on_rows(n);
    return hn::Sub(dot(n, t_), hn::Add(hn::Sqrt(dot(of_a, of_a)), hn::Sqrt(dot(of_b, of_b))));
  }

  struct Reach {
    F height_a, height_b, over_a, over_b;
    F3 on_a, on_b;

    HWY_INLINE Reach(const EllipsoidPairLanes& pair, const F3& n) {
      const F one = splat(1), least = splat(kLeastRim);
      const F3 of_a = pair.on_axes(n), of_b = pair.on_rows(n);
      height_a = hn::Sqrt(dot(of_a, of_a));
      height_b = hn::Sqrt(dot(of_b, of_b));
      over_a = hn::Div(one, max(height_a, least));
      over_b = hn::Div(one, max(height_b, least));
      on_a = pair.on_axes(of_a) * over_a;
      on_b = ((pair.b_[0] * of_b.x + pair.b_[1] * of_b.y) + pair.b_[2] * of_b.z) * over_b;
    }
  };

  class Starts : public StartDirections<16> {
   public:
    HWY_INLINE explicit Starts(const EllipsoidPairLanes& pair) {
      add(pair.t_, pair);
      for (const F3& row : pair.b_) add(row, pair);
      const F zero = splat(0), one = splat(1);
      add({one, zero, zero}, pair);
      add({zero, one, zero}, pair);
      add({zero, zero, one}, pair);
      for (const F3& row : pair.b_) {
        add({zero, hn::Neg(row.z), row.y}, pair);
        add({row.z, zero, hn::Neg(row.x)}, pair);
        add({hn::Neg(row.y), row.x, zero}, pair);
      }
    }

   private:
    HWY_INLINE void add(const F3& way, const EllipsoidPairLanes& pair) {
      StartDirections::add(way, dot(way, pair.t_), hn::Not(no_lanes()),
                           [&](const F3& n) HWY_ATTR { return pair.gap(n); });
    }
  };

  HWY_INLINE Mask step(F3& n) const {
    const F zero = splat(0), half_one = splat(0.5f), unit = splat(1);
    const Reach reach(*this, n);
    const F sign = hn::CopySign(unit, n.z);
    const F p = hn::Div(splat(-1), hn::Add(sign, n.z));
    const F q = hn::Mul(hn::Mul(n.x, n.y), p);
    const F3 across_one = {hn::Add(unit, hn::Mul(sign, hn::Mul(hn::Mul(n.x, n.x), p))),
                           hn::Mul(sign, q), hn::Neg(hn::Mul(sign, n.x))};
    const F3 across_two = {q, hn::Add(sign, hn::Mul(hn::Mul(n.y, n.y), p)), hn::Neg(n.y)};
    const F3 way = (t_ - reach.on_a) - reach.on_b;
    const F height = dot(way, n), slope_one = dot(way, across_one),
            slope_two = dot(way, across_two);
    const F3 a_one = on_axes(across_one), a_two = on_axes(across_two);
    const F3 b_one = on_rows(across_one), b_two = on_rows(across_two);
    const F on_a_one = dot(reach.on_a, across_one), on_a_two = dot(reach.on_a, across_two);
    const F on_b_one = dot(reach.on_b, across_one), on_b_two = dot(reach.on_b, across_two);
    const auto bend = [&](F of_a, F of_b) HWY_ATTR {
      return hn::Add(hn::Mul(of_a, reach.over_a), hn::Mul(of_b, reach.over_b));
    };
    const F bend_one = bend(hn::Sub(dot(a_one, a_one), hn::Mul(on_a_one, on_a_one)),
                            hn::Sub(dot(b_one, b_one), hn::Mul(on_b_one, on_b_one)));
    const F bend_both = bend(hn::Sub(dot(a_one, a_two), hn::Mul(on_a_one, on_a_two)),
                             hn::Sub(dot(b_one, b_two), hn::Mul(on_b_one, on_b_two)));
    const F bend_two = bend(hn::Sub(dot(a_two, a_two), hn::Mul(on_a_two, on_a_two)),
                            hn::Sub(dot(b_two, b_two), hn::Mul(on_b_two, on_b_two)));
    const F one = hn::Sub(hn::Neg(bend_one), height), two = hn::Sub(hn::Neg(bend_two), height);
    const F both = hn::Neg(bend_both);
    const F half = hn::Mul(hn::Sub(one, two), half_one),
            mean = hn::Mul(hn::Add(one, two), half_one);
    const F spread = hn::Sqrt(hn::Add(hn::Mul(half, half), hn::Mul(both, both)));
    const F greater = hn::Add(mean, spread);
    const F lower = hn::IfThenZeroElse(
        hn::Lt(greater, zero),
        hn::Add(hn::Add(greater, hn::Mul(splat(kSaddleShare), spread)), splat(kSaddle)));
    const F one_one = hn::Sub(one, lower), two_two = hn::Sub(two, lower);
    const F over = hn::Div(unit, hn::Sub(hn::Mul(one_one, two_two), hn::Mul(both, both)));
    const F by_one = hn::Mul(hn::Sub(hn::Mul(both, slope_two), hn::Mul(two_two, slope_one)), over);
    const F by_two = hn::Mul(hn::Sub(hn::Mul(both, slope_one), hn::Mul(one_one, slope_two)), over);
    const F length = hn::Sqrt(hn::Add(hn::Mul(by_one, by_one), hn::Mul(by_two, by_two)));
    const F share =
        hn::IfThenElse(hn::Gt(length, splat(kLongTurn)), hn::Div(splat(kLongTurn), length), unit);
    const F3 next = n + (across_one * hn::Mul(by_one, share) + across_two * hn::Mul(by_two, share));
    n = next * hn::Div(unit, hn::Sqrt(dot(next, next)));
    return hn::And(hn::Le(length, splat(kLastArc)), hn::Lt(greater, zero));
  }

  F3 a_;
  std::array<F3, 3> b_;
  F3 t_;
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_ELLIPSOIDS_INL_H_
