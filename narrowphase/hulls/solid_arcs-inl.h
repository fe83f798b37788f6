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
#include <bit>

#include "narrowphase/features/edge_arc-inl.h"
#include "narrowphase/features/round_tolerances.h"
#include "narrowphase/features/solid_contact-inl.h"
#include "narrowphase/hulls/hull_edges-inl.h"
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

// Four floats a lane.
struct RecordLanes {
  std::array<const float*, kLanes> record;

#if HWY_TARGET != HWY_SCALAR
  HWY_INLINE hn::Vec<Quad> quad(size_t lane) const { return hn::LoadU(Quad(), record[lane]); }
#endif
  HWY_INLINE float component(size_t lane, size_t c) const { return record[lane][c]; }
  HWY_INLINE F3 first_three() const {
    F3 v;
    F unused;
    transpose_records(*this, v, unused);
    return v;
  }
};

// How far the middle of a cylinder lies in front of each face, and how far its axis leads there.
struct FaceHeights {
  HWY_ALIGN float middle[Solid::kMostFaces + kLanes];
  HWY_ALIGN float axis[Solid::kMostFaces + kLanes];
};

// The heights at some faces. Wide vectors look them up in registers.
struct HeightsOfFaces {
  F middle, axis;

  HWY_INLINE HeightsOfFaces(const FaceHeights& heights, size_t count, const uint8_t* faces) {
    if constexpr (kLanes >= 8) {
      const FloatTag tag;
      const IntTag integers;
      const I face = hn::PromoteTo(integers, hn::LoadU(hn::Rebind<uint8_t, IntTag>(), faces));
      const auto within = hn::And(face, hn::Set(integers, static_cast<int32_t>(kLanes) - 1));
      const auto place = hn::IndicesFromVec(tag, within);
      const auto look_up = [&](const float* table) HWY_ATTR {
        return hn::TableLookupLanes(hn::Load(tag, table), place);
      };
      middle = look_up(heights.middle);
      axis = look_up(heights.axis);
      for (size_t i = kLanes; i < count; i += kLanes) {
        const auto is_behind =
            hn::RebindMask(tag, hn::Gt(face, hn::Set(integers, static_cast<int32_t>(i) - 1)));
        middle = hn::IfThenElse(is_behind, look_up(heights.middle + i), middle);
        axis = hn::IfThenElse(is_behind, look_up(heights.axis + i), axis);
      }
    } else {
      middle = lanes_from([&](size_t lane) { return heights.middle[faces[lane]]; });
      axis = lanes_from([&](size_t lane) { return heights.axis[faces[lane]]; });
    }
  }
};

// The length of the slope in the plane of the arc, by its parts along both ends, where that is a
// direction of the arc, and otherwise `end`. Of a narrow arc rounding leaves no digits of it: then
// `most`.
HWY_INLINE F peak_of_arc(F left, F right, F cosine, F most, F end) {
  const F one = splat(1), two = splat(2);
  const F square = hn::Mul(cosine, cosine);
  const F c = hn::Sub(hn::Mul(two, square), one);
  const F sine = hn::Mul(hn::Mul(splat(4), square), hn::Sub(one, square));
  const F squares = hn::Add(hn::Mul(left, left), hn::Mul(right, right));
  const F product = hn::Mul(hn::Mul(two, c), hn::Mul(left, right));
  const F length = hn::Sqrt(hn::Div(hn::Sub(squares, product), sine));
  const Mask is_inside = hn::And(hn::Gt(hn::Sub(right, hn::Mul(c, left)), splat(0)),
                                 hn::Gt(hn::Sub(left, hn::Mul(c, right)), splat(0)));
  const Mask is_wide = hn::Le(cosine, splat(kWideArc));
  const F peak = hn::IfThenElse(is_inside, hn::Add(length, splat(kEdgeBoundSlack)), end);
  return hn::IfThenElse(is_wide, peak, most);
}

