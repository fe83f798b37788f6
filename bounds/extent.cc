#include "bounds/extent.h"

#include <algorithm>

#include "base/outward.h"
#include "bounds/point_reach.h"
#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/height_field_geometry.h"
#include "carom/shapes/mesh_geometry.h"
#include "shapes/dop_geometry.h"
#include "shapes/turn.h"

namespace carom {
namespace {

Intervals box_intervals(const std::array<Double3, 3>& turn, const Row& half) {
  Intervals result;
  for (size_t axis = 0; axis < 3; ++axis) {
    const Double3& r = turn[axis];
    const double reach = dot({std::fabs(r[0]), std::fabs(r[1]), std::fabs(r[2])}, vector_of(half));
    result[axis] = {-reach, reach};
  }
  return result;
}

// An axis of the world, in the frame of the body, is `r`.
double across(const Double3& r) { return std::sqrt(r[0] * r[0] + r[1] * r[1]); }

Intervals cylinder_intervals(const std::array<Double3, 3>& turn, const Row& row) {
  Intervals result;
  for (size_t axis = 0; axis < 3; ++axis) {
    const Double3& r = turn[axis];
    const double reach = double{row[0]} * across(r) + double{row[1]} * std::fabs(r[2]);
    result[axis] = {-reach, reach};
  }
  return result;
}

Intervals cone_intervals(const std::array<Double3, 3>& turn, const Row& row) {
  Intervals result;
  for (size_t axis = 0; axis < 3; ++axis) {
    const Double3& r = turn[axis];
    const double of_base = double{row[0]} * across(r), of_tip = double{row[1]} * r[2];
    result[axis] = {std::min(of_tip, -of_tip - of_base), std::max(of_tip, of_base - of_tip)};
  }
  return result;
}

Intervals ellipsoid_intervals(const std::array<Double3, 3>& turn, const Row& row) {
  const Double3 semi_axes = vector_of(row);
  Intervals result;
  for (size_t axis = 0; axis < 3; ++axis) {
    Double3 scaled = turn[axis];
    for (size_t k = 0; k < 3; ++k) scaled[k] *= semi_axes[k];
    const double reach = std::sqrt(dot(scaled, scaled));
    result[axis] = {-reach, reach};
  }
  return result;
}

template <class Points>
Intervals point_intervals(const std::array<Double3, 3>& turn, const Points& points) {
  Intervals result;
  for (size_t axis = 0; axis < 3; ++axis) {
    result[axis] = {dot(turn[axis], points[0]), dot(turn[axis], points[0])};
    for (const Double3& point : points) {
      const double x = dot(turn[axis], point);
      result[axis] = {std::min(result[axis].lower, x), std::max(result[axis].upper, x)};
    }
  }
  return result;
}

Intervals triangle_intervals(const std::array<Double3, 3>& turn, const Row* rows) {
  const Double3 a = vector_of(rows[0]), b = vector_of(rows[1]), c = vector_of(rows[2]);
  Intervals result = point_intervals(turn, std::array{a, b, c});
  const double thickness = rows[0][3];
  if (thickness == 0) return result;
  const Double3 back = way_back(a, b, c, thickness);
  const bool is_known = greatest(back) > 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double shift = dot(turn[axis], back);
    const double slack = thickness * (is_known ? 0x1p-24 : 1);
    result[axis].lower += std::min(shift, 0.0) - slack;
    result[axis].upper += std::max(shift, 0.0) + slack;
  }
  return result;
}

// The largest float32 <= x, but never below -FLT_MAX or above FLT_MAX.
float downwards(double x) {
  return round_downwards(std::clamp(x, -double{FLT_MAX}, double{FLT_MAX}));
}

Extent outward(const Intervals& intervals, double radius, double slack) {
  Extent extent;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double lower = intervals[axis].lower - radius - slack;
    const double upper = intervals[axis].upper + radius + slack;
    extent.lower[axis] = downwards(lower);
    extent.upper[axis] = -downwards(-upper);
  }
  return extent;
}

// The slack covers the rounding of the polytope's points and of the rotation.
Extent dop_extent(const std::array<Double3, 3>& turn, const DopGeometry& geometry) {
  return outward(point_reach(turn, geometry.polytope()), 0, kDopRounding * geometry.size());
}

