// Which faces hulls turn towards other shapes: a vector of hulls at a time, each in lanes of its
// points and faces (hull_face.h is the scalar form).
#if defined(CAROM_NARROWPHASE_MANIFOLDS_FACING_FACES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_MANIFOLDS_FACING_FACES_INL_H_
#undef CAROM_NARROWPHASE_MANIFOLDS_FACING_FACES_INL_H_
#else
#define CAROM_NARROWPHASE_MANIFOLDS_FACING_FACES_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>

#include "base/tolerances.h"
#include "narrowphase/batch/shape_lanes-inl.h"
#include "shapes/hull_features.h"
#include "simd/first_of_most-inl.h"
#include "simd/greatest_of_each-inl.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// The scalar form handles faces with more corners, and hulls whose features are unknown.
inline constexpr size_t kMostSideCorners = 8;

// The heights of a hull's points and the cosines of its faces along a direction, in the frame of
// the hull.
class HullProjection {
 public:
  // Whether the hull has features, and fits.
  static bool can_project(const HullGeometry* hull) {
    return hull && hull->features() && hull->points().size() <= kMostLanePoints &&
           hull->faces().size() <= 2 * kMostLanePoints;
  }

  // Writes vectors with the greatest of the heights and of the cosines. The latter may be 0 if none
  // is greater.
  HWY_INLINE void project(const HullGeometry& hull, float scale, const F3& along,
                          F& greatest_height, F& greatest_cosine) {
    const FloatTag tag;
    // Copies, because the compiler would read them again after every store.
    const size_t points = hull.points().size(), faces = hull.faces().size();
    const float *const x = hull.column(0), *const y = hull.column(1), *const z = hull.column(2);
    const HullFeatures& features = *hull.features();
    const float *const u = features.column(0), *const v = features.column(1),
                       *const w = features.column(2);
    greatest_height = greatest_cosine = splat(-FLT_MAX);
    for (size_t i = 0; i < points; i += kLanes) {
      const F3 p = {hn::LoadU(tag, x + i), hn::LoadU(tag, y + i), hn::LoadU(tag, z + i)};
      const F height = dot(along, p * splat(scale));
      hn::Store(height, tag, heights_ + i);
      greatest_height = max(greatest_height, height);
    }
    for (size_t i = 0; i < faces; i += kLanes) {
      const F3 normal = {hn::LoadU(tag, u + i), hn::LoadU(tag, v + i), hn::LoadU(tag, w + i)};
      const F cosine = dot(normal, along);
      hn::Store(cosine, tag, cosines_ + i);
      greatest_cosine = max(greatest_cosine, cosine);
    }
  }

  // The first face with this cosine, if it is above zero and there is one; else any face.
  HWY_INLINE size_t first_with(float cosine, size_t count) const {
    const FloatTag tag;
    constexpr size_t kAtOnce = 64;
    for (size_t first = 0; first < count; first += kAtOnce) {
      const size_t end = std::min(count, first + kAtOnce);
      uint64_t bits = 0;
      for (size_t i = first; i < end; i += kLanes) {
        bits |= bits_of(tag, hn::Eq(hn::Load(tag, cosines_ + i), splat(cosine))) << (i - first);
      }
      if (bits != 0)
        return std::min(first + static_cast<size_t>(std::countr_zero(bits)), count - 1);
    }
    return 0;
  }

  // How many points are at least as high.
  size_t count_points(const HullGeometry& hull, float least) const {
    const FloatTag tag;
    const F count = splat(static_cast<float>(hull.points().size()));
    size_t found = 0;
    F index = lane_indices();
    for (size_t i = 0; i < hull.points().size(); i += kLanes) {
      const Mask is_above = hn::Ge(hn::Load(tag, heights_ + i), splat(least));
      found += hn::CountTrue(tag, hn::And(is_above, hn::Lt(index, count)));
      index = hn::Add(index, splat(kLanes));
    }
    return found;
  }

  // The same face as in the scalar form. `least` and `touching` are heights; `most_corners` can
  // touch of one face, of which two count.
  std::optional<size_t> search(const HullGeometry& hull, float least, float touching,
                               size_t most_corners) {
    std::optional<size_t> found;
    while (true) {
      const size_t face = nearest(hull);
      if (cosines_[face] == -FLT_MAX) return found;
      if (count_corners(hull, face, least) > 0) {
        if (count_corners(hull, face, touching) >= most_corners) return face;
        if (!found) found = face;
      }
      cosines_[face] = -FLT_MAX;
    }
  }

 private:
  size_t nearest(const HullGeometry& hull) const {
    const FloatTag tag;
    const F count = splat(static_cast<float>(hull.faces().size()));
    FirstOfMost best = FirstOfMost::none();
    F index = lane_indices();
    for (size_t i = 0; i < hull.faces().size(); i += kLanes) {
      best.keep(hn::Lt(index, count), hn::Load(tag, cosines_ + i), index);
      index = hn::Add(index, splat(kLanes));
    }
    return best.first_of(hull.faces().size());
  }

