#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broadphase/resting/compare_boxes.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "broadphase/resting/compare_boxes.h"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

using FlagTag = hn::RebindToUnsigned<FloatTag>;

HWY_INLINE hn::Vec<FlagTag> load_bits(const float* column) {
  return hn::BitCast(FlagTag(), hn::LoadU(FloatTag(), column));
}

bool compare_boxes(const BoxBlock& now, const std::array<const float*, 6>& last,
                   BoxFlags& differs) {
  static_assert(BoxBlock::kBoxes % kLanes == 0 && kLanes <= BoxBlock::kPadding);
  const FlagTag tag;
  auto any = hn::Zero(tag);
  for (size_t i = 0; i < now.count; i += kLanes) {
    auto bits = hn::Zero(tag);
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto lower = hn::Xor(load_bits(now.lower[axis] + i), load_bits(last[axis] + i));
      const auto upper = hn::Xor(load_bits(now.upper[axis] + i), load_bits(last[3 + axis] + i));
      bits = hn::Or(bits, hn::Or(lower, upper));
    }
    if (HWY_UNLIKELY(i + kLanes > now.count)) {
      bits = hn::IfThenElseZero(hn::FirstN(tag, now.count - i), bits);
    }
    hn::StoreU(bits, tag, differs.data() + i);
    any = hn::Or(any, bits);
  }
  return !hn::AllTrue(tag, hn::Eq(any, hn::Zero(tag)));
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(compare_boxes);

}  // namespace

bool compare_boxes(const BoxBlock& now, const std::array<const float*, 6>& last,
                   BoxFlags& differs) {
  return CAROM_DISPATCH(compare_boxes)(now, last, differs);
}

}  // namespace carom
#endif  // HWY_ONCE
