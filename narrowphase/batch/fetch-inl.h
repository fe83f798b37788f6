// Asks for the bodies of a list of pairs some pairs before they are loaded.
//
// The second bodies of sorted pairs lie anywhere in memory. A processor looks ahead over less than
// a vector of pairs, and would wait for the memory of each vector in turn.
#if defined(CAROM_NARROWPHASE_BATCH_FETCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_BATCH_FETCH_INL_H_
#undef CAROM_NARROWPHASE_BATCH_FETCH_INL_H_
#else
#define CAROM_NARROWPHASE_BATCH_FETCH_INL_H_
#endif

#include <hwy/cache_control.h>

#include <algorithm>

#include "narrowphase/batch/batch.h"
#include "narrowphase/batch/shape_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// Two vectors of the widest target, so that what the last part asks for has the time of a whole
// vector to come.
constexpr size_t kPairsAhead = 2 * kMostLanes;

// For each body, where its shape lies; nullptr if that follows from the index of the body.
template <class Shape>
HWY_INLINE const uint32_t* places_of_shapes(const BatchSide& side) {
  if constexpr (Shape::kKind == ShapeKind::aabb) return side.box_slot;
  if constexpr (row_count(Shape::kKind) > 0) return side.rows.first;
  return nullptr;
}

HWY_INLINE void fetch_box(const AabbColumns& boxes, size_t slot) {
  if (boxes.are_records) return hwy::Prefetch(boxes.lower[0] + 8 * slot);
  const size_t offset = slot * boxes.stride;
  for (size_t axis = 0; axis < 3; ++axis) {
    hwy::Prefetch(reinterpret_cast<const char*>(boxes.lower[axis]) + offset);
    hwy::Prefetch(reinterpret_cast<const char*>(boxes.upper[axis]) + offset);
  }
}

template <class Shape>
HWY_INLINE void fetch_body(const BatchSide& side, size_t body) {
  hwy::Prefetch(static_cast<const char*>(side.records) + body * side.record_stride);
  if constexpr (Shape::kIsOriented) {
    hwy::Prefetch(reinterpret_cast<const char*>(side.orientation.data) +
                  body * side.orientation.stride);
  }
  if constexpr (Shape::kKind == ShapeKind::aabb) {
    fetch_box(side.boxes, side.box_slot ? side.box_slot[body] : body);
  } else if constexpr (constexpr uint32_t kRows = row_count(Shape::kKind); kRows > 0) {
    const size_t first = side.rows.first ? side.rows.first[body] : body * kRows;
    hwy::Prefetch(side.rows.data + 4 * first);
  }
}

// Some of the lanes of a vector.
struct LaneRange {
  size_t begin, end;
};

// Asks for one side of the pairs at `near`, and for the places of their shapes at `far`.
template <Role kRole, class Shape>
HWY_INLINE void fetch_side(const BatchSide& side, const Listed& near, const Listed& far,
                           LaneRange lanes) {
  if (const uint32_t* const places = places_of_shapes<Shape>(side)) {
    for (size_t i = lanes.begin; i < lanes.end; ++i) {
      hwy::Prefetch(places + far.template body<kRole>(i));
    }
  }
  for (size_t i = lanes.begin; i < lanes.end; ++i) {
    fetch_body<Shape>(side, near.template body<kRole>(i));
  }
}

// One body in so many is asked for, where rows follow one another: records and orientations of 16
// bytes then share a line of the cache.
constexpr size_t kRowsInLine = 4;

// The same of both sides. Processors see by themselves that one row follows the other, but not
// across pages of memory.
template <class A, class B>
HWY_INLINE void fetch_lanes(const Batch& batch, size_t row, LaneRange lanes) {
  if (row + kPairsAhead + kLanes > batch.count) return;
  const Listed near{batch.pairs + row + kPairsAhead};
  if (batch.pairs_are_rows) {
    if (lanes.begin % kRowsInLine != 0) return;
    fetch_body<A>(batch.a, near.template body<Role::a>(lanes.begin));
    fetch_body<B>(batch.b, near.template body<Role::b>(lanes.begin));
    return;
  }
  const size_t last = batch.count - kLanes;
  const Listed far{batch.pairs + std::min(row + 2 * kPairsAhead, last)};
  fetch_side<Role::a, A>(batch.a, near, far, lanes);
  fetch_side<Role::b, B>(batch.b, near, far, lanes);
}

// To be called before the vector of pairs at `row` is loaded.
template <class A, class B>
HWY_INLINE void fetch_ahead(const Batch& batch, size_t row) {
  fetch_lanes<A, B>(batch, row, {0, kLanes});
}

// The same in parts, each to be called once, between pieces of the work on that vector. A processor
// fetches some ten lines at a time; asked for more at once, it waits until there is room.
constexpr size_t kFetchParts = 4;
template <class A, class B, size_t kPart>
HWY_INLINE void fetch_part(const Batch& batch, size_t row) {
  constexpr size_t kBegin = kPart * kLanes / kFetchParts;
  constexpr size_t kEnd = (kPart + 1) * kLanes / kFetchParts;
  if constexpr (kBegin < kEnd) fetch_lanes<A, B>(batch, row, {kBegin, kEnd});
}

// Whether Kernel::test() calls the parts, and not the loop.
template <class Kernel>
constexpr bool test_fetches() {
  if constexpr (requires { Kernel::kTestFetches; }) return Kernel::kTestFetches;
  return false;
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_BATCH_FETCH_INL_H_
