// The widest gap between a solid and a cylinder, a feature a lane (solid_cylinder_scalar.h is the
// scalar form, says how the search goes, and gives the same bits).
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/hulls/solid_cylinder.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <array>

#include "narrowphase/hulls/hull_edges-inl.h"
#include "narrowphase/hulls/solid_cylinder.h"
#include "simd/compress-inl.h"
#include "simd/first_of_most-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

using scalar::PlacedCylinder;
using scalar::SolidWay;

HWY_INLINE F3 unit(const F3& v) {
  return v * hn::Div(splat(1), hn::Sqrt(max(dot(v, v), splat(kLeastWay))));
}

HWY_INLINE F3 load3(const std::array<const float*, 3>& column, size_t i, F scale) {
  const FloatTag tag;
  const F3 v = {hn::LoadU(tag, column[0] + i), hn::LoadU(tag, column[1] + i),
                hn::LoadU(tag, column[2] + i)};
  return v * scale;
}

// The cylinder in all lanes.
struct CylinderOfPair {
  F3 middle, axis;
  F half_length, rim;

  explicit HWY_INLINE CylinderOfPair(const PlacedCylinder& c)
      : middle(in_all_lanes(c.middle)),
        axis(in_all_lanes(c.axis)),
        half_length(splat(c.half_length)),
        rim(splat(c.rim)) {}

  HWY_INLINE F gap_over(const F3& n, F height) const {
    const F3 across = cross(n, axis);
    const F reach = hn::Add(hn::Mul(half_length, hn::Abs(dot(n, axis))),
                            hn::Mul(rim, hn::Sqrt(dot(across, across))));
    return hn::Sub(hn::Sub(dot(n, middle), reach), height);
  }
  // Over the line of an edge; `way` leads from it to the middle.
  HWY_INLINE F gap_over_line(const F3& n, const F3& way) const {
    return gap_over(n, hn::Sub(dot(n, middle), dot(n, way)));
  }
};

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

HWY_INLINE F3 way_from_corner(const F3& corner, const CylinderOfPair& cylinder) {
  const F zero = splat(0), one = splat(1);
  const F3 p = corner - cylinder.middle;
  const F along = dot(p, cylinder.axis);
  const F3 across = p - cylinder.axis * along;
  const F from_axis = hn::Sqrt(dot(across, across));
  const F above = hn::Sub(hn::Abs(along), cylinder.half_length);
  const F beside = hn::Sub(from_axis, cylinder.rim);
  const Mask is_at_rim = hn::Gt(min(above, beside), zero);
  const F share = hn::IfThenElse(is_at_rim, hn::Div(beside, max(from_axis, splat(kLeastRim))), one);
  const F rise = hn::IfThenElseZero(is_at_rim, hn::CopySign(above, along));
  return -unit(across * share + cylinder.axis * rise);
}

SolidWay best_corner(const Solid& solid, const PlacedCylinder& placed,
                     const CylinderOfPair& cylinder) {
  const F scale = splat(solid.scale), count = splat(static_cast<float>(solid.point_count));
  FirstOfMost best = FirstOfMost::none();
  F index = lane_indices();
  for (size_t i = 0; i < solid.point_count; i += kLanes) {
    const F3 n = way_from_corner(load3(solid.point, i, scale), cylinder);
    F height = splat(-FLT_MAX);
    for (size_t k = 0; k < solid.point_count; ++k) {
      height = max(height, dot(n, in_all_lanes(solid.corner(k))));
    }
    best.keep(hn::Lt(index, count), cylinder.gap_over(n, height), index);
    index = hn::Add(index, splat(kLanes));
  }
  const size_t place = best.first();
  return {best.value(), scalar::way_from_corner(solid.corner(place), placed),
          SolidWay::Feature::corner, static_cast<uint32_t>(place)};
}

// The edges of one vector. The last lanes may repeat an edge.
struct EdgeLanes {
  F3 left, right, d, way;

  template <class EdgeAt>
  HWY_INLINE EdgeLanes(const Solid& solid, const CylinderOfPair& cylinder, const EdgeAt& edge_at) {
    HWY_ALIGN float column[9][kLanes];
    for (size_t lane = 0; lane < kLanes; ++lane) {
      const size_t e = edge_at(lane);
      const float* const faces[2] = {solid.plane_record[solid.side[0][e]].data(),
                                     solid.plane_record[solid.side[1][e]].data()};
      const float* const point = solid.point_record[solid.edges[e].from].data();
      for (size_t c = 0; c < 3; ++c) {
        column[c][lane] = faces[0][c];
        column[3 + c][lane] = faces[1][c];
        column[6 + c][lane] = point[c];
      }
    }
    const FloatTag tag;
    left = {hn::Load(tag, column[0]), hn::Load(tag, column[1]), hn::Load(tag, column[2])};
    right = {hn::Load(tag, column[3]), hn::Load(tag, column[4]), hn::Load(tag, column[5])};
    const F3 from = {hn::Load(tag, column[6]), hn::Load(tag, column[7]), hn::Load(tag, column[8])};
    d = unit(cross(left, right));
    way = cylinder.middle - from * splat(solid.scale);
  }

