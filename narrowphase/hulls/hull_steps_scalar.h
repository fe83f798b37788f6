// The steps of the float32 penetration search: the scalar form.
#pragma once

#include <algorithm>

#include "narrowphase/hulls/deep_frames_scalar.h"
#include "narrowphase/hulls/hull_depth.h"
#include "narrowphase/hulls/shell_check_scalar.h"
#include "narrowphase/hulls/shell_corners_scalar.h"

namespace carom::scalar {

inline void place_points(const Solid& solid, const Rotation<float>& turn, const Vector3f& offset,
                         HullPoints& out) {
  out.count = out.padded = solid.point_count;
  for (size_t i = 0; i < out.count; ++i) {
    const Vector3f p = rotate(turn, solid.corner(i)) + offset;
    out.column(0)[i] = p.x();
    out.column(1)[i] = p.y();
    out.column(2)[i] = p.z();
  }
}

inline BestFace bound_faces(const Solid& solid, const Ball& ball, FaceBounds& bounds) {
  const size_t last = bounds.count++;
  BestFace best;
  for (size_t f = 0; f < solid.face_count; ++f) {
    const float above = dot(solid.normal(f), ball.middle) - solid.height(f);
    const float gap = above - ball.radius;
    bounds.between(last)[f] = above > 0 ? kLargest : gap;
    bounds.gap[f] = last == 0 ? gap : min(bounds.gap[f], gap);
    if (bounds.gap[f] > best.gap) best = {bounds.gap[f], f};
  }
  return best;
}

inline FurthestOfHull furthest_of_hull(const PointView& points, const Vector3f& way) {
  FurthestOfHull best{0, dot(way, points[0])};
  for (size_t i = 1; i < points.count; ++i) {
    const float height = dot(way, points[i]);
    if (height > best.height) best = {i, height};
  }
  return best;
}

inline TriedFace try_face(const Solid& solid, const HullPoints& points, size_t face,
                          FaceBounds& bounds) {
  const FurthestOfHull lowest = furthest_of_hull(points.view(), -solid.normal(face));
  const float gap = -lowest.height - solid.height(face);
  return {gap, bound_faces(solid, {points[lowest.index], 0}, bounds)};
}

inline BestFace try_all_faces(const Solid& solid, const HullPoints& points, FaceBounds& bounds) {
  bounds.count = points.count;
  BestFace best;
  for (size_t f = 0; f < solid.face_count; ++f) {
    float least = kLargest;
    for (size_t i = 0; i < points.count; ++i) {
      const float gap = dot(solid.normal(f), points[i]) - solid.height(f);
      bounds.between(i)[f] = gap;
      least = min(least, gap);
    }
    if (least > best.gap) best = {least, f};
  }
  return best;
}

inline void settle_faces(const Solid& solid, float gap, FaceBounds& bounds) {
  for (size_t row = 0; row < bounds.settled_rows(); ++row) {
    const size_t first = 8 * row, count = std::min<size_t>(bounds.count - first, 8);
    for (size_t f = 0; f < solid.face_count; ++f) {
      uint32_t settled = 0;
      for (size_t i = 0; i < count; ++i) {
        settled |= uint32_t{bounds.between(first + i)[f] <= gap} << i;
      }
      bounds.settled[row][f] = static_cast<uint8_t>(settled);
    }
  }
}

inline void find_open_edges(const Solid& solid, float gap, FaceBounds& bounds, OpenEdges& open) {
  settle_faces(solid, gap, bounds);
  open.count = 0;
  for (size_t e = 0; e < solid.edge_count; ++e) {
    uint32_t settled = 0;
    for (size_t row = 0; row < bounds.settled_rows(); ++row) {
      const auto& faces = bounds.settled[row];
      settled |= uint32_t{faces[solid.side[0][e]]} & faces[solid.side[1][e]];
    }
    open.index[open.count] = static_cast<uint16_t>(e);
    open.count += settled == 0 ? 1 : 0;
  }
}

// Two edges have a common axis if the arc of A's edge on the sphere of normals crosses the negated
// arc of B's edge.
inline Crossing cross_edges(const CrossedEdges& a, const CrossedEdges& b,
                            const Rotation<float>& turn, const Vector3f& offset, float gap) {
  Crossing best{gap};
  for (size_t i = 0; i < a.open.count; ++i) {
    const Solid::Edge& edge_a = a.edge(i);
    const Vector3f direction_a = edge_a.direction.head<3>(), from_a = a.solid.corner(edge_a.from);
    const Vector3f left_a = a.solid.normal(edge_a.left), right_a = a.solid.normal(edge_a.right);
    for (size_t k = 0; k < b.open.count; ++k) {
      const Solid::Edge& edge_b = b.edge(k);
      const Vector3f direction_b = rotate<float>(turn, edge_b.direction.head<3>());
      const Vector3f from_b = rotate(turn, b.solid.corner(edge_b.from)) + offset;
      const float of_left = dot(rotate(turn, b.solid.normal(edge_b.left)), direction_a);
      const float of_right = dot(rotate(turn, b.solid.normal(edge_b.right)), direction_a);
      const float on_left = dot(left_a, direction_b), on_right = dot(right_a, direction_b);
      if (!(of_right * of_left < 0 && on_right * on_left < 0 && of_right * on_left < 0)) continue;
      const Vector3f n = cross(direction_a, direction_b);
      const float nn = dot(n, n);
      if (!(nn > kAlongEachOther)) best.is_doubtful = true;
      const float along = dot(n, Vector3f(from_b - from_a)) * (1 / std::sqrt(nn));
      const float found = dot(n, Vector3f(left_a + right_a)) < 0 ? -along : along;
      if (found > best.gap) best = {found, i, k, true, best.is_doubtful};
    }
  }
  return best;
}

inline FacingPoints facing_points(const HullPoints& points, const Vector3f& way) {
  FacingPoints facing{furthest_of_hull(points.view(), way), 0};
  for (size_t i = 0; i < points.count; ++i) {
    facing.count += facing.furthest.height - dot(way, points[i]) <= kFacingSlack ? 1 : 0;
  }
  return facing;
}

inline bool is_inside(const Solid& solid, const Vector3f& point) {
  for (size_t f = 0; f < solid.face_count; ++f) {
    if (dot(solid.normal(f), point) - solid.height(f) > kSameGapInFloat) return false;
  }
  return true;
}

inline constexpr HullSteps kHullSteps = {
    &set_up_frames, &finish_frames,   &place_points, &bound_faces,      &try_face,
    &try_all_faces, &find_open_edges, &cross_edges,  &furthest_of_hull, &facing_points,
    &is_inside,     &place_corners,   &check_planes, &check_edges,      &in_front};

}  // namespace carom::scalar
