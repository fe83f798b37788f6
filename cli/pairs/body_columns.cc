#include "cli/pairs/body_columns.h"

#include <algorithm>

namespace carom::cli {
namespace {

// nullptr for shapes without geometry.
std::shared_ptr<const void> geometry_of(const Shape& shape) {
  if (const Hull* hull = std::get_if<Hull>(&shape)) return hull->geometry;
  if (const Mesh* mesh = std::get_if<Mesh>(&shape)) return mesh->geometry;
  if (const HeightField* field = std::get_if<HeightField>(&shape)) return field->geometry;
  if (const Compound* compound = std::get_if<Compound>(&shape)) return compound->geometry;
  return nullptr;
}

}  // namespace

void BodyColumns::reserve(size_t count) {
  if (positions_ == PositionType::float64) {
    record64_.reserve(4 * count);
  } else {
    record32_.reserve(4 * count);
  }
  kind_.reserve(count);
  first_row_.reserve(count);
  for (auto& column : lower_) column.reserve(count);
  for (auto& column : upper_) column.reserve(count);
}

void BodyColumns::push(const Shape& shape, const Pose& pose) {
  const Sphere* sphere = std::get_if<Sphere>(&shape);
  const Aabb* box = std::get_if<Aabb>(&shape);
  push_position(pose.position, sphere ? sphere->radius : 0);
  push_box(box ? *box : Aabb{});
  push_rows(shape, pose.orientation);
  kind_.push_back(kind_of(shape));
  if (auto geometry = geometry_of(shape)) geometries_.insert(std::move(geometry));
}

void BodyColumns::push_position(const Eigen::Vector3d& position, float radius) {
  if (positions_ == PositionType::float64) {
    record64_.insert(record64_.end(), {position.x(), position.y(), position.z(), radius});
  } else {
    Eigen::Vector3f rounded = position.cast<float>();
    record32_.insert(record32_.end(), {rounded.x(), rounded.y(), rounded.z(), radius});
  }
}

void BodyColumns::push_box(const Aabb& box) {
  for (int axis = 0; axis < 3; ++axis) {
    lower_[axis].push_back(box.lower[axis]);
    upper_[axis].push_back(box.upper[axis]);
  }
}

void BodyColumns::push_rows(const Shape& shape, const Eigen::Quaternionf& orientation) {
  const uint32_t count = row_count(kind_of(shape));
  const auto rows = shape_rows(shape);
  first_row_.push_back(count ? static_cast<uint32_t>(rows_.size()) : 0);
  rows_.insert(rows_.end(), rows.begin(), rows.begin() + count);
  if (rows_.empty()) return;
  orientation_.resize(size(), {0, 0, 0, 1});  // for bodies before the first with rows
  orientation_.push_back({orientation.x(), orientation.y(), orientation.z(), orientation.w()});
}

bool BodyColumns::has_composites() const {
  return std::any_of(kind_.begin(), kind_.end(), is_composite);
}

Shape BodyColumns::shape(size_t index) const {
  switch (kind_[index]) {
    case ShapeKind::sphere:
      return Sphere{positions_ == PositionType::float64
                        ? static_cast<float>(record64_[4 * index + 3])
                        : record32_[4 * index + 3]};
    case ShapeKind::aabb:
      return Aabb{{lower_[0][index], lower_[1][index], lower_[2][index]},
                  {upper_[0][index], upper_[1][index], upper_[2][index]}};
    default:
      return shape_from_rows(kind_[index], &rows_[first_row_[index]]);
  }
}

Pose BodyColumns::pose(size_t index) const {
  Pose pose;
  pose.position = position(index);
  if (!orientation_.empty()) pose.orientation = Eigen::Quaternionf(orientation_[index].data());
  return pose;
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
  if (!rows_.empty()) {
    bodies.orientation.data = orientation_.front().data();
    bodies.rows = {rows_.front().data(), uniform ? nullptr : first_row_.data()};
  }
  return bodies;
}

}  // namespace carom::cli