  HWY_INLINE Mask holds(const F3& n) const {
    const F zero = splat(0);
    return hn::And(hn::Gt(dot(cross(left, n), d), zero), hn::Gt(dot(cross(n, right), d), zero));
  }
};

// An upper bound of the gap on the arcs; `n`: their middles.
HWY_INLINE F bound_on_arcs(const EdgeLanes& arc, const CylinderOfPair& cylinder, F3& n) {
  const F zero = splat(0);
  n = unit(arc.left + arc.right);
  const F along = dot(n, cylinder.axis);
  const F3 across = n - cylinder.axis * along;
  const F over = hn::Div(splat(1), max(hn::Sqrt(dot(across, across)), splat(kLeastRim)));
  const F3 slope = (arc.way - cylinder.axis * hn::CopySign(cylinder.half_length, along)) -
                   across * hn::Mul(cylinder.rim, over);
  const F at_left = dot(slope, arc.left), at_right = dot(slope, arc.right);
  const F from_left = dot(slope, cross(arc.d, arc.left));
  const F from_right = dot(slope, cross(arc.d, arc.right));
  const Mask has_peak = hn::And(hn::Gt(from_left, zero), hn::Lt(from_right, zero));
  const F peak = hn::Sqrt(hn::Add(hn::Mul(at_left, at_left), hn::Mul(from_left, from_left)));
  return hn::IfThenElse(has_peak, peak, max(at_left, at_right));
}

HWY_INLINE Mask step_on_arc(const EdgeLanes& arc, const F3& way, const CylinderOfPair& cylinder,
                            F3& n) {
  const F zero = splat(0);
  const F3 s = cross(arc.d, n), across = cross(n, cylinder.axis);
  const F x = dot(n, cylinder.axis), y = dot(s, cylinder.axis);
  const F off = max(hn::Sqrt(dot(across, across)), splat(kLeastRim));
  const F over = hn::Div(splat(1), off);
  const F tilt = hn::Mul(hn::Mul(x, y), over);
  const F slope = hn::Add(dot(s, way), hn::Mul(cylinder.rim, tilt));
  const F bend = hn::Add(hn::Sub(hn::Mul(y, y), hn::Mul(x, x)), hn::Mul(tilt, tilt));
  const F curve = hn::Sub(hn::Mul(hn::Mul(cylinder.rim, over), bend), dot(n, way));
  const F step = hn::IfThenElse(hn::Lt(curve, zero), hn::Div(hn::Neg(slope), curve),
                                hn::CopySign(splat(kShortArc), slope));
  const F most = min(splat(kLongTurn), hn::Mul(splat(kRimStep), off));
  const F turn = clamp(step, hn::Neg(most), most);
  F3 next = unit(n + s * turn);
  next = select(hn::Lt(dot(cross(arc.left, next), arc.d), zero), arc.left, next);
  next = select(hn::Lt(dot(cross(next, arc.right), arc.d), zero), arc.right, next);
  const F moved = dot(cross(n, next), arc.d);
  n = next;
  return hn::Le(hn::Abs(moved), splat(kLastArc));
}

// Directions to start from on the side of one cap.
struct StartLanes {
  const EdgeLanes& arc;
  const CylinderOfPair& cylinder;
  F sign;
  F gap = splat(-FLT_MAX);
  F3 n = {splat(0), splat(0), splat(1)};

  HWY_INLINE void keep_if_wider(Mask may, const F3& m) {
    const F wide = cylinder.gap_over_line(m, arc.way);
    const Mask is_there = hn::Ge(hn::Mul(dot(m, cylinder.axis), sign), splat(0));
    const Mask wider = hn::And(may, hn::And(is_there, hn::Gt(wide, gap)));
    gap = hn::IfThenElse(wider, wide, gap);
    n = select(wider, m, n);
  }
};

// What the searches of a vector of edges find: across, then on the side of either cap.
struct FoundOnEdges {
  HWY_ALIGN float gap[3][kLanes];
  HWY_ALIGN float n[3][3][kLanes];
  HWY_ALIGN float has_ended[3][kLanes];

  HWY_INLINE void put(size_t which, F wide, const F3& way, Mask ended) {
    const FloatTag tag;
    hn::Store(wide, tag, gap[which]);
    hn::Store(way.x, tag, n[which][0]);
    hn::Store(way.y, tag, n[which][1]);
    hn::Store(way.z, tag, n[which][2]);
    hn::Store(hn::IfThenElseZero(ended, splat(1)), tag, has_ended[which]);
  }
  HWY_INLINE SolidWay way(size_t which, size_t lane, uint32_t e) const {
    return {gap[which][lane],
            {n[which][0][lane], n[which][1][lane], n[which][2][lane]},
            which == 0 ? SolidWay::Feature::crossing : SolidWay::Feature::edge,
            e,
            has_ended[which][lane] != 0};
  }
};

