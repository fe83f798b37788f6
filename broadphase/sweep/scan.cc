#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broadphase/sweep/scan.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "broadphase/sweep/scan.h"
#include "simd/compress-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// One box in every lane.
struct BoxLanes {
  F lower[3], upper[3];

  explicit HWY_INLINE BoxLanes(const SearchBox& box)
      : lower{splat(box.lower[0]), splat(box.lower[1]), splat(box.lower[2])},
        upper{splat(box.upper[0]), splat(box.upper[1]), splat(box.upper[2])} {}
};

// Which rows from `row` on start before the box ends on an axis, or as it ends.
HWY_INLINE Mask starts_before_end(const BoxColumns& columns, const BoxLanes& box, size_t axis,
                                  size_t row) {
  return hn::Le(hn::LoadU(FloatTag(), columns.lower[axis].data() + row), box.upper[axis]);
}

HWY_INLINE Mask ends_after_start(const BoxColumns& columns, const BoxLanes& box, size_t axis,
                                 size_t row) {
  return hn::Ge(hn::LoadU(FloatTag(), columns.upper[axis].data() + row), box.lower[axis]);
}

// Collects the hits of one box, and hands them to the sink in portions.
class Hits {
 public:
  HWY_INLINE Hits(size_t box_row, HitSink& sink) : box_row_(box_row), sink_(sink) {}

  HWY_INLINE void add(Mask mask, size_t row) {
    const IndexTag tag;
    const Indices rows = hn::Add(hn::Iota(tag, 0), hn::Set(tag, static_cast<uint32_t>(row)));
    count_ += compress_store(rows, mask, rows_ + count_);
    if (HWY_UNLIKELY(count_ > HitSink::kMaxHits - kLanes)) flush();
  }

  HWY_INLINE void flush() {
    if (count_ > 0) sink_.add(box_row_, rows_, count_);
    count_ = 0;
  }

 private:
  size_t box_row_;
  HitSink& sink_;
  size_t count_ = 0;
  uint32_t rows_[HitSink::kMaxHits + kLanes];  // whole vectors are written
};

enum class RowOrder { any, ascending };  // by lower[0]

template <RowOrder kOrder>
HWY_INLINE void scan_from(const BoxColumns& columns, const SearchBox& box, size_t box_row,
                          size_t first_row, size_t end, HitSink& sink) {
  const FloatTag tag;
  const BoxLanes lanes(box);
  Hits hits(box_row, sink);
  for (size_t row = first_row; row < end; row += kLanes) {
    const Mask reached = starts_before_end(columns, lanes, 0, row);
    if (kOrder == RowOrder::ascending && hn::AllFalse(tag, reached)) break;
    const Mask x = hn::And(reached, ends_after_start(columns, lanes, 0, row));
    const Mask y = hn::And(starts_before_end(columns, lanes, 1, row),
                           ends_after_start(columns, lanes, 1, row));
    const Mask z = hn::And(starts_before_end(columns, lanes, 2, row),
                           ends_after_start(columns, lanes, 2, row));
    const Mask hit = hn::And(x, hn::And(y, z));
    if (HWY_UNLIKELY(!hn::AllFalse(tag, hit))) hits.add(hit, row);
  }
  hits.flush();
}

HWY_INLINE SearchBox box_at(const BoxColumns& columns, size_t row) {
  return {{columns.lower[0][row], columns.lower[1][row], columns.lower[2][row]},
          {columns.upper[0][row], columns.upper[1][row], columns.upper[2][row]}};
}

template <RowOrder kOrder>
void scan_rows(const BoxColumns& columns, size_t begin, size_t end, size_t last, HitSink& sink) {
  for (size_t row = begin; row < end; ++row) {
    scan_from<kOrder>(columns, box_at(columns, row), row, row + 1, last, sink);
  }
}

void sweep_rows(const BoxColumns& columns, size_t begin, size_t end, HitSink& sink) {
  scan_rows<RowOrder::ascending>(columns, begin, end, columns.count, sink);
}

void test_rows(const BoxColumns& columns, size_t begin, size_t end, size_t last, HitSink& sink) {
  scan_rows<RowOrder::any>(columns, begin, end, last, sink);
}

void sweep_box(const BoxColumns& columns, const SearchBox& box, size_t box_row, size_t first_row,
               HitSink& sink) {
  scan_from<RowOrder::ascending>(columns, box, box_row, first_row, columns.count, sink);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(sweep_rows);
HWY_EXPORT(test_rows);
HWY_EXPORT(sweep_box);

}  // namespace

void sweep_rows(const BoxColumns& columns, size_t begin, size_t end, HitSink& sink) {
  CAROM_DISPATCH(sweep_rows)(columns, begin, end, sink);
}

void test_rows(const BoxColumns& columns, size_t begin, size_t end, size_t last, HitSink& sink) {
  CAROM_DISPATCH(test_rows)(columns, begin, end, last, sink);
}

void sweep_box(const BoxColumns& columns, const SearchBox& box, size_t box_row, size_t first_row,
               HitSink& sink) {
  CAROM_DISPATCH(sweep_box)(columns, box, box_row, first_row, sink);
}

}  // namespace carom
#endif  // HWY_ONCE
