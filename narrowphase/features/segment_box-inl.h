// Segment against box in lanes. The box is centred at the origin, along the coordinate axes.
// Sources and reasons: segment_box_scalar.h.
#if defined(CAROM_NARROWPHASE_FEATURES_SEGMENT_BOX_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_FEATURES_SEGMENT_BOX_INL_H_
#undef CAROM_NARROWPHASE_FEATURES_SEGMENT_BOX_INL_H_
#else
#define CAROM_NARROWPHASE_FEATURES_SEGMENT_BOX_INL_H_
#endif

#include "narrowphase/features/axis_search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// start + s direction for s from 0 to `length`. The direction is scaled so that its greatest
// component is about one, however short the segment is.
struct DirectedSegment {
  F3 start, direction;
  F length;

  HWY_INLINE DirectedSegment(const F3& from, const F3& d) : start(from) {
    F down;
    power_of_two(largest_component(d), length, down);
    direction = d * down;
  }

  HWY_INLINE F3 at(F s) const { return start + direction * s; }
};

// The part of a segment in which the slope of the distance to the box changes its sign.
struct Bracket {
  F low, high;
  F slope_low, slope_high;

  // From the ends of the segment. It is one point if the distance only grows or only shrinks from
  // end to end.
  HWY_INLINE Bracket(const DirectedSegment& segment, const F3& half) {
    const F zero = splat(0);
    slope_low = dot(beyond(segment.start, half), segment.direction);
    slope_high = dot(beyond(segment.at(segment.length), half), segment.direction);
    const Mask grows = hn::Ge(slope_low, zero);
    const Mask shrinks = hn::AndNot(grows, hn::Le(slope_high, zero));
    slope_low = hn::IfThenZeroElse(hn::Or(grows, shrinks), slope_low);
    low = hn::IfThenElseZero(shrinks, segment.length);
    high = hn::IfThenZeroElse(grows, segment.length);
  }

  // Narrows by the slope at s, where the segment crosses the plane of a face. The other arguments:
  // start, direction and half extents in the other two axes.
  HWY_INLINE void narrow(F s, F start_u, F start_v, F u, F v, F half_u, F half_v) {
    const F slope = hn::Add(hn::Mul(beyond(hn::Add(start_u, hn::Mul(u, s)), half_u), u),
                            hn::Mul(beyond(hn::Add(start_v, hn::Mul(v, s)), half_v), v));
    const Mask is_inside = hn::And(hn::Gt(s, low), hn::Lt(s, high));
    const Mask shrinks = hn::Le(slope, splat(0));
    const Mask is_low = hn::And(is_inside, shrinks);
    const Mask is_high = hn::AndNot(shrinks, is_inside);
    low = hn::IfThenElse(is_low, s, low);
    slope_low = hn::IfThenElse(is_low, slope, slope_low);
    high = hn::IfThenElse(is_high, s, high);
    slope_high = hn::IfThenElse(is_high, slope, slope_high);
  }

  // Narrows by both faces of one axis.
  HWY_INLINE void narrow_axis(F start, F d, F half, F start_u, F start_v, F u, F v, F half_u,
                              F half_v) {
    const F inverse = hn::IfThenElseZero(hn::Ne(d, splat(0)), hn::Div(splat(1), d));
    narrow(hn::Mul(hn::Sub(hn::Neg(half), start), inverse), start_u, start_v, u, v, half_u, half_v);
    narrow(hn::Mul(hn::Sub(half, start), inverse), start_u, start_v, u, v, half_u, half_v);
  }

  // The parameter at which a linear slope is zero.
  HWY_INLINE F zero() const {
    const F share = hn::IfThenElseZero(hn::Lt(slope_low, splat(0)),
                                       hn::Div(slope_low, hn::Sub(slope_low, slope_high)));
    return hn::Add(low, hn::Mul(hn::Sub(high, low), share));
  }
};

HWY_INLINE Bracket bracket_of(const DirectedSegment& segment, const F3& half) {
  const F3& p = segment.start;
  const F3& d = segment.direction;
  Bracket bracket(segment, half);
  bracket.narrow_axis(p.x, d.x, half.x, p.y, p.z, d.y, d.z, half.y, half.z);
  bracket.narrow_axis(p.y, d.y, half.y, p.x, p.z, d.x, d.z, half.x, half.z);
  bracket.narrow_axis(p.z, d.z, half.z, p.x, p.y, d.x, d.y, half.x, half.y);
  return bracket;
}

// The point of a segment that is nearest to the box, and the vector to it from the nearest point of
// the box.
HWY_INLINE void nearest_to_box(const DirectedSegment& segment, const F3& half, F3& point, F3& way) {
  const Bracket bracket = bracket_of(segment, half);
  const F s = bracket.zero();
  point = segment.at(s);

  // Only axes in which the segment is beyond the box all along the bracket contribute to the
  // vector.
  const F middle = hn::Mul(hn::Add(bracket.low, bracket.high), splat(0.5f));
  const F3 in_bracket = beyond(segment.at(middle), half);
  const F zero = splat(0);
  const Mask3 is_beyond = {hn::Ne(in_bracket.x, zero), hn::Ne(in_bracket.y, zero),
                           hn::Ne(in_bracket.z, zero)};
  way = select(is_beyond, beyond(point, half), splat3(0));
  const F3 free = select(is_beyond, segment.direction, splat3(0));
  const F squared = dot(free, free);
  const F newton =
      hn::IfThenElseZero(hn::Gt(squared, zero), hn::Div(hn::Neg(dot(way, free)), squared));
  const F step = clamp(newton, hn::Sub(bracket.low, s), hn::Sub(bracket.high, s));
  point = point + segment.direction * step;
  way = way + free * step;
}

// The unit vector along `way`, and its length; zero if `way` is zero.
HWY_INLINE F3 direction_of(const F3& way, F& length) {
  length = hn::Sqrt(dot(way, way));
  return way * hn::IfThenElseZero(hn::Gt(length, splat(0)), hn::Div(splat(1), length));
}

// The contact location or nearest points of a box and another shape. The normal leads from the box
// to the shape.
struct BoxContact {
  F separation;
  F3 normal, on_box, on_other;
  Mask unsure;
};

HWY_INLINE void segment_box(const F3& start, const F3& d, const F3& half, BoxContact& contact) {
  DirectedSegment segment(start, d);
  const F3 end = segment.at(segment.length);
  AxisSearch search(half, min(start, end), max(start, end));
  search.try_crosses(segment.direction, start, start);
  F gap;
  search.best(gap, contact.normal);

  const F3 inwards = contact.normal * min(gap, splat(0));
  segment.start = start - inwards;
  F3 point, way;
  nearest_to_box(segment, half, point, way);
  contact.on_box = point - beyond(point, half);
  contact.on_other = point + inwards;

  F length;
  const F3 n = direction_of(way, length);
  const F certain = hn::Sub(min(dot(n, start), dot(n, end)), reach(half, n));
  contact.unsure = choose_normal(way, certain, gap, contact.normal, contact.separation);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_SEGMENT_BOX_INL_H_
