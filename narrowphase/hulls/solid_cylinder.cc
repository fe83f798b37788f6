// The widest gaps between solids and cylinders, a feature a lane (solid_cylinder_scalar.h is the
// scalar form, says how the search goes, and gives the same bits).
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/hulls/solid_cylinder.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <array>

#include "narrowphase/features/solid_contact-inl.h"
#include "narrowphase/hulls/solid_arcs-inl.h"
#include "narrowphase/hulls/solid_cylinder.h"
#include "simd/first_of_most-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

SolidWay best_face(const Solid& solid, const CylinderOfPair& cylinder) {
  const FloatTag tag;
  const F scale = splat(solid.scale);
  const F count = splat(static_cast<float>(solid.face_count));
  FirstOfMost best = FirstOfMost::none();
  F index = lane_indices();
  for (size_t i = 0; i < solid.face_count; i += kLanes) {
    const F3 n = load3({solid.plane[0], solid.plane[1], solid.plane[2]}, i, splat(1));
    const F height = hn::Mul(hn::LoadU(tag, solid.plane[3] + i), scale);
    best.keep(hn::Lt(index, count), cylinder.gap_over(n, height), index);
    index = hn::Add(index, splat(kLanes));
  }
  const size_t place = best.first();
  return {best.value(), solid.normal(place), SolidWay::Feature::face, static_cast<uint32_t>(place)};
}

// How far the solid reaches along n, and against it.
void reach_along(const Solid& solid, const Vector3f& n, float& along, float& against) {
  const FloatTag tag;
  const F scale = splat(solid.scale);
  const F3 way = in_all_lanes(n);
  F most = splat(-FLT_MAX), least = splat(FLT_MAX);
  for (size_t i = 0; i < solid.point_count; i += kLanes) {
    const F height = dot(way, load3(solid.point, i, scale));
    most = max(most, height);
    least = min(least, height);
  }
  along = hn::GetLane(hn::MaxOfLanes(tag, most));
  against = -hn::GetLane(hn::MinOfLanes(tag, least));
}

void keep_caps(const Solid& solid, const PlacedCylinder& cylinder, SolidWay& best) {
  float along, against;
  reach_along(solid, cylinder.axis, along, against);
  const float middle = scalar::dot(cylinder.axis, cylinder.middle);
  for (const float sign : {1.0f, -1.0f}) {
    const float height = sign > 0 ? along : against;
    const float gap = (sign * middle - cylinder.half_length) - height;
    best.keep_if_wider({gap, cylinder.axis * sign, SolidWay::Feature::cap, 0});
  }
}

SolidWay best_corner(const Solid& solid, const PlacedCylinder& placed,
                     const CylinderOfPair& cylinder) {
  const AxialCoreLanes core = {cylinder.axis, cylinder.half_length, cylinder.rim};
  const F scale = splat(solid.scale), count = splat(static_cast<float>(solid.point_count));
  FirstOfMost best = FirstOfMost::none();
  F index = lane_indices();
  for (size_t i = 0; i < solid.point_count; i += kLanes) {
    const F3 n = way_from_corner(load3(solid.point, i, scale), cylinder.middle, core);
    F height = splat(-FLT_MAX);
    for (size_t k = 0; k < solid.point_count; ++k) {
      height = max(height, dot(n, in_all_lanes(solid.corner(k))));
    }
    best.keep(hn::Lt(index, count), cylinder.gap_over(n, height), index);
    index = hn::Add(index, splat(kLanes));
  }
  const size_t place = best.first();
  return {best.value(), scalar::way_from_corner(solid.corner(place), placed.middle, placed.core()),
          SolidWay::Feature::corner, static_cast<uint32_t>(place)};
}

void begin(const Solid& solid, const PlacedCylinder& placed, uint8_t pair, SolidWay* ways,
           WaitingArcs& waiting) {
  if (waiting.rest_count + solid.edge_count > WaitingArcs::kMost) search_waiting(ways, waiting);
  const CylinderOfPair cylinder(placed);
  SolidWay best;
  best.keep_if_wider(best_face(solid, cylinder));
  keep_caps(solid, placed, best);
  best.keep_if_wider(best_corner(solid, placed, cylinder));
  ways[pair] = best;
  waiting.half_length[pair] = placed.half_length;
  waiting.rim[pair] = placed.rim;
  leave_edges(solid, cylinder, pair, best, waiting);
}

bool is_within(const Solid& solid, const Vector3f& p, float most) {
  const FloatTag tag;
  const F3 place = in_all_lanes(p);
  const F scale = splat(solid.scale);
  Mask within = hn::Not(no_lanes());
  for (size_t i = 0; i < solid.face_count; i += kLanes) {
    const F3 n = load3({solid.plane[0], solid.plane[1], solid.plane[2]}, i, splat(1));
    const F height = hn::Mul(hn::LoadU(tag, solid.plane[3] + i), scale);
    within = hn::And(within, hn::Le(hn::Sub(dot(n, place), height), splat(most)));
  }
  return hn::AllTrue(tag, within);
}

Vector3f furthest_corner(const Solid& solid, const Vector3f& n) {
  const F count = splat(static_cast<float>(solid.point_count)), scale = splat(solid.scale);
  const F3 way = in_all_lanes(n);
  FirstOfMost best = FirstOfMost::none();
  F index = lane_indices();
  for (size_t i = 0; i < solid.point_count; i += kLanes) {
    best.keep(hn::Lt(index, count), dot(way, load3(solid.point, i, scale)), index);
    index = hn::Add(index, splat(kLanes));
  }
  return solid.corner(best.first());
}

scalar::SolidContact contact(const Solid& solid, const PlacedCylinder& cylinder,
                             const SolidWay& way, bool is_blunt) {
  float along, against;
  const Vector3f n = scalar::direction_of(solid, way);
  reach_along(solid, n, along, against);
  const auto is_in_solid = [&](const Vector3f& p, float most) { return is_within(solid, p, most); };
  const auto furthest = [&] { return furthest_corner(solid, n); };
  return scalar::contact_at(solid, cylinder, way, n, along, is_blunt, furthest, is_in_solid);
}

const SolidWaySteps& solid_way_steps() {
  static constexpr SolidWaySteps kSteps = {&begin, &search_waiting, &contact};
  return kSteps;
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(solid_way_steps);

}  // namespace

const SolidWaySteps& solid_way_steps_in_lanes() { return CAROM_DISPATCH(solid_way_steps)(); }

}  // namespace carom
#endif  // HWY_ONCE
