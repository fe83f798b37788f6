// Travel in lanes.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bounds/travel.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <algorithm>
#include <type_traits>

#include "bounds/bounds_load-inl.h"
#include "bounds/travel.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// The sums, products and roots below round some twenty times.
constexpr float kRoundedUp = 1 + 0x1p-18f;
// The vector part of q conj(p) is a difference of products: it rounds by a share of |p| |q|.
constexpr float kTurnRounding = 0x1p-20f;
// Below this, in square metres, products of lengths lose digits.
constexpr float kLeastSquare = 0x1p-100f;

HWY_INLINE F squared(const F3& v) {
  return hn::Add(hn::Add(hn::Mul(v.x, v.x), hn::Mul(v.y, v.y)), hn::Mul(v.z, v.z));
}

HWY_INLINE F3 way_of(const F3& from, const F3& to) { return to - from; }

HWY_INLINE F3 way_of(const Wide3& from, const Wide3& to) {
  const auto part = [](const Wide& a, const Wide& b) HWY_ATTR {
#if HWY_TARGET == HWY_SCALAR
    return demote(Wide{hn::Sub(b.all, a.all)});
#else
    return demote(Wide{hn::Sub(b.low, a.low), hn::Sub(b.high, a.high)});
#endif
  };
  return {part(from.x, to.x), part(from.y, to.y), part(from.z, to.z)};
}

// Or up to twice as much, of very short ways, whose squares vanish. NaN stays NaN.
HWY_INLINE F length_of(const F3& way) {
  const F square = squared(way), largest = largest_component(way);
  return hn::IfThenElse(hn::Lt(square, splat(kLeastSquare)), hn::Add(largest, largest),
                        hn::Sqrt(square));
}

// The quaternion with its largest component scaled to between 1 and 2, exactly, so that no product
// leaves the range of floats.
HWY_INLINE Quaternion scaled(const Quaternion& q) {
  F up, down;
  power_of_two(max(largest_component(q.v), hn::Abs(q.w)), up, down);
  return {q.v * down, hn::Mul(q.w, down)};
}

// How far points move that lie `radius` from the axis about which one orientation becomes another,
// and that go `way` as well. The turn moves them across the axis, by a chord of c = 2 r sin(angle /
// 2). Of the way, the part across the axis may go with the chord: the square of both is that of the
// way, of c, and twice c times that part. |p| |q| sin(angle / 2) is the length of the vector part
// of q conj(p), which lies along the axis.
HWY_INLINE F turning_way(const F3& way, const Quaternion& from, const Quaternion& to, F radius) {
  const Quaternion p = scaled(from), q = scaled(to);
  const auto minus = [](F a, F b, F c, F d)
                         HWY_ATTR { return hn::Sub(hn::Mul(a, b), hn::Mul(c, d)); };
  const F3 straight = {minus(p.w, q.v.x, q.w, p.v.x), minus(p.w, q.v.y, q.w, p.v.y),
                       minus(p.w, q.v.z, q.w, p.v.z)};
  const F3 crossed = {minus(p.v.y, q.v.z, p.v.z, q.v.y), minus(p.v.z, q.v.x, p.v.x, q.v.z),
                      minus(p.v.x, q.v.y, p.v.y, q.v.x)};
  const F3 axis = straight + crossed;
  const F lengths =
      hn::Mul(hn::Add(squared(p.v), hn::Mul(p.w, p.w)), hn::Add(squared(q.v), hn::Mul(q.w, q.w)));
  const auto share = [&](const F3& v) HWY_ATTR { return hn::Sqrt(hn::Div(squared(v), lengths)); };
  const F diameter = hn::Add(radius, radius), length = length_of(way);
  const F chord = hn::Mul(diameter, hn::Add(share(axis), splat(kTurnRounding)));
  const F across = hn::Mul(
      diameter, hn::Add(share(cross(way, axis)), hn::Mul(length, splat(2 * kTurnRounding))));
  const F square = hn::Add(hn::Add(squared(way), hn::Mul(chord, chord)), hn::Add(across, across));
  const F together = hn::Sqrt(square), most = hn::Add(length, chord);
  // Where something is infinite or NaN, so is the second.
  const Mask is_less = hn::And(hn::Lt(together, most), hn::Gt(square, splat(kLeastSquare)));
  return hn::IfThenElse(is_less, together, most);
}

