#include "world/store/body_store.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace carom {
namespace {

constexpr uint32_t kEverything = 0xffffffffu;
constexpr float kToleranceOfWorld = -1;

// Creates the column as soon as a row differs from the default.
template <class T>
void set_row(std::vector<T>& column, size_t rows, uint32_t index, T value, T default_value) {
  if (column.empty()) {
    if (value == default_value) return;
    column.resize(rows, default_value);
  }
  column[index] = value;
}

// Replaces the numbers at `at` by `value`, after note() if any bit differs: NaN equals itself. If
// note() throws, they stay.
template <class Value, class T, class Note>
void replace_bits(const Value& value, T* at, const Note& note) {
  const size_t size = value.size() * sizeof(T);
  if (std::memcmp(at, value.data(), size) == 0) return;
  note();
  std::memcpy(at, value.data(), size);
}

}  // namespace

// Calls visit(column, whether it exists, values a row, value of a new row) for every column.
template <class Self, class Visit>
void BodyStore::for_each_column(Self& self, const Visit& visit) {
  const auto optional = [&](auto& column, auto value) { visit(column, !column.empty(), 1, value); };
  const bool is_float64 = self.positions_ == PositionType::float64;
  visit(self.generation_, true, 1, self.first_generation_);
  visit(self.kind_, true, 1, ShapeKind::sphere);
  visit(self.records32_, !is_float64, 4, 0.0f);
  visit(self.records64_, is_float64, 4, 0.0);
  const Eigen::Vector3f at_rest = Eigen::Vector3f::Zero();
  visit(self.velocity_, self.has_velocities_, 1, at_rest);
  visit(self.angular_velocity_, self.has_angular_velocities_, 1, at_rest);
  optional(self.box_slot_, 0u);
  optional(self.first_row_, 0u);
  optional(self.orientation_, kIdentity);
  optional(self.motion_, Motion::dynamic);
  optional(self.detection_, Detection::discrete);
  optional(self.layer_, kEverything);
  optional(self.mask_, kEverything);
  optional(self.owner_, 0u);
  optional(self.group_, 0);
  optional(self.space_, 0u);
  optional(self.sensor_, uint8_t{0});
  optional(self.contact_distance_, 0.0f);
  optional(self.tolerance_, kToleranceOfWorld);
  optional(self.model_, Model{});
  optional(self.user_, uint64_t{0});
  optional(self.geometry_, std::shared_ptr<const void>());
  optional(self.dop_, static_cast<const DopGeometry*>(nullptr));
}

void BodyStore::add_row() {
  for_each_column(*this, [&](auto& column, bool exists, int width, const auto& value) {
    if (!exists) return;
    for (int i = 0; i < width; ++i) column.push_back(value);
  });
  if (touched_.size() < rows()) touched_.push_back(0);
}

// Drops the rows beyond the last body.
void BodyStore::drop_rows() {
  for (size_t i = rows(); i < generation_.size(); ++i) {
    first_generation_ = std::max(first_generation_, generation_[i]);
  }
  for_each_column(*this, [&](auto& column, bool exists, int width, const auto&) {
    if (exists) column.resize(rows() * static_cast<size_t>(width));
  });
}

BodyId BodyStore::add(const BodyDesc& body) {
  const uint32_t index = alive_.take();
  if (rows() > generation_.size()) add_row();
  touch(index, kReplaced);
  set_position(index, body.position);
  store_tolerance(index, body.tolerance);
  store_shape(index, body.shape);
  set_orientation(index, body.orientation);
  set_row(motion_, rows(), index, body.motion, Motion::dynamic);
  set_filter(index, body.layer, body.mask, body.owner);
  set_row(group_, rows(), index, body.group, 0);
  set_row(space_, rows(), index, body.space, 0u);
  set_row(sensor_, rows(), index, uint8_t{body.sensor}, uint8_t{0});
  set_row(contact_distance_, rows(), index, body.contact_distance, 0.0f);
  set_row(user_, rows(), index, body.user, uint64_t{0});
  if (has_velocities_ || !body.linear_velocity.isZero(0)) {
    set_linear_velocity(index, body.linear_velocity);
  }
  if (has_angular_velocities_ || !body.angular_velocity.isZero(0)) {
    set_angular_velocity(index, body.angular_velocity);
  }
  store_detection(index, body.detection);
  return id_of(index);
}

void BodyStore::remove(BodyId id) {
  const uint32_t index = id.index;
  touch(index, kReplaced);
  store_detection(index, Detection::discrete);
  count_kind(index, -1);
  change_kind(index, ShapeKind::sphere);
  if (!geometry_.empty()) geometry_[index].reset();
  if (!model_.empty()) model_[index] = {};
  store_tolerance(index, std::nullopt);
  if (!dop_.empty()) dop_[index] = nullptr;
  ++generation_[index];
  any_removed_ = true;
  alive_.release(index);
  if (rows() < generation_.size()) drop_rows();
}

void BodyStore::touch(uint32_t index, uint8_t how) {
  if (!touched(index)) touched_indices_.push_back(index);
  touched_[index] |= how;
}

void BodyStore::note_move(uint32_t index) {
  if (shares_poses_ || touched_[index]) return;  // then it counts as changed anyway
  moved_indices_.push_back(index);
  touched_[index] |= kMoved;
}

void BodyStore::touch_all() {
  touched_indices_.reserve(touched_indices_.size() + rows());
  for (uint32_t index = 0; index < rows(); ++index) touch(index, kReplaced);
}

void BodyStore::clear_touched() {
  for (std::vector<uint32_t>* list : {&touched_indices_, &moved_indices_}) {
    for (const uint32_t index : *list) touched_[index] = 0;
    list->clear();
  }
  touched_.resize(rows());
}

