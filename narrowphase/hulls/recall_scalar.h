// Pairs of hulls that are nearest, or overlap, by the same corners as the last time: one look at
// all points shows whether they are. The kernel in lanes does the same, operation for operation.
//
// What is believed of the corners is what GJK's result has to show, too (gjk_ref.h): zero well
// inside of four; or projections of all points on the way that its corners span that lie as far
// apart as it is long, and a way that ends between the corners. So it does not matter which
// corners are tried.
#pragma once

#include "narrowphase/hulls/features.h"
#include "narrowphase/hulls/gjk_scalar.h"

namespace carom::scalar {

// A hull whose points stay where they are stored: few of them are placed.
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

// Unsure unless the pair is nearest, or overlaps, by these corners. Of overlapping pairs there is
// the decision alone.
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
