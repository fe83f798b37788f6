// Sphere against ellipsoid, in the frame of the ellipsoid.
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/pairs/sphere/sphere_ellipsoid.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "narrowphase/batch/batch-inl.h"
#include "narrowphase/features/profile-inl.h"
#include "narrowphase/features/round_tolerances.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// The steps of the scalar form. A lane stops where its own search ends.
struct EllipsoidSearch {
  F3 reached;  // the semi-axes times the coordinates of the point
  F3 beyond;   // the squares of the semi-axes less the least of them
  F s;
  Mask is_found;

  HWY_INLINE EllipsoidSearch(const F3& semi_axes, const F3& y) {
    const F least = min(min(semi_axes.x, semi_axes.y), semi_axes.z);
    const auto square_beyond = [&](F axis) HWY_ATTR {
      return hn::Mul(hn::Sub(axis, least), hn::Add(axis, least));
    };
    reached = {hn::Mul(semi_axes.x, y.x), hn::Mul(semi_axes.y, y.y), hn::Mul(semi_axes.z, y.z)};
    beyond = {square_beyond(semi_axes.x), square_beyond(semi_axes.y), square_beyond(semi_axes.z)};
    const F3 start = reached - beyond;
    s = max(max(max(start.x, start.y), start.z), splat(kLeastShift));
    is_found = no_lanes();
    Mask is_open = hn::Gt(s, splat(kLeastShift));
    for (size_t i = 0; i < kMostEllipsoidSteps && !hn::AllFalse(FloatTag(), is_open); ++i) {
      step(is_open);
    }
  }

 private:
  HWY_INLINE void step(Mask& is_open) {
    const F one = splat(1);
    const F3 share = {hn::Div(one, hn::Add(s, beyond.x)), hn::Div(one, hn::Add(s, beyond.y)),
                      hn::Div(one, hn::Add(s, beyond.z))};
    const F3 q = {hn::Mul(reached.x, share.x), hn::Mul(reached.y, share.y),
                  hn::Mul(reached.z, share.z)};
    const F3 squares = {hn::Mul(q.x, q.x), hn::Mul(q.y, q.y), hn::Mul(q.z, q.z)};
    const F sum = hn::Add(hn::Add(squares.x, squares.y), squares.z);
    const F rate = dot(squares, share);
    const F next = hn::Add(s, hn::Div(hn::Mul(sum, hn::Sub(hn::Sqrt(sum), one)), rate));
    s = hn::IfThenElse(is_open, max(next, splat(kLeastShift)), s);
    const Mask is_near = hn::Le(hn::Abs(hn::Sub(sum, one)), splat(kNearSurface));
    is_found = hn::Or(is_found, hn::And(is_open, is_near));
    is_open = hn::AndNot(is_near, is_open);
  }
};

HWY_INLINE Mask is_at_thin_rim(const F3& semi_axes, const EllipsoidSearch& search,
                               const F3& gradient) {
  const auto of_rim = [&](F axis, F slope, F beyond) HWY_ATTR {
    const F q = hn::Mul(axis, slope);
    return hn::IfThenElseZero(hn::Gt(beyond, search.s), hn::Mul(q, q));
  };
  const F3& beyond = search.beyond;
  const F sum = hn::Add(
      hn::Add(of_rim(semi_axes.x, gradient.x, beyond.x), of_rim(semi_axes.y, gradient.y, beyond.y)),
      of_rim(semi_axes.z, gradient.z, beyond.z));
  const F most = max(max(beyond.x, beyond.y), beyond.z);
  return hn::And(hn::Lt(search.s, hn::Mul(splat(kThinRim), most)), hn::Gt(sum, splat(kMostOfSum)));
}

HWY_INLINE WayOutLanes way_out_of_ellipsoid(const F3& semi_axes, const F3& point) {
  const F3 y = {hn::Abs(point.x), hn::Abs(point.y), hn::Abs(point.z)};
  const EllipsoidSearch search(semi_axes, y);
  const F3 gradient = {hn::Div(y.x, hn::Add(search.s, search.beyond.x)),
                       hn::Div(y.y, hn::Add(search.s, search.beyond.y)),
                       hn::Div(y.z, hn::Add(search.s, search.beyond.z))};
  const F3 n = gradient * hn::Div(splat(1), hn::Sqrt(dot(gradient, gradient)));
  const F3 h = {hn::Mul(semi_axes.x, n.x), hn::Mul(semi_axes.y, n.y), hn::Mul(semi_axes.z, n.z)};
  const F gap = hn::Sub(dot(n, y), hn::Sqrt(dot(h, h)));
  const F3 out = {hn::CopySign(n.x, point.x), hn::CopySign(n.y, point.y),
                  hn::CopySign(n.z, point.z)};
  return {gap, out, hn::Or(hn::Not(search.is_found), is_at_thin_rim(semi_axes, search, gradient))};
}

struct SphereEllipsoid {
  using A = SphereLanes;
  using B = EllipsoidLanes;
  static constexpr Units kUnits = Units::scaled;
  static constexpr Unsure kUnsure = Unsure::everything;

  template <class Report>
  static HWY_INLINE void test(const PoseLanes& pose, const SphereLanes& sphere,
                              const EllipsoidLanes& ellipsoid, Report& report) {
    const Rotation turn = rotation_of(pose.b);
    const F3 centre = rotate_back(turn, -pose.d);
    const WayOutLanes way = way_out_of_ellipsoid(ellipsoid.semi_axes, centre);
    report_ball(centre, sphere.radius, ellipsoid.rounding, turn, way, report);
  }
};

void sphere_ellipsoid(const Batch& batch) { run_batch<SphereEllipsoid>(batch); }

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {

HWY_EXPORT(sphere_ellipsoid);

void run_sphere_ellipsoid(const Batch& batch) { CAROM_DISPATCH(sphere_ellipsoid)(batch); }

}  // namespace carom
#endif  // HWY_ONCE
