// Travel in lanes.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bounds/travel.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <bit>
#include <cstring>
#include <type_traits>

#include "bounds/bounds_load-inl.h"
#include "bounds/travel.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// The sums, products and roots below round a dozen times.
constexpr float kRoundedUp = 1 + 0x1p-19f;
// The vector part of conj(p) q is a difference of products: it rounds by a share of |p| |q|.
constexpr float kTurnRounding = 0x1p-20f;

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

// Squares of very short ways vanish. NaN stays NaN: it is the second operand.
HWY_INLINE F length_of(const F3& way) {
  return max(largest_component(way), hn::Sqrt(squared(way)));
}

// The chord that a point at `radius` covers when p becomes q: 2 r sin(angle / 2), where |p| |q|
// times the sine is the length of the vector part of conj(p) q.
HWY_INLINE F chord(const Quaternion& p, const Quaternion& q, F radius) {
  const auto minus = [](F a, F b, F c, F d)
                         HWY_ATTR { return hn::Sub(hn::Mul(a, b), hn::Mul(c, d)); };
  const F3 straight = {minus(p.w, q.v.x, q.w, p.v.x), minus(p.w, q.v.y, q.w, p.v.y),
                       minus(p.w, q.v.z, q.w, p.v.z)};
  const F3 crossed = {minus(p.v.y, q.v.z, p.v.z, q.v.y), minus(p.v.z, q.v.x, p.v.x, q.v.z),
                      minus(p.v.x, q.v.y, p.v.y, q.v.x)};
  const F3 part = straight - crossed;
  const F lengths =
      hn::Mul(hn::Add(squared(p.v), hn::Mul(p.w, p.w)), hn::Add(squared(q.v), hn::Mul(q.w, q.w)));
  const F sine = hn::Sqrt(hn::Div(squared(part), lengths));
  return hn::Mul(hn::Add(radius, radius), hn::Add(sine, splat(kTurnRounding)));
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

template <class T>
struct Travel {
  using Records = std::conditional_t<std::is_same_v<T, float>, FloatRecords, DoubleRecords>;

  const TravelColumns& bodies;
  const TravelUnit& unit;
  Records position, anchor;

  Travel(const TravelColumns& columns, const TravelUnit& of)
      : bodies(columns),
        unit(of),
        position(view(columns.position)),
        anchor(view(columns.anchor_position)) {}

  static PositionView view(const void* records) {
    PositionView of;
    of.data = records;
    of.stride = 4 * sizeof(T);
    return of;
  }

  // Whether all of these bodies are at their anchors.
  bool are_at_anchors(size_t begin, size_t count) const {
    const auto same = [&](const void* a, const void* b, size_t size) {
      return std::memcmp(static_cast<const char*>(a) + begin * size,
                         static_cast<const char*>(b) + begin * size, count * size) == 0;
    };
    return same(bodies.position, bodies.anchor_position, 4 * sizeof(T)) &&
           (!bodies.orientation ||
            same(bodies.orientation, bodies.anchor_orientation, 4 * sizeof(float)));
  }

  template <size_t kCount>
  HWY_INLINE void move_anchors(size_t i) const {
    std::memcpy(static_cast<T*>(bodies.anchor_position) + 4 * i,
                static_cast<const T*>(bodies.position) + 4 * i, kCount * 4 * sizeof(T));
    if (bodies.orientation) {
      std::memcpy(bodies.anchor_orientation + 4 * i, bodies.orientation + 4 * i,
                  kCount * 4 * sizeof(float));
    }
  }

  HWY_INLINE void add_lanes(size_t i) const {
    const FloatTag tag;
    const IntTag integers;
    typename Records::Position from, to;
    F unused;
    anchor.load(i, from, unused);
    position.load(i, to, unused);
    F metres = length_of(way_of(from, to));
    if (bodies.orientation) {
      const Quaternion p = load_quaternions(bodies.anchor_orientation, i);
      const Quaternion q = load_quaternions(bodies.orientation, i);
      const F radius = hn::LoadU(tag, bodies.turn_radius + i);
      const Mask turns = hn::And(differ(p, q), hn::Ne(radius, splat(0)));
      metres = hn::Add(metres, hn::IfThenElseZero(turns, chord(p, q, radius)));
    }
    const I gone = ticks_of(hn::Mul(metres, splat(kRoundedUp)), unit.ticks_per_metre);
    const auto signed_of = [](uint32_t* column) { return reinterpret_cast<int32_t*>(column); };
    const I until = hn::LoadU(integers, signed_of(bodies.anchored) + i);
    const I travelled = hn::Add(until, gone);
    hn::StoreU(travelled, integers, signed_of(bodies.travelled) + i);
    const auto leaves = hn::Gt(gone, hn::Set(integers, static_cast<int32_t>(unit.leash)));
    if (hn::AllFalse(integers, leaves)) return;
    hn::StoreU(hn::IfThenElse(leaves, travelled, until), integers, signed_of(bodies.anchored) + i);
    if (hn::AllTrue(integers, leaves)) return move_anchors<kLanes>(i);
    for (uint64_t rest = bits_of(integers, leaves); rest != 0; rest &= rest - 1) {
      move_anchors<1>(i + static_cast<size_t>(std::countr_zero(rest)));
    }
  }

  // The last bodies, fewer than the lanes, in copies of their columns.
  void add_tail(size_t begin, size_t count) const {
    alignas(64) T positions[4 * kLanes] = {}, anchors[4 * kLanes] = {};
    alignas(64) float turns[4 * kLanes] = {}, anchor_turns[4 * kLanes] = {};
    alignas(64) float radii[kLanes] = {};
    alignas(64) uint32_t anchored[kLanes] = {}, travelled[kLanes] = {};
    TravelColumns few = bodies;
    const auto copy = [count](auto* to, const auto* from, size_t each) {
      std::memcpy(to, from, count * each * sizeof(*to));
    };
    copy(positions, static_cast<const T*>(bodies.position) + 4 * begin, 4);
    copy(anchors, static_cast<const T*>(bodies.anchor_position) + 4 * begin, 4);
    copy(radii, bodies.turn_radius + begin, 1);
    copy(anchored, bodies.anchored + begin, 1);
    few.position = positions;
    few.anchor_position = anchors;
    few.turn_radius = radii;
    few.anchored = anchored;
    few.travelled = travelled;
    if (bodies.orientation) {
      copy(turns, bodies.orientation + 4 * begin, 4);
      copy(anchor_turns, bodies.anchor_orientation + 4 * begin, 4);
      few.orientation = turns;
      few.anchor_orientation = anchor_turns;
    }
    Travel(few, unit).add_lanes(0);
    copy(static_cast<T*>(bodies.anchor_position) + 4 * begin, anchors, 4);
    if (bodies.orientation) copy(bodies.anchor_orientation + 4 * begin, anchor_turns, 4);
    copy(bodies.anchored + begin, anchored, 1);
    copy(bodies.travelled + begin, travelled, 1);
  }
};

template <class T>
void travel_of(const TravelColumns& bodies, const TravelUnit& unit, size_t begin, size_t end) {
  const Travel<T> travel(bodies, unit);
  if (travel.are_at_anchors(begin, end - begin)) {
    std::memcpy(bodies.travelled + begin, bodies.anchored + begin,
                (end - begin) * sizeof(uint32_t));
    return;
  }
  size_t i = begin;
  for (; i + kLanes <= end; i += kLanes) travel.add_lanes(i);
  if (i < end) travel.add_tail(i, end - i);
}

void travel(const TravelColumns& bodies, const TravelUnit& unit, size_t begin, size_t end) {
  const auto run = bodies.type == PositionType::float64 ? travel_of<double> : travel_of<float>;
  run(bodies, unit, begin, end);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(travel);

}  // namespace

void add_travel(const TravelColumns& bodies, const TravelUnit& unit, size_t begin, size_t end) {
  CAROM_DISPATCH(travel)(bodies, unit, begin, end);
}

}  // namespace carom
#endif  // HWY_ONCE
