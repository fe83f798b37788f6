// When a ray may touch a triangle of a mesh, and whether it certainly does.
#pragma once

#include <cmath>

#include "impacts/ray_in_mesh.h"
#include "impacts/slack.h"

namespace carom {

// Bounds on rounding and on the slack of linear times, as shares of products of lengths; more than
// kSweepSlack and kSeam.
inline constexpr double kPointSlack = 0x1p-38;
inline constexpr double kParallel = 0x1p-30;
// The square of the sine above which a face is certainly not slanted.
inline constexpr double kSurelyUpright = 4 * kSlantedFace * kSlantedFace;

// The times at which the point may touch a triangle.
struct RayWindow {
  double earliest, latest;
  bool is_sure;  // it does touch it
};

// False if the ray misses the triangle.
inline bool window_of(const RayInMesh& ray, uint32_t triangle, RayWindow& window) {
  const MeshGeometry& mesh = *ray.mesh;
  const Double3 a = corner(mesh, triangle, 0);
  const Double3 u = minus(corner(mesh, triangle, 1), a), v = minus(corner(mesh, triangle, 2), a);
  const Double3 normal = cross(u, v), from = minus(ray.start, a);
  const double towards = -dot(ray.way, normal);
  const bool from_front = towards > 0;
  const double sign = from_front ? 1 : -1;
  const double rate = std::fabs(towards);
  const double side = std::max(greatest(u), greatest(v));
  const Double3 turn = cross(from, ray.way);  // -way x from
  const double along_u = sign * dot(v, turn), along_v = -sign * dot(u, turn);
  const double doubt = kPointSlack * (side * ray.travel * ray.lengths + rate);
  if (along_u < -doubt || along_v < -doubt || along_u + along_v > rate + doubt) return false;
  window = {0, HUGE_VAL, false};
  if (rate <= kParallel * (side * side * ray.travel)) return true;
  const double t = sign * dot(from, normal) / rate;
  const double late =
      kPointSlack *
      ((side * side * ray.lengths + std::fabs(t) * (side * side * ray.travel)) / rate);
  if (t - late > 1 || t + late < 0) return false;
  const bool is_inside = along_u >= doubt && along_v >= doubt && along_u + along_v <= rate - doubt;
  const bool is_upright = dot(normal, normal) > kSurelyUpright * (dot(u, u) * dot(v, v));
  window = {
      t - late, t + late,
      is_inside && is_upright && t >= late && t + late <= 1 && (from_front || !ray.one_sided)};
  return true;
}

}  // namespace carom
