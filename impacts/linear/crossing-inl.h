// Times at which points that move along lines come within reach of balls, edges and faces, one pair
// per lane (crossing_scalar.h is the scalar form and has the sources).
#if defined(CAROM_IMPACTS_LINEAR_CROSSING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_IMPACTS_LINEAR_CROSSING_INL_H_
#undef CAROM_IMPACTS_LINEAR_CROSSING_INL_H_
#else
#define CAROM_IMPACTS_LINEAR_CROSSING_INL_H_
#endif

#include "impacts/slack.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

HWY_INLINE D zero() { return hn::Zero(DoubleTag()); }
HWY_INLINE D never() { return hn::Inf(DoubleTag()); }

HWY_INLINE D inverse_or_zero(D x) {
  return hn::IfThenElseZero(hn::Gt(x, zero()), hn::Div(splat_double(1), x));
}

HWY_INLINE D first_time(D entry, D exit, DoubleMask meets) {
  const D t = max(entry, zero());
  const DoubleMask in_time = hn::And(hn::Ge(exit, zero()), hn::Le(t, splat_double(1)));
  return hn::IfThenElse(hn::And(meets, in_time), t, never());
}

struct MovingPoint {
  D3 from, way;
  D inverse;
};

HWY_INLINE MovingPoint moving_point(const D3& from, const D3& way) {
  return {from, way, inverse_or_zero(dot(way, way))};
}

HWY_INLINE MovingPoint seen_from(const MovingPoint& point, const D3& place) {
  return {point.from - place, point.way, point.inverse};
}

struct Crossing {
  D entry, exit;
  DoubleMask meets;

  HWY_INLINE Crossing(const MovingPoint& point, D reach) {
    const D nearest = hn::Mul(hn::Neg(dot(point.from, point.way)), point.inverse);
    const D3 across = point.from + point.way * nearest;
    const D under = hn::Sub(hn::Mul(reach, reach), dot(across, across));
    const D half = hn::IfThenElse(hn::Gt(point.inverse, zero()),
                                  hn::Sqrt(hn::Mul(max(under, zero()), point.inverse)), never());
    entry = hn::Sub(nearest, half);
    exit = hn::Add(nearest, half);
    meets = hn::Ge(under, zero());
  }
};

HWY_INLINE D meets_ball(const MovingPoint& point, D reach) {
  const Crossing crossing(point, reach);
  return first_time(crossing.entry, crossing.exit, crossing.meets);
}

// Whether the share is in [0, 1], with a seam.
HWY_INLINE DoubleMask is_along(D share) {
  return hn::And(hn::Ge(share, splat_double(-kSeam)), hn::Le(share, splat_double(1 + kSeam)));
}

HWY_INLINE D meets_edge(const MovingPoint& point, const D3& edge, D reach) {
  const D inverse = inverse_or_zero(dot(edge, edge));
  const D start = hn::Mul(dot(point.from, edge), inverse);
  const D rate = hn::Mul(dot(point.way, edge), inverse);
  const Crossing crossing(moving_point(point.from - edge * start, point.way - edge * rate), reach);
  const D t = first_time(crossing.entry, crossing.exit, crossing.meets);
  const D along = hn::Add(start, hn::Mul(rate, max(crossing.entry, zero())));
  return hn::IfThenElse(is_along(along), t, never());
}

struct Face {
  D3 u, v;
  D3 normal;
  D squared;
  D sides;
  DoubleMask is_thin;
  DoubleMask is_slanted;

  HWY_INLINE Face(const D3& side_u, const D3& side_v)
      : u(side_u), v(side_v), normal(cross(side_u, side_v)), squared(dot(normal, normal)) {
    sides = hn::Mul(dot(u, u), dot(v, v));
    is_thin = hn::Not(hn::Gt(squared, hn::Mul(splat_double(kThinFace * kThinFace), sides)));
    is_slanted = hn::AndNot(
        is_thin, hn::Lt(squared, hn::Mul(splat_double(kSlantedFace * kSlantedFace), sides)));
  }

  HWY_INLINE D width() const {
    const D longest = max(dot(u, u), dot(v, v));
    return hn::IfThenElseZero(is_thin, hn::Sqrt(hn::Mul(squared, inverse_or_zero(longest))));
  }
};

enum class FaceKind { parallelogram, triangle };

template <FaceKind kKind>
HWY_INLINE D meets_face(const MovingPoint& point, const Face& face, D reach, D slack) {
  const D height = dot(face.normal, point.from), rate = dot(face.normal, point.way);
  const D limit = hn::Add(hn::Mul(reach, hn::Sqrt(face.squared)),
                          hn::Mul(hn::Mul(splat_double(kFaceSlack), slack), hn::Sqrt(face.sides)));
  const DoubleMask stands = hn::Eq(rate, zero());
  const D inverse = hn::IfThenZeroElse(stands, hn::Div(splat_double(1), rate));
  const D middle = hn::Neg(hn::Mul(height, inverse)), half = hn::Mul(limit, hn::Abs(inverse));
  const DoubleMask meets =
      hn::AndNot(face.is_thin, hn::Or(hn::Not(stands), hn::Le(hn::Abs(height), limit)));
  const D entry = hn::Sub(middle, half);
  const D t = first_time(entry, hn::Add(middle, half), meets);
  const D3 at = point.from + point.way * max(entry, zero());
  const D area = inverse_or_zero(face.squared);
  const D along_u = hn::Mul(dot(cross(at, face.v), face.normal), area);
  const D along_v = hn::Mul(dot(cross(face.u, at), face.normal), area);
  const D most = kKind == FaceKind::triangle ? hn::Add(along_u, along_v) : max(along_u, along_v);
  const D least = splat_double(-kSeam);
  const DoubleMask is_in = hn::And(hn::And(hn::Ge(along_u, least), hn::Ge(along_v, least)),
                                   hn::Le(most, splat_double(1 + kSeam)));
  return hn::IfThenElse(is_in, t, never());
}

// Pairs with a slanted face have no closed form that is exact enough.
HWY_INLINE D unless_slanted(DoubleMask is_slanted, D time) {
  return hn::IfThenElse(is_slanted, splat_double(kNoClosedForm), time);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_IMPACTS_LINEAR_CROSSING_INL_H_
