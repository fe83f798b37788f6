#include "cli/body_columns.h"

#include <algorithm>

namespace carom::cli {

void BodyColumns::reserve(size_t count) {
  if (positions_ == PositionType::float64) {
    record64_.reserve(4 * count);
  } else {
    record32_.reserve(4 * count);
  }
  kind_.reserve(count);
  for (auto& column : lower_) column.reserve(count);
  for (auto& column : upper_) column.reserve(count);
}

void BodyColumns::push(const Shape& shape, const Eigen::Vector3d& position) {
  const Sphere* sphere = std::get_if<Sphere>(&shape);
  const Aabb box = sphere ? Aabb{} : std::get<Aabb>(shape);
  const float radius = sphere ? sphere->radius : 0;
  kind_.push_back(sphere ? ShapeKind::sphere : ShapeKind::aabb);
  for (int axis = 0; axis < 3; ++axis) {
    lower_[axis].push_back(box.lower[axis]);
    upper_[axis].push_back(box.upper[axis]);
  }
  if (positions_ == PositionType::float64) {
    record64_.insert(record64_.end(), {position.x(), position.y(), position.z(), radius});
  } else {
    Eigen::Vector3f rounded = position.cast<float>();
    record32_.insert(record32_.end(), {rounded.x(), rounded.y(), rounded.z(), radius});
  }
}

Shape BodyColumns::shape(size_t index) const {
  if (kind_[index] == ShapeKind::sphere) {
    return Sphere{positions_ == PositionType::float64 ? static_cast<float>(record64_[4 * index + 3])
                                                      : record32_[4 * index + 3]};
  }
  return Aabb{{lower_[0][index], lower_[1][index], lower_[2][index]},
              {upper_[0][index], upper_[1][index], upper_[2][index]}};
}

Eigen::Vector3d BodyColumns::position(size_t index) const {
  if (positions_ == PositionType::float64) {
    return Eigen::Map<const Eigen::Vector3d>(&record64_[4 * index]);
  }
  return Eigen::Map<const Eigen::Vector3f>(&record32_[4 * index]).cast<double>();
}

Collidables BodyColumns::view() const {
  Collidables bodies;
  bodies.count = size();
  bodies.position.type = positions_;
  if (positions_ == PositionType::float64) {
    bodies.position.data = record64_.data();
    bodies.position.stride = 4 * sizeof(double);
  } else {
    bodies.position.data = record32_.data();
    bodies.position.stride = 4 * sizeof(float);
  }
  if (!kind_.empty()) bodies.uniform_kind = kind_.front();
  bool uniform = std::all_of(kind_.begin(), kind_.end(),
                             [&](ShapeKind kind) { return kind == bodies.uniform_kind; });
  if (!uniform) bodies.kind = kind_.data();
  for (int axis = 0; axis < 3; ++axis) {
    bodies.boxes.lower[axis] = lower_[axis].data();
    bodies.boxes.upper[axis] = upper_[axis].data();
  }
  return bodies;
}

}  // namespace carom::cli
