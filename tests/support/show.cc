#include "tests/support/show.h"

namespace carom::test {

std::string hex(double x) {
  char text[64];
  std::snprintf(text, sizeof text, "%a", x);
  return text;
}

std::string show(const Sphere& sphere) { return "r " + hex(sphere.radius); }

std::string show(const Aabb& box) { return hex3(box.lower) + " .. " + hex3(box.upper); }

std::string show(const Capsule& capsule) {
  return hex3(capsule.a) + " .. " + hex3(capsule.b) + " r " + hex(capsule.radius);
}

std::string with_rounding(std::string text, float rounding) {
  return rounding == 0 ? text : text + " rounding " + hex(rounding);
}

std::string show(const Box& box) { return with_rounding("half " + hex3(box.half), box.rounding); }

std::string show(const Cylinder& cylinder) {
  return with_rounding("r " + hex(cylinder.radius) + " h " + hex(cylinder.half_length),
                       cylinder.rounding);
}

std::string show(const Cone& cone) {
  return with_rounding("r " + hex(cone.radius) + " h " + hex(cone.half_length), cone.rounding);
}

std::string show(const Ellipsoid& ellipsoid) {
  return with_rounding("axes " + hex3(ellipsoid.semi_axes), ellipsoid.rounding);
}

std::string show(const Triangle& triangle) {
  std::string text;
  for (const Eigen::Vector3f& corner : triangle.corners) text += "(" + hex3(corner) + ") ";
  return text + "thickness " + hex(triangle.thickness) + (triangle.one_sided ? " one-sided" : "") +
         " inner edges " + std::to_string(triangle.inner_edges);
}

std::string show(const Halfspace& halfspace) {
  return "(" + hex3(halfspace.normal) + ") <= " + hex(halfspace.offset);
}

std::string show(const Dop& dop) {
  std::string text = "k = " + std::to_string(static_cast<int>(dop.kind));
  for (size_t i = 0; i < std::min(slab_count(dop.kind), kMostSlabs); ++i) {
    text += (i ? ", " : " ") + hex(dop.lower[i]) + " .. " + hex(dop.upper[i]);
  }
  return text;
}

std::string show(const Hull& hull) {
  if (!hull.geometry) return "without geometry";
  std::string text = std::to_string(hull.geometry->faces().size()) + " faces";
  for (const Eigen::Vector3f& point : hull.geometry->points()) text += " (" + hex3(point) + ")";
  return with_rounding(text, hull.rounding);
}

std::string show(const Mesh& mesh) {
  if (!mesh.geometry) return "without geometry";
  return std::to_string(mesh.geometry->triangles().size()) + " triangles";
}

std::string show(const HeightField& field) {
  if (!field.geometry) return "without geometry";
  return std::to_string(field.geometry->nx()) + " x " + std::to_string(field.geometry->ny()) +
         " samples";
}

std::string show(const Compound& compound) {
  if (!compound.geometry) return "without geometry";
  return std::to_string(compound.geometry->children().size()) + " children";
}

std::string show(const PlacedShape& body) {
  std::string text = carom::name(kind_of(body.shape));
  text += " " + std::visit([](const auto& shape) { return show(shape); }, body.shape);
  text += " @ " + hex3(body.position);
  if (!has_rows(body.shape)) return text;
  const Eigen::Vector4f& q = body.orientation.coeffs();
  return text + " turned " + hex3(q) + ", " + hex(q[3]);
}

std::string show(const TestPair& pair) { return show(pair.a) + "\n" + show(pair.b); }

}  // namespace carom::test