  size_t count_corners(const HullGeometry& hull, size_t face, float least) const {
    const auto corners = hull.corners(hull.faces()[face]);
    return static_cast<size_t>(std::count_if(corners.begin(), corners.end(),
                                             [&](uint32_t i) { return heights_[i] >= least; }));
  }

  HWY_ALIGN float heights_[kMostLanePoints];
  HWY_ALIGN float cosines_[2 * kMostLanePoints];
};

// The facing face of each lane's hull, in the frame and the scaled units of the hull.
class FacingFaces {
 public:
  // `along` is in the frames of the hulls; `depth` is that of the contact.
  FacingFaces(const HullLanes& hull, const F3& along, F depth) {
    const FloatTag tag;
    HullProjection projections[kLanes];
    F furthest, nearest;
    project(hull, along, projections, furthest, nearest);
    choose_nearest(projections, nearest);
    read_faces();
    place_corners(hull.scaling);
    const F least = hn::Sub(furthest, hn::Mul(splat(kSameCorner), hull.extent()));
    const F touching = min(least, hn::Sub(furthest, depth));
    // The face whose normal is nearest to the direction is nearly always the right one.
    Mask is_furthest, is_touching;
    compare_corners(along, least, touching, is_furthest, is_touching);
    is_furthest = hn::And(is_furthest, hn::Gt(nearest, splat(0)));
    const Mask in_doubt = hn::AndNot(hn::And(is_furthest, is_touching), is_known());
    if (HWY_LIKELY(hn::AllFalse(tag, in_doubt))) return;
    const bool has_changed =
        search(bits_of(tag, in_doubt), bits_of(tag, is_furthest), least, touching, projections);
    if (has_changed) place_corners(hull.scaling);
  }

  size_t most() const { return most_; }
  HWY_INLINE Mask is_known() const { return hn::Gt(count(), splat(0)); }
  HWY_INLINE F count() const { return hn::Load(FloatTag(), count_); }
  HWY_INLINE F3 normal() const { return vectors_of(planes_); }
  // The first most() corners. Places after the last corner repeat the first one.
  HWY_INLINE F3 corner(size_t k) const {
    const FloatTag tag;
    return {hn::Load(tag, corners_[k][0]), hn::Load(tag, corners_[k][1]),
            hn::Load(tag, corners_[k][2])};
  }

 private:
  using Records = float[kLanes][4];

  struct RecordSource {
    const Records& records;

#if HWY_TARGET != HWY_SCALAR
    HWY_INLINE hn::Vec<Quad> quad(size_t i) const { return hn::Load(Quad(), records[i]); }
#endif
    HWY_INLINE float component(size_t i, size_t c) const { return records[i][c]; }
  };

  static HWY_INLINE F3 vectors_of(const Records& records) {
    F3 v;
    F unused;
    transpose_records(RecordSource{records}, v, unused);
    return v;
  }

  // Writes the greatest height and the greatest cosine of each hull.
  HWY_INLINE void project(const HullLanes& hull, const F3& along,
                          HullProjection (&projections)[kLanes], F& furthest, F& nearest) {
    const FloatTag tag;
    HWY_ALIGN float ways[3][kLanes], scales[kLanes];
    hn::Store(along.x, tag, ways[0]);
    hn::Store(along.y, tag, ways[1]);
    hn::Store(along.z, tag, ways[2]);
    hn::Store(hull.scaling, tag, scales);
    GreatestOfEach heights, cosines;
    for (size_t lane = 0; lane < kLanes; ++lane) {
      const HullGeometry* const geometry = hull.geometry[lane];
      const bool is_searched = HullProjection::can_project(geometry);
      searched_[lane] = is_searched ? geometry : nullptr;
      F height = splat(0), cosine = splat(0);
      if (HWY_LIKELY(is_searched)) {
        const F3 way = {splat(ways[0][lane]), splat(ways[1][lane]), splat(ways[2][lane])};
        projections[lane].project(*geometry, scales[lane], way, height, cosine);
      }
      heights.put(lane, height);
      cosines.put(lane, cosine);
    }
    furthest = heights.lanes();
    nearest = cosines.lanes();
  }

  HWY_INLINE void choose_nearest(const HullProjection (&projections)[kLanes], F nearest) {
    HWY_ALIGN float cosines[kLanes];
    hn::Store(nearest, FloatTag(), cosines);
    for (size_t lane = 0; lane < kLanes; ++lane) {
      const HullGeometry* const hull = searched_[lane];
      if (HWY_UNLIKELY(!hull)) continue;
      const auto faces = hull->faces();
      choose(lane, *hull, projections[lane].first_with(cosines[lane], faces.size()));
    }
  }

