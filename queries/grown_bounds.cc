// Four bodies at a time: their bounds and positions come in columns, their boxes go into rows.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "queries/grown_bounds.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <algorithm>
#include <array>
#include <bit>
#include <cfloat>
#include <cmath>

#include "base/tolerances.h"
#include "queries/grown_bounds.h"
#include "queries/grown_box.h"
#include "shapes/body_reader.h"
#include "trees/box_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

using BoxTag = hn::CappedTag<float, 4>;
using Bodies = hn::Vec<BoxTag>;
constexpr size_t kBoxLanes = hn::MaxLanes(BoxTag());

HWY_INLINE Bodies set(float value) { return hn::Set(BoxTag(), value); }

// Columns of the bounds and positions of a run.
class Columns {
 public:
  using Column = std::array<float, kBodiesAtOnce>;
  alignas(64) std::array<Column, 3> lower, upper, position;
  alignas(64) Column travel{};  // the margin for what each travels

  // Bodies from `count` on are not there.
  HWY_INLINE void load(const Collidables& bodies, const BoundsView& bounds, size_t first,
                       size_t count) {
    for (size_t axis = 0; axis < 3; ++axis) {
      copy(bounds.lower[axis], bounds.stride, first, count, lower[axis]);
      copy(bounds.upper[axis], bounds.stride, first, count, upper[axis]);
      std::fill(lower[axis].begin() + count, lower[axis].end(), kNothing.lower[axis]);
      std::fill(upper[axis].begin() + count, upper[axis].end(), kNothing.upper[axis]);
      std::fill(position[axis].begin() + count, position[axis].end(), 0.0f);
    }
    load_positions(bodies, first, count);
  }

  // No less than kTravelSlack times the length of each displacement.
  HWY_INLINE void load_travels(const SweepView& sweep, size_t first, size_t count) {
    constexpr auto kShare = static_cast<float>(kTravelSlack * (1 + 0x1p-20));
    for (size_t i = 0; i < count; ++i) {
      const auto way = load_strided<std::array<float, 3>>(sweep.displacement,
                                                          sweep.displacement_stride, first + i);
      travel[i] =
          (std::abs(way[0]) * kShare + std::abs(way[1]) * kShare) + std::abs(way[2]) * kShare;
    }
  }

 private:
  static HWY_INLINE void copy(const float* from, size_t stride, size_t first, size_t count,
                              Column& to) {
    if (stride == sizeof(float)) {
      std::copy_n(from + first, count, to.begin());
      return;
    }
    for (size_t i = 0; i < count; ++i) to[i] = load_strided<float>(from, stride, first + i);
  }

  HWY_INLINE void load_positions(const Collidables& bodies, size_t first, size_t count) {
    const PositionView& view = bodies.position;
    size_t i = 0;
    if (view.data && view.type == PositionType::float32 && view.stride == 4 * sizeof(float) &&
        view.radius_layout == RadiusLayout::fourth) {
      // Records of x, y, z and a radius. Behind the last of others the memory may end.
      const auto* record = static_cast<const float*>(view.data) + 4 * first;
      const BoxTag tag;
      for (; i + kBoxLanes <= count; i += kBoxLanes) {
        Bodies x, y, z, radius;
        hn::LoadInterleaved4(tag, record + 4 * i, x, y, z, radius);
        hn::Store(x, tag, position[0].data() + i);
        hn::Store(y, tag, position[1].data() + i);
        hn::Store(z, tag, position[2].data() + i);
      }
    }
    const BodyReader reader{bodies};
    for (; i < count; ++i) {
      const auto at = reader.position<float>(first + i);
      position[0][i] = at.x;
      position[1][i] = at.y;
      position[2][i] = at.z;
    }
  }
};