HWY_INLINE void search_side(const EdgeLanes& arc, const F3& middle, const CylinderOfPair& cylinder,
                            float sign, size_t which, FoundOnEdges& found) {
  const Mask all = hn::Not(no_lanes());
  StartLanes start{arc, cylinder, splat(sign)};
  const F3 axis = cylinder.axis;
  const F3 nearest = unit((axis - arc.d * dot(arc.d, axis)) * splat(sign));
  const F3 before = unit(arc.left + middle), behind = unit(middle + arc.right);
  start.keep_if_wider(all, middle);
  start.keep_if_wider(all, before);
  start.keep_if_wider(all, behind);
  start.keep_if_wider(all, unit(arc.left + before));
  start.keep_if_wider(all, unit(behind + arc.right));
  start.keep_if_wider(arc.holds(nearest), nearest);
  const Mask has_none = hn::Eq(start.gap, splat(-FLT_MAX));
  start.keep_if_wider(has_none, arc.left);
  start.keep_if_wider(has_none, arc.right);

  F3 n = start.n;
  const F3 way = arc.way - axis * hn::Mul(splat(sign), cylinder.half_length);
  Mask has_ended = no_lanes();
  for (size_t i = 0; i < kSolidArcSteps; ++i) has_ended = step_on_arc(arc, way, cylinder, n);
  const F gap = hn::IfThenElse(hn::Gt(start.gap, splat(-FLT_MAX)),
                               cylinder.gap_over_line(n, arc.way), splat(-FLT_MAX));
  found.put(which, gap, n, has_ended);
}

HWY_INLINE void search_across(const EdgeLanes& arc, const CylinderOfPair& cylinder,
                              FoundOnEdges& found) {
  const F3 n = unit(cross(arc.d, cylinder.axis));
  const F3 out = select(hn::Lt(dot(cross(arc.left, n), arc.d), splat(0)), -n, n);
  const F gap =
      hn::IfThenElse(arc.holds(out), cylinder.gap_over_line(out, arc.way), splat(-FLT_MAX));
  found.put(0, gap, out, hn::Not(no_lanes()));
}

// The edges on whose arcs the gap may exceed `most`, in order.
size_t find_open(const Solid& solid, const CylinderOfPair& cylinder, float most,
                 std::array<uint32_t, Solid::kMostEdges + kLanes>& open) {
  size_t count = 0;
  for (size_t first = 0; first < solid.edge_count; first += kLanes) {
    const size_t last = solid.edge_count - 1;
    const EdgeLanes arc(solid, cylinder, [&](size_t lane) { return std::min(first + lane, last); });
    F3 middle;
    const F bound = bound_on_arcs(arc, cylinder, middle);
    const Mask exists = hn::FirstN(FloatTag(), solid.edge_count - first);
    const Mask is_open = hn::And(exists, hn::Gt(bound, splat(most)));
    const Indices edges = hn::Iota(IndexTag(), static_cast<uint32_t>(first));
    count += compress_store(edges, is_open, open.data() + count);
  }
  return count;
}

void keep_edges(const Solid& solid, const CylinderOfPair& cylinder, SolidWay& best) {
  std::array<uint32_t, Solid::kMostEdges + kLanes> open;
  const size_t count = find_open(solid, cylinder, best.gap, open);
  for (size_t first = 0; first < count; first += kLanes) {
    const EdgeLanes arc(solid, cylinder, [&](size_t lane) {
      return size_t{open[std::min(first + lane, count - 1)]};
    });
    const F3 middle = unit(arc.left + arc.right);
    FoundOnEdges found;
    search_across(arc, cylinder, found);
    search_side(arc, middle, cylinder, 1, 1, found);
    search_side(arc, middle, cylinder, -1, 2, found);
    for (size_t lane = 0; lane < std::min(kLanes, count - first); ++lane) {
      for (size_t which = 0; which < 3; ++which) {
        best.keep_if_wider(found.way(which, lane, open[first + lane]));
      }
    }
  }
}

SolidWay find_solid_way(const Solid& solid, const PlacedCylinder& placed) {
  const CylinderOfPair cylinder(placed);
  SolidWay best;
  best.keep_if_wider(best_face(solid, cylinder));
  keep_caps(solid, placed, best);
  best.keep_if_wider(best_corner(solid, placed, cylinder));
  keep_edges(solid, cylinder, best);
  return best;
}

FindSolidWay find_way() { return &find_solid_way; }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(find_way);

}  // namespace

FindSolidWay find_solid_way_in_lanes() { return CAROM_DISPATCH(find_way)(); }

}  // namespace carom
#endif  // HWY_ONCE
