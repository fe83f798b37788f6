#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broadphase/grid/survey.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "broadphase/grid/edge-inl.h"
#include "broadphase/grid/survey.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

float largest_lane(F v) {
  HWY_ALIGN float lanes[kLanes];
  hn::Store(v, FloatTag(), lanes);
  float largest = lanes[0];
  for (size_t i = 1; i < kLanes; ++i) largest = largest < lanes[i] ? lanes[i] : largest;
  return largest;
}

// Adds the boxes of a block to the survey.
void survey_block(const BoxBlock& block, Survey& survey) {
  const FloatTag tag;
  const IntTag bits;
  F lowest[3], highest[3], edges[3];
  for (size_t axis = 0; axis < 3; ++axis) {
    lowest[axis] = splat(survey.lowest[axis]);
    highest[axis] = splat(survey.highest[axis]);
    edges[axis] = splat(survey.longest_edge[axis]);
  }
  HWY_ALIGN int32_t classes[kLanes];
  for (size_t i = 0; i < block.count; i += kLanes) {
    F lower[3], upper[3];
    for (size_t axis = 0; axis < 3; ++axis) {
      lower[axis] = hn::LoadU(tag, block.lower[axis] + i);
      upper[axis] = hn::LoadU(tag, block.upper[axis] + i);
    }
    const Mask valid = hn::And(hn::And(hn::Le(lower[0], upper[0]), hn::Le(lower[1], upper[1])),
                               hn::Le(lower[2], upper[2]));
    F longest = splat(0);
    for (size_t axis = 0; axis < 3; ++axis) {
      const F edge = hn::IfThenElseZero(valid, edge_of(lower[axis], upper[axis]));
      longest = max(longest, edge);
      edges[axis] = max(edges[axis], edge);
      const F finite = clamp_to_finite(lower[axis]);
      lowest[axis] = hn::IfThenElse(valid, min(lowest[axis], finite), lowest[axis]);
      highest[axis] = hn::IfThenElse(valid, max(highest[axis], finite), highest[axis]);
    }
    const size_t boxes = hn::CountTrue(tag, valid);
    survey.count += boxes;
    hn::Store(hn::ShiftRight<kSizeClassShift>(hn::BitCast(bits, longest)), bits, classes);
    if (HWY_LIKELY(boxes == kLanes)) {
      for (size_t k = 0; k < kLanes; ++k) ++survey.boxes_of_class[classes[k]];
    } else {
      const uint64_t valid_bits = bits_of(tag, valid);
      for (size_t k = 0; k < kLanes; ++k) {
        survey.boxes_of_class[classes[k]] += valid_bits >> k & 1;
      }
    }
  }
  for (size_t axis = 0; axis < 3; ++axis) {
    survey.lowest[axis] = -largest_lane(hn::Neg(lowest[axis]));
    survey.highest[axis] = largest_lane(highest[axis]);
    survey.longest_edge[axis] = largest_lane(edges[axis]);
  }
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <limits>

#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(survey_block);

}  // namespace

void Survey::clear() {
  lowest.fill(std::numeric_limits<float>::infinity());
  highest.fill(-std::numeric_limits<float>::infinity());
  longest_edge.fill(0);
  boxes_of_class.fill(0);
  count = 0;
}

void Survey::add(const Survey& other) {
  for (size_t axis = 0; axis < 3; ++axis) {
    lowest[axis] = std::min(lowest[axis], other.lowest[axis]);
    highest[axis] = std::max(highest[axis], other.highest[axis]);
    longest_edge[axis] = std::max(longest_edge[axis], other.longest_edge[axis]);
  }
  for (size_t i = 0; i < kSizeClasses; ++i) boxes_of_class[i] += other.boxes_of_class[i];
  count += other.count;
}

const Survey& Surveyor::run(const BoxSource& source, Parallelism parallelism) {
  const auto survey = CAROM_DISPATCH(survey_block);
  const size_t per_task = boxes_per_task(source.count);
  const size_t tasks = block_count(source.count, per_task);
  if (blocks_.size() < tasks) blocks_.resize(tasks);
  for_each_block(source.count, per_task, parallelism, [&](size_t task, size_t begin, size_t end) {
    BlockBuffer buffer;
    blocks_[task].clear();
    for (size_t i = begin; i < end; i += BoxBlock::kBoxes) {
      survey(buffer.load(source, i, std::min(end, i + BoxBlock::kBoxes)), blocks_[task]);
    }
  });
  total_.clear();
  for (size_t task = 0; task < tasks; ++task) total_.add(blocks_[task]);
  return total_;
}

}  // namespace carom
#endif  // HWY_ONCE
