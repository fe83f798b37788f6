#include "world/body_store.h"

#include <algorithm>
#include <cassert>
#include <functional>

namespace carom {
namespace {

constexpr uint32_t kEverything = 0xffffffffu;

// Makes the column if a row differs from the default for the first time.
template <class T>
void set_row(std::vector<T>& column, size_t rows, uint32_t index, T value, T default_value) {
  if (column.empty()) {
    if (value == default_value) return;
    column.resize(rows, default_value);
  }
  column[index] = value;
}

template <class T>
void grow_column(std::vector<T>& column, T default_value) {
  if (!column.empty()) column.push_back(default_value);
}

template <class T>
size_t bytes_of(const std::vector<T>& column) {
  return column.capacity() * sizeof(T);
}

template <class T>
const T* data_or_null(const std::vector<T>& column) {
  return column.empty() ? nullptr : column.data();
}

}  // namespace

BodyId BodyStore::add(const BodyDesc& body) {
  const uint32_t index = take_index();
  alive_[index] = 1;
  set_position(index, body.position);
  set_radius(index, 0);
  store_shape(index, body.shape);
  set_row(motion_, rows(), index, body.motion, Motion::dynamic);
  set_filter(index, body.layer, body.mask, body.owner);
  set_row(sensor_, rows(), index, uint8_t{body.sensor}, uint8_t{0});
  set_row(user_, rows(), index, body.user, uint64_t{0});
  if (has_velocities_ || !body.linear_velocity.isZero(0)) {
    set_linear_velocity(index, body.linear_velocity);
  }
  touch(index, kReplaced);
  return id_of(index);
}

void BodyStore::remove(BodyId id) {
  const uint32_t index = id.index;
  const ShapeKind kind = kind_[index];
  --bodies_of_kind_[static_cast<size_t>(kind)];
  if (kind == ShapeKind::aabb) free_boxes_.push_back(box_slot_[index]);
  alive_[index] = 0;
  ++generation_[index];
  free_.push_back(index);
  std::push_heap(free_.begin(), free_.end(), std::greater<>());
  touch(index, kReplaced);
}

uint32_t BodyStore::take_index() {
  if (free_.empty()) {
    grow();
    return static_cast<uint32_t>(rows() - 1);
  }
  std::pop_heap(free_.begin(), free_.end(), std::greater<>());
  const uint32_t index = free_.back();
  free_.pop_back();
  return index;
}

void BodyStore::grow() {
  alive_.push_back(0);
  generation_.push_back(0);
  kind_.push_back(ShapeKind::sphere);
  touched_.push_back(0);
  if (positions_ == PositionType::float64) {
    records64_.insert(records64_.end(), 4, 0.0);
  } else {
    records32_.insert(records32_.end(), 4, 0.0f);
  }
  grow_column(box_slot_, 0u);
  grow_column(motion_, Motion::dynamic);
  grow_column(layer_, kEverything);
  grow_column(mask_, kEverything);
  grow_column(owner_, 0u);
  grow_column(sensor_, uint8_t{0});
  grow_column(user_, uint64_t{0});
  if (has_velocities_) velocity_.emplace_back(Eigen::Vector3f::Zero());
}

void BodyStore::touch(uint32_t index, uint8_t how) {
  touched_[index] |= how;
  any_touched_ = true;
}

void BodyStore::clear_touched() {
  if (any_touched_) std::fill(touched_.begin(), touched_.end(), uint8_t{0});
  any_touched_ = false;
}

Eigen::Vector3d BodyStore::position(uint32_t index) const {
  const size_t row = size_t{index} * 4;
  if (positions_ == PositionType::float64) {
    return {records64_[row], records64_[row + 1], records64_[row + 2]};
  }
  return {records32_[row], records32_[row + 1], records32_[row + 2]};
}

void BodyStore::set_position(uint32_t index, const Eigen::Vector3d& position) {
  const size_t row = size_t{index} * 4;
  for (int axis = 0; axis < 3; ++axis) {
    if (positions_ == PositionType::float64) {
      records64_[row + axis] = position[axis];
    } else {
      records32_[row + axis] = static_cast<float>(position[axis]);
    }
  }
}

void BodyStore::set_radius(uint32_t index, float radius) {
  const size_t row = size_t{index} * 4 + 3;
  if (positions_ == PositionType::float64) {
    records64_[row] = radius;
  } else {
    records32_[row] = radius;
  }
}

Shape BodyStore::shape(uint32_t index) const {
  if (kind_[index] == ShapeKind::aabb) {
    const uint32_t slot = box_slot_[index];
    return Aabb{{boxes_[0][slot], boxes_[1][slot], boxes_[2][slot]},
                {boxes_[3][slot], boxes_[4][slot], boxes_[5][slot]}};
  }
  const size_t row = size_t{index} * 4 + 3;
  return Sphere{positions_ == PositionType::float64 ? static_cast<float>(records64_[row])
                                                    : records32_[row]};
}

void BodyStore::set_shape(uint32_t index, const Shape& shape) {
  --bodies_of_kind_[static_cast<size_t>(kind_[index])];
  if (kind_[index] == ShapeKind::aabb) free_boxes_.push_back(box_slot_[index]);
  set_radius(index, 0);
  store_shape(index, shape);
  touch(index, kShapeTouched);
}

void BodyStore::store_shape(uint32_t index, const Shape& shape) {
  if (const Sphere* sphere = std::get_if<Sphere>(&shape)) {
    kind_[index] = ShapeKind::sphere;
    set_radius(index, sphere->radius);
  } else if (const Aabb* box = std::get_if<Aabb>(&shape)) {
    kind_[index] = ShapeKind::aabb;
    if (box_slot_.empty()) box_slot_.resize(rows(), 0);
    const uint32_t slot = take_box();
    box_slot_[index] = slot;
    for (int axis = 0; axis < 3; ++axis) {
      boxes_[axis][slot] = box->lower[axis];
      boxes_[3 + axis][slot] = box->upper[axis];
    }
  }
  ++bodies_of_kind_[static_cast<size_t>(kind_[index])];
}

uint32_t BodyStore::take_box() {
  if (free_boxes_.empty()) {
    for (std::vector<float>& column : boxes_) column.push_back(0);
    return static_cast<uint32_t>(boxes_[0].size() - 1);
  }
  const uint32_t slot = free_boxes_.back();
  free_boxes_.pop_back();
  return slot;
}

Motion BodyStore::motion(uint32_t index) const {
  return motion_.empty() ? Motion::dynamic : motion_[index];
}

void BodyStore::set_motion(uint32_t index, Motion motion) {
  set_row(motion_, rows(), index, motion, Motion::dynamic);
  touch(index, kShapeTouched);
}

void BodyStore::set_filter(uint32_t index, uint32_t layer, uint32_t mask, uint32_t owner) {
  if (layer_.empty() && (layer != kEverything || mask != kEverything)) {
    layer_.resize(rows(), kEverything);
    mask_.resize(rows(), kEverything);
  }
  if (!layer_.empty()) {
    layer_[index] = layer;
    mask_[index] = mask;
  }
  set_row(owner_, rows(), index, owner, 0u);
  touch(index, kShapeTouched);
}

void BodyStore::set_sensor(uint32_t index, bool sensor) {
  set_row(sensor_, rows(), index, uint8_t{sensor}, uint8_t{0});
  touch(index, kShapeTouched);
}

void BodyStore::set_user(uint32_t index, uint64_t user) {
  set_row(user_, rows(), index, user, uint64_t{0});
}

Eigen::Vector3f BodyStore::linear_velocity(uint32_t index) const {
  return !has_velocities_ ? Eigen::Vector3f::Zero().eval() : velocity_[index];
}

void BodyStore::set_linear_velocity(uint32_t index, const Eigen::Vector3f& velocity) {
  linear_velocities()[index] = velocity;
}

std::span<Eigen::Vector3f> BodyStore::linear_velocities() {
  has_velocities_ = true;
  velocity_.resize(rows(), Eigen::Vector3f::Zero());
  return velocity_;
}

Collidables BodyStore::view() const {
  Collidables view;
  view.count = rows();
  const bool is_float64 = positions_ == PositionType::float64;
  view.position.type = positions_;
  view.position.data = is_float64 ? static_cast<const void*>(records64_.data())
                                  : static_cast<const void*>(records32_.data());
  view.position.stride = is_float64 ? 4 * sizeof(double) : 4 * sizeof(float);
  for (size_t kind = 0; kind < bodies_of_kind_.size(); ++kind) {
    if (bodies_of_kind_[kind] == 0) continue;
    view.uniform_kind = static_cast<ShapeKind>(kind);
    if (bodies_of_kind_[kind] != size()) view.kind = kind_.data();
  }
  view.box_slot = data_or_null(box_slot_);
  view.boxes.lower = {boxes_[0].data(), boxes_[1].data(), boxes_[2].data()};
  view.boxes.upper = {boxes_[3].data(), boxes_[4].data(), boxes_[5].data()};
  return view;
}

PairFilter BodyStore::filter() const {
  return {data_or_null(layer_), data_or_null(mask_), data_or_null(owner_), data_or_null(motion_)};
}

size_t BodyStore::bytes() const {
  size_t sum = bytes_of(alive_) + bytes_of(generation_) + bytes_of(kind_) + bytes_of(touched_) +
               bytes_of(free_) + bytes_of(records32_) + bytes_of(records64_) +
               bytes_of(free_boxes_) + bytes_of(box_slot_) + bytes_of(motion_) + bytes_of(layer_) +
               bytes_of(mask_) + bytes_of(owner_) + bytes_of(sensor_) + bytes_of(user_) +
               bytes_of(velocity_);
  for (const std::vector<float>& column : boxes_) sum += bytes_of(column);
  return sum;
}

}  // namespace carom
