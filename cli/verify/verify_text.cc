#include "cli/verify/verify_text.h"

#include <algorithm>
#include <cstdio>
#include <span>
#include <variant>

#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/height_field_geometry.h"
#include "carom/shapes/mesh_geometry.h"
#include "carom/shapes/views.h"

namespace carom::cli {
namespace {

template <class Vector>
std::string list(const Vector& v) {
  char text[160];
  std::snprintf(text, sizeof text, "(%a, %a, %a)", double{v[0]}, double{v[1]}, double{v[2]});
  return text;
}

std::string parameters(const Sphere& sphere) { return "radius " + text_of(sphere.radius); }

std::string parameters(const Aabb& box) {
  return "lower " + list(box.lower) + " upper " + list(box.upper);
}

std::string parameters(const Capsule& capsule) {
  return "a " + list(capsule.a) + " b " + list(capsule.b) + " radius " + text_of(capsule.radius);
}

std::string with_rounding(std::string text, float rounding) {
  return rounding == 0 ? text : text + " rounding " + text_of(rounding);
}

std::string parameters(const Box& box) {
  return with_rounding("half " + list(box.half), box.rounding);
}

std::string parameters(const Triangle& triangle) {
  const auto& [a, b, c] = triangle.corners;
  return list(a) + ' ' + list(b) + ' ' + list(c) + " thickness " + text_of(triangle.thickness) +
         (triangle.one_sided ? " one-sided" : "") + " inner edges " +
         std::to_string(triangle.inner_edges);
}

std::string parameters(const Cylinder& c) {
  return with_rounding("radius " + text_of(c.radius) + " half length " + text_of(c.half_length),
                       c.rounding);
}

std::string parameters(const Cone& c) {
  return with_rounding("radius " + text_of(c.radius) + " half length " + text_of(c.half_length),
                       c.rounding);
}

std::string parameters(const Ellipsoid& e) {
  return with_rounding("semi-axes " + list(e.semi_axes), e.rounding);
}

std::string parameters(const Halfspace& halfspace) {
  return "normal " + list(halfspace.normal) + " offset " + text_of(halfspace.offset);
}

std::string parameters(const Dop& dop) {
  std::string text = "k " + std::to_string(static_cast<int>(dop.kind));
  for (size_t i = 0; i < std::min(slab_count(dop.kind), kMostSlabs); ++i) {
    text += " [" + text_of(dop.lower[i]) + ", " + text_of(dop.upper[i]) + "]";
  }
  return text;
}

// The number of points and the first of them.
std::string list(std::span<const Eigen::Vector3f> points) {
  constexpr size_t kMost = 64;
  std::string text = std::to_string(points.size()) + " points";
  for (size_t i = 0; i < std::min(points.size(), kMost); ++i) text += ' ' + list(points[i]);
  return points.size() > kMost ? text + " ..." : text;
}

std::string parameters(const Hull& hull) {
  if (!hull.geometry) return "that is invalid";
  return with_rounding("of " + list(hull.geometry->points()), hull.rounding);
}

template <class Geometry>
std::string scale_text(const Geometry& geometry) {
  return geometry.is_scaled() ? " scale " + list(geometry.scale()) : "";
}

std::string parameters(const Mesh& mesh) {
  constexpr size_t kMost = 32;
  if (!mesh.geometry) return "that is invalid";
  const auto triangles = mesh.geometry->triangles();
  const MeshRules& rules = mesh.geometry->rules();
  std::string text = "of " + list(mesh.geometry->vertices()) + " and " +
                     std::to_string(triangles.size()) + " triangles";
  for (size_t i = 0; i < std::min(triangles.size(), kMost); ++i) {
    const auto& [a, b, c] = triangles[i];
    text += ' ' + std::to_string(a) + '-' + std::to_string(b) + '-' + std::to_string(c);
  }
  return text + (triangles.size() > kMost ? " ..." : "") + " thickness " +
         text_of(rules.thickness) + (rules.one_sided ? " one-sided" : "") +
         scale_text(*mesh.geometry);
}

std::string parameters(const HeightField& field) {
  constexpr uint32_t kMost = 64;
  if (!field.geometry) return "that is invalid";
  const HeightFieldGeometry& grid = *field.geometry;
  const uint64_t count = uint64_t{grid.nx()} * grid.ny();
  std::string text = "of " + std::to_string(grid.nx()) + " x " + std::to_string(grid.ny()) +
                     " samples, spacing " + text_of(grid.dx()) + ", " + text_of(grid.dy()) +
                     ", heights";
  for (uint32_t i = 0; i < std::min<uint64_t>(count, kMost); ++i) {
    text += ' ' + text_of(grid.height(i % grid.nx(), i / grid.nx()));
  }
  return text + (count > kMost ? " ..." : "") + scale_text(grid);
}

std::string list(const Orientation& q) {
  return "(" + text_of(q.x()) + ", " + text_of(q.y()) + ", " + text_of(q.z()) + ", " +
         text_of(q.w()) + ")";
}

std::string parameters(const Compound& compound);

std::string shape_text(const Shape& shape) {
  return name(kind_of(shape)) +
         (' ' + std::visit([](const auto& s) { return parameters(s); }, shape));
}

std::string parameters(const Compound& compound) {
  constexpr size_t kMost = 16;
  if (!compound.geometry) return "that is invalid";
  const auto children = compound.geometry->children();
  std::string text = "of " + std::to_string(children.size()) + " children";
  for (size_t i = 0; i < std::min(children.size(), kMost); ++i) {
    text += " [" + shape_text(children[i].shape) + " at " + list(children[i].position) +
            " orientation " + list(children[i].orientation) + "]";
  }
  return children.size() > kMost ? text + " ..." : text;
}

}  // namespace

std::string text_of(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%a", value);
  return text;
}

std::string text_of(const Eigen::Vector3f& v) { return list(v); }
std::string text_of(const Eigen::Vector3d& v) { return list(v); }

std::string text_of(const Shape& shape, const Pose& pose, PositionType positions) {
  const ShapeKind kind = kind_of(shape);
  std::string text = shape_text(shape) + " at " + text_of(pose.position);
  if (row_count(kind) > 0) text += " orientation " + list(pose.orientation);
  return text + (positions == PositionType::float64 ? " float64" : " float32");
}

std::string text_of(const BodyDesc& body, PositionType positions) {
  std::string text = text_of(body.shape, {body.position, body.orientation}, positions) +
                     " velocity " + text_of(body.linear_velocity);
  char rest[120];
  std::snprintf(rest, sizeof rest, " motion %d layer %#x mask %#x owner %u group %d space %u%s",
                static_cast<int>(body.motion), body.layer, body.mask, body.owner, body.group,
                body.space, body.sensor ? " sensor" : "");
  return text + rest;
}

std::string text_of(const Sweep& sweep) {
  return "displacement " + list(sweep.displacement) + " rotation " + list(sweep.rotation);
}

std::string text_of(const Contact& contact) {
  return "separation " + text_of(double{contact.separation}) + " normal " +
         text_of(contact.normal) + " arm_a " + text_of(contact.arm_a) + " arm_b " +
         text_of(contact.arm_b) + " normal_velocity " + text_of(double{contact.normal_velocity}) +
         " status " + std::to_string(static_cast<int>(contact.status)) + " manifold of " +
         std::to_string(contact.manifold_count);
}

std::string text_of(const ManifoldPoints& manifold) {
  std::string text;
  for (size_t i = 0; i < manifold.point.size(); ++i) {
    text += (i ? ", " : "") + list(manifold.point[i]) + " separation " +
            text_of(manifold.separation[i]);
  }
  return text;
}

std::string text_of(const reference::Box& box) {
  return text_of(box.lower) + " - " + text_of(box.upper);
}

}  // namespace carom::cli
