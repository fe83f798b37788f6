// The steps of the float32 penetration search in lanes (hull_steps_scalar.h is the scalar form).
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/hulls/hull_steps.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <bit>

#include "narrowphase/hulls/deep_frames-inl.h"
#include "narrowphase/hulls/hull_edges-inl.h"
#include "narrowphase/hulls/hull_steps.h"
#include "narrowphase/hulls/shell_check-inl.h"
#include "narrowphase/hulls/shell_corners-inl.h"
#include "simd/first_of_most-inl.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

using scalar::Vector3;

void place_points(const Solid& solid, const scalar::Rotation<float>& turn, const Vector3f& offset,
                  HullPoints& out) {
  const FloatTag tag;
  const Rotation r{in_all_lanes(turn.x), in_all_lanes(turn.y), in_all_lanes(turn.z)};
  const F3 d = in_all_lanes(offset);
  const F s = splat(solid.scale);
  out.count = solid.point_count;
  out.padded = (out.count + kLanes - 1) / kLanes * kLanes;
  for (size_t i = 0; i < out.padded; i += kLanes) {
    const F3 p = {hn::LoadU(tag, solid.point[0] + i), hn::LoadU(tag, solid.point[1] + i),
                  hn::LoadU(tag, solid.point[2] + i)};
    const F3 placed = rotate(r, p * s) + d;
    hn::StoreU(placed.x, tag, out.column(0) + i);
    hn::StoreU(placed.y, tag, out.column(1) + i);
    hn::StoreU(placed.z, tag, out.column(2) + i);
  }
}

// The planes of kLanes faces, from face i on.
struct FaceLanes {
  F3 normal;
  F height;

  HWY_INLINE FaceLanes(const Solid& solid, size_t i) {
    const FloatTag tag;
    normal = {hn::LoadU(tag, solid.plane[0] + i), hn::LoadU(tag, solid.plane[1] + i),
              hn::LoadU(tag, solid.plane[2] + i)};
    height = hn::Mul(hn::LoadU(tag, solid.plane[3] + i), splat(solid.scale));
  }
};

HWY_INLINE F above(const FaceLanes& faces, const F3& point) {
  return hn::Sub(dot(faces.normal, point), faces.height);
}

// The bounds of one ball for a vector of faces (see FaceBounds).
struct BoundLanes {
  F gap, between;
};

HWY_INLINE BoundLanes bound(const FaceLanes& faces, const F3& middle, F radius) {
  const F height = above(faces, middle);
  const F gap = hn::Sub(height, radius);
  return {gap, hn::IfThenElse(hn::Gt(height, splat(0)), splat(FLT_MAX), gap)};
}

BestFace bound_faces(const Solid& solid, const Ball& ball, FaceBounds& bounds) {
  const FloatTag tag;
  const size_t last = bounds.count++;
  const F3 middle = in_all_lanes(ball.middle);
  const F radius = splat(ball.radius);
  const Mask all = hn::Not(no_lanes());
  FirstOfMost best = FirstOfMost::none();
  F index = lane_indices();
  for (size_t i = 0; i < solid.face_count; i += kLanes) {
    const BoundLanes found = bound(FaceLanes(solid, i), middle, radius);
    hn::StoreU(found.between, tag, bounds.between(last) + i);
    float* const gaps = bounds.gap.data() + i;
    const F least = last == 0 ? found.gap : min(hn::LoadU(tag, gaps), found.gap);
    hn::StoreU(least, tag, gaps);
    best.keep(all, least, index);
    index = hn::Add(index, splat(kLanes));
  }
  return {best.value(), best.first_of(solid.face_count)};
}

HWY_INLINE F heights(const PointView& points, const F3& way, size_t i) {
  const FloatTag tag;
  return dot(way, {hn::LoadU(tag, points.column[0] + i), hn::LoadU(tag, points.column[1] + i),
                   hn::LoadU(tag, points.column[2] + i)});
}

