#include "kernel/extent.h"

#include <algorithm>
#include <limits>

#include "kernel/outward.h"

namespace carom {
namespace {

using Vector = std::array<double, 3>;

// What double precision may round in a rotation and the sums that follow, as a share of the
// greatest length that goes in; generously.
constexpr double kRounding = 0x1p-46;

struct Interval {
  double lower, upper;
};

using Intervals = std::array<Interval, 3>;

// Rows of M(q) / |q|^2.
std::array<Vector, 3> rotation_of(const Row& q) {
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  const double s = 2 / ((x * x + y * y) + (z * z + w * w));
  return {{{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
           {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
           {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}}};
}

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector vector_of(const Row& row) { return {row[0], row[1], row[2]}; }

double greatest(const Vector& v) {
  return std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
}

Intervals box_intervals(const std::array<Vector, 3>& turn, const Row& half) {
  Intervals result;
  for (size_t axis = 0; axis < 3; ++axis) {
    const Vector& r = turn[axis];
    const double reach = dot({std::fabs(r[0]), std::fabs(r[1]), std::fabs(r[2])}, vector_of(half));
    result[axis] = {-reach, reach};
  }
  return result;
}

template <size_t kCount>
Intervals point_intervals(const std::array<Vector, 3>& turn,
                          const std::array<Vector, kCount>& points) {
  Intervals result;
  for (size_t axis = 0; axis < 3; ++axis) {
    result[axis] = {dot(turn[axis], points[0]), dot(turn[axis], points[0])};
    for (const Vector& point : points) {
      const double x = dot(turn[axis], point);
      result[axis] = {std::min(result[axis].lower, x), std::max(result[axis].upper, x)};
    }
  }
  return result;
}

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

// Against the front; zero if the triangle has hardly any area, and with it no direction to rely on.
Vector way_back(const Vector& a, const Vector& b, const Vector& c, double thickness) {
  const Vector u = minus(b, a);
  const Vector v = minus(c, a);
  const Vector n = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                    u[0] * v[1] - u[1] * v[0]};
  const double length = std::sqrt(dot(n, n));
  if (!(length > 0x1p-24 * greatest(u) * greatest(v))) return {};
  return {-n[0] / length * thickness, -n[1] / length * thickness, -n[2] / length * thickness};
}

Intervals triangle_intervals(const std::array<Vector, 3>& turn, const std::array<Row, 3>& rows) {
  const Vector a = vector_of(rows[0]), b = vector_of(rows[1]), c = vector_of(rows[2]);
  Intervals result = point_intervals<3>(turn, {a, b, c});
  const double thickness = rows[0][3];
  if (thickness == 0) return result;
  const Vector back = way_back(a, b, c, thickness);
  const bool is_known = greatest(back) > 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double shift = dot(turn[axis], back);
    const double slack = thickness * (is_known ? 0x1p-24 : 1);
    result[axis].lower += std::min(shift, 0.0) - slack;
    result[axis].upper += std::max(shift, 0.0) + slack;
  }
  return result;
}

// Radius and thickness are the fourth number of the first row.
double greatest_of(const std::array<Row, kMostRows>& rows) {
  double size = rows[0][3];
  for (const Row& row : rows) size = std::max(size, greatest(vector_of(row)));
  return size;
}

float down(double x) {
  const auto rounded = static_cast<float>(std::max(x, -double{FLT_MAX}));
  return rounded > x ? next_down(rounded) : rounded;
}
float up(double x) { return -down(-x); }

Extent outward(const Intervals& intervals, double radius, double slack) {
  Extent extent;
  for (size_t axis = 0; axis < 3; ++axis) {
    extent.lower[axis] = std::max(down(intervals[axis].lower - radius - slack), -FLT_MAX);
    extent.upper[axis] = std::min(up(intervals[axis].upper + radius + slack), FLT_MAX);
  }
  return extent;
}

Extent turned_extent(const BodyReader& reader, size_t i) {
  const ShapeKind kind = reader.kind(i);
  const std::array<Row, kMostRows> rows = reader.rows(i);
  const auto turn = rotation_of(reader.orientation(i));
  const double slack = kRounding * greatest_of(rows);
  switch (kind) {
    case ShapeKind::capsule:
      return outward(point_intervals<2>(turn, {vector_of(rows[0]), vector_of(rows[1])}), rows[0][3],
                     slack);
    case ShapeKind::box:
      return outward(box_intervals(turn, rows[0]), 0, slack);
    case ShapeKind::triangle:
      return outward(triangle_intervals(turn, rows), 0, slack);
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
