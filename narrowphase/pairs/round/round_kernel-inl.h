// The kernels of round shapes share this.
#if defined(CAROM_NARROWPHASE_PAIRS_ROUND_ROUND_KERNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_PAIRS_ROUND_ROUND_KERNEL_INL_H_
#undef CAROM_NARROWPHASE_PAIRS_ROUND_ROUND_KERNEL_INL_H_
#else
#define CAROM_NARROWPHASE_PAIRS_ROUND_ROUND_KERNEL_INL_H_
#endif

#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/manifolds/manifold-inl.h"
#include "narrowphase/manifolds/round_points-inl.h"
#include "narrowphase/pairs/manifold_batch.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

struct RoundKernel {
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::everything;
  static constexpr Columns kColumns = Columns::as_asked;
};

// Manifolds in lanes, and one at a time what those leave.
template <class Kernel>
void run_round_kernel(const Batch& batch) {
  using A = typename Kernel::A;
  using B = typename Kernel::B;
  if (batch.pass == Pass::manifold) {
    return run_manifolds(batch, A::kKind, B::kKind, run_manifold<A, B>);
  }
  run_batch<Kernel>(batch);
}

// Manifolds one at a time.
template <class Kernel>
void run_round_tests(const Batch& batch) {
  if (batch.pass == Pass::manifold) {
    return run_manifolds_one_by_one(batch, Kernel::A::kKind, Kernel::B::kKind);
  }
  run_batch<Kernel>(batch);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_PAIRS_ROUND_ROUND_KERNEL_INL_H_
