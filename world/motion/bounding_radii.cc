#include "world/motion/bounding_radii.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>

#include "base/outward.h"
#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/height_field_geometry.h"
#include "carom/shapes/mesh_geometry.h"
#include "shapes/body_reader.h"
#include "shapes/dop_geometry.h"
#include "shapes/hull_features.h"
#include "shapes/turn.h"

namespace carom {
namespace {

double length(const Double3& v) { return std::sqrt(dot(v, v)); }

double aabb_reach(const BodyReader& reader, size_t i) {
  Double3 furthest;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double lower = reader.lower(axis, i), upper = reader.upper(axis, i);
    furthest[axis] = std::max(std::fabs(lower), std::fabs(upper));
  }
  return length(furthest);
}

double dop_reach(const DopGeometry& geometry) {
  const DopPolytope& polytope = geometry.polytope();
  double reach = 0;
  for (size_t i = 0; i < polytope.point_count(); ++i) {
    reach = std::max(reach, length(polytope.point(i)));
  }
  return reach + kDopRounding * geometry.size();
}

double hull_reach(const HullGeometry& hull) {
  double reach = 0;
  for (const Eigen::Vector3f& p : hull.points()) {
    reach = std::max(reach, length({p.x(), p.y(), p.z()}));
  }
  return reach;
}

// The distance of the furthest corner of the box that holds all parts.
template <class Geometry>
double parts_reach(const Geometry& parts) {
  Double3 furthest;
  for (int axis = 0; axis < 3; ++axis) {
    furthest[axis] = std::max(std::fabs(parts.lower()[axis]), std::fabs(parts.upper()[axis]));
  }
  return length(furthest);
}

double rows_reach(ShapeKind kind, const std::array<Row, kMostRows>& rows) {
  const auto corner = [&](size_t k) { return length(vector_of(rows[k])); };
  switch (kind) {
    case ShapeKind::capsule:
      return std::max(corner(0), corner(1)) + rows[0][3];
    case ShapeKind::box:
      return corner(0);
    case ShapeKind::rounded_box:
    case ShapeKind::cylinder:  // the rim
    case ShapeKind::cone:
      return corner(0) + rows[0][3];
    case ShapeKind::ellipsoid:
      return double{std::max({rows[0][0], rows[0][1], rows[0][2]})} + rows[0][3];
    case ShapeKind::triangle:
      return std::max({corner(0), corner(1), corner(2)}) + rows[0][3];
    case ShapeKind::hull:
      return hull_reach(*geometry_at<HullGeometry>(rows[0]));
    case ShapeKind::rounded_hull:
      return hull_reach(*geometry_at<HullGeometry>(rows[0])) + rows[0][3];
    case ShapeKind::mesh:
      return parts_reach(*geometry_at<MeshGeometry>(rows[0]));
    case ShapeKind::height_field:
      return parts_reach(*geometry_at<HeightFieldGeometry>(rows[0]));
    case ShapeKind::compound:
      return parts_reach(*geometry_at<CompoundGeometry>(rows[0]));
    default:
      return std::numeric_limits<double>::infinity();
  }
}

// The next float but one, which also covers the rounding of the tests.
float round_upwards(double reach) {
  const float above = -round_downwards(-std::min(reach, double{FLT_MAX}));
  return std::min(next_up(above), FLT_MAX);
}

}  // namespace

float bounding_radius(const BodyReader& reader, size_t i) {
  const ShapeKind kind = reader.kind(i);
  if (kind == ShapeKind::sphere) return reader.radius(i);
  if (kind == ShapeKind::halfspace) return std::numeric_limits<float>::infinity();
  if (kind == ShapeKind::aabb) {
    const double reach = aabb_reach(reader, i);
    return std::isfinite(reach) ? round_upwards(reach) : 0;
  }
  const std::array<Row, kMostRows> rows = reader.rows(i);
  if (!are_valid_rows(kind, rows.data(), reader.dop_geometry(i))) return 0;
  return round_upwards(kind == ShapeKind::dop ? with_geometry(read_dop(reader, i), dop_reach)
                                              : rows_reach(kind, rows));
}

float turning_radius(const BodyReader& reader, size_t i, float radius) {
  const ShapeKind kind = reader.kind(i);
  if (row_count(kind) == 0) return 0;
  if (kind == ShapeKind::box) {
    const std::array<float, 4> half = reader.rows(i)[0];
    const double x = half[0], y = half[1], z = half[2];
    const double shortest = std::min({x, y, z});
    return radius > 0 ? round_upwards(std::sqrt(x * x + y * y + z * z - shortest * shortest)) : 0;
  }
  if (kind == ShapeKind::capsule) {
    const std::array<Row, kMostRows> rows = reader.rows(i);
    const double furthest = std::max(length(vector_of(rows[0])), length(vector_of(rows[1])));
    return radius > 0 ? round_upwards(furthest) : 0;
  }
  if (kind == ShapeKind::hull && radius > 0) {
    const auto& hull = *geometry_at<HullGeometry>(reader.rows(i)[0]);
    if (!hull.features()) return radius;
    // A ball about the position that fits into the hull.
    const Eigen::Vector3d& middle = hull.middle();
    const double inner =
        std::max(0.0, hull.features()->inner_radius() * (1 - 0x1p-20) - middle.norm());
    return round_upwards(std::sqrt(double{radius} * radius - inner * inner));
  }
  return radius;
}

}  // namespace carom
