// The steps of the float32 penetration search: the scalar form.
#pragma once

#include "narrowphase/hulls/hull_depth.h"

namespace carom::scalar {

inline void place_points(const Solid& solid, const Rotation<float>& turn, const Vector3f& offset,
                         HullPoints& out) {
  out.count = out.padded = solid.point_count;
  for (size_t i = 0; i < out.count; ++i) {
    const Vector3f p = rotate(turn, solid.corner(i)) + offset;
    out.x[i] = p.x();
    out.y[i] = p.y();
    out.z[i] = p.z();
  }
}

inline BestFace bound_faces(const Solid& solid, const Ball& ball, FaceBounds& bounds) {
  const size_t last = bounds.count++;
  BestFace best;
  for (size_t f = 0; f < solid.face_count; ++f) {
    const float above = dot(solid.normal(f), ball.middle) - solid.height(f);
    const float gap = above - ball.radius;
    bounds.between[last][f] = above > 0 ? kLargest : gap;
    bounds.gap[f] = last == 0 ? gap : min(bounds.gap[f], gap);
    if (bounds.gap[f] > best.gap) best = {bounds.gap[f], f};
  }
  return best;
}

inline BestFace try_all_faces(const Solid& solid, const HullPoints& points, FaceBounds& bounds) {
  bounds.count = points.count;
  BestFace best;
  for (size_t f = 0; f < solid.face_count; ++f) {
    float least = kLargest;
    for (size_t i = 0; i < points.count; ++i) {
      const float gap = dot(solid.normal(f), points[i]) - solid.height(f);
      bounds.between[i][f] = gap;
      least = min(least, gap);
    }
    if (least > best.gap) best = {least, f};
  }
  return best;
}

inline void settle_faces(const Solid& solid, float gap, FaceBounds& bounds) {
  for (size_t f = 0; f < solid.face_count; ++f) {
    bounds.settled[f] = 0;
    for (size_t ball = 0; ball < bounds.count; ++ball) {
      bounds.settled[f] |= uint32_t{bounds.between[ball][f] <= gap} << ball;
    }
  }
}

// Two edges have a common axis if the arc of A's edge on the sphere of normals crosses the negated
// arc of B's edge.
inline Crossing cross_edges(const EdgeColumns& a, const EdgeColumns& b, const Rotation<float>& turn,
                            float gap) {
  const auto of = [](const EdgeColumns::Column3& column, size_t k) -> Vector3f {
    return {column[0][k], column[1][k], column[2][k]};
  };
  Crossing best{gap};
  for (size_t i = 0; i < a.count; ++i) {
    const Vector3f direction_a = of(a.direction, i), left_a = of(a.left, i);
    const Vector3f right_a = of(a.right, i);
    for (size_t k = 0; k < b.count; ++k) {
      const Vector3f direction_b = rotate(turn, of(b.direction, k));
      const float of_left = dot(rotate(turn, of(b.left, k)), direction_a);
      const float of_right = dot(rotate(turn, of(b.right, k)), direction_a);
      const float on_left = dot(left_a, direction_b), on_right = dot(right_a, direction_b);
      if (!(of_right * of_left < 0 && on_right * on_left < 0 && of_right * on_left < 0)) continue;
      const Vector3f n = cross(direction_a, direction_b);
      const float nn = dot(n, n);
      if (!(nn > kAlongEachOther)) best.is_doubtful = true;
      const float along = dot(n, Vector3f(of(b.from, k) - of(a.from, i))) * (1 / std::sqrt(nn));
      const float found = dot(n, Vector3f(left_a + right_a)) < 0 ? -along : along;
      if (found > best.gap) best = {found, i, k, true, best.is_doubtful};
    }
  }
  return best;
}

inline FurthestOfHull furthest_of_hull(const HullPoints& points, const Vector3f& way) {
  FurthestOfHull best{0, dot(way, points[0])};
  for (size_t i = 1; i < points.count; ++i) {
    const float height = dot(way, points[i]);
    if (height > best.height) best = {i, height};
  }
  return best;
}

inline FacingPoints facing_points(const HullPoints& points, const Vector3f& way) {
  FacingPoints facing{furthest_of_hull(points, way), 0};
  for (size_t i = 0; i < points.count; ++i) {
    facing.count += facing.furthest.height - dot(way, points[i]) <= kFacingSlack ? 1 : 0;
  }
  return facing;
}

inline constexpr HullSteps kHullSteps = {&place_points, &bound_faces,      &try_all_faces,
                                         &settle_faces, &furthest_of_hull, &cross_edges,
                                         &facing_points};

}  // namespace carom::scalar
