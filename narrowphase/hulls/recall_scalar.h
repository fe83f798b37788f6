// Tests whether hulls are still nearest, or still overlap, by the corners of the last time. One
// pass over all points shows it. The kernel in lanes does the same, operation for operation.
//
// The corners are trusted only if they show what a result of GJK must show (gjk_scalar.h). Either
// zero lies well inside four corners. Or the projections of all points on the spanned vector are as
// far apart as the vector is long, and the vector ends strictly inside the span. So a wrong guess
// of corners costs time, never the result.
#pragma once

#include "narrowphase/hulls/features.h"
#include "narrowphase/hulls/gjk_scalar.h"

namespace carom::scalar {

// A hull whose points stay where they are stored; only the few corners are placed in the world.
class StoredHull {
 public:
  StoredHull(const HullShape<float>& hull, const Quaternion<float>& q, const Vector3f& offset)
      : records_(hull.geometry->records()),
        points_(hull.geometry->points().size()),
        turn_(placing_turn(hull, q)),
        offset_(offset) {}

  Vector3f placed_point(size_t i) const {
    return rotate(turn_, point(std::min(i, points_ - 1))) + offset_;
  }

  FacingCount count_facing(const Vector3f& way, float height) const {
    const Vector3f own_way = rotate_back(turn_, way);
    const float base = dot(way, offset_), limit = height - kFacingSlack;
    FacingCount facing;
    for (size_t i = 0; i < points_; ++i) {
      const float h = dot(own_way, point(i)) + base;
      facing.most = max(facing.most, h);
      facing.count += h >= limit;
    }
    return facing;
  }

 private:
  Vector3f point(size_t i) const { return {records_[i][0], records_[i][1], records_[i][2]}; }

  std::span<const std::array<float, 4>> records_;
  size_t points_;
  Rotation<float> turn_;
  Vector3f offset_;
};

inline ZeroInside zero_inside(const std::array<Vector3f, 4>& corner) {
  const Vector3f& last = corner[3];
  const Vector3f p = corner[0] - last, q = corner[1] - last, r = corner[2] - last;
  const Vector3f pq = cross(p, q);
  return ZeroInside({dot(cross(q, r), last), -dot(cross(p, r), last), dot(pq, last)}, dot(pq, r),
                    corner);
}

// Unsure unless the pair is nearest, or overlaps, by these corners. Pairs that overlap get the
// decision only, no depth.
inline Separation recalled_separation(const HullShape<float>& a, const HullShape<float>& b,
                                      const PairPose<float>& pose, uint64_t packed) {
  const Features features = unpack_features(packed);
  if (features.count < 1 || features.count > kMostFeatures || !is_usual_scale(1 / a.scale)) {
    return not_in_float<float>();
  }
  const StoredHull hull_a(a, pose.a, Vector3f::Zero()), hull_b(b, pose.b, pose.d);
  FewOf<Corner, kMostFeatures> corners;
  for (size_t i = 0; i < features.count; ++i) {
    const Vector3f on_a = hull_a.placed_point(features.of_a[i]);
    corners.push_back({hull_b.placed_point(features.of_b[i]) - on_a, on_a});
  }
  if (features.count == 4) {
    const bool is_sure =
        zero_inside({corners[0].point, corners[1].point, corners[2].point, corners[3].point})
            .is_sure;
    Separation result = not_in_float<float>();
    if (is_sure) result.separation = -1;
    result.is_unsure = !is_sure;
    return result;
  }
  FewOf<Corner, 3> ends;
  for (size_t i = 0; i < features.count; ++i) ends.push_back(corners[i]);
  const SpannedWay way(ends);
  NearestCores nearest = way.confirmed_by(hull_a.count_facing(way.normal(), way.height_of_a()),
                                          hull_b.count_facing(-way.normal(), way.height_of_b()));
  nearest.is_sure = nearest.is_sure && way.ends_inside();
  return separation_of(nearest, 0, 0, pose.d);
}

}  // namespace carom::scalar
