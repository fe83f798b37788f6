#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broadphase/grid/box_records.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "broadphase/grid/box_records.h"
#include "simd/gather-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// Half of every record: four numbers, beginning with number `first`.
struct RecordHalves {
  const BoxRecord* records;
  const uint32_t* order;
  size_t first;

  HWY_INLINE const float* half(size_t i) const {
    return reinterpret_cast<const float*>(records + order[i]) + first;
  }
#if HWY_TARGET != HWY_SCALAR
  HWY_INLINE hn::Vec<Quad> quad(size_t i) const { return hn::LoadU(Quad(), half(i)); }
#endif
  HWY_INLINE float component(size_t i, size_t c) const { return half(i)[c]; }
};

void write_row(const BoxRecord& record, size_t row, const RowColumns& columns) {
  for (size_t k = 0; k < 3; ++k) {
    columns.corners[k * columns.stride + row] = record.lower[k];
    columns.corners[(3 + k) * columns.stride + row] = record.upper[k];
  }
  columns.body[row] = record.body;
  columns.key[row] = record.key;
}

void write_columns(const BoxRecord* records, const uint32_t* order, size_t count,
                   const RowColumns& columns) {
  const FloatTag tag;
  size_t row = 0;
  for (; row + kLanes <= count; row += kLanes) {
    float* corner = columns.corners + row;
    F3 xyz;
    F w;
    transpose_records(RecordHalves{records, order + row, 0}, xyz, w);
    hn::StoreU(xyz.x, tag, corner);
    hn::StoreU(xyz.y, tag, corner + columns.stride);
    hn::StoreU(xyz.z, tag, corner + 2 * columns.stride);
    hn::StoreU(w, tag, corner + 3 * columns.stride);
    transpose_records(RecordHalves{records, order + row, 4}, xyz, w);
    hn::StoreU(xyz.x, tag, corner + 4 * columns.stride);
    hn::StoreU(xyz.y, tag, corner + 5 * columns.stride);
    const IntTag bits;
    hn::StoreU(hn::BitCast(bits, xyz.z), bits, reinterpret_cast<int32_t*>(columns.body + row));
    hn::StoreU(hn::BitCast(bits, w), bits, reinterpret_cast<int32_t*>(columns.key + row));
  }
  for (; row < count; ++row) write_row(records[order[row]], row, columns);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(write_columns);

}  // namespace

void write_columns(const BoxRecord* records, const uint32_t* order, size_t count,
                   const RowColumns& columns) {
  CAROM_DISPATCH(write_columns)(records, order, count, columns);
}

}  // namespace carom
#endif  // HWY_ONCE
