// Decides pairs of hulls by a ball that holds each, and one that lies in it (ball_scalar.h is the
// scalar form, and says why that is certain).
#if defined(CAROM_NARROWPHASE_HULLS_BALL_KERNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAROM_NARROWPHASE_HULLS_BALL_KERNEL_INL_H_
#undef CAROM_NARROWPHASE_HULLS_BALL_KERNEL_INL_H_
#else
#define CAROM_NARROWPHASE_HULLS_BALL_KERNEL_INL_H_
#endif

#include "narrowphase/hulls/core_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {

// The middle and the outer radius of each lane's hull are a record.
struct BallRecords {
  const HullLanes& hull;

  HWY_INLINE const float* record(size_t lane) const {
    const HullGeometry* const geometry = hull.geometry[lane];
    return geometry ? geometry->balls().outer.data() : kNoRecords.data();
  }
#if HWY_TARGET != HWY_SCALAR
  HWY_INLINE hn::Vec<Quad> quad(size_t lane) const { return hn::LoadU(Quad(), record(lane)); }
#endif
  HWY_INLINE float component(size_t lane, size_t c) const { return record(lane)[c]; }
};

struct BallLanes {
  F3 middle;
  F outer, inner;

  HWY_INLINE BallLanes(const HullLanes& hull, const Quaternion& q, const F3& offset) {
    F3 own;
    transpose_records(BallRecords{hull}, own, outer);
    inner = lanes_from([&](size_t lane) {
      const HullGeometry* const geometry = hull.geometry[lane];
      return geometry ? geometry->balls().inner : 0.0f;
    });
    middle = rotate(placing_turn(hull, q), own) + offset;
    outer = hn::Mul(outer, hull.scaling);
    inner = hn::Mul(inner, hull.scaling);
  }
};

// Marks as unsure what the balls do not decide.
struct BallKernel {
  using A = HullLanes;
  using B = HullLanes;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::left;
  static constexpr Columns kColumns = Columns::as_asked;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const A& a, const B& b, Report& report) {
    const BallLanes ball_a(a, pose.a, splat3(0)), ball_b(b, pose.b, pose.d);
    const F3 way = ball_b.middle - ball_a.middle;
    const F squared = dot(way, way);
    const F outer = hn::Add(hn::Add(ball_a.outer, ball_b.outer), splat(kSureGap));
    const F inner = hn::Sub(hn::Add(ball_a.inner, ball_b.inner), splat(kSureGap));
    const Mask is_apart = hn::Gt(squared, hn::Mul(outer, outer));
    const Mask overlap = hn::And(hn::Gt(inner, splat(0)), hn::Lt(squared, hn::Mul(inner, inner)));
    const Mask is_sure = hn::And(is_usual_scale(report.up), hn::Or(is_apart, overlap));
    const F separation = hn::IfThenElse(is_apart, splat(1), splat(-1));
    report(overlap, hn::Not(is_sure), no_lanes(), separation, splat3(0), splat3(0), splat3(0));
  }
};

}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAROM_NARROWPHASE_HULLS_BALL_KERNEL_INL_H_