// Finds the greatest height first, and then its place: fewer instructions than to keep both.
FurthestOfHull furthest_of_hull(const PointView& points, const Vector3f& way) {
  const FloatTag tag;
  const F3 n = in_all_lanes(way);
  HWY_ALIGN float found[kMostLanePoints];
  F most = heights(points, n, 0);
  hn::Store(most, tag, found);
  for (size_t i = kLanes; i < points.padded; i += kLanes) {
    const F height = heights(points, n, i);
    hn::Store(height, tag, found + i);
    most = max(most, height);
  }
  const F greatest = hn::MaxOfLanes(tag, most);
  // Without a branch on the place, which nobody can predict.
  const auto place_from = [&](size_t begin) {
    uint64_t places = 0;
    for (size_t i = begin; i < std::min(begin + 64, points.padded); i += kLanes) {
      places |= bits_of(tag, hn::Eq(hn::Load(tag, found + i), greatest)) << (i - begin);
    }
    return begin + static_cast<size_t>(std::countr_zero(places));
  };
  static_assert(kMostLanePoints == 128);
  const size_t low = place_from(0);
  const size_t place = low < 64 ? low : place_from(64);
  return {place < points.count ? place : 0, hn::GetLane(greatest)};  // heights may be no numbers
}

TriedFace try_face(const Solid& solid, const HullPoints& points, size_t face, FaceBounds& bounds) {
  const FurthestOfHull lowest = furthest_of_hull(points.view(), -solid.normal(face));
  const float gap = -lowest.height - solid.height(face);
  return {gap, bound_faces(solid, {points[lowest.index], 0}, bounds)};
}

BestFace try_all_faces(const Solid& solid, const HullPoints& points, FaceBounds& bounds) {
  const FloatTag tag;
  bounds.count = points.count;
  const Mask all = hn::Not(no_lanes());
  FirstOfMost best = FirstOfMost::none();
  F index = lane_indices();
  // Copies, because the compiler would read them again after every store.
  const size_t count = points.count, padded = padded_count(solid.face_count);
  const float *const x = points.column(0), *const y = points.column(1), *const z = points.column(2);
  for (size_t i = 0; i < solid.face_count; i += kLanes) {
    const FaceLanes faces(solid, i);
    float* between = bounds.between(0) + i;
    F least = splat(FLT_MAX);
    for (size_t p = 0; p < count; ++p, between += padded) {
      const F gap = above(faces, {splat(x[p]), splat(y[p]), splat(z[p])});
      hn::StoreU(gap, tag, between);
      least = min(least, gap);
    }
    best.keep(all, least, index);
    index = hn::Add(index, splat(kLanes));
  }
  return {best.value(), best.first_of(solid.face_count)};
}

FacingPoints facing_points(const HullPoints& points, const Vector3f& way) {
  const FloatTag tag;
  const FurthestOfHull furthest = furthest_of_hull(points.view(), way);
  const F3 n = in_all_lanes(way);
  const F most = splat(furthest.height), count = splat(static_cast<float>(points.count));
  F index = lane_indices();
  size_t found = 0;
  for (size_t i = 0; i < points.padded; i += kLanes) {
    const Mask is_as_far = hn::Le(hn::Sub(most, heights(points.view(), n, i)), splat(kFacingSlack));
    found += hn::CountTrue(tag, hn::And(is_as_far, hn::Lt(index, count)));
    index = hn::Add(index, splat(kLanes));
  }
  return {furthest, found};
}

bool is_inside(const Solid& solid, const Vector3f& point) {
  const F3 p = in_all_lanes(point);
  Mask is_outside = no_lanes();
  for (size_t i = 0; i < solid.face_count; i += kLanes) {
    const Mask is_above = hn::Gt(above(FaceLanes(solid, i), p), splat(kSameGapInFloat));
    is_outside = hn::Or(is_outside, is_above);
  }
  return hn::AllFalse(FloatTag(), is_outside);
}

const HullSteps& hull_steps() {
  static constexpr HullSteps kSteps = {
      &set_up_frames, &finish_frames,   &place_points, &bound_faces,      &try_face,
      &try_all_faces, &find_open_edges, &cross_edges,  &furthest_of_hull, &facing_points,
      &is_inside,     &place_corners,   &check_planes, &check_edges,      &in_front};
  return kSteps;
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(hull_steps);

}  // namespace

const HullSteps& hull_steps_in_lanes() { return CAROM_DISPATCH(hull_steps)(); }

}  // namespace carom
#endif  // HWY_ONCE
