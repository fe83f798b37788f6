// Stores lanes to columns of results.
#if defined(CAROM_NARROWPHASE_BATCH_STORE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_BATCH_STORE_INL_H_
#undef CAROM_NARROWPHASE_BATCH_STORE_INL_H_
#else
#define CAROM_NARROWPHASE_BATCH_STORE_INL_H_
#endif

#include <array>
#include <cstddef>
#include <cstdint>

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// `value` where the mask is set, 0 elsewhere.
HWY_INLINE I bytes_where(Mask mask, int32_t value) {
  const IntTag tag;
  return hn::And(hn::BitCast(tag, hn::VecFromMask(FloatTag(), mask)), hn::Set(tag, value));
}

HWY_INLINE void store(F v, float* column, size_t row) { hn::StoreU(v, FloatTag(), column + row); }

HWY_INLINE void store(const F3& v, const std::array<float*, 3>& columns, size_t row) {
  store(v.x, columns[0], row);
  store(v.y, columns[1], row);
  store(v.z, columns[2], row);
}

HWY_INLINE void store_bytes(I v, uint8_t* column, size_t row) {
  const hn::Rebind<uint8_t, IntTag> bytes;
  hn::StoreU(hn::DemoteTo(bytes, v), bytes, column + row);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_BATCH_STORE_INL_H_
