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
template <class V>
struct DirectedSegmentOf {
  Lanes3<V> start, direction;
  V length;

  HWY_INLINE DirectedSegmentOf(const Lanes3<V>& from, const Lanes3<V>& d) : start(from) {
    V down;
    power_of_two(largest_component(d), length, down);
    direction = d * down;
  }

  HWY_INLINE Lanes3<V> at(V s) const { return start + direction * s; }
};

using DirectedSegment = DirectedSegmentOf<F>;

// The part of a segment in which the slope of the distance to the box changes its sign.
template <class V>
struct BracketOf {
  V low, high;
  V slope_low, slope_high;

  // From the ends of the segment. It is one point if the distance only grows or only shrinks from
  // end to end.
  HWY_INLINE BracketOf(const DirectedSegmentOf<V>& segment, const Lanes3<V>& half) {
    const V zero = splat_as<V>(0);
    slope_low = dot(beyond(segment.start, half), segment.direction);
    slope_high = dot(beyond(segment.at(segment.length), half), segment.direction);
    const MaskOf<V> grows = hn::Ge(slope_low, zero);
    const MaskOf<V> shrinks = hn::AndNot(grows, hn::Le(slope_high, zero));
    slope_low = hn::IfThenZeroElse(hn::Or(grows, shrinks), slope_low);
    low = hn::IfThenElseZero(shrinks, segment.length);
    high = hn::IfThenZeroElse(grows, segment.length);
  }

  // Narrows by the slope at s, where the segment crosses the plane of a face. The other arguments:
  // start, direction and half extents in the other two axes.
  HWY_INLINE void narrow(V s, V start_u, V start_v, V u, V v, V half_u, V half_v) {
    const V slope = hn::Add(hn::Mul(beyond(hn::Add(start_u, hn::Mul(u, s)), half_u), u),
                            hn::Mul(beyond(hn::Add(start_v, hn::Mul(v, s)), half_v), v));
    const MaskOf<V> is_inside = hn::And(hn::Gt(s, low), hn::Lt(s, high));
    const MaskOf<V> shrinks = hn::Le(slope, splat_as<V>(0));
    const MaskOf<V> is_low = hn::And(is_inside, shrinks);
    const MaskOf<V> is_high = hn::AndNot(shrinks, is_inside);
    low = hn::IfThenElse(is_low, s, low);
    slope_low = hn::IfThenElse(is_low, slope, slope_low);
    high = hn::IfThenElse(is_high, s, high);
    slope_high = hn::IfThenElse(is_high, slope, slope_high);
  }

  // Narrows by both faces of one axis.
  HWY_INLINE void narrow_axis(V start, V d, V half, V start_u, V start_v, V u, V v, V half_u,
                              V half_v) {
    const V inverse = hn::IfThenElseZero(hn::Ne(d, splat_as<V>(0)), hn::Div(splat_as<V>(1), d));
    narrow(hn::Mul(hn::Sub(hn::Neg(half), start), inverse), start_u, start_v, u, v, half_u, half_v);
    narrow(hn::Mul(hn::Sub(half, start), inverse), start_u, start_v, u, v, half_u, half_v);
  }

  // The parameter at which a linear slope is zero.
  HWY_INLINE V zero() const {
    const V share = hn::IfThenElseZero(hn::Lt(slope_low, splat_as<V>(0)),
                                       hn::Div(slope_low, hn::Sub(slope_low, slope_high)));
    return hn::Add(low, hn::Mul(hn::Sub(high, low), share));
  }
};

template <class V>
HWY_INLINE BracketOf<V> bracket_of(const DirectedSegmentOf<V>& segment, const Lanes3<V>& half) {
  const Lanes3<V>& p = segment.start;
  const Lanes3<V>& d = segment.direction;
  BracketOf<V> bracket(segment, half);
  bracket.narrow_axis(p.x, d.x, half.x, p.y, p.z, d.y, d.z, half.y, half.z);
  bracket.narrow_axis(p.y, d.y, half.y, p.x, p.z, d.x, d.z, half.x, half.z);
  bracket.narrow_axis(p.z, d.z, half.z, p.x, p.y, d.x, d.y, half.x, half.y);
  return bracket;
}

// The point of a segment that is nearest to the box, and the vector to it from the nearest point of
// the box.
template <class V>
HWY_INLINE void nearest_to_box(const DirectedSegmentOf<V>& segment, const Lanes3<V>& half,
                               Lanes3<V>& point, Lanes3<V>& way) {
  const BracketOf<V> bracket = bracket_of(segment, half);
  const V s = bracket.zero();
  point = segment.at(s);

  // Only axes in which the segment is beyond the box all along the bracket contribute to the
  // vector.
  const V middle = hn::Mul(hn::Add(bracket.low, bracket.high), splat_as<V>(0.5));
  const Lanes3<V> in_bracket = beyond(segment.at(middle), half);
  const V zero = splat_as<V>(0);
  const Lanes3<V> zeros = {zero, zero, zero};
  const Mask3Of<V> is_beyond = {hn::Ne(in_bracket.x, zero), hn::Ne(in_bracket.y, zero),
                                hn::Ne(in_bracket.z, zero)};
  way = select(is_beyond, beyond(point, half), zeros);
  const Lanes3<V> free = select(is_beyond, segment.direction, zeros);
  const V squared = dot(free, free);
  const V newton =
      hn::IfThenElseZero(hn::Gt(squared, zero), hn::Div(hn::Neg(dot(way, free)), squared));
  const V step = clamp(newton, hn::Sub(bracket.low, s), hn::Sub(bracket.high, s));
  point = point + segment.direction * step;
  way = way + free * step;
}

// The unit vector along `way`, and its length; zero if `way` is zero.
template <class V>
HWY_INLINE Lanes3<V> direction_of(const Lanes3<V>& way, V& length) {
  length = hn::Sqrt(dot(way, way));
  return way * hn::IfThenElseZero(hn::Gt(length, splat_as<V>(0)), hn::Div(splat_as<V>(1), length));
}

// The contact location or nearest points of a box and another shape. The normal leads from the box
// to the shape.
template <class V>
struct BoxContactOf {
  V separation;
  Lanes3<V> normal, on_box, on_other;
  MaskOf<V> unsure;
};

using BoxContact = BoxContactOf<F>;

template <class V>
HWY_INLINE void segment_box(const Lanes3<V>& start, const Lanes3<V>& d, const Lanes3<V>& half,
                            BoxContactOf<V>& contact) {
  DirectedSegmentOf<V> segment(start, d);
  const Lanes3<V> end = segment.at(segment.length);
  AxisSearchOf<V> search(half, min(start, end), max(start, end));
  search.try_crosses(segment.direction, start, start);
  V gap;
  search.best(gap, contact.normal);

  const Lanes3<V> inwards = contact.normal * min(gap, splat_as<V>(0));
  segment.start = start - inwards;
  Lanes3<V> point, way;
  nearest_to_box(segment, half, point, way);
  contact.on_box = point - beyond(point, half);
  contact.on_other = point + inwards;

  V length;
  const Lanes3<V> n = direction_of(way, length);
  const V certain = hn::Sub(min(dot(n, start), dot(n, end)), reach(half, n));
  contact.unsure = choose_normal(way, certain, gap, contact.normal, contact.separation);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_FEATURES_SEGMENT_BOX_INL_H_
