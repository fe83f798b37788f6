// Linear times of impact with half-spaces (linear.h is the scalar form).
#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "impacts/linear/plane_kernels.cc"
#include <hwy/foreach_target.h>
// After the loop over targets.
#include "impacts/linear/axes-inl.h"
#include "impacts/linear/linear_load-inl.h"

HWY_BEFORE_NAMESPACE();
namespace carom::HWY_NAMESPACE {
namespace {

// The height of a body's lowest point along the plane's normal, relative to the body's position.
HWY_INLINE D lowest(const LinearSphere& sphere, const D3&) { return hn::Neg(sphere.radius); }

HWY_INLINE D lowest(const LinearCapsule& capsule, const D3& n) {
  const D start = dot(n, capsule.start), end = hn::Add(start, dot(n, capsule.edge));
  return hn::Sub(min(start, end), capsule.radius);
}

HWY_INLINE D lowest(const LinearBox& box, const D3& n) {
  return hn::Neg(reach_of_box(box.half, rotate_back(box.turn, n)));
}

HWY_INLINE D lowest(const LinearTriangle& triangle, const D3& n) {
  return min(min(dot(n, triangle.corner[0]), dot(n, triangle.corner[1])),
             dot(n, triangle.corner[2]));
}

HWY_INLINE D meets_plane(D height, D rate, D slack) {
  const D t = hn::Div(hn::Sub(height, slack), hn::Neg(rate));
  const DoubleMask meets = hn::And(hn::Lt(rate, zero()), hn::Le(t, splat_double(1)));
  return hn::IfThenZeroElse(hn::Le(height, slack), hn::IfThenElse(meets, t, never()));
}

template <class Body, LinearKind kKind>
struct OverPlane {
  using A = Body;
  using B = LinearPlane;
  static constexpr LinearKind kKindA = kKind;

  static HWY_INLINE D time(const LinearPair& pair, const A& a, const B& b) {
    return meets_plane(hn::Add(b.height, lowest(a, b.normal)), b.rate, pair.slack);
  }
};

void sphere_plane(LinearRows& rows, size_t count) {
  run_rows<OverPlane<LinearSphere, LinearKind::sphere>>(rows, count);
}
void capsule_plane(LinearRows& rows, size_t count) {
  run_rows<OverPlane<LinearCapsule, LinearKind::capsule>>(rows, count);
}
void box_plane(LinearRows& rows, size_t count) {
  run_rows<OverPlane<LinearBox, LinearKind::box>>(rows, count);
}
void triangle_plane(LinearRows& rows, size_t count) {
  run_rows<OverPlane<LinearTriangle, LinearKind::triangle>>(rows, count);
}

}  // namespace
}  // namespace carom::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "simd/dispatch.h"

namespace carom {
namespace {

HWY_EXPORT(sphere_plane);
HWY_EXPORT(capsule_plane);
HWY_EXPORT(box_plane);
HWY_EXPORT(triangle_plane);

}  // namespace

LinearKernel plane_kernel(LinearKind a) {
  using enum LinearKind;
  if (a == sphere) return CAROM_DISPATCH(sphere_plane);
  if (a == capsule) return CAROM_DISPATCH(capsule_plane);
  if (a == box) return CAROM_DISPATCH(box_plane);
  if (a == triangle) return CAROM_DISPATCH(triangle_plane);
  return nullptr;
}

}  // namespace carom
#endif  // HWY_ONCE
