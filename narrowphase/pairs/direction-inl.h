// The direction pass of a batch: whether shapes are still separate along the direction that
// separated them before. It takes a few products; a whole test tries many axes.
#if defined(CAROM_NARROWPHASE_PAIRS_DIRECTION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_PAIRS_DIRECTION_INL_H_
#undef CAROM_NARROWPHASE_PAIRS_DIRECTION_INL_H_
#else
#define CAROM_NARROWPHASE_PAIRS_DIRECTION_INL_H_
#endif

#include "base/tolerances.h"
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/batch/packed_direction.h"
#include "narrowphase/hulls/core_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Unpacks what pack_direction() packed.
HWY_INLINE F3 load_directions(const uint32_t* packed) {
  const IntTag tag;
  const I bits = hn::LoadU(tag, reinterpret_cast<const int32_t*>(packed));
  const I ten_bits = hn::Set(tag, 0x3ff);
  const auto component = [&](I shifted) HWY_ATTR {
    const F steps = hn::ConvertTo(FloatTag(), hn::And(shifted, ten_bits));
    return hn::Mul(hn::Sub(steps, splat(kDirectionZero)), splat(1 / kDirectionSteps));
  };
  return {component(bits), component(hn::ShiftRight<10>(bits)),
          component(hn::ShiftRight<20>(bits))};
}

// Rotates by the inverse of q, without a matrix.
HWY_INLINE F3 rotate_back(const Quaternion& q, const F3& v) {
  const F3 t = cross(v, q.v) * hn::Div(splat(2), squared_norm(q));
  return (v + t * q.w) + cross(t, q.v);
}

// How far a shape reaches along n, from its position.
HWY_INLINE F reach_along(const BoxLanes& box, const Quaternion& q, const F3& n) {
  const F3 m = rotate_back(q, n);
  return dot({hn::Abs(m.x), hn::Abs(m.y), hn::Abs(m.z)}, box.half);
}
HWY_INLINE F reach_along(const AabbLanes& box, const Quaternion&, const F3& n) {
  const F zero = splat(0);
  return dot(n, {hn::IfThenElse(hn::Gt(n.x, zero), box.upper.x, box.lower.x),
                 hn::IfThenElse(hn::Gt(n.y, zero), box.upper.y, box.lower.y),
                 hn::IfThenElse(hn::Gt(n.z, zero), box.upper.z, box.lower.z)});
}
HWY_INLINE F reach_along(const TriangleLanes& triangle, const Quaternion& q, const F3& n) {
  const F3 m = rotate_back(q, n);
  return max(max(dot(m, triangle.a), dot(m, triangle.b)), dot(m, triangle.c));
}

HWY_INLINE F reach_along(const HullLanes& hull, const Quaternion& q, const F3& n) {
  const F3 m = rotate_back(q, n);
  const HullRecords records(hull);
  F reach = splat(-FLT_MAX);
  records.for_each_point(records.most(),
                         [&](size_t, const F3& p) HWY_ATTR { reach = max(reach, dot(m, p)); });
  return hn::Mul(reach, hull.scaling);
}

template <class Shape>
HWY_INLINE Mask has_rules(const Shape&) {
  return no_lanes();
}
HWY_INLINE Mask has_rules(const TriangleLanes& triangle) { return triangle.is_special; }

// Writes to `overlap` 1 if a pair needs a test, 0 if the shapes are separate. The test would find
// the latter separate, too: their gap is greater than its error.
template <class A, class B>
void run_direction(const Batch& batch) {
  for (size_t row = 0; row < batch.count; row += kLanes) {
    fetch_ahead<A, B>(batch, row);
    const Listed bodies{batch.pairs + row};
    PositionLanes positions;
    PoseLanes pose;
    A a;
    B b;
    load_pairs<AnyRecords>(batch, bodies, positions, pose, a, b);
    const Mask valid = is_plainly_valid(pose, a, b);
    to_units<Units::scaled>(pose, a, b);
    const F3 n = load_directions(batch.direction + row);
    const F reach = hn::Add(reach_along(a, pose.a, n), reach_along(b, pose.b, -n));
    const Mask apart = hn::And(valid, hn::Gt(hn::Sub(dot(n, pose.d), reach), splat(kClearlyApart)));
    const Mask open = hn::Or(hn::Not(apart), hn::Or(has_rules(a), has_rules(b)));
    store_bytes(bytes_where(open, 1), batch.out.overlap, row);
  }
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_PAIRS_DIRECTION_INL_H_
