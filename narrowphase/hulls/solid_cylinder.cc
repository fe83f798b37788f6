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

constexpr float kFirstCorner = Solid::kMostFaces;  // numbers of faces, then of corners

void try_faces(const Solid& solid, const CylinderOfPair& cylinder, FaceHeights& heights,
               FirstOfMost& best) {
  const FloatTag tag;
  const F scale = splat(solid.scale);
  const F count = splat(static_cast<float>(solid.face_count));
  F index = lane_indices();
  for (size_t i = 0; i < solid.face_count; i += kLanes) {
    const F3 n = load3({solid.plane[0], solid.plane[1], solid.plane[2]}, i, splat(1));
    const F height = hn::Mul(hn::LoadU(tag, solid.plane[3] + i), scale);
    best.keep(hn::Lt(index, count), cylinder.gap_over(n, height), index);
    index = hn::Add(index, splat(kLanes));
    hn::Store(hn::Sub(dot(n, cylinder.middle), height), tag, heights.middle + i);
    hn::Store(dot(n, cylinder.axis), tag, heights.axis + i);
  }
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

SolidWay best_cap(const Solid& solid, const PlacedCylinder& cylinder) {
  float along, against;
  reach_along(solid, cylinder.axis, along, against);
  const float middle = scalar::dot(cylinder.axis, cylinder.middle);
  const float front = (middle - cylinder.half_length) - along;
  const float back = (-middle - cylinder.half_length) - against;
  const bool is_back = back > front;
  return {is_back ? back : front, cylinder.axis * (is_back ? -1.0f : 1.0f), SolidWay::Feature::cap};
}

// How far the solid reaches along each of the directions.
HWY_INLINE F reach_along(const Solid& solid, const F3& n) {
  const auto height = [&](size_t i) HWY_ATTR {
    return dot(n, F3{splat(solid.point[0][i]), splat(solid.point[1][i]), splat(solid.point[2][i])});
  };
  // Two chains; columns are padded to an even number.
  F even = height(0), odd = height(1);
  for (size_t i = 2; i < solid.point_count; i += 2) {
    even = max(even, height(i));
    odd = max(odd, height(i + 1));
  }
  return max(even, odd);
}

struct CornerWays {
  HWY_ALIGN float n[3][kMostLanePoints + kLanes];

  Vector3f operator[](size_t i) const { return {n[0][i], n[1][i], n[2][i]}; }
};

void try_corners(const Solid& solid, const CylinderOfPair& cylinder, CornerWays& ways,
                 FirstOfMost& best) {
  const FloatTag tag;
  const AxialCoreLanes core = {cylinder.axis, cylinder.half_length, cylinder.rim};
  const F scale = splat(solid.scale), count = splat(static_cast<float>(solid.point_count));
  F index = lane_indices();
  for (size_t i = 0; i < solid.point_count; i += kLanes) {
    const F3 n = way_from_corner(load3(solid.point, i, scale), cylinder.middle, core);
    // The scale is a power of two: it may go to the direction, once for all corners.
    const F gap = cylinder.gap_over(n, reach_along(solid, n * scale));
    best.keep(hn::Lt(index, count), gap, hn::Add(index, splat(kFirstCorner)));
    index = hn::Add(index, splat(kLanes));
    hn::Store(n.x, tag, ways.n[0] + i);
    hn::Store(n.y, tag, ways.n[1] + i);
    hn::Store(n.z, tag, ways.n[2] + i);
  }
}

// The best way of faces, caps and corners; of equals that of the first kind.
SolidWay best_way(const Solid& solid, const PlacedCylinder& placed, const CylinderOfPair& cylinder,
                  FaceHeights& heights) {
  using Feature = SolidWay::Feature;
  FirstOfMost best = FirstOfMost::none();
  CornerWays corner_ways;
  try_faces(solid, cylinder, heights, best);
  try_corners(solid, cylinder, corner_ways, best);
  const SolidWay cap = best_cap(solid, placed);
  const float gap = best.value();
  const size_t place = best.first();
  const bool is_face = place < Solid::kMostFaces;
  if (cap.gap > gap || (cap.gap == gap && !is_face)) return cap;
  if (is_face) return {gap, solid.normal(place), Feature::face, static_cast<uint32_t>(place)};
  const size_t corner = place - Solid::kMostFaces;
  return {gap, corner_ways[corner], Feature::corner, static_cast<uint32_t>(corner)};
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

float height_along(const Solid& solid, const Vector3f& n) {
  const F scale = splat(solid.scale);
  const F3 way = in_all_lanes(n);
  F most = splat(-FLT_MAX);
  for (size_t i = 0; i < solid.point_count; i += kLanes) {
    most = max(most, dot(way, load3(solid.point, i, scale)));
  }
  return hn::GetLane(hn::MaxOfLanes(FloatTag(), most));
}

void find_contact(SolidCylinderPair& pair) {
  const Solid& solid = *pair.solid;
  const Vector3f n = scalar::direction_of(solid, pair.way);
  const auto is_in_solid = [&](const Vector3f& p, float most) { return is_within(solid, p, most); };
  const auto furthest = [&] { return furthest_corner(solid, n); };
  pair.contact = scalar::contact_at(solid, pair.cylinder, pair.way, n, height_along(solid, n),
                                    pair.is_blunt, furthest, is_in_solid);
}

void wait(const SolidCylinderPair& pair, size_t place, const FaceHeights& heights,
          const CylinderOfPair& cylinder, WaitingEdges& waiting) {
  waiting.solid[place] = pair.solid;
  waiting.scale[place] = pair.solid->scale;
  const auto& [middle, axis, half_length, rim] = pair.cylinder;
  const float numbers[] = {axis.x(),   axis.y(),   axis.z(),    middle.x(),
                           middle.y(), middle.z(), half_length, rim};
  for (size_t i = 0; i < 8; ++i) waiting.cylinder[i][place] = numbers[i];
  leave_edges(*pair.solid, heights, cylinder, static_cast<uint32_t>(place), pair.way.gap, waiting);
}

void find_solid_contacts(SolidCylinderPair* pairs, size_t count) {
  WaitingEdges waiting;
  for (size_t i = 0; i < count; ++i) {
    SolidCylinderPair& pair = pairs[i];
    if (waiting.count + 2 * pair.solid->edge_count > WaitingEdges::kMost) {
      search_waiting(pairs, i, waiting);
    }
    const CylinderOfPair cylinder(pair.cylinder);
    FaceHeights heights;
    pair.way = best_way(*pair.solid, pair.cylinder, cylinder, heights);
    pair.is_found = false;
    if (scalar::may_prove(*pair.solid, pair.cylinder, pair.way)) {
      find_contact(pair);
      pair.is_found = pair.contact.is_sure;
    }
    if (!pair.is_found) wait(pair, i, heights, cylinder, waiting);
  }
  search_waiting(pairs, count, waiting);
  for (size_t i = 0; i < count; ++i) {
    if (!pairs[i].is_found) find_contact(pairs[i]);
  }
}

FindSolidContacts solid_contacts() { return &find_solid_contacts; }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(solid_contacts);

}  // namespace

FindSolidContacts find_solid_contacts_in_lanes() { return CAROM_DISPATCH(solid_contacts)(); }

}  // namespace carom
#endif  // HWY_ONCE
