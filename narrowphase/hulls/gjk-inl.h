// GJK in lanes, in float32 and scaled units; each lane has its own simplex. gjk_scalar.h is the
// scalar form and says when a result is sure.
#if defined(CAROM_NARROWPHASE_HULLS_GJK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_HULLS_GJK_INL_H_
#undef CAROM_NARROWPHASE_HULLS_GJK_INL_H_
#else
#define CAROM_NARROWPHASE_HULLS_GJK_INL_H_
#endif

#include "base/tolerances.h"
#include "narrowphase/hulls/core_lanes-inl.h"
#include "narrowphase/hulls/open_searches.h"
#include "narrowphase/hulls/simplex-inl.h"
#include "simd/compress-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// The support point of each lane; the first of equals.
HWY_INLINE F3 furthest_point(const CoreLanes& core, const F3& way) {
  F3 best = core.point(0);
  F most = dot(way, best);
  for (size_t i = 1; i < core.count(); ++i) {
    const F3 p = core.point(i);
    const F height = dot(way, p);
    const Mask is_better = hn::Gt(height, most);
    most = max(most, height);
    best = select(is_better, p, best);
  }
  return best;
}

HWY_INLINE CornerLanes difference_corner(const CoreLanes& a, const CoreLanes& b, const F3& way) {
  const F3 on_a = furthest_point(a, way);
  return {furthest_point(b, -way) - on_a, on_a};
}

struct GjkLanes {
  F3 way;             // from A to B
  F squared;          // of the vector's length
  SimplexLanes ends;  // the corners that span `way`
  CornerLanes last;   // the fourth corner around zero, if goal.keeps_last
  Mask is_apart;      // surely separate by more than the radius; set by the overlap test only
  F gap;              // between the projections on `way`, times its length; overlap test only
  Mask is_around;     // zero is surely inside B - A
  Mask has_ended;     // the vector cannot become shorter
};

// The new corner takes the first free place.
HWY_INLINE void replace_corners(Mask is_open, I kept, const CornerLanes& next,
                                SimplexLanes& simplex) {
  const I above = hn::Add(kept, hn::Set(IntTag(), 1));
  const I taken = hn::IfThenElseZero(hn::RebindMask(IntTag(), is_open), hn::AndNot(kept, above));
  for (size_t i = 0; i < 3; ++i) {
    simplex.corner[i] = select(has_bit(taken, i), next, simplex.corner[i]);
  }
  simplex.used = select(is_open, hn::Or(kept, taken), simplex.used);
}

struct SearchGoal {
  F sure_squared;   // for the overlap test: square of a gap that surely separates
  bool keeps_last;  // for the distance search: also keep the fourth corner around zero
};

// One round of GJK: finds the next corner, and the nearest point of the new simplex.
template <bool kDecides, size_t kPlaces>
HWY_INLINE void run_round(const CoreLanes& a, const CoreLanes& b, const SearchGoal& goal,
                          GjkLanes& gjk, Mask& is_open) {
  const CornerLanes next = difference_corner(a, b, gjk.way);
  const F gap = dot(gjk.way, next.point);
  if constexpr (kDecides) {
    const Mask is_beyond = hn::And(
        hn::Gt(gap, splat(0)), hn::Gt(hn::Mul(gap, gap), hn::Mul(goal.sure_squared, gjk.squared)));
    gjk.is_apart = hn::Or(gjk.is_apart, hn::And(is_open, is_beyond));
    gjk.gap = hn::IfThenElse(is_open, gap, gjk.gap);
    is_open = hn::AndNot(is_beyond, is_open);
  }
  const Mask is_shortest =
      hn::Le(hn::Sub(gjk.squared, gap), hn::Mul(gjk.squared, splat(kLeastProgress)));
  const NearestSearch<kPlaces> search(gjk.ends, next.point);
  const NearestLanes& nearest = search.nearest();
  const Mask is_nearer = hn::Lt(nearest.squared, gjk.squared);
  const Mask is_sure_around = hn::And(is_open, nearest.is_sure_around);
  gjk.is_around = hn::Or(gjk.is_around, is_sure_around);
  if constexpr (!kDecides && kPlaces == 3) {
    if (goal.keeps_last) gjk.last = select(is_sure_around, next, gjk.last);
  }
  is_open = hn::AndNot(nearest.is_around, is_open);
  gjk.has_ended = hn::Or(gjk.has_ended, hn::And(is_open, hn::Or(is_shortest, hn::Not(is_nearer))));
  is_open = hn::AndNot(gjk.has_ended, is_open);
  gjk.way = select(is_open, nearest.point, gjk.way);
  gjk.squared = hn::IfThenElse(is_open, nearest.squared, gjk.squared);
  replace_corners(is_open, nearest.kept, next, gjk.ends);
  is_open = hn::And(is_open, hn::Gt(gjk.squared, splat(kNearCores * kNearCores)));
}