HWY_INLINE Mask differ(const Quaternion& p, const Quaternion& q) {
  const auto is_other = [](F a, F b) HWY_ATTR {
    const IntTag bits;
    return hn::RebindMask(FloatTag(), hn::Ne(hn::BitCast(bits, a), hn::BitCast(bits, b)));
  };
  return hn::Or(hn::Or(is_other(p.v.x, q.v.x), is_other(p.v.y, q.v.y)),
                hn::Or(is_other(p.v.z, q.v.z), is_other(p.w, q.w)));
}

// Rounded up; 0 for 0 alone.
HWY_INLINE I ticks_of(F metres, float ticks_per_metre) {
  const IntTag integers;
  const F scaled = hn::Mul(metres, splat(ticks_per_metre));
  const Mask is_near = hn::Lt(scaled, splat(static_cast<float>(kJump)));  // false for NaN
  const I above =
      hn::Add(hn::ConvertTo(integers, hn::IfThenElseZero(is_near, scaled)), hn::Set(integers, 1));
  const I ticks = hn::IfThenElse(hn::RebindMask(integers, is_near), above,
                                 hn::Set(integers, static_cast<int32_t>(kJump)));
  return hn::IfThenZeroElse(hn::RebindMask(integers, hn::Eq(metres, splat(0))), ticks);
}

HWY_INLINE Quaternion load_quaternions(const float* rows, size_t i) {
  Quaternion q;
  const char* const first = reinterpret_cast<const char*>(rows + 4 * i);
  transpose_records(ConsecutiveRecords{first, 4 * sizeof(float)}, q.v, q.w);
  return q;
}

HWY_INLINE F load_column(const float* column) { return hn::LoadU(FloatTag(), column); }
HWY_INLINE Wide load_column(const double* column) { return load_wide(column); }

HWY_INLINE void store_column(F v, hn::Mask<IntTag> where, float* column) {
  hn::BlendedStore(v, hn::RebindMask(FloatTag(), where), FloatTag(), column);
}
HWY_INLINE void store_column(const Wide& v, hn::Mask<IntTag> where, double* column) {
  HWY_ALIGN double values[kLanes];
  store_wide(v, values);
  const uint64_t bits = bits_of(IntTag(), where);
  for (size_t k = 0; k < kLanes; ++k) column[k] = bits >> k & 1 ? values[k] : column[k];
}

// Returns the ticks that each odometer has gained; none where it went back.
template <class T>
HWY_INLINE I add_lanes(const TravelColumns<T>& bodies, const TravelUnit& unit, size_t i) {
  using Records = std::conditional_t<std::is_same_v<T, float>, FloatRecords, DoubleRecords>;
  using Position = typename Records::Position;
  const FloatTag tag;
  const IntTag integers;
  PositionView records;
  records.data = bodies.position;
  records.stride = 4 * sizeof(T);
  Position to;
  F unused;
  Records(records).load(i, to, unused);
  const auto& column = bodies.anchor_position;
  const Position from = {load_column(column[0] + i), load_column(column[1] + i),
                         load_column(column[2] + i)};
  const F3 way = way_of(from, to);
  F metres = length_of(way);
  Quaternion q = {splat3(0), splat(1)};
  const auto& turned = bodies.anchor_orientation;
  if (bodies.orientation) {
    q = load_quaternions(bodies.orientation, i);
    const Quaternion p = {
        {load_column(turned[0] + i), load_column(turned[1] + i), load_column(turned[2] + i)},
        load_column(turned[3] + i)};
    const F radius = hn::LoadU(tag, bodies.turn_radius + i);
    // Not by Ne(), which is false for NaN on some instruction sets.
    const Mask turns = hn::AndNot(hn::Eq(radius, splat(0)), differ(p, q));
    metres = hn::IfThenElse(turns, turning_way(way, p, q, radius), metres);
  }
  const I gone = ticks_of(hn::Mul(metres, splat(kRoundedUp)), unit.ticks_per_metre);
  const auto signed_of = [](uint32_t* of) { return reinterpret_cast<int32_t*>(of); };
  const I until = hn::LoadU(integers, signed_of(bodies.anchored) + i);
  const I travelled = hn::Add(until, gone);
  const I before = hn::LoadU(integers, signed_of(bodies.travelled) + i);
  const I gained = hn::Max(hn::Sub(travelled, before), hn::Zero(integers));
  hn::StoreU(before, integers, signed_of(bodies.travelled_before) + i);
  hn::StoreU(travelled, integers, signed_of(bodies.travelled) + i);
  const auto leaves = hn::Gt(gone, hn::Set(integers, static_cast<int32_t>(unit.leash)));
  if (hn::AllFalse(integers, leaves)) return gained;
  hn::StoreU(hn::IfThenElse(leaves, travelled, until), integers, signed_of(bodies.anchored) + i);
  store_column(to.x, leaves, column[0] + i);
  store_column(to.y, leaves, column[1] + i);
  store_column(to.z, leaves, column[2] + i);
  if (!bodies.orientation) return gained;
  store_column(q.v.x, leaves, turned[0] + i);
  store_column(q.v.y, leaves, turned[1] + i);
  store_column(q.v.z, leaves, turned[2] + i);
  store_column(q.w, leaves, turned[3] + i);
  return gained;
}

