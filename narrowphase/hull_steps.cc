// Points and faces of solids in lanes (hull_steps_ref.h is the reference).
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/hull_steps.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/hull_steps.h"
#include "simd/rotation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

using reference::Vector3;

HWY_INLINE F3 in_all_lanes(const Vector3f& v) { return {splat(v.x()), splat(v.y()), splat(v.z())}; }

HWY_INLINE F indices() { return hn::Iota(FloatTag(), 0); }

// Of lanes with the greatest value, the least index.
struct FirstOfMost {
  F most, index;

  static HWY_INLINE FirstOfMost none() { return {splat(-FLT_MAX), splat(0)}; }
  HWY_INLINE void keep(Mask exists, F value, F at) {
    const Mask is_better = hn::And(exists, hn::Gt(value, most));
    most = hn::IfThenElse(is_better, value, most);
    index = hn::IfThenElse(is_better, at, index);
  }
  HWY_INLINE float value() const { return hn::GetLane(hn::MaxOfLanes(FloatTag(), most)); }
  // The same of the indices 0 to count - 1.
  HWY_INLINE size_t first_of(size_t count) const {
    if (count > kLanes) return first();
    const FloatTag tag;
    return hn::FindKnownFirstTrue(tag, hn::Eq(most, hn::MaxOfLanes(tag, most)));
  }
  // Of lanes that kept nothing it is 0.
  HWY_INLINE size_t first() const {
    const FloatTag tag;
    const Mask is_best = hn::Eq(most, hn::MaxOfLanes(tag, most));
    const F candidates = hn::IfThenElse(is_best, index, splat(FLT_MAX));
    return static_cast<size_t>(hn::GetLane(hn::MinOfLanes(tag, candidates)));
  }
};

void place_points(const Solid& solid, const reference::Rotation<float>& turn,
                  const Vector3f& offset, HullPoints& out) {
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
    hn::StoreU(placed.x, tag, out.x.data() + i);
    hn::StoreU(placed.y, tag, out.y.data() + i);
    hn::StoreU(placed.z, tag, out.z.data() + i);
  }
}

// The planes of some faces of a hull.
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

// What one ball says of a vector of faces.
struct BoundLanes {
  F gap, between;
};

HWY_INLINE BoundLanes bound(const FaceLanes& faces, const F3& middle, F radius) {
  const F above = hn::Sub(dot(faces.normal, middle), faces.height);
  const F gap = hn::Sub(above, radius);
  return {gap, hn::IfThenElse(hn::Gt(above, splat(0)), splat(FLT_MAX), gap)};
}

BestFace bound_faces(const Solid& solid, const Ball& ball, FaceBounds& bounds) {
  const FloatTag tag;
  const size_t last = bounds.count++;
  const F3 middle = in_all_lanes(ball.middle);
  const F radius = splat(ball.radius);
  const Mask all = hn::Not(no_lanes());
  FirstOfMost best = FirstOfMost::none();
  F index = indices();
  for (size_t i = 0; i < solid.face_count; i += kLanes) {
    const BoundLanes found = bound(FaceLanes(solid, i), middle, radius);
    hn::StoreU(found.between, tag, bounds.between[last].data() + i);
    float* const gaps = bounds.gap.data() + i;
    float* const closed = bounds.closed.data() + i;
    const F least = last == 0 ? found.gap : min(hn::LoadU(tag, gaps), found.gap);
    const F is_closed = last == 0 ? splat(0) : hn::LoadU(tag, closed);
    hn::StoreU(least, tag, gaps);
    hn::StoreU(is_closed, tag, closed);
    best.keep(all, hn::Sub(least, is_closed), index);
    index = hn::Add(index, splat(kLanes));
  }
  return {best.value(), best.first_of(solid.face_count)};
}

BestFace try_all_faces(const Solid& solid, const HullPoints& points, FaceBounds& bounds) {
  const FloatTag tag;
  bounds.count = points.count;
  const F zero = splat(0);
  const Mask all = hn::Not(no_lanes());
  FirstOfMost best = FirstOfMost::none();
  F index = indices();
  for (size_t i = 0; i < solid.face_count; i += kLanes) {
    const FaceLanes faces(solid, i);
    F least = splat(FLT_MAX);
    for (size_t p = 0; p < points.count; ++p) {
      const F3 point = {splat(points.x[p]), splat(points.y[p]), splat(points.z[p])};
      const BoundLanes found = bound(faces, point, zero);
      hn::StoreU(found.between, tag, bounds.between[p].data() + i);
      least = min(least, found.gap);
    }
    best.keep(all, least, index);
    index = hn::Add(index, splat(kLanes));
  }
  return {best.value(), best.first_of(solid.face_count)};
}

void settle_faces(const Solid& solid, float gap, FaceBounds& bounds) {
  const FloatTag tag;
  const hn::RebindToUnsigned<FloatTag> bits;
  const F most = splat(gap);
  for (size_t i = 0; i < solid.face_count; i += kLanes) {
    auto settled = hn::Zero(bits);
    auto bit = hn::Set(bits, 1);
    for (size_t ball = 0; ball < bounds.count; ++ball) {
      const Mask is_low = hn::Le(hn::LoadU(tag, bounds.between[ball].data() + i), most);
      settled = hn::Or(settled, hn::IfThenElseZero(hn::RebindMask(bits, is_low), bit));
      bit = hn::Add(bit, bit);
    }
    hn::StoreU(settled, bits, bounds.settled.data() + i);
  }
}

HWY_INLINE F heights(const HullPoints& points, const F3& way, size_t i) {
  const FloatTag tag;
  return dot(way, {hn::LoadU(tag, points.x.data() + i), hn::LoadU(tag, points.y.data() + i),
                   hn::LoadU(tag, points.z.data() + i)});
}

FurthestOfHull furthest_of_hull(const HullPoints& points, const Vector3f& way) {
  const F3 n = in_all_lanes(way);
  const Mask all = hn::Not(no_lanes());
  FirstOfMost best = FirstOfMost::none();
  F index = indices();
  for (size_t i = 0; i < points.padded; i += kLanes) {
    best.keep(all, heights(points, n, i), index);
    index = hn::Add(index, splat(kLanes));
  }
  return {best.first_of(points.count), best.value()};
}

FacingPoints facing_points(const HullPoints& points, const Vector3f& way) {
  const FloatTag tag;
  const FurthestOfHull furthest = furthest_of_hull(points, way);
  const F3 n = in_all_lanes(way);
  const F most = splat(furthest.height), count = splat(static_cast<float>(points.count));
  F index = indices();
  size_t found = 0;
  for (size_t i = 0; i < points.padded; i += kLanes) {
    const Mask is_as_far = hn::Le(hn::Sub(most, heights(points, n, i)), splat(kFacingSlack));
    found += hn::CountTrue(tag, hn::And(is_as_far, hn::Lt(index, count)));
    index = hn::Add(index, splat(kLanes));
  }
  return {furthest, found};
}

const HullSteps& hull_steps() {
  static constexpr HullSteps kSteps = {&place_points, &bound_faces,      &try_all_faces,
                                       &settle_faces, &furthest_of_hull, &facing_points};
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
