#include "bench/support/bodies.h"

#include <numbers>
#include <variant>

#include "carom/reference/reference.h"
#include "oracle/hull_faces.h"

namespace carom::bench {
namespace {

float radius_of(const Shape& shape) {
  const auto* sphere = std::get_if<Sphere>(&shape);
  return sphere ? sphere->radius : 0;
}

float draw_size(oracle::Random& random) { return static_cast<float>(random.uniform(0.5, 2)); }

Eigen::Vector3f draw_half(oracle::Random& random) {
  const float x = draw_size(random), y = draw_size(random);
  return {x, y, draw_size(random)};
}

Capsule draw_capsule(oracle::Random& random) {
  const Eigen::Vector3f end(0, draw_size(random), 0);
  return {-end, end, draw_size(random) / 2};
}

// A cylinder or a cone.
template <class Rim>
Rim draw_rim(oracle::Random& random) {
  const float radius = draw_size(random);
  return {radius, draw_size(random)};
}

Triangle draw_triangle(oracle::Random& random) {
  Triangle triangle;
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();
  for (Eigen::Vector3f& corner : triangle.corners) {
    corner = draw_size(random) * random.direction().cast<float>();
    middle += corner / 3;
  }
  for (Eigen::Vector3f& corner : triangle.corners) corner -= middle;
  return triangle;
}

Dop draw_dop(oracle::Random& random) {
  std::vector<Eigen::Vector3f> points(24);
  for (Eigen::Vector3f& p : points) p = draw_size(random) * random.direction().cast<float>();
  Dop dop = Dop::of_points(points, DopKind::k26);
  dop.geometry = dop_geometry(dop);
  return dop;
}

Hull draw_hull(size_t vertices, oracle::Random& random) {
  const Eigen::Vector3f half = draw_half(random);
  std::vector<Eigen::Vector3f> points(vertices);
  for (Eigen::Vector3f& p : points) p = half.cwiseProduct(random.direction().cast<float>());
  return oracle::hull_of(points);
}

Shape draw_shape(ShapeKind kind, oracle::Random& random, std::span<const Hull> hulls) {
  switch (kind) {
    case ShapeKind::sphere:
      return Sphere{draw_size(random)};
    case ShapeKind::capsule:
      return draw_capsule(random);
    case ShapeKind::box:
      return Box{draw_half(random)};
    case ShapeKind::rounded_box: {
      const Eigen::Vector3f half = draw_half(random);
      return Box{half, draw_size(random) / 10};
    }
    case ShapeKind::triangle:
      return draw_triangle(random);
    case ShapeKind::dop:
      return draw_dop(random);
    case ShapeKind::hull:
      return hulls[random.below(hulls.size())];
    case ShapeKind::rounded_hull: {
      Hull hull = hulls[random.below(hulls.size())];
      hull.rounding = draw_size(random) / 10;
      return hull;
    }
    case ShapeKind::cylinder:
      return draw_rim<Cylinder>(random);
    case ShapeKind::cone:
      return draw_rim<Cone>(random);
    case ShapeKind::ellipsoid:
      return Ellipsoid{draw_half(random)};
    case ShapeKind::halfspace:
      return Halfspace{random.direction().cast<float>(), draw_size(random)};
    default:
      return Aabb::from_half_extents(draw_half(random));
  }
}

Eigen::Vector3d draw_position(oracle::Random& random) {
  const double x = random.uniform(-100, 100), y = random.uniform(-100, 100);
  return {x, y, random.uniform(-100, 100)};
}

Eigen::Quaternionf draw_orientation(oracle::Random& random) {
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, random.direction())).cast<float>();
}

}  // namespace

const char* name(Storage storage) {
  static constexpr std::array<const char*, 3> kNames = {"f32", "f64", "world"};
  return kNames[static_cast<size_t>(storage)];
}

PositionType position_type(Storage storage) {
  return storage == Storage::f64 ? PositionType::float64 : PositionType::float32;
}

PlacedShape draw_body(ShapeKind kind, oracle::Random& random, std::span<const Hull> hulls) {
  PlacedShape body = {draw_shape(kind, random, hulls), draw_position(random)};
  if (row_count(kind) > 0) body.orientation = draw_orientation(random);
  return body;
}

std::vector<Hull> draw_hulls(size_t count, size_t vertices, oracle::Random& random) {
  std::vector<Hull> hulls;
  for (size_t i = 0; i < count; ++i) hulls.push_back(draw_hull(vertices, random));
  return hulls;
}

Eigen::AlignedBox3d local_bounds(const PlacedShape& body) {
  const Pose turned = {Eigen::Vector3d::Zero(), body.orientation};
  const reference::Box box = reference::bounds(body.shape, turned, PositionType::float32);
  return {box.lower.cast<double>(), box.upper.cast<double>()};
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
  if (row_count(kind) > 0) store_rows(bodies);
}

size_t DenseBodies::bytes_per_body() const {
  const size_t corners = view_.boxes.lower.size() + view_.boxes.upper.size();
  return (view_.position.data ? view_.position.stride : 0) +
         (view_.boxes.lower[0] ? corners * view_.boxes.stride : 0) +
         (view_.orientation.data ? view_.orientation.stride : 0) +
         row_count(view_.uniform_kind) * sizeof(rows_[0]);
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

void DenseBodies::store_rows(std::span<const PlacedShape> bodies) {
  for (const PlacedShape& body : bodies) {
    for (const float x : body.orientation.coeffs()) orientations_.push_back(x);
    const auto rows = shape_rows(body.shape);
    rows_.insert(rows_.end(), rows.begin(), rows.begin() + row_count(view_.uniform_kind));
  }
  view_.orientation.data = orientations_.data();
  view_.rows.data = rows_.front().data();
  if (view_.uniform_kind == ShapeKind::dop) store_geometries(bodies);
}

void DenseBodies::store_geometries(std::span<const PlacedShape> bodies) {
  for (const PlacedShape& body : bodies) {
    dop_geometries_.push_back(std::get<Dop>(body.shape).geometry);
    dops_.push_back(dop_geometries_.back().get());
  }
  view_.dops = dops_.data();
}

}  // namespace carom::bench