// The last bodies, fewer than the lanes, in copies of their columns.
template <class T>
HWY_INLINE I add_tail(const TravelColumns<T>& bodies, const TravelUnit& unit, size_t begin,
                      size_t count) {
  HWY_ALIGN T position[4 * kLanes] = {}, anchor[3][kLanes] = {};
  HWY_ALIGN float turn[4 * kLanes] = {}, anchor_turn[4][kLanes] = {}, radius[kLanes] = {};
  HWY_ALIGN uint32_t anchored[kLanes] = {}, travelled[kLanes] = {}, before[kLanes] = {};
  const auto copy = [count](const auto* from, size_t each, auto* to) {
    std::copy_n(from, count * each, to);
  };
  TravelColumns<T> few = {
      .position = position,
      .orientation = bodies.orientation ? turn : nullptr,
      .turn_radius = radius,
      .anchor_position = {anchor[0], anchor[1], anchor[2]},
      .anchor_orientation = {anchor_turn[0], anchor_turn[1], anchor_turn[2], anchor_turn[3]},
      .anchored = anchored,
      .travelled = travelled,
      .travelled_before = before};
  copy(bodies.position + 4 * begin, 4, position);
  copy(bodies.turn_radius + begin, 1, radius);
  copy(bodies.anchored + begin, 1, anchored);
  copy(bodies.travelled + begin, 1, travelled);
  for (size_t c = 0; c < 3; ++c) copy(bodies.anchor_position[c] + begin, 1, anchor[c]);
  if (bodies.orientation) {
    copy(bodies.orientation + 4 * begin, 4, turn);
    for (size_t c = 0; c < 4; ++c) copy(bodies.anchor_orientation[c] + begin, 1, anchor_turn[c]);
  }
  const I gained = add_lanes(few, unit, 0);
  copy(anchored, 1, bodies.anchored + begin);
  copy(travelled, 1, bodies.travelled + begin);
  copy(before, 1, bodies.travelled_before + begin);
  for (size_t c = 0; c < 3; ++c) copy(anchor[c], 1, bodies.anchor_position[c] + begin);
  for (size_t c = 0; bodies.orientation && c < 4; ++c) {
    copy(anchor_turn[c], 1, bodies.anchor_orientation[c] + begin);
  }
  return gained;
}

template <class T>
HWY_INLINE uint32_t travel(const TravelColumns<T>& bodies, const TravelUnit& unit, size_t begin,
                           size_t end) {
  size_t i = begin;
  I gains = hn::Zero(IntTag());
  for (; i + kLanes <= end; i += kLanes) gains = hn::Or(gains, add_lanes(bodies, unit, i));
  if (i < end) gains = hn::Or(gains, add_tail(bodies, unit, i, end - i));
  HWY_ALIGN int32_t gain[kLanes];
  hn::Store(gains, IntTag(), gain);
  uint32_t all = 0;
  for (const int32_t its : gain) all |= static_cast<uint32_t>(its);
  return all;
}

uint32_t travel32(const TravelColumns<float>& bodies, const TravelUnit& unit, size_t begin,
                  size_t end) {
  return travel(bodies, unit, begin, end);
}
uint32_t travel64(const TravelColumns<double>& bodies, const TravelUnit& unit, size_t begin,
                  size_t end) {
  return travel(bodies, unit, begin, end);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(travel32);
HWY_EXPORT(travel64);

}  // namespace

uint32_t add_travel(const TravelColumns<float>& bodies, const TravelUnit& unit, size_t begin,
                    size_t end) {
  return CAROM_DISPATCH(travel32)(bodies, unit, begin, end);
}
uint32_t add_travel(const TravelColumns<double>& bodies, const TravelUnit& unit, size_t begin,
                    size_t end) {
  return CAROM_DISPATCH(travel64)(bodies, unit, begin, end);
}

}  // namespace carom
#endif  // HWY_ONCE
