// The closest feature of two cores in lanes: the nearest vector that one to three corners span, and
// whether all points of both cores confirm it (closest_feature_scalar.h is the scalar form).
#if defined(CAROM_NARROWPHASE_HULLS_CLOSEST_FEATURE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_HULLS_CLOSEST_FEATURE_INL_H_
#undef CAROM_NARROWPHASE_HULLS_CLOSEST_FEATURE_INL_H_
#else
#define CAROM_NARROWPHASE_HULLS_CLOSEST_FEATURE_INL_H_
#endif

#include <array>

#include "base/tolerances.h"
#include "narrowphase/hulls/core_lanes-inl.h"
#include "narrowphase/hulls/simplex-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Support of a core along a direction: the greatest height, and the number of points that reach
// `height` up to kFacingSlack.
struct FacingCount {
  F most, count;

  HWY_INLINE Mask is_one() const { return hn::Lt(count, splat(1.5f)); }
  HWY_INLINE Mask is_two() const { return hn::Lt(count, splat(2.5f)); }
};

HWY_INLINE FacingCount count_facing(const CoreLanes& core, const F3& way, F height) {
  const F limit = hn::Sub(height, splat(kFacingSlack)), one = splat(1);
  FacingCount facing{splat(-FLT_MAX), splat(0)};
  for (size_t i = 0; i < core.count(); ++i) {
    const F h = dot(way, core.point(i));
    Mask is_facing = hn::Ge(h, limit);
    if (i >= core.least()) is_facing = hn::And(is_facing, core.has(i));
    facing.most = max(facing.most, h);
    facing.count = hn::Add(facing.count, hn::IfThenElseZero(is_facing, one));
  }
  return facing;
}

// Moves the used corners of a simplex to the front; the unused places behind them hold any corner.
struct FrontCorners {
  CornerLanes p, q, r;
  Mask has_two, has_three;

  HWY_INLINE F count() const {
    return hn::IfThenElse(has_three, splat(3), hn::IfThenElse(has_two, splat(2), splat(1)));
  }

  explicit HWY_INLINE FrontCorners(const SimplexLanes& simplex) {
    const std::array<Mask, 3> used = {has_bit(simplex.used, 0), has_bit(simplex.used, 1),
                                      has_bit(simplex.used, 2)};
    const auto& corner = simplex.corner;
    has_three = hn::And(hn::And(used[0], used[1]), used[2]);
    has_two = hn::AndNot(
        has_three, hn::Or(hn::And(used[0], used[1]), hn::And(hn::Or(used[0], used[1]), used[2])));
    p = select(used[0], corner[0], select(used[1], corner[1], corner[2]));
    q = select(hn::And(used[0], used[1]), corner[1], corner[2]);
    r = corner[2];
  }
};

// The closest points of two cores.
struct NearestCores {
  F distance;
  F3 normal;  // unit, from A to B
  F3 on_a;
  Mask is_sure;
};

// The vector from zero to the span of one to three corners of B - A. The places that a lane does
// not use may hold anything.
class SpannedWay {
 public:
  // Uses p always, q where has_two or has_three, r where has_three.
  HWY_INLINE SpannedWay(const CornerLanes& p, const CornerLanes& q, const CornerLanes& r,
                        Mask has_two, Mask has_three)
      : p_(p), has_three_(has_three), u_(q.point - p.point), v_(r.point - p.point) {
    // One corner: the nearest vector ends there.
    way_ = p.point;
    on_a_ = p.on_a;
    // Two corners: the vector is perpendicular to the side between them.
    const F uu = dot(u_, u_);
    const F along = hn::Div(hn::Neg(dot(p.point, u_)), uu);
    const F3 on_side = p.point + u_ * along;
    way_ = select(has_two, on_side - u_ * hn::Div(dot(on_side, u_), uu), way_);
    on_a_ = select(has_two, p.on_a + (q.on_a - p.on_a) * along, on_a_);
    // Three corners: the vector is perpendicular to their plane.
    const F3 n = cross(u_, v_);
    const F nn = dot(n, n);
    const F3 foot = n * hn::Div(dot(n, p.point), nn), along_plane = foot - p.point;
    const F of_q = hn::Div(dot(n, cross(along_plane, v_)), nn);
    const F of_r = hn::Div(dot(n, cross(u_, along_plane)), nn);
    way_ = select(has_three, foot, way_);
    on_a_ =
        select(has_three, (p.on_a + (q.on_a - p.on_a) * of_q) + (r.on_a - p.on_a) * of_r, on_a_);

    is_wide_ =
        hn::And(has_three, hn::Gt(nn, hn::Mul(splat(kSmallCrossing), hn::Mul(uu, dot(v_, v_)))));
    const F zero = splat(0), one = splat(1);
    const Mask is_in_side = hn::And(hn::Gt(along, zero), hn::Lt(along, one));
    const Mask is_in_triangle =
        hn::And(hn::Gt(min(of_q, of_r), zero), hn::Lt(hn::Add(of_q, of_r), one));
    ends_inside_ =
        hn::And(hn::Or(hn::Not(has_two), is_in_side), hn::Or(hn::Not(has_three), is_in_triangle));
    distance_ = hn::Sqrt(dot(way_, way_));
    normal_ = way_ * hn::Div(one, distance_);
  }

  HWY_INLINE F distance() const { return distance_; }
  HWY_INLINE const F3& normal() const { return normal_; }       // unit, from A to B
  HWY_INLINE Mask ends_inside() const { return ends_inside_; }  // of the span
  // Heights of the two points behind corner p: A's along the normal, B's against it.
  HWY_INLINE F height_of_a() const { return dot(normal_, p_.on_a); }
  HWY_INLINE F height_of_b() const { return hn::Neg(dot(normal_, on_b())); }

  // Compares the vector with the support of all points: `of_a` along the normal, `of_b` against it.
  // It is sure if no points of the cores are nearer and the witness points are unique.
  HWY_INLINE NearestCores confirmed_by(const FacingCount& of_a, const FacingCount& of_b) const {
    const F gap = hn::Neg(hn::Add(of_a.most, of_b.most));
    const Mask is_shortest = hn::Le(hn::Abs(hn::Sub(distance_, gap)), splat(kSameGapInFloat));
    // The witness points are unique if one core has a single facing point, or two edges cross.
    const Mask crosses = hn::And(is_wide_, hn::And(of_a.is_two(), of_b.is_two()));
    const Mask is_unique = hn::Or(hn::Or(of_a.is_one(), of_b.is_one()), crosses);
    F3 on_a = select(of_a.is_one(), p_.on_a, on_a_);
    on_a = select(of_b.is_one(), on_b() - normal_ * distance_, on_a);
    // Rounding tilts the plane of a needle; its corners then have different heights.
    const Mask is_tilted = hn::AndNot(hn::And(is_level(u_), is_level(v_)), has_three_);
    const Mask is_sure = hn::And(hn::Gt(distance_, splat(kNearCores)),
                                 hn::And(is_shortest, hn::AndNot(is_tilted, is_unique)));
    return {distance_, normal_, on_a, is_sure};
  }

 private:
  HWY_INLINE F3 on_b() const { return p_.point + p_.on_a; }
  HWY_INLINE Mask is_level(const F3& side) const {
    return hn::Le(hn::Abs(dot(normal_, side)), splat(kSameGapInFloat));
  }

  const CornerLanes p_;
  const Mask has_three_;
  const F3 u_, v_;
  F3 way_, on_a_, normal_;
  F distance_;
  Mask is_wide_, ends_inside_;
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_HULLS_CLOSEST_FEATURE_INL_H_
