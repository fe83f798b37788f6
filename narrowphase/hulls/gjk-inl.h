// GJK in lanes, in float32 and scaled units: each lane has a simplex of its own (gjk_ref.h says
// what is found, and when it is sure).
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
  F squared;          // of its length
  SimplexLanes ends;  // the corners that span it
  CornerLanes last;   // with three of those: around zero, if that is asked for
  Mask is_apart;      // surely, by more than the radius; found by whoever asks for no more
  F gap;              // there: of the projections on the way, times its length
  Mask is_around;     // zero is surely inside of B - A
  Mask has_ended;     // at the shortest way
};

struct SearchGoal {
  F sure_squared;   // who only decides: of a gap that surely parts
  bool keeps_last;  // who measures: of the corners around zero
};

// `radius`: of both together. `keeps_last`: the corners around zero.
HWY_INLINE SearchGoal goal_at(F radius, bool keeps_last) {
  const F sure = hn::Add(radius, splat(kSureGap));
  return {hn::Mul(sure, sure), keeps_last};
}

// A search, and how far it is.
struct GjkSearch {
  GjkLanes gjk;
  Mask is_open;
  F rounds;  // so far
};

// These are compiled once an instruction set, in gjk.cc: every kind with a hull calls them.
//
// The first two rounds. `kDecides`: only which lanes are separate is wanted; otherwise the search
// measures.
template <bool kDecides>
void begin_search(const CoreLanes& a, const CoreLanes& b, const SearchGoal& goal,
                  GjkSearch& search);

// Until no more than `few` lanes are open.
template <bool kDecides>
void go_on(const CoreLanes& a, const CoreLanes& b, const SearchGoal& goal, size_t few,
           GjkSearch& search);

// Where the cores are nearest to each other, by the corners that a search ended with.
void nearest_cores(const CoreLanes& a, const CoreLanes& b, const FrontCorners& ends,
                   NearestCores& nearest);

// use(column, lanes) of the numbers that a search goes on with.
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
inline constexpr size_t kUsedCorners = 23;  // the column of bits beside those
static_assert(kUsedCorners + 1 == OpenSearches::kColumns);

// The lanes of `row` and those behind it that go on later.
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
