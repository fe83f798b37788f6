#include "cli/scenes/scene_bounds.h"

#include "carom/bounds/bounds.h"
#include "cli/scenes/shapes.h"
#include "io/recording.h"

namespace carom::cli {

SceneBounds::SceneBounds(const io::SceneInfo& info)
    : info_(info), boxes_(io::kFloatsPerBox * info.bodies) {
  for (Columns* columns : {&half_, &negative_half_, &lower_, &upper_}) {
    for (std::vector<float>& column : *columns) column.resize(info.bodies);
  }
  for (size_t i = 0; i < info.bodies; ++i) {
    const std::array<float, 8>& params = info.shapes.params[info.body_shape[i]];
    for (size_t axis = 0; axis < 3; ++axis) {
      half_[axis][i] = params[axis];
      negative_half_[axis][i] = -params[axis];
    }
  }
  add_rows();
}

void SceneBounds::add_rows() {
  const uint32_t count = row_count(kind());
  if (count == 0) return;
  shapes_ = *convert_shapes(info_.shapes, info_.name);
  for (uint32_t shape : info_.body_shape) {
    const auto rows = shape_rows(shapes_[shape]);
    rows_.insert(rows_.end(), rows.begin(), rows.begin() + count);
  }
}

ShapeKind SceneBounds::kind() const {
  const auto kind = static_cast<ShapeKind>(info_.shapes.kind.front());
  if (info_.shapes.rounding.empty()) return kind;
  return kind == ShapeKind::box    ? ShapeKind::rounded_box
         : kind == ShapeKind::hull ? ShapeKind::rounded_hull
                                   : kind;
}

const std::vector<float>& SceneBounds::boxes(const io::SceneFrame& frame) {
  BoundsColumns columns;
  for (size_t axis = 0; axis < 3; ++axis) {
    columns.lower[axis] = lower_[axis].data();
    columns.upper[axis] = upper_[axis].data();
  }
  compute_bounds(view(frame), columns);
  for (size_t i = 0; i < info_.bodies; ++i) {
    float* box = &boxes_[io::kFloatsPerBox * i];
    for (size_t axis = 0; axis < 3; ++axis) {
      box[axis] = lower_[axis][i];
      box[4 + axis] = upper_[axis][i];
    }
  }
  return boxes_;
}

Collidables SceneBounds::view(const io::SceneFrame& frame) const {
  Collidables bodies;
  bodies.count = info_.bodies;
  bodies.uniform_kind = kind();
  bodies.position.radius_layout = RadiusLayout::column;
  bodies.position.radius = half_[0].data();
  if (info_.float64_positions) {
    bodies.position.data = frame.position64.data();
    bodies.position.stride = 3 * sizeof(double);
    bodies.position.type = PositionType::float64;
  } else {
    bodies.position.data = frame.position32.data();
    bodies.position.stride = 3 * sizeof(float);
  }
  for (size_t axis = 0; axis < 3; ++axis) {
    bodies.boxes.lower[axis] = negative_half_[axis].data();
    bodies.boxes.upper[axis] = half_[axis].data();
  }
  if (!rows_.empty()) {
    bodies.orientation.data = frame.orientation.data();
    bodies.rows.data = rows_.front().data();
  }
  return bodies;
}

}  // namespace carom::cli
