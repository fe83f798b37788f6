#include "bounds/dop_core.h"

#include "bounds/extent.h"

namespace carom {
namespace {

using Turn = std::array<Double3, 3>;

Double3 turned(const Turn& turn, const Double3& v) {
  return {dot(turn[0], v), dot(turn[1], v), dot(turn[2], v)};
}

Double3 half_of(const Double3& v) { return {0.5 * v[0], 0.5 * v[1], 0.5 * v[2]}; }
Double3 plus(const Double3& a, const Double3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

DopCore sphere_core(float radius) {
  DopCore core;
  core.radius = core.size = radius;
  return core;
}

// A box along the world axes. Double precision rounds the sums of two floats by very little.
DopCore extent_core(const Extent& extent) {
  const Double3 lower = {extent.lower[0], extent.lower[1], extent.lower[2]};
  const Double3 upper = {extent.upper[0], extent.upper[1], extent.upper[2]};
  const Double3 half = half_of(minus(upper, lower));
  DopCore core;
  core.points.fill(half_of(plus(lower, upper)));
  for (size_t axis = 0; axis < 3; ++axis) core.edges[axis][axis] = half[axis];
  core.size = std::max(greatest(lower), greatest(upper));
  return core;
}

DopCore capsule_core(const Turn& turn, const std::array<Row, kMostRows>& rows) {
  const Double3 a = vector_of(rows[0]), b = vector_of(rows[1]);
  DopCore core;
  core.points.fill(turned(turn, half_of(plus(a, b))));
  core.edges[0] = turned(turn, half_of(minus(b, a)));
  core.radius = rows[0][3];
  return core;
}

DopCore box_core(const Turn& turn, const Row& half, double rounding = 0) {
  DopCore core;
  core.radius = rounding;
  for (size_t axis = 0; axis < 3; ++axis) {
    core.edges[axis] = {turn[0][axis] * half[axis], turn[1][axis] * half[axis],
                        turn[2][axis] * half[axis]};
  }
  return core;
}

// A thick triangle is a prism. It is grown by its thickness on all sides if its back is unknown.
DopCore triangle_core(const Turn& turn, const std::array<Row, kMostRows>& rows) {
  const Double3 a = vector_of(rows[0]), b = vector_of(rows[1]), c = vector_of(rows[2]);
  DopCore core;
  core.points = {turned(turn, a), turned(turn, b), turned(turn, c)};
  const double thickness = rows[0][3];
  if (thickness == 0) return core;
  const Double3 back = way_back(a, b, c, thickness);
  core.radius = thickness * (greatest(back) > 0 ? 0x1p-24 : 1);
  core.edges[0] = turned(turn, half_of(back));
  for (Double3& point : core.points) point = plus(point, core.edges[0]);
  return core;
}

// `row`: as of an ellipsoid.
DopCore ellipsoid_core(const Turn& turn, const Row& row) {
  DopCore core;
  core.is_round = true;
  core.shares.fill(1);
  core.half_axes = box_core(turn, row).edges;
  core.radius = row[3];
  return core;
}

// `row`: as of a cylinder or a cone; `top`: the share of the upper disc.
DopCore axial_core(const Turn& turn, const Row& row, double top) {
  DopCore core = ellipsoid_core(turn, {row[0], row[0], 0, row[3]});
  const Double3 end = turned(turn, {0, 0, row[1]}), start = minus({}, end);
  core.points = {start, start, end};
  core.shares[2] = top;
  return core;
}

DopCore turned_core(const BodyReader& reader, size_t i) {
  const std::array<Row, kMostRows> rows = reader.rows(i);
  const Turn turn = rotation_of(reader.orientation(i));
  switch (reader.kind(i)) {
    case ShapeKind::capsule:
      return capsule_core(turn, rows);
    case ShapeKind::box:
      return box_core(turn, rows[0]);
    case ShapeKind::rounded_box:
      return box_core(turn, rows[0], rows[0][3]);
    case ShapeKind::cylinder:
      return axial_core(turn, rows[0], 1);
    case ShapeKind::cone:
      return axial_core(turn, rows[0], 0);
    case ShapeKind::ellipsoid:
      return ellipsoid_core(turn, rows[0]);
    default:
      return triangle_core(turn, rows);
  }
}

}  // namespace

DopCore dop_core(const BodyReader& reader, size_t i) {
  switch (reader.kind(i)) {
    case ShapeKind::sphere:
      return sphere_core(reader.radius(i));
    case ShapeKind::capsule:
    case ShapeKind::box:
    case ShapeKind::rounded_box:
    case ShapeKind::cylinder:
    case ShapeKind::cone:
    case ShapeKind::ellipsoid:
    case ShapeKind::triangle: {
      DopCore core = turned_core(reader, i);
      core.size = greatest_of(reader.rows(i));
      return core;
    }
    default:
      return extent_core(extent_of(reader, i));
  }
}

}  // namespace carom
