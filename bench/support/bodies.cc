#include "bench/support/bodies.h"

#include <array>
#include <variant>

#include "carom/reference/reference.h"

namespace carom::bench {
namespace {

float radius_of(const Shape& shape) {
  const auto* sphere = std::get_if<Sphere>(&shape);
  return sphere ? sphere->radius : 0;
}

}  // namespace

const char* name(Storage storage) {
  static constexpr std::array<const char*, 3> kNames = {"f32", "f64", "world"};
  return kNames[static_cast<size_t>(storage)];
}

PositionType position_type(Storage storage) {
  return storage == Storage::f64 ? PositionType::float64 : PositionType::float32;
}

Shape draw_shape(ShapeKind kind, test::Random& random) {
  const auto size = [&] { return static_cast<float>(random.uniform(0.5, 2)); };
  if (kind == ShapeKind::sphere) return Sphere{size()};
  const float x = size(), y = size(), z = size();
  return Aabb::from_half_extents({x, y, z});
}

Eigen::Vector3d draw_position(test::Random& random) {
  const double x = random.uniform(-100, 100), y = random.uniform(-100, 100);
  return {x, y, random.uniform(-100, 100)};
}

Eigen::Vector3d half_extents(const Shape& shape) {
  const reference::Box box =
      reference::bounds(shape, Eigen::Vector3d::Zero(), PositionType::float32);
  return (box.upper - box.lower).cast<double>() / 2;
}

PlacedShape as_stored(PlacedShape body, Storage storage) {
  body.position = test::stored(body.position, position_type(storage));
  if (storage != Storage::world) return body;
  auto& box = std::get<Aabb>(body.shape);
  box.lower += body.position.cast<float>();
  box.upper += body.position.cast<float>();
  body.position.setZero();
  return body;
}

DenseBodies::DenseBodies(ShapeKind kind, std::span<const PlacedShape> bodies, Storage storage) {
  view_.count = bodies.size();
  view_.uniform_kind = kind;
  if (storage == Storage::f32) store_records(bodies, records32_);
  if (storage == Storage::f64) store_records(bodies, records64_);
  if (kind == ShapeKind::aabb) store_boxes(bodies);
}

template <class T>
void DenseBodies::store_records(std::span<const PlacedShape> bodies, std::vector<T>& records) {
  records.reserve(4 * bodies.size());
  for (const PlacedShape& body : bodies) {
    for (int axis = 0; axis < 3; ++axis) records.push_back(static_cast<T>(body.position[axis]));
    records.push_back(radius_of(body.shape));
  }
  view_.position = {
      .data = records.data(),
      .stride = 4 * sizeof(T),
      .type = sizeof(T) == sizeof(double) ? PositionType::float64 : PositionType::float32};
}

void DenseBodies::store_boxes(std::span<const PlacedShape> bodies) {
  boxes_.resize(6 * bodies.size());
  for (size_t axis = 0; axis < 3; ++axis) {
    float* lower = &boxes_[axis * bodies.size()];
    float* upper = &boxes_[(3 + axis) * bodies.size()];
    for (size_t i = 0; i < bodies.size(); ++i) {
      const auto& box = std::get<Aabb>(bodies[i].shape);
      lower[i] = box.lower[static_cast<int>(axis)];
      upper[i] = box.upper[static_cast<int>(axis)];
    }
    view_.boxes.lower[axis] = lower;
    view_.boxes.upper[axis] = upper;
  }
}

}  // namespace carom::bench
