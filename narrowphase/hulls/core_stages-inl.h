// Runs GJK in lanes in two stages. A vector takes as many rounds as its slowest lane. So the first
// stage stops when few lanes are open, and the second packs the open lanes of many vectors
// together.
#if defined(CAROM_NARROWPHASE_HULLS_CORE_STAGES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_HULLS_CORE_STAGES_INL_H_
#undef CAROM_NARROWPHASE_HULLS_CORE_STAGES_INL_H_
#else
#define CAROM_NARROWPHASE_HULLS_CORE_STAGES_INL_H_
#endif

#include <array>
#include <cstdint>

#include "narrowphase/batch/row_selection.h"
#include "narrowphase/hulls/core_kernel-inl.h"
#include "narrowphase/hulls/open_searches.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

template <class Kernel>
void run_rest(const Batch& batch, OpenSearches& open) {
  RowSelection left(batch);
  left.select(open.row.data(), open.count);
  for (auto& column : open.column) {
    for (size_t i = open.count; i < left.padded_count(); ++i) column[i] = column[open.count - 1];
  }
  TestColumns scratch;
  std::array<uint8_t, kPairsPerBlock> unsure{};
  std::array<uint64_t, kPairsPerBlock> features;
  Batch rest = left.batch(batch.pass);
  rest.open = &open;
  rest.count = left.padded_count();
  rest.unsure = unsure.data();
  rest.out = scratch.columns();
  if (batch.features) rest.features = features.data();
  run_batch<Kernel>(rest);
  left.scatter(rest.out, batch.out, batch.detail);
  left.scatter(unsure.data(), batch.unsure);
  if (batch.features) left.scatter(features.data(), batch.features);
}

// As CoreKernel in one stage. Somebody asks which rows are unsure.
template <class A, class B, bool kDecides>
void run_core(const Batch& batch) {
  if constexpr (kFewOpen == 0) {
    run_batch<CoreKernel<A, B, kDecides, Stage::whole>>(batch);
  } else {
    OpenSearches open;
    Batch first = batch;
    first.open = &open;
    run_batch<CoreKernel<A, B, kDecides, Stage::first>>(first);
    if (open.count > 0) run_rest<CoreKernel<A, B, kDecides, Stage::rest>>(batch, open);
  }
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_HULLS_CORE_STAGES_INL_H_