void BodyStore::give_back() {
  for_each_column(*this, [](auto& column, bool, int, const auto&) { carom::give_back(column); });
  for (IndexPool* pool : {&alive_, &slots_}) pool->give_back();
  row_pool_.give_back();
  carom::give_back(touched_, touched_indices_, moved_indices_, boxes_, rows_, halfspaces_);
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
  const auto note = [&] { note_move(index); };
  if (positions_ == PositionType::float64) {
    replace_bits(position, &records64_[row], note);
  } else {
    replace_bits(position.cast<float>().eval(), &records32_[row], note);
  }
}

Orientation BodyStore::orientation(uint32_t index) const {
  const Row q = row_count(kind_[index]) > 0 ? orientation_[index] : kIdentity;
  return {q[3], q[0], q[1], q[2]};
}

void BodyStore::set_orientation(uint32_t index, const Orientation& q) {
  if (row_count(kind_[index]) == 0) return;
  replace_bits(Row{q.x(), q.y(), q.z(), q.w()}, orientation_[index].data(),
               [&] { note_move(index); });
}

float BodyStore::radius(uint32_t index) const {
  const size_t row = size_t{index} * 4 + 3;
  return positions_ == PositionType::float64 ? static_cast<float>(records64_[row])
                                             : records32_[row];
}

void BodyStore::set_radius(uint32_t index, float radius) {
  const size_t row = size_t{index} * 4 + 3;
  if (positions_ == PositionType::float64) {
    records64_[row] = radius;
  } else {
    records32_[row] = radius;
  }
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

void BodyStore::set_group(uint32_t index, int32_t group) {
  set_row(group_, rows(), index, group, 0);
  touch(index, kShapeTouched);
}

void BodyStore::set_space(uint32_t index, uint32_t space) {
  set_row(space_, rows(), index, space, 0u);
  touch(index, kShapeTouched);
}

void BodyStore::set_sensor(uint32_t index, bool sensor) {
  set_row(sensor_, rows(), index, uint8_t{sensor}, uint8_t{0});
  touch(index, kShapeTouched);
}

void BodyStore::set_user(uint32_t index, uint64_t user) {
  set_row(user_, rows(), index, user, uint64_t{0});
}

void BodyStore::set_contact_distance(uint32_t index, float distance) {
  set_row(contact_distance_, rows(), index, distance, 0.0f);
  touch(index, kShapeTouched);
}

void BodyStore::set_tolerance(uint32_t index, std::optional<float> tolerance) {
  store_tolerance(index, tolerance);
  const Shape own = shape(index);
  if (ladder_of(own)) set_shape(index, own);  // another model may stand for it
  touch(index, kShapeTouched);
}

void BodyStore::store_tolerance(uint32_t index, std::optional<float> tolerance) {
  const auto counts = [this, index] { return !tolerance_.empty() && tolerance_[index] > 0; };
  tolerant_ -= counts();
  set_row(tolerance_, rows(), index, tolerance.value_or(kToleranceOfWorld), kToleranceOfWorld);
  tolerant_ += counts();
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

Eigen::Vector3f BodyStore::angular_velocity(uint32_t index) const {
  return !has_angular_velocities_ ? Eigen::Vector3f::Zero().eval() : angular_velocity_[index];
}

void BodyStore::set_angular_velocity(uint32_t index, const Eigen::Vector3f& velocity) {
  angular_velocities()[index] = velocity;
}

std::span<Eigen::Vector3f> BodyStore::angular_velocities() {
  has_angular_velocities_ = true;
  angular_velocity_.resize(rows(), Eigen::Vector3f::Zero());
  return angular_velocity_;
}

Detection BodyStore::detection(uint32_t index) const {
  return detection_.empty() ? Detection::discrete : detection_[index];
}

void BodyStore::set_detection(uint32_t index, Detection detection) {
  store_detection(index, detection);
  touch(index, kShapeTouched);
}

void BodyStore::store_detection(uint32_t index, Detection detection) {
  detected_ -= this->detection(index) != Detection::discrete;
  detected_ += detection != Detection::discrete;
  set_row(detection_, rows(), index, detection, Detection::discrete);
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
  // Rows without a body have nothing that could be read as the address of a geometry.
  if (has_geometry(view.uniform_kind) && rows() != size()) view.kind = kind_.data();
  // Without the detour through slots, or through the first rows below, where each shape lies at the
  // index of its body.
  if (boxes_elsewhere_ > 0) view.box_slot = box_slot_.data();
  if (!boxes_.empty()) view.boxes = box_records(boxes_.front().lower.data());
  if (!orientation_.empty()) view.orientation.data = orientation_.front().data();
  if (!rows_.empty()) view.rows.data = rows_.front().data();
  // Bodies of several kinds need it (Collidables::rows).
  if (view.kind || rows_elsewhere_ > 0) view.rows.first = data_or_null(first_row_);
  view.dops = data_or_null(dop_);
  return view;
}

PairFilter BodyStore::filter() const {
  return {.layer = data_or_null(layer_),
          .mask = data_or_null(mask_),
          .owner = data_or_null(owner_),
          .motion = data_or_null(motion_),
          .group = data_or_null(group_),
          .space = data_or_null(space_)};
}

size_t BodyStore::bytes() const {
  size_t sum = alive_.bytes() + slots_.bytes() + row_pool_.bytes() + bytes_of(rows_) +
               bytes_of(boxes_) + bytes_of(halfspaces_) + bytes_of(touched_) +
               bytes_of(touched_indices_) + bytes_of(moved_indices_) + dop_geometries_.bytes();
  for_each_column(*this, [&](const auto& column, auto...) { sum += bytes_of(column); });
  return sum;
}

}  // namespace carom
