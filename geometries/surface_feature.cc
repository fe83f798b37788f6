#include "geometries/surface_feature.h"

#include <cmath>
#include <utility>

#include "shapes/dop_polytope.h"
#include "shapes/hull_features.h"

namespace carom {
namespace {

// What kind of feature a name is of, in its two highest bits.
enum class Kind : uint32_t { smooth = 0, vertex = 1, edge = 2, face = 3 };

constexpr uint32_t kIndexMask = 0x3fffffffu;

uint32_t name_of(Kind kind, uint32_t index) {
  return static_cast<uint32_t>(kind) << 30 | (index & kIndexMask);
}

// Scrambles two numbers to one. Source: the finaliser of MurmurHash3 (A. Appleby, public domain).
uint32_t mixed(uint32_t a, uint32_t b) {
  uint64_t x = (uint64_t{a} << 32 | b) + 0x9e3779b97f4a7c15u;
  x = (x ^ x >> 33) * 0xff51afd7ed558ccdu;
  x = (x ^ x >> 33) * 0xc4ceb9fe1a85ec53u;
  return static_cast<uint32_t>(x ^ x >> 33);
}

double norm_of(const Double3& v) { return std::sqrt(dot(v, v)); }

// The planes of a polytope on which the point lies. Two planes make an edge, more a vertex. A point
// inside takes the plane that it is nearest to.
class TouchedPlanes {
 public:
  explicit TouchedPlanes(double size) : near_(kOnFeature * size) {}

  // `height`: of the point over the plane; negative inside.
  void add(uint32_t plane, double height) {
    if (count_ == 0 || height > highest_) {
      highest_ = height;
      nearest_ = plane;
    }
    if (height < -near_) return;
    ++count_;
    planes_ = mixed(planes_, plane);
  }

  uint32_t name() const {
    if (count_ == 0 || count_ == 1) return name_of(Kind::face, nearest_);
    return name_of(count_ == 2 ? Kind::edge : Kind::vertex, planes_);
  }

 private:
  const double near_;
  uint32_t count_ = 0, planes_ = 0, nearest_ = 0;
  double highest_ = 0;
};

uint32_t box_feature(const Double3& lower, const Double3& upper, const Double3& point) {
  TouchedPlanes touched(std::max(greatest(lower), greatest(upper)));
  for (uint32_t axis = 0; axis < 3; ++axis) {
    touched.add(2 * axis, point[axis] - upper[axis]);
    touched.add(2 * axis + 1, lower[axis] - point[axis]);
  }
  return touched.name();
}

uint32_t capsule_feature(const Part& part, const Double3& point) {
  const Double3 a = {part.rows[0][0], part.rows[0][1], part.rows[0][2]};
  const Double3 b = {part.rows[1][0], part.rows[1][1], part.rows[1][2]};
  const Double3 axis = minus(b, a);
  const double squared = dot(axis, axis);
  const double along = squared > 0 ? dot(minus(point, a), axis) / squared : 0;
  if (along <= kOnFeature) return name_of(Kind::vertex, 0);
  if (along >= 1 - kOnFeature) return name_of(Kind::vertex, 1);
  return name_of(Kind::edge, 0);
}

uint32_t dop_feature(const Part& part, const Double3& point) {
  const DopSlabs slabs(std::get<Dop>(shape_from_rows(part.kind, part.rows.data())));
  TouchedPlanes touched(slabs.size());
  const auto directions = slab_directions(slabs.kind);
  for (uint32_t i = 0; i < directions.size(); ++i) {
    const Double3 n = {double(directions[i][0]), double(directions[i][1]),
                       double(directions[i][2])};
    const double scale = 1 / norm_of(n), at = dot(n, point);
    touched.add(2 * i, (at - slabs.upper[i]) * scale);
    touched.add(2 * i + 1, (slabs.lower[i] - at) * scale);
  }
  return touched.name();
}

// A hull that is flat, or has no faces, has vertices alone.
uint32_t nearest_point(const HullGeometry& hull, const Double3& point) {
  uint32_t nearest = 0;
  double least = HUGE_VAL;
  for (uint32_t i = 0; i < hull.points().size(); ++i) {
    const Double3 way = minus(wide(hull.points()[i]), point);
    if (dot(way, way) < least) {
      least = dot(way, way);
      nearest = i;
    }
  }
  return name_of(Kind::vertex, nearest);
}

uint32_t hull_feature(const HullGeometry& hull, const Double3& point) {
  const HullFeatures* const features = hull.features();
  if (!features) return nearest_point(hull, point);
  TouchedPlanes touched(hull.size());
  for (uint32_t face = 0; face < features->face_count(); ++face) {
    touched.add(face, dot(wide(features->normal(face)), point) - features->height(face));
  }
  return touched.name();
}

// `index` names the corners and `own` the triangle.
uint32_t triangle_feature(const std::array<Double3, 3>& corners,
                          const std::array<uint32_t, 3>& index, uint32_t own,
                          const Double3& point) {
  const Double3 normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
  std::array<bool, 3> on{};  // edge i goes from corner i to the next
  double size = 0;
  for (const Double3& corner : corners) size = std::max(size, norm_of(minus(corner, corners[0])));
  for (size_t i = 0; i < 3; ++i) {
    const Double3 inward = cross(normal, minus(corners[(i + 1) % 3], corners[i]));
    on[i] = dot(inward, minus(point, corners[i])) <= kOnFeature * size * norm_of(inward);
  }
  for (size_t i = 0; i < 3; ++i) {
    if (on[i] && on[(i + 2) % 3]) return name_of(Kind::vertex, index[i]);
  }
  for (size_t i = 0; i < 3; ++i) {
    const auto [low, high] = std::minmax(index[i], index[(i + 1) % 3]);
    if (on[i]) return name_of(Kind::edge, mixed(low, high));
  }
  return name_of(Kind::face, own);
}

uint32_t feature_of_surface(const Surface& surface, uint32_t triangle, const Double3& point) {
  return triangle_feature(wide_corners(surface, triangle), surface.corner_numbers(triangle),
                          triangle, point);
}

}  // namespace

uint32_t surface_feature(const Part& part, uint32_t triangle, const Double3& point) {
  const std::array<Row, kMostRows>& rows = part.rows;
  const auto corner_of = [](const std::array<float, 3>& v) { return Double3{v[0], v[1], v[2]}; };
  switch (part.kind) {
    case ShapeKind::aabb:
      return box_feature(corner_of(part.lower), corner_of(part.upper), point);
    case ShapeKind::box:
    case ShapeKind::rounded_box:
      return box_feature({-rows[0][0], -rows[0][1], -rows[0][2]},
                         {rows[0][0], rows[0][1], rows[0][2]}, point);
    case ShapeKind::capsule:
      return capsule_feature(part, point);
    case ShapeKind::dop:
      return dop_feature(part, point);
    case ShapeKind::hull:
    case ShapeKind::rounded_hull:
      return hull_feature(*geometry_at<HullGeometry>(rows[0]), point);
    case ShapeKind::mesh:
    case ShapeKind::height_field:
      return feature_of_surface(surface_at(part.kind, rows[0]), triangle, point);
    case ShapeKind::triangle:
      return triangle_feature({vector_of(rows[0]), vector_of(rows[1]), vector_of(rows[2])},
                              {0, 1, 2}, 0, point);
    default:
      return name_of(Kind::smooth, 1);  // one surface without edges
  }
}

uint32_t feature_of_child(uint32_t child, uint32_t feature) {
  if (child == 0) return feature;
  return (feature & ~kIndexMask) | (mixed(child, feature) & kIndexMask);
}

}  // namespace carom
