// The edges of solids beside cylinders, an edge a lane: their bounds, which of them wait for a
// search, and the search itself. solid_cylinder_scalar.h is the scalar form.
#if defined(CAROM_NARROWPHASE_HULLS_SOLID_ARCS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_HULLS_SOLID_ARCS_INL_H_
#undef CAROM_NARROWPHASE_HULLS_SOLID_ARCS_INL_H_
#else
#define CAROM_NARROWPHASE_HULLS_SOLID_ARCS_INL_H_
#endif

#include <algorithm>
#include <array>

#include "narrowphase/features/edge_arc-inl.h"
#include "narrowphase/features/solid_contact-inl.h"
#include "narrowphase/hulls/hull_edges-inl.h"
#include "narrowphase/hulls/shell_corners-inl.h"
#include "narrowphase/hulls/solid_cylinder.h"
#include "simd/compress-inl.h"
#include "simd/first_of_most-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

using scalar::PlacedCylinder;
using scalar::SolidWay;

// One cylinder in all lanes.
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
};

HWY_INLINE F3 load3(const std::array<const float*, 3>& column, size_t i, F scale) {
  const FloatTag tag;
  const F3 v = {hn::LoadU(tag, column[0] + i), hn::LoadU(tag, column[1] + i),
                hn::LoadU(tag, column[2] + i)};
  return v * scale;
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

// Loads the normals of both faces of the edges from `first` on, and returns the points where they
// begin. The last lanes may hold any edge. In narrow vectors they come from records.
HWY_INLINE F3 load_edges(const Solid& solid, size_t first, F3& left, F3& right) {
  if constexpr (kLanes == WaitingArcs::kPairs) {
    left = points_at(solid.normals(), solid.side[0] + first);
    right = points_at(solid.normals(), solid.side[1] + first);
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
    read(solid.plane_record, solid.side[0], left);
    read(solid.plane_record, solid.side[1], right);
    read(solid.point_record, solid.end[0], from);
    return from;
  }
}

HWY_INLINE EdgeArcLanes load_arcs(const Solid& solid, const CylinderOfPair& cylinder,
                                  size_t first) {
  F3 left, right;
  const F3 from = load_edges(solid, first, left, right) * splat(solid.scale);
  const F3 along = unit(cross(left, right)), across = cross(along, left);
  const F3 way = cylinder.middle - from;
  return {dot(way, left),
          dot(way, across),
          dot(cylinder.axis, along),
          dot(cylinder.axis, left),
          dot(cylinder.axis, across),
          cylinder.half_length,
          cylinder.rim,
          {dot(right, left), dot(right, across)}};
}

// Calls use(column, lanes) for all that an edge has of its own.
template <class Use>
HWY_INLINE void for_each_column(EdgeArcLanes& arc, const Use& use) {
  use(0, arc.u_way);
  use(1, arc.v_way);
  use(2, arc.along);
  use(3, arc.u_axis);
  use(4, arc.v_axis);
  use(5, arc.end.u);
  use(6, arc.end.v);
}

HWY_INLINE ArcPlaceLanes middle_of(const EdgeArcLanes& arc) {
  return unit(ArcPlaceLanes{hn::Add(splat(1), arc.end.u), arc.end.v});
}

HWY_INLINE std::array<ArcPlaceLanes, 5> places_on(const EdgeArcLanes& arc) {
  const auto between = [](const ArcPlaceLanes& m, const ArcPlaceLanes& n) HWY_ATTR {
    return unit(ArcPlaceLanes{hn::Add(m.u, n.u), hn::Add(m.v, n.v)});
  };
  const ArcPlaceLanes left = {splat(1), splat(0)}, middle = middle_of(arc);
  const ArcPlaceLanes before = between(left, middle), behind = between(middle, arc.end);
  return {middle, before, behind, between(left, before), between(behind, arc.end)};
}

// The best way of each of a vector of edges.
struct EdgeWayLanes {
  ArcFoundLanes found;
  Mask is_crossing;

  explicit HWY_INLINE EdgeWayLanes(const EdgeArcLanes& arc) {
    const F sign = hn::CopySign(splat(1), arc.u_axis);
    const ArcPlaceLanes across =
        unit(ArcPlaceLanes{hn::Neg(hn::Mul(arc.v_axis, sign)), hn::Mul(arc.u_axis, sign)});
    is_crossing = arc.holds(across);
    const F gap = hn::IfThenElse(is_crossing, arc.gap(across), splat(-FLT_MAX));
    found = {gap, across, hn::Not(no_lanes())};
    ArcFoundLanes front, back;
    search_arc(arc, places_on(arc), front, back);
    keep_if_wider(front);
    keep_if_wider(back);
  }

 private:
  HWY_INLINE void keep_if_wider(const ArcFoundLanes& next) {
    const Mask wider = hn::Gt(next.rank(), found.rank());
    found.gap = hn::IfThenElse(wider, next.gap, found.gap);
    found.n = select(wider, next.n, found.n);
    found.has_ended = hn::Or(hn::And(wider, next.has_ended), hn::AndNot(wider, found.has_ended));
    is_crossing = hn::AndNot(wider, is_crossing);
  }
};

// Numbers of EdgeWayLanes, a lane at a time.
class EdgeWays {
 public:
  explicit HWY_INLINE EdgeWays(const EdgeWayLanes& way) {
    const FloatTag tag;
    hn::Store(way.found.gap, tag, gap_);
    hn::Store(way.found.n.u, tag, u_);
    hn::Store(way.found.n.v, tag, v_);
    crossing_ = bits_of(tag, way.is_crossing);
    ended_ = bits_of(tag, way.found.has_ended);
  }
  SolidWay way(size_t lane, uint32_t edge) const {
    using Feature = SolidWay::Feature;
    return {gap_[lane],
            {u_[lane], v_[lane], 0},
            crossing_ >> lane & 1 ? Feature::crossing : Feature::edge,
            edge,
            (ended_ >> lane & 1) != 0};
  }

 private:
  HWY_ALIGN float gap_[kLanes];
  HWY_ALIGN float u_[kLanes];
  HWY_ALIGN float v_[kLanes];
  uint64_t crossing_, ended_;
};

// Entries of a table of pairs, by the numbers of pairs.
HWY_INLINE F at_pairs(const float* table, Indices pairs) {
  const FloatTag tag;
  const I within =
      hn::And(hn::BitCast(IntTag(), pairs), hn::Set(IntTag(), static_cast<int32_t>(kLanes) - 1));
  return hn::TableLookupLanes(hn::LoadU(tag, table), hn::IndicesFromVec(tag, within));
}

HWY_INLINE void search_first(SolidWay* ways, const WaitingArcs& waiting) {
  const FloatTag tag;
  EdgeArcLanes arc;
  for_each_column(
      arc, [&](size_t column, F& v) HWY_ATTR { v = hn::LoadU(tag, waiting.first[column].data()); });
  arc.half_length = hn::LoadU(tag, waiting.half_length.data());
  arc.rim = hn::LoadU(tag, waiting.rim.data());
  const EdgeWays found{EdgeWayLanes(arc)};
  for (size_t pair = 0; pair < kLanes; ++pair) {
    if (!(waiting.has_first >> pair & 1)) continue;
    ways[pair].keep_if_wider(found.way(pair, waiting.first_edge[pair]));
  }
}

// Packs the edges whose bounds exceed what the best way of their pair has.
HWY_INLINE void drop_settled(const SolidWay* ways, WaitingArcs& waiting) {
  const IndexTag bits;
  HWY_ALIGN float rank[WaitingArcs::kPairs];
  for (size_t pair = 0; pair < kLanes; ++pair) rank[pair] = ways[pair].rank();
  size_t left = 0;
  for (size_t i = 0; i < waiting.rest_count; i += kLanes) {
    const F bound = hn::BitCast(FloatTag(), hn::LoadU(bits, waiting.bound.data() + i));
    const F least = at_pairs(rank, hn::LoadU(bits, waiting.pair.data() + i));
    const Mask exists = hn::FirstN(FloatTag(), waiting.rest_count - i);
    const Mask is_open = hn::And(exists, hn::Gt(bound, least));
    const auto pack = [&](WaitingArcs::Column& column) HWY_ATTR {
      const Indices v = hn::LoadU(bits, column.data() + i);
      return compress_store(v, is_open, column.data() + left);
    };
    for (WaitingArcs::Column& column : waiting.rest) pack(column);
    pack(waiting.edge);
    left += pack(waiting.pair);
  }
  waiting.rest_count = left;
}

// Searches all edges that wait.
inline void search_waiting(SolidWay* ways, WaitingArcs& waiting) {
  const IndexTag bits;
  if (waiting.has_first != 0) search_first(ways, waiting);
  drop_settled(ways, waiting);
  for (size_t i = 0; i < waiting.rest_count; i += kLanes) {
    EdgeArcLanes arc;
    for_each_column(arc, [&](size_t column, F& v) HWY_ATTR {
      v = hn::BitCast(FloatTag(), hn::LoadU(bits, waiting.rest[column].data() + i));
    });
    const Indices pairs = hn::LoadU(bits, waiting.pair.data() + i);
    arc.half_length = at_pairs(waiting.half_length.data(), pairs);
    arc.rim = at_pairs(waiting.rim.data(), pairs);
    const EdgeWays found{EdgeWayLanes(arc)};
    for (size_t lane = 0; lane < std::min(kLanes, waiting.rest_count - i); ++lane) {
      ways[waiting.pair[i + lane]].keep_if_wider(found.way(lane, waiting.edge[i + lane]));
    }
  }
  waiting.rest_count = 0;
  waiting.has_first = 0;
}

// Leaves the edges on whose arcs the gap may exceed that of the pair's way so far.
inline void leave_edges(const Solid& solid, const CylinderOfPair& cylinder, uint32_t pair,
                        const SolidWay& way, WaitingArcs& waiting) {
  const FloatTag tag;
  const IndexTag bits;
  constexpr size_t kRoom = Solid::kMostEdges + kLanes;
  HWY_ALIGN float bounds[kRoom];
  HWY_ALIGN float arcs[WaitingArcs::kArcColumns][kRoom];
  F known = splat(way.gap);
  const F count = splat(static_cast<float>(solid.edge_count));
  F index = lane_indices();
  FirstOfMost greatest = FirstOfMost::none();
  for (size_t i = 0; i < solid.edge_count; i += kLanes) {
    EdgeArcLanes arc = load_arcs(solid, cylinder, i);
    F gap;
    const F bound = bound_on_arc(arc, middle_of(arc), gap);
    const Mask exists = hn::Lt(index, count);
    known = hn::IfThenElse(exists, max(known, hn::Sub(gap, splat(kNotEnded))), known);
    greatest.keep(exists, bound, index);
    index = hn::Add(index, splat(kLanes));
    hn::Store(bound, tag, bounds + i);
    for_each_column(arc,
                    [&](size_t column, F& v) HWY_ATTR { hn::Store(v, tag, arcs[column] + i); });
  }
  const float most_known = hn::GetLane(hn::MaxOfLanes(tag, known));
  if (solid.edge_count == 0 || !(greatest.value() > most_known)) return;
  const size_t first = greatest.first();
  for (size_t column = 0; column < WaitingArcs::kArcColumns; ++column) {
    waiting.first[column][pair] = arcs[column][first];
  }
  waiting.first_edge[pair] = static_cast<uint32_t>(first);
  waiting.has_first |= 1u << pair;
  bounds[first] = -FLT_MAX;
  for (size_t i = 0; i < solid.edge_count; i += kLanes) {
    const F bound = hn::Load(tag, bounds + i);
    const Mask exists = hn::FirstN(tag, solid.edge_count - i);
    const Mask is_open = hn::And(exists, hn::Gt(bound, splat(most_known)));
    if (hn::AllFalse(tag, is_open)) continue;
    const auto put = [&](Indices v, WaitingArcs::Column& column) HWY_ATTR {
      return compress_store(v, is_open, column.data() + waiting.rest_count);
    };
    for (size_t column = 0; column < WaitingArcs::kArcColumns; ++column) {
      put(hn::BitCast(bits, hn::Load(tag, arcs[column] + i)), waiting.rest[column]);
    }
    put(hn::BitCast(bits, bound), waiting.bound);
    put(hn::Set(bits, pair), waiting.pair);
    waiting.rest_count += put(hn::Iota(bits, static_cast<uint32_t>(i)), waiting.edge);
  }
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_HULLS_SOLID_ARCS_INL_H_
