// Boxes and capsules are computed with one body a lane; all other bodies, and tests of pairs, one
// at a time with one slab a lane.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bounds/dop_bounds.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <hwy/cache_control.h>

#include <algorithm>
#include <limits>

#include "bounds/bounds_columns.h"
#include "bounds/dop_core.h"
#include "bounds/dop_directions.h"
#include "bounds/dop_lanes-inl.h"
#include "carom/bounds/dop_bounds.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// Four slabs take one vector, two, or four of one lane.
using SlabTag = hn::CappedTag<double, 4>;
using Slabs = hn::Vec<SlabTag>;
inline constexpr size_t kSlabLanes = hn::MaxLanes(SlabTag());

HWY_INLINE Slabs all_slabs(double value) { return hn::Set(SlabTag(), value); }

// Directions s, s + 1, ..., one a lane.
struct SlabDirections {
  Slabs x, y, z;

  HWY_INLINE SlabDirections(const SlabColumns& all, size_t s)
      : x(hn::Load(SlabTag(), all.x + s)),
        y(hn::Load(SlabTag(), all.y + s)),
        z(hn::Load(SlabTag(), all.z + s)) {}

  // Exact: the factors x, y, z are -1, 0 or 1.
  HWY_INLINE Slabs project(const Double3& v) const {
    return hn::Add(hn::Add(hn::Mul(x, all_slabs(v[0])), hn::Mul(y, all_slabs(v[1]))),
                   hn::Mul(z, all_slabs(v[2])));
  }
};

// Rounds to the nearest float, and to infinity beyond their range. A cast on the scalar target,
// where Highway's DemoteTo saturates.
HWY_INLINE void store_floats(Slabs v, float* to) {
#if HWY_TARGET == HWY_SCALAR
  *to = static_cast<float>(hn::GetLane(v));
#else
  const hn::Rebind<float, SlabTag> tag;
  hn::StoreU(hn::DemoteTo(tag, v), tag, to);
#endif
}

// More than half a unit in the last place of a float.
HWY_INLINE Slabs float_rounding(Slabs v) {
  return hn::Add(hn::Mul(hn::Abs(v), all_slabs(kFloatRounding)), all_slabs(kLeastFloat));
}

// The ends of the projection of the core's points, or of the ellipsoids about them.
struct PointEnds {
  Slabs lower, upper;

  HWY_INLINE PointEnds(const SlabDirections& along, const DopCore& core) {
    const Slabs a = along.project(core.points[0]);
    const Slabs b = along.project(core.points[1]);
    const Slabs c = along.project(core.points[2]);
    if (!core.is_round) {
      lower = hn::Min(hn::Min(a, b), c);
      upper = hn::Max(hn::Max(a, b), c);
      return;
    }
    const auto square = [&](const Double3& v) HWY_ATTR {
      const Slabs on = along.project(v);
      return hn::Mul(on, on);
    };
    const auto& [x, y, z] = core.half_axes;
    const Slabs reach = hn::Sqrt(hn::Add(hn::Add(square(x), square(y)), square(z)));
    const auto share = [&](size_t i) HWY_ATTR { return hn::Mul(reach, all_slabs(core.shares[i])); };
    const Slabs of_a = share(0), of_b = share(1), of_c = share(2);
    lower = hn::Min(hn::Min(hn::Sub(a, of_a), hn::Sub(b, of_b)), hn::Sub(c, of_c));
    upper = hn::Max(hn::Max(hn::Add(a, of_a), hn::Add(b, of_b)), hn::Add(c, of_c));
  }
};

void write_record(const SlabColumns& directions, const DopCore& core, const Double3& position,
                  float* record) {
  const Slabs slack = all_slabs(slack_of(core, position));
  const Slabs radius = all_slabs(core.radius);
  for (size_t s = 0; s < directions.count; s += kSlabLanes) {
    const SlabDirections along(directions, s);
    const Slabs limit = all_slabs(kBeyondFloats);
    const Slabs at = hn::Min(hn::Max(along.project(position), hn::Neg(limit)), limit);
    const PointEnds ends(along, core);
    const Slabs box = hn::Add(
        hn::Add(hn::Abs(along.project(core.edges[0])), hn::Abs(along.project(core.edges[1]))),
        hn::Abs(along.project(core.edges[2])));
    const Slabs length = hn::Load(SlabTag(), directions.length + s);
    const Slabs reach = hn::Add(hn::Add(box, hn::Mul(radius, length)), slack);
    const Slabs lower = hn::Add(at, hn::Sub(ends.lower, reach));
    const Slabs upper = hn::Add(at, hn::Add(ends.upper, reach));
    float* to = record + place_in_record(s);
    store_floats(hn::Min(hn::Sub(lower, float_rounding(lower)), all_slabs(FLT_MAX)), to);
    store_floats(hn::Max(hn::Add(upper, float_rounding(upper)), all_slabs(-FLT_MAX)), to + 4);
  }
}

void fill_record(float lower, float upper, size_t size, float* record) {
  for (size_t i = 0; i < size; ++i) record[i] = i % 8 < 4 ? lower : upper;
}

