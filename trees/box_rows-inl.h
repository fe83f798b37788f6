// Four boxes between rows, a TreeBox each, and columns, a coordinate of all four each. Not for the
// scalar target, which has one lane.
#if defined(CAROM_TREES_BOX_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_TREES_BOX_ROWS_INL_H_
#undef CAROM_TREES_BOX_ROWS_INL_H_
#else
#define CAROM_TREES_BOX_ROWS_INL_H_
#endif

#include <cstddef>

#include "simd/gather-inl.h"
#include "trees/tree.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR

using RowOfFour = hn::Vec<Quad>;

// Turns four rows into columns, or back. transpose_records() does the same to whole vectors; code
// that both shared gave the kernels other registers.
HWY_INLINE void transpose(RowOfFour (&v)[4]) {
  const Quad tag;
  const RowOfFour low_even = hn::InterleaveLower(tag, v[0], v[2]);
  const RowOfFour low_odd = hn::InterleaveLower(tag, v[1], v[3]);
  const RowOfFour high_even = hn::InterleaveUpper(tag, v[0], v[2]);
  const RowOfFour high_odd = hn::InterleaveUpper(tag, v[1], v[3]);
  v[0] = hn::InterleaveLower(tag, low_even, low_odd);
  v[1] = hn::InterleaveUpper(tag, low_even, low_odd);
  v[2] = hn::InterleaveLower(tag, high_even, high_odd);
  v[3] = hn::InterleaveUpper(tag, high_even, high_odd);
}

// The six numbers of a box as two vectors, of which two numbers are in both.
struct BoxRow {
  RowOfFour first;   // lower x, y, z and upper x
  RowOfFour second;  // lower z and upper x, y, z
};

static_assert(sizeof(TreeBox) == 6 * sizeof(float));

HWY_INLINE BoxRow load_row(const TreeBox& box) {
  const float* const numbers = box.lower.data();
  return {hn::LoadU(Quad(), numbers), hn::LoadU(Quad(), numbers + 2)};
}

HWY_INLINE void store_row(const BoxRow& row, TreeBox& box) {
  float* const numbers = box.lower.data();
  hn::StoreU(row.first, Quad(), numbers);
  hn::StoreU(row.second, Quad(), numbers + 2);
}

#endif  // HWY_TARGET
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_TREES_BOX_ROWS_INL_H_
