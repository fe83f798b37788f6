// The steps of the search for depths, scalar.
#pragma once

#include "narrowphase/hull_depth.h"

namespace carom::reference {

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
    if (last == 0) bounds.closed[f] = 0;
    const float open = bounds.gap[f] - bounds.closed[f];
    if (open > best.gap) best = {open, f};
  }
  return best;
}

inline BestFace try_all_faces(const Solid& solid, const HullPoints& points, FaceBounds& bounds) {
  bounds.count = 0;
  BestFace best;
  for (size_t i = 0; i < points.count; ++i) {
    best = bound_faces(solid, {points[i], 0}, bounds);
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
                                         &settle_faces, &furthest_of_hull, &facing_points};

}  // namespace carom::reference
