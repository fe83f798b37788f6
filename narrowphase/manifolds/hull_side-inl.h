// The faces that hulls turn towards other shapes, in lanes (hull_face.h is the scalar form).
#if defined(CAROM_NARROWPHASE_MANIFOLDS_HULL_SIDE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_MANIFOLDS_HULL_SIDE_INL_H_
#undef CAROM_NARROWPHASE_MANIFOLDS_HULL_SIDE_INL_H_
#else
#define CAROM_NARROWPHASE_MANIFOLDS_HULL_SIDE_INL_H_
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/tolerances.h"
#include "narrowphase/features/segment-inl.h"
#include "narrowphase/hulls/core_lanes-inl.h"
#include "narrowphase/manifolds/polygon-inl.h"
#include "shapes/hull_features.h"
#include "simd/first_of_most-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// The scalar form handles faces with more corners, and hulls whose features are unknown.
inline constexpr size_t kMostSideCorners = 8;

// Searches one hull along one direction, in its own frame. `depth` is that of the contact.
class FacingFaceSearch {
 public:
  FacingFaceSearch(const HullGeometry& hull, float scale, const F3& along, float depth)
      : hull_(hull) {
    const FloatTag tag;
    F most = splat(-FLT_MAX);
    for (size_t i = 0; i < hull.points().size(); i += kLanes) {
      const F3 p = {hn::LoadU(tag, hull.column(0) + i), hn::LoadU(tag, hull.column(1) + i),
                    hn::LoadU(tag, hull.column(2) + i)};
      const F height = dot(along, p * splat(scale));
      hn::Store(height, tag, heights_ + i);
      most = max(most, height);
    }
    const float furthest = hn::GetLane(hn::MaxOfLanes(tag, most));
    least_ = furthest - kSameCorner * (hull.size() * scale);
    touching_ = std::min(least_, furthest - depth);
    most_corners_ = std::min<size_t>(count_touching(), 2);
    for (size_t i = 0; i < hull.faces().size(); i += kLanes) {
      const HullFeatures& features = *hull.features();
      const F3 normal = {hn::LoadU(tag, features.column(0) + i),
                         hn::LoadU(tag, features.column(1) + i),
                         hn::LoadU(tag, features.column(2) + i)};
      hn::Store(dot(normal, along), tag, cosines_ + i);
    }
  }

  // The same face as in the scalar form. It is nearly always the first one tried, whose normal is
  // nearest to the direction.
  std::optional<size_t> run() {
    std::optional<size_t> found;
    while (true) {
      const size_t face = nearest();
      if (cosines_[face] == -FLT_MAX) return found;
      if (count_above(face, least_) > 0) {
        if (count_above(face, touching_) >= most_corners_) return face;
        if (!found) found = face;
      }
      cosines_[face] = -FLT_MAX;
    }
  }

 private:
  // Counts the points that touch.
  size_t count_touching() const {
    const FloatTag tag;
    const F count = splat(static_cast<float>(hull_.points().size()));
    size_t found = 0;
    F index = lane_indices();
    for (size_t i = 0; i < hull_.points().size(); i += kLanes) {
      const Mask touches = hn::Ge(hn::Load(tag, heights_ + i), splat(touching_));
      found += hn::CountTrue(tag, hn::And(touches, hn::Lt(index, count)));
      index = hn::Add(index, splat(kLanes));
    }
    return found;
  }

  size_t nearest() const {
    const FloatTag tag;
    const F count = splat(static_cast<float>(hull_.faces().size()));
    FirstOfMost best = FirstOfMost::none();
    F index = lane_indices();
    for (size_t i = 0; i < hull_.faces().size(); i += kLanes) {
      best.keep(hn::Lt(index, count), hn::Load(tag, cosines_ + i), index);
      index = hn::Add(index, splat(kLanes));
    }
    return best.first_of(hull_.faces().size());
  }

  size_t count_above(size_t face, float least) const {
    const auto corners = hull_.corners(hull_.faces()[face]);
    return static_cast<size_t>(std::count_if(corners.begin(), corners.end(),
                                             [&](uint32_t i) { return heights_[i] >= least; }));
  }

  const HullGeometry& hull_;
  float least_, touching_;  // heights
  size_t most_corners_;     // the most that can touch of one face, at most 2
  HWY_ALIGN float heights_[kMostLanePoints];
  HWY_ALIGN float cosines_[2 * kMostLanePoints];
};

