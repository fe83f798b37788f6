// The widest gaps between solids and cylinders, a feature a lane (solid_cylinder_scalar.h is the
// scalar form, says how the search goes, and gives the same bits).
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/hulls/solid_cylinder.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <array>

#include "narrowphase/features/solid_contact-inl.h"
#include "narrowphase/hulls/hull_edges-inl.h"
#include "narrowphase/hulls/shell_corners-inl.h"
#include "narrowphase/hulls/solid_cylinder.h"
#include "simd/compress-inl.h"
#include "simd/first_of_most-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

using scalar::PlacedCylinder;
using scalar::SolidWay;

HWY_INLINE F3 load3(const std::array<const float*, 3>& column, size_t i, F scale) {
  const FloatTag tag;
  const F3 v = {hn::LoadU(tag, column[0] + i), hn::LoadU(tag, column[1] + i),
                hn::LoadU(tag, column[2] + i)};
  return v * scale;
}

// One cylinder in all lanes, or one a lane.
struct CylinderOfPair {
  F3 middle, axis;
  F half_length, rim;

  CylinderOfPair() = default;
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

// Four floats a lane, at record(lane).
template <class Record>
struct RecordsOf {
  const Record& record;

#if HWY_TARGET != HWY_SCALAR
  HWY_INLINE hn::Vec<Quad> quad(size_t lane) const {
    return hn::LoadU(Quad(), record(lane)->data());
  }
#endif
  HWY_INLINE float component(size_t lane, size_t c) const { return (*record(lane))[c]; }
};

struct EdgeLanes {
  F3 left, right, d, way;

  // Loads the edges from `first` on. The last lanes may hold any edge.
  static HWY_INLINE EdgeLanes load(const Solid& solid, const CylinderOfPair& cylinder,
                                   size_t first) {
    EdgeLanes arc;
    const F3 from = load_ends(solid, first, arc);
    arc.d = unit(cross(arc.left, arc.right));
    arc.way = cylinder.middle - from * splat(solid.scale);
    return arc;
  }

  // Calls use(column, lanes) for all but d.
  template <class Use>
  HWY_INLINE void for_each_column(const Use& use) {
    const auto use3 = [&](size_t column, F3& v) HWY_ATTR {
      use(column, v.x);
      use(column + 1, v.y);
      use(column + 2, v.z);
    };
    use3(0, left);
    use3(3, right);
    use3(6, way);
  }

  HWY_INLINE Mask holds(const F3& n) const {
    const F zero = splat(0);
    return hn::And(hn::Gt(dot(cross(left, n), d), zero), hn::Gt(dot(cross(n, right), d), zero));
  }

