// The recall pass of hulls against hulls, compiled apart from their other passes (recall.cc), which
// are the longest file as it is.
#if defined(CAROM_NARROWPHASE_HULLS_RECALL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_HULLS_RECALL_INL_H_
#undef CAROM_NARROWPHASE_HULLS_RECALL_INL_H_
#else
#define CAROM_NARROWPHASE_HULLS_RECALL_INL_H_
#endif

#include "narrowphase/batch/batch.h"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Runs Pass::recall.
void recall_hulls(const Batch& batch);

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_HULLS_RECALL_INL_H_
