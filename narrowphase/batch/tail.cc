#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/batch/tail.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/column_memory.h"
#include "narrowphase/batch/tail-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
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

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
