// The sides that cylinders, cones and ellipsoids turn towards another shape: the scalar form.
#pragma once

#include <algorithm>
#include <initializer_list>

#include "narrowphase/manifolds/hull_face.h"
#include "narrowphase/scalar/rim.h"

namespace carom::scalar {

inline Point2 on_unit_circle(size_t corner) {
  return {static_cast<float>(rim_cosine(corner)), static_cast<float>(rim_sine(corner))};
}

// A disc in the body's frame, across z, `side` (1 or -1) being the sign of its normal. Corners of
// its rim are fixed to the body, so that contacts keep their places from step to step; but the one
// nearest to the deepest point, along m, is that point.
inline FacingSide disc_side(float radius_x, float radius_y, float height, float side,
                            const Vector3f& along, const Placed& placed) {
  const Point2 deep = {along.x() * radius_x, side * (along.y() * radius_y)};
  const float squared = deep.x * deep.x + deep.y * deep.y;
  const auto depth = [&](size_t k) {
    const Point2 unit = on_unit_circle(k);
    return unit.x * deep.x + unit.y * deep.y;
  };
  size_t deepest = 0;
  for (size_t k = 1; k < kRimCorners; ++k) deepest = depth(k) > depth(deepest) ? k : deepest;
  FacingSide result;
  for (size_t k = 0; k < kRimCorners; ++k) {
    Point2 unit = on_unit_circle(k);
    if (k == deepest && squared > 0) {
      const float inverse = 1 / std::sqrt(squared);
      unit = {deep.x * inverse, deep.y * inverse};
    }
    const Vector3f corner(unit.x * radius_x, side * (unit.y * radius_y), height);
    result.corners.push_back(rotate(placed.turn, corner) + placed.origin);
    result.face.points.push_back({unit.x * radius_x, unit.y * radius_y});
  }
  const Rotation<float>& turn = placed.turn;
  const Vector3f middle = rotate(turn, Vector3f(0, 0, height)) + placed.origin;
  result.face.frame = {middle, turn.x, turn.y * side, turn.z * side, 0};
  return result;
}

// An edge or a point in the body's frame.
inline FacingSide bare_side(std::initializer_list<Vector3f> points, const Placed& placed) {
  FacingSide side;
  for (const Vector3f& p : points) side.corners.push_back(rotate(placed.turn, p) + placed.origin);
  const Vector3f zero = Vector3f::Zero();
  side.face.frame = {side.corners[0], zero, zero, zero, 0};
  return side;
}

// The unit vector across z towards `along`; x if there is none.
inline Vector3f across_z(const Vector3f& along) {
  const float squared = along.x() * along.x() + along.y() * along.y();
  if (!(squared > 0)) return {1, 0, 0};
  const float inverse = 1 / std::sqrt(squared);
  return {along.x() * inverse, along.y() * inverse, 0};
}

// The disc whose normal is nearer to m than the side's, else a line of the side.
inline FacingSide side_towards(const Vector3f& m, float, const CylinderShape<float>& cylinder,
                               const Placed& placed) {
  const Vector3f along = rotate_back(placed.turn, m);
  const float radius = cylinder.radius, half = cylinder.half_length;
  if (2 * (along.z() * along.z()) >= dot(along, along)) {
    const float side = along.z() < 0 ? -1.0f : 1.0f;
    return disc_side(radius, radius, side * half, side, along, placed);
  }
  const Vector3f out = across_z(along) * radius;
  return bare_side({out - Vector3f(0, 0, half), out + Vector3f(0, 0, half)}, placed);
}

// The base whose normal is nearer to m than the side's, else a line of the side.
inline FacingSide side_towards(const Vector3f& m, float, const ConeShape<float>& cone,
                               const Placed& placed) {
  const Vector3f along = rotate_back(placed.turn, m);
  const float radius = cone.radius, half = cone.half_length;
  const Vector3f out = across_z(along);
  // Across the side: 2 half outwards, `radius` upwards.
  const float slope = std::sqrt(4 * (half * half) + radius * radius);
  const float to_side = 2 * half * dot(out, along) + radius * along.z();
  if (-along.z() * slope >= to_side) return disc_side(radius, radius, -half, -1, along, placed);
  return bare_side({out * radius - Vector3f(0, 0, half), Vector3f(0, 0, half)}, placed);
}

// The nearest point; of a flat ellipsoid its face, and of one without width its ends.
inline FacingSide side_towards(const Vector3f& m, float, const EllipsoidShape<float>& ellipsoid,
                               const Placed& placed) {
  const Vector3f along = rotate_back(placed.turn, m);
  const Vector3f& s = ellipsoid.semi_axes;
  const auto flat = static_cast<int>(std::min_element(s.begin(), s.end()) - s.begin());
  const int u = (flat + 1) % 3, v = (flat + 2) % 3;
  if (s[flat] == 0 && std::max(s[u], s[v]) > 0) {
    if (std::min(s[u], s[v]) == 0) return bare_side({-s, s}, placed);
    const Rotation<float>& turn = placed.turn;
    const Vector3f axes[3] = {turn.x, turn.y, turn.z};
    const Placed cyclic = {{axes[u], axes[v], axes[flat]}, placed.origin};
    const Vector3f seen(along[u], along[v], along[flat]);
    return disc_side(s[u], s[v], 0, seen.z() < 0 ? -1.0f : 1.0f, seen, cyclic);
  }
  const Vector3f scaled = s.cwiseProduct(along);
  const float reach = std::sqrt(dot(scaled, scaled));
  const Vector3f nearest = reach > 0 ? Vector3f(s.cwiseProduct(scaled) * (1 / reach)) : scaled;
  return bare_side({nearest}, placed);
}

}  // namespace carom::scalar
