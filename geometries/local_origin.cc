#include "geometries/local_origin.h"

#include <algorithm>

#include "base/powers.h"
#include "carom/shapes/hull.h"

namespace carom {
namespace {

// The greatest coordinate of the part about its position, or up to twice as much.
double size_of(const Part& part) {
  if (part.kind == ShapeKind::hull) return geometry_at<HullGeometry>(part.rows[0])->size();
  const PartBox box = box_of(part);
  return greatest(box.middle) + greatest(box.half);
}

// For numbers up to 2^51. std::nearbyint() is a call.
double nearest_integer(double x) {
  constexpr double kHasNoFraction = 0x1.8p52;
  return (x + kHasNoFraction) - kHasNoFraction;
}

}  // namespace

std::array<float, 3> origin_near(const Turn& turn, const Double3& position, const Part& other,
                                 const Double3& other_position) {
  constexpr double kFurthest = 0x1p100, kLeast = 0x1p-100;
  constexpr int kDigits = 16;  // of a coordinate, at most
  if (other.kind == ShapeKind::halfspace) return kMeshOrigin;
  const Double3 way = turned_back(turn, minus(other_position, position));
  const double distance = greatest(way), size = size_of(other);
  // False for NaN.
  if (!(distance > kLeast && distance < kFurthest && size < distance)) return kMeshOrigin;
  const int of_size = size > kLeast ? exponent_of(size) + 2 : exponent_of(kLeast);
  const double step = power_of_two(std::max(of_size, exponent_of(distance) - kDigits));
  std::array<float, 3> origin;
  for (size_t axis = 0; axis < 3; ++axis) {
    origin[axis] = static_cast<float>(step * nearest_integer(way[axis] / step));
  }
  return origin;
}

}  // namespace carom