// Grows the boxes of kBoxLanes bodies, and empties those that take no part. Returns which do.
HWY_INLINE uint64_t grow(Columns& columns, size_t i) {
  const BoxTag tag;
  Bodies lower[3], upper[3], reach = hn::Zero(tag);
  auto is_there = hn::Eq(reach, reach);
  for (size_t axis = 0; axis < 3; ++axis) {
    lower[axis] = hn::Load(tag, columns.lower[axis].data() + i);
    upper[axis] = hn::Load(tag, columns.upper[axis].data() + i);
    const Bodies position = hn::Load(tag, columns.position[axis].data() + i);
    is_there = hn::And(is_there, hn::Le(lower[axis], upper[axis]));
    reach = max(hn::Sub(position, lower[axis]), reach);
    reach = max(hn::Sub(upper[axis], position), reach);
  }
  // 2^-23 of a coordinate covers the rounding of its sum, and 2^-20 of the margin the rest.
  constexpr auto kShare = static_cast<float>(kSearchSlack * (1 + 0x1p-20));
  const Bodies margin = hn::Add(hn::Add(hn::Mul(set(kShare), reach), set(8 * FLT_TRUE_MIN)),
                                hn::Load(tag, columns.travel.data() + i));
  for (size_t axis = 0; axis < 3; ++axis) {
    const Bodies below = hn::Add(margin, hn::Mul(set(0x1p-23f), hn::Abs(lower[axis])));
    const Bodies above = hn::Add(margin, hn::Mul(set(0x1p-23f), hn::Abs(upper[axis])));
    const Bodies new_lower =
        hn::IfThenElse(is_there, hn::Sub(lower[axis], below), set(kNothing.lower[axis]));
    const Bodies new_upper =
        hn::IfThenElse(is_there, hn::Add(upper[axis], above), set(kNothing.upper[axis]));
    hn::Store(new_lower, tag, columns.lower[axis].data() + i);
    hn::Store(new_upper, tag, columns.upper[axis].data() + i);
  }
  return bits_of(tag, is_there);
}

// Puts a number, and returns which of its bits have changed.
HWY_INLINE uint32_t put(float value, float& to) {
  const uint32_t changed = std::bit_cast<uint32_t>(to) ^ std::bit_cast<uint32_t>(value);
  to = value;
  return changed;
}

// Puts the numbers of a body into its row, and returns whether that has changed.
HWY_INLINE bool put_one(const Columns& columns, size_t i, TreeBox& box) {
  uint32_t changed = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    changed |= put(columns.lower[axis][i], box.lower[axis]);
    changed |= put(columns.upper[axis][i], box.upper[axis]);
  }
  return changed != 0;
}

#if HWY_TARGET != HWY_SCALAR
HWY_INLINE bool are_same(const BoxRow& a, const BoxRow& b) {
  const hn::RebindToUnsigned<Quad> bits;
  const auto differ = hn::Or(hn::Xor(hn::BitCast(bits, a.first), hn::BitCast(bits, b.first)),
                             hn::Xor(hn::BitCast(bits, a.second), hn::BitCast(bits, b.second)));
  return hn::AllTrue(bits, hn::Eq(differ, hn::Zero(bits)));
}

// The same for four bodies; returns a bit each.
HWY_INLINE uint64_t put_four(const Columns& columns, size_t i, TreeBox* boxes) {
  const auto load = [&](const Columns::Column& numbers) {
    return hn::Load(Quad(), numbers.data() + i);
  };
  const auto& lower = columns.lower;
  const auto& upper = columns.upper;
  RowOfFour first[4] = {load(lower[0]), load(lower[1]), load(lower[2]), load(upper[0])};
  RowOfFour second[4] = {first[2], first[3], load(upper[1]), load(upper[2])};
  transpose(first);
  transpose(second);
  uint64_t changed = 0;
  for (size_t k = 0; k < 4; ++k) {
    const BoxRow row{first[k], second[k]};
    changed |= uint64_t{!are_same(row, load_row(boxes[i + k]))} << k;
    store_row(row, boxes[i + k]);
  }
  return changed;
}
#endif  // HWY_TARGET

// Puts the columns into rows, and returns which of these have changed.
HWY_INLINE uint64_t put_rows(const Columns& columns, size_t count, TreeBox* boxes) {
  uint64_t changed = 0;
  size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  for (; i + 4 <= count; i += 4) changed |= put_four(columns, i, boxes) << i;
#endif  // HWY_TARGET
  for (; i < count; ++i) changed |= uint64_t{put_one(columns, i, boxes[i])} << i;
  return changed;
}

ChangedBoxes update(const Collidables& bodies, const BoundsView& bounds, size_t first, size_t count,
                    TreeBox* boxes, const SweepView* sweep) {
  Columns columns;
  if (sweep && sweep->displacement) columns.load_travels(*sweep, first, count);
  columns.load(bodies, bounds, first,
               first < bounds.count ? std::min(count, bounds.count - first) : 0);
  ChangedBoxes result{};
  for (size_t i = 0; i < count; i += kBoxLanes) result.are_there |= grow(columns, i) << i;
  result.changed = put_rows(columns, count, boxes);
  return result;
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(update);

}  // namespace

ChangedBoxes update_grown_bounds(const Collidables& bodies, const BoundsView& bounds, size_t first,
                                 size_t count, TreeBox* boxes, const SweepView* sweep) {
  return CAROM_DISPATCH(update)(bodies, bounds, first, count, boxes, sweep);
}

}  // namespace carom
#endif  // HWY_ONCE
