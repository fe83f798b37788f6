// The last rows of a batch, fewer than a vector has lanes. Compiled once an instruction set, in
// tail.cc, and not once a kernel.
#if defined(CAROM_NARROWPHASE_BATCH_TAIL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_BATCH_TAIL_INL_H_
#undef CAROM_NARROWPHASE_BATCH_TAIL_INL_H_
#else
#define CAROM_NARROWPHASE_BATCH_TAIL_INL_H_
#endif

#include "narrowphase/batch/batch.h"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Runs the rows from `first_row` on as a batch of one whole vector, filled up by repeating the last
// pair.
void run_tail(const Batch& batch, size_t first_row, void (*run)(const Batch&));

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_BATCH_TAIL_INL_H_