// Bounds the gaps over the edges from `first` on, as bound_edge() does.
struct EdgeBoundLanes {
  F at_middle, most;
  Mask is_in_front, is_behind;

  HWY_INLINE EdgeBoundLanes(const Solid& solid, const FaceHeights& faces,
                            const CylinderOfPair& cylinder, size_t first) {
    const F zero = splat(0), one = splat(1);
    const F slack = splat(kEdgeBoundSlack), least_cosine = splat(kEdgeBoundCosine);
    const HeightsOfFaces l(faces, solid.face_count, solid.side[0] + first);
    const HeightsOfFaces r(faces, solid.face_count, solid.side[1] + first);
    is_in_front = hn::Gt(max(l.axis, r.axis), zero);
    is_behind = hn::Or(hn::Lt(min(l.axis, r.axis), zero), hn::Not(is_in_front));
    const F cosine = hn::LoadU(FloatTag(), solid.half_cosine + first);
    const F over = hn::Div(one, max(cosine, least_cosine)), half = hn::Mul(splat(0.5f), over);
    const F x = hn::Mul(hn::Add(l.axis, r.axis), half);
    const F off = hn::Sub(one, hn::Mul(x, x));
    const Mask is_known = hn::And(hn::Ge(off, splat(kEdgeBoundSine)), hn::Ge(cosine, least_cosine));
    const F bend = hn::Div(cylinder.rim, hn::Sqrt(off));
    const F reach = hn::CopySign(cylinder.half_length, x);
    const auto slope = [&](const HeightsOfFaces& face) HWY_ATTR {
      return hn::Sub(hn::Sub(face.middle, hn::Mul(reach, face.axis)),
                     hn::Mul(hn::Sub(cosine, hn::Mul(x, face.axis)), bend));
    };
    const F left = slope(l), right = slope(r);
    const F sum = hn::Mul(hn::Add(left, right), half);
    at_middle = hn::IfThenElse(is_known, hn::Sub(sum, slack), splat(-FLT_MAX));
    const F end = hn::Add(max(left, right), slack);
    const F peak = peak_of_arc(left, right, cosine, hn::Mul(end, over), end);
    most = hn::IfThenElse(hn::Gt(end, zero), peak, end);
    most = hn::IfThenElse(is_known, most, splat(FLT_MAX));
  }
};

// Entries of a table of pairs, by the numbers of pairs.
HWY_INLINE F at_pairs(const float* table, Indices pairs) {
  const FloatTag tag;
  const I within =
      hn::And(hn::BitCast(IntTag(), pairs), hn::Set(IntTag(), static_cast<int32_t>(kLanes) - 1));
  return hn::TableLookupLanes(hn::LoadU(tag, table), hn::IndicesFromVec(tag, within));
}

// The arcs of the edges that wait from `first` on. Lanes behind the last one hold that again.
HWY_INLINE EdgeArcLanes load_arcs(const WaitingEdges& waiting, size_t first) {
  RecordLanes left_plane, right_plane, first_point, direction;
  for (size_t lane = 0; lane < kLanes; ++lane) {
    const size_t i = std::min(first + lane, waiting.count - 1);
    const Solid& solid = *waiting.solid[waiting.pair(i)];
    const size_t e = waiting.edge(i);
    left_plane.record[lane] = solid.plane_record[solid.side[0][e]].data();
    right_plane.record[lane] = solid.plane_record[solid.side[1][e]].data();
    first_point.record[lane] = solid.point_record[solid.end[0][e]].data();
    direction.record[lane] = solid.edges[e].direction.data();
  }
  const F3 left = left_plane.first_three(), right = right_plane.first_three();
  const F3 from = first_point.first_three(), along = direction.first_three();
  const Indices items = hn::LoadU(IndexTag(), waiting.item.data() + first);
  const Indices pair = hn::ShiftRight<WaitingEdges::kPairBits>(items);
  const auto of_cylinder = [&](size_t i)
                               HWY_ATTR { return at_pairs(waiting.cylinder[i].data(), pair); };
  const F3 axis = {of_cylinder(0), of_cylinder(1), of_cylinder(2)};
  const F3 middle = {of_cylinder(3), of_cylinder(4), of_cylinder(5)};
  const F3 across = cross(along, left);
  const F3 way = middle - from * at_pairs(waiting.scale.data(), pair);
  return {dot(way, left),    dot(way, across),
          dot(axis, along),  dot(axis, left),
          dot(axis, across), of_cylinder(6),
          of_cylinder(7),    {dot(right, left), dot(right, across)}};
}

