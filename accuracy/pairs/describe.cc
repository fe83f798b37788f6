#include "accuracy/pairs/describe.h"

#include <cstdio>

#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/height_field_geometry.h"
#include "carom/shapes/mesh_geometry.h"

namespace carom::accuracy {
namespace {

template <class Vector>
std::string list(const Vector& v) {
  std::string all;
  for (int i = 0; i < v.size(); ++i) {
    all += (i > 0 ? " " : "") + text("%a", static_cast<double>(v[i]));
  }
  return "(" + all + ")";
}

std::string numbers(const Sphere& sphere) { return text("%a", sphere.radius); }
std::string numbers(const Capsule& c) { return list(c.a) + list(c.b) + text(" %a", c.radius); }
std::string numbers(const Aabb& box) { return list(box.lower) + list(box.upper); }
std::string numbers(const Box& box) { return list(box.half) + text(" %a", box.rounding); }
std::string numbers(const Cylinder& c) {
  return text("%a", c.radius) + text(" %a", c.half_length) + text(" %a", c.rounding);
}
std::string numbers(const Cone& c) {
  return text("%a", c.radius) + text(" %a", c.half_length) + text(" %a", c.rounding);
}
std::string numbers(const Ellipsoid& e) { return list(e.semi_axes) + text(" %a", e.rounding); }
std::string numbers(const Halfspace& h) { return list(h.normal) + text(" %a", h.offset); }
std::string numbers(const Triangle& triangle) {
  std::string all;
  for (const Eigen::Vector3f& corner : triangle.corners) all += list(corner);
  return all + text(" %a", triangle.thickness);
}
std::string numbers(const Dop& dop) {
  const auto count = static_cast<Eigen::Index>(slab_count(dop.kind));
  const Eigen::Map<const Eigen::VectorXf> lower(dop.lower.data(), count);
  const Eigen::Map<const Eigen::VectorXf> upper(dop.upper.data(), count);
  return std::to_string(static_cast<int>(dop.kind)) + list(lower) + list(upper);
}

std::string numbers(const Hull& hull) {
  std::string all;
  for (const Eigen::Vector3f& point : hull.geometry->points()) all += list(point);
  return all + text(" %a", hull.rounding);
}
std::string numbers(const Mesh& mesh) {
  return std::to_string(mesh.geometry->triangles().size()) + " triangles";
}
std::string numbers(const HeightField& field) {
  return std::to_string(field.geometry->nx()) + " x " + std::to_string(field.geometry->ny()) +
         " samples";
}
std::string numbers(const Compound& compound) {
  return std::to_string(compound.geometry->children().size()) + " children";
}

std::string describe(const Shape& shape, const Pose& pose) {
  return std::string(name(kind_of(shape))) + " " +
         std::visit([](const auto& s) { return numbers(s); }, shape) + " at " +
         list(pose.position) + " turned " + list(pose.orientation.coeffs());
}

}  // namespace

std::string text(const char* format, double value) {
  char line[64];
  std::snprintf(line, sizeof line, format, value);
  return line;
}

std::string describe(const ConvexPair& pair, PositionType positions) {
  return describe(pair.shape_a, pair.pose_a) + " - " + describe(pair.shape_b, pair.pose_b) +
         (positions == PositionType::float32 ? ", float32" : ", float64");
}

}  // namespace carom::accuracy
