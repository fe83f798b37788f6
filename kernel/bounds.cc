// World bounds. Spheres and boxes with float32 positions go through lanes; float64 positions are
// summed one by one.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/bounds.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <array>
#include <limits>

#include "carom/kernel/bounds.h"
#include "kernel/bounds_columns.h"
#include "simd/gather-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// The neighbouring float towards -inf (kTowards = -1) or +inf (+1), by its bits. Finite v.
template <int kTowards>
HWY_INLINE F neighbour(F v) {
  const IntTag bits;
  const I as_integer = hn::BitCast(bits, v);
  const I sign = hn::ShiftRight<31>(as_integer);  // 0 or -1
  const I step = hn::Set(bits, kTowards);
  // Positive floats order like their bits, negative ones against them.
  const I moved = hn::Add(as_integer, hn::Sub(hn::Xor(step, sign), sign));
  const I from_zero = hn::Set(bits, kTowards < 0 ? static_cast<int32_t>(0x80000001u) : 1);
  return hn::IfThenElse(hn::Eq(v, splat(0)), hn::BitCast(FloatTag(), from_zero),
                        hn::BitCast(FloatTag(), moved));
}

struct RoundedSum {
  F sum;
  F error;  // NaN if the sum overflows
};

HWY_INLINE RoundedSum two_sum(F a, F b) {
  const F sum = hn::Add(a, b);
  const F b_part = hn::Sub(sum, a);
  return {sum, hn::Add(hn::Sub(a, hn::Sub(sum, b_part)), hn::Sub(b, b_part))};
}

HWY_INLINE F sum_downwards(F a, F b) {
  const RoundedSum s = two_sum(a, b);
  const F down = hn::IfThenElse(hn::Lt(s.error, splat(0)), neighbour<-1>(s.sum), s.sum);
  return min(down, splat(FLT_MAX));
}

HWY_INLINE F sum_upwards(F a, F b) {
  const RoundedSum s = two_sum(a, b);
  const F up = hn::IfThenElse(hn::Gt(s.error, splat(0)), neighbour<1>(s.sum), s.sum);
  return max(up, splat(-FLT_MAX));
}

HWY_INLINE Mask is_finite(F v) { return hn::Le(hn::Abs(v), splat(FLT_MAX)); }

HWY_INLINE Mask is_finite(const F3& v) {
  return hn::And(hn::And(is_finite(v.x), is_finite(v.y)), is_finite(v.z));
}

HWY_INLINE Mask is_ordered(const F3& lower, const F3& upper) {
  return hn::And(hn::And(hn::Le(lower.x, upper.x), hn::Le(lower.y, upper.y)),
                 hn::Le(lower.z, upper.z));
}

// Writes kLanes bounds; returns how many of them are of valid bodies.
HWY_INLINE size_t write_bounds(const F3& position, const F3& lower, const F3& upper,
                               const BoundsColumns& out, size_t row) {
  const FloatTag tag;
  const Mask valid = hn::And(hn::And(is_finite(position), is_ordered(lower, upper)),
                             hn::And(is_finite(lower), is_finite(upper)));
  const F empty_lower = splat(kInfinity);
  const F empty_upper = splat(-kInfinity);
  const auto write = [&](size_t axis, F p, F low, F high) HWY_ATTR {
    hn::StoreU(hn::IfThenElse(valid, sum_downwards(p, low), empty_lower), tag,
               out.lower[axis] + row);
    hn::StoreU(hn::IfThenElse(valid, sum_upwards(p, high), empty_upper), tag,
               out.upper[axis] + row);
  };
  write(0, position.x, lower.x, upper.x);
  write(1, position.y, lower.y, upper.y);
  write(2, position.z, lower.z, upper.z);
  return hn::CountTrue(tag, valid);
}

struct ConsecutiveRecords {
  const char* base;
  size_t stride;

  HWY_INLINE const float* record(size_t i) const {
    return reinterpret_cast<const float*>(base + i * stride);
  }
#if HWY_TARGET != HWY_SCALAR
  HWY_INLINE hn::Vec<Quad> quad(size_t i) const { return hn::LoadU(Quad(), record(i)); }
#endif
  HWY_INLINE float component(size_t i, size_t c) const { return record(i)[c]; }
};

// Packed spheres [begin, end), end - begin a multiple of the lanes; returns the valid ones.
size_t sphere_bounds(const PositionView& records, const BoundsColumns& out, size_t begin,
                     size_t end) {
  size_t valid = 0;
  for (size_t i = begin; i < end; i += kLanes) {
    const char* base = static_cast<const char*>(records.data) + i * records.stride;
    F3 centre;
    F radius;
    transpose_records(ConsecutiveRecords{base, records.stride}, centre, radius);
    const F3 r = {radius, radius, radius};
    valid += write_bounds(centre, -r, r, out, i);
  }
  return valid;
}

