#include "narrowphase/lane_validity.h"

#include "kernel/body_reader.h"

namespace carom {
namespace {

Collidables view_of(const BatchSide& side, PositionLayout layout, ShapeKind kind) {
  Collidables view;
  view.position.data = side.records;
  view.position.stride = side.record_stride;
  view.position.type =
      layout == PositionLayout::records64 ? PositionType::float64 : PositionType::float32;
  view.uniform_kind = kind;
  view.boxes = side.boxes;
  view.box_slot = side.box_slot;
  return view;
}

bool is_valid(const BatchSide& side, PositionLayout layout, ShapeKind kind, size_t index) {
  const Collidables view = view_of(side, layout, kind);
  return BodyReader{view}.is_valid(index);
}

}  // namespace

bool is_valid_pair(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b, size_t row) {
  const Pair pair = batch.pairs[row];
  return is_valid(batch.a, batch.layout, kind_a, pair.a) &&
         is_valid(batch.b, batch.layout, kind_b, pair.b);
}

}  // namespace carom
