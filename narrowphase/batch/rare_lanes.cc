#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/batch/rare_lanes.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/column_memory.h"
#include "narrowphase/batch/rare_lanes-inl.h"
#include "narrowphase/batch/single_pair.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

template <class Body>
void for_each_lane(const Mask& mask, const Body& body) {
  HWY_ALIGN float flags[kLanes];
  hn::Store(hn::IfThenElseZero(mask, splat(1)), FloatTag(), flags);
  for (size_t i = 0; i < kLanes; ++i) {
    if (flags[i] != 0) body(i);
  }
}

}  // namespace

void run_tail(const Batch& batch, size_t first_row, void (*run)(const Batch&)) {
  const size_t count = batch.count - first_row;
  Pair pairs[kLanes];
  for (size_t i = 0; i < kLanes; ++i) {
    pairs[i] = batch.pairs[first_row + (i < count ? i : count - 1)];
  }
  ColumnMemory<kLanes, ColumnRole::test> results;
  uint8_t unsure[kLanes] = {};
  uint64_t features[kLanes] = {};
  for (size_t i = 0; batch.features && i < count; ++i) features[i] = batch.features[first_row + i];
  Batch tail = batch;
  tail.unsure = batch.unsure ? unsure : nullptr;
  tail.features = batch.features ? features : nullptr;
  tail.open = nullptr;
  tail.pairs = pairs;
  tail.pairs_are_rows = false;
  tail.count = kLanes;
  tail.out = results.columns();
  run(tail);
  copy_rows(tail.out, batch.out, batch.detail, count, [=](size_t i) { return first_row + i; });
  for (size_t i = 0; batch.unsure && i < count; ++i) batch.unsure[first_row + i] = unsure[i];
  for (size_t i = 0; batch.features && i < count; ++i) batch.features[first_row + i] = features[i];
}

void find_valid(const RowsOfKinds& rows, Mask& valid) {
  HWY_ALIGN float flags[kLanes];
  for (size_t i = 0; i < kLanes; ++i) {
    flags[i] = is_valid_pair(rows.batch, rows.a, rows.b, rows.row + i) ? 1.0f : 0.0f;
  }
  valid = hn::Gt(hn::Load(FloatTag(), flags), hn::Zero(FloatTag()));
}

void refine_separation(const RowsOfKinds& rows, const Mask& unsure, F& separation) {
  HWY_ALIGN float values[kLanes];
  hn::Store(separation, FloatTag(), values);
  for_each_lane(unsure, [&](size_t i) {
    values[i] = near_touch_separation(rows.batch, rows.a, rows.b, rows.row + i);
  });
  separation = hn::Load(FloatTag(), values);
}

void refine_all(const RowsOfKinds& rows, const Mask& unsure, AnswerLanes& answer,
                Mask& degenerate) {
  constexpr size_t kNumbers = 11;
  HWY_ALIGN float values[kNumbers][kLanes];
  F* const columns[kNumbers - 1] = {
      &answer.separation, &answer.normal.x, &answer.normal.y, &answer.normal.z, &answer.arm_a.x,
      &answer.arm_a.y,    &answer.arm_a.z,  &answer.arm_b.x,  &answer.arm_b.y,  &answer.arm_b.z};
  for (size_t c = 0; c + 1 < kNumbers; ++c) hn::Store(*columns[c], FloatTag(), values[c]);
  hn::Store(hn::IfThenElseZero(degenerate, splat(1)), FloatTag(), values[kNumbers - 1]);
  for_each_lane(unsure, [&](size_t i) {
    const std::array<float, kNumbers> exact =
        exact_answer(rows.batch, rows.a, rows.b, rows.row + i);
    for (size_t c = 0; c < kNumbers; ++c) values[c][i] = exact[c];
  });
  for (size_t c = 0; c + 1 < kNumbers; ++c) *columns[c] = hn::Load(FloatTag(), values[c]);
  degenerate = hn::Ne(hn::Load(FloatTag(), values[kNumbers - 1]), splat(0));
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
