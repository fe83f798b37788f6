#include "narrowphase/pairs/rounded/grow_boxes.h"

#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/rounded/grow_boxes.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <cfloat>

#include "base/tolerances.h"
#include "narrowphase/batch/load-inl.h"
#include "narrowphase/batch/store-inl.h"
#include "simd/axis-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

struct GrownBoxes {
  F rounding, size;
};

template <Role kRole>
HWY_INLINE GrownBoxes load_boxes(const BatchSide& side, const Listed& bodies, bool is_rounded) {
  F3 half;
  GrownBoxes boxes;
  load_row<kRole, 1>(side, bodies, 0, half, boxes.rounding);
  if (!is_rounded) boxes.rounding = splat(0);
  boxes.size = hn::Add(hn::Add(hn::Abs(half.x), hn::Abs(half.y)), hn::Abs(half.z));
  return boxes;
}

HWY_INLINE F3 load_column(const std::array<float*, 3>& columns, size_t row) {
  const FloatTag tag;
  return {hn::LoadU(tag, columns[0] + row), hn::LoadU(tag, columns[1] + row),
          hn::LoadU(tag, columns[2] + row)};
}

HWY_INLINE Mask is_radius(F radius) {
  return hn::And(hn::Ge(radius, splat(0)), hn::Le(radius, splat(FLT_MAX)));
}

// Writes whole vectors and returns how many rows these are.
size_t grow_rows(const BoxesToGrow& boxes, uint8_t* state) {
  const Batch& batch = boxes.cores;
  const ResultColumns out = batch.out;
  const bool is_world = boxes.frame == WitnessFrame::world;
  const Mask measures_all = batch.measures ? hn::Not(no_lanes()) : no_lanes();
  const size_t whole = batch.count - batch.count % kLanes;
  for (size_t row = 0; row < whole; row += kLanes) {
    const Listed bodies{batch.pairs + row};
    PositionLanes positions;
    AnyRecords::load(batch, bodies, positions);
    const GrownBoxes a = load_boxes<Role::a>(batch.a, bodies, boxes.is_rounded_a);
    const GrownBoxes b = load_boxes<Role::b>(batch.b, bodies, boxes.is_rounded_b);
    const F distance = largest_component(clamp_to_finite(positions.relative));
    const F near = hn::Mul(splat(kNearTouchScaled), hn::Add(hn::Add(distance, a.size), b.size));

    const F of_cores = hn::LoadU(FloatTag(), out.separation + row);
    const F both = hn::Add(a.rounding, b.rounding);
    const F separation = hn::Sub(of_cores, both);
    const F3 n = load_column(out.normal, row);
    F3 arm_a = load_column(out.point_a, row) + n * a.rounding;
    F3 arm_b = load_column(out.point_b, row) - n * b.rounding;

    const Mask has_answer = hn::Eq(of_cores, of_cores);
    const Mask is_valid = hn::And(is_radius(a.rounding), is_radius(b.rounding));
    const F magnitude = hn::Abs(separation);
    Mask is_done = hn::And(hn::Gt(magnitude, near), hn::Le(magnitude, splat(FLT_MAX)));
    is_done = hn::And(is_done, hn::Gt(both, splat(0)));
    Mask is_near = no_lanes();
    if (boxes.is_bound) {
      is_near = hn::And(hn::Gt(of_cores, splat(0)),
                        hn::Or(measures_all, hn::Not(hn::Gt(separation, near))));
      is_done = hn::AndNot(is_near, is_done);
    }
    // Rows without an answer keep it.
    const Mask is_open = hn::And(has_answer, hn::Or(hn::Not(is_done), hn::Not(is_valid)));
    const Mask is_grown = hn::AndNot(is_open, has_answer);
    I code = bytes_where(is_open, static_cast<int32_t>(GrownState::left));
    code = hn::IfThenElse(hn::RebindMask(IntTag(), hn::And(is_open, is_near)),
                          hn::Set(IntTag(), static_cast<int32_t>(GrownState::near)), code);
    code = hn::IfThenElse(hn::RebindMask(IntTag(), hn::AndNot(is_valid, is_open)),
                          hn::Set(IntTag(), static_cast<int32_t>(GrownState::invalid)), code);
    store_bytes(code, state, row);
    if (is_world) {
      arm_a = positions.a + (positions.a_low + arm_a);
      arm_b = positions.b + (positions.b_low + arm_b);
    }
    store(hn::IfThenElse(is_grown, separation, of_cores), out.separation, row);
    store_bytes(bytes_where(hn::And(is_grown, hn::Le(separation, splat(0))), 1), out.overlap, row);
    store(select(is_grown, arm_a, load_column(out.point_a, row)), out.point_a, row);
    store(select(is_grown, arm_b, load_column(out.point_b, row)), out.point_b, row);
  }
  return whole;
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(grow_rows);

size_t grow_boxes(const BoxesToGrow& boxes, uint8_t* state) {
  return CAROM_DISPATCH(grow_rows)(boxes, state);
}

}  // namespace carom
#endif  // HWY_ONCE
