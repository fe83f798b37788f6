// The face that a hull turns towards another shape: the scalar form.
#pragma once

#include <algorithm>
#include <vector>

#include "narrowphase/features/segment_scalar.h"
#include "narrowphase/manifolds/polygon_scalar.h"
#include "narrowphase/scalar/polytope.h"
#include "shapes/hull_features.h"

namespace carom::scalar {

using FaceCorners = FewOf<Vector3f, 30>;

// The facing side of a hull. A hull without faces gives an edge, or a point.
struct FacingSide {
  PolygonFace face;
  FaceCorners corners;  // relative to the position of A
};

class HullSideFinder {
 public:
  HullSideFinder(const HullShape<float>& hull, const Placed& placed)
      : hull_(*hull.geometry), scale_(static_cast<float>(hull.scale)), placed_(placed) {}

  // Chooses among the faces that contain a furthest point along m. Faces with two corners within
  // `depth` of the furthest height come first, because beside a ridge a flatter face may hold just
  // one end of it. Among them it takes the face whose normal is nearest to m; the first of equals.
  // A hull without faces gives its furthest points: one, or the two ends.
  FacingSide towards(const Vector3f& m, float depth) const {
    const Vector3f along = rotate_back(placed_.turn, m);
    thread_local std::vector<float> heights;
    heights.clear();
    for (const Vector3f& p : hull_.points()) heights.push_back(dot(along, p * scale_));
    const float most = *std::max_element(heights.begin(), heights.end());
    const float least = most - kSameCorner * (hull_.size() * scale_);
    const float touching = min(least, most - depth);
    const HullGeometry::Face* best = nullptr;
    bool best_has_two = false;
    Vector3f best_normal = Vector3f::Zero();
    float nearest = 0;
    for (const HullGeometry::Face& face : hull_.faces()) {
      if (count_above(face, heights, least) == 0) continue;
      const bool has_two = count_above(face, heights, touching) >= 2;
      const Vector3f normal = normal_of(face);
      const float cosine = dot(normal, along);
      const bool is_better = has_two == best_has_two ? cosine > nearest : has_two;
      if (best && !is_better) continue;
      best = &face;
      best_has_two = has_two;
      best_normal = normal;
      nearest = cosine;
    }
    return best && !best_normal.isZero(0) ? side_of(*best, best_normal) : ends(along, least);
  }

 private:
  Vector3f point(uint32_t i) const { return hull_.points()[i] * scale_; }

  // Counts corners whose height is at least `least`.
  size_t count_above(const HullGeometry::Face& face, const std::vector<float>& heights,
                     float least) const {
    const auto corners = hull_.corners(face);
    return static_cast<size_t>(std::count_if(corners.begin(), corners.end(),
                                             [&](uint32_t i) { return heights[i] >= least; }));
  }

  // Source: M. E. Newell's sum over the outline; I. Sutherland, R. Sproull, R. Schumacker, "A
  // Characterization of Ten Hidden-Surface Algorithms", Computing Surveys 6(1), 1974.
  Vector3f normal_of(const HullGeometry::Face& face) const {
    if (const HullFeatures* const features = hull_.features()) {
      return features->normal(static_cast<size_t>(&face - hull_.faces().data()));
    }
    const auto corners = hull_.corners(face);
    const Vector3d first = point(corners[0]).cast<double>();
    Vector3d sum = Vector3d::Zero();
    for (size_t i = 2; i < corners.size(); ++i) {
      const Vector3d u = point(corners[i - 1]).cast<double>() - first;
      const Vector3d v = point(corners[i]).cast<double>() - first;
      sum += cross(u, v);
    }
    return unit_or_zero(sum).cast<float>();
  }

  // Outlines with too many corners are sampled evenly.
  FacingSide side_of(const HullGeometry::Face& face, const Vector3f& n) const {
    const auto corners = hull_.corners(face);
    const size_t step = (corners.size() + FaceCorners::kCapacity - 1) / FaceCorners::kCapacity;
    const Vector3f u = any_perpendicular(n), v = cross(n, u), first = point(corners[0]);
    FacingSide side;
    for (size_t i = 0; i < corners.size(); i += step) {
      const Vector3f p = point(corners[i]), r = p - first;
      side.corners.push_back(placed(p));
      side.face.points.push_back({dot(u, r), dot(v, r)});
    }
    const Rotation<float>& turn = placed_.turn;
    side.face.frame = {side.corners[0], rotate(turn, u), rotate(turn, v), rotate(turn, n), 0};
    return side;
  }

  FacingSide ends(const Vector3f& along, float least) const {
    FacingSide side;
    for (uint32_t i = 0; i < hull_.points().size() && side.corners.size() < 2; ++i) {
      if (dot(along, point(i)) >= least) side.corners.push_back(placed(point(i)));
    }
    const Vector3f zero = Vector3f::Zero();
    side.face.frame = {side.corners[0], zero, zero, zero, 0};
    return side;
  }

  Vector3f placed(const Vector3f& p) const { return rotate(placed_.turn, p) + placed_.origin; }

  const HullGeometry& hull_;
  const float scale_;
  const Placed& placed_;
};

inline FacingSide side_towards(const Vector3f& m, float depth, const HullShape<float>& hull,
                               const Placed& placed) {
  return HullSideFinder(hull, placed).towards(m, depth);
}

}  // namespace carom::scalar
