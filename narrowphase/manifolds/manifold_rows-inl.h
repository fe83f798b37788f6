// Stores manifolds, which are columns in lanes, as rows: each in as few pieces as vectors allow.
#if defined(CAROM_NARROWPHASE_MANIFOLDS_MANIFOLD_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_MANIFOLDS_MANIFOLD_ROWS_INL_H_
#undef CAROM_NARROWPHASE_MANIFOLDS_MANIFOLD_ROWS_INL_H_
#else
#define CAROM_NARROWPHASE_MANIFOLDS_MANIFOLD_ROWS_INL_H_
#endif

#include <cstddef>

#include "carom/results/contact.h"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

inline constexpr size_t kManifoldColumns = sizeof(ManifoldPoints) / sizeof(float);
static_assert(kManifoldColumns == 16);

#if HWY_TARGET != HWY_SCALAR
// Block b of quads[k] gets the numbers that four columns have in lane 4 b + k.
HWY_INLINE void interleave_four(const F* column, F (&quads)[4]) {
  const FloatTag tag;
  const hn::RepartitionToWide<FloatTag> wide;
  const auto pairs = [&](F v) HWY_ATTR { return hn::BitCast(wide, v); };
  const auto low_xy = pairs(hn::InterleaveLower(tag, column[0], column[1]));
  const auto low_zw = pairs(hn::InterleaveLower(tag, column[2], column[3]));
  const auto high_xy = pairs(hn::InterleaveUpper(tag, column[0], column[1]));
  const auto high_zw = pairs(hn::InterleaveUpper(tag, column[2], column[3]));
  quads[0] = hn::BitCast(tag, hn::InterleaveLower(wide, low_xy, low_zw));
  quads[1] = hn::BitCast(tag, hn::InterleaveUpper(wide, low_xy, low_zw));
  quads[2] = hn::BitCast(tag, hn::InterleaveLower(wide, high_xy, high_zw));
  quads[3] = hn::BitCast(tag, hn::InterleaveUpper(wide, high_xy, high_zw));
}

// Stores the rows 4 b + k, of which block b of quarter[q] is a quarter.
HWY_INLINE void store_blocks(const F (&quarter)[4], float* const* rows) {
  const FloatTag tag;
  if constexpr (kLanes == 16) {
    const F even_low = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(quarter[1]), quarter[0]);
    const F even_high = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(quarter[3]), quarter[2]);
    const F odd_low = hn::OddEvenBlocks(quarter[1], hn::SwapAdjacentBlocks(quarter[0]));
    const F odd_high = hn::OddEvenBlocks(quarter[3], hn::SwapAdjacentBlocks(quarter[2]));
    hn::StoreU(hn::ConcatLowerLower(tag, even_high, even_low), tag, rows[0]);
    hn::StoreU(hn::ConcatLowerLower(tag, odd_high, odd_low), tag, rows[4]);
    hn::StoreU(hn::ConcatUpperUpper(tag, even_high, even_low), tag, rows[8]);
    hn::StoreU(hn::ConcatUpperUpper(tag, odd_high, odd_low), tag, rows[12]);
  } else if constexpr (kLanes == 8) {
    for (size_t half = 0; half < 2; ++half) {
      const F low = quarter[2 * half], high = quarter[2 * half + 1];
      hn::StoreU(hn::ConcatLowerLower(tag, high, low), tag, rows[0] + 8 * half);
      hn::StoreU(hn::ConcatUpperUpper(tag, high, low), tag, rows[4] + 8 * half);
    }
  } else {
    for (size_t q = 0; q < 4; ++q) hn::StoreU(quarter[q], tag, rows[0] + 4 * q);
  }
}
#endif  // HWY_TARGET

// Stores lane i of the columns as the kManifoldColumns numbers at rows[i].
HWY_INLINE void store_rows(const F (&columns)[kManifoldColumns], float* const (&rows)[kLanes]) {
#if HWY_TARGET == HWY_SCALAR
  for (size_t c = 0; c < kManifoldColumns; ++c) hn::StoreU(columns[c], FloatTag(), rows[0] + c);
#else
  F quads[4][4];
  for (size_t q = 0; q < 4; ++q) interleave_four(columns + 4 * q, quads[q]);
  for (size_t k = 0; k < 4; ++k) {
    store_blocks({quads[0][k], quads[1][k], quads[2][k], quads[3][k]}, rows + k);
  }
#endif
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_MANIFOLDS_MANIFOLD_ROWS_INL_H_