// Writes the record of a body of any kind.
void write_single(const BodyReader& reader, const SlabColumns& directions, size_t i,
                  float* record) {
  constexpr float kUnbounded = std::numeric_limits<float>::infinity();
  const size_t size = 2 * directions.count;
  if (!reader.is_valid(i)) {
    fill_record(kUnbounded, -kUnbounded, size, record);
  } else if (reader.kind(i) == ShapeKind::halfspace) {
    fill_record(-kUnbounded, kUnbounded, size, record);
  } else {
    const Position<double> p = reader.position<double>(i);
    write_record(directions, dop_core(reader, i), {p.x, p.y, p.z}, record);
  }
}

// A list of bodies of one kind.
struct BodyList {
  size_t count = 0;
  uint32_t bodies[kBodiesPerBlock + kLanes];

  void add(size_t i) { bodies[count++] = static_cast<uint32_t>(i); }
};

template <class ShapeLanes>
void write_listed(const BodyReader& reader, const SlabColumns& directions, BodyList& list,
                  float* records) {
  if (list.count == 0) return;
  const size_t size = 2 * directions.count;
  std::fill_n(list.bodies + list.count, kLanes, list.bodies[list.count - 1]);
  for (size_t first = 0; first < list.count; first += kLanes) {
    const uint32_t* bodies = list.bodies + first;
    RecordLanes found;
    find_records<ShapeLanes>(reader, bodies, directions, found);
    for (size_t k = 0; k < std::min(kLanes, list.count - first); ++k) {
      float* record = records + bodies[k] * size;
      if (found.plain[k] != 0) {
        found.copy(k, size, record);
      } else {
        write_single(reader, directions, bodies[k], record);
      }
    }
  }
}

// The path that a body takes must depend on that body alone, or results would depend on the ISA.
void lane_dops(const Collidables& bodies, const SlabColumns& directions, const uint8_t* which,
               float* records, size_t begin, size_t end) {
  const BodyReader reader{bodies};
  BodyList boxes, capsules;
  for (size_t i = begin; i < end; ++i) {
    if (which && !which[i]) continue;
    const ShapeKind kind = reader.kind(i);
    if (kind == ShapeKind::box) {
      boxes.add(i);
    } else if (kind == ShapeKind::capsule) {
      capsules.add(i);
    } else {
      write_single(reader, directions, i, records + i * 2 * directions.count);
    }
  }
  write_listed<BoxLanes>(reader, directions, boxes, records);
  write_listed<CapsuleLanes>(reader, directions, capsules, records);
}

// --- Pairs ---

using EndTag = hn::CappedTag<float, 4>;
using Meets = hn::Mask<EndTag>;

// Compares up to four slabs of two records.
HWY_INLINE Meets meet(const float* a, const float* b) {
  const EndTag tag;
  return hn::And(hn::Le(hn::LoadU(tag, a), hn::LoadU(tag, b + 4)),
                 hn::Le(hn::LoadU(tag, b), hn::LoadU(tag, a + 4)));
}

// Without a branch: which slab separates two bodies cannot be predicted. The second bodies of
// sorted pairs lie anywhere in memory, and are asked for some pairs ahead.
template <size_t kFours>
size_t find_overlaps(const float* records, const Pair* pairs, size_t count, uint8_t* overlap) {
  const EndTag tag;
  constexpr size_t kSize = 8 * kFours;
  size_t sum = 0;
  for (size_t i = 0; i < count; ++i) {
    const float* a = records + pairs[i].a * kSize;
    const float* b = records + pairs[i].b * kSize;
    Meets all = meet(a, b);
    for (size_t s = hn::MaxLanes(tag); s < 4 * kFours; s += hn::MaxLanes(tag)) {
      all = hn::And(all, meet(a + place_in_record(s), b + place_in_record(s)));
    }
    overlap[i] = hn::AllTrue(tag, all);
    sum += overlap[i];
  }
  return sum;
}

size_t lane_overlaps(const DopRecords& records, const Pair* pairs, size_t count, uint8_t* overlap) {
  switch (records.kind) {
    case DopKind::k14:
      return find_overlaps<1>(records.data, pairs, count, overlap);
    case DopKind::k18:
      return find_overlaps<2>(records.data, pairs, count, overlap);
    default:
      return find_overlaps<3>(records.data, pairs, count, overlap);
  }
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <atomic>

#include "base/parallel.h"
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(lane_dops);
HWY_EXPORT(lane_overlaps);

constexpr size_t kPairsPerBlock = 4096;

}  // namespace

void compute_dops(const Collidables& bodies, const DopRecords& out, Parallelism parallelism,
                  std::span<const uint8_t> which) {
  const SlabColumns directions(out.kind);
  if (directions.count == 0) return;
  const uint8_t* flags = which.empty() ? nullptr : which.data();
  for_each_block(bodies.count, kBodiesPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    CAROM_DISPATCH(lane_dops)(bodies, directions, flags, out.data, begin, end);
  });
}

size_t drop_separate_dops(const DopRecords& records, std::span<const Pair> pairs, uint8_t* overlap,
                          Parallelism parallelism) {
  if (extra_slab_count(records.kind) == 0) {
    std::fill_n(overlap, pairs.size(), uint8_t{1});
    return pairs.size();
  }
  std::atomic<size_t> sum{0};
  for_each_block(pairs.size(), kPairsPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    sum += CAROM_DISPATCH(lane_overlaps)(records, &pairs[begin], end - begin, overlap + begin);
  });
  return sum;
}

}  // namespace carom
#endif  // HWY_ONCE
