// GJK in lanes, compiled once an instruction set: the kinds that search call it a vector at a time,
// so that the call costs nothing that counts.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/hulls/gjk.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/hulls/gjk_search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
void begin_search(const CoreLanes& a, const CoreLanes& b, const SearchGoal& goal,
                  GjkSearch& search) {
  begin_search_inlined<false>(a, b, goal, search);
}

void go_on(const CoreLanes& a, const CoreLanes& b, const SearchGoal& goal, size_t few,
           GjkSearch& search) {
  go_on_inlined<false>(a, b, goal, few, search);
}

void nearest_cores(const CoreLanes& a, const CoreLanes& b, const FrontCorners& ends,
                   NearestCores& nearest) {
  const SpannedWay way(ends.p, ends.q, ends.r, ends.has_two, ends.has_three);
  nearest = way.confirmed_by(count_facing(a, way.normal(), way.height_of_a()),
                             count_facing(b, -way.normal(), way.height_of_b()));
}

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
