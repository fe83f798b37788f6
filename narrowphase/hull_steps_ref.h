// The steps of the search for depths, scalar.
#pragma once

#include "narrowphase/hull_depth.h"

namespace carom::reference {

inline void place_points(const HullGeometry& hull, float scale, const Rotation<float>& turn,
                         const Vector3f& offset, HullPoints& out) {
  out.count = out.padded = hull.points().size();
  for (size_t i = 0; i < out.count; ++i) {
    const Vector3f p = rotate(turn, Vector3f(hull.points()[i] * scale)) + offset;
    out.x[i] = p.x();
    out.y[i] = p.y();
    out.z[i] = p.z();
  }
}

inline BestFace bound_faces(const HullFeatures& features, float scale, FaceBounds& bounds) {
  const size_t last = bounds.balls.size() - 1;
  const auto& [middle, radius] = bounds.balls[last];
  BestFace best;
  for (size_t f = 0; f < features.face_count(); ++f) {
    const float above = dot(features.normal(f), middle) - features.height(f) * scale;
    const float gap = above - radius;
    bounds.between[last][f] = above > 0 ? kLargest : gap;
    bounds.gap[f] = last == 0 ? gap : min(bounds.gap[f], gap);
    if (last == 0) bounds.closed[f] = 0;
    const float open = bounds.gap[f] - bounds.closed[f];
    if (open > best.gap) best = {open, f};
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

inline size_t count_as_far(const HullPoints& points, const Vector3f& way, float height) {
  size_t count = 0;
  for (size_t i = 0; i < points.count; ++i) {
    count += height - dot(way, points[i]) <= kFacingSlack ? 1 : 0;
  }
  return count;
}

inline BestCrossing cross_edge(const EdgeOfHull& edge, const EdgeColumns& others) {
  BestCrossing best;
  const Vector3f outwards = edge.left + edge.right;
  for (size_t i = 0; i < others.count; ++i) {
    const auto vector = [&](size_t c) -> Vector3f {
      return {others.column[c][i], others.column[c + 1][i], others.column[c + 2][i]};
    };
    const Vector3f direction = vector(0), from = vector(3), left = vector(6), right = vector(9);
    // Whether the arc of this edge crosses that of the other one, turned round.
    const float of_left = dot(left, edge.direction), of_right = dot(right, edge.direction);
    const float on_left = dot(edge.left, direction), on_right = dot(edge.right, direction);
    const bool is_axis = of_right * of_left < 0 && on_right * on_left < 0 && of_right * on_left < 0;
    if (!is_axis) continue;
    const Vector3f n = cross(edge.direction, direction);
    const float nn = dot(n, n);
    if (!(nn > kAlongEachOther)) {
      best.is_doubtful = true;
      continue;
    }
    const float along = dot(n, Vector3f(from - edge.from)) * (1 / std::sqrt(nn));
    const float gap = dot(n, outwards) < 0 ? -along : along;
    if (gap > best.gap) {
      best.gap = gap;
      best.other = i;
    }
  }
  return best;
}

inline constexpr HullSteps kHullSteps = {&place_points, &bound_faces, &furthest_of_hull,
                                         &count_as_far, &cross_edge};

}  // namespace carom::reference
