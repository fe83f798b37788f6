#include "tests/support/textbook.h"

namespace carom::test {

RoundedBox rounded_box(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    return {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), sphere->radius};
  }
  const Aabb& box = std::get<Aabb>(shape);
  return {box.lower.cast<double>(), box.upper.cast<double>(), 0};
}

double textbook_separation(const Shape& shape_a, const Shape& shape_b, const Eigen::Vector3d& d) {
  const RoundedBox a = rounded_box(shape_a);
  const RoundedBox b = rounded_box(shape_b);
  const Eigen::Vector3d gap = (b.lower + d - a.upper).cwiseMax(a.lower - b.upper - d);
  const double core = gap.maxCoeff() > 0 ? gap.cwiseMax(0).stableNorm() : gap.maxCoeff();
  return core - a.radius - b.radius;
}

double bounding_radius(const Sphere& sphere) { return sphere.radius; }

double bounding_radius(const Aabb& box) {
  return box.lower.cwiseAbs().cwiseMax(box.upper.cwiseAbs()).cast<double>().stableNorm();
}

double bounding_radius(const Capsule& c) {
  return std::max(c.a.cast<double>().stableNorm(), c.b.cast<double>().stableNorm()) + c.radius;
}

double bounding_radius(const Box& box) {
  return box.half.cast<double>().stableNorm() + box.rounding;
}

double bounding_radius(const Cylinder& cylinder) {
  return std::hypot(double{cylinder.radius}, double{cylinder.half_length}) + cylinder.rounding;
}

double bounding_radius(const Cone& cone) {
  return std::hypot(double{cone.radius}, double{cone.half_length}) + cone.rounding;
}

double bounding_radius(const Ellipsoid& ellipsoid) {
  return double{ellipsoid.semi_axes.maxCoeff()} + ellipsoid.rounding;
}

double bounding_radius(const Triangle& triangle) {
  double radius = 0;
  for (const Eigen::Vector3f& corner : triangle.corners) {
    radius = std::max(radius, corner.cast<double>().stableNorm());
  }
  return radius + triangle.thickness;
}

double bounding_radius(const Dop& dop) {
  const auto reach = [&](size_t i) {
    return std::max(std::fabs(double{dop.lower[i]}), std::fabs(double{dop.upper[i]}));
  };
  return Eigen::Vector3d(reach(0), reach(1), reach(2)).stableNorm();
}

double bounding_radius(const Hull& hull) {
  double radius = 0;
  for (const Eigen::Vector3f& point : hull.geometry->points()) {
    radius = std::max(radius, point.cast<double>().stableNorm());
  }
  return radius + hull.rounding;
}

double bounding_radius(const Halfspace&) { return 0; }

double bounding_radius(const Mesh& mesh) {
  return bounding_radius(Aabb{mesh.geometry->lower(), mesh.geometry->upper()});
}

double bounding_radius(const HeightField& field) {
  return bounding_radius(Aabb{field.geometry->lower(), field.geometry->upper()});
}

double bounding_radius(const Compound& compound) {
  return bounding_radius(Aabb{compound.geometry->lower(), compound.geometry->upper()});
}

double bounding_radius(const Shape& shape) {
  return std::visit([](const auto& s) { return bounding_radius(s); }, shape);
}

}  // namespace carom::test
