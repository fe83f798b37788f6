#include "reference/shape_sizes.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/height_field_geometry.h"
#include "carom/shapes/mesh_geometry.h"
#include "reference/vectors.h"
#include "shapes/dop_geometry.h"
#include "shapes/hull_features.h"

namespace carom::reference {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

// The distance of the furthest corner of a box.
double reach_of_box(const Vector3f& lower, const Vector3f& upper) {
  return norm(lower.cwiseAbs().cwiseMax(upper.cwiseAbs()).eval());
}

double reach(const Sphere& sphere) { return sphere.radius; }
double reach(const Aabb& box) { return reach_of_box(box.lower, box.upper); }
double reach(const Capsule& c) { return std::max(norm(c.a), norm(c.b)) + c.radius; }
double reach(const carom::Box& box) { return norm(box.half) + box.rounding; }
double reach(const Cylinder& c) { return norm(Vector3f(c.radius, c.half_length, 0)) + c.rounding; }
double reach(const Cone& c) { return norm(Vector3f(c.radius, c.half_length, 0)) + c.rounding; }
double reach(const Ellipsoid& e) { return double{e.semi_axes.maxCoeff()} + e.rounding; }
double reach(const Triangle& t) {
  const auto& c = t.corners;
  return std::max({norm(c[0]), norm(c[1]), norm(c[2])}) + t.thickness;
}
double reach(const Halfspace&) { return kInfinity; }
double reach(const Dop& dop) {
  return with_geometry(dop, [](const DopGeometry& geometry) {
    double furthest = 0;
    for (size_t i = 0; i < geometry.polytope().point_count(); ++i) {
      const Double3 p = geometry.polytope().point(i);
      furthest = std::max(furthest, norm(Vector3d(p[0], p[1], p[2])));
    }
    return furthest + kDopRounding * geometry.size();
  });
}
double reach(const Hull& hull) {
  double furthest = 0;
  for (const Vector3f& p : hull.geometry->points()) furthest = std::max(furthest, norm(p));
  return furthest + hull.rounding;
}
double reach(const Mesh& mesh) {
  return reach_of_box(mesh.geometry->lower(), mesh.geometry->upper());
}
double reach(const HeightField& field) {
  return reach_of_box(field.geometry->lower(), field.geometry->upper());
}
double reach(const Compound& compound) {
  return reach_of_box(compound.geometry->lower(), compound.geometry->upper());
}

double diameter(const Sphere& sphere) { return 2 * double{sphere.radius}; }
double diameter(const Aabb& box) {
  return (box.upper.cast<double>() - box.lower.cast<double>()).minCoeff();
}
double diameter(const Capsule& capsule) { return 2 * double{capsule.radius}; }
double diameter(const carom::Box& box) { return 2 * (double{box.half.minCoeff()} + box.rounding); }
double diameter(const Cylinder& c) {
  return 2 * (double{std::min(c.radius, c.half_length)} + c.rounding);
}
// The ball touches the base and the side.
double diameter(const Cone& c) {
  const double radius = c.radius, length = 2 * double{c.half_length};
  const double side = std::sqrt(radius * radius + length * length);
  const double of_cone = radius > 0 ? 2 * radius * length / (radius + side) : 0;
  return of_cone + 2 * double{c.rounding};
}
double diameter(const Ellipsoid& e) { return 2 * (double{e.semi_axes.minCoeff()} + e.rounding); }
double diameter(const Triangle&) { return 0; }
double diameter(const Halfspace&) { return kInfinity; }
// The diameter of the largest ball around the middle of the first three slabs that stays within all
// slabs.
double diameter(const Dop& dop) {
  const auto middle_of = [&](size_t slab) {
    return (double{dop.lower[slab]} + double{dop.upper[slab]}) / 2;
  };
  const Vector3d middle(middle_of(0), middle_of(1), middle_of(2));
  double radius = kInfinity;
  const auto directions = slab_directions(dop.kind);
  for (size_t slab = 0; slab < directions.size(); ++slab) {
    const auto& [x, y, z] = directions[slab];
    const double height = x * middle.x() + y * middle.y() + z * middle.z();
    const double room = std::min(dop.upper[slab] - height, height - dop.lower[slab]);
    radius = std::min(radius, room / std::sqrt(x * x + y * y + z * z));
  }
  return 2 * std::max(radius, 0.0);
}
double diameter(const Hull& hull) {
  const HullFeatures* features = hull.geometry->features();
  const double of_core = features ? 2 * double{features->inner_radius()} : 0;
  return of_core + 2 * double{hull.rounding};
}
double diameter(const Mesh&) { return 0; }
double diameter(const HeightField&) { return 0; }
double diameter(const Compound& compound) {
  double least = kInfinity;
  for (const CompoundChild& child : compound.geometry->children()) {
    least = std::min(least, inner_diameter(child.shape));
  }
  return least;
}

}  // namespace

// Rounds up, and takes one float more, which covers the rounding above.
float bounding_radius(const Shape& shape) {
  const double exact =
      std::min(std::visit([](const auto& s) { return reach(s); }, shape), double{kLargest});
  const auto nearest = static_cast<float>(exact);
  const float above = nearest < exact ? std::nextafter(nearest, kLargest) : nearest;
  return std::nextafter(above, kLargest);
}

double inner_diameter(const Shape& shape) {
  return std::visit([](const auto& s) { return diameter(s); }, shape);
}

}  // namespace carom::reference
