// Four rows at a time, without branches, since half of the pairs may touch.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/manifolds/witness_points.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <cstddef>

#include "base/fetch_ahead.h"
#include "narrowphase/manifolds/witness_points.h"
#include "trees/box_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

void copy_row(const Batch& batch, size_t row) {
  const ResultColumns& out = batch.out;
  const bool has_point = touches(batch, row);
  ManifoldPoints points{};
  if (has_point) {
    points.point[0] = {out.point_a[0][row], out.point_a[1][row], out.point_a[2][row]};
    points.separation[0] = out.separation[row];
  }
  out.manifold[row] = points;
  out.manifold_count[row] = has_point;
}

#if HWY_TARGET != HWY_SCALAR
using QuadOfInts = hn::FixedTag<uint32_t, 4>;

// Manifolds are asked for in the cache so long before they are written.
constexpr size_t kManifoldsAhead = 64;

static_assert(offsetof(ManifoldPoints, separation) == 12 * sizeof(float));

// Stores a manifold of one point (x, y, z, separation), a line of the cache, in as few pieces as
// vectors allow.
HWY_INLINE void store_point(RowOfFour point, float* numbers) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
  const FloatTag tag;
  // Which of the four each number is; those behind them are zeros.
  alignas(64) static constexpr int32_t kSource[16] = {0, 1, 2, 4, 4, 4, 4, 4,
                                                      4, 4, 4, 4, 3, 4, 4, 4};
#if HWY_TARGET == HWY_AVX3
  const F source = hn::ZeroExtendVector(tag, hn::ZeroExtendVector(hn::Half<FloatTag>(), point));
#else
  const F source = hn::ZeroExtendVector(tag, point);
#endif
  for (size_t i = 0; i < 16; i += kLanes) {
    const auto from = hn::SetTableIndices(tag, kSource + i);
    hn::StoreU(hn::TableLookupLanes(source, from), tag, numbers + i);
  }
#else
  const Quad tag;
  const QuadOfInts ints;
  const RowOfFour separation =
      hn::BitCast(tag, hn::ShiftRightLanes<3>(ints, hn::BitCast(ints, point)));
  hn::StoreU(hn::IfThenElseZero(hn::FirstN(tag, 3), point), tag, numbers);
  hn::StoreU(hn::Zero(tag), tag, numbers + 4);
  hn::StoreU(hn::Zero(tag), tag, numbers + 8);
  hn::StoreU(separation, tag, numbers + 12);
#endif
}

HWY_INLINE void copy_four(const Batch& batch, size_t row) {
  const ResultColumns& out = batch.out;
  const Quad tag;
  const QuadOfInts ints;
  const hn::FixedTag<uint8_t, 4> bytes;
  const RowOfFour separation = hn::LoadU(tag, out.separation + row);
  const auto overlap = hn::PromoteTo(ints, hn::LoadU(bytes, out.overlap + row));
  auto has_point = hn::Eq(overlap, hn::Set(ints, 1));
  if (batch.reach) {
    const auto near = hn::Le(separation, hn::LoadU(tag, batch.reach + row));
    const auto apart = hn::Eq(overlap, hn::Zero(ints));
    has_point = hn::Or(has_point, hn::And(apart, hn::RebindMask(ints, near)));
  }
  const auto if_has_point = [&](RowOfFour v) HWY_ATTR {
    return hn::IfThenElseZero(hn::RebindMask(tag, has_point), v);
  };
  RowOfFour point[4];  // first columns, then x, y, z and separation of each row
  for (size_t axis = 0; axis < 3; ++axis) {
    point[axis] = if_has_point(hn::LoadU(tag, out.point_a[axis] + row));
  }
  point[3] = if_has_point(separation);
  transpose(point);
  for (size_t k = 0; k < 4; ++k) {
    fetch_to_write(out.manifold + row + k, kManifoldsAhead);
    store_point(point[k], reinterpret_cast<float*>(out.manifold + row + k));
  }
  const auto counts = hn::And(hn::VecFromMask(ints, has_point), hn::Set(ints, 1));
  hn::StoreU(hn::DemoteTo(bytes, hn::BitCast(hn::FixedTag<int32_t, 4>(), counts)), bytes,
             out.manifold_count + row);
}
#endif  // HWY_TARGET

void copy_rows(const Batch& batch) {
  const Batch local = batch;  // see BatchLoop
  size_t row = 0;
#if HWY_TARGET != HWY_SCALAR
  for (; row + 4 <= local.count; row += 4) copy_four(local, row);
#endif  // HWY_TARGET
  for (; row < local.count; ++row) copy_row(local, row);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(copy_rows);

}  // namespace

void copy_witnesses(const Batch& batch) { CAROM_DISPATCH(copy_rows)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
