#include "narrowphase/proof/upright_boxes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/dyadic.h"

namespace carom {
namespace {

int sign_of(float x) { return (x > 0) - (x < 0); }

// Sets how much of the half axes of a box lies along each axis of the world. Returns false unless
// the box is turned by quarter turns. All components of its quaternion that are not zero are equal
// then, but for their signs; and there are one (no turn, or half a turn), two, or four. Without
// branches on which they are: these cannot be predicted.
bool turn_half(const Row& q, const Row& half, std::array<float, 3>& extent) {
  const float size = std::max(std::max(std::fabs(q[0]), std::fabs(q[1])),
                              std::max(std::fabs(q[2]), std::fabs(q[3])));
  const auto is_odd = [size](float c) { return int{c != 0} & int{std::fabs(c) != size}; };
  const int odd = (is_odd(q[0]) + is_odd(q[1])) + (is_odd(q[2]) + is_odd(q[3]));
  const int x = sign_of(q[0]), y = sign_of(q[1]), z = sign_of(q[2]), w = sign_of(q[3]);
  const int xx = x * x, yy = y * y, zz = z * z, ww = w * w;
  const int norm = (xx + yy) + (zz + ww);
  if (odd != 0 || norm == 0 || norm == 3) return false;
  // Each row of the rotation has one entry that is not zero.
  const auto along = [&half](int of_x, int of_y, int of_z) {
    const auto part = [](int entry, float length) { return entry != 0 ? length : 0.0f; };
    return (part(of_x, half[0]) + part(of_y, half[1])) + part(of_z, half[2]);
  };
  extent[0] = along(ww + xx - yy - zz, x * y - w * z, x * z + w * y);
  extent[1] = along(x * y + w * z, ww - xx + yy - zz, y * z - w * x);
  extent[2] = along(x * z - w * y, y * z + w * x, ww - xx - yy + zz);
  return true;
}

// Whether a + b is what rounding makes of it.
bool is_exact(double a, double b, double sum) {
  const double b_in_sum = sum - a;
  return (a - (sum - b_in_sum)) + (b - b_in_sum) == 0;
}

// Whether low + from <= high + to.
bool reaches(double from, float low, double to, float high) {
  const double way = from - to;
  const double size = double{high} - double{low};
  if (is_exact(from, -to, way) && is_exact(high, -double{low}, size)) return way <= size;
  return (((Dyadic(from) - Dyadic(to)) + Dyadic(low)) - Dyadic(high)).sign() <= 0;
}

}  // namespace

bool read_upright_box(const BodyReader& body, size_t index, UprightBox& box) {
  const ShapeKind kind = body.kind(index);
  if (kind != ShapeKind::box && kind != ShapeKind::aabb) return false;
  const Position<double> at = body.position<double>(index);
  box.position = {at.x, at.y, at.z};
  if (kind == ShapeKind::aabb) {
    for (size_t i = 0; i < 3; ++i) {
      box.lower[i] = body.lower(i, index);
      box.upper[i] = body.upper(i, index);
    }
    return true;
  }
  if (!turn_half(body.orientation(index), body.row(index, 0), box.upper)) return false;
  for (size_t i = 0; i < 3; ++i) box.lower[i] = -box.upper[i];
  return true;
}

bool do_overlap(const UprightBox& a, const UprightBox& b) {
  for (size_t i = 0; i < 3; ++i) {
    if (!reaches(b.position[i], b.lower[i], a.position[i], a.upper[i])) return false;
    if (!reaches(a.position[i], a.lower[i], b.position[i], b.upper[i])) return false;
  }
  return true;
}

}  // namespace carom
