// GJK in lanes, in float32 and scaled units; each lane has its own simplex. gjk_scalar.h is the
// scalar form and says when a result is sure.
#if defined(CAROM_NARROWPHASE_HULLS_GJK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_HULLS_GJK_INL_H_
#undef CAROM_NARROWPHASE_HULLS_GJK_INL_H_
#else
#define CAROM_NARROWPHASE_HULLS_GJK_INL_H_
#endif

#include "base/tolerances.h"
#include "narrowphase/hulls/closest_feature-inl.h"
#include "narrowphase/hulls/core_lanes-inl.h"
#include "narrowphase/hulls/open_searches.h"
#include "narrowphase/hulls/simplex-inl.h"
#include "simd/compress-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

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

struct SearchGoal {
  F sure_squared;   // for the overlap test: square of a gap that surely separates
  bool keeps_last;  // for the distance search: also keep the fourth corner around zero
};

// `radius`: of both together. `keeps_last`: the corners around zero.
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

// Searches that measure are compiled once an instruction set, in gjk.cc: every kind with a hull
// calls them. Those that only decide are short, and kernels inline them (gjk_search-inl.h).
//
// The first two rounds.
void begin_search(const CoreLanes& a, const CoreLanes& b, const SearchGoal& goal,
                  GjkSearch& search);

// Runs rounds until no more than `few` lanes are open.
void go_on(const CoreLanes& a, const CoreLanes& b, const SearchGoal& goal, size_t few,
           GjkSearch& search);

// Where the cores are nearest to each other, by the corners that a search ended with.
void nearest_cores(const CoreLanes& a, const CoreLanes& b, const FrontCorners& ends,
                   NearestCores& nearest);

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
