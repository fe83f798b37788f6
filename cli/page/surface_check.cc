#include "cli/page/surface_check.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/views.h"
#include "geometries/surface.h"
#include "oracle/convex_oracle.h"
#include "oracle/round_surface.h"

namespace carom::cli {
namespace {

using Vec = oracle::Vec3<long double>;
using oracle::vec3_as;

// The oracle's time to find the faces of a hull grows with the cube of its corners.
constexpr size_t kMostCorners = 256;

// Rotates from a body's frame into the frame of a child with orientation q.
Vec turned_back(const Vec& v, const Eigen::Quaternionf& q) {
  return oracle::Rotation<long double>(q.conjugate())(v);
}

Shape triangle_of(const Surface& surface, size_t index) {
  return Triangle{surface.corners(index), surface.rules().thickness};
}

bool is_too_large(const Shape& shape) {
  const Hull* hull = std::get_if<Hull>(&shape);
  return hull != nullptr && hull->geometry->points().size() > kMostCorners;
}

// Distance of the point from the box around a triangle: a lower bound of its distance from the
// triangle.
double distance_to_box(const Surface& surface, size_t index, const Vec& point) {
  const auto [a, b, c] = surface.corners(index);
  const Eigen::Vector3d p(double(point.x), double(point.y), double(point.z));
  const Eigen::Vector3d lower = a.cwiseMin(b).cwiseMin(c).cast<double>();
  const Eigen::Vector3d upper = a.cwiseMax(b).cwiseMax(c).cast<double>();
  const Eigen::Vector3d beyond = (lower - p).cwiseMax(p - upper).cwiseMax(0);
  return beyond.norm() - surface.rules().thickness;
}

// Distances of points from surfaces, in the frame of the shape. Caches hulls.
class Surfaces {
 public:
  // Distance from the nearest part; nothing if a hull is too large.
  std::optional<double> distance(const Shape& shape, const Vec& point) {
    if (const Compound* compound = std::get_if<Compound>(&shape)) {
      return to_children(*compound->geometry, point);
    }
    if (const Mesh* mesh = std::get_if<Mesh>(&shape)) return to_triangles(*mesh->geometry, point);
    if (const HeightField* field = std::get_if<HeightField>(&shape)) {
      return to_triangles(*field->geometry, point);
    }
    if (is_too_large(shape)) return std::nullopt;
    if (const auto distance_to_round = oracle::round_surface_distance(shape, point)) {
      return static_cast<double>(*distance_to_round);
    }
    return to_simple(shape, point);
  }

 private:
  std::optional<double> to_children(const CompoundGeometry& compound, const Vec& point) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const CompoundChild& child : compound.children()) {
      Vec in_child = point - vec3_as<long double>(child.position);
      if (row_count(kind_of(child.shape)) > 0) in_child = turned_back(in_child, child.orientation);
      const std::optional<double> distance_to_child = distance(child.shape, in_child);
      if (!distance_to_child) return std::nullopt;
      nearest = std::min(nearest, *distance_to_child);
    }
    return nearest;
  }

  template <class Geometry>
  double to_triangles(const Geometry& surface, const Vec& point) {
    double nearest = std::numeric_limits<double>::infinity();
    for_each_triangle(surface, [&](size_t i) {
      if (distance_to_box(surface, i, point) >= nearest) return;
      nearest = std::min(nearest, to_simple(triangle_of(surface, i), point));
    });
    return nearest;
  }

  double to_simple(const Shape& shape, const Vec& point) {
    return static_cast<double>(oracle::surface_distance(convex(shape), point));
  }

  const oracle::ConvexShape<>& convex(const Shape& shape) {
    const Hull* hull = std::get_if<Hull>(&shape);
    if (hull == nullptr) return other_.emplace(shape, Pose{});
    const std::pair key(hull->geometry.get(), hull->rounding);
    return hulls_.try_emplace(key, shape, Pose{}).first->second;
  }

  std::map<std::pair<const HullGeometry*, float>, oracle::ConvexShape<>> hulls_;
  std::optional<oracle::ConvexShape<>> other_;
};

class Checker {
 public:
  explicit Checker(const World& world) : world_(world) {}

  SurfaceCheck run() {
    const bool has_manifolds = !world_.manifolds().empty();
    for (contact_ = 0; contact_ < world_.contacts().size(); ++contact_) {
      const Contact& contact = world_.contacts()[contact_];
      note(contact.a, contact.arm_a.cast<double>(), check_.on);
      note(contact.b, contact.arm_b.cast<double>(), check_.on);
      if (has_manifolds) add_manifold(contact, world_.manifolds()[contact_]);
    }
    return std::move(check_);
  }

 private:
  void add_manifold(const Contact& contact, const ManifoldPoints& manifold) {
    const Eigen::Vector3d from_b_to_a = position(contact.a) - position(contact.b);
    for (size_t i = 0; i < contact.manifold_count; ++i) {
      const Eigen::Vector3d arm = Eigen::Vector3f(manifold.point[i].data()).cast<double>();
      const Eigen::Vector3d way = double{manifold.separation[i]} * contact.normal.cast<double>();
      note(contact.a, arm, check_.on);
      note(contact.b, from_b_to_a + arm + way, check_.across);
    }
  }

  Eigen::Vector3d position(uint32_t body) const { return world_.position(world_.id_of(body)); }

  void note(uint32_t body, const Eigen::Vector3d& arm, SurfaceDistances& distances) {
    const BodyId id = world_.id_of(body);
    const Vec point = turned_back(vec3_as<long double>(arm), world_.orientation(id));
    if (const auto distance = surfaces_.distance(world_.shape(id), point)) {
      distances.add(*distance, contact_);
    } else {
      ++check_.left_out;
    }
  }

  const World& world_;
  Surfaces surfaces_;
  SurfaceCheck check_;
  size_t contact_ = 0;
};

}  // namespace

void SurfaceDistances::add(double distance, size_t contact) {
  if (metres.empty() || distance > greatest) {
    greatest = distance;
    furthest_contact = contact;
  }
  metres.push_back(distance);
}

SurfaceCheck check_surfaces(const World& world) { return Checker(world).run(); }

}  // namespace carom::cli
