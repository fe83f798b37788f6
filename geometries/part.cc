#include "geometries/part.h"

#include <algorithm>
#include <cmath>

#include "base/powers.h"
#include "shapes/dop_polytope.h"

namespace carom {
namespace {

// The bounding box of points that are added one by one.
class GrowingBox {
 public:
  void add(const Double3& point) {
    for (size_t axis = 0; axis < 3; ++axis) {
      lower_[axis] = std::min(lower_[axis], point[axis]);
      upper_[axis] = std::max(upper_[axis], point[axis]);
    }
  }

  PartBox box(double radius) const {
    PartBox box;
    for (size_t axis = 0; axis < 3; ++axis) {
      box.middle[axis] = (lower_[axis] + upper_[axis]) / 2;
      box.half[axis] = (upper_[axis] - lower_[axis]) / 2 + radius;
    }
    return box;
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  Double3 lower_ = {kInfinity, kInfinity, kInfinity};
  Double3 upper_ = {-kInfinity, -kInfinity, -kInfinity};
};

template <class Point>
PartBox box_around(const Point& lower, const Point& upper, double radius = 0) {
  GrowingBox box;
  box.add({lower[0], lower[1], lower[2]});
  box.add({upper[0], upper[1], upper[2]});
  return box.box(radius);
}

PartBox dop_box(const Part& part) {
  const DopSlabs slabs =
      DopSlabs(std::get<Dop>(shape_from_rows(part.kind, part.rows.data()))).with_tight_axes();
  return box_around(slabs.lower, slabs.upper);
}

PartBox hull_box(const HullGeometry& hull, double rounding = 0) {
  GrowingBox box;
  for (const Eigen::Vector3f& point : hull.points()) box.add(wide(point));
  return box.box(rounding);
}

// A box about the part's own position.
PartBox box_about_position(double x, double y, double z, double rounding = 0) {
  return {{}, {x + rounding, y + rounding, z + rounding}};
}

}  // namespace

PartBox box_of(const Part& part) {
  const std::array<Row, kMostRows>& rows = part.rows;
  switch (part.kind) {
    case ShapeKind::sphere:
      return {{}, {part.radius, part.radius, part.radius}};
    case ShapeKind::aabb:
      return box_around(part.lower, part.upper);
    case ShapeKind::capsule:
      return box_around(rows[0], rows[1], rows[0][3]);
    case ShapeKind::box:
      return box_about_position(rows[0][0], rows[0][1], rows[0][2]);
    case ShapeKind::cylinder:
    case ShapeKind::cone:
      return box_about_position(rows[0][0], rows[0][0], rows[0][1], rows[0][3]);
    case ShapeKind::rounded_box:
    case ShapeKind::ellipsoid:
      return box_about_position(rows[0][0], rows[0][1], rows[0][2], rows[0][3]);
    case ShapeKind::dop:
      return dop_box(part);
    case ShapeKind::hull:
      return hull_box(*geometry_at<HullGeometry>(rows[0]));
    case ShapeKind::rounded_hull:
      return hull_box(*geometry_at<HullGeometry>(rows[0]), rows[0][3]);
    case ShapeKind::mesh:
    case ShapeKind::height_field: {
      const Surface surface = surface_at(part.kind, rows[0]);
      return box_around(surface.lower(), surface.upper());
    }
    case ShapeKind::triangle: {
      GrowingBox box;
      for (size_t i = 0; i < 3; ++i) box.add({rows[i][0], rows[i][1], rows[i][2]});
      return box.box(rows[0][3]);
    }
    case ShapeKind::compound:
    case ShapeKind::halfspace:
      break;
  }
  return {};
}

PartBall ball_of(const Part& part) {
  const auto length = [](const Double3& v) { return std::sqrt(dot(v, v)); };
  const std::array<Row, kMostRows>& rows = part.rows;
  switch (part.kind) {
    case ShapeKind::sphere:
      return {{}, part.radius};
    case ShapeKind::capsule: {
      const Double3 a = vector_of(rows[0]), b = vector_of(rows[1]);
      const Double3 middle = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
      return {middle, length(minus(b, middle)) + rows[0][3]};
    }
    case ShapeKind::hull:
    case ShapeKind::rounded_hull: {
      const auto& hull = *geometry_at<HullGeometry>(rows[0]);
      const Double3 middle = {hull.middle().x(), hull.middle().y(), hull.middle().z()};
      double radius = 0;
      for (const Eigen::Vector3f& point : hull.points()) {
        radius = std::max(radius, length(minus(wide(point), middle)));
      }
      return {middle, radius + (part.kind == ShapeKind::hull ? 0 : rows[0][3])};
    }
    case ShapeKind::cylinder:
    case ShapeKind::cone:
      return {{}, length({rows[0][0], rows[0][1], 0}) + rows[0][3]};
    case ShapeKind::ellipsoid:
      return {{}, double{std::max({rows[0][0], rows[0][1], rows[0][2]})} + rows[0][3]};
    case ShapeKind::rounded_box:
      return {{}, length(vector_of(rows[0])) + rows[0][3]};
    case ShapeKind::aabb:
    case ShapeKind::box:
    case ShapeKind::dop: {
      const PartBox box = box_of(part);
      return {box.middle, length(box.half)};
    }
    case ShapeKind::mesh:
    case ShapeKind::height_field:
    case ShapeKind::triangle:
    case ShapeKind::compound:
    case ShapeKind::halfspace:
      break;
  }
  return {};
}

void put_triangle_of_others(const Surface& surface, size_t triangle, Row* rows,
                            const std::array<float, 3>& origin) {
  surface.visit(
      [&](const auto& geometry) { put_visited_triangle(geometry, triangle, rows, origin); });
}

std::array<Eigen::Vector3f, 3> Surface::corners_of_others(size_t triangle) const {
  return visit([triangle](const auto& geometry) { return corners_of(geometry, triangle); });
}

// Hamilton's product, scaled so that the squares of its numbers neither underflow nor overflow.
Row product(const Row& q, const Row& p) {
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  const std::array<double, 4> r = {
      ((w * p[0] + x * p[3]) + y * p[2]) - z * p[1], ((w * p[1] + y * p[3]) + z * p[0]) - x * p[2],
      ((w * p[2] + z * p[3]) + x * p[1]) - y * p[0], ((w * p[3] - x * p[0]) - y * p[1]) - z * p[2]};
  double largest = 0;
  for (const double c : r) largest = std::max(largest, std::fabs(c));
  // The quaternion of a sphere or an aabb may be zero, since those do not turn.
  const double scale = largest > 0 ? power_of_two(-exponent_of(largest)) : 1;
  Row result;
  for (size_t i = 0; i < 4; ++i) result[i] = static_cast<float>(r[i] * scale);
  return result;
}

}  // namespace carom
