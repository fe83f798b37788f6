#include "bench/peers/narrowphase/peer_bodies.h"

#include <map>
#include <variant>

namespace carom::bench {
namespace {

std::array<float, 9> peer_size(const Sphere& sphere) { return {sphere.radius}; }
std::array<float, 9> peer_size(const Capsule& capsule) { return {capsule.radius, capsule.b.y()}; }
std::array<float, 9> peer_size(const Aabb& box) {
  return {box.upper.x(), box.upper.y(), box.upper.z()};
}
std::array<float, 9> peer_size(const Box& box) {
  return {box.half.x(), box.half.y(), box.half.z()};
}
std::array<float, 9> peer_size(const Cylinder& cylinder) {
  return {cylinder.radius, cylinder.half_length};
}
std::array<float, 9> peer_size(const Cone& cone) { return {cone.radius, cone.half_length}; }
std::array<float, 9> peer_size(const Ellipsoid& ellipsoid) {
  return {ellipsoid.semi_axes.x(), ellipsoid.semi_axes.y(), ellipsoid.semi_axes.z()};
}
std::array<float, 9> peer_size(const Triangle& triangle) {
  const auto& [a, b, c] = triangle.corners;
  return {a.x(), a.y(), a.z(), b.x(), b.y(), b.z(), c.x(), c.y(), c.z()};
}
// Hulls have points instead of sizes; there are no streams of the other kinds.
template <class Other>
std::array<float, 9> peer_size(const Other& /*shape*/) {
  return {};
}

PeerShape peer_shape(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::sphere:
      return PeerShape::sphere;
    case ShapeKind::capsule:
      return PeerShape::capsule;
    case ShapeKind::triangle:
      return PeerShape::triangle;
    case ShapeKind::hull:
      return PeerShape::hull;
    case ShapeKind::cylinder:
      return PeerShape::cylinder;
    case ShapeKind::cone:
      return PeerShape::cone;
    case ShapeKind::ellipsoid:
      return PeerShape::ellipsoid;
    default:
      return PeerShape::box;
  }
}

// Collects hulls, each geometry once.
class PeerHulls {
 public:
  explicit PeerHulls(std::vector<PeerHull>& all) : all_(all) {}

  // Index of a shape's hull; 0 for other shapes.
  size_t place_of(const Shape& shape) {
    const auto* hull = std::get_if<Hull>(&shape);
    if (!hull) return 0;
    const auto [found, is_new] = places_.emplace(hull->geometry.get(), all_.size());
    if (is_new) {
      PeerHull& plain = all_.emplace_back();
      for (const Eigen::Vector3f& p : hull->geometry->points()) {
        plain.points.push_back({p.x(), p.y(), p.z()});
      }
      for (const HullGeometry::Face& face : hull->geometry->faces()) {
        const auto outline = hull->geometry->corners(face);
        plain.faces.emplace_back(outline.begin(), outline.end());
      }
    }
    return found->second;
  }

 private:
  std::vector<PeerHull>& all_;
  std::map<const HullGeometry*, size_t> places_;
};

PeerBody peer_body(const PlacedShape& body) {
  const Eigen::Vector3f p = body.position.cast<float>();
  const Eigen::Vector4f q = body.orientation.coeffs();
  return {{p.x(), p.y(), p.z()},
          {q.x(), q.y(), q.z(), q.w()},
          std::visit([](const auto& shape) { return peer_size(shape); }, body.shape)};
}

}  // namespace

PeerBodies peer_bodies(ShapeKind kind, const std::vector<PlacedShape>& bodies) {
  PeerBodies all = {.shape = peer_shape(kind)};
  PeerHulls hulls(all.hulls);
  for (const PlacedShape& body : bodies) {
    all.bodies.push_back(peer_body(body));
    all.bodies.back().hull = hulls.place_of(body.shape);
  }
  return all;
}

PeerBodies peer_meshes(std::span<const Eigen::Vector3f> vertices,
                       std::span<const std::array<uint32_t, 3>> triangles,
                       const std::vector<PlacedShape>& bodies) {
  PeerBodies all = {.shape = PeerShape::mesh};
  for (const Eigen::Vector3f& p : vertices) all.vertices.push_back({p.x(), p.y(), p.z()});
  all.triangles.assign(triangles.begin(), triangles.end());
  for (const PlacedShape& body : bodies) all.bodies.push_back(peer_body(body));
  return all;
}

}  // namespace carom::bench
