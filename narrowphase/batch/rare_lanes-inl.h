// What a batch seldom does in lanes: it ends with part of a vector, or some lanes are invalid or
// unsure. Compiled once an instruction set, in rare_lanes.cc, and not once a kernel.
#if defined(CAROM_NARROWPHASE_BATCH_RARE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_BATCH_RARE_LANES_INL_H_
#undef CAROM_NARROWPHASE_BATCH_RARE_LANES_INL_H_
#else
#define CAROM_NARROWPHASE_BATCH_RARE_LANES_INL_H_
#endif

#include "narrowphase/batch/batch.h"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

struct AnswerLanes {
  F separation;
  F3 normal, arm_a, arm_b;
};

// The kinds of the pairs from row `row` on.
struct RowsOfKinds {
  const Batch& batch;
  ShapeKind a, b;
  size_t row;
};

// Runs the rows from `first_row` on, fewer than kLanes, as a batch of one whole vector, filled up
// by repeating the last pair.
void run_tail(const Batch& batch, size_t first_row, void (*run)(const Batch&));

// The lanes whose pairs are valid.
void find_valid(const RowsOfKinds& rows, Mask& valid);

// Computes the lanes of `unsure` again in double precision: the separation, or all of the answer
// and whether it is degenerate.
void refine_separation(const RowsOfKinds& rows, const Mask& unsure, F& separation);
void refine_all(const RowsOfKinds& rows, const Mask& unsure, AnswerLanes& answer,
                Mask& degenerate);

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_BATCH_RARE_LANES_INL_H_
