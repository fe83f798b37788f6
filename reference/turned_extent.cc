// The extent is computed in double precision. A bound on its rounding is added before the result is
// rounded outwards to float32.
//
// Source of the extent of a box: C. Ericson, Real-Time Collision Detection, 2005, section 4.2.6.
#include "reference/turned_extent.h"

#include <cmath>
#include <limits>
#include <vector>

#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/height_field_geometry.h"
#include "carom/shapes/mesh_geometry.h"
#include "reference/vectors.h"
#include "shapes/dop_geometry.h"

namespace carom::reference {
namespace {

using Eigen::Vector3d;

constexpr double kTurnRounding =
    0x1p-46;  // a generous bound for a rotation and the sums that follow

// The rows of M(q) / |q|^2.
struct Turn {
  Vector3d x, y, z;

  explicit Turn(const Eigen::Quaternionf& q) {
    const double i = q.x(), j = q.y(), k = q.z(), w = q.w();
    const double s = 2 / ((i * i + j * j) + (k * k + w * w));
    x = {1 - s * (j * j + k * k), s * (i * j - w * k), s * (i * k + w * j)};
    y = {s * (i * j + w * k), 1 - s * (i * i + k * k), s * (j * k - w * i)};
    z = {s * (i * k - w * j), s * (j * k + w * i), 1 - s * (i * i + j * j)};
  }

  const Vector3d& row(int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};

double across(const Vector3d& r) { return std::sqrt(r.x() * r.x() + r.y() * r.y()); }

double greatest(const Vector3d& v) { return v.cwiseAbs().maxCoeff(); }

// The largest float that is not above x, and the smallest that is not below.
float round_down(double x) {
  if (x <= -double{kLargest}) return -kLargest;
  const auto rounded = static_cast<float>(x);
  return rounded > x ? std::nextafter(rounded, -std::numeric_limits<float>::infinity()) : rounded;
}
float round_up(double x) { return -round_down(-x); }

void set_axis(Aabb& extent, int axis, double lower, double upper, double slack) {
  extent.lower[axis] = round_down(lower - slack);
  extent.upper[axis] = round_up(upper + slack);
}

// The interval of points along one axis of the world.
struct Interval {
  double lower = std::numeric_limits<double>::infinity();
  double upper = -std::numeric_limits<double>::infinity();

  Interval(const Vector3d& row, const std::vector<Vector3d>& points) {
    for (const Vector3d& point : points) {
      lower = std::fmin(lower, inner_product(row, point));
      upper = std::fmax(upper, inner_product(row, point));
    }
  }
};

double greatest(const std::vector<Vector3d>& points, double size) {
  for (const Vector3d& point : points) size = std::fmax(size, greatest(point));
  return size;
}

// The vector, `thickness` long, from the front of a triangle to its back. Zero if the triangle has
// hardly any area, so that its normal is unreliable.
Vector3d way_back(const std::vector<Vector3d>& corners, double thickness) {
  const Vector3d u = corners[1] - corners[0];
  const Vector3d v = corners[2] - corners[0];
  const Vector3d n(u.y() * v.z() - u.z() * v.y(), u.z() * v.x() - u.x() * v.z(),
                   u.x() * v.y() - u.y() * v.x());
  const double length = std::sqrt(inner_product(n, n));
  if (!(length > 0x1p-24 * greatest(u) * greatest(v))) return Vector3d::Zero();
  return {-n.x() / length * thickness, -n.y() / length * thickness, -n.z() / length * thickness};
}

Aabb extent_of_points(const std::vector<Vector3d>& points, const Eigen::Quaternionf& orientation,
                      double radius = 0) {
  const Turn turn(orientation);
  const double slack = kTurnRounding * greatest(points, radius);
  Aabb extent;
  for (int axis = 0; axis < 3; ++axis) {
    const Interval of_points(turn.row(axis), points);
    set_axis(extent, axis, of_points.lower - radius, of_points.upper + radius, slack);
  }
  return extent;
}

std::vector<Vector3d> corners_of(const Eigen::Vector3f& lower, const Eigen::Vector3f& upper) {
  std::vector<Vector3d> corners;
  corners.reserve(8);
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back((i & 1 ? upper : lower).x(), (i & 2 ? upper : lower).y(),
                         (i & 4 ? upper : lower).z());
  }
  return corners;
}

// The extent of the corners of a k-DOP.
Aabb extent_of(const DopGeometry& geometry, const Eigen::Quaternionf& orientation) {
  const Turn turn(orientation);
  std::vector<Vector3d> points;
  for (size_t i = 0; i < geometry.polytope().point_count(); ++i) {
    const Double3 p = geometry.polytope().point(i);
    points.emplace_back(p[0], p[1], p[2]);
  }
  Aabb extent;
  for (int axis = 0; axis < 3; ++axis) {
    const Interval of_points(turn.row(axis), points);
    set_axis(extent, axis, of_points.lower, of_points.upper, kDopRounding * geometry.size());
  }
  return extent;
}

}  // namespace

Aabb turned_extent(const Capsule& capsule, const Eigen::Quaternionf& orientation) {
  const Turn turn(orientation);
  const std::vector<Vector3d> ends = {capsule.a.cast<double>(), capsule.b.cast<double>()};
  const double radius = capsule.radius;
  const double slack = kTurnRounding * greatest(ends, radius);
  Aabb extent;
  for (int axis = 0; axis < 3; ++axis) {
    const Interval ends_on_axis(turn.row(axis), ends);
    set_axis(extent, axis, ends_on_axis.lower - radius, ends_on_axis.upper + radius, slack);
  }
  return extent;
}

Aabb turned_extent(const carom::Box& box, const Eigen::Quaternionf& orientation) {
  const Turn turn(orientation);
  const Vector3d half = box.half.cast<double>();
  const double rounding = box.rounding;
  Aabb extent;
  for (int axis = 0; axis < 3; ++axis) {
    const double reach = inner_product(turn.row(axis).cwiseAbs(), half);
    set_axis(extent, axis, -reach - rounding, reach + rounding,
             kTurnRounding * std::fmax(greatest(half), rounding));
  }
  return extent;
}

Aabb turned_extent(const Cylinder& cylinder, const Eigen::Quaternionf& orientation) {
  const Turn turn(orientation);
  const double radius = cylinder.radius, half_length = cylinder.half_length;
  const double rounding = cylinder.rounding;
  const double slack = kTurnRounding * std::fmax(std::fmax(radius, half_length), rounding);
  Aabb extent;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d& r = turn.row(axis);
    const double reach = radius * across(r) + half_length * std::fabs(r.z());
    set_axis(extent, axis, -reach - rounding, reach + rounding, slack);
  }
  return extent;
}