// Rows of columns, as for sphere_bounds; `out` is indexed from `begin`.
size_t column_bounds(const BodyColumns& bodies, const BoundsColumns& out, size_t begin,
                     size_t end) {
  const FloatTag tag;
  const auto load = [&](const auto& columns, size_t i) HWY_ATTR {
    return F3{hn::LoadU(tag, columns[0].data() + i), hn::LoadU(tag, columns[1].data() + i),
              hn::LoadU(tag, columns[2].data() + i)};
  };
  size_t valid = 0;
  for (size_t i = 0; begin + i < end; i += kLanes) {
    valid += write_bounds(load(bodies.position, i), load(bodies.lower, i), load(bodies.upper, i),
                          out, begin + i);
  }
  return valid;
}

size_t lane_count() { return kLanes; }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <atomic>

#include "kernel/body_reader.h"
#include "kernel/outward.h"
#include "kernel/parallel.h"
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(sphere_bounds);
HWY_EXPORT(column_bounds);
HWY_EXPORT(lane_count);

bool are_packed_spheres(const Collidables& bodies) {
  return !bodies.kind && bodies.uniform_kind == ShapeKind::sphere &&
         bodies.position.type == PositionType::float32 &&
         bodies.position.radius_layout == RadiusLayout::fourth;
}

struct Extent {
  std::array<float, 3> lower, upper;
};

Extent extent_of(const BodyReader& reader, size_t i) {
  if (reader.kind(i) == ShapeKind::sphere) {
    const float r = reader.radius(i);
    return {{-r, -r, -r}, {r, r, r}};
  }
  return {{reader.lower(0, i), reader.lower(1, i), reader.lower(2, i)},
          {reader.upper(0, i), reader.upper(1, i), reader.upper(2, i)}};
}

// One body at a time: float64 positions and the tail of a block.
size_t single_bounds(const Collidables& bodies, const BoundsColumns& out, size_t begin,
                     size_t end) {
  const BodyReader reader{bodies};
  const float infinity = std::numeric_limits<float>::infinity();
  size_t valid = 0;
  for (size_t i = begin; i < end; ++i) {
    const bool is_valid = reader.is_valid(i);
    const Position<double> p = reader.position<double>(i);
    const Extent extent = extent_of(reader, i);
    const std::array<double, 3> position = {p.x, p.y, p.z};
    for (size_t axis = 0; axis < 3; ++axis) {
      const double lower = extent.lower[axis];
      const double upper = extent.upper[axis];
      out.lower[axis][i] = is_valid ? sum_downwards(position[axis], lower) : infinity;
      out.upper[axis][i] = is_valid ? sum_upwards(position[axis], upper) : -infinity;
    }
    valid += is_valid;
  }
  return valid;
}

// float32 bodies of any kinds and layout, through columns.
size_t any_bounds(const Collidables& bodies, const BoundsColumns& out, size_t begin, size_t end) {
  BodyColumns columns;
  const BodyReader reader{bodies};
  for (size_t i = begin; i < end; ++i) {
    const Position<float> p = reader.position<float>(i);
    const Extent extent = extent_of(reader, i);
    const std::array<float, 3> position = {p.x, p.y, p.z};
    for (size_t axis = 0; axis < 3; ++axis) {
      columns.position[axis][i - begin] = position[axis];
      columns.lower[axis][i - begin] = extent.lower[axis];
      columns.upper[axis][i - begin] = extent.upper[axis];
    }
  }
  return CAROM_DISPATCH(column_bounds)(columns, out, begin, end);
}

size_t block_bounds(const Collidables& bodies, const BoundsColumns& out, size_t begin, size_t end) {
  if (bodies.position.type == PositionType::float64) return single_bounds(bodies, out, begin, end);
  const size_t whole = end - (end - begin) % CAROM_DISPATCH(lane_count)();
  const size_t valid = are_packed_spheres(bodies)
                           ? CAROM_DISPATCH(sphere_bounds)(bodies.position, out, begin, whole)
                           : any_bounds(bodies, out, begin, whole);
  return valid + single_bounds(bodies, out, whole, end);
}

}  // namespace

size_t compute_bounds(const Collidables& bodies, const BoundsColumns& out,
                      Parallelism parallelism) {
  std::atomic<size_t> valid{0};
  for_each_block(bodies.count, kBodiesPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    valid += block_bounds(bodies, out, begin, end);
  });
  return bodies.count - valid;
}

}  // namespace carom
#endif  // HWY_ONCE