HWY_INLINE std::array<ArcPlaceLanes, 5> places_on(const EdgeArcLanes& arc) {
  const F half_lanes = splat(0.5f);
  const auto half_of = [&](F cosine) HWY_ATTR {
    const F sum = hn::Add(half_lanes, hn::Mul(half_lanes, cosine));
    return hn::Sqrt(max(sum, splat(kLeastWay)));
  };
  const auto between = [](const ArcPlaceLanes& m, const ArcPlaceLanes& n, F over) HWY_ATTR {
    return ArcPlaceLanes{hn::Mul(hn::Add(m.u, n.u), over), hn::Mul(hn::Add(m.v, n.v), over)};
  };
  const F half = half_of(arc.end.u), quarter = half_of(half), eighth = half_of(quarter);
  const F of_half = hn::Div(half_lanes, half), of_quarter = hn::Div(half_lanes, quarter);
  const F of_eighth = hn::Div(half_lanes, eighth);
  const ArcPlaceLanes left = {splat(1), splat(0)}, middle = between(left, arc.end, of_half);
  const ArcPlaceLanes before = between(left, middle, of_quarter);
  const ArcPlaceLanes behind = between(middle, arc.end, of_quarter);
  return {middle, before, behind, between(left, before, of_eighth),
          between(behind, arc.end, of_eighth)};
}

// The search for the best way of each of a vector of edges, on the side of one cap each.
struct EdgeSearch {
  EdgeArcLanes arc;
  F sign;
  ArcFoundLanes found;

  HWY_INLINE EdgeSearch(const EdgeArcLanes& arcs, F signs) : arc(arcs), sign(signs) {
    const ArcStartsLanes starts(arc, places_on(arc));
    const Mask is_front = hn::Gt(sign, splat(0));
    found = {hn::IfThenElse(is_front, starts.front.gap, starts.back.gap),
             select(is_front, starts.front.n, starts.back.n), no_lanes()};
  }
  HWY_INLINE ArcClimb climb() { return {arc, sign, found}; }

  // Takes the way across the edge and a side if it is no worse. Returns where it has.
  HWY_INLINE Mask keep_crossing() {
    const F side = hn::CopySign(splat(1), arc.u_axis);
    const ArcPlaceLanes across =
        unit(ArcPlaceLanes{hn::Neg(hn::Mul(arc.v_axis, side)), hn::Mul(arc.u_axis, side)});
    const Mask exists = arc.holds(across);
    const F gap = hn::IfThenElse(exists, arc.gap(across), splat(-FLT_MAX));
    const Mask wider = hn::Gt(found.rank(), gap);
    found.gap = hn::IfThenElse(wider, found.gap, gap);
    found.n = select(wider, found.n, across);
    found.has_ended = hn::Or(found.has_ended, hn::Not(wider));
    return hn::AndNot(wider, exists);
  }
};

