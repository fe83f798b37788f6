#include "geometries/inner_edges.h"

#include <algorithm>
#include <cmath>

#include "base/tolerances.h"
#include "geometries/part.h"

namespace carom {
namespace {

double norm(const Double3& v) { return std::sqrt(dot(v, v)); }

enum class Bend { outwards, inwards, flat, folded };  // as seen from the front of the triangle

// How the surface bends at edge `index` of a triangle; `across` is the third corner of the
// neighbour.
Bend bend_at(const std::array<Double3, 3>& corners, size_t index, const Double3& across) {
  const Double3& start = corners[index];
  const Double3 edge = minus(corners[(index + 1) % 3], start);
  const Double3 normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
  const Double3 inwards = cross(normal, edge);
  const Double3 way = minus(across, start);
  const double height = dot(normal, way) / norm(normal);
  const double beside = dot(inwards, way) / norm(inwards);
  const double size = std::max(
      {greatest(corners[0]), greatest(corners[1]), greatest(corners[2]), greatest(across)});
  if (std::fabs(height) > kFlatEdge * std::fabs(beside) + kRoundedCorner * size) {
    return height > 0 ? Bend::inwards : Bend::outwards;
  }
  return beside < 0 ? Bend::flat : Bend::folded;
}

}  // namespace

InnerSides inner_sides(const std::array<Double3, 3>& corners, size_t index, const Double3& across) {
  const Bend bend = bend_at(corners, index, across);
  return {bend == Bend::inwards || bend == Bend::flat,
          bend == Bend::outwards || bend == Bend::flat};
}

}  // namespace carom