// `radius`: the sum of both radii.
HWY_INLINE SearchGoal goal_at(F radius, bool keeps_last) {
  const F sure = hn::Add(radius, splat(kSureGap));
  return {hn::Mul(sure, sure), keeps_last};
}

// The state of a search between rounds.
struct GjkSearch {
  GjkLanes gjk;
  Mask is_open;
  F rounds;  // so far
};

// Runs the first two rounds. kDecides: the search only asks which lanes are separate; otherwise it
// measures distances.
template <bool kDecides>
HWY_INLINE void begin_search(const CoreLanes& a, const CoreLanes& b, const SearchGoal& goal,
                             GjkSearch& search) {
  const CornerLanes first = difference_corner(a, b, b.middle - a.middle);
  GjkLanes& gjk = search.gjk;
  gjk.way = first.point;
  gjk.squared = dot(gjk.way, gjk.way);
  gjk.ends.corner = {first, first, first};
  gjk.last = first;
  gjk.ends.used = hn::Set(IntTag(), 0b001);
  gjk.is_apart = gjk.is_around = gjk.has_ended = no_lanes();
  gjk.gap = splat(0);
  search.is_open = hn::Gt(gjk.squared, splat(kNearCores * kNearCores));
  run_round<kDecides, 1>(a, b, goal, gjk, search.is_open);
  run_round<kDecides, 2>(a, b, goal, gjk, search.is_open);
  search.rounds = splat(2);
}

// Runs rounds until no more than `few` lanes are open.
template <bool kDecides>
HWY_INLINE void go_on(const CoreLanes& a, const CoreLanes& b, const SearchGoal& goal, size_t few,
                      GjkSearch& search) {
  while (hn::CountTrue(FloatTag(), search.is_open) > few) {
    run_round<kDecides, 3>(a, b, goal, search.gjk, search.is_open);
    search.rounds = hn::Add(search.rounds, splat(1));
    search.is_open =
        hn::And(search.is_open, hn::Lt(search.rounds, splat(static_cast<float>(kMostLaneRounds))));
  }
}

// Calls use(column, lanes) for every float column that the second stage needs.
template <class Search, class Use>
HWY_INLINE void for_each_column(Search& search, const Use& use) {
  const auto use3 = [&](size_t column, auto& v) HWY_ATTR {
    use(column, v.x);
    use(column + 1, v.y);
    use(column + 2, v.z);
  };
  use(0, search.rounds);
  use(1, search.gjk.squared);
  use3(2, search.gjk.way);
  for (size_t i = 0; i < 3; ++i) {
    auto& corner = search.gjk.ends.corner[i];
    use3(5 + 6 * i, corner.point);
    use3(8 + 6 * i, corner.on_a);
  }
}
inline constexpr size_t kUsedCorners = 23;  // the column of `used` bits, after the float columns
static_assert(kUsedCorners + 1 == OpenSearches::kColumns);

// Appends the lanes in `leaves` to `open`. `row` is the row of the first lane.
HWY_INLINE void leave(const GjkSearch& search, Mask leaves, size_t row, OpenSearches& open) {
  const IndexTag bits;
  for_each_column(search, [&](size_t column, const F& v) HWY_ATTR {
    compress_store(hn::BitCast(bits, v), leaves, open.column[column].data() + open.count);
  });
  compress_store(hn::BitCast(bits, search.gjk.ends.used), leaves,
                 open.column[kUsedCorners].data() + open.count);
  const Indices rows = hn::Iota(bits, static_cast<uint32_t>(row));
  open.count += compress_store(rows, leaves, open.row.data() + open.count);
}

HWY_INLINE void resume(const OpenSearches& open, size_t row, GjkSearch& search) {
  const IndexTag bits;
  for_each_column(search, [&](size_t column, F& v) HWY_ATTR {
    v = hn::BitCast(FloatTag(), hn::LoadU(bits, open.column[column].data() + row));
  });
  GjkLanes& gjk = search.gjk;
  gjk.ends.used = hn::BitCast(IntTag(), hn::LoadU(bits, open.column[kUsedCorners].data() + row));
  gjk.last = gjk.ends.corner[0];
  gjk.is_apart = gjk.is_around = gjk.has_ended = no_lanes();
  gjk.gap = splat(0);
  search.is_open = hn::Not(no_lanes());
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_HULLS_GJK_INL_H_