  HWY_INLINE void choose(size_t lane, const HullGeometry& hull, size_t face) {
    const HullGeometry::Face& outline = hull.faces()[face];
    face_[lane] = static_cast<uint32_t>(face);
    first_[lane] = outline.first;
    corner_count_[lane] = outline.count;
  }

  // Each step for all hulls before the next, since each waits for what the last one has read.
  HWY_INLINE void read_faces() {
    for (size_t lane = 0; lane < kLanes; ++lane) {
      if (HWY_LIKELY(searched_[lane])) {
        read(lane, *searched_[lane]);
      } else {
        leave(lane);
      }
    }
  }

  HWY_INLINE void read(size_t lane, const HullGeometry& hull) {
    const size_t count = corner_count_[lane];
    if (HWY_UNLIKELY(count > kMostSideCorners)) return leave(lane);
    const uint32_t* const corners = hull.corners().data() + first_[lane];
    const std::array<float, 4>* const points = hull.records().data();
    count_[lane] = static_cast<float>(count);
    std::memcpy(planes_[lane], hull.features()->planes()[face_[lane]].data(),
                sizeof(planes_[lane]));
    for (size_t k = 0; k < count; ++k) {
      std::memcpy(records_[k][lane], points[corners[k]].data(), sizeof(records_[k][lane]));
    }
    most_ = std::max(most_, count);
    least_ = std::min(least_, count);
  }

  void leave(size_t lane) {
    count_[lane] = 0;
    std::fill_n(planes_[lane], 4, 0.0f);
    std::fill_n(records_[0][lane], 4, 0.0f);
    least_ = 0;
  }

  HWY_INLINE void place_corners(F scaling) {
    const FloatTag tag;
    if (HWY_UNLIKELY(least_ < most_)) repeat_first();
    for (size_t k = 0; k < most_; ++k) {
      const F3 p = vectors_of(records_[k]) * scaling;
      hn::Store(p.x, tag, corners_[k][0]);
      hn::Store(p.y, tag, corners_[k][1]);
      hn::Store(p.z, tag, corners_[k][2]);
    }
  }

  void repeat_first() {
    for (size_t lane = 0; lane < kLanes; ++lane) {
      for (auto k = std::max<size_t>(1, static_cast<size_t>(count_[lane])); k < most_; ++k) {
        std::copy_n(records_[0][lane], 4, records_[k][lane]);
      }
    }
  }

  // In which lanes a corner of the face is as high as `least`, and in which two as `touching`.
  HWY_INLINE void compare_corners(const F3& along, F least, F touching, Mask& is_furthest,
                                  Mask& is_touching) const {
    Mask one = no_lanes();
    is_furthest = is_touching = no_lanes();
    for (size_t k = 0; k < most_; ++k) {
      const F height = dot(along, corner(k));
      const Mask exists = hn::Gt(count(), splat(static_cast<float>(k)));
      const Mask touches = hn::And(exists, hn::Ge(height, touching));
      is_furthest = hn::Or(is_furthest, hn::And(exists, hn::Ge(height, least)));
      is_touching = hn::Or(is_touching, hn::And(one, touches));
      one = hn::Or(one, touches);
    }
  }

  // Searches these lanes, but those of hulls with one touching corner that the face has. Returns
  // whether a face has changed.
  HWY_NOINLINE bool search(uint64_t lanes, uint64_t is_furthest, F least, F touching,
                           HullProjection (&projections)[kLanes]) {
    const FloatTag tag;
    HWY_ALIGN float leasts[kLanes], touchings[kLanes];
    hn::Store(least, tag, leasts);
    hn::Store(touching, tag, touchings);
    bool has_changed = false;
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<size_t>(std::countr_zero(lanes));
      const HullGeometry& hull = *searched_[lane];
      const size_t corners = projections[lane].count_points(hull, touchings[lane]);
      if (corners < 2 && (is_furthest >> lane & 1) != 0) continue;
      const std::optional<size_t> face = projections[lane].search(
          hull, leasts[lane], touchings[lane], std::min<size_t>(corners, 2));
      if (face == face_[lane]) continue;
      has_changed = true;
      if (face) {
        choose(lane, hull, *face);
        read(lane, hull);
      } else {
        leave(lane);
      }
    }
    return has_changed;
  }

  size_t most_ = 3, least_ = kMostSideCorners;  // corners
  const HullGeometry* searched_[kLanes];        // nullptr: the face is not known
  uint32_t face_[kLanes], first_[kLanes], corner_count_[kLanes];
  HWY_ALIGN float count_[kLanes];
  HWY_ALIGN Records planes_;
  HWY_ALIGN Records records_[kMostSideCorners];
  HWY_ALIGN float corners_[kMostSideCorners][3][kLanes];
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_MANIFOLDS_FACING_FACES_INL_H_