// Yields the ways that a search found, a lane at a time.
class EdgeWays {
 public:
  explicit HWY_INLINE EdgeWays(EdgeSearch& search) {
    const FloatTag tag;
    crossing_ = bits_of(tag, search.keep_crossing());
    hn::Store(search.found.gap, tag, gap_);
    hn::Store(search.found.n.u, tag, u_);
    hn::Store(search.found.n.v, tag, v_);
    ended_ = bits_of(tag, search.found.has_ended);
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

HWY_INLINE EdgeSearch search_from(const WaitingEdges& waiting, size_t first) {
  const Indices items = hn::LoadU(IndexTag(), waiting.item.data() + first);
  const F sign = hn::CopySign(splat(1), hn::BitCast(FloatTag(), items));
  return EdgeSearch(load_arcs(waiting, first), sign);
}

// Looks only at those that beat what their pair had before.
HWY_INLINE void keep_ways(EdgeSearch& search, const WaitingEdges& waiting, size_t first,
                          const float* ranks, SolidCylinderPair* pairs) {
  const EdgeWays found(search);
  const Indices items = hn::LoadU(IndexTag(), waiting.item.data() + first);
  const F before = at_pairs(ranks, hn::ShiftRight<WaitingEdges::kPairBits>(items));
  const Mask exists = hn::FirstN(FloatTag(), waiting.count - first);
  const Mask is_better = hn::And(exists, hn::Gt(search.found.rank(), before));
  for (uint64_t lanes = bits_of(FloatTag(), is_better); lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<size_t>(std::countr_zero(lanes));
    pairs[waiting.pair(first + lane)].way.keep_if_wider(
        found.way(lane, waiting.edge(first + lane)));
  }
}

// Searches all edges that wait, two vectors at a time.
inline void search_waiting(SolidCylinderPair* pairs, size_t pair_count, WaitingEdges& waiting) {
  HWY_ALIGN float ranks[WaitingEdges::kPairs];
  for (size_t i = 0; i < pair_count; ++i) ranks[i] = pairs[i].way.rank();
  for (size_t i = 0; i < waiting.count; i += 2 * kLanes) {
    const size_t next = i + kLanes < waiting.count ? i + kLanes : i;
    EdgeSearch one = search_from(waiting, i), other = search_from(waiting, next);
    climb_arcs(one.climb(), other.climb());
    keep_ways(one, waiting, i, ranks, pairs);
    if (next != i) keep_ways(other, waiting, next, ranks, pairs);
  }
  waiting.count = 0;
}

// Leaves the edges on whose arcs the gap may exceed `gap`, which is that of the pair's way so far.
inline void leave_edges(const Solid& solid, const FaceHeights& faces,
                        const CylinderOfPair& cylinder, uint32_t pair, float gap,
                        WaitingEdges& waiting) {
  const FloatTag tag;
  const IndexTag bits;
  HWY_ALIGN float bounds[2][Solid::kMostEdges + kLanes];
  F known = splat(gap);
  for (size_t i = 0; i < solid.edge_count; i += kLanes) {
    const EdgeBoundLanes bound(solid, faces, cylinder, i);
    const Mask exists = hn::FirstN(tag, solid.edge_count - i);
    known = hn::IfThenElse(exists, max(known, bound.at_middle), known);
    const F none = splat(-FLT_MAX), most = hn::IfThenElse(exists, bound.most, none);
    hn::Store(hn::IfThenElse(bound.is_in_front, most, none), tag, bounds[0] + i);
    hn::Store(hn::IfThenElse(bound.is_behind, most, none), tag, bounds[1] + i);
  }
  known = hn::MaxOfLanes(tag, known);
  for (const uint32_t side : {0u, 1u}) {
    Indices items = hn::Iota(bits, side << 31 | pair << WaitingEdges::kPairBits);
    for (size_t i = 0; i < solid.edge_count; i += kLanes) {
      const Mask is_open = hn::Gt(hn::Load(tag, bounds[side] + i), known);
      waiting.count += compress_store(items, is_open, waiting.item.data() + waiting.count);
      items = hn::Add(items, hn::Set(bits, uint32_t{kLanes}));
    }
  }
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_HULLS_SOLID_ARCS_INL_H_
