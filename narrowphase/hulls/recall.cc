// Tests in lanes whether hulls are still nearest, or still overlap, by the corners of the last
// time, without a search (recall_scalar.h says when that is sure).
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/hulls/recall.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include <array>
#include <bit>

#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/hulls/core_kernel-inl.h"
#include "narrowphase/hulls/features.h"
#include "narrowphase/hulls/recall-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// A hull whose points stay where they are stored; only the few corners are placed in the world.
class StoredHull {
 public:
  HWY_INLINE StoredHull(const HullLanes& hull, const Quaternion& q, const F3& offset)
      : records_(hull), turn_(placing_turn(hull, q)), offset_(offset) {}

  HWY_INLINE F3 placed_point(Indices places) const {
    return rotate(turn_, records_.points_at(places)) + offset_;
  }

  HWY_INLINE FacingCount count_facing(const F3& way, F height) const {
    const F3 own_way = rotate_back(turn_, way);
    const F base = dot(way, offset_), limit = hn::Sub(height, splat(kFacingSlack)), one = splat(1);
    const F each = records_.count_lanes();
    FacingCount facing{splat(-FLT_MAX), splat(0)};
    records_.for_each_point(records_.most(), [&](size_t i, const F3& p) HWY_ATTR {
      const F h = hn::Add(dot(own_way, p), base);
      Mask is_facing = hn::Ge(h, limit);
      if (i >= records_.least()) {
        is_facing = hn::And(is_facing, hn::Lt(splat(static_cast<float>(i)), each));
      }
      facing.most = max(facing.most, h);
      facing.count = hn::Add(facing.count, hn::IfThenElseZero(is_facing, one));
    });
    return facing;
  }

 private:
  const HullRecords records_;
  const Rotation turn_;
  const F3 offset_;
};

// The features of each lane (features.h), as the two halves of their words.
class FeatureLanes {
 public:
  explicit HWY_INLINE FeatureLanes(const uint64_t* packed) {
    static_assert(std::endian::native == std::endian::little);
    hn::LoadInterleaved2(IndexTag(), reinterpret_cast<const uint32_t*>(packed), low_, high_);
  }

  HWY_INLINE F count() const {
    const hn::RebindToSigned<IndexTag> integers;
    return hn::ConvertTo(FloatTag(), hn::BitCast(integers, hn::ShiftRight<24>(high_)));
  }
  template <size_t kCorner>
  HWY_INLINE CornerLanes corner(const StoredHull& a, const StoredHull& b) const {
    const F3 on_a = a.placed_point(index<2 * kCorner>());
    return {b.placed_point(index<2 * kCorner + 1>()) - on_a, on_a};
  }

 private:
  template <size_t kPlace>
  HWY_INLINE Indices index() const {
    constexpr int kFirst = kPlace * kFeatureBits;
    const Indices mask = hn::Set(IndexTag(), (1 << kFeatureBits) - 1);
    if constexpr (kFirst >= 32) {
      return hn::And(hn::ShiftRight<kFirst - 32>(high_), mask);
    } else if constexpr (kFirst + kFeatureBits <= 32) {
      return hn::And(hn::ShiftRight<kFirst>(low_), mask);
    } else {
      return hn::And(hn::Or(hn::ShiftRight<kFirst>(low_), hn::ShiftLeft<32 - kFirst>(high_)), mask);
    }
  }

  Indices low_, high_;
};

HWY_INLINE ZeroInside zero_inside(const std::array<F3, 4>& corner) {
  const F3& last = corner[3];
  const F3 p = corner[0] - last, q = corner[1] - last, r = corner[2] - last;
  const F3 pq = cross(p, q);
  return ZeroInside({dot(cross(q, r), last), hn::Neg(dot(cross(p, r), last)), dot(pq, last)},
                    dot(pq, r), corner);
}

// Marks a row unsure unless its corners surely hold. Pairs that overlap get the decision only, no
// depth.
struct RecallKernel {
  using A = HullLanes;
  using B = HullLanes;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::left;
  static constexpr Columns kColumns = Columns::contact;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const A& a, const B& b, Report& report) {
    const StoredHull hull_a(a, pose.a, splat3(0)), hull_b(b, pose.b, pose.d);
    const FeatureLanes features(report.batch.features + report.row);
    const F count = features.count();
    const CornerLanes p = features.corner<0>(hull_a, hull_b),
                      q = features.corner<1>(hull_a, hull_b),
                      r = features.corner<2>(hull_a, hull_b),
                      last = features.corner<3>(hull_a, hull_b);
    const Mask is_known = hn::And(is_usual_scale(report.up), report.valid);
    const Mask is_around = hn::And(hn::And(is_known, hn::Eq(count, splat(4))),
                                   zero_inside({p.point, q.point, r.point, last.point}).is_sure);
    const SpannedWay way(p, q, r, hn::Eq(count, splat(2)), hn::Eq(count, splat(3)));
    NearestCores nearest = way.confirmed_by(hull_a.count_facing(way.normal(), way.height_of_a()),
                                            hull_b.count_facing(-way.normal(), way.height_of_b()));
    const Mask is_span = hn::And(hn::Gt(count, splat(0)), hn::Lt(count, splat(4)));
    nearest.is_sure =
        hn::And(nearest.is_sure, hn::And(way.ends_inside(), hn::And(is_known, is_span)));
    nearest.distance = hn::IfThenElse(is_around, splat(-1), nearest.distance);
    nearest.is_sure = hn::Or(nearest.is_sure, is_around);
    report_nearest(nearest, splat(0), splat(0), pose.d, no_lanes(), report);
  }
};

}  // namespace

void recall_hulls(const Batch& batch) { run_batch<RecallKernel>(batch); }

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
