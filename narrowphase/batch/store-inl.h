// Stores lanes to columns of results.
#if defined(CAROM_NARROWPHASE_BATCH_STORE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_BATCH_STORE_INL_H_
#undef CAROM_NARROWPHASE_BATCH_STORE_INL_H_
#else
#define CAROM_NARROWPHASE_BATCH_STORE_INL_H_
#endif

#include <cstring>

#include "carom/results/contact.h"
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

// The results of one vector; the batch wants only the first `count` rows.
class TailColumns {
 public:
  ResultColumns columns() {
    return {overlap_, status_, floats_[0], column3(1), column3(4), column3(7)};
  }

  void copy_to(const ResultColumns& to, size_t row, size_t count, Detail detail) const {
    copy(overlap_, to.overlap, row, count);
    copy(status_, to.status, row, count);
    if (!has_contacts(detail)) return;
    copy(floats_[0], to.separation, row, count);
    for (size_t axis = 0; axis < 3; ++axis) {
      copy(floats_[1 + axis], to.normal[axis], row, count);
      copy(floats_[4 + axis], to.point_a[axis], row, count);
      copy(floats_[7 + axis], to.point_b[axis], row, count);
    }
  }

 private:
  std::array<float*, 3> column3(size_t i) { return {floats_[i], floats_[i + 1], floats_[i + 2]}; }

  template <class T>
  static void copy(const T* from, T* to, size_t row, size_t count) {
    std::memcpy(to + row, from, count * sizeof(T));
  }

  uint8_t overlap_[kLanes], status_[kLanes];
  float floats_[10][kLanes];
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_BATCH_STORE_INL_H_