// For each lane's hull: the outline of its facing face, as indices of points, and the face's normal
// in the frame of the hull.
class FacingFaces {
 public:
  // `along` is in the frames of the hulls.
  FacingFaces(const HullLanes& hull, const F3& along, F depth) {
    const FloatTag tag;
    HWY_ALIGN float ways[3][kLanes];
    HWY_ALIGN float scales[kLanes], depths[kLanes];
    hn::Store(depth, tag, depths);
    hn::Store(along.x, tag, ways[0]);
    hn::Store(along.y, tag, ways[1]);
    hn::Store(along.z, tag, ways[2]);
    hn::Store(hull.scaling, tag, scales);
    for (size_t lane = 0; lane < kLanes; ++lane) {
      const F3 way = {splat(ways[0][lane]), splat(ways[1][lane]), splat(ways[2][lane])};
      find(hull.geometry[lane], scales[lane], way, depths[lane], lane);
    }
  }

  size_t most() const { return most_; }
  HWY_INLINE Mask is_known() const { return hn::Gt(count(), splat(0)); }
  HWY_INLINE F count() const { return hn::Load(FloatTag(), count_); }
  HWY_INLINE F3 normal() const {
    const FloatTag tag;
    return {hn::Load(tag, normal_[0]), hn::Load(tag, normal_[1]), hn::Load(tag, normal_[2])};
  }
  const std::array<uint8_t, kLanes>& place(size_t corner) const { return place_[corner]; }

 private:
  void find(const HullGeometry* hull, float scale, const F3& way, float depth, size_t lane) {
    count_[lane] = 0;
    for (auto& places : place_) places[lane] = 0;
    for (auto& component : normal_) component[lane] = 0;
    if (!hull || !hull->features() || hull->points().size() > kMostLanePoints ||
        hull->faces().size() > 2 * kMostLanePoints) {
      return;
    }
    const std::optional<size_t> face = FacingFaceSearch(*hull, scale, way, depth).run();
    if (!face) return;
    const auto corners = hull->corners(hull->faces()[*face]);
    if (corners.size() > kMostSideCorners) return;
    const auto normal = hull->features()->normal(*face);
    for (size_t axis = 0; axis < 3; ++axis) normal_[axis][lane] = normal[axis];
    for (size_t k = 0; k < kMostSideCorners; ++k) {
      place_[k][lane] = static_cast<uint8_t>(corners[k < corners.size() ? k : 0]);
    }
    count_[lane] = static_cast<float>(corners.size());
    most_ = std::max(most_, corners.size());
  }

  size_t most_ = 3;
  HWY_ALIGN float count_[kLanes];
  HWY_ALIGN float normal_[3][kLanes];
  std::array<std::array<uint8_t, kLanes>, kMostSideCorners> place_;
};

// `found` has at most kMost corners.
template <size_t kMost>
HWY_INLINE void hull_side(const HullLanes& hull, const Placed& placed, const FacingFaces& found,
                          FaceSide<PolygonFace<kMost>>& side) {
  const HullRecords records(hull);
  const F3 n = found.normal(), u = any_perpendicular(n), v = cross(n, u);
  const F3 first = records.points_at(found.place(0)) * hull.scaling;
  PolygonFace<kMost>& face = side.face;
  for (size_t k = 0; k < kMost; ++k) {
    const F3 p = records.points_at(found.place(k)) * hull.scaling, r = p - first;
    side.corners[k] = rotate(placed.turn, p) + placed.origin;
    face.x[k] = dot(u, r);
    face.y[k] = dot(v, r);
  }
  face.count = found.count();
  face.frame.origin = side.corners[0];
  face.frame.u = rotate(placed.turn, u);
  face.frame.v = rotate(placed.turn, v);
  face.frame.n = rotate(placed.turn, n);
  face.frame.height = splat(0);
  face.lower_x = face.upper_x = face.x[0];
  face.lower_y = face.upper_y = face.y[0];
  for (size_t k = 1; k < kMost; ++k) {
    face.lower_x = min(face.lower_x, face.x[k]);
    face.lower_y = min(face.lower_y, face.y[k]);
    face.upper_x = max(face.upper_x, face.x[k]);
    face.upper_y = max(face.upper_y, face.y[k]);
  }
}

// A triangle as a polygon. As in clip_to_extent(), only x has bounds.
template <size_t kMost>
HWY_INLINE void triangle_as_polygon(const FaceSide<TriangleFace>& triangle,
                                    FaceSide<PolygonFace<kMost>>& side) {
  PolygonFace<kMost>& face = side.face;
  face.frame = triangle.face.frame;
  for (size_t k = 0; k < kMost; ++k) {
    const size_t corner = k < 3 ? k : 0;
    side.corners[k] = triangle.corners[corner];
    face.x[k] = triangle.face.x[corner];
    face.y[k] = triangle.face.y[corner];
  }
  face.count = splat(3);
  face.lower_x = splat(0);
  face.upper_x = triangle.face.x[1];
  face.lower_y = splat(-HUGE_VALF);
  face.upper_y = splat(HUGE_VALF);
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_MANIFOLDS_HULL_SIDE_INL_H_
