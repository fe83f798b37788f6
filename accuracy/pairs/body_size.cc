#include "accuracy/pairs/body_size.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/height_field_geometry.h"
#include "carom/shapes/mesh_geometry.h"

namespace carom::accuracy {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double farthest_corner(const Vector3d& lower, const Vector3d& upper) {
  return lower.cwiseAbs().cwiseMax(upper.cwiseAbs()).norm();
}

double edge_ratio(const Vector3d& edges) {
  return edges.minCoeff() > 0 ? edges.maxCoeff() / edges.minCoeff() : kInfinity;
}

Vector3d lower_corner(const Dop& dop) { return {dop.lower[0], dop.lower[1], dop.lower[2]}; }
Vector3d upper_corner(const Dop& dop) { return {dop.upper[0], dop.upper[1], dop.upper[2]}; }

struct Radius {
  double operator()(const Sphere& sphere) const { return sphere.radius; }
  double operator()(const Aabb& box) const {
    return farthest_corner(box.lower.cast<double>(), box.upper.cast<double>());
  }
  double operator()(const Capsule& capsule) const {
    return std::max(capsule.a.cast<double>().norm(), capsule.b.cast<double>().norm()) +
           capsule.radius;
  }
  double operator()(const Box& box) const { return box.half.cast<double>().norm() + box.rounding; }
  double operator()(const Cylinder& c) const {
    return std::hypot(c.radius, c.half_length) + c.rounding;
  }
  double operator()(const Cone& c) const {
    return std::hypot(c.radius, c.half_length) + c.rounding;
  }
  double operator()(const Ellipsoid& e) const { return e.semi_axes.maxCoeff() + e.rounding; }
  double operator()(const Triangle& triangle) const {
    double farthest = 0;
    for (const Eigen::Vector3f& corner : triangle.corners) {
      farthest = std::max(farthest, corner.cast<double>().norm());
    }
    return farthest + triangle.thickness;
  }
  double operator()(const Halfspace&) const { return kInfinity; }
  double operator()(const Dop& dop) const {
    return farthest_corner(lower_corner(dop), upper_corner(dop));
  }
  double operator()(const Hull& hull) const {
    double farthest = 0;
    for (const Eigen::Vector3f& point : hull.geometry->points()) {
      farthest = std::max(farthest, point.cast<double>().norm());
    }
    return farthest + hull.rounding;
  }
  double operator()(const Mesh& mesh) const { return of_box(*mesh.geometry); }
  double operator()(const HeightField& field) const { return of_box(*field.geometry); }
  double operator()(const Compound& compound) const { return of_box(*compound.geometry); }

  template <class Geometry>
  static double of_box(const Geometry& geometry) {
    return farthest_corner(geometry.lower().template cast<double>(),
                           geometry.upper().template cast<double>());
  }
};

struct Aspect {
  double operator()(const Sphere&) const { return 1; }
  double operator()(const Halfspace&) const { return 1; }
  double operator()(const Aabb& box) const {
    return edge_ratio((box.upper - box.lower).cast<double>());
  }
  double operator()(const Box& box) const { return edge_ratio(box.half.cast<double>()); }
  double operator()(const Cylinder& c) const {
    return edge_ratio({c.radius, c.radius, c.half_length});
  }
  double operator()(const Cone& c) const { return edge_ratio({c.radius, c.radius, c.half_length}); }
  double operator()(const Ellipsoid& e) const { return edge_ratio(e.semi_axes.cast<double>()); }
  double operator()(const Dop& dop) const {
    return edge_ratio(upper_corner(dop) - lower_corner(dop));
  }
  // The aspect of its bounding box.
  double operator()(const Hull& hull) const {
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& point : hull.geometry->points()) box.extend(point);
    return edge_ratio(box.sizes().cast<double>());
  }
  double operator()(const Mesh& mesh) const { return of_box(*mesh.geometry); }
  double operator()(const HeightField& field) const { return of_box(*field.geometry); }
  double operator()(const Compound& compound) const { return of_box(*compound.geometry); }

  template <class Geometry>
  static double of_box(const Geometry& geometry) {
    return edge_ratio((geometry.upper() - geometry.lower()).template cast<double>());
  }

  double operator()(const Capsule& capsule) const {
    const double width = 2 * double{capsule.radius};
    const double length = (capsule.b - capsule.a).cast<double>().norm();
    return edge_ratio({width, width, length + width});
  }
  double operator()(const Triangle& triangle) const {
    const Vector3d a = triangle.corners[0].cast<double>();
    const Vector3d b = triangle.corners[1].cast<double>() - a;
    const Vector3d c = triangle.corners[2].cast<double>() - a;
    const double longest = std::max({b.norm(), c.norm(), (c - b).norm()});
    const double twice_area = b.cross(c).norm();
    return twice_area > 0 ? longest * longest / twice_area : kInfinity;
  }
};

}  // namespace

double bounding_radius(const Shape& shape) { return std::visit(Radius{}, shape); }
double aspect(const Shape& shape) { return std::visit(Aspect{}, shape); }

}  // namespace carom::accuracy
