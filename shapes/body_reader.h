// Reads single bodies of a view, and says which are valid: finite position, finite size that is not
// negative. Bounds, kernels and queries share this one rule. The comparisons are ordered so that
// NaN fails them.
#pragma once

#include <array>
#include <cfloat>
#include <cstring>

#include "carom/shapes/views.h"
#include "shapes/geometry_row.h"

namespace carom {

inline bool is_valid_radius(float radius) { return radius >= 0 && radius <= FLT_MAX; }

inline bool is_valid_box_axis(float lower, float upper) {
  return lower >= -FLT_MAX && upper <= FLT_MAX && lower <= upper;
}

// Element i of an array with a stride in bytes, at any alignment; zero if there is no array.
template <class T>
T load_strided(const void* base, size_t stride, size_t i) {
  T value{};
  if (base) std::memcpy(&value, static_cast<const char*>(base) + i * stride, sizeof(T));
  return value;
}

template <class T>
struct Position {
  T x, y, z;
};

using Row = std::array<float, 4>;

// Without a branch: x - x is zero for a finite number and NaN for any other.
template <class T>
bool is_finite(const Position<T>& p) {
  return ((p.x - p.x) + (p.y - p.y)) + (p.z - p.z) == 0;
}
inline bool is_finite(const Row& row) {
  return ((row[0] - row[0]) + (row[1] - row[1])) + ((row[2] - row[2]) + (row[3] - row[3])) == 0;
}

inline bool is_direction(float x, float y, float z) { return (x != 0) | (y != 0) | (z != 0); }

// A finite quaternion that is not zero.
inline bool is_rotation(const Row& q) {
  return is_finite(q) && (is_direction(q[0], q[1], q[2]) || q[3] != 0);
}

// True if the number of planes exists, and the slabs are finite, in order, and have a point in
// common.
bool is_valid_dop(const Dop& dop);
// The same for rows of parameters. A geometry that was found from them proves it.
bool are_valid_dop_rows(const Row* rows, const DopGeometry* geometry);

// Whether the parameters are valid; for all kinds but spheres and aabbs. A geometry is valid if its
// address is not null.
inline bool are_valid_rows(ShapeKind kind, const Row* rows,
                           const DopGeometry* geometry_of_dop = nullptr) {
  if (has_geometry(kind)) {
    return geometry_at<void>(rows[0]) != nullptr &&
           (kind != ShapeKind::rounded_hull || is_valid_radius(rows[0][3]));
  }
  if (kind == ShapeKind::dop) return are_valid_dop_rows(rows, geometry_of_dop);
  for (uint32_t i = 0; i < row_count(kind); ++i) {
    if (!is_finite(rows[i])) return false;
  }
  switch (kind) {
    case ShapeKind::capsule:
      return rows[0][3] >= 0;
    case ShapeKind::triangle:  // thickness and the bits of the inner edges
      return rows[0][3] >= 0 && rows[2][3] >= 0 && rows[2][3] <= 7;
    case ShapeKind::box:
      return rows[0][0] >= 0 && rows[0][1] >= 0 && rows[0][2] >= 0;
    case ShapeKind::rounded_box:
    case ShapeKind::cylinder:
    case ShapeKind::cone:
    case ShapeKind::ellipsoid:
      return rows[0][0] >= 0 && rows[0][1] >= 0 && rows[0][2] >= 0 && rows[0][3] >= 0;
    case ShapeKind::halfspace:
      return is_direction(rows[0][0], rows[0][1], rows[0][2]);
    default:
      return true;
  }
}

// Reads single bodies of a view: for rare paths, scalar stages and set-up.
struct BodyReader {
  const Collidables& bodies;

  ShapeKind kind(size_t i) const { return bodies.kind ? bodies.kind[i] : bodies.uniform_kind; }

  size_t box(size_t i) const { return bodies.box_slot ? bodies.box_slot[i] : i; }

  bool is_float64() const { return bodies.position.type == PositionType::float64; }

  // Zero if the view has no positions.
  template <class T>
  Position<T> position(size_t i) const {
    const PositionView& view = bodies.position;
    if (!view.data) return {};
    if (is_float64()) {
      const auto p = load_strided<Position<double>>(view.data, view.stride, i);
      return {static_cast<T>(p.x), static_cast<T>(p.y), static_cast<T>(p.z)};
    }
    const auto p = load_strided<Position<float>>(view.data, view.stride, i);
    return {p.x, p.y, p.z};
  }

  // The radius of a sphere.
  float radius(size_t i) const {
    const PositionView& view = bodies.position;
    switch (view.radius_layout) {
      case RadiusLayout::none:
        return 0;
      case RadiusLayout::column:
        return load_strided<float>(view.radius, view.radius_stride, i);
      case RadiusLayout::fourth:
        break;
    }
    const char* base = static_cast<const char*>(view.data);
    if (is_float64()) {
      return static_cast<float>(
          load_strided<double>(base + sizeof(Position<double>), view.stride, i));
    }
    return load_strided<float>(base + sizeof(Position<float>), view.stride, i);
  }

  float lower(size_t axis, size_t i) const {
    return load_strided<float>(bodies.boxes.lower[axis], bodies.boxes.stride, box(i));
  }
  float upper(size_t axis, size_t i) const {
    return load_strided<float>(bodies.boxes.upper[axis], bodies.boxes.stride, box(i));
  }

  // The identity if the view has no orientations.
  Row orientation(size_t i) const {
    if (!bodies.orientation.data) return {0, 0, 0, 1};
    return load_strided<Row>(bodies.orientation.data, bodies.orientation.stride, i);
  }

  // The index of the body's first row of parameters; row() reads row k of those.
  size_t first_row(size_t i) const {
    return bodies.rows.first ? bodies.rows.first[i] : i * row_count(kind(i));
  }
  Row row(size_t i, size_t k) const {
    return load_strided<Row>(bodies.rows.data, sizeof(Row), first_row(i) + k);
  }
  std::array<Row, kMostRows> rows(size_t i) const {
    std::array<Row, kMostRows> rows{};
    for (uint32_t k = 0; k < row_count(kind(i)); ++k) rows[k] = row(i, k);
    return rows;
  }

  bool is_valid(size_t i) const {
    if (bodies.position.data && !is_finite(position<double>(i))) return false;
    if (kind(i) == ShapeKind::sphere) return is_valid_radius(radius(i));
    if (kind(i) == ShapeKind::aabb) return is_valid_box(i);
    return has_valid_parameters(i);
  }

  // Checks orientation and rows, for a kind that has them.
  bool has_valid_parameters(size_t i) const {
    if (!is_rotation(orientation(i))) return false;
    if (has_geometry(kind(i))) {
      const Row only = row(i, 0);
      return are_valid_rows(kind(i), &only);
    }
    return are_valid_rows(kind(i), rows(i).data(), dop_geometry(i));
  }

  // What the view says about the k-DOP of body i; its slabs may have changed since.
  const DopGeometry* dop_geometry(size_t i) const { return bodies.dops ? bodies.dops[i] : nullptr; }

 private:
  bool is_valid_box(size_t i) const {
    for (size_t axis = 0; axis < 3; ++axis) {
      if (!is_valid_box_axis(lower(axis, i), upper(axis, i))) return false;
    }
    return true;
  }
};

}  // namespace carom
