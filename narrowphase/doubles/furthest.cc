// Each lane keeps its best point; then the best of all lanes is the support point.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/doubles/furthest.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <hwy/highway.h>

#include <cmath>

#include "narrowphase/doubles/furthest.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, kCoreLanes>;
using Heights = hn::Vec<Tag>;

// The first point among the lanes with the greatest height.
HWY_INLINE size_t best_of(Heights most, Heights first) {
  const Tag tag;
  const auto is_best = hn::Eq(most, hn::MaxOfLanes(tag, most));
  const Heights candidates = hn::IfThenElse(is_best, first, hn::Set(tag, HUGE_VAL));
  return static_cast<size_t>(hn::GetLane(hn::MinOfLanes(tag, candidates)));
}

size_t furthest_in_lanes(const Core& core, const CoreVector& way) {
  const Tag tag;
  const Heights x = hn::Set(tag, way.x), y = hn::Set(tag, way.y), z = hn::Set(tag, way.z);
  Heights most = hn::Set(tag, -HUGE_VAL);
  // The indices are doubles, so that the same masks select them.
  Heights index = hn::Iota(tag, 0), first = index;
  const Heights step = hn::Set(tag, static_cast<double>(hn::MaxLanes(tag)));
  for (size_t i = 0; i < core.padded_size(); i += hn::MaxLanes(tag)) {
    const Heights height = hn::Add(
        hn::Add(hn::Mul(x, hn::LoadU(tag, core.x() + i)), hn::Mul(y, hn::LoadU(tag, core.y() + i))),
        hn::Mul(z, hn::LoadU(tag, core.z() + i)));
    const auto is_better = hn::Gt(height, most);
    most = hn::IfThenElse(is_better, height, most);
    first = hn::IfThenElse(is_better, index, first);
    index = hn::Add(index, step);
  }
  return best_of(most, first);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/measured_kernels.h"

namespace carom {
namespace {

HWY_EXPORT(furthest_in_lanes);

}  // namespace

FurthestPoint furthest_point_in_lanes() {
  return &CAROM_DISPATCH_MEASURED(furthest_point, furthest_in_lanes);
}

}  // namespace carom
#endif  // HWY_ONCE