Aabb turned_extent(const Cone& cone, const Eigen::Quaternionf& orientation) {
  const Turn turn(orientation);
  const double radius = cone.radius, half_length = cone.half_length, rounding = cone.rounding;
  const double slack = kTurnRounding * std::fmax(std::fmax(radius, half_length), rounding);
  Aabb extent;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d& r = turn.row(axis);
    const double base = radius * across(r), tip = half_length * r.z();
    set_axis(extent, axis, std::fmin(tip, -tip - base) - rounding,
             std::fmax(tip, base - tip) + rounding, slack);
  }
  return extent;
}

Aabb turned_extent(const Ellipsoid& ellipsoid, const Eigen::Quaternionf& orientation) {
  const Turn turn(orientation);
  const Vector3d semi_axes = ellipsoid.semi_axes.cast<double>();
  const double rounding = ellipsoid.rounding;
  Aabb extent;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d scaled = turn.row(axis).cwiseProduct(semi_axes);
    const double reach = std::sqrt(inner_product(scaled, scaled));
    set_axis(extent, axis, -reach - rounding, reach + rounding,
             kTurnRounding * std::fmax(greatest(semi_axes), rounding));
  }
  return extent;
}

Aabb turned_extent(const Triangle& triangle, const Eigen::Quaternionf& orientation) {
  const Turn turn(orientation);
  std::vector<Vector3d> corners;
  for (const Eigen::Vector3f& corner : triangle.corners) corners.push_back(corner.cast<double>());
  const double thickness = triangle.thickness;
  const double slack = kTurnRounding * greatest(corners, thickness);
  const Vector3d back = thickness > 0 ? way_back(corners, thickness) : Vector3d::Zero().eval();
  const double reach = thickness * (greatest(back) > 0 ? 0x1p-24 : 1);
  Aabb extent;
  for (int axis = 0; axis < 3; ++axis) {
    Interval front(turn.row(axis), corners);
    const double shift = inner_product(turn.row(axis), back);
    if (thickness > 0) {
      front.lower += std::fmin(shift, 0.0) - reach;
      front.upper += std::fmax(shift, 0.0) + reach;
    }
    set_axis(extent, axis, front.lower, front.upper, slack);
  }
  return extent;
}

Aabb turned_extent(const Dop& dop, const Eigen::Quaternionf& orientation) {
  return with_geometry(
      dop, [&](const DopGeometry& geometry) { return extent_of(geometry, orientation); });
}

Aabb turned_extent(const Hull& hull, const Eigen::Quaternionf& orientation) {
  std::vector<Vector3d> points;
  points.reserve(hull.geometry->points().size());
  for (const Eigen::Vector3f& p : hull.geometry->points()) points.push_back(p.cast<double>());
  return extent_of_points(points, orientation, hull.rounding);
}

Aabb turned_extent(const Mesh& mesh, const Eigen::Quaternionf& orientation) {
  return extent_of_points(corners_of(mesh.geometry->lower(), mesh.geometry->upper()), orientation);
}

Aabb turned_extent(const HeightField& field, const Eigen::Quaternionf& orientation) {
  return extent_of_points(corners_of(field.geometry->lower(), field.geometry->upper()),
                          orientation);
}

Aabb turned_extent(const Compound& compound, const Eigen::Quaternionf& orientation) {
  return extent_of_points(corners_of(compound.geometry->lower(), compound.geometry->upper()),
                          orientation);
}

Aabb turned_extent(const Halfspace&, const Eigen::Quaternionf&) { return {}; }

}  // namespace carom::reference
