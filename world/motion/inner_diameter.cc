#include "world/motion/inner_diameter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/hull.h"
#include "geometries/part.h"
#include "shapes/hull_features.h"

namespace carom {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The diameter of the largest ball around the middle of the first three slabs that stays within all
// slabs.
double dop_diameter(const Dop& dop) {
  Double3 middle;
  for (size_t axis = 0; axis < 3; ++axis) {
    middle[axis] = (double{dop.lower[axis]} + double{dop.upper[axis]}) / 2;
  }
  double radius = kInfinity;
  const auto directions = slab_directions(dop.kind);
  for (size_t slab = 0; slab < directions.size(); ++slab) {
    const Double3 d = {double(directions[slab][0]), double(directions[slab][1]),
                       double(directions[slab][2])};
    const double height = dot(d, middle);
    const double room = std::min(dop.upper[slab] - height, height - dop.lower[slab]);
    radius = std::min(radius, room / std::sqrt(dot(d, d)));
  }
  return 2 * std::max(radius, 0.0);
}

double hull_diameter(const HullGeometry& hull) {
  return hull.features() ? 2 * double{hull.features()->inner_radius()} : 0;
}

// The ball touches the base and the side.
double cone_diameter(double radius, double half_length) {
  const double length = 2 * half_length, side = std::sqrt(radius * radius + length * length);
  return radius > 0 ? 2 * radius * length / (radius + side) : 0;
}

double compound_diameter(const CompoundGeometry& compound);

// `rows` are valid rows of a kind that has rows.
double diameter(ShapeKind kind, const Row* rows) {
  switch (kind) {
    case ShapeKind::capsule:
      return 2 * double{rows[0][3]};
    case ShapeKind::box:
      return 2 * double{std::min({rows[0][0], rows[0][1], rows[0][2]})};
    case ShapeKind::rounded_box:
    case ShapeKind::ellipsoid:
      return 2 * (double{std::min({rows[0][0], rows[0][1], rows[0][2]})} + rows[0][3]);
    case ShapeKind::cylinder:
      return 2 * (double{std::min(rows[0][0], rows[0][1])} + rows[0][3]);
    case ShapeKind::cone:
      return cone_diameter(rows[0][0], rows[0][1]) + 2 * double{rows[0][3]};
    case ShapeKind::dop:
      return dop_diameter(std::get<Dop>(shape_from_rows(kind, rows)));
    case ShapeKind::hull:
      return hull_diameter(*geometry_at<HullGeometry>(rows[0]));
    case ShapeKind::rounded_hull:
      return hull_diameter(*geometry_at<HullGeometry>(rows[0])) + 2 * double{rows[0][3]};
    case ShapeKind::compound:
      return compound_diameter(*geometry_at<CompoundGeometry>(rows[0]));
    case ShapeKind::halfspace:
      return kInfinity;
    default:
      return 0;
  }
}

double least_side(const std::array<float, 3>& lower, const std::array<float, 3>& upper) {
  double least = kInfinity;
  for (size_t axis = 0; axis < 3; ++axis) {
    least = std::min(least, double{upper[axis]} - double{lower[axis]});
  }
  return least;
}

double compound_diameter(const CompoundGeometry& compound) {
  double least = kInfinity;
  for (const Part& child : compound.parts()) {
    const double of_child = child.kind == ShapeKind::sphere ? 2 * double{child.radius}
                            : child.kind == ShapeKind::aabb
                                ? least_side(child.lower, child.upper)
                                : diameter(child.kind, child.rows.data());
    least = std::min(least, of_child);
  }
  return least;
}

}  // namespace

double inner_diameter(const BodyReader& reader, size_t i) {
  const ShapeKind kind = reader.kind(i);
  if (kind == ShapeKind::sphere) return 2 * double{reader.radius(i)};
  if (kind == ShapeKind::aabb) {
    return least_side({reader.lower(0, i), reader.lower(1, i), reader.lower(2, i)},
                      {reader.upper(0, i), reader.upper(1, i), reader.upper(2, i)});
  }
  const std::array<Row, kMostRows> rows = reader.rows(i);
  const bool is_valid = are_valid_rows(kind, rows.data(), reader.dop_geometry(i));
  return is_valid ? diameter(kind, rows.data()) : 0;
}

}  // namespace carom
