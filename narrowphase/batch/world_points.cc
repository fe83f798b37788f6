#include "narrowphase/batch/world_points.h"

#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/batch/world_points.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/load-inl.h"
#include "narrowphase/batch/store-inl.h"
#include "simd/axis-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

HWY_INLINE void move_points(const std::array<float*, 3>& columns, size_t row, const F3& position,
                            const F3& low) {
  const auto column = [&](size_t axis)
                          HWY_ATTR { return hn::LoadU(FloatTag(), columns[axis] + row); };
  const F3 arm = {column(0), column(1), column(2)};
  const Mask3 has_answer = {hn::Eq(arm.x, arm.x), hn::Eq(arm.y, arm.y), hn::Eq(arm.z, arm.z)};
  store(select(has_answer, position + (low + arm), arm), columns, row);
}

// A NaN (no answer) keeps its bits, wherever the body is.
void move_rows(const Batch& batch, size_t& row) {
  for (; row + kLanes <= batch.count; row += kLanes) {
    PositionLanes positions;
    AnyRecordsOrNone::load(batch, Listed{batch.pairs + row}, positions);
    move_points(batch.out.point_a, row, positions.a, positions.a_low);
    move_points(batch.out.point_b, row, positions.b, positions.b_low);
  }
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "narrowphase/batch/single_pair.h"
#include "narrowphase/batch/world_point.h"
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(move_rows);

void move_row(const Collidables& bodies, uint32_t body, const std::array<float*, 3>& columns,
              size_t row) {
  const auto moved =
      world_point(BodyReader{bodies}, body, {columns[0][row], columns[1][row], columns[2][row]});
  for (size_t axis = 0; axis < 3; ++axis) columns[axis][row] = moved[axis];
}

}  // namespace

void move_to_world(const Batch& batch) {
  size_t row = 0;
  CAROM_DISPATCH(move_rows)(batch, row);
  // The list of pairs may end here.
  const Collidables a = view_of(batch.a, batch.layout, ShapeKind::box);
  const Collidables b = view_of(batch.b, batch.layout, ShapeKind::box);
  for (; row < batch.count; ++row) {
    move_row(a, batch.pairs[row].a, batch.out.point_a, row);
    move_row(b, batch.pairs[row].b, batch.out.point_b, row);
  }
}

}  // namespace carom
#endif  // HWY_ONCE
