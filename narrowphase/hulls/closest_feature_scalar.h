// The closest feature of two cores: the nearest vector that one to three corners of B - A span, and
// whether all points of both cores confirm it.
#pragma once

#include <cmath>

#include "base/few_of.h"
#include "base/tolerances.h"
#include "narrowphase/hulls/float_core.h"
#include "narrowphase/hulls/simplex_scalar.h"

namespace carom::scalar {

// Support of a core along a direction: the greatest height, and the number of points that reach
// `height` up to kFacingSlack.
struct FacingCount {
  float most = -kLargest;
  size_t count = 0;
};

inline FacingCount count_facing(const FloatCore& core, const Vector3f& way, float height) {
  const float limit = height - kFacingSlack;
  FacingCount facing;
  for (const Vector3f& p : core.points) {
    const float h = dot(way, p);
    facing.most = max(facing.most, h);
    facing.count += h >= limit;
  }
  return facing;
}

// The closest points of two cores.
struct NearestCores {
  float distance;
  Vector3f normal;  // unit, from A to B
  Vector3f on_a;
  bool is_sure;
};

// The vector from zero to the span of one to three corners of B - A.
class SpannedWay {
 public:
  explicit SpannedWay(const FewOf<Corner, 3>& ends) : p_(ends[0]) {
    Vector3f way = p_.point;
    on_a_ = p_.on_a;
    if (ends.size() == 2) {  // perpendicular to the side between them
      const Corner& q = ends[1];
      const Vector3f u = q.point - p_.point;
      const float uu = dot(u, u), along = -dot(p_.point, u) / uu;
      const Vector3f on_side = p_.point + u * along;
      way = on_side - u * (dot(on_side, u) / uu);
      on_a_ = p_.on_a + (q.on_a - p_.on_a) * along;
      ends_inside_ = along > 0 && along < 1;
    }
    if (ends.size() == 3) {  // perpendicular to their plane
      const Corner &q = ends[1], &r = ends[2];
      const Vector3f u = q.point - p_.point, v = r.point - p_.point, n = cross(u, v);
      const float nn = dot(n, n);
      way = n * (dot(n, p_.point) / nn);
      const Vector3f along_plane = way - p_.point;
      const float of_q = dot(n, cross(along_plane, v)) / nn;
      const float of_r = dot(n, cross(u, along_plane)) / nn;
      on_a_ = (p_.on_a + (q.on_a - p_.on_a) * of_q) + (r.on_a - p_.on_a) * of_r;
      is_wide_ = nn > kSmallCrossing * (dot(u, u) * dot(v, v));
      ends_inside_ = min(of_q, of_r) > 0 && of_q + of_r < 1;
    }
    distance_ = std::sqrt(dot(way, way));
    normal_ = way * (1 / distance_);
    // Rounding tilts the plane of a needle; its corners then have different heights.
    const auto is_level = [&](const Corner& corner) {
      return std::fabs(dot(normal_, corner.point - p_.point)) <= kSameGapInFloat;
    };
    is_tilted_ = ends.size() == 3 && !(is_level(ends[1]) && is_level(ends[2]));
  }

  float distance() const { return distance_; }
  const Vector3f& normal() const { return normal_; }  // unit, from A to B
  bool ends_inside() const { return ends_inside_; }   // strictly inside the span of the corners
  // Heights of the two points behind the first corner: A's along the normal, B's against it.
  float height_of_a() const { return dot(normal_, p_.on_a); }
  float height_of_b() const { return -dot(normal_, on_b()); }

  // Compares the vector with the support of all points: `of_a` along the normal, `of_b` against it.
  // It is sure if no points of the cores are nearer and the witness points are unique.
  NearestCores confirmed_by(const FacingCount& of_a, const FacingCount& of_b) const {
    const float gap = -(of_a.most + of_b.most);
    const bool is_shortest = std::fabs(distance_ - gap) <= kSameGapInFloat;
    // The witness points are unique if one core has a single facing point, or two edges cross.
    const bool crosses = is_wide_ && of_a.count <= 2 && of_b.count <= 2;
    const bool is_unique = of_a.count <= 1 || of_b.count <= 1 || crosses;
    Vector3f on_a = on_a_;
    if (of_a.count <= 1) on_a = p_.on_a;
    if (of_b.count <= 1) on_a = on_b() - normal_ * distance_;
    const bool is_sure = distance_ > kNearCores && is_shortest && is_unique && !is_tilted_;
    return {distance_, normal_, on_a, is_sure};
  }

 private:
  Vector3f on_b() const { return p_.point + p_.on_a; }

  Corner p_;
  Vector3f on_a_, normal_;
  float distance_;
  bool is_wide_ = false, is_tilted_ = false, ends_inside_ = true;
};

}  // namespace carom::scalar
