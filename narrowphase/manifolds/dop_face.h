// The face that a k-DOP turns towards another shape: the scalar form.
#pragma once

#include <algorithm>
#include <utility>

#include "narrowphase/features/segment_scalar.h"
#include "narrowphase/manifolds/polygon_scalar.h"
#include "narrowphase/scalar/dop_corners.h"

namespace carom::scalar {

using FaceCorners = FewOf<Vector3f, DopFace::kMostCorners>;

// The facing side of a shape. A k-DOP without faces gives an edge, or a point.
struct FacingSide {
  PolygonFace face;
  FaceCorners corners;  // relative to the position of A
};

class DopSideFinder {
 public:
  DopSideFinder(const DopShape<float>& dop, const Placed& placed)
      : slabs_(slab_directions(dop.slabs.kind)),
        corners_(dop),
        placed_(placed),
        same_point_(double{kSameCorner} * dop.greatest) {}

  // Chooses among the faces that contain a furthest point along m. The rules are those for hulls
  // (hull_face.h), but faces with more distinct corners (up to three) come first. So a flat k-DOP
  // gives an edge or a point.
  FacingSide towards(const Vector3f& m, float depth) const {
    const Vector3f along = rotate_back(placed_.turn, m);
    double most = -HUGE_VAL;
    for (size_t i = 0; i < corners_.size(); ++i) {
      most = std::max(most, height(along, corners_.point(i)));
    }
    const double least = most - same_point_, touching = most - std::max(same_point_, double{depth});
    const auto count_above = [&](const Corners& corners, double limit) {
      return std::count_if(corners.begin(), corners.end(),
                           [&](const Vector3d& x) { return height(along, x) >= limit; });
    };
    using Rank = std::pair<size_t, bool>;  // number of corners; two of them touch
    Corners best;
    Rank best_rank{};
    size_t plane = 0;
    float nearest = 0;
    for (const DopFace& face : corners_.polytope().faces()) {
      const Corners corners = distinct_corners(face);
      if (count_above(corners, least) == 0) continue;
      const Rank rank{std::min<size_t>(corners.size(), 3), count_above(corners, touching) >= 2};
      const float cosine = dot(normal_of(face.plane), along);
      if (rank < best_rank || (rank == best_rank && !(cosine > nearest))) continue;
      best = corners;
      best_rank = rank;
      plane = face.plane;
      nearest = cosine;
    }
    return side_of(plane, best);
  }

 private:
  using Corners = FewOf<Vector3d, DopFace::kMostCorners>;

  static double height(const Vector3f& way, const Vector3d& x) {
    return (way.x() * x[0] + way.y() * x[1]) + way.z() * x[2];
  }

  Corners distinct_corners(const DopFace& face) const {
    Corners distinct;
    const auto is_far = [&](const Vector3d& a, const Vector3d& b) {
      return largest_component<double>(a - b) > same_point_;
    };
    for (const DopCorner& corner : corners_.polytope().corners(face)) {
      const Vector3d point = corners_.point(corner.point);
      if (distinct.empty() || is_far(point, distinct[distinct.size() - 1])) {
        distinct.push_back(point);
      }
    }
    const bool closes = distinct.size() > 1 && !is_far(distinct[0], distinct[distinct.size() - 1]);
    return closes ? without_last(distinct) : distinct;
  }
  static Corners without_last(const Corners& corners) {
    Corners rest;
    for (size_t i = 0; i + 1 < corners.size(); ++i) rest.push_back(corners[i]);
    return rest;
  }

  Vector3f normal_of(size_t plane) const {
    const auto& d = slabs_[slab_of_plane(plane)];
    const Vector3f normal = Vector3f(d[0], d[1], d[2]) * static_cast<float>(sign_of_plane(plane));
    return normal * (1 / std::sqrt(dot(normal, normal)));
  }

  Vector3f placed(const Vector3d& x) const {
    return rotate(placed_.turn, Vector3f(x.cast<float>())) + placed_.origin;
  }

  FacingSide side_of(size_t plane, const Corners& corners) const {
    FacingSide side;
    for (const Vector3d& corner : corners) side.corners.push_back(placed(corner));
    FaceFrame& frame = side.face.frame;
    frame = {side.corners[0], Vector3f::Zero(), Vector3f::Zero(), Vector3f::Zero(), 0};
    if (corners.size() < 3) return side;
    const Vector3f n = normal_of(plane), u = any_perpendicular(n), v = cross(n, u);
    frame.n = rotate(placed_.turn, n);
    frame.u = rotate(placed_.turn, u);
    frame.v = rotate(placed_.turn, v);
    for (const Vector3d& corner : corners) {
      const Vector3f r = Vector3d(corner - corners[0]).cast<float>();
      side.face.points.push_back({dot(u, r), dot(v, r)});
    }
    return side;
  }

  const std::span<const std::array<int8_t, 3>> slabs_;
  const DopCorners corners_;
  const Placed& placed_;
  const double same_point_;
};

inline FacingSide side_towards(const Vector3f& m, float depth, const DopShape<float>& dop,
                               const Placed& placed) {
  return DopSideFinder(dop, placed).towards(m, depth);
}

}  // namespace carom::scalar