 private:
  // Sets the normals and returns the first points. In narrow vectors they come from records.
  static HWY_INLINE F3 load_ends(const Solid& solid, size_t first, EdgeLanes& arc) {
    if constexpr (kLanes == WaitingArcs::kPairs) {
      arc.left = points_at(solid.normals(), solid.side[0] + first);
      arc.right = points_at(solid.normals(), solid.side[1] + first);
      return points_at(solid.points(), solid.end[0] + first);
    } else {
      std::array<size_t, kLanes> edge;
      for (size_t lane = 0; lane < kLanes; ++lane) {
        edge[lane] = std::min(first + lane, solid.edge_count - 1);
      }
      const auto read = [&](const auto* records, const uint8_t* numbers, F3& v) HWY_ATTR {
        const auto record = [&](size_t lane) { return records + numbers[edge[lane]]; };
        F unused;
        transpose_records(RecordsOf<decltype(record)>{record}, v, unused);
      };
      F3 from;
      read(solid.plane_record, solid.side[0], arc.left);
      read(solid.plane_record, solid.side[1], arc.right);
      read(solid.point_record, solid.end[0], from);
      return from;
    }
  }
};

// An upper bound of the gap on the arcs; `gap`: that at their middles.
HWY_INLINE F bound_on_arcs(const EdgeLanes& arc, const CylinderOfPair& cylinder, F& gap) {
  const F zero = splat(0);
  const F3 n = unit(arc.left + arc.right);
  const F along = dot(n, cylinder.axis);
  const F3 across = n - cylinder.axis * along;
  const F over = hn::Div(splat(1), max(hn::Sqrt(dot(across, across)), splat(kLeastRim)));
  const F3 slope = (arc.way - cylinder.axis * hn::CopySign(cylinder.half_length, along)) -
                   across * hn::Mul(cylinder.rim, over);
  gap = dot(slope, n);
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

// The best way of each of a vector of edges.
struct FoundOnEdges {
  F gap;
  F3 n;
  Mask is_crossing, has_ended;

  HWY_INLINE void keep_if_wider(F wide, const F3& way, Mask ended) {
    const Mask wider = hn::Gt(rank(wide, ended), rank(gap, has_ended));
    gap = hn::IfThenElse(wider, wide, gap);
    n = select(wider, way, n);
    is_crossing = hn::AndNot(wider, is_crossing);
    has_ended = hn::Or(hn::And(wider, ended), hn::AndNot(wider, has_ended));
  }

 private:
  static HWY_INLINE F rank(F gap, Mask has_ended) {
    return hn::Sub(gap, hn::IfThenZeroElse(has_ended, splat(kNotEnded)));
  }
};

HWY_INLINE void search_side(const EdgeLanes& arc, const F3& middle, const CylinderOfPair& cylinder,
                            float sign, FoundOnEdges& found) {
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
  found.keep_if_wider(gap, n, has_ended);
}

HWY_INLINE FoundOnEdges search_across(const EdgeLanes& arc, const CylinderOfPair& cylinder) {
  const F3 n = unit(cross(arc.d, cylinder.axis));
  const F3 out = select(hn::Lt(dot(cross(arc.left, n), arc.d), splat(0)), -n, n);
  const Mask is_there = arc.holds(out);
  const F gap = hn::IfThenElse(is_there, cylinder.gap_over_line(out, arc.way), splat(-FLT_MAX));
  return {gap, out, is_there, hn::Not(no_lanes())};
}

// The cylinders of the pairs with these numbers.
HWY_INLINE CylinderOfPair cylinders_at(const WaitingArcs& waiting, const uint8_t* pairs) {
  const FloatTag tag;
  const IntTag integers;
  const I pair = hn::PromoteTo(integers, hn::LoadU(hn::Rebind<uint8_t, IntTag>(), pairs));
  const auto place =
      hn::IndicesFromVec(tag, hn::And(pair, hn::Set(integers, static_cast<int32_t>(kLanes) - 1)));
  const auto column = [&](size_t i) HWY_ATTR {
    return hn::TableLookupLanes(hn::LoadU(tag, waiting.cylinder[i].data()), place);
  };
  CylinderOfPair cylinder;
  cylinder.axis = {column(0), column(1), column(2)};
  cylinder.middle = {column(3), column(4), column(5)};
  cylinder.half_length = column(6);
  cylinder.rim = column(7);
  return cylinder;
}

void keep_found(const FoundOnEdges& found, const WaitingArcs& waiting, size_t first,
                SolidWay* ways) {
  const FloatTag tag;
  HWY_ALIGN float number[6][kLanes];
  hn::Store(found.gap, tag, number[0]);
  hn::Store(found.n.x, tag, number[1]);
  hn::Store(found.n.y, tag, number[2]);
  hn::Store(found.n.z, tag, number[3]);
  hn::Store(hn::IfThenElseZero(found.is_crossing, splat(1)), tag, number[4]);
  hn::Store(hn::IfThenElseZero(found.has_ended, splat(1)), tag, number[5]);
  for (size_t lane = 0; lane < std::min(kLanes, waiting.count - first); ++lane) {
    ways[waiting.pair[first + lane]].keep_if_wider(
        {number[0][lane],
         {number[1][lane], number[2][lane], number[3][lane]},
         number[4][lane] != 0 ? SolidWay::Feature::crossing : SolidWay::Feature::edge,
         waiting.edge[first + lane],
         number[5][lane] != 0});
  }
}

void finish(SolidWay* ways, WaitingArcs& waiting) {
  const IndexTag bits;
  for (size_t first = 0; first < waiting.count; first += kLanes) {
    EdgeLanes arc;
    arc.for_each_column([&](size_t column, F& v) HWY_ATTR {
      v = hn::BitCast(FloatTag(), hn::LoadU(bits, waiting.arc[column].data() + first));
    });
    arc.d = unit(cross(arc.left, arc.right));
    const CylinderOfPair cylinder = cylinders_at(waiting, waiting.pair.data() + first);
    const F3 middle = unit(arc.left + arc.right);
    FoundOnEdges found = search_across(arc, cylinder);
    search_side(arc, middle, cylinder, 1, found);
    search_side(arc, middle, cylinder, -1, found);
    keep_found(found, waiting, first, ways);
  }
  waiting.count = 0;
}

// Appends the edges on whose arcs the gap may exceed that of the pair's way so far, in order.
void leave_edges(const Solid& solid, const CylinderOfPair& cylinder, uint8_t pair, SolidWay* ways,
                 WaitingArcs& waiting) {
  const FloatTag tag;
  const IndexTag bits;
  constexpr size_t kRoom = Solid::kMostEdges + kLanes;
  HWY_ALIGN float bounds[kRoom];
  HWY_ALIGN float arcs[9][kRoom];
  F most = splat(ways[pair].gap);
  for (size_t first = 0; first < solid.edge_count; first += kLanes) {
    EdgeLanes arc = EdgeLanes::load(solid, cylinder, first);
    F gap;
    const F bound = bound_on_arcs(arc, cylinder, gap);
    const Mask exists = hn::FirstN(tag, solid.edge_count - first);
    most = hn::IfThenElse(exists, max(most, hn::Sub(gap, splat(kNotEnded))), most);
    hn::Store(bound, tag, bounds + first);
    arc.for_each_column([&](size_t column, F& v)
                            HWY_ATTR { hn::Store(v, tag, arcs[column] + first); });
  }
  most = hn::MaxOfLanes(tag, most);
  for (size_t first = 0; first < solid.edge_count; first += kLanes) {
    const Mask exists = hn::FirstN(tag, solid.edge_count - first);
    const Mask is_open = hn::And(exists, hn::Gt(hn::Load(tag, bounds + first), most));
    if (hn::AllFalse(tag, is_open)) continue;
    if (waiting.count + kLanes > WaitingArcs::kMost) finish(ways, waiting);
    const size_t at = waiting.count;
    for (size_t column = 0; column < 9; ++column) {
      const Indices v = hn::BitCast(bits, hn::Load(tag, arcs[column] + first));
      compress_store(v, is_open, waiting.arc[column].data() + at);
    }
    const Indices edges = hn::Iota(bits, static_cast<uint32_t>(first));
    waiting.count += compress_store(edges, is_open, waiting.edge.data() + at);
    std::fill(waiting.pair.data() + at, waiting.pair.data() + waiting.count, pair);
  }
}

void begin(const Solid& solid, const PlacedCylinder& placed, uint8_t pair, SolidWay* ways,
           WaitingArcs& waiting) {
  const CylinderOfPair cylinder(placed);
  SolidWay best;
  best.keep_if_wider(best_face(solid, cylinder));
  keep_caps(solid, placed, best);
  best.keep_if_wider(best_corner(solid, placed, cylinder));
  ways[pair] = best;
  const float numbers[] = {placed.axis.x(),    placed.axis.y(),   placed.axis.z(),
                           placed.middle.x(),  placed.middle.y(), placed.middle.z(),
                           placed.half_length, placed.rim};
  for (size_t i = 0; i < 8; ++i) waiting.cylinder[i][pair] = numbers[i];
  leave_edges(solid, cylinder, pair, ways, waiting);
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
  reach_along(solid, way.n, along, against);
  const auto is_in_solid = [&](const Vector3f& p, float most) { return is_within(solid, p, most); };
  const auto furthest = [&] { return furthest_corner(solid, way.n); };
  return scalar::contact_at(solid, cylinder, way, along, is_blunt, furthest, is_in_solid);
}

const SolidWaySteps& solid_way_steps() {
  static constexpr SolidWaySteps kSteps = {&begin, &finish, &contact};
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