// `rows`: those of the k-DOP, body i.
Extent dop_extent(const std::array<Double3, 3>& turn, const BodyReader& reader, size_t i,
                  const Row* rows) {
  const DopGeometry* known = reader.dop_geometry(i);
  if (known && known->is_of(rows)) return dop_extent(turn, *known);
  return dop_extent(turn, DopGeometry(std::get<Dop>(shape_from_rows(ShapeKind::dop, rows))));
}

// The extent of the turned points.
Extent hull_extent(const std::array<Double3, 3>& turn, const HullGeometry& hull,
                   double rounding = 0) {
  return outward(point_reach(turn, hull), rounding,
                 kTurnRounding * std::max(double{hull.size()}, rounding));
}

// The extent of the turned box that holds all parts in the body's frame.
template <class Geometry>
Extent parts_extent(const std::array<Double3, 3>& turn, const Geometry& parts) {
  std::array<Double3, 8> corners;
  for (size_t i = 0; i < corners.size(); ++i) {  // bit k of i: the upper end of axis k
    for (int axis = 0; axis < 3; ++axis) {
      corners[i][axis] = (i >> axis & 1 ? parts.upper() : parts.lower())[axis];
    }
  }
  const double size = std::max(greatest(corners[0]), greatest(corners[7]));
  return outward(point_intervals(turn, corners), 0, kTurnRounding * size);
}

Extent turned_extent(const BodyReader& reader, size_t i) {
  const ShapeKind kind = reader.kind(i);
  const std::array<Row, kMostRows> rows = reader.rows(i);
  const auto turn = rotation_of(reader.orientation(i));
  switch (kind) {
    case ShapeKind::hull:
      return hull_extent(turn, *geometry_at<HullGeometry>(rows[0]));
    case ShapeKind::rounded_hull:
      return hull_extent(turn, *geometry_at<HullGeometry>(rows[0]), rows[0][3]);
    case ShapeKind::mesh:
      return parts_extent(turn, *geometry_at<MeshGeometry>(rows[0]));
    case ShapeKind::height_field:
      return parts_extent(turn, *geometry_at<HeightFieldGeometry>(rows[0]));
    case ShapeKind::compound:
      return parts_extent(turn, *geometry_at<CompoundGeometry>(rows[0]));
    default:
      break;
  }
  const double slack = kTurnRounding * greatest_of({rows.data(), row_count(kind)});
  switch (kind) {
    case ShapeKind::capsule:
      return outward(point_intervals(turn, std::array{vector_of(rows[0]), vector_of(rows[1])}),
                     rows[0][3], slack);
    case ShapeKind::box:
      return outward(box_intervals(turn, rows[0]), 0, slack);
    case ShapeKind::rounded_box:
      return outward(box_intervals(turn, rows[0]), rows[0][3], slack);
    case ShapeKind::cylinder:
      return outward(cylinder_intervals(turn, rows[0]), rows[0][3], slack);
    case ShapeKind::cone:
      return outward(cone_intervals(turn, rows[0]), rows[0][3], slack);
    case ShapeKind::ellipsoid:
      return outward(ellipsoid_intervals(turn, rows[0]), rows[0][3], slack);
    case ShapeKind::triangle:
      return outward(triangle_intervals(turn, rows.data()), 0, slack);
    case ShapeKind::dop:
      return dop_extent(turn, reader, i, rows.data());
    default:
      return {};
  }
}

}  // namespace

Extent extent_of(const BodyReader& reader, size_t i) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const ShapeKind kind = reader.kind(i);
  if (kind == ShapeKind::sphere) {
    const float r = reader.radius(i);
    return {{-r, -r, -r}, {r, r, r}};
  }
  if (kind == ShapeKind::aabb) {
    return {{reader.lower(0, i), reader.lower(1, i), reader.lower(2, i)},
            {reader.upper(0, i), reader.upper(1, i), reader.upper(2, i)}};
  }
  if (!reader.has_valid_parameters(i)) return {{kNan, kNan, kNan}, {kNan, kNan, kNan}};
  return turned_extent(reader, i);
}

}  // namespace carom
