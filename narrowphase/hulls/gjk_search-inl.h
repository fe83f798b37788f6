// The search of GJK in lanes itself. gjk.cc compiles it once an instruction set; kinds of which one
// has a number of corners that is known inline the search that only decides, which is shorter then.
#if defined(CAROM_NARROWPHASE_HULLS_GJK_SEARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_HULLS_GJK_SEARCH_INL_H_
#undef CAROM_NARROWPHASE_HULLS_GJK_SEARCH_INL_H_
#else
#define CAROM_NARROWPHASE_HULLS_GJK_SEARCH_INL_H_
#endif

#include "narrowphase/hulls/gjk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// The point of each lane that is furthest along `way`; of equals the first.
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

// The new corner takes the first place that is free.
HWY_INLINE void replace_corners(Mask is_open, I kept, const CornerLanes& next,
                                SimplexLanes& simplex) {
  const I above = hn::Add(kept, hn::Set(IntTag(), 1));
  const I taken = hn::IfThenElseZero(hn::RebindMask(IntTag(), is_open), hn::AndNot(kept, above));
  for (size_t i = 0; i < 3; ++i) {
    simplex.corner[i] = select(has_bit(taken, i), next, simplex.corner[i]);
  }
  simplex.used = select(is_open, hn::Or(kept, taken), simplex.used);
}

// One more corner.
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

template <bool kDecides>
HWY_INLINE void begin_search_inlined(const CoreLanes& a, const CoreLanes& b, const SearchGoal& goal,
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

template <bool kDecides>
HWY_INLINE void go_on_inlined(const CoreLanes& a, const CoreLanes& b, const SearchGoal& goal,
                              size_t few, GjkSearch& search) {
  while (hn::CountTrue(FloatTag(), search.is_open) > few) {
    run_round<kDecides, 3>(a, b, goal, search.gjk, search.is_open);
    search.rounds = hn::Add(search.rounds, splat(1));
    search.is_open =
        hn::And(search.is_open, hn::Lt(search.rounds, splat(static_cast<float>(kMostLaneRounds))));
  }
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_HULLS_GJK_SEARCH_INL_H_
