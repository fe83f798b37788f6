#include "impacts/rays/point_contact.h"

#include <cmath>

#include "narrowphase/pairs/any_pair.h"
#include "narrowphase/scalar/quaternion_as.h"

namespace carom {
namespace {

// Nearer to an edge than this share of the triangle's size, or on a triangle with a smaller square
// of the sine of its angle, the general test decides which feature is the nearest.
constexpr double kClearOfEdges = 0x1p-20;

// The contact with the inside of a face. False if the edges matter. C. Ericson, Real-Time Collision
// Detection, 2005, section 5.1.5.
bool find_face_contact(const SeenSurface& seen, uint32_t triangle, scalar::Separation& contact) {
  const auto [a, b, c] = wide_corners(seen.surface, triangle);
  const Double3 u = minus(b, a), v = minus(c, a);
  const Double3 from = minus(turned_back(seen.turn, minus({}, seen.place)), a);
  const Double3 front = cross(u, v);
  const double squared = dot(front, front);
  const double along_u = dot(front, cross(from, v)), along_v = dot(front, cross(u, from));
  const double margin = kClearOfEdges * squared;
  const bool is_inside =
      along_u >= margin && along_v >= margin && along_u + along_v <= squared - margin;
  if (!is_inside || !(squared > kClearOfEdges * (dot(u, u) * dot(v, v)))) return false;

  const double per_length = 1 / std::sqrt(squared);
  const double height = dot(from, front) * per_length;
  // A one-sided triangle pushes what lies behind it to its front.
  if (height <= 0 && seen.one_sided.value_or(seen.surface.rules().one_sided)) return false;
  const double to_unit = height >= 0 ? -per_length : per_length;
  const Double3 normal =
      turned(seen.turn, {front[0] * to_unit, front[1] * to_unit, front[2] * to_unit});
  const double distance = std::fabs(height);
  contact.separation = scalar::round_separation(distance);
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<size_t>(axis);
    contact.normal[axis] = static_cast<float>(normal[i]);
    contact.arm_a[axis] = 0;
    contact.arm_b[axis] = static_cast<float>(normal[i] * distance - seen.place[i]);
  }
  contact.status = Status::ok;
  contact.is_unsure = false;
  return true;
}

scalar::Separation general_contact(const SeenSurface& seen, uint32_t triangle) {
  std::array<Row, row_count(ShapeKind::triangle)> rows;
  put_triangle_rows(seen.surface, triangle, rows.data());
  if (seen.one_sided) rows[1][3] = *seen.one_sided ? 1.0f : 0.0f;
  const Row& q = seen.orientation;
  return scalar::rounded(
      scalar::separation_of<double>(Sphere{0}, shape_from_rows(ShapeKind::triangle, rows.data()),
                                    {{seen.place[0], seen.place[1], seen.place[2]},
                                     scalar::quaternion_as<double>({0, 0, 0, 1}),
                                     scalar::quaternion_as<double>({q[0], q[1], q[2], q[3]})}));
}

}  // namespace

void find_point_contact(const SeenSurface& seen, uint32_t triangle, scalar::Separation& contact) {
  if (seen.surface.rules().thickness == 0 && find_face_contact(seen, triangle, contact)) return;
  contact = general_contact(seen, triangle);
}

}  // namespace carom
